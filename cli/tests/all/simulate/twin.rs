//! A two-link arm whose equations stand here, integrated in tiny steps.

use crate::simulate::common::{pendulum, plant, released};

/// Lagrange's equations: lengths, masses at the middle of the links, inertias about it.
const LENGTH: f64 = 0.5;
const MASSES: [f64; 2] = [2.0, 1.0];
const MIDDLES: [f64; 2] = [0.25, 0.2];
const INERTIAS: [f64; 2] = [0.05, 0.02];

fn accelerations(q: [f64; 2], dq: [f64; 2]) -> [f64; 2] {
    let [m1, m2] = MASSES;
    let [c1, c2] = MIDDLES;
    let h = m2 * LENGTH * c2 * q[1].sin();
    let lever = m2 * LENGTH * c2 * q[1].cos();
    let far = m2 * c2 * c2 + INERTIAS[1];
    let near = m1 * c1 * c1 + INERTIAS[0] + m2 * LENGTH * LENGTH;
    let matrix = [[near + far + 2.0 * lever, far + lever], [far + lever, far]];
    let weight = 9.81 * m2 * c2 * (q[0] + q[1]).cos();
    let rest = [
        h * dq[1] * (2.0 * dq[0] + dq[1]) - 9.81 * (m1 * c1 + m2 * LENGTH) * q[0].cos() - weight,
        -h * dq[0] * dq[0] - weight,
    ];
    let det = matrix[0][0] * matrix[1][1] - matrix[0][1] * matrix[1][0];
    [
        (matrix[1][1] * rest[0] - matrix[0][1] * rest[1]) / det,
        (matrix[0][0] * rest[1] - matrix[1][0] * rest[0]) / det,
    ]
}

fn rate(x: [f64; 4]) -> [f64; 4] {
    let [a, b] = accelerations([x[0], x[1]], [x[2], x[3]]);
    [x[2], x[3], a, b]
}

#[test]
fn runge_and_kutta_in_tiny_steps_agree() {
    let mut arm = released(plant(pendulum(""), &[]), &[0.4, -0.7], &[0.3, -0.2]);
    arm.advance(2.0).expect("a motion");
    let mut x = [0.4, -0.7, 0.3, -0.2];
    let steps = 40_000;
    let h = 2.0 / f64::from(steps);
    for _ in 0..steps {
        let ahead = |k: [f64; 4], share: f64| std::array::from_fn(|i| x[i] + share * h * k[i]);
        let k1 = rate(x);
        let k2 = rate(ahead(k1, 0.5));
        let k3 = rate(ahead(k2, 0.5));
        let k4 = rate(ahead(k3, 1.0));
        x = std::array::from_fn(|i| x[i] + h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]));
    }
    for (found, wanted) in arm.q().iter().chain(arm.dq()).zip(x) {
        assert!((found - wanted).abs() < 1e-8, "{found} {wanted}");
    }
}
