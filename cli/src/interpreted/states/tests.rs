use robot_model_codegen::expr::{Dag, ExprId, Function};
use robot_model_codegen::states::equations;

use super::*;

/// One state with this rate.
fn alone(dag: &mut Dag, rate: ExprId) -> Vec<StateProgram> {
    let equations = equations(dag, &[rate], [1]);
    equations.iter().map(|part| part.program(dag)).collect()
}

/// `dz/dt = dq - abs(dq) z / d`, Dahl's model, driven by a given velocity.
fn dahl(dag: &mut Dag, d: f64) -> Vec<StateProgram> {
    let (z, dq) = (dag.symbol(Symbol::State(0)), dag.symbol(Symbol::Dq(0)));
    let speed = dag.call(Function::Abs, dq);
    let loss = dag.mul(speed, z);
    let loss = dag.scale(1.0 / d, loss);
    let rate = dag.sub(dq, loss);
    alone(dag, rate)
}

#[test]
fn constant_speed_is_exact_however_stiff() {
    let parts = dahl(&mut Dag::new(), 1e-4);
    let dq = vec![0.5; 21];
    let z = states(&parts, 21, 1e-4, &|_| Operand::Column(&dq));
    for (k, z) in z[0].iter().enumerate() {
        let wanted = 1e-4 * (1.0 - (-0.5 * k as f64 * 1e-4 / 1e-4).exp());
        // Rounding of numbers near 1e-4.
        assert!((z - wanted).abs() < 1e-18, "{k}: {z} {wanted}");
    }
    // A step of a second, ten thousand time constants.
    let z = states(&parts, 3, 1.0, &|_| Operand::Column(&dq));
    assert!((z[0][2] - 1e-4).abs() < 1e-18);
}

#[test]
fn a_reversal_inside_a_sample_is_met_where_it_is() {
    let parts = dahl(&mut Dag::new(), 0.1);
    // From 1 to -1 rad/s: forward for half of the interval, then back.
    let z = states(&parts, 2, 0.2, &|_| Operand::Column(&[1.0, -1.0]));
    // Both halves have the mean speed 0.5 over 0.1 s: 0.05 rad there and back.
    let there = 0.1 * (1.0 - (-0.5_f64).exp());
    let back = -0.1 + (there + 0.1) * (-0.5_f64).exp();
    assert!((z[0][1] - back).abs() < 1e-15, "{} {back}", z[0][1]);
}

#[test]
fn a_rate_that_is_not_affine_converges_with_the_second_order() {
    // dz/dt = dq (1 - z^2): z = tanh(integral of dq).
    let mut dag = Dag::new();
    let (z, dq) = (dag.symbol(Symbol::State(0)), dag.symbol(Symbol::Dq(0)));
    let square = dag.mul(z, z);
    let one = dag.constant(1.0);
    let rest = dag.sub(one, square);
    let rate = dag.mul(dq, rest);
    let parts = alone(&mut dag, rate);
    let error = |samples: usize| {
        let h = 2.0 / (samples - 1) as f64;
        let dq: Vec<f64> = (0..samples).map(|k| (3.0 * h * k as f64).cos()).collect();
        let z = states(&parts, samples, h, &|_| Operand::Column(&dq));
        (z[0][samples - 1] - (6.0_f64.sin() / 3.0).tanh()).abs()
    };
    let (coarse, fine) = (error(101), error(201));
    assert!(coarse < 1e-4 && coarse / fine > 3.5, "{coarse} {fine}");
}

/// `dz/dt = if z > 1 { 0 } else { abs(dq) }`: level on both sides, and yet it has to be asked where it is.
#[test]
fn a_rate_that_jumps_with_its_state_is_not_affine() {
    let mut dag = Dag::new();
    let (z, dq) = (dag.symbol(Symbol::State(0)), dag.symbol(Symbol::Dq(0)));
    let (one, zero) = (dag.constant(1.0), dag.zero());
    let beyond = dag.sub(z, one);
    let speed = dag.call(Function::Abs, dq);
    let rate = dag.select(beyond, zero, speed);
    let parts = alone(&mut dag, rate);
    let dq = vec![0.5; 101];
    let z = states(&parts, 101, 0.03, &|_| Operand::Column(&dq));
    // A step of 0.015 past the gate at most.
    let end = z[0][100];
    assert!((1.0..1.016).contains(&end), "{end}");
}
