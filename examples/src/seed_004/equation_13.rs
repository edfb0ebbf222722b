//! Equation (13) as a model of its own: what identification without accelerations leaves with it, as printed and as it is derived.

use robot_model::columns::{Arm, Columns, Entry, MomentumArm, Shape, Unknown};
use robot_model::motion::Motion;
use robot_model_cli::interpreted::InterpretedMomentum;

use super::device::{self, SPEC};
use super::equations::{
    Comparison, Off, Place, SIGN, Transposed, is_sign, names, printed_filtered,
};
use super::fits::{self, Installation};
use super::plant::Three;
use super::truth::{CORNER, NAMES};
use crate::paper::{Error, Row, in_threads};

/// What is left of the filtered torque is no noise beyond this, RMS% of (15): item 4.6 has less everywhere.
const MISFIT: f64 = 1.0;

/// The device with the rigid columns of (13) in place of those that are derived, and the friction of the spec.
struct Printed {
    derived: InterpretedMomentum,
    /// How often `dtheta2^2 cos(theta2 - theta3)` is in the row of `pi4` on joint 3, printed once.
    times: f64,
    /// Whether all that is not `w (p - L{p})` passes the filter, which is not so in print.
    passes_all: bool,
}

impl Printed {
    fn new(times: f64, passes_all: bool) -> Result<Self, Error> {
        Ok(Self {
            derived: device::momentum(SPEC)?,
            times,
            passes_all,
        })
    }

    /// Whether a column is one of `pi1` to `pi8`, and of which.
    fn place(&self, column: usize) -> Option<usize> {
        let own = &self.derived.unknowns()[column].name;
        NAMES[..8]
            .iter()
            .position(|name| device::is_named(own, name))
    }

    /// A part of the rigid columns along a motion.
    fn entries_of(
        &self,
        motion: &Motion,
        part: impl Fn(&[Transposed; 3], Place) -> f64,
    ) -> Vec<Entry> {
        let at =
            |channels: &[Vec<f64>], k: usize| -> Three { std::array::from_fn(|j| channels[j][k]) };
        let printed: Vec<_> = (0..motion.time.len())
            .map(|k| {
                let (q, dq) = (at(&motion.smooth.q, k), at(&motion.smooth.dq, k));
                printed_filtered(&q, &dq, self.times)
            })
            .collect();
        let columns = (0..self.derived.unknowns().len()).filter_map(|c| Some((c, self.place(c)?)));
        let all =
            columns.flat_map(|(column, place)| (0..3).map(move |joint| (column, place, joint)));
        all.map(|(column, place, joint)| Entry {
            joint,
            column,
            values: printed
                .iter()
                .map(|all| part(all, (place, joint)))
                .collect(),
        })
        .collect()
    }
}

impl Columns for Printed {
    fn unknowns(&self) -> &[Unknown] {
        self.derived.unknowns()
    }

    fn shapes(&self) -> &[Shape] {
        self.derived.shapes()
    }

    fn uses_rigid_torque(&self) -> bool {
        self.derived.uses_rigid_torque()
    }

    fn entries(&self, motion: &Motion, shapes: &[f64]) -> Vec<Entry> {
        self.derived.entries(motion, shapes)
    }
}

impl Arm for Printed {
    fn dof(&self) -> usize {
        self.derived.dof()
    }

    fn joints(&self) -> &[String] {
        self.derived.joints()
    }

    fn actuator_gain(&self) -> &[f64] {
        self.derived.actuator_gain()
    }

    fn known_torque(&self, motion: &Motion, shapes: &[f64]) -> Vec<Vec<f64>> {
        self.derived.known_torque(motion, shapes)
    }

    fn rigid_torque(&self, motion: &Motion, shapes: &[f64], estimate: &[f64]) -> Vec<Vec<f64>> {
        self.derived.rigid_torque(motion, shapes, estimate)
    }

    fn dry_joints(&self) -> &[usize] {
        self.derived.dry_joints()
    }
}

/// The library has `Y_L = w (p - L{p}) - L{h}`. What is printed without the filter, `u`, is `w (u/w - L{u/w}) + L{u}`.
impl MomentumArm for Printed {
    fn momentum(&self, motion: &Motion, _: &[f64]) -> Vec<Entry> {
        self.entries_of(motion, |[momentum, _, bare], (k, joint)| {
            let own = if self.passes_all {
                0.0
            } else {
                bare[k][joint] / CORNER
            };
            momentum[k][joint] + own
        })
    }

