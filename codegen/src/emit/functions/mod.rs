//! The functions of a page: what each is, what it takes and what it computes, whatever language it is in.

mod mechanics;

use robot_model_spec::parameter::Status;

use super::Extent;
use super::function::{Context, Function, Returns, Task, place};
use super::written::{Place, Written};
use crate::compiled::Compiled;
use crate::expr::{Dag, Symbol};
use crate::right_inverse::right_inverse;

/// The functions of the page, in order.
pub fn functions(compiled: &Compiled, extent: Extent) -> Vec<Function> {
    let names = compiled.names();
    let free_shapes = compiled.free_shapes();
    let beta = |k: usize| {
        let kept = &compiled.base.kept;
        let index = kept.binary_search(&k);
        Place::Entry("beta", index.expect("only kept parameters are symbols"))
    };
    let shape = |k: usize| {
        let index = free_shapes.binary_search(&k);
        Place::Entry(
            "shapes",
            index.expect("only open shape parameters are symbols"),
        )
    };
    let context = Context {
        compiled,
        names: &names,
        binding: &|symbol| place(symbol, &beta, &shape),
        dag: &compiled.dag,
        note: "",
    };
    let (computed, dof) = (&compiled.computed, compiled.dof());

    let note = inertia_of_effects(compiled);
    let with_note = Context {
        note: &note,
        ..context
    };
    let mut functions = vec![
        with_note.function(&Task {
            name: "mass_matrix",
            doc: "Joint-space mass matrix `M(q)`, kg m^2 (kg for prismatic joints); symmetric, positive definite for \
                  physical `beta`.",
            arguments: "q beta shapes",
            result: "M",
            outputs: computed.mass_matrix.concat(),
            returns: Returns::Matrix(dof),
        }),
        context.function(&Task {
            name: "coriolis_matrix",
            doc: "Coriolis matrix `C(q, dq)` in Christoffel form: `dM/dt - 2 C` is skew.",
            arguments: "q dq beta shapes",
            result: "C",
            outputs: computed.coriolis_matrix.concat(),
            returns: Returns::Matrix(dof),
        }),
        context.function(&Task {
            name: "gravity",
            doc: "Gravity torque `G(q)`, N m (N for prismatic joints).",
            arguments: "q beta shapes",
            result: "G",
            outputs: computed.gravity.clone(),
            returns: Returns::Vector,
        }),
        context.function(&Task {
            name: "bias",
            doc: "Bias torque `C(q, dq) * dq + G(q)`, N m (N for prismatic joints).",
            arguments: "q dq beta shapes",
            result: "tau",
            outputs: computed.bias.clone(),
            returns: Returns::Vector,
        }),
        context.function(&Task {
            name: "inverse_dynamics",
            doc: "Joint torque `tau = M * ddq + C * dq + G + effects`, N m (N for prismatic joints).",
            arguments: "q dq ddq measured_torque time inputs states beta shapes",
            result: "tau",
            outputs: computed.inverse_dynamics.clone(),
            returns: Returns::Vector,
        }),
    ];
    functions.extend(regressors(&context));
    functions.push(base_parameters(compiled));
    if extent == Extent::All {
        functions.extend(mechanics::functions(&context));
    }
    functions.extend(memory(&context));
    functions
}

/// The regressors, and the load where they read one that the mass matrix and the bias alone do not make.
fn regressors(context: &Context<'_>) -> Vec<Function> {
    let compiled = context.compiled;
    let rows = compiled.computed_candidates.regressor.iter();
    let of_base = rows
        .flat_map(|row| compiled.base.kept.iter().map(|&k| row[k]))
        .collect();
    let regressor = context.function(&Task {
        name: "regressor",
        doc: "Regressor `Y(q, dq, ddq)`: `tau = Y * standard`.",
        arguments: "q dq ddq rigid_torque measured_torque time inputs states shapes",
        result: "Y",
        outputs: compiled.computed_linear.regressor.concat(),
        returns: Returns::Matrix(compiled.standard.len()),
    });
    let base_regressor = context.function(&Task {
        name: "base_regressor",
        doc: "Base regressor `Y_b(q, dq, ddq)`: `tau = Y_b * beta`, besides what the spec fixes.",
        arguments: "q dq ddq rigid_torque measured_torque time inputs states shapes",
        result: "Y_b",
        outputs: of_base,
        returns: Returns::Matrix(compiled.base.kept.len()),
    });
    let mut functions = vec![regressor, base_regressor];
    if compiled.has_motors_in_loads() {
        functions.push(context.function(&Task {
            name: "load",
            doc: "What transmissions carry, N m (N for prismatic joints): `M * ddq + C * dq + G` without motors that are in one sum with \
                  their links, which have their nominal part of it. Effects read it as `rigid_torque`.",
            arguments: "q dq ddq beta shapes",
            result: "tau",
            outputs: compiled.computed.load.clone(),
            returns: Returns::Vector,
        }));
    }
    functions
}

