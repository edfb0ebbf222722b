//! What a motion may not exceed.

use std::f64::consts::PI;

use super::ExciteError;

/// Limits of each joint, SI units; infinite where there is none.
#[derive(Debug, Clone, PartialEq)]
pub struct Limits {
    /// Lowest and highest position, rad or m.
    pub position: Vec<(f64, f64)>,
    /// Largest velocity, either way.
    pub velocity: Vec<f64>,
    /// Largest acceleration, either way.
    pub acceleration: Vec<f64>,
    /// Largest torque, either way, N m or N.
    pub torque: Vec<f64>,
}

impl Limits {
    /// No limit at all.
    ///
    /// # Examples
    /// ```
    /// use robot_model::excite::Limits;
    /// // Two joints, of which the second may go from -1 to 2 rad.
    /// let mut limits = Limits::none(2);
    /// limits.position[1] = (-1.0, 2.0);
    /// assert!(limits.position[0].1.is_infinite() && limits.velocity[1].is_infinite());
    /// ```
    #[must_use]
    pub fn none(dof: usize) -> Self {
        Self {
            position: vec![(f64::NEG_INFINITY, f64::INFINITY); dof],
            velocity: vec![f64::INFINITY; dof],
            acceleration: vec![f64::INFINITY; dof],
            torque: vec![f64::INFINITY; dof],
        }
    }

    /// Whether something has a limit that keeps every motion finite, and each limit leaves room.
    pub(super) fn check(&self, joints: &[String]) -> Result<(), ExciteError> {
        for (j, name) in joints.iter().enumerate() {
            let (low, high) = self.position[j];
            if low.is_nan() || high.is_nan() || low >= high {
                return Err(ExciteError::NoRange {
                    joint: name.clone(),
                    low,
                    high,
                });
            }
            let both_ways = [
                ("velocity", self.velocity[j]),
                ("acceleration", self.acceleration[j]),
                ("torque", self.torque[j]),
            ];
            for (what, limit) in both_ways {
                if limit.is_nan() || limit <= 0.0 {
                    return Err(ExciteError::NoRoom {
                        joint: name.clone(),
                        what,
                        limit,
                    });
                }
            }
            if self.velocity[j].is_infinite() {
                return Err(ExciteError::Unlimited {
                    joint: name.clone(),
                });
            }
        }
        Ok(())
    }

    /// Middle and half width of what `q` may be.
    pub(super) fn range(&self, joint: usize) -> (f64, f64) {
        match self.position[joint] {
            (low, high) if low.is_finite() && high.is_finite() => {
                (f64::midpoint(low, high), 0.5 * (high - low))
            }
            // A joint that turns without end is designed for one turn.
            (low, _) if low.is_finite() => (low + PI, PI),
            (_, high) if high.is_finite() => (high - PI, PI),
            _ => (0.0, PI),
        }
    }
}

/// What of a limit is used on a grid of `samples` instants a period, so that a wave of `harmonics` harmonics keeps the limit at all
/// times: between the instants it is at most `1 / cos(pi harmonics / samples)` times as far from any constant as at one of them.
///
/// Source: Ehlich & Zeller 1964.
pub(super) fn share(harmonics: usize, samples: usize) -> f64 {
    (PI * harmonics as f64 / samples as f64).cos()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A wave that peaks between the instants of the grid.
    #[test]
    fn what_is_kept_on_the_grid_is_kept_between() {
        let (harmonics, samples) = (5, 40);
        let phase = PI * harmonics as f64 / samples as f64;
        let wave = |t: f64| (2.0 * PI * harmonics as f64 * t - phase).cos();
        let on_grid = (0..samples).map(|k| wave(k as f64 / samples as f64).abs());
        let on_grid = on_grid.fold(0.0, f64::max);
        assert!(
            (on_grid - share(harmonics, samples)).abs() < 1e-12,
            "{on_grid}"
        );
        let limits = Limits::none(1);
        assert!(matches!(
            limits.check(&["elbow".to_owned()]),
            Err(ExciteError::Unlimited { .. })
        ));
    }
}
