//! The functions beside torque and its regressor: energies, momentum, forward dynamics, slopes, kinematics.

use super::super::function::{Context, Equations, Function, Returns, Task};
use crate::expr::{ExprId, Symbol};

/// These functions, in the order of the page.
pub fn functions(context: &Context<'_>) -> Vec<Function> {
    let mut functions = energies(context);
    functions.extend(momentum(context));
    functions.push(forward_dynamics(context));
    functions.extend(slopes(context));
    functions.extend(kinematics(context));
    functions
}

fn energies(context: &Context<'_>) -> Vec<Function> {
    let energies = context.compiled.dynamics.energies;
    let tasks = [
        Task {
            name: "kinetic_energy",
            doc: "Kinetic energy of the rigid body, `1/2 dq^T M dq`, J.",
            arguments: "q dq beta shapes",
            result: "",
            outputs: vec![energies.kinetic],
            returns: Returns::Scalar,
        },
        Task {
            name: "potential_energy",
            doc: "Potential energy of the rigid body, J, up to a constant: `G` is its gradient.",
            arguments: "q beta shapes",
            result: "",
            outputs: vec![energies.potential],
            returns: Returns::Scalar,
        },
    ];
    tasks.iter().map(|task| context.function(task)).collect()
}

fn momentum(context: &Context<'_>) -> Vec<Function> {
    let compiled = context.compiled;
    let kept = |regressor: &[Vec<ExprId>]| -> Vec<ExprId> {
        let rows = regressor.iter();
        rows.flat_map(|row| compiled.base.kept.iter().map(|&k| row[k]))
            .collect()
    };
    let form = &compiled.momentum;
    let (standard, base) = (compiled.standard.len(), compiled.base.kept.len());
    let tasks = [
        Task {
            name: "momentum_regressor",
            doc: "Momentum regressor `Y_p(q, dq)`: `tau = d/dt (Y_p * standard) - Y_h * standard`.",
            arguments: "q dq measured_torque time inputs states shapes",
            result: "Y_p",
            outputs: form.momentum.concat(),
            returns: Returns::Matrix(standard),
        },
        Task {
            name: "drift_regressor",
            doc: "Drift regressor `Y_h(q, dq)`: what changes the momentum beside the torque, `C^T dq - G` less effects.",
            arguments: "q dq measured_torque time inputs states shapes",
            result: "Y_h",
            outputs: form.drift.concat(),
            returns: Returns::Matrix(standard),
        },
        Task {
            name: "base_momentum_regressor",
            doc: "Momentum regressor of the base parameters: `tau = d/dt (Y_p * beta) - Y_h * beta`, besides what the spec \
                  fixes.",
            arguments: "q dq measured_torque time inputs states shapes",
            result: "Y_p",
            outputs: kept(&compiled.base_momentum.momentum),
            returns: Returns::Matrix(base),
        },
        Task {
            name: "base_drift_regressor",
            doc: "Drift regressor of the base parameters.",
            arguments: "q dq measured_torque time inputs states shapes",
            result: "Y_h",
            outputs: kept(&compiled.base_momentum.drift),
            returns: Returns::Matrix(base),
        },
    ];
    let without: Vec<String> = form
        .refused
        .iter()
        .map(|refusal| format!("`{}`", compiled.standard[refusal.parameter].name))
        .collect();
    let note = format!(
        "Zero for what has no momentum form, as its torque reads accelerations otherwise: {}.",
        without.join(", ")
    );
    let context = Context {
        note: if without.is_empty() { "" } else { &note },
        ..*context
    };
    tasks.iter().map(|task| context.function(task)).collect()
}