/// What the mass matrix has of the inertia of effects; empty where the arm has none.
fn inertia_of_effects(compiled: &Compiled) -> String {
    let reads_ddq = |k: usize| {
        let rows = compiled.candidates.regressor.iter();
        let column: Vec<_> = rows.map(|row| row[k]).collect();
        let symbols = compiled.dag.symbols(&column);
        symbols
            .iter()
            .any(|symbol| matches!(symbol, Symbol::Ddq(_)))
    };
    let standard = compiled.standard.iter().enumerate();
    let inertias: Vec<_> = standard
        .filter(|&(k, parameter)| !compiled.model.is_rigid(parameter) && reads_ddq(k))
        .collect();
    if inertias.is_empty() {
        return String::new();
    }
    let is_outside = |k: usize, status: Status| {
        matches!(status, Status::Fixed(_)) || compiled.base.kept.contains(&k)
    };
    let outside = inertias
        .iter()
        .filter(|(k, parameter)| is_outside(*k, parameter.status));
    let outside: Vec<String> = outside
        .map(|(_, parameter)| format!("`{}`", parameter.name))
        .collect();
    let without = if outside.is_empty() {
        String::new()
    } else {
        format!(", so without {}", outside.join(", "))
    };
    format!(
        "That of the rigid body, and of the inertia of effects what regroups into a base parameter of a link{without}. The slope \
         of `inverse_dynamics` by `ddq` has all of it: `forward_dynamics` solves with that, and for computed torque call \
         `inverse_dynamics`."
    )
}

/// How the effects' internal states change, where there are some.
fn memory(context: &Context<'_>) -> Vec<Function> {
    let mut dag = context.dag.clone();
    let equations = context.compiled.state_equations(&mut dag);
    if equations.is_empty() {
        return Vec::new();
    }
    let context = Context {
        dag: &dag,
        ..*context
    };
    let tasks = [
        Task {
            name: "state_rates",
            doc: "Rates of the effects' internal states, which are 0 at the start. They are stiff: `memory_after` steps them.",
            arguments: "q dq ddq rigid_torque measured_torque time inputs states shapes",
            result: "rates",
            outputs: equations
                .iter()
                .flat_map(|part| part.rates.clone())
                .collect(),
            returns: Returns::List,
        },
        Task {
            name: "memory_after",
            doc: "The effects' internal states after some seconds in which all else stays as it is: an exponential step.",
            arguments: "q dq ddq rigid_torque measured_torque time inputs states seconds shapes",
            result: "states_after",
            outputs: equations
                .iter()
                .flat_map(|part| [&part.rates[..], &part.jacobian].concat())
                .collect(),
            returns: Returns::Memory(equations.iter().map(|part| part.rates.len()).collect()),
        },
    ];
    tasks.iter().map(|task| context.function(task)).collect()
}

/// `beta = map * standard`, as a function of its own.
fn base_parameters(compiled: &Compiled) -> Function {
    let mut dag = Dag::new();
    let outputs = compiled
        .base
        .combinations
        .iter()
        .map(|combination| {
            let terms: Vec<_> = combination
                .iter()
                .map(|&(k, coefficient)| {
                    let parameter = dag.symbol(Symbol::Parameter(k));
                    dag.scale(coefficient, parameter)
                })
                .collect();
            dag.sum(terms)
        })
        .collect();
    let standard = |k: usize| Place::Entry("standard", k);
    let shape = |_| unreachable!("base parameters are sums of standard ones");
    let names = compiled.names();
    let context = Context {
        compiled,
        names: &names,
        binding: &|symbol| place(symbol, &standard, &shape),
        dag: &dag,
        note: "",
    };
    context.function(&Task {
        name: "base_parameters",
        doc: "Base parameters `beta` of the standard parameters: sums of them with lengths as coefficients.",
        arguments: "standard",
        result: "beta",
        outputs,
        returns: Returns::List,
    })
}

/// Standard parameters of base parameters, `beta`: those that the map to base parameters prefers, what the spec fixes, zeros.
pub fn standard_of(compiled: &Compiled) -> Vec<Written> {
    let of_beta = |combination: &Vec<(usize, f64)>| {
        let terms = combination.iter();
        Written::combination(
            terms.map(|&(j, coefficient)| (coefficient, Written::Place(Place::Entry("beta", j)))),
        )
    };
    choose_standard(compiled, Written::Number, of_beta)
}

/// The standard parameters of the arm that has `beta` in its equations.
pub fn its_standard(compiled: &Compiled, beta: &[f64]) -> Vec<f64> {
    let of_beta = |combination: &Vec<(usize, f64)>| {
        let terms = combination.iter();
        let sum: f64 = terms.map(|&(k, share)| share * beta[k]).sum();
        // No zero has a sign.
        sum + 0.0
    };
    choose_standard(compiled, |value| value, of_beta)
}

/// What is fixed by its value, what is not by its combination of base parameters.
fn choose_standard<T>(
    compiled: &Compiled,
    fixed: impl Fn(f64) -> T,
    of_beta: impl Fn(&Vec<(usize, f64)>) -> T,
) -> Vec<T> {
    let combinations = right_inverse(
        &compiled.base.combinations,
        &compiled.base.kept,
        compiled.standard.len(),
    );
    let standard = compiled.standard.iter().zip(&combinations);
    standard
        .map(|(parameter, combination)| match parameter.status {
            Status::Fixed(value) => fixed(value),
            Status::Unknown | Status::Nominal(_) => of_beta(combination),
        })
        .collect()
}
