//! Columns of a regressor at states that tell them apart.
//!
//! In: [`LinearForm`]. Out: [`Sample`]. Invariants gained: every entry is a number and more than rounding, or zero; rows and
//! columns are scaled, so that what is small in its units counts as much as what is large.
//!
//! Columns of a chain are analytic: what holds near any state holds at all. Effects are not. One may sleep at usual states,
//! another look like a third there; so states are also drawn between every two neighbours among the numbers that its
//! equations contain, and powers of ten.

mod marks;
mod scaling;

use robot_model_spec::model::Model;
use robot_model_spec::parameter::StandardParameter;

use crate::expr::{Dag, ExprId, Function, Node, Symbol};
use crate::random::Generator;
use crate::regressor::LinearForm;
use crate::rounded::Rounded;
use marks::Deck;
use scaling::Scaled;

/// Usual states are this many times as many as the parameters, over the degrees of freedom.
const OVERSAMPLING: usize = 3;
/// Each interval between two marks is drawn from so often.
const VISITS: usize = 3;
/// States that are tried before it is said that there is no number at any, in multiples of those that are wanted.
const PATIENCE: usize = 48;
/// One state in so many has a given joint at rest.
const REST_EVERY: usize = 7;

/// Values of columns.
pub struct Sample {
    /// One per standard parameter; `None` where it is zero by structure.
    pub columns: Vec<Option<Column>>,
    /// Per column whether what holds near a state holds at all.
    pub is_analytic: Vec<bool>,
}

/// The values of one column.
pub struct Column {
    /// Scaled to length one; empty where no value is more than rounding.
    pub values: Vec<f64>,
    /// A unit of the scaled column is so many of the original.
    pub scale: f64,
    /// Whether every value was exactly zero.
    pub is_asleep: bool,
}

/// Where a column is no number.
#[derive(Debug, Clone, PartialEq)]
pub struct NoNumber {
    /// Name of the standard parameter.
    pub name: String,
    /// Names of the coordinates, with their values at such a state.
    pub position: Vec<(String, f64)>,
    /// Whether the robot's coordinates are joints of a chain.
    pub is_chain: bool,
}

impl std::fmt::Display for NoNumber {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let at: Vec<String> = self
            .position
            .iter()
            .map(|(name, value)| format!("{name} = {value:.3}"))
            .collect();
        let limits = if self.is_chain {
            "`position = LOW .. HIGH;` of the joints"
        } else {
            "`limits COORDINATE { position = LOW .. HIGH; }`"
        };
        write!(
            f,
            "the torque of `{}` is not a number at any tested state, such as {}: write {limits} within which it is one",
            self.name,
            at.join(", ")
        )
    }
}

/// Where the arm is and what effects read there.
struct State {
    q: Vec<f64>,
    dq: Vec<f64>,
    ddq: Vec<f64>,
    rigid_torque: Vec<f64>,
    measured_torque: Vec<f64>,
    inputs: Vec<f64>,
    states: Vec<f64>,
    time: f64,
}

/// How a state is drawn.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    /// Of the size of an arm and its motions, whatever the limits.
    Usual,
    /// Inside the limits that the spec gives.
    Inside,
    /// Each signal between two marks; positions inside the limits that the spec gives.
    MarksInside,
    /// Each signal between two marks.
    Marks,
}

