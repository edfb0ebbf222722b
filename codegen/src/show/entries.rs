//! The equations of each form: left-hand sides with their expressions.

use super::What;
use crate::compiled::Compiled;
use crate::expr::{Dag, ExprId, Style, Symbol};

/// The left-hand side of an equation, what it is, and a remark.
pub struct Entry {
    /// `M[1,2]`, `Y[1,link.izz]`, `d tau[1]/d q[2]`; indices count from 1.
    pub name: String,
    pub value: ExprId,
    pub note: Option<String>,
}

impl Entry {
    fn new(name: String, value: ExprId) -> Self {
        Self {
            name,
            value,
            note: None,
        }
    }
}

/// The entries of a form that consists of equations.
pub fn entries(compiled: &Compiled, dag: &mut Dag, what: What) -> Vec<Entry> {
    let dynamics = &compiled.dynamics;
    match what {
        What::MassMatrix => mass_matrix(&dynamics.mass_matrix),
        What::CoriolisMatrix => matrix("C", &dynamics.coriolis_matrix),
        What::Gravity => vector("G", &dynamics.gravity),
        What::Bias => vector("bias", &dynamics.bias),
        What::InverseDynamics => vector("tau", &dynamics.inverse_dynamics),
        What::ForwardDynamics => forward_dynamics(compiled, dag),
        What::Slopes => {
            let mut entries = slopes("q", &compiled.partials.by_position);
            entries.extend(slopes("dq", &compiled.partials.by_velocity));
            entries
        }
        What::Regressor => standard_columns(compiled, "Y", &compiled.linear.regressor),
        What::BaseRegressor => base_columns(compiled, "Y_b", &compiled.candidates.regressor),
        What::FilteredRegressor => {
            let mut entries = standard_columns(compiled, "Y_p", &compiled.momentum.momentum);
            let drift = standard_columns(compiled, "Y_h", &compiled.momentum.drift);
            entries.extend(drift);
            entries
        }
        What::BaseFilteredRegressor => {
            let mut entries = base_columns(compiled, "Y_p", &compiled.base_momentum.momentum);
            entries.extend(base_columns(compiled, "Y_h", &compiled.base_momentum.drift));
            entries
        }
        What::Energies => vec![
            Entry::new("T".to_owned(), dynamics.energies.kinetic),
            Entry::new("V".to_owned(), dynamics.energies.potential),
        ],
        What::ForwardKinematics => forward_kinematics(compiled),
        What::Jacobian => jacobian(compiled),
        What::StateRates => state_rates(compiled),
        What::Measurement => measurement(compiled, dag),
        What::BaseParameters | What::Cost => Vec::new(),
    }
}

fn vector(stem: &str, entries: &[ExprId]) -> Vec<Entry> {
    let entries = entries.iter().enumerate();
    entries
        .map(|(k, &value)| Entry::new(format!("{stem}[{}]", k + 1), value))
        .collect()
}

fn matrix<Row: AsRef<[ExprId]>>(stem: &str, rows: &[Row]) -> Vec<Entry> {
    let mut entries = Vec::new();
    for (i, row) in rows.iter().enumerate() {
        for (j, &value) in row.as_ref().iter().enumerate() {
            entries.push(Entry::new(format!("{stem}[{},{}]", i + 1, j + 1), value));
        }
    }
    entries
}

/// Each pair of equal entries once.
fn mass_matrix(rows: &[Vec<ExprId>]) -> Vec<Entry> {
    let mut entries = Vec::new();
    for (i, row) in rows.iter().enumerate() {
        for (j, &value) in row.iter().enumerate().skip(i) {
            let mut entry = Entry::new(format!("M[{},{}]", i + 1, j + 1), value);
            entry.note = (i != j).then(|| format!("(= M[{},{}])", j + 1, i + 1));
            entries.push(entry);
        }
    }
    entries
}

/// `A ddq = tau - b`. Where an effect is not affine in accelerations, such as friction that depends on the load, `A` is the mass
/// matrix and `b` has the effects with the accelerations in them.
fn forward_dynamics(compiled: &Compiled, dag: &mut Dag) -> Vec<Entry> {
    let dynamics = &compiled.dynamics;
    let (slope, effects) = if compiled.partials.is_affine {
        let zero = dag.zero();
        let still = |symbol| matches!(symbol, Symbol::Ddq(_)).then_some(zero);
        let rest = dag.substitute(&dynamics.effect_torque, &still);
        (&compiled.partials.by_acceleration, rest)
    } else {
        (&dynamics.mass_matrix, dynamics.effect_torque.clone())
    };
    let bias = dynamics.bias.iter().zip(effects);
    let rest: Vec<ExprId> = bias.map(|(&bias, effect)| dag.add(bias, effect)).collect();
    let mut entries = matrix("A", slope);
    entries.extend(vector("b", &rest));
    entries
}

fn slopes(coordinate: &str, rows: &[Vec<ExprId>]) -> Vec<Entry> {
    let mut entries = Vec::new();
    for (i, row) in rows.iter().enumerate() {
        for (j, &value) in row.iter().enumerate() {
            let name = format!("d tau[{}]/d {coordinate}[{}]", i + 1, j + 1);
            entries.push(Entry::new(name, value));
        }
    }
    entries
}

