//! Functions of the motion with their slopes: what a design of experiments moves.
//!
//! In: expressions of the forms. Out: a [`Differentiable`], whose programs read positions, velocities, accelerations, the internal
//! states that follow from them, and weights, and nothing else: parameters and shapes are numbers, dry friction turns round
//! within a small velocity.

mod smooth;

use crate::compiled::Compiled;
use crate::expr::{Dag, ExprId, Symbol};
use crate::interpreter::Program;
use crate::states::{self, StateEquations, StateProgram};

use smooth::smoothed;

/// Outputs and the slopes of their weighted sum.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Differentiable {
    /// Reads `q, dq, ddq` and the states of [`Self::memory`].
    pub values: Program,
    /// `d (sum_k weight_k * output_k)` by every `q`, then `dq`, then `ddq`, then by the states of [`Self::memory`]; reads
    /// [`Symbol::Weight`] too.
    pub pullback: Program,
    /// The effects whose states the outputs read.
    pub memory: Vec<Remembering>,
}

/// The states of an effect, `dz/dt = f(z, q, dq, ddq)`, with the slopes of what steps them.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Remembering {
    /// `f` and `df/dz`.
    pub states: StateProgram,
    /// As [`Differentiable::pullback`], of the outputs of [`StateProgram::program`]; its last slopes are by these states.
    pub pullback: Program,
}

/// Numbers for what is no motion.
#[derive(Debug, Clone, PartialEq)]
pub struct Nominal {
    /// Base parameters, in their order.
    pub beta: Vec<f64>,
    /// All shape parameters, in their order.
    pub shapes: Vec<f64>,
    /// Velocity within which a joint's dry friction turns round, rad/s or m/s.
    pub turn: Vec<f64>,
}

/// What a column of a design is the column of, by its index.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DesignColumn {
    /// A base parameter.
    Parameter(usize),
    /// A shape: the slope of the nominal arm's torque by it.
    Shape(usize),
}

/// Two effects that are to be told apart, in columns.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct RivalColumns {
    /// Shapes whose slopes are columns.
    pub shapes: Vec<usize>,
    /// Base parameters whose columns read the torque of the nominal arm where they read measured torque. All others that read it
    /// are left out.
    pub loaded: Vec<usize>,
}

/// Columns that a design can move, with those that it cannot.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct DesignColumns {
    /// What is designed for.
    pub columns: Vec<DesignColumn>,
    /// `(joint, place in columns)` of each output.
    pub entries: Vec<(usize, usize)>,
    /// The entries.
    pub function: Differentiable,
    /// Columns that follow from more than the motion: channels, time.
    pub left_out: Vec<DesignColumn>,
}

impl DesignColumn {
    /// Its name.
    #[must_use]
    pub fn name(self, compiled: &Compiled) -> String {
        match self {
            Self::Parameter(column) => compiled.base.names[column].clone(),
            Self::Shape(shape) => compiled.shape_names().swap_remove(shape),
        }
    }
}

