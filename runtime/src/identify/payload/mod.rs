//! What an arm carries: the difference of logs with and without it.
//!
//! A payload is a body on a link, so with it the base parameters are `beta + K pi`, where `K` has the combinations of that link's ten
//! parameters. All logs are fitted at once, `tau = Y_b beta` without and `tau = Y_b (beta + K pi)` with it: friction and the arm itself
//! are the same in both, and what they have in common tells nothing of the payload and harms nothing.
//!
//! Source: Khalil, Gautier, Lemoine 2007, Identification of the payload inertial parameters of industrial manipulators, method of two
//! trajectories.

mod drive_gains;
mod gain_rows;
mod shares;

pub use drive_gains::{DriveGain, Driven, KnownPayload};

use super::least_squares::Solution;
use super::stack::Stack;
use super::{
    Estimate, Fitted, Form, Identified, Identify, IdentifyError, Method, RIGID_TORQUE_PASSES,
    check_logs, prepare_all, slowest_bands, update_load,
};
use crate::columns::Arm;
use crate::log::Log;
use crate::signal::{Bands, Prepared};
use shares::Shares;

/// Names of a payload's first moments.
const FIRST_MOMENTS: [&str; 3] = ["mx", "my", "mz"];

/// An arm and what it carries.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Carried {
    /// The link that carries it.
    pub link: String,
    /// The arm's parameters and behind them the payload's, `LINK.payload.m` and so on, about the origin of the link's frame.
    pub estimate: Estimate,
    /// The arm with its payload, for errors on logs with it; deviations are those of the arm without it.
    pub loaded: Estimate,
    /// Standard deviations of its center of mass, m, along the axes of the link's frame, where logs tell it and its mass.
    pub center_std: [Option<f64>; 3],
}

impl Carried {
    /// What a solution says of the arm and its payload, the first unknowns of a stack; `alone` is the estimate without it, whose filters, shapes
    /// and delays stay, `with_payload` are the arm's unknowns with the payload in them.
    fn of(
        identify: &Identify,
        arm: &dyn Arm,
        shares: &Shares,
        stack: &Stack,
        solution: &Solution,
        alone: Estimate,
        with_payload: Vec<f64>,
    ) -> Self {
        let count = shares.coefficients.len() + shares.unknowns.len();
        let center_std = shares.center_std(identify, stack, solution);
        let fitted = Fitted::new(stack, &solution.estimate);
        let (form, bands) = (Form::Acceleration, alone.bands);
        let shapes = alone.shapes.iter().map(|(_, value)| *value).collect();
        let found = Estimate::new(arm, identify.method, form, bands, solution, shapes, fitted);
        let mut estimate = Estimate {
            shape_std: alone.shape_std.clone(),
            delays: alone.delays.clone(),
            held_torques: alone.held_torques.clone(),
            other_friction: alone.other_friction.clone(),
            hidden_delay: alone.hidden_delay,
            ..found
        };
        estimate.parameters.truncate(count);
        estimate.rank = count - estimate.unexcited.len();
        let mut loaded = alone;
        for (parameter, value) in loaded.parameters.iter_mut().zip(with_payload) {
            parameter.value = value;
        }
        Self {
            link: shares.link.clone(),
            estimate,
            loaded,
            center_std,
        }
    }

    /// The payload's parameters, as the estimate has them. Those that no torque depends on are not among them.
    ///
    /// # Examples
    /// ```
    /// # mod payload { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/payload.rs")); }
    /// let carried = payload::carried()?; // 0.5 kg m^2 and 1 kg m about the joint
    /// let izz = carried.payload().iter().find(|p| p.name == "link.payload.izz").expect("torque depends on it");
    /// assert!((izz.value - 0.5).abs() < 0.02);
    /// # Ok::<(), robot_model::identify::IdentifyError>(())
    /// ```
    #[must_use]
    pub fn payload(&self) -> &[Identified] {
        &self.estimate.parameters[self.loaded.parameters.len()..]
    }

