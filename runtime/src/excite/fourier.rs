//! Periodic motions: a mean and some harmonics a joint.

use std::f64::consts::TAU;

use crate::motion::Kinematics;

/// A periodic motion of every joint,
/// `q(t) = q0 + sum_l a_l / (w l) sin(w l t) - b_l / (w l) cos(w l t)`, `w = 2 pi / period`.
///
/// So `dq = sum a_l cos(w l t) + b_l sin(w l t)`: coefficients are velocities. Source: Swevers et al. 1997.
///
/// # Examples
/// ```
/// use robot_model::excite::Fourier;
///
/// // One harmonic of 2 s about 0.3 rad: q = 0.3 + 0.5 / pi sin(pi t).
/// let motion = Fourier { period: 2.0, coefficients: vec![vec![0.3, 0.5, 0.0]] };
/// let [q, dq, ddq] = motion.at(0, 0.5);
/// assert!((q - 0.3 - 0.5 / std::f64::consts::PI).abs() < 1e-12);
/// assert!(dq.abs() < 1e-12 && (ddq + 0.5 * std::f64::consts::PI).abs() < 1e-12);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Fourier {
    /// Time after which the motion repeats, s.
    pub period: f64,
    /// A joint's `q0, a_1 .. a_N, b_1 .. b_N`: rad (m), then rad/s (m/s).
    pub coefficients: Vec<Vec<f64>>,
}

impl Fourier {
    /// Position, velocity and acceleration of a joint, from 0, at a time in s.
    ///
    /// # Examples
    /// ```
    /// use robot_model::excite::Fourier;
    /// // One harmonic of 2 s: dq = 0.5 cos(pi t).
    /// let motion = Fourier { period: 2.0, coefficients: vec![vec![0.3, 0.5, 0.0]] };
    /// let [q, dq, ddq] = motion.at(0, 1.0);
    /// assert!((q - 0.3).abs() < 1e-12 && (dq + 0.5).abs() < 1e-12 && ddq.abs() < 1e-12);
    /// ```
    #[must_use]
    pub fn at(&self, joint: usize, time: f64) -> [f64; 3] {
        let coefficients = &self.coefficients[joint];
        basis(coefficients.len() / 2, self.period, time).map(|row| dot(&row, coefficients))
    }

    /// The motion at each of these times.
    ///
    /// # Examples
    /// ```
    /// use robot_model::excite::Fourier;
    /// // q = 0.3 + 0.5 / pi sin(pi t)
    /// let motion = Fourier { period: 2.0, coefficients: vec![vec![0.3, 0.5, 0.0]] };
    /// let along = motion.motion(&[0.0, 1.0, 2.0]);
    /// assert!((along.q[0][0] - along.q[0][2]).abs() < 1e-12); // it repeats
    /// assert!((along.dq[0][0] - 0.5).abs() < 1e-12 && (along.dq[0][1] + 0.5).abs() < 1e-12);
    /// ```
    #[must_use]
    pub fn motion(&self, time: &[f64]) -> Kinematics {
        let rows: Vec<[Vec<f64>; 3]> = time
            .iter()
            .map(|&t| basis(self.harmonics(), self.period, t))
            .collect();
        let [q, dq, ddq] = std::array::from_fn(|order| {
            let joints = self.coefficients.iter();
            joints
                .map(|joint| rows.iter().map(|row| dot(&row[order], joint)).collect())
                .collect()
        });
        Kinematics { q, dq, ddq }
    }

    /// Number of harmonics.
    ///
    /// # Examples
    /// ```
    /// use robot_model::excite::Fourier;
    /// // q0, a_1, a_2, b_1, b_2
    /// let motion = Fourier { period: 2.0, coefficients: vec![vec![0.0, 0.5, 0.1, 0.0, 0.0]] };
    /// assert_eq!(motion.harmonics(), 2);
    /// ```
    #[must_use]
    pub fn harmonics(&self) -> usize {
        self.coefficients.first().map_or(0, |joint| joint.len() / 2)
    }

    /// `count` instants of one period, in the middle of as many equal parts.
    ///
    /// # Examples
    /// ```
    /// use robot_model::excite::Fourier;
    /// let motion = Fourier { period: 2.0, coefficients: vec![vec![0.0, 0.5, 0.1, 0.0, 0.0]] };
    /// assert_eq!(motion.harmonics(), 2);
    /// assert_eq!(motion.instants(4), [0.25, 0.75, 1.25, 1.75]);
    /// ```
    #[must_use]
    pub fn instants(&self, count: usize) -> Vec<f64> {
        instants(self.period, count)
    }
}

/// `count` instants of one period, in the middle of as many equal parts: none is the one at which the motion begins at rest, where
/// friction is what its law says of standing still.
pub(super) fn instants(period: f64, count: usize) -> Vec<f64> {
    (0..count)
        .map(|k| period * (k as f64 + 0.5) / count as f64)
        .collect()
}

/// What `q0, a_1 .. a_N, b_1 .. b_N` are multiplied by in `q`, `dq` and `ddq` at a time.
pub(super) fn basis(harmonics: usize, period: f64, time: f64) -> [Vec<f64>; 3] {
    let mut rows = [vec![1.0], vec![0.0], vec![0.0]];
    let waves = |f: &dyn Fn(f64, f64, f64) -> f64| -> Vec<f64> {
        (1..=harmonics)
            .map(|l| {
                let w = TAU * l as f64 / period;
                let (sin, cos) = (w * time).sin_cos();
                f(w, sin, cos)
            })
            .collect()
    };
    rows[0].extend(waves(&|w, sin, _| sin / w));
    rows[0].extend(waves(&|w, _, cos| -cos / w));
    rows[1].extend(waves(&|_, _, cos| cos));
    rows[1].extend(waves(&|_, sin, _| sin));
    rows[2].extend(waves(&|w, sin, _| -w * sin));
    rows[2].extend(waves(&|w, _, cos| w * cos));
    rows
}