fn column(stem: &str, name: &str, regressor: &[Vec<ExprId>], k: usize) -> Vec<Entry> {
    let rows = regressor.iter().enumerate();
    rows.map(|(joint, row)| Entry::new(format!("{stem}[{},{name}]", joint + 1), row[k]))
        .collect()
}

fn standard_columns(compiled: &Compiled, stem: &str, regressor: &[Vec<ExprId>]) -> Vec<Entry> {
    let parameters = compiled.standard.iter().enumerate();
    parameters
        .flat_map(|(k, parameter)| column(stem, &parameter.name, regressor, k))
        .collect()
}

fn base_columns(compiled: &Compiled, stem: &str, regressor: &[Vec<ExprId>]) -> Vec<Entry> {
    let kept = compiled.base.kept.iter().zip(&compiled.base.names);
    kept.flat_map(|(&k, name)| column(stem, name, regressor, k))
        .collect()
}

/// Rotation and position of every link, or positions of points.
fn forward_kinematics(compiled: &Compiled) -> Vec<Entry> {
    let mut entries = Vec::new();
    let poses = compiled.kinematics.iter().flat_map(|k| &k.poses);
    for (link, pose) in poses.enumerate() {
        entries.extend(matrix(&format!("R{}", link + 1), &pose.rotation));
        entries.extend(vector(&format!("p{}", link + 1), &pose.translation));
    }
    for point in &compiled.points {
        entries.extend(vector(&point.name, &point.position));
    }
    entries
}

fn jacobian(compiled: &Compiled) -> Vec<Entry> {
    let mut entries = Vec::new();
    if let Some(kinematics) = &compiled.kinematics {
        entries.extend(matrix("J", &kinematics.jacobian));
    }
    for point in &compiled.points {
        entries.extend(matrix(&format!("J {}", point.name), &point.jacobian));
    }
    entries
}

/// `link[2] = q2 - rigid_torque2/stiffness`, `delay`
fn measurement(compiled: &Compiled, dag: &mut Dag) -> Vec<Entry> {
    let measurement = compiled.measurement(dag);
    let mut entries = Vec::new();
    for (joint, displacement) in measurement.displacements {
        let q = dag.symbol(Symbol::Q(joint));
        let stands = dag.add(q, displacement);
        entries.push(Entry::new(format!("link[{}]", joint + 1), stands));
    }
    entries.extend(
        measurement
            .delay
            .map(|delay| Entry::new("delay".to_owned(), delay)),
    );
    entries
}

/// `dot(elbow.dahl.z)`
fn state_rates(compiled: &Compiled) -> Vec<Entry> {
    let states = compiled.model.states();
    let rates = states.iter().zip(&compiled.dynamics.state_rates);
    rates
        .map(|(state, &rate)| Entry::new(format!("dot({state})"), rate))
        .collect()
}

/// A left-hand side in its notation.
pub fn left(name: &str, style: Style) -> String {
    if style == Style::Text {
        return name.to_owned();
    }
    if let Some((above, below)) = name.strip_prefix("d ").and_then(|n| n.split_once("/d ")) {
        let (above, below) = (left(above, style), left(below, style));
        return format!("\\partial {above} / \\partial {below}");
    }
    let state = name.strip_prefix("dot(").and_then(|n| n.strip_suffix(')'));
    if let Some(state) = state {
        return format!(
            "\\tfrac{{d}}{{dt}} \\mathrm{{{}}}",
            state.replace('_', "\\_")
        );
    }
    let Some((stem, index)) = name.trim_end_matches(']').split_once('[') else {
        return name.to_owned();
    };
    let index = match index.split_once(',') {
        Some((row, column)) if column.contains(|c: char| !c.is_ascii_digit()) => {
            format!("{row},\\mathrm{{{}}}", column.replace('_', "\\_"))
        }
        _ => index.to_owned(),
    };
    format!("{}_{{{index}}}", stem_in_latex(stem))
}

/// `Y_p`, `R2` and `J tip` have something above; words stand upright.
fn stem_in_latex(stem: &str) -> String {
    let word = |word: &str| format!("\\mathrm{{{}}}", word.replace('_', "\\_"));
    match stem {
        "tau" => return "\\tau".to_owned(),
        "dq" => return "\\dot q".to_owned(),
        _ => {}
    }
    let split = stem
        .split_once(' ')
        .or_else(|| stem.strip_prefix("Y_").map(|above| ("Y", above)));
    if let Some((stem, above)) = split {
        return format!("{stem}^{{{}}}", word(above));
    }
    let letters = stem.trim_end_matches(|c: char| c.is_ascii_digit());
    if letters.len() == 1 && letters.len() < stem.len() {
        return format!("{letters}^{{({})}}", &stem[letters.len()..]);
    }
    if stem.len() == 1 {
        stem.to_owned()
    } else {
        word(stem)
    }
}