    /// Its first moments about the origin of the link's frame, kg m, with their standard deviations, as far as the logs tell.
    ///
    /// # Examples
    /// ```
    /// # mod payload { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/payload.rs")); }
    /// let [x, _, z] = payload::carried()?.first_moments(); // 1 kg m along x
    /// assert!((x.expect("it is told")[0] - 1.0).abs() < 0.02);
    /// assert_eq!(z, None); // along the axis
    /// # Ok::<(), robot_model::identify::IdentifyError>(())
    /// ```
    #[must_use]
    pub fn first_moments(&self) -> [Option<[f64; 2]>; 3] {
        FIRST_MOMENTS.map(|own| self.told(own))
    }

    /// Its mass, kg, with the standard deviation, and its center of mass in the link's frame, m, with its deviations, each as far as the logs
    /// tell; no center where the mass is not two deviations above zero.
    ///
    /// # Examples
    /// ```
    /// # mod payload { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/payload.rs")); }
    /// // Torques of one joint do not tell the mass itself, and so no center.
    /// assert_eq!(payload::carried()?.mass_and_center(), (None, [None; 3]));
    /// # Ok::<(), robot_model::identify::IdentifyError>(())
    /// ```
    #[must_use]
    pub fn mass_and_center(&self) -> (Option<[f64; 2]>, [Option<[f64; 2]>; 3]) {
        let mass = self.told("m");
        let body = mass.filter(|[mass, std]| *mass > 2.0 * std);
        let moments = self.first_moments();
        let center = [0, 1, 2].map(|axis| {
            let [moment, _] = moments[axis]?;
            Some([moment / body?[0], self.center_std[axis]?])
        });
        (mass, center)
    }

    /// One of the payload's parameters with its deviation, where it has a value of its own.
    fn told(&self, own: &str) -> Option<[f64; 2]> {
        let name = format!("{}.payload.{own}", self.link);
        let found = self.payload().iter().find(|p| p.name == name)?;
        let is_told = self.estimate.is_separated(&name);
        is_told.then_some([found.value, found.std])
    }
}

impl Identify {
    /// Identifies an arm from logs without its payload, and the payload from logs with it; `link` carries it, without a name the last one.
    /// Open shapes are those of the logs without it.
    ///
    /// # Errors
    /// Those of [`Self::fit`]; [`IdentifyError::PayloadMethod`], [`IdentifyError::NoLink`], [`IdentifyError::FixedLink`], [`IdentifyError::NoBodies`].
    ///
    /// # Examples
    /// A body of 0.5 kg m^2 and 1 kg m about the joint:
    /// ```
    /// # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); }
    /// # use pendulum::{measure_with, pendulum};
    /// # use robot_model::identify::Identify;
    /// let alone = measure_with([2.0, 9.0, 1.0], 0.0);
    /// let loaded = measure_with([2.5, 10.0, 1.0], 0.0);
    /// let carried = Identify::default().fit_payload(&pendulum(), &[alone], &[loaded], None)?;
    /// let found: Vec<(&str, f64)> = carried.payload().iter().map(|p| (p.name.as_str(), p.value)).collect();
    /// for (name, truth) in [("link.payload.izz", 0.5), ("link.payload.mx", 1.0)] {
    ///     assert!(found.iter().any(|(own, value)| *own == name && (value - truth).abs() < 0.02));
    /// }
    /// let [moment, std] = carried.first_moments()[0].expect("it is told");
    /// assert!((moment - 1.0).abs() < 0.02 && std < 0.02); // kg m
    /// // Torques of one joint do not tell the mass itself.
    /// assert_eq!(carried.mass_and_center().0, None);
    /// # Ok::<(), robot_model::identify::IdentifyError>(())
    /// ```
    pub fn fit_payload(
        &self,
        arm: &dyn Arm,
        unloaded: &[Log],
        loaded: &[Log],
        link: Option<&str>,
    ) -> Result<Carried, IdentifyError> {
        self.check_method()?;
        check_logs(arm, unloaded)?;
        check_logs(arm, loaded)?;
        let shares = Shares::of(arm, link)?;
        let bands = self.bands_of_both(arm, unloaded, loaded)?;
        let both = Self {
            bands: Some(bands),
            ..self.clone()
        };
        let alone = both.fit(arm, unloaded)?;
        let shapes: Vec<f64> = alone.shapes.iter().map(|(_, value)| *value).collect();
        let n = shares.coefficients.len();
        let mut values = alone.values();
        values.resize(n + shares.unknowns.len(), 0.0);
        let mut logs = Both::new(unloaded, loaded, &bands)?;
        let passes = if arm.uses_rigid_torque() {
            RIGID_TORQUE_PASSES
        } else {
            1
        };
        let mut last = None;
        for _ in 0..passes {
            if arm.uses_rigid_torque() {
                logs.update(arm, &shapes, &values[..n], &shares.loaded(&values));
            }
            let (mut stack, start) = logs.stack(self, arm, &shapes);
            let columns = shares.columns(&stack, start);
            stack.append(&shares.unknowns, &columns);
            let solution = self.solve_stack(&stack)?;
            values.clone_from(&solution.estimate);
            last = Some((stack, solution));
        }
        let (stack, mut solution) = last.ok_or(IdentifyError::NoLog)?;
        solution.std = self.deviations(&stack, &solution);
        let with_payload = shares.loaded(&values);
        Ok(Carried::of(
            self,
            arm,
            &shares,
            &stack,
            &solution,
            alone,
            with_payload,
        ))
    }