fn dot(x: &[f64], y: &[f64]) -> f64 {
    x.iter().zip(y).map(|(x, y)| x * y).sum()
}

/// How a motion begins and, as it is periodic, ends.
#[derive(Debug, Clone, PartialEq, Default)]
#[non_exhaustive]
pub enum Ends {
    /// Wherever and however fast it is there.
    Free,
    /// With no velocity and no acceleration.
    #[default]
    AtRest,
    /// With no velocity and no acceleration, at this position, rad or m.
    At(Vec<f64>),
}

/// Coefficients of a joint that begin as they should, by free variables `z`: `coefficients = offset + map * z`.
///
/// Of `dq(0) = sum a_l = 0` and `ddq(0) = w sum l b_l = 0` the last `a` and `b` follow, of `q(0) = q0 - sum b_l / (w l)` the
/// mean; what is left is free.
#[derive(Debug, Clone)]
pub(super) struct Freedom {
    /// `[coefficient][variable]`
    pub map: Vec<Vec<f64>>,
    pub offset: Vec<f64>,
}

impl Freedom {
    pub(super) fn new(harmonics: usize, period: f64, ends: &Ends, joint: usize) -> Self {
        let coefficients = 1 + 2 * harmonics;
        let (a, b) = (1, 1 + harmonics);
        let last = harmonics - 1;
        let mut offset = vec![0.0; coefficients];
        // The coefficients that are variables themselves.
        let free: Vec<usize> = match ends {
            Ends::Free => (0..coefficients).collect(),
            Ends::AtRest => (0..a + last).chain(b..b + last).collect(),
            Ends::At(_) => (a..a + last).chain(b..b + last).collect(),
        };
        let mut map = vec![vec![0.0; free.len()]; coefficients];
        for (variable, &coefficient) in free.iter().enumerate() {
            map[coefficient][variable] = 1.0;
        }
        if *ends != Ends::Free {
            for variable in 0..free.len() {
                map[a + last][variable] = -(0..last).map(|l| map[a + l][variable]).sum::<f64>();
                map[b + last][variable] = -(0..last)
                    .map(|l| (l + 1) as f64 * map[b + l][variable])
                    .sum::<f64>()
                    / harmonics as f64;
            }
        }
        if let Ends::At(position) = ends {
            offset[0] = position[joint];
            for variable in 0..free.len() {
                map[0][variable] = (0..harmonics)
                    .map(|l| map[b + l][variable] * period / (TAU * (l + 1) as f64))
                    .sum();
            }
        }
        Self { map, offset }
    }

    /// Number of variables.
    pub(super) fn len(&self) -> usize {
        self.map[0].len()
    }

    /// Coefficients of these variables.
    pub(super) fn coefficients(&self, z: &[f64]) -> Vec<f64> {
        let rows = self.map.iter().zip(&self.offset);
        rows.map(|(row, offset)| offset + dot(row, z)).collect()
    }

    /// What the variables are multiplied by where the coefficients are multiplied by `row`.
    pub(super) fn of_variables(&self, row: &[f64]) -> Vec<f64> {
        (0..self.len())
            .map(|k| row.iter().zip(&self.map).map(|(x, map)| x * map[k]).sum())
            .collect()
    }

    /// What is added where the coefficients are multiplied by `row`.
    pub(super) fn constant(&self, row: &[f64]) -> f64 {
        dot(row, &self.offset)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn derivatives_are_those_of_the_position() {
        let motion = Fourier {
            period: 10.0,
            coefficients: vec![vec![0.2, 0.4, -0.3, 0.7, 0.1, -0.5, 0.6]],
        };
        let h = 1e-4;
        for k in 0..40 {
            let t = 0.37 * f64::from(k);
            let [before, now, after] = [t - h, t, t + h].map(|t| motion.at(0, t));
            assert!(((after[0] - before[0]) / (2.0 * h) - now[1]).abs() < 1e-7);
            assert!(((after[1] - before[1]) / (2.0 * h) - now[2]).abs() < 1e-7);
        }
    }

    #[test]
    fn ends_are_as_wished_whatever_the_variables() {
        let ends = [Ends::AtRest, Ends::At(vec![0.0, -1.2])];
        for (ends, free) in ends.iter().zip([9, 8]) {
            let freedom = Freedom::new(5, 20.0, ends, 1);
            assert_eq!(freedom.len(), free, "{ends:?}");
            let z: Vec<f64> = (0..free).map(|k| (1.7 * k as f64).sin()).collect();
            let motion = Fourier {
                period: 20.0,
                coefficients: vec![freedom.coefficients(&z)],
            };
            for t in [0.0, 20.0] {
                let [q, dq, ddq] = motion.at(0, t);
                assert!(dq.abs() < 1e-13 && ddq.abs() < 1e-13, "{dq} {ddq}");
                if let Ends::At(position) = ends {
                    assert!((q - position[1]).abs() < 1e-13, "{q}");
                }
            }
        }
        assert_eq!(Freedom::new(5, 20.0, &Ends::Free, 0).len(), 11);
    }
}