/// Draws states, finds values, scales them.
pub fn sample(
    dag: &Dag,
    model: &Model,
    linear: &LinearForm,
    parameters: &[StandardParameter],
) -> Result<Sample, NoNumber> {
    /// Any fixed number: same spec, same states.
    const SEED: u64 = 0x726f_626f_745f_6d6f;
    let dof = model.joints.len();
    let entries: Vec<(usize, usize, ExprId)> = (0..parameters.len())
        .flat_map(|k| linear.column(dag, k).map(move |(joint, x)| (joint, k, x)))
        .collect();
    let mut generator = Generator::new(SEED);
    let shapes = generic_shapes(model, &mut generator);
    let is_analytic = analytic(dag, model, parameters, &entries);
    let marked: Vec<ExprId> = entries
        .iter()
        .filter(|entry| !is_analytic[entry.1])
        .map(|entry| entry.2)
        .collect();
    let mut deck = Deck::new(dag, model, &marked, &shapes);
    let usual = OVERSAMPLING * parameters.len().div_ceil(dof) + 16;
    let marks = VISITS * deck.intervals();

    let roots: Vec<ExprId> = entries.iter().map(|entry| entry.2).collect();
    let order = dag.reachable(&roots);
    let mut values = vec![Rounded::ZERO; dag.len()];
    let mut rows: Vec<(usize, Vec<Rounded>)> = Vec::new();
    let mut failure = None;
    for (kinds, wanted) in [
        ([Kind::Usual, Kind::Inside], usual),
        ([Kind::MarksInside, Kind::Marks], marks),
    ] {
        let mut found = 0;
        for attempt in 0..PATIENCE * wanted {
            if found == wanted {
                break;
            }
            let kind = kinds[attempt % 2];
            let state = draw(model, kind, attempt, &mut generator, &mut deck);
            let bind = |symbol: Symbol| value(symbol, &state, &shapes);
            dag.evaluate_rounded(&order, &bind, &mut values);
            let not_finite = entries
                .iter()
                .find(|entry| !values[entry.2.index()].value.is_finite());
            if let Some(&(_, k, _)) = not_finite {
                failure.get_or_insert_with(|| no_number(model, &parameters[k].name, &state));
                continue;
            }
            found += 1;
            for joint in 0..dof {
                let mut row = vec![Rounded::ZERO; parameters.len()];
                for &(_, k, x) in entries.iter().filter(|entry| entry.0 == joint) {
                    row[k] = values[x.index()];
                }
                rows.push((joint, row));
            }
        }
        // Fewer states than parameters cannot tell them apart.
        if kinds[0] == Kind::Usual
            && OVERSAMPLING * found < wanted
            && let Some(failure) = failure
        {
            return Err(failure);
        }
    }
    let is_there: Vec<bool> = (0..parameters.len())
        .map(|k| entries.iter().any(|entry| entry.1 == k))
        .collect();
    let is_asleep: Vec<bool> = (0..parameters.len())
        .map(|k| rows.iter().all(|(_, row)| row[k].value == 0.0))
        .collect();
    let scaled = Scaled::new(rows, parameters.len());
    let columns = scaled.columns.into_iter().zip(scaled.scale).enumerate();
    Ok(Sample {
        columns: columns
            .map(|(k, (values, scale))| {
                is_there[k].then_some(Column {
                    values,
                    scale,
                    is_asleep: is_asleep[k],
                })
            })
            .collect(),
        is_analytic,
    })
}

/// Columns of a rigid body, where all of them are sums of products of coordinates, rates, sines and cosines.
fn analytic(
    dag: &Dag,
    model: &Model,
    parameters: &[StandardParameter],
    entries: &[(usize, usize, ExprId)],
) -> Vec<bool> {
    let is_rigid: Vec<bool> = parameters.iter().map(|p| model.is_rigid(p)).collect();
    let rigid = entries.iter().filter(|entry| is_rigid[entry.1]);
    let rigid: Vec<ExprId> = rigid.map(|entry| entry.2).collect();
    let are_plain = dag.reachable(&rigid).into_iter().all(|x| {
        matches!(
            dag.node(x),
            Node::Constant(_)
                | Node::Symbol(Symbol::Q(_) | Symbol::Dq(_) | Symbol::Ddq(_))
                | Node::Add(..)
                | Node::Mul(..)
                | Node::Call(Function::Sin | Function::Cos, _)
        )
    });
    is_rigid.into_iter().map(|is| is && are_plain).collect()
}

fn no_number(model: &Model, name: &str, state: &State) -> NoNumber {
    let joints = model.joints.iter().map(|joint| joint.name.clone());
    NoNumber {
        name: name.to_owned(),
        position: joints.zip(state.q.iter().copied()).collect(),
        is_chain: model.chain().is_some(),
    }
}

fn value(symbol: Symbol, state: &State, shapes: &[f64]) -> f64 {
    match symbol {
        Symbol::Q(joint) => state.q[joint],
        Symbol::Dq(joint) => state.dq[joint],
        Symbol::Ddq(joint) => state.ddq[joint],
        Symbol::RigidTorque(joint) => state.rigid_torque[joint],
        Symbol::Time => state.time,
        Symbol::MeasuredTorque(joint) => state.measured_torque[joint],
        Symbol::Input(k) => state.inputs[k],
        Symbol::State(k) => state.states[k],
        Symbol::Shape(k) => shapes[k],
        Symbol::Parameter(_) => unreachable!("checked in regressor::linearize"),
        Symbol::Switch(_) | Symbol::Weight(_) => {
            unreachable!("in equations of simulation and design alone")
        }
    }
}

