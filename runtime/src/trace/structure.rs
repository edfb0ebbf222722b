//! Is anything missing? Structure in the residual, whatever its cause.
//!
//! Four tests that need no candidate and no known noise level. The first compares the residual's power where robots move
//! with its power just above, and with that of the part of the band of motion which has least: sensor noise, white or correlated over
//! milliseconds, has as much power in all of them or one, a missing torque follows the motion. The second asks what of that power noise can
//! have at all that is seen above the band, whatever the time over which it is correlated: a torque that rings has more. The third needs a
//! motion that repeats: what comes back in every period is not noise. The last is of a level that changes once and stays, which is slower
//! than any motion.

use crate::signal::band_density;

use super::periodic::repeated_power;

/// Ends of bands, as multiples of the shared filter's cutoff: of the band of motion, and of its parts, about as wide as far up they are; of the
/// band of reference above it; and of one above that, where noise shows how steep it is.
const MOTION_BAND: (f64, f64) = (0.03, 0.8);
const PARTS_OF_MOTION: [f64; 5] = [0.03, 0.08, 0.18, 0.38, 0.8];
const REFERENCE_BAND: (f64, f64) = (1.2, 2.5);
const BAND_ABOVE: (f64, f64) = (2.5, 4.0);

/// Noise falls by at most this many times what first order does from the reference to the band above it. Second order, as filters have that
/// logs went through before they were written, falls by more, and then nothing is known of noise below.
const STEEPEST: f64 = 2.0;

/// What rings has this many times the power of some part of the band of motion below it. Noise behind a filter does not rise with the frequency,
/// and where it was rounded afterwards, too, it is as flat above the band as noise that is not filtered.
const RISES: f64 = 3.0;

/// The residual is structured where its power in the band of motion is more than this many times that of the reference.
const LEAST_RATIO: f64 = 4.0;

/// Structure counts from this share of the raw error's power: its removal would lower the raw error by eight percent. An
/// effect is named from five percent on; to say that something unknown is missing takes a little more, as the filters of the
/// motion leave some structure at the reversals of dry friction.
pub(super) const MATERIAL_SHARE: f64 = 0.15;

/// Structure is a level that changes where steps take more than this share of its power off.
const OF_LEVEL: f64 = 0.5;

/// Structure of one joint's residual.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct Structure {
    /// Power of the structured part, (N m)^2 or N^2.
    pub power: f64,
    /// Its share of the raw residual's power.
    pub share: f64,
    /// Density of power in the band of motion over that of the reference band, or of the part of the band of motion where it is least, if
    /// that is more.
    pub ratio: f64,
    /// Power that steps of its level take off it, (N m)^2 or N^2.
    pub(super) stepped: f64,
}

impl Structure {
    /// Whether something is missing on this joint that matters.
    ///
    /// # Examples
    /// ```
    /// use robot_model::trace::Structure;
    /// // A tenth of the residual's power is what filters and noise leave, half of it is an effect.
    /// let mut structure = Structure::default();
    /// let mut is_material = |share: f64| {
    ///     structure.share = share;
    ///     structure.is_material()
    /// };
    /// assert!(!is_material(0.1) && is_material(0.5));
    /// ```
    #[must_use]
    pub fn is_material(&self) -> bool {
        self.share > MATERIAL_SHARE
    }

    /// Whether most of it is a level that changes: no law of the motion, and no word against one.
    pub(super) fn is_of_level(&self) -> bool {
        self.stepped > OF_LEVEL * self.power
    }

    /// No more of it than this power.
    pub(super) fn limit(&mut self, most: f64) {
        if most < self.power {
            let kept = most / self.power;
            self.share *= kept;
            self.stepped *= kept;
            self.power = most;
        }
    }
}

/// One log's raw residual: unfiltered torque minus the model's.
pub(super) struct RawResidual<'a> {
    pub(super) values: &'a [f64],
    /// Mean square of what decimation took off it.
    pub(super) beyond: f64,
    /// The same residual, filtered and decimated.
    pub(super) filtered: Vec<f64>,
    /// Rate of the decimated samples.
    pub(super) filtered_hz: f64,
    pub(super) rate_hz: f64,
    pub(super) shared_hz: f64,
    pub(super) period: Option<f64>,
    /// Mean square that a step takes off it.
    pub(super) stepped: f64,
    /// Mean square of what steps of encoders make of it.
    pub(super) encoder: f64,
}

