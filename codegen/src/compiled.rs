//! The pipeline on a page, and the programs that run its forms.

use robot_model_spec::model::Model;
use robot_model_spec::parameter::{StandardParameter, Status};

use crate::baked::{BakeError, Origin};
use crate::base::{self, BaseForm};
use crate::block::Block;
use crate::dynamics::energy::EnergyForm;
use crate::dynamics::{self, Computed, Dynamics, Kinematics, Partials, Point, Value, energy};
use crate::expr::{Dag, Names};
use crate::filtered::{self, MomentumForm};
use crate::interpreter::Program;
use crate::lumps;
use crate::motors;
use crate::regressor::{self, LinearForm};
use crate::states::{self, StateEquations, StateProgram};

/// A model with everything that is derived from it.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Compiled {
    /// What was compiled.
    pub model: Model,
    /// The standard parameters, in their order.
    pub standard: Vec<StandardParameter>,
    /// Where the expressions of all forms live.
    pub dag: Dag,
    /// `tau = Y * standard`
    pub linear: LinearForm,
    /// `tau = Y' * standard'` in the parameters that base parameters are chosen from: lumps of standard parameters at the
    /// place of their representatives where the robot says its energies, else the standard parameters themselves.
    pub candidates: LinearForm,
    /// Base parameters, and how they are made of standard ones.
    pub base: BaseForm,
    /// Equations of motion in the kept parameters, whose symbols stand for base parameters. What the spec fixes is numbers.
    pub dynamics: Dynamics,
    /// The same equations to be computed.
    pub computed: Computed,
    /// [`Self::linear`] to be computed.
    pub computed_linear: LinearForm,
    /// [`Self::candidates`] to be computed, as far as it is kept.
    pub computed_candidates: LinearForm,
    /// Slopes of the inverse dynamics, in the same parameters.
    pub partials: Partials,
    /// `tau = d/dt (Y_p * standard) - Y_h * standard`
    pub momentum: MomentumForm,
    /// The same in the parameters of [`Self::candidates`]: the columns of the kept ones are those of the base parameters.
    pub base_momentum: MomentumForm,
    /// Where the links are; `None` for a robot without links.
    pub kinematics: Option<Kinematics>,
    /// Points that a robot which says its energies names.
    pub points: Vec<Point>,
    /// Numbers of the base parameters where these are in the equations, see [`Self::baked`]; else they are symbols.
    pub baked: Option<Vec<f64>>,
    /// Where these numbers are from, for those who read the page; set by whoever knows it.
    pub origin: Option<Origin>,
}

/// Derives everything. A checked model has no errors left; how clear the base parameters are is
/// [`BaseForm::rank`](base::BaseForm::rank).
#[must_use]
pub fn compile_model(model: &Model) -> Compiled {
    assemble(model, &Parameters::Base, Sought::All)
}

/// The same for an arm of which rows are wanted and little more: the base regressor alone is sought in the form with the fewest operations,
/// for which most of the time goes. All else has the same values by more of them.
#[must_use]
pub fn compile_for_rows(model: &Model) -> Compiled {
    assemble(model, &Parameters::Base, Sought::BaseRegressor)
}

/// Which equations are sought in the form with the fewest operations; the others are computed as they are read.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Sought {
    All,
    BaseRegressor,
}

/// What equations are written in.
enum Parameters<'a> {
    /// Base parameters, to be found.
    Base,
    /// Numbers for base parameters that are known already.
    Baked(&'a BaseForm, &'a [f64]),
    /// Standard parameters, each for itself, of an arm whose base parameters are known.
    Standard(&'a BaseForm),
}