    fn drift(&self, motion: &Motion, shapes: &[f64]) -> Vec<Entry> {
        let friction = self.derived.drift(motion, shapes).into_iter();
        let friction = friction.filter(|entry| self.place(entry.column).is_none());
        let rigid = self.entries_of(motion, |[_, inside, bare], (k, joint)| {
            -inside[k][joint] - bare[k][joint]
        });
        friction.chain(rigid).collect()
    }

    fn known_momentum(&self, motion: &Motion, shapes: &[f64]) -> Vec<Vec<f64>> {
        self.derived.known_momentum(motion, shapes)
    }

    fn known_drift(&self, motion: &Motion, shapes: &[f64]) -> Vec<Vec<f64>> {
        self.derived.known_drift(motion, shapes)
    }
}

/// RMS% of (15) on the other half where (13) is the model of the fit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Left {
    /// With its sign as printed, and filters over all.
    pub sign: Three,
    /// With filters as printed, and its sign put right.
    pub filters: Three,
    /// With both put right.
    pub repaired: Three,
}

impl Left {
    /// Of an installation.
    ///
    /// # Errors
    /// Those of identification.
    pub fn of(installation: &Installation) -> Result<Self, Error> {
        let left = |times: f64, passes_all: bool| -> Result<Three, Error> {
            let model = Printed::new(times, passes_all)?;
            let halves = &installation.halves;
            let estimate = fits::fit(&model, &halves.train)?;
            fits::rms(&estimate, &model, &halves.validate)
        };
        let cases = [(1.0, true), (0.0, false), (0.0, true)];
        let all = in_threads(&cases, |&(times, passes_all)| left(times, passes_all))?;
        let [sign, filters, repaired] = all[..] else {
            unreachable!("three cases");
        };
        Ok(Self {
            sign,
            filters,
            repaired,
        })
    }

    /// Whether nothing is left where both are put right.
    #[must_use]
    pub fn is_repaired(&self) -> bool {
        self.repaired.iter().all(|left| *left <= MISFIT)
    }

    /// Joints of which more is left than noise, from 0.
    #[must_use]
    pub fn joints(left: &Three) -> Vec<usize> {
        (0..3).filter(|j| left[*j] > MISFIT).collect()
    }
}

fn list(left: &Three) -> String {
    left.map(|percent| format!("{percent:.1}")).join(", ")
}

/// Items 4.2; `left` is of the installation that is named.
#[must_use]
pub fn rows(
    found: &Comparison,
    [printed, passed]: &[Vec<Off>; 2],
    left: &Left,
    installation: &str,
) -> Vec<Row> {
    let places: Vec<Place> = printed.iter().map(|(place, _)| *place).collect();
    let percents: Vec<String> = printed.iter().map(|(_, off)| format!("{off:.0}")).collect();
    let repaired = list(&left.repaired);
    vec![
        Row::holds(
            "4.2",
            "entries of (13) that are derived, filters put right",
            "24",
            format!("{}", 24 - found.filtered.len()),
            found.filtered.iter().all(|place| *place == SIGN),
            "other entries differ, too",
        ),
        Row::wrong_in_print(
            "4.2.sign",
            "(13), pi4 on joint 3: dtheta2^2 cos(theta2 - theta3) inside L",
            "1 times",
            format!(
                "`identify` without accelerations, with (13) as the model of {installation}, leaves {} % of the three joints, and {repaired} % \
                 with 0 times; differs from the derived one: {}",
                list(&left.sign),
                names(&found.filtered)
            ),
            is_sign(found) && Left::joints(&left.sign).contains(&SIGN.1) && left.is_repaired(),
            "it inherits the sign of (4)",
        ),
        Row::wrong_in_print(
            "4.2.L",
            "(13), entries without the subscript L",
            names(&places),
            format!(
                "`identify` with them as the model of {installation} leaves {} % of the three joints, and {repaired} % inside L; off the derived \
                 ones by {} %; inside L {} of 24 differ",
                list(&left.filters),
                percents.join(", "),
                passed.len()
            ),
            printed.len() == 4
                && passed.is_empty()
                && Left::joints(&left.filters) == [1, 2]
                && left.is_repaired(),
            "a torque that passed L is no sum of columns that did not",
        ),
    ]
}