    /// Methods that solve for the arm and its payload at once.
    fn check_method(&self) -> Result<(), IdentifyError> {
        match self.method {
            Method::Ls | Method::Wls | Method::Robust => Ok(()),
            method => Err(IdentifyError::PayloadMethod {
                method: method.name(),
            }),
        }
    }

    /// Bands that logs of both kinds can bear: those that are given, or that logs without the payload ask for.
    fn bands_of_both(
        &self,
        arm: &dyn Arm,
        unloaded: &[Log],
        loaded: &[Log],
    ) -> Result<Bands, IdentifyError> {
        if let Some(bands) = self.bands {
            return Ok(bands);
        }
        let without = self.choose_bands(arm, unloaded)?;
        let with = slowest_bands(loaded);
        Ok(Bands {
            smooth_hz: without.smooth_hz.min(with.smooth_hz),
            wide_hz: without.wide_hz.min(with.wide_hz),
            shared_hz: without.shared_hz.min(with.shared_hz),
        })
    }
}

/// Logs without and with a payload, ready for rows.
struct Both {
    /// Those with it behind those without.
    all: Vec<Prepared>,
    /// How many are without it.
    without: usize,
}

impl Both {
    fn new(unloaded: &[Log], loaded: &[Log], bands: &Bands) -> Result<Self, IdentifyError> {
        let mut all = prepare_all(unloaded, bands)?;
        all.extend(prepare_all(loaded, bands)?);
        let without = unloaded.len();
        Ok(Self { all, without })
    }

    /// The load that effects read, at the arm's parameters alone and with the payload.
    fn update(&mut self, arm: &dyn Arm, shapes: &[f64], alone: &[f64], loaded: &[f64]) {
        let (without, with) = self.all.split_at_mut(self.without);
        update_load(arm, without, shapes, alone);
        update_load(arm, with, shapes, loaded);
    }

    /// Rows of all logs, and the first with the payload.
    fn stack(&self, identify: &Identify, arm: &dyn Arm, shapes: &[f64]) -> (Stack, usize) {
        let stack = identify.rows(arm, &self.all, shapes);
        let start = stack.segments[self.without].start;
        (stack, start)
    }
}