/// Structure of one joint over all logs.
pub(super) fn of(logs: &[RawResidual]) -> Structure {
    let samples: usize = logs.iter().map(|log| log.values.len()).sum();
    let mut found = Structure::default();
    let mut total = 0.0;
    for log in logs {
        let weight = log.values.len() as f64 / samples.max(1) as f64;
        let mean = log.values.iter().sum::<f64>() / log.values.len().max(1) as f64;
        let squares = log.values.iter().map(|v| (v - mean).powi(2)).sum::<f64>();
        total += weight * (squares / log.values.len().max(1) as f64 + log.beyond);
        let spectrum = Spectrum::of(log);
        let (ratio, above) = spectrum.beyond_reference();
        let rings = spectrum.beyond_noise() - log.encoder;
        let periodic = log.period.map_or(0.0, |period| {
            (repeated_power(&log.filtered, period * log.filtered_hz) - log.encoder).max(0.0)
        });
        found.stepped += weight * log.stepped;
        found.power += weight * above.max(rings).max(periodic).max(log.stepped);
        found.ratio = found.ratio.max(ratio);
    }
    found.share = if total > 0.0 {
        (found.power / total).min(1.0)
    } else {
        0.0
    };
    found
}

/// Densities of a raw residual's power, of frequencies as multiples of the shared filter's cutoff.
struct Spectrum {
    /// In the band of motion.
    motion: f64,
    /// In its parts.
    parts: [f64; PARTS_OF_MOTION.len() - 1],
    /// In the band of reference, and in the one above it.
    reference: f64,
    above: f64,
}

impl Spectrum {
    fn of(log: &RawResidual) -> Self {
        let density = |edges: &[f64]| {
            let hz: Vec<f64> = edges.iter().map(|edge| edge * log.shared_hz).collect();
            let density = band_density(log.values, log.rate_hz, &hz).into_iter();
            density
                .map(|of_hz| of_hz * log.shared_hz)
                .collect::<Vec<_>>()
        };
        let above = [REFERENCE_BAND.0, REFERENCE_BAND.1, BAND_ABOVE.1];
        let bands = density(&[&PARTS_OF_MOTION[..], &above].concat());
        let at = |band: usize| bands[band];
        Self {
            motion: density(&[MOTION_BAND.0, MOTION_BAND.1])[0],
            parts: std::array::from_fn(at),
            // The one between the band of motion and the reference is in neither.
            reference: at(PARTS_OF_MOTION.len()),
            above: at(PARTS_OF_MOTION.len() + 1),
        }
    }

    /// Parts of the band of motion: their ends, and the density in them.
    fn parts(&self) -> impl Iterator<Item = ((f64, f64), f64)> {
        let ends = PARTS_OF_MOTION.windows(2).map(|ends| (ends[0], ends[1]));
        ends.zip(self.parts)
    }

    /// How many times the density of the reference the band of motion has, and the power that it has beyond, where that is enough. Noise that is
    /// correlated over some ten milliseconds falls from the band of motion on, and is flat in it: so the least part of it is a reference, too.
    fn beyond_reference(&self) -> (f64, f64) {
        let least = self.parts.into_iter().fold(f64::INFINITY, f64::min);
        let reference = self.reference.max(least);
        let ratio = self.motion / reference.max(f64::MIN_POSITIVE);
        let above = if ratio > LEAST_RATIO {
            (self.motion - reference) * (MOTION_BAND.1 - MOTION_BAND.0)
        } else {
            0.0
        };
        (ratio, above)
    }

    /// Power in the band of motion that noise with what is seen above it cannot have.
    ///
    /// The density of noise of first order falls with the frequency by `1 / f^2` at most, whose mean from `a` to `b` is `1 / (a b)`. So the one
    /// that is seen from `c` to `d` comes with at most `c d / (a b)` times as much in a part of the band of motion. Noise behind a steeper filter
    /// has more there, but does not rise with the frequency.
    fn beyond_noise(&self) -> f64 {
        let product = |(low, high): (f64, f64)| low * high;
        let falls = product(BAND_ABOVE) / product(REFERENCE_BAND);
        let mut least = f64::INFINITY;
        let rises = self.parts.into_iter().any(|density| {
            let rises = density > RISES * least;
            least = least.min(density);
            rises
        });
        if !rises || self.reference > STEEPEST * falls * self.above {
            return 0.0;
        }
        let beyond = self.parts().map(|(ends, density)| {
            let noise = self.reference * product(REFERENCE_BAND) / product(ends);
            if density > LEAST_RATIO * noise {
                (density - noise) * (ends.1 - ends.0)
            } else {
                0.0
            }
        });
        beyond.sum()
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::{LEAST_RATIO, RawResidual, Spectrum, Structure, of};

    use crate::signal::LowPass;

    const HZ: f64 = 500.0;

    /// Noise that is correlated over so long, s.
    fn noise(correlated_s: f64) -> Vec<f64> {
        let kept = (-1.0 / (HZ * correlated_s)).exp();
        let mut value = 0.0;
        let noise = (0..30_000_u32).map(|k| {
            let random = (12.9898 * (f64::from(k) + 1.0)).sin() * 43_758.545_3;
            value = kept * value + random.rem_euclid(1.0) - 0.5;
            value
        });
        noise.collect()
    }

    fn residual(values: &[f64]) -> RawResidual<'_> {
        RawResidual {
            values,
            beyond: 0.0,
            filtered: values.to_vec(),
            filtered_hz: HZ,
            rate_hz: HZ,
            shared_hz: 10.0,
            period: None,
            stepped: 0.0,
            encoder: 0.0,
        }
    }