fn assemble(model: &Model, parameters: &Parameters<'_>, sought: Sought) -> Compiled {
    let mut dag = Dag::new();
    let standard = model.standard_parameters();
    let dof = model.joints.len();
    let energies = model.energies();
    let written = energies.map(|energies| energy::written(&mut dag, energies, dof));
    let lumps = match parameters {
        Parameters::Standard(_) => None,
        Parameters::Base | Parameters::Baked(..) => {
            energies.and_then(|energies| lumps::collect(&mut dag, energies, dof))
        }
    };
    let linear = regressor::linearize(&mut dag, model, written.as_ref());
    let form = lumps.as_ref().map(|lumps| &lumps.form);
    let candidates = match form {
        Some(form) => regressor::linearize(&mut dag, model, Some(form)),
        None => linear.clone(),
    };
    let (base, baked) = match *parameters {
        Parameters::Base => {
            let mut base = base::reduce(&dag, model, &candidates);
            if let Some(lumps) = &lumps {
                base.spell_out(model, &standard, &lumps.lumps);
            }
            (base, None)
        }
        Parameters::Baked(base, beta) => (base.clone(), Some(beta.to_vec())),
        Parameters::Standard(base) => (base.ungrouped(&standard), None),
    };
    let values = base_values(&standard, &base, baked.as_deref());
    let motors = motors::torque(&mut dag, model, &base, &candidates, baked.as_deref());
    let form_of_body = form.or(written.as_ref());
    let dynamics = dynamics::derive(&mut dag, model, form_of_body, &values, motors.clone());
    let all: Vec<usize> = (0..standard.len()).collect();
    let (computed, computed_linear) = match sought {
        Sought::All => (
            dynamics::compute(&mut dag, model, form_of_body, &values, motors.as_deref()),
            regressor::computed(&mut dag, model, &linear, &all),
        ),
        Sought::BaseRegressor => (Computed::as_read(&dynamics), linear.clone()),
    };
    let computed_candidates = match form {
        Some(_) => candidates.clone(),
        None => regressor::computed(&mut dag, model, &linear, &base.kept),
    };
    let partials = Partials::new(&mut dag, &dynamics);
    let symbols = vec![Value::Symbol; standard.len()];
    let mut momentum_of = |form: Option<&EnergyForm>, linear: &LinearForm| {
        let energies = dynamics::energies(&mut dag, model, form, &symbols);
        filtered::derive(&mut dag, model, energies, linear, &dynamics.state_rates)
    };
    let momentum = momentum_of(written.as_ref(), &linear);
    let base_momentum = match form {
        Some(form) => momentum_of(Some(form), &candidates),
        None => momentum.clone(),
    };
    let kinematics = dynamics::kinematics(&mut dag, model);
    let points = energies.map_or_else(Vec::new, |energies| {
        dynamics::points(&mut dag, model, energies)
    });
    Compiled {
        model: model.clone(),
        standard,
        dag,
        linear,
        candidates,
        base,
        dynamics,
        computed,
        computed_linear,
        computed_candidates,
        partials,
        momentum,
        base_momentum,
        kinematics,
        points,
        baked,
        origin: None,
    }
}

/// Kept parameters are symbols, or the numbers of an arm; fixed ones are numbers. What was regrouped into kept ones counts there
/// and vanishes here.
pub(crate) fn base_values(
    standard: &[StandardParameter],
    base: &BaseForm,
    beta: Option<&[f64]>,
) -> Vec<Value> {
    let mut values: Vec<Value> = standard
        .iter()
        .map(|parameter| Value::Number(fixed_value(parameter)))
        .collect();
    for (column, &k) in base.kept.iter().enumerate() {
        values[k] = beta.map_or(Value::Symbol, |beta| Value::Number(beta[column]));
    }
    values
}

fn fixed_value(parameter: &StandardParameter) -> f64 {
    match parameter.status {
        Status::Fixed(value) => value,
        Status::Unknown | Status::Nominal(_) => 0.0,
    }
}

impl Compiled {
    /// Degrees of freedom.
    #[must_use]
    pub fn dof(&self) -> usize {
        self.model.joints.len()
    }

    /// Names for displays: the user's, with base parameters' names for the kept ones.
    #[must_use]
    pub fn names(&self) -> Names {
        let mut parameters: Vec<String> = self
            .standard
            .iter()
            .map(|parameter| parameter.name.clone())
            .collect();
        for (&k, name) in self.base.kept.iter().zip(&self.base.names) {
            parameters[k].clone_from(name);
        }
        // Joints of a chain have long names, and numbers that everybody knows.
        let coordinates = match self.model.energies() {
            Some(_) => {
                let joints = self.model.joints.iter();
                joints.map(|joint| joint.name.clone()).collect()
            }
            None => Vec::new(),
        };
        Names {
            coordinates,
            parameters,
            shapes: self.shape_names(),
            inputs: self.model.inputs(),
            states: self.model.states(),
        }
    }

    /// Names of all shape parameters of the declared effects, `JOINT.EFFECT.SHAPE`, in the order of [`Symbol::Shape`](crate::expr::Symbol::Shape).
    #[must_use]
    pub fn shape_names(&self) -> Vec<String> {
        self.model
            .effects
            .iter()
            .enumerate()
            .flat_map(|(index, effect)| {
                let prefix = self.model.effect_name(index);
                effect
                    .definition
                    .shapes
                    .iter()
                    .map(move |shape| format!("{prefix}.{}", shape.name))
            })
            .collect()
    }

    /// Shape parameters that the spec leaves to identification, as indices of [`Symbol::Shape`](crate::expr::Symbol::Shape).
    #[must_use]
    pub fn free_shapes(&self) -> Vec<usize> {
        let given = self.model.effects.iter().flat_map(|effect| &effect.shapes);
        given
            .enumerate()
            .filter(|(_, value)| value.is_none())
            .map(|(k, _)| k)
            .collect()
    }

    /// Whether base parameter `column` belongs to the rigid body, not to an effect's torque.
    #[must_use]
    pub fn is_rigid(&self, column: usize) -> bool {
        self.model.is_rigid(&self.standard[self.base.kept[column]])
    }

