//! The columns of all that a spec does not declare, filtered as the tracer's are, for methods that choose among columns.

use robot_model::columns::{Arm, Candidate, Change, Columns as _, Entry, Unknown};
use robot_model::identify::{Identify, IdentifyError, Solution, Stack, filtered_columns};
use robot_model::signal::Prepared;
use robot_model_cli::interpreted::InterpretedArm;

/// A column of the logged torque may be more than this share of its largest value in this share of all rows, as for the tracer: else the
/// torque explains itself.
const THERE: f64 = 0.01;
const RARELY: f64 = 0.4;

/// A candidate at values of its shapes; of one that changes the arm, what a little of it adds to first order.
pub struct Trial<'a> {
    pub candidate: &'a dyn Candidate,
    /// Its place among all candidates.
    pub effect: usize,
    pub shapes: Vec<f64>,
    /// Filtered.
    pub entries: Vec<Entry>,
}

impl Trial<'_> {
    /// One of its columns, as an effect of one column.
    pub fn column(&self, column: usize) -> (&Unknown, Vec<Entry>) {
        let own = self.entries.iter().filter(|entry| entry.column == column);
        let alone = own.map(|entry| Entry {
            column: 0,
            ..entry.clone()
        });
        (&self.candidate.unknowns()[column], alone.collect())
    }
}

/// The declared model's fit, beside which columns are chosen.
pub struct Fit<'a> {
    pub arm: &'a InterpretedArm,
    pub identify: Identify,
    pub logs: Vec<Prepared>,
    pub stack: Stack,
    pub solution: Solution,
}

impl Fit<'_> {
    /// Every candidate at a handful of values of its shapes. A change that cannot be solved for where nothing is changed is none, as for the
    /// tracer.
    pub fn trials<'a>(&self, candidates: &[&'a dyn Candidate]) -> Vec<Trial<'a>> {
        let mut trials = Vec::new();
        for (effect, &candidate) in candidates.iter().enumerate() {
            if let Some(change) = candidate.change() {
                let first = self.first_order(change).ok();
                trials.extend(first.map(|entries| Trial {
                    candidate,
                    effect,
                    shapes: Vec::new(),
                    entries,
                }));
                continue;
            }
            for shapes in points(candidate) {
                let entries = filtered_columns(candidate, &self.logs, &shapes);
                if candidate.follows_torque() && !entries.iter().all(is_rare) {
                    continue;
                }
                trials.push(Trial {
                    candidate,
                    effect,
                    shapes,
                    entries,
                });
            }
        }
        trials
    }

    /// What a change adds to first order at the declared model's estimate: one column a shape, for the shape at its probe.
    fn first_order(&self, change: &dyn Change) -> Result<Vec<Entry>, IdentifyError> {
        let arm = change.arm();
        let is_same = |(a, b): (&Unknown, &Unknown)| a.name == b.name;
        let (own, others) = (self.arm.unknowns(), arm.unknowns());
        let has_same = own.len() == others.len() && own.iter().zip(others).all(is_same);
        let mut logs = self.logs.clone();
        let estimate = if has_same {
            self.solution.estimate.clone()
        } else {
            let stack = Stack::new(arm, &logs, change.neutral());
            self.identify.solve_stack(&stack)?.estimate
        };
        load(arm, &mut logs, change.neutral(), &estimate);
        let before = Stack::new(arm, &logs, change.neutral()).residuals(&estimate);
        let mut entries = Vec::new();
        for (column, probe) in change.probe().iter().enumerate() {
            let mut moved = change.neutral().to_vec();
            moved[column] = *probe;
            let moved = Stack::new(arm, &logs, &moved).residuals(&estimate);
            for (joint, (before, moved)) in before.iter().zip(&moved).enumerate() {
                entries.push(Entry {
                    joint,
                    column,
                    values: before.iter().zip(moved).map(|(b, m)| b - m).collect(),
                });
            }
        }
        Ok(entries)
    }
}

/// Loads along the motions, for what depends on them.
pub fn load(arm: &dyn Arm, logs: &mut [Prepared], shapes: &[f64], estimate: &[f64]) {
    for log in logs {
        log.motion.rigid_torque = arm.rigid_torque(&log.motion, shapes, estimate);
        log.motion.transmitted_torque = arm.transmitted_torque(&log.motion, shapes, estimate);
    }
}

/// A handful of the tracer's first values of shapes: five of one shape, three each of two, two each of three, else those in the middle.
fn points(candidate: &dyn Candidate) -> Vec<Vec<f64>> {
    let shapes = candidate.shapes();
    let each = match shapes.len() {
        0 | 1 => 5,
        2 => 3,
        3 => 2,
        _ => 1,
    };
    let mut points = vec![Vec::new()];
    for shape in shapes {
        let count = shape.grid.len();
        let mut places: Vec<usize> = (0..each)
            .map(|k| (2 * k + 1) * count / (2 * each))
            .collect();
        places.dedup();
        let longer = |point: &Vec<f64>| -> Vec<Vec<f64>> {
            let values = places.iter().map(|place| shape.grid[*place]);
            values
                .map(|value| [point.as_slice(), &[value]].concat())
                .collect()
        };
        points = points.iter().flat_map(longer).collect();
    }
    points
}

/// Whether a column is next to nothing in most rows.
fn is_rare(entry: &Entry) -> bool {
    let sizes = entry.values.iter().map(|value| value.abs());
    let largest = sizes.clone().fold(0.0, f64::max);
    let there = sizes.filter(|size| *size > THERE * largest).count();
    there as f64 <= RARELY * entry.values.len() as f64
}
