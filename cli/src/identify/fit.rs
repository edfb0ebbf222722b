//! Both forms of the equations behind one face.

use std::borrow::Borrow;

use robot_model::columns::{Arm, Columns, Shape, Unknown};
use robot_model::identify::{Errors, Estimate, Factor, FactorBlock, Form, Identify, IdentifyError};
use robot_model::log::Log;
use robot_model::signal::Bands;
use robot_model_codegen::Compiled;
use robot_model_spec::Model;

use crate::Error;
use crate::interpreted::{InterpretedArm, InterpretedMomentum};

/// A way to identify and to judge what was identified.
pub(crate) trait Fit: Sync {
    fn arm(&self) -> &dyn Arm;
    fn compiled(&self) -> &Compiled;
    /// The same form of another arm, if it has one.
    fn of(&self, compiled: Compiled) -> Option<Box<dyn Fit>>;
    fn model(&self) -> &Model {
        &self.compiled().model
    }
    fn unknowns(&self) -> &[Unknown];
    fn shapes(&self) -> &[Shape];
    fn dof(&self) -> usize {
        self.model().joints.len()
    }
    fn fit(&self, identify: &Identify, logs: &[Log]) -> Result<Estimate, IdentifyError>;
    fn errors(&self, estimate: &Estimate, log: &Log) -> Result<Errors, IdentifyError>;
    /// Torques of an estimate with other values of its parameters.
    fn predict(
        &self,
        values: &[f64],
        estimate: &Estimate,
        log: &Log,
    ) -> Result<Vec<Vec<f64>>, IdentifyError>;
    /// The bands that [`Self::fit`] takes of a log.
    fn bands_of(&self, identify: &Identify, log: &Log) -> Result<Bands, IdentifyError>;
    /// A factor of no log.
    fn factor(&self, bands: Bands) -> Result<Factor, IdentifyError>;
    /// A piece of a log, reduced for such a factor.
    fn reduced(&self, log: &Log, bands: &Bands) -> Result<Vec<FactorBlock>, IdentifyError>;
}

/// An estimate with other values of its parameters.
fn with_values(estimate: &Estimate, values: &[f64]) -> Estimate {
    let mut other = estimate.clone();
    for (parameter, value) in other.parameters.iter_mut().zip(values) {
        parameter.value = *value;
    }
    other
}

/// An arm, owned or lent.
pub(crate) struct ByAcceleration<A = InterpretedArm>(pub A);

impl<A: Borrow<InterpretedArm> + Sync> Fit for ByAcceleration<A> {
    fn arm(&self) -> &dyn Arm {
        self.0.borrow()
    }

    fn compiled(&self) -> &Compiled {
        self.0.borrow().compiled()
    }

    fn of(&self, compiled: Compiled) -> Option<Box<dyn Fit>> {
        Some(Box::new(ByAcceleration(InterpretedArm::new(compiled))))
    }

    fn unknowns(&self) -> &[Unknown] {
        self.0.borrow().unknowns()
    }

    fn shapes(&self) -> &[Shape] {
        self.0.borrow().shapes()
    }

    fn fit(&self, identify: &Identify, logs: &[Log]) -> Result<Estimate, IdentifyError> {
        identify.fit(self.0.borrow(), logs)
    }

    fn errors(&self, estimate: &Estimate, log: &Log) -> Result<Errors, IdentifyError> {
        estimate.errors(self.0.borrow(), log)
    }

    fn predict(
        &self,
        values: &[f64],
        estimate: &Estimate,
        log: &Log,
    ) -> Result<Vec<Vec<f64>>, IdentifyError> {
        with_values(estimate, values).predict(self.0.borrow(), log)
    }

    fn bands_of(&self, identify: &Identify, log: &Log) -> Result<Bands, IdentifyError> {
        identify.bands_of(self.0.borrow(), log)
    }

    fn factor(&self, bands: Bands) -> Result<Factor, IdentifyError> {
        Factor::new(self.0.borrow(), bands)
    }

    fn reduced(&self, log: &Log, bands: &Bands) -> Result<Vec<FactorBlock>, IdentifyError> {
        FactorBlock::of_log(self.0.borrow(), log, bands)
    }
}

pub(crate) struct Filtered {
    pub arm: InterpretedMomentum,
    pub corner: Option<f64>,
}

impl Filtered {
    pub fn new(compiled: Compiled, corner: Option<f64>) -> Result<Self, Error> {
        let arm = InterpretedMomentum::new(compiled);
        let arm = arm.map_err(|refusal| Error::Argument(refusal.to_string()))?;
        Ok(Self { arm, corner })
    }
}

impl Fit for Filtered {
    fn arm(&self) -> &dyn Arm {
        &self.arm
    }

    fn compiled(&self) -> &Compiled {
        self.arm.compiled()
    }

    fn of(&self, compiled: Compiled) -> Option<Box<dyn Fit>> {
        let form = Self::new(compiled, self.corner).ok()?;
        Some(Box::new(form))
    }

    fn unknowns(&self) -> &[Unknown] {
        self.arm.unknowns()
    }

    fn shapes(&self) -> &[Shape] {
        self.arm.shapes()
    }

    fn fit(&self, identify: &Identify, logs: &[Log]) -> Result<Estimate, IdentifyError> {
        identify.fit_filtered(&self.arm, logs, self.corner)
    }

    fn errors(&self, estimate: &Estimate, log: &Log) -> Result<Errors, IdentifyError> {
        estimate.filtered_errors(&self.arm, log)
    }

    fn predict(
        &self,
        values: &[f64],
        estimate: &Estimate,
        log: &Log,
    ) -> Result<Vec<Vec<f64>>, IdentifyError> {
        with_values(estimate, values).predict(&self.arm, log)
    }
    fn bands_of(&self, identify: &Identify, log: &Log) -> Result<Bands, IdentifyError> {
        identify.filtered_bands_of(&self.arm, log, self.corner)
    }

    fn factor(&self, bands: Bands) -> Result<Factor, IdentifyError> {
        Factor::filtered(&self.arm, bands, self.corner)
    }

    fn reduced(&self, log: &Log, bands: &Bands) -> Result<Vec<FactorBlock>, IdentifyError> {
        FactorBlock::of_filtered_log(&self.arm, log, bands, self.corner)
    }
}

/// A spec behind the face of a form.
pub(crate) fn of_form(compiled: Compiled, form: Form) -> Result<Box<dyn Fit>, Error> {
    Ok(match form {
        Form::Acceleration => Box::new(ByAcceleration(InterpretedArm::new(compiled))),
        Form::Filtered { corner } => Box::new(Filtered::new(compiled, Some(corner))?),
    })
}

/// Errors on each of several logs.
pub(crate) fn errors_of_each(
    estimate: &Estimate,
    form: &dyn Fit,
    logs: &[Log],
) -> Result<Vec<Errors>, IdentifyError> {
    let errors = logs.iter().map(|log| form.errors(estimate, log));
    errors.collect()
}

/// Errors over several logs: means over all their samples.
pub(crate) fn errors_of_all(
    estimate: &Estimate,
    form: &dyn Fit,
    logs: &[Log],
) -> Result<Errors, IdentifyError> {
    Ok(Errors::of_all(&errors_of_each(estimate, form, logs)?))
}
