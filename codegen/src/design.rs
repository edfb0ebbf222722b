//! Functions of the motion alone with their slopes: what a design of experiments moves.
//!
//! In: expressions of the forms. Out: a [`Differentiable`], whose programs read positions, velocities, accelerations and
//! weights, and nothing else: parameters and shapes are numbers, dry friction turns round within a small velocity.

use crate::compiled::Compiled;
use crate::expr::{Dag, ExprId, Function, Node, Symbol};
use crate::interpreter::Program;

/// Outputs and the slopes of their weighted sum.
#[derive(Debug, Clone)]
pub struct Differentiable {
    /// Reads `q, dq, ddq`.
    pub values: Program,
    /// `d (sum_k weight_k * output_k)` by every `q`, then `dq`, then `ddq`; reads [`Symbol::Weight`] too.
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

/// Columns that a design can move, with those that it cannot.
#[derive(Debug, Clone)]
pub struct DesignColumns {
    /// Base parameters that are designed for, by their index.
    pub columns: Vec<usize>,
    /// `(joint, place in columns)` of each output.
    pub entries: Vec<(usize, usize)>,
    /// The entries.
    pub function: Differentiable,
    /// Base parameters whose columns follow from more than the motion of the instant, by their index: memory, channels, torque
    /// that is measured, time.
    pub left_out: Vec<usize>,
}

impl Compiled {
    /// The base regressor as functions of the motion.
    #[must_use]
    pub fn design_columns(&self, nominal: &Nominal) -> DesignColumns {
        let mut dag = self.dag.clone();
        let (mut columns, mut left_out) = (Vec::new(), Vec::new());
        let (mut entries, mut outputs) = (Vec::new(), Vec::new());
        for (column, &kept) in self.base.kept.iter().enumerate() {
            let of_column = self.computed_candidates.column(&self.dag, kept);
            let (joints, expressions): (Vec<usize>, Vec<ExprId>) = of_column.unzip();
            let expressions = self.of_motion(&mut dag, &expressions, nominal);
            if is_of_motion(&dag, &expressions) {
                entries.extend(joints.into_iter().map(|joint| (joint, columns.len())));
                outputs.extend(expressions);
                columns.push(column);
            } else {
                left_out.push(column);
            }
        }
        DesignColumns {
            columns,
            entries,
            function: self.differentiable(dag, &outputs),
            left_out,
        }
    }

    /// The torque of the nominal arm, as far as the motion tells it: one output a joint. What remembers counts as unbent, what
    /// reads channels as 0.
    #[must_use]
    pub fn design_torque(&self, nominal: &Nominal) -> Differentiable {
        let mut dag = self.dag.clone();
        let outputs = self.of_motion(&mut dag, &self.computed.inverse_dynamics, nominal);
        let zero = dag.zero();
        let outputs = dag.substitute(&outputs, &|symbol| (!is_motion(symbol)).then_some(zero));
        self.differentiable(dag, &outputs)
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
        Some(self.differentiable(dag, &outputs))
    }

    /// `expressions` with numbers for parameters and shapes, the arm's own load, and friction that turns round smoothly.
    fn of_motion(&self, dag: &mut Dag, expressions: &[ExprId], nominal: &Nominal) -> Vec<ExprId> {
        let loads = self.dynamics.rigid_torque.clone();
        let loaded = dag.substitute(expressions, &|symbol| match symbol {
            Symbol::RigidTorque(joint) => Some(loads[joint]),
            _ => None,
        });
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

    fn differentiable(&self, mut dag: Dag, outputs: &[ExprId]) -> Differentiable {
        let dof = self.dof();
        let symbols: Vec<Symbol> = [Symbol::Q, Symbol::Dq, Symbol::Ddq]
            .into_iter()
            .flat_map(|signal| (0..dof).map(signal))
            .collect();
        let weights: Vec<ExprId> = (0..outputs.len())
            .map(|k| dag.symbol(Symbol::Weight(k)))
            .collect();
        let slopes = dag.pullback(outputs, &weights, &symbols);
        Differentiable {
            values: Program::new(&dag, outputs),
            pullback: Program::new(&dag, &slopes),
        }
    }
}

/// `tanh(g / turn)` for each `sign(g)` of a velocity.
fn smoothed(dag: &mut Dag, expressions: &[ExprId], turn: &[f64]) -> Vec<ExprId> {
    let mut known: std::collections::HashMap<ExprId, ExprId> = std::collections::HashMap::new();
    for x in dag.reachable(expressions) {
        let of = |operand: ExprId| known[&operand];
        let new = match dag.node(x) {
            Node::Constant(_) | Node::Symbol(_) => x,
            Node::Add(p, q) => dag.add(of(p), of(q)),
            Node::Mul(p, q) => dag.mul(of(p), of(q)),
            Node::Power(p, q) => dag.power(of(p), of(q)),
            Node::Select(condition, p, q) => dag.select(of(condition), of(p), of(q)),
            Node::Call(Function::Sign, p) => {
                let inside = of(p);
                let symbols = dag.symbols(&[inside]);
                let turns = symbols.iter().filter_map(|symbol| match symbol {
                    Symbol::Dq(joint) => turn.get(*joint).copied(),
                    _ => None,
                });
                match turns.reduce(f64::min) {
                    Some(turn) => {
                        let scaled = dag.scale(1.0 / turn, inside);
                        dag.call(Function::Tanh, scaled)
                    }
                    None => dag.call(Function::Sign, inside),
                }
            }
            Node::Call(function, p) => dag.call(function, of(p)),
        };
        known.insert(x, new);
    }
    expressions.iter().map(|x| known[x]).collect()
}

fn is_of_motion(dag: &Dag, expressions: &[ExprId]) -> bool {
    dag.symbols(expressions).into_iter().all(is_motion)
}

fn is_motion(symbol: Symbol) -> bool {
    matches!(symbol, Symbol::Q(_) | Symbol::Dq(_) | Symbol::Ddq(_))
}