    fn structure(values: &[f64]) -> Structure {
        of(&[residual(values)])
    }

    /// What is a level stays one where less of it counts, and what is none does not become one.
    #[test]
    fn a_limit_of_structure_leaves_what_it_is() {
        for (stepped, is_of_level) in [(0.9, true), (0.3, false)] {
            let mut structure = Structure {
                power: 1.0,
                share: 0.8,
                ratio: 2.0,
                stepped,
            };
            for most in [2.0, 0.25] {
                structure.limit(most);
                assert_eq!(structure.is_of_level(), is_of_level);
            }
            assert!((structure.share - 0.2).abs() < 1e-12);
        }
    }

    fn with(values: &[f64], law: impl Fn(f64) -> f64) -> Vec<f64> {
        let values = values.iter().enumerate();
        values.map(|(k, v)| v + law(k as f64 / HZ)).collect()
    }

    /// Noise that is correlated over 20 ms falls by more than the least ratio from the band of motion to that above it, and follows nothing.
    #[test]
    fn noise_of_some_milliseconds_is_no_structure_and_a_wave_in_it_is() {
        let noise = noise(0.02);
        let spectrum = Spectrum::of(&residual(&noise));
        assert!(spectrum.motion > LEAST_RATIO * spectrum.reference);
        assert!(!structure(&noise).is_material(), "{:?}", structure(&noise));
        let wave = with(&noise, |t| 1.2 * (TAU * 1.3 * t).sin());
        assert!(structure(&wave).is_material(), "{:?}", structure(&wave));
    }

    /// A torque that rings at 4 Hz every 2.3 s has some power wherever robots move, as slow noise has, and none above.
    #[test]
    fn a_torque_that_rings_is_structure_and_slow_noise_is_none() {
        for correlated_s in [1e-3, 0.005, 0.02, 0.05, 0.1] {
            let noise = noise(correlated_s);
            let found = structure(&noise);
            assert!(!found.is_material(), "{correlated_s} s: {found:?}");
        }
        let noise = noise(0.005);
        let rings = |t: f64| {
            let since = t.rem_euclid(2.3);
            6.0 * (-since / 0.4).exp() * (TAU * 4.0 * since).sin()
        };
        let found = structure(&with(&noise, rings));
        assert!(
            found.is_material() && found.ratio < LEAST_RATIO,
            "{found:?}"
        );
    }

    /// What a log went through before it was written falls as steeply, and is no structure; nor is it where its torques were rounded, too, and
    /// are as flat above the band as noise that is not filtered.
    #[test]
    fn noise_behind_a_filter_is_no_structure() {
        for (order, cutoff_hz) in [(2, 6.0), (2, 8.0), (4, 6.0), (4, 8.0)] {
            let filter = LowPass::butterworth(order, cutoff_hz, HZ).expect("a filter");
            let mut values = Vec::new();
            filter.apply(&noise(1e-3), &mut values);
            let power = values.iter().map(|v| v * v).sum::<f64>();
            let rms = (power / values.len() as f64).sqrt();
            for of_rms in [0.0, 0.1, 0.3, 0.6] {
                let step = of_rms * rms;
                let round = |v: &f64| {
                    if step > 0.0 {
                        (v / step).round() * step
                    } else {
                        *v
                    }
                };
                for count in [6000, 30_000] {
                    let values: Vec<f64> = values.iter().take(count).map(round).collect();
                    let found = structure(&values);
                    let what = format!("{cutoff_hz} Hz, order {order}, {of_rms}, {count}");
                    assert!(!found.is_material(), "{what}: {found:?}");
                }
            }
        }
    }

    /// What rises with the frequency counts where noise above is seen to be no steeper than first order, and not behind a filter.
    #[test]
    fn what_rings_is_told_beside_noise_that_is_no_steeper_than_first_order() {
        let beyond = |parts: [f64; 4], above: f64| {
            let spectrum = Spectrum {
                motion: 1.0,
                parts,
                reference: 0.01,
                above,
            };
            spectrum.beyond_noise()
        };
        // Less noise of first order, 0.01 (1.2 x 2.5) / (0.38 x 0.8), in a part that is 0.42 wide; the others have no more than noise may have.
        let rings = [0.1, 0.1, 0.1, 2.0];
        let wanted = (2.0 - 0.03 / 0.304) * 0.42;
        assert!((beyond(rings, 0.003) - wanted).abs() < 1e-12);
        assert!(beyond(rings, 1e-4).abs() <= 0.0);
        assert!(beyond([2.0; 4], 0.003).abs() <= 0.0);
    }
}