fn forward_dynamics(context: &Context<'_>) -> Function {
    let compiled = context.compiled;
    let mut dag = compiled.dag.clone();
    let slope = compiled.partials.by_acceleration.concat();
    let equations = if !compiled.partials.is_affine {
        Equations::Nonlinear
    } else if compiled.partials.is_symmetric() {
        Equations::Symmetric
    } else {
        Equations::General
    };
    let torque = match equations {
        Equations::Nonlinear => compiled.computed.inverse_dynamics.clone(),
        Equations::Symmetric | Equations::General => {
            let zero = dag.zero();
            let still = |symbol| matches!(symbol, Symbol::Ddq(_)).then_some(zero);
            let effects = dag.substitute(&compiled.dynamics.effect_torque, &still);
            let bias = compiled.computed.bias.iter().zip(effects);
            bias.map(|(&bias, effect)| dag.add(bias, effect)).collect()
        }
    };
    let context = Context {
        dag: &dag,
        ..*context
    };
    context.function(&Task {
        name: "forward_dynamics",
        doc: "Accelerations that `tau` gives, rad/s^2 (m/s^2 for prismatic joints): solves the inverse dynamics for `ddq`. \
              {none} where the inertia is singular, or not positive definite, which no physical `beta` gives.",
        arguments: "q dq tau measured_torque time inputs states beta shapes",
        result: "ddq",
        outputs: [slope, torque].concat(),
        returns: Returns::Accelerations(equations),
    })
}

fn slopes(context: &Context<'_>) -> Vec<Function> {
    let (compiled, dof) = (context.compiled, context.compiled.dof());
    let tasks = [
        Task {
            name: "inverse_dynamics_by_position",
            doc: "Slope of the inverse dynamics by positions, `[i][j] = d tau_i / d q_j`, effects included; jumps have none.",
            arguments: "q dq ddq measured_torque time inputs states beta shapes",
            result: "slope",
            outputs: compiled.partials.by_position.concat(),
            returns: Returns::Matrix(dof),
        },
        Task {
            name: "inverse_dynamics_by_velocity",
            doc: "Slope of the inverse dynamics by velocities, `[i][j] = d tau_i / d dq_j`, effects included; jumps have none.",
            arguments: "q dq ddq measured_torque time inputs states beta shapes",
            result: "slope",
            outputs: compiled.partials.by_velocity.concat(),
            returns: Returns::Matrix(dof),
        },
    ];
    tasks.iter().map(|task| context.function(task)).collect()
}

fn kinematics(context: &Context<'_>) -> Vec<Function> {
    let compiled = context.compiled;
    let Some(kinematics) = &compiled.kinematics else {
        return points(context);
    };
    let mut dag = compiled.dag.clone();
    let poses = kinematics
        .poses
        .iter()
        .flat_map(|pose| pose.homogeneous(&mut dag))
        .collect();
    let context = Context {
        dag: &dag,
        ..*context
    };
    let tasks = [
        Task {
            name: "forward_kinematics",
            doc: "Poses of the link frames in the base frame as homogeneous matrices, m; the last one is the tip's.",
            arguments: "q shapes",
            result: "poses",
            outputs: poses,
            returns: Returns::Poses,
        },
        Task {
            name: "jacobian",
            doc: "Geometric Jacobian of the tip, the origin of the last link's frame, in base coordinates: `jacobian * dq` is its \
                  velocity, then its angular velocity.",
            arguments: "q shapes",
            result: "J",
            outputs: kinematics.jacobian.concat(),
            returns: Returns::Matrix(compiled.dof()),
        },
    ];
    tasks.iter().map(|task| context.function(task)).collect()
}

/// None where the spec names none.
fn points(context: &Context<'_>) -> Vec<Function> {
    let points = &context.compiled.points;
    if points.is_empty() {
        return Vec::new();
    }
    let tasks = [
        Task {
            name: "points",
            doc: "Positions of the points that the spec names, in the base frame, m.",
            arguments: "q shapes",
            result: "positions",
            outputs: points.iter().flat_map(|point| point.position).collect(),
            returns: Returns::Matrix(3),
        },
        Task {
            name: "point_jacobians",
            doc: "Slopes of the points' positions: `[k] * dq` is the velocity of point `k`.",
            arguments: "q shapes",
            result: "slopes",
            outputs: points
                .iter()
                .flat_map(|point| point.jacobian.concat())
                .collect(),
            returns: Returns::Stack(3),
        },
    ];
    tasks.iter().map(|task| context.function(task)).collect()
}
