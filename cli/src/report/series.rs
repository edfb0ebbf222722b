//! What is drawn of a model on a log.

use std::ops::Range;

use robot_model::columns::Arm;
use robot_model::identify::{Estimate, judged_samples};
use robot_model::log::Log;
use robot_model::signal::{SEGMENT_S, band_density, prepare};

use robot_model_spec::Model;

use super::chart::{Chart, Ink, Series};
use crate::Error;
use crate::units::Units;

/// Most dots of a color in a drawing, and most points of a line, two for each place.
const DOTS: usize = 400;
const PLACES: usize = 500;

/// Of a log that is longer, torques are drawn for so long, s: strokes of a minute are a comb on a page.
const LONGEST_S: f64 = 20.0;
pub(crate) const WINDOW_S: f64 = 10.0;

/// Bands of a spectrum, from here on to two fifths of the rate.
const LOWEST_HZ: f64 = 0.25;
const BANDS: usize = 60;

/// A model with a name, and the color that its errors have.
pub(crate) struct Shown<'a> {
    pub(crate) color: Ink,
    pub(crate) arm: &'a dyn Arm,
    pub(crate) estimate: &'a Estimate,
}

/// Errors of models on one log, `[model][joint][sample]`, and what they are drawn over.
pub(crate) struct Drawn {
    time: Vec<f64>,
    rate_hz: f64,
    measured: Vec<Vec<f64>>,
    models: Vec<OfModel>,
    /// Position, velocity and load of the joints at the rows, by the last model.
    position: Vec<Vec<f64>>,
    velocity: Vec<Vec<f64>>,
    load: Vec<Vec<f64>>,
    row_time: Vec<f64>,
    units: Vec<Units>,
}

struct OfModel {
    color: Ink,
    predicted: Vec<Vec<f64>>,
    /// In the band of the fit, `[joint][row]`.
    filtered: Vec<Vec<f64>>,
}

impl Drawn {
    /// Models on a log of an arm. Rows are those of the first model's filters.
    pub(crate) fn new(arm: &Model, models: &[Shown], log: &Log) -> Result<Self, Error> {
        let (first, last) = (&models[0], &models[models.len() - 1]);
        let bands = first.estimate.bands.at_rate(log.rate_hz());
        let prepared = prepare(log, &bands).map_err(robot_model::identify::IdentifyError::from)?;
        let samples = prepared.motion.time.len();
        let kept: Vec<usize> = prepared.shared.kept(samples).collect();
        let pick = |values: &Vec<f64>| kept.iter().map(|&k| values[k]).collect::<Vec<f64>>();
        let gain = first.arm.actuator_gain();
        let scaled = log.tau.iter().zip(gain);
        let measured: Vec<Vec<f64>> = scaled
            .map(|(tau, gain)| tau.iter().map(|tau| gain * tau).collect())
            .collect();
        let of_model = |shown: &Shown| -> Result<OfModel, Error> {
            let predicted = shown.estimate.predict(shown.arm, log)?;
            let joints = measured.iter().zip(&predicted);
            let filtered = joints.map(|(measured, predicted)| {
                let at = |k: usize| k * prepared.stride;
                let rest: Vec<f64> = (0..samples)
                    .map(|k| measured[at(k)] - predicted[at(k)])
                    .collect();
                let mut out = Vec::new();
                prepared.shared.apply(&rest, &mut out);
                out
            });
            Ok(OfModel {
                color: shown.color,
                filtered: filtered.collect(),
                predicted,
            })
        };
        let models_drawn = models.iter().map(of_model).collect::<Result<Vec<_>, _>>()?;
        let values = last.estimate.values();
        let shapes: Vec<f64> = last
            .estimate
            .shapes
            .iter()
            .map(|(_, value)| *value)
            .collect();
        let load = last.arm.rigid_torque(&prepared.motion, &shapes, &values);
        let units = arm.joints.iter().map(|joint| Units::of(joint.kind));
        Ok(Self {
            units: units.collect(),
            rate_hz: log.rate_hz(),
            time: log.time.clone(),
            models: models_drawn,
            position: prepared.motion.wide.q.iter().map(pick).collect(),
            velocity: prepared.motion.wide.dq.iter().map(pick).collect(),
            load: load.iter().map(pick).collect(),
            row_time: pick(&prepared.motion.time),
            measured,
        })
    }

