//! The momentum form: columns without accelerations, and those that have none with the reason.

use robot_model_codegen::Compiled;
use robot_model_codegen::expr::{ExprId, Symbol};
use robot_model_codegen::filtered::{MomentumForm, Reason};
use robot_model_codegen::regressor::LinearForm;

use super::{ROBOTS, assert_close, compiled, from_text, rate, value, with_effect};

/// `Y = dY_p/dt - Y_h` for every column and every value of the signals: nothing is lost and no acceleration left.
#[test]
fn the_momentum_form_is_the_regressor_without_accelerations() {
    for robot in ROBOTS {
        let arm = compiled(robot);
        assert_same_columns(
            &format!("{robot}, standard"),
            &arm,
            &arm.linear,
            &arm.momentum,
        );
        assert_same_columns(
            &format!("{robot}, base"),
            &arm,
            &arm.candidates,
            &arm.base_momentum,
        );
    }
}

fn assert_same_columns(what: &str, arm: &Compiled, linear: &LinearForm, form: &MomentumForm) {
    let mut dag = arm.dag.clone();
    let refused: Vec<usize> = form.refused.iter().map(|r| r.parameter).collect();
    for (joint, row) in linear.regressor.iter().enumerate() {
        for (k, &entry) in row.iter().enumerate().filter(|(k, _)| !refused.contains(k)) {
            let what = format!("{what}, joint {joint}, {}", arm.standard[k].name);
            let (p, h) = (form.momentum[joint][k], form.drift[joint][k]);
            let reads_acceleration = dag
                .symbols(&[p, h])
                .iter()
                .any(|symbol| matches!(symbol, Symbol::Ddq(_) | Symbol::RigidTorque(_)));
            assert!(!reads_acceleration, "{what}");
            let rate = rate(&mut dag, p, arm.dof());
            let found = dag.evaluate(rate, &value) - dag.evaluate(h, &value);
            let wanted = dag.evaluate(entry, &value);
            assert_close(&what, found, wanted, wanted);
        }
    }
}

/// Bodies of effects with a state `z`: one follows the velocity, one the acceleration.
#[test]
fn a_memory_of_the_acceleration_is_refused_with_the_reason() {
    for (rate, reason) in [
        ("dq(j) - abs(dq(j)) * z", None),
        ("ddq(j) - z", Some(Reason::Memory)),
        ("abs(rigid_torque(j)) - z", Some(Reason::Memory)),
    ] {
        let arm = from_text(&format!(
            "effect own(j) {{ linear c; state z; dot(z) = {rate}; torque(j) = c * z; }}
            robot Arm {{ gravity = [0, -9.81, 0]; convention = standard_dh;
                joint one: revolute {{ a = 0.5; alpha = 0; d = 0; }}
                effects {{ own on one; }} }}"
        ));
        let refused: Vec<Reason> = arm.momentum.refused.iter().map(|r| r.reason).collect();
        assert_eq!(refused, Vec::from_iter(reason), "{rate}");
    }
}

#[test]
fn accelerations_that_do_not_go_by_parts_are_refused_with_the_reason() {
    for (torque, reason) in [
        ("c * ddq(j)", None),
        ("c * cos(q(j)) * ddq(j) + c * dq(j)^2", None),
        ("c * abs(ddq(j))", Some(Reason::NotAffine)),
        ("c * ddq(j)^2", Some(Reason::NotAffine)),
        ("c * sign(ddq(j))", Some(Reason::NotAffine)),
        ("c * dq(j) * ddq(j)", Some(Reason::Coefficient)),
        (
            "c * ddq(j) * if q(j) > 0 { 1 } else { 0 }",
            Some(Reason::Jump),
        ),
        ("c * ddq(j) * sign(time - 1)", Some(Reason::Jump)),
        ("c * ddq(j) * max(q(j), 0)", None),
        ("c * abs(rigid_torque(j)) * sign(dq(j))", Some(Reason::Load)),
    ] {
        let arm = with_effect(torque);
        let refused: Vec<(&str, Reason)> = arm
            .momentum
            .refused
            .iter()
            .map(|r| (arm.standard[r.parameter].name.as_str(), r.reason))
            .collect();
        let wanted: Vec<_> = reason
            .map(|reason| ("two.own.c", reason))
            .into_iter()
            .collect();
        assert_eq!(refused, wanted, "{torque}");
    }
}

/// An effect whose inertia depends on the position: `A ddq = d/dt (A dq) - dA/dt dq` has both parts.
#[test]
fn an_inertia_that_depends_on_the_position_goes_by_parts() {
    let arm = with_effect("c * cos(q(j)) * ddq(j)");
    let column = arm.standard.len() - 1;
    let at = |x: ExprId| arm.dag.evaluate(x, &value);
    let (q, dq) = (value(Symbol::Q(1)), value(Symbol::Dq(1)));
    let (p, h) = (
        arm.momentum.momentum[1][column],
        arm.momentum.drift[1][column],
    );
    assert_close("p", at(p), q.cos() * dq, 1.0);
    assert_close("h", at(h), -q.sin() * dq * dq, 1.0);
}