impl Compiled {
    /// The base regressor as functions of the motion, with what two rivals have of columns beside it.
    #[must_use]
    pub fn design_columns(&self, nominal: &Nominal, rivals: &RivalColumns) -> DesignColumns {
        let mut dag = self.dag.clone();
        let (mut columns, mut left_out) = (Vec::new(), Vec::new());
        let mut candidates = Vec::new();
        for (column, &kept) in self.base.kept.iter().enumerate() {
            let of_column = self.computed_candidates.column(&self.dag, kept);
            let (joints, mut entries): (Vec<usize>, Vec<ExprId>) = of_column.unzip();
            if rivals.loaded.contains(&column) {
                entries = self.loaded_by_torque(&mut dag, &entries);
            }
            candidates.push((DesignColumn::Parameter(column), joints, entries));
        }
        for &shape in &rivals.shapes {
            let column = DesignColumn::Shape(shape);
            // The slope by way of a state is that of a whole motion.
            if self.states_read(&mut dag, Symbol::Shape(shape)) {
                left_out.push(column);
                continue;
            }
            let slopes = dag.derivatives(&self.computed.inverse_dynamics, Symbol::Shape(shape));
            candidates.push((column, (0..slopes.len()).collect(), slopes));
        }
        let remembered = self.remembered(&mut dag, nominal);
        let (mut entries, mut outputs) = (Vec::new(), Vec::new());
        for (column, joints, expressions) in candidates {
            let expressions = self.of_motion(&mut dag, &expressions, nominal);
            let mut symbols = dag.symbols(&expressions).into_iter();
            if symbols.all(|symbol| is_motion(symbol) || remembered.contains(&symbol)) {
                let entered = joints.into_iter().zip(expressions);
                for (joint, entry) in entered.filter(|&(_, entry)| !dag.is_zero(entry)) {
                    entries.push((joint, columns.len()));
                    outputs.push(entry);
                }
                columns.push(column);
            } else {
                left_out.push(column);
            }
        }
        DesignColumns {
            columns,
            entries,
            function: self.differentiable(dag, &outputs, nominal),
            left_out,
        }
    }

    /// The torque of the nominal arm, as far as the motion tells it: one output a joint. Time, channels, measured torque and
    /// states that follow from those count as 0.
    #[must_use]
    pub fn design_torque(&self, nominal: &Nominal) -> Differentiable {
        let mut dag = self.dag.clone();
        let outputs = self.nominal_torque(&mut dag);
        let outputs = self.of_motion(&mut dag, &outputs, nominal);
        let remembered = self.remembered(&mut dag, nominal);
        let zero = dag.zero();
        let outputs = dag.substitute(&outputs, &|symbol| {
            let is_known = is_motion(symbol) || remembered.contains(&symbol);
            (!is_known).then_some(zero)
        });
        self.differentiable(dag, &outputs, nominal)
    }

    /// Places of points that move with links, `(link, position in its frame in m)`, in the base frame: three outputs a point. `None` for
    /// a robot without links.
    #[must_use]
    pub fn design_points(
        &self,
        points: &[(usize, [f64; 3])],
        nominal: &Nominal,
    ) -> Option<Differentiable> {
        let mut dag = self.dag.clone();
        let poses = &self.kinematics.as_ref()?.poses;
        let mut outputs = Vec::new();
        for &(link, point) in points {
            let pose = poses[link].homogeneous(&mut dag);
            for row in pose.chunks_exact(4).take(3) {
                let mut terms = vec![row[3]];
                terms.extend(row.iter().zip(point).map(|(&entry, x)| dag.scale(x, entry)));
                outputs.push(dag.sum(terms));
            }
        }
        let outputs = self.of_motion(&mut dag, &outputs, nominal);
        Some(self.differentiable(dag, &outputs, nominal))
    }

    /// The torque of the arm with its own load; time, channels and measured torque are 0.
    fn nominal_torque(&self, dag: &mut Dag) -> Vec<ExprId> {
        let zero = dag.zero();
        dag.substitute(&self.computed.inverse_dynamics, &|symbol| {
            let is_more = matches!(
                symbol,
                Symbol::Time | Symbol::Input(_) | Symbol::MeasuredTorque(_)
            );
            is_more.then_some(zero)
        })
    }

    /// `expressions` with the torque of the arm in place of the measured one.
    fn loaded_by_torque(&self, dag: &mut Dag, expressions: &[ExprId]) -> Vec<ExprId> {
        let torques = self.nominal_torque(dag);
        dag.substitute(expressions, &|symbol| match symbol {
            Symbol::MeasuredTorque(joint) => Some(torques[joint]),
            _ => None,
        })
    }

    /// `expressions` with the arm's own load.
    fn loaded(&self, dag: &mut Dag, expressions: &[ExprId]) -> Vec<ExprId> {
        let loads = &self.dynamics.load;
        dag.substitute(expressions, &|symbol| match symbol {
            Symbol::RigidTorque(joint) => Some(loads[joint]),
            _ => None,
        })
    }