    /// Measured torque and that of the last model over time, and errors of all models over velocity, position, load, time and frequency.
    pub(crate) fn of_joint(&self, joint: usize, name: &str) -> Vec<String> {
        let mut all = vec![self.torque(joint, name)];
        all.extend(self.errors(joint, name));
        all
    }

    fn torque(&self, joint: usize, name: &str) -> String {
        let line = |color, time: &[f64], values: &[f64]| Series {
            color,
            is_line: true,
            points: envelope(time, values),
        };
        let last = &self.models[self.models.len() - 1];
        // Filters swing at both ends, which no error counts.
        let counts = judged_samples(self.time.len(), self.rate_hz);
        let [measured, predicted] = if self.is_long() {
            let rest = self.measured[joint].iter().zip(&last.predicted[joint]);
            let rest: Vec<f64> = rest
                .map(|(measured, predicted)| measured - predicted)
                .collect();
            let end = self.time[0] + WINDOW_S;
            let samples = self.time.partition_point(|time| *time < end);
            let window = worst(&rest, counts, samples);
            [window.clone(), window]
        } else {
            [0..self.time.len(), counts]
        };
        Chart {
            label: &format!("measured and predicted torque of {name} over time"),
            letter: Some('a'),
            x: "time, s",
            y: &format!("torque, {}", self.units[joint].torque),
            is_logarithmic: false,
            series: vec![
                line(
                    Ink::Measured,
                    &self.time[measured.clone()],
                    &self.measured[joint][measured],
                ),
                line(
                    last.color,
                    &self.time[predicted.clone()],
                    &last.predicted[joint][predicted],
                ),
            ],
        }
        .svg()
    }

    /// Whether torques are drawn of the seconds with the largest residual only.
    pub(crate) fn is_long(&self) -> bool {
        judged_samples(self.time.len(), self.rate_hz).len() as f64 > LONGEST_S * self.rate_hz
    }

    fn errors(&self, joint: usize, name: &str) -> Vec<String> {
        let Units {
            position,
            velocity,
            torque,
        } = self.units[joint];
        let over = |letter: char, what: &str, unit: &str, of: &[f64]| {
            let dots = |model: &OfModel| {
                let values = &model.filtered[joint];
                let step = of.len().div_ceil(DOTS).max(1);
                Series {
                    color: model.color,
                    is_line: false,
                    points: (0..of.len().min(values.len()))
                        .step_by(step)
                        .map(|k| (of[k], values[k]))
                        .collect(),
                }
            };
            Chart {
                label: &format!("residual torque of {name} over {what}"),
                letter: Some(letter),
                x: &format!("{what}, {unit}"),
                y: &format!("residual, {torque}"),
                is_logarithmic: false,
                series: self.models.iter().map(dots).collect(),
            }
            .svg()
        };
        vec![
            over('b', "velocity", velocity, &self.velocity[joint]),
            over('c', "position", position, &self.position[joint]),
            over('d', "load of the rigid body", torque, &self.load[joint]),
            over('e', "time", "s", &self.row_time),
            self.spectrum(joint, name),
        ]
    }

    fn spectrum(&self, joint: usize, name: &str) -> String {
        let edges = edges(0.4 * self.rate_hz);
        let line = |model: &OfModel| {
            let rest = self.measured[joint].iter().zip(&model.predicted[joint]);
            let rest: Vec<f64> = rest
                .map(|(measured, predicted)| measured - predicted)
                .collect();
            let density = band_density(&rest, self.rate_hz, &edges);
            let points = density
                .iter()
                .enumerate()
                .filter(|(_, power)| **power > 0.0);
            Series {
                color: model.color,
                is_line: true,
                points: points
                    .map(|(k, power)| ((edges[k] * edges[k + 1]).sqrt(), power.sqrt()))
                    .collect(),
            }
        };
        Chart {
            label: &format!("spectrum of the residual torque of {name}"),
            letter: Some('f'),
            x: "frequency, Hz",
            y: &format!("residual, {}/\u{221a}Hz", self.units[joint].torque),
            is_logarithmic: true,
            series: self.models.iter().map(line).collect(),
        }
        .svg()
    }
}

