//! Columns over motions: filtered as the torque of logs is, or summed to a torque.

use super::subtract;
use crate::columns::{Arm, Columns, Entry, Unknown};
use crate::motion::Motion;
use crate::signal::Prepared;

/// An unknown of a column that is asked for and forgotten: nobody reads its name.
pub(in crate::identify) fn nameless() -> Unknown {
    Unknown {
        name: String::new(),
        nonnegative: false,
    }
}

/// Columns over several logs, each log through its own shared filter, the logs' samples one after the other.
///
/// # Examples
/// ```
/// # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); }
/// # use pendulum::{measure, pendulum};
/// # use robot_model::{identify::filtered_columns, signal::{Bands, prepare}};
/// let log = measure(0.0);
/// let prepared = prepare(&log, &Bands::for_log(&log))?;
/// let columns = filtered_columns(&pendulum(), &[prepared], &[]);
/// assert_eq!(columns.len(), 3); // of izz, mx and fv
/// assert!(columns[0].values.len() < log.time.len()); // decimated
/// # Ok::<(), robot_model::signal::SignalError>(())
/// ```
#[must_use]
pub fn filtered_columns<C: Columns + ?Sized>(
    columns: &C,
    logs: &[Prepared],
    shapes: &[f64],
) -> Vec<Entry> {
    let mut all: Vec<Entry> = Vec::new();
    for (number, log) in logs.iter().enumerate() {
        let mut entries = columns.entries(&log.motion, shapes);
        filter(&mut entries, log);
        if number == 0 {
            all = entries;
        } else {
            // The pattern of zeros is that of the equations, so every log has the same entries in the same order.
            for (sum, entry) in all.iter_mut().zip(entries) {
                sum.values.extend(entry.values);
            }
        }
    }
    all
}

/// Filters and decimates entries in place, on all cores.
fn filter(entries: &mut [Entry], log: &Prepared) {
    let workers = std::thread::available_parallelism().map_or(1, usize::from);
    let share = entries.len().div_ceil(workers).max(1);
    std::thread::scope(|scope| {
        for part in entries.chunks_mut(share) {
            scope.spawn(move || {
                let mut filtered = Vec::new();
                for entry in part {
                    log.shared.apply(&entry.values, &mut filtered);
                    entry.values = filtered.clone();
                }
            });
        }
    });
}

/// `columns * estimate` at every sample of a motion, unfiltered, `[joint][sample]`.
///
/// # Examples
/// ```
/// # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); }
/// # use robot_model::identify::torque_of;
/// use robot_model::motion::Motion;
/// let mut motion = Motion { time: vec![0.0], ..Motion::default() };
/// motion.smooth.q = vec![vec![std::f64::consts::FRAC_PI_2]];
/// motion.smooth.ddq = vec![vec![3.0]];
/// motion.wide.dq = vec![vec![0.5]];
/// // izz ddq + mx sin(q) + fv dq
/// let torque = torque_of(&pendulum::pendulum(), &motion, &[], &[2.0, 9.0, 1.0], 1);
/// assert!((torque[0][0] - (2.0 * 3.0 + 9.0 + 0.5)).abs() < 1e-12);
/// ```
#[must_use]
pub fn torque_of<C: Columns + ?Sized>(
    columns: &C,
    motion: &Motion,
    shapes: &[f64],
    estimate: &[f64],
    dof: usize,
) -> Vec<Vec<f64>> {
    let mut torque = vec![vec![0.0; motion.time.len()]; dof];
    for entry in columns.entries(motion, shapes) {
        subtract(
            &mut torque[entry.joint],
            -estimate[entry.column],
            &entry.values,
        );
    }
    torque
}

/// Torque of an arm at every sample of a motion, what is known of it included, `[joint][sample]`.
pub(crate) fn whole_torque(
    arm: &dyn Arm,
    motion: &Motion,
    shapes: &[f64],
    estimate: &[f64],
) -> Vec<Vec<f64>> {
    let mut torque = torque_of(arm, motion, shapes, estimate, arm.dof());
    for (sum, known) in torque.iter_mut().zip(arm.known_torque(motion, shapes)) {
        subtract(sum, -1.0, &known);
    }
    torque
}