    /// The same arm in standard parameters, each for itself: for numbers that are known one by one, where those of a motor and of
    /// its link are not the same thing. An identification needs base parameters.
    #[must_use]
    pub fn ungrouped(&self) -> Self {
        assemble(&self.model, &Parameters::Standard(&self.base), Sought::All)
    }

    /// Values for base parameters, by the standard parameter that each symbol names: `bind` for [`Symbol::Parameter`](crate::expr::Symbol::Parameter).
    /// Parameters that are not kept have 0.
    #[must_use]
    pub fn parameter_values(&self, beta: &[f64]) -> Vec<f64> {
        let mut values = vec![0.0; self.standard.len()];
        for (&k, &value) in self.base.kept.iter().zip(beta) {
            values[k] = value;
        }
        values
    }

    fn base_block(&self, wanted: impl Fn(usize) -> bool) -> Block {
        let entries = (0..self.base.kept.len())
            .filter(|&column| wanted(column))
            .flat_map(|column| {
                let entries = self
                    .computed_candidates
                    .column(&self.dag, self.base.kept[column]);
                entries.map(move |(joint, entry)| (joint, column, entry))
            })
            .collect();
        Block::new(&self.dag, entries)
    }

    /// Columns of the rigid body in the base regressor; reads `q, dq, ddq`.
    #[must_use]
    pub fn rigid_columns(&self) -> Block {
        self.base_block(|column| self.is_rigid(column))
    }

    /// Columns of the declared effects in the base regressor; may read any signal and shape.
    #[must_use]
    pub fn effect_columns(&self) -> Block {
        self.base_block(|column| !self.is_rigid(column))
    }

    /// One arm: the same model with numbers for all that an estimate gives, base parameters in their order and all shape
    /// parameters. Terms of parameters that are zero are gone, products of numbers are numbers, and the derivation chooses its
    /// ways for them. Regressors, which have no parameters in them, stay.
    ///
    /// # Errors
    /// A number that is not finite, a shape for which its effect's law does not hold, too many or too few of them; by name.
    pub fn baked(&self, beta: &[f64], shapes: &[f64]) -> Result<Self, BakeError> {
        self.check_numbers(beta, shapes)?;
        let mut model = self.model.clone();
        let mut values = shapes.iter();
        for effect in &mut model.effects {
            for (shape, value) in effect.shapes.iter_mut().zip(&mut values) {
                *shape = Some(*value);
            }
        }
        let parameters = Parameters::Baked(&self.base, beta);
        Ok(assemble(&model, &parameters, Sought::All))
    }

    /// The internal states of the declared effects, one entry per effect that has some; slopes are added to `dag`, a copy of
    /// [`Self::dag`].
    pub fn state_equations(&self, dag: &mut Dag) -> Vec<StateEquations> {
        let effects = self.model.effects.iter();
        let counts = effects.map(|effect| effect.definition.states.len());
        states::equations(dag, &self.dynamics.state_rates, counts)
    }

    /// The internal states of the declared effects, to run.
    #[must_use]
    pub fn states(&self) -> Vec<StateProgram> {
        let mut dag = self.dag.clone();
        let equations = self.state_equations(&mut dag);
        equations.iter().map(|part| part.program(&dag)).collect()
    }

    /// The whole base regressor `Y_b`.
    #[must_use]
    pub fn base_regressor(&self) -> Block {
        self.base_block(|_| true)
    }

    /// The whole regressor `Y` of the standard parameters.
    #[must_use]
    pub fn regressor(&self) -> Block {
        let entries = (0..self.standard.len())
            .flat_map(|column| {
                self.computed_linear
                    .column(&self.dag, column)
                    .map(move |(joint, entry)| (joint, column, entry))
            })
            .collect();
        Block::new(&self.dag, entries)
    }

    /// `M ddq + C dq + G`, one output a joint; reads base parameters as [`Symbol::Parameter`](crate::expr::Symbol::Parameter), see
    /// [`Self::parameter_values`]. Includes what the spec fixes.
    #[must_use]
    pub fn rigid_torque(&self) -> Program {
        Program::new(&self.dag, &self.computed.rigid_torque)
    }

    /// `rigid_torque` and the declared effects, one output a joint.
    #[must_use]
    pub fn inverse_dynamics(&self) -> Program {
        Program::new(&self.dag, &self.computed.inverse_dynamics)
    }

    /// `M`, row by row.
    #[must_use]
    pub fn mass_matrix(&self) -> Program {
        Program::new(&self.dag, &self.computed.mass_matrix.concat())
    }

    /// `C`, row by row.
    #[must_use]
    pub fn coriolis_matrix(&self) -> Program {
        Program::new(&self.dag, &self.computed.coriolis_matrix.concat())
    }

    /// `G`, one output a joint.
    #[must_use]
    pub fn gravity(&self) -> Program {
        Program::new(&self.dag, &self.computed.gravity)
    }
}