    /// `expressions` with numbers for parameters and shapes, the arm's own load, and friction that turns round smoothly.
    fn of_motion(&self, dag: &mut Dag, expressions: &[ExprId], nominal: &Nominal) -> Vec<ExprId> {
        let loaded = self.loaded(dag, expressions);
        let values = self.parameter_values(&nominal.beta);
        let parameters: Vec<ExprId> = values.iter().map(|&value| dag.constant(value)).collect();
        let shapes: Vec<ExprId> = nominal.shapes.iter().map(|&x| dag.constant(x)).collect();
        let numbers = dag.substitute(&loaded, &|symbol| match symbol {
            Symbol::Parameter(k) => Some(parameters[k]),
            Symbol::Shape(k) => Some(shapes[k]),
            _ => None,
        });
        smoothed(dag, &numbers, &nominal.turn)
    }

    /// Rates of each effect's states, as functions of the motion.
    fn rates(&self, dag: &mut Dag, nominal: &Nominal) -> Vec<StateEquations> {
        let rates = self.of_motion(dag, &self.dynamics.state_rates, nominal);
        let effects = self.model.effects.iter();
        let counts = effects.map(|effect| effect.definition.states.len());
        states::equations(dag, &rates, counts)
    }

    /// States that follow from the motion and from other states of their own effect alone.
    fn remembered(&self, dag: &mut Dag, nominal: &Nominal) -> Vec<Symbol> {
        let mut parts = self.rates(dag, nominal);
        parts.retain(|part| {
            let own: Vec<Symbol> = part.symbols().collect();
            let mut symbols = dag.symbols(&part.rates).into_iter();
            symbols.all(|symbol| is_motion(symbol) || own.contains(&symbol))
        });
        parts.iter().flat_map(StateEquations::symbols).collect()
    }

    /// Whether a state that the torque reads depends on a symbol.
    fn states_read(&self, dag: &mut Dag, symbol: Symbol) -> bool {
        let read = dag.symbols(&self.computed.inverse_dynamics);
        let states = read.into_iter().filter_map(|symbol| match symbol {
            Symbol::State(k) => Some(self.dynamics.state_rates[k]),
            _ => None,
        });
        let rates: Vec<ExprId> = states.collect();
        let rates = self.loaded(dag, &rates);
        dag.symbols(&rates).contains(&symbol)
    }

    fn differentiable(
        &self,
        mut dag: Dag,
        outputs: &[ExprId],
        nominal: &Nominal,
    ) -> Differentiable {
        let is_read = dag.symbols(outputs);
        let mut parts = self.rates(&mut dag, nominal);
        parts.retain(|part| part.symbols().any(|state| is_read.contains(&state)));
        let states = parts.iter().flat_map(StateEquations::symbols);
        let pullback = self.pullback(&mut dag, outputs, states);
        let memory = parts.iter().map(|part| Remembering {
            states: part.program(&dag),
            pullback: self.pullback(&mut dag, &part.outputs(), part.symbols()),
        });
        Differentiable {
            memory: memory.collect(),
            values: Program::new(&dag, outputs),
            pullback,
        }
    }

    fn pullback(
        &self,
        dag: &mut Dag,
        outputs: &[ExprId],
        states: impl Iterator<Item = Symbol>,
    ) -> Program {
        let signals = [Symbol::Q, Symbol::Dq, Symbol::Ddq].into_iter();
        let signals = signals.flat_map(|signal| (0..self.dof()).map(signal));
        let symbols: Vec<Symbol> = signals.chain(states).collect();
        let weights: Vec<ExprId> = (0..outputs.len())
            .map(|k| dag.symbol(Symbol::Weight(k)))
            .collect();
        let slopes = dag.pullback(outputs, &weights, &symbols);
        Program::new(dag, &slopes)
    }
}

fn is_motion(symbol: Symbol) -> bool {
    matches!(symbol, Symbol::Q(_) | Symbol::Dq(_) | Symbol::Ddq(_))
}