/// Every symbol is drawn in a fixed order, whether an equation reads it or not.
fn draw(
    model: &Model,
    kind: Kind,
    number: usize,
    generator: &mut Generator,
    deck: &mut Deck,
) -> State {
    let is_marked = matches!(kind, Kind::Marks | Kind::MarksInside);
    let is_inside = matches!(kind, Kind::Inside | Kind::MarksInside);
    let mut signal = |symbol: Symbol, usual: f64, limits: Option<(f64, f64)>| -> f64 {
        let part = generator.symmetric();
        let marked = deck.draw(symbol, generator);
        // A torque or a speed may be as large as it wants at a mark; a position outside may be no number.
        let limits = limits.filter(|_| is_inside);
        match (limits, marked) {
            (Some((low, high)), _) if matches!(symbol, Symbol::Q(_)) || !is_marked => {
                f64::midpoint(low, high) + 0.5 * part * (high - low)
            }
            (_, Some(marked)) if is_marked => marked,
            _ => usual * part,
        }
    };
    let both_ways = |limit: Option<f64>| limit.map(|limit| (-limit, limit));
    let joints = || model.joints.iter().enumerate();
    let q = joints().map(|(k, joint)| signal(Symbol::Q(k), 3.0, joint.limits.position.map(near)));
    let q = q.collect();
    let dq = joints().map(|(k, joint)| {
        let speed = signal(Symbol::Dq(k), 2.0, both_ways(joint.limits.velocity));
        // Laws that jump at rest are told from those that do not.
        let rests = !is_marked && (number + REST_EVERY - k % REST_EVERY).is_multiple_of(REST_EVERY);
        if rests { 0.0 } else { speed }
    });
    let dq = dq.collect();
    let ddq = joints().map(|(k, _)| signal(Symbol::Ddq(k), 4.0, None));
    let ddq = ddq.collect();
    let torque = |joint: &robot_model_spec::model::Joint| both_ways(joint.limits.torque);
    let rigid_torque =
        joints().map(|(k, joint)| signal(Symbol::RigidTorque(k), 10.0, torque(joint)));
    let rigid_torque = rigid_torque.collect();
    let measured_torque =
        joints().map(|(k, joint)| signal(Symbol::MeasuredTorque(k), 10.0, torque(joint)));
    let measured_torque = measured_torque.collect();
    let time = signal(Symbol::Time, 20.0, None).abs();
    // Temperatures and currents of most logs are positive, and roots of others are no numbers.
    let inputs = (0..model.inputs().len()).map(|k| {
        let input = signal(Symbol::Input(k), 30.0, None);
        if is_inside { input.abs() } else { input }
    });
    let inputs = inputs.collect();
    let states = (0..model.states().len())
        .map(|k| signal(Symbol::State(k), 1.0, None))
        .collect();
    State {
        q,
        dq,
        ddq,
        rigid_torque,
        measured_torque,
        inputs,
        states,
        time,
    }
}

/// The part of a range that is near zero, where it has one: of a joint that travels a million kilometers, squares of positions
/// would hide everything else.
fn near((low, high): (f64, f64)) -> (f64, f64) {
    /// rad or m.
    const FAR: f64 = 10.0;
    let (from, to) = (low.max(-FAR), high.min(FAR));
    if from < to { (from, to) } else { (low, high) }
}

/// The spec's values of shape parameters, and a value without meaning inside the range for every other: no law may look like
/// another one because both stand at a special value.
fn generic_shapes(model: &Model, generator: &mut Generator) -> Vec<f64> {
    let effects = model.effects.iter();
    effects
        .flat_map(|effect| effect.shapes.iter().zip(&effect.definition.shapes))
        .map(|(value, shape)| {
            let part = 0.5 + 0.4 * generator.symmetric();
            value.unwrap_or(shape.low + part * (shape.high - shape.low))
        })
        .collect()
}