/// Ends of the bands of a spectrum up to a frequency, Hz. One narrower than the resolution would have what its neighbor has.
fn edges(highest: f64) -> Vec<f64> {
    let wider = (highest / LOWEST_HZ).powf(1.0 / BANDS as f64);
    let next = |edge: &f64| Some((edge * wider).max(edge + 1.0 / SEGMENT_S));
    let edges = std::iter::successors(Some(LOWEST_HZ), next);
    // A little beyond: the last one of a product of factors.
    edges
        .take_while(|edge| *edge <= highest * (1.0 + 1e-9))
        .collect()
}

/// So many samples among those that count in which a residual has the largest mean square.
fn worst(residual: &[f64], counts: Range<usize>, samples: usize) -> Range<usize> {
    let squares = |range: Range<usize>| residual[range].iter().map(|r| r * r).sum::<f64>();
    let mut from = counts.start;
    let mut sum = squares(from..from + samples);
    let mut most = (sum, from);
    while from + samples < counts.end {
        sum += residual[from + samples].powi(2) - residual[from].powi(2);
        from += 1;
        if sum > most.0 {
            most = (sum, from);
        }
    }
    most.1..most.1 + samples
}

/// A long line by the least and the largest value in each of some places.
fn envelope(time: &[f64], values: &[f64]) -> Vec<(f64, f64)> {
    let count = time.len().min(values.len());
    let each = count.div_ceil(PLACES).max(1);
    if each < 3 {
        return (0..count).map(|k| (time[k], values[k])).collect();
    }
    let place = |start: usize| {
        let range = start..(start + each).min(count);
        let least = range
            .clone()
            .min_by(|a, b| values[*a].total_cmp(&values[*b]));
        let most = range.max_by(|a, b| values[*a].total_cmp(&values[*b]));
        let (first, second) = (least.unwrap_or(start), most.unwrap_or(start));
        let (first, second) = (first.min(second), first.max(second));
        [(time[first], values[first]), (time[second], values[second])]
    };
    (0..count).step_by(each).flat_map(place).collect()
}

#[cfg(test)]
mod tests {
    use super::{LOWEST_HZ, SEGMENT_S, edges, envelope, worst};

    #[test]
    fn the_window_of_a_long_log_is_that_of_the_largest_residual() {
        let mut residual = vec![1.0; 100];
        residual[60..70].fill(3.0);
        assert_eq!(worst(&residual, 10..90, 10), 60..70);
        // What does not count is not drawn.
        residual[..10].fill(9.0);
        residual[90..].fill(-9.0);
        assert_eq!(worst(&residual, 10..90, 10), 60..70);
        assert_eq!(worst(&residual, 0..100, 10), 0..10);
        assert_eq!(worst(&residual, 10..90, 80), 10..90);
    }

    #[test]
    fn bands_are_resolved_and_reach_to_the_highest() {
        for highest in [20.0, 80.0, 400.0] {
            let edges = edges(highest);
            let mut pairs = edges.windows(2);
            assert!(pairs.all(|pair| pair[1] - pair[0] > 0.999 / SEGMENT_S));
            let last = edges[edges.len() - 1];
            assert!(edges[0] <= LOWEST_HZ && last > 0.8 * highest && last < 1.001 * highest);
        }
    }

    #[test]
    fn a_long_line_keeps_its_peaks() {
        let time: Vec<f64> = (0..100_000).map(f64::from).collect();
        let mut values = vec![0.0; 100_000];
        (values[31_415], values[92_653]) = (7.0, -5.0);
        let points = envelope(&time, &values);
        assert!(points.len() <= 1000);
        assert!(points.contains(&(31_415.0, 7.0)) && points.contains(&(92_653.0, -5.0)));
        assert!(points.windows(2).all(|pair| pair[0].0 <= pair[1].0));
    }
}
