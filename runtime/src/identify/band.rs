//! The band that torque and columns share: as wide as the model's torque stands out.

use crate::columns::Arm;
use crate::log::Log;
use crate::signal::resample::whole_steps;
use crate::signal::{Bands, Prepared, band_density};

use super::stack::whole_torque;
use super::{Identify, IdentifyError, check_logs, left_out, prepare_all, shapes, slowest_bands};

/// The model's torque counts as seen where its power is at least this many times that of what it leaves.
const LEAST_RATIO: f64 = 2.0;

/// Narrowest and widest shared band, Hz.
const NARROWEST_HZ: f64 = 10.0;
const WIDEST_HZ: f64 = 50.0;

/// The motion's filters relative to the shared one, at least.
const SMOOTH_RATIO: f64 = 1.25;
const WIDE_RATIO: f64 = 2.0;

/// Width of the bands in which powers are compared, Hz.
const STEP_HZ: f64 = 3.0;

impl Identify {
    /// A first estimate over a wide band shows how far the model's torque reaches.
    pub(super) fn choose_bands(&self, arm: &dyn Arm, logs: &[Log]) -> Result<Bands, IdentifyError> {
        let mut bands = slowest_bands(logs);
        bands.smooth_hz = bands.wide_hz;
        let mut prepared = prepare_all(logs, &bands)?;
        let (solution, shapes, _) = self.solve(arm, &mut prepared, Some(shapes::middle(arm)))?;
        Ok(choose(arm, &prepared, &shapes, &solution.estimate))
    }

    /// The bands of a first log, chosen as for a fit.
    ///
    /// # Errors
    /// Those of [`Self::fit`].
    ///
    /// # Examples
    /// ```
    /// # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); }
    /// let log = pendulum::measure(0.0);
    /// let bands = robot_model::identify::Identify::default().bands_of(&pendulum::pendulum(), &log)?;
    /// assert!(bands.smooth_hz > 0.9 && bands.smooth_hz <= bands.wide_hz); // its fastest wave is of 0.9 Hz
    /// # Ok::<(), robot_model::identify::IdentifyError>(())
    /// ```
    pub fn bands_of(&self, arm: &dyn Arm, log: &Log) -> Result<Bands, IdentifyError> {
        let logs = std::slice::from_ref(log);
        check_logs(arm, logs)?;
        self.bands.map_or_else(|| self.choose_bands(arm, logs), Ok)
    }
}

/// Chooses the shared band from a first estimate.
///
/// Least squares gains from every frequency at which the model's torque is larger than noise and model error, and loses at
/// every other. The band ends at the first 3 Hz in which the power of the modeled torque falls below twice that of the
/// residual, on the joint where that is first, and lies within 10 Hz .. 50 Hz and below a tenth of the sample rate. The
/// motion's own filters stay wider: the smooth one a little, as every hertz of it adds noise to accelerations. Of arms whose links
/// [follow the load](Arm::follows_load) they are those of the rate alone.
pub(super) fn choose(arm: &dyn Arm, logs: &[Prepared], shapes: &[f64], estimate: &[f64]) -> Bands {
    let rate_hz = logs
        .iter()
        .map(|log| log.rate_hz)
        .fold(f64::INFINITY, f64::min);
    let base = Bands::for_rate(rate_hz);
    if arm.follows_load() {
        return base;
    }
    let highest = WIDEST_HZ.min(0.1 * rate_hz);
    let count = ((highest - 2.0) / STEP_HZ).max(1.0).ceil();
    let edges: Vec<f64> = (0..=whole_steps(count))
        .map(|k| 2.0 + STEP_HZ * k as f64)
        .collect();
    let mut modeled = vec![vec![0.0; edges.len() - 1]; arm.dof()];
    let mut left = modeled.clone();
    for log in logs {
        let torque = whole_torque(arm, &log.motion, shapes, estimate);
        for (joint, total) in torque.iter().enumerate() {
            let mut rest: Vec<f64> = log.tau[joint]
                .iter()
                .zip(total)
                .map(|(tau, t)| arm.actuator_gain()[joint] * tau - t)
                .collect();
            if left_out::samples(arm, log, joint)
                .iter()
                .all(|is_out| *is_out)
            {
                continue;
            }
            if !arm.saturated_joints().contains(&joint) {
                // What a limit took is no noise.
                let clipped = log.is_clipped(joint, 0).into_iter();
                for (rest, _) in rest.iter_mut().zip(clipped).filter(|(_, is)| *is) {
                    *rest = 0.0;
                }
            }
            for (sum, power) in
                modeled[joint]
                    .iter_mut()
                    .zip(band_density(total, log.rate_hz, &edges))
            {
                *sum += power;
            }
            for (sum, power) in left[joint]
                .iter_mut()
                .zip(band_density(&rest, log.rate_hz, &edges))
            {
                *sum += power;
            }
        }
    }
    let ends = modeled.iter().zip(&left).map(|(modeled, left)| {
        let lost = modeled
            .iter()
            .zip(left)
            .position(|(m, l)| *m < LEAST_RATIO * l);
        lost.map_or(highest, |k| edges[k])
    });
    let shared_hz = ends
        .fold(highest, f64::min)
        .max(NARROWEST_HZ.min(base.shared_hz));
    Bands {
        shared_hz,
        smooth_hz: base.smooth_hz.max(SMOOTH_RATIO * shared_hz),
        wide_hz: base.wide_hz.max(WIDE_RATIO * shared_hz),
    }
}
