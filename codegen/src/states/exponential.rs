//! One exponential step of a small system.

/// Largest norm of a matrix whose exponential is summed directly; others are halved until they are as small.
const SMALL: f64 = 0.5;

/// Terms of the exponential's series: `0.5^15 / 15!` is below rounding.
const TERMS: u32 = 14;

/// `z += h phi(h J) f`, with `phi(x) = (exp(x) - 1) / x`; `rate` is `f`, `jacobian` is `J` row by row.
pub(super) fn step(z: &mut [f64], h: f64, rate: &[f64], jacobian: &[f64]) {
    if !rate.iter().all(|f| f.is_finite()) {
        return;
    }
    let increment = if !jacobian.iter().all(|j| j.is_finite()) {
        rate.iter().map(|f| h * f).collect()
    } else if let ([f], [j]) = (rate, jacobian) {
        vec![h * phi(h * j) * f]
    } else {
        phi_times(h, rate, jacobian)
    };
    for (z, increment) in z.iter_mut().zip(increment) {
        let next = *z + increment;
        if next.is_finite() {
            *z = next;
        }
    }
}

/// `(exp(x) - 1) / x`
fn phi(x: f64) -> f64 {
    if x == 0.0 { 1.0 } else { x.exp_m1() / x }
}

/// `h phi(h J) f`: the last column of `exp([h J, h f; 0, 0])`.
fn phi_times(h: f64, rate: &[f64], jacobian: &[f64]) -> Vec<f64> {
    let count = rate.len();
    let size = count + 1;
    let mut matrix = vec![0.0; size * size];
    for row in 0..count {
        for column in 0..count {
            matrix[row * size + column] = h * jacobian[row * count + column];
        }
        matrix[row * size + count] = h * rate[row];
    }
    let norm = matrix
        .chunks(size)
        .map(|row| row.iter().map(|x| x.abs()).sum::<f64>())
        .fold(0.0, f64::max);
    // More halvings than a double has binary digits say nothing.
    let mut halvings = 0;
    let mut scale = 1.0;
    while norm * scale > SMALL && halvings < 60 {
        scale *= 0.5;
        halvings += 1;
    }
    for entry in &mut matrix {
        *entry *= scale;
    }
    let mut sum = identity(size);
    let mut term = identity(size);
    for k in 1..=TERMS {
        term = product(&term, &matrix, size);
        for (entry, t) in sum.iter_mut().zip(&mut term) {
            *t /= f64::from(k);
            *entry += *t;
        }
    }
    for _ in 0..halvings {
        sum = product(&sum, &sum, size);
    }
    (0..count).map(|row| sum[row * size + count]).collect()
}

fn identity(size: usize) -> Vec<f64> {
    let mut matrix = vec![0.0; size * size];
    for k in 0..size {
        matrix[k * size + k] = 1.0;
    }
    matrix
}

fn product(x: &[f64], y: &[f64], size: usize) -> Vec<f64> {
    let mut out = vec![0.0; size * size];
    for row in 0..size {
        for k in 0..size {
            let factor = x[row * size + k];
            for column in 0..size {
                out[row * size + column] += factor * y[k * size + column];
            }
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::{phi_times, step};

    #[test]
    fn a_pair_that_does_not_couple_is_two_single_states() {
        let (mut both, mut first, mut second) = ([0.3, -0.2], [0.3], [-0.2]);
        step(&mut both, 0.1, &[2.0, -1.0], &[-30.0, 0.0, 0.0, 0.5]);
        step(&mut first, 0.1, &[2.0], &[-30.0]);
        step(&mut second, 0.1, &[-1.0], &[0.5]);
        // A few roundings of numbers near one.
        assert!((both[0] - first[0]).abs() < 1e-14 && (both[1] - second[0]).abs() < 1e-14);
    }

    #[test]
    fn an_oscillator_turns_by_its_angle() {
        // x'' = -w^2 x from x = 1: the increment over h is (cos(wh) - 1, -w sin(wh)).
        let (w, h) = (40.0_f64, 0.07);
        let increment = phi_times(h, &[0.0, -w * w], &[0.0, 1.0, -w * w, 0.0]);
        assert!(
            (increment[0] - ((w * h).cos() - 1.0)).abs() < 1e-12,
            "{increment:?}"
        );
        assert!(
            (increment[1] + w * (w * h).sin()).abs() < 1e-11,
            "{increment:?}"
        );
    }

    #[test]
    fn what_is_no_number_changes_nothing() {
        let mut z = [0.3];
        step(&mut z, 0.1, &[f64::NAN], &[1.0]);
        assert_eq!(z[0].to_bits(), 0.3_f64.to_bits());
        step(&mut z, 0.1, &[2.0], &[f64::NAN]);
        assert!((z[0] - 0.5).abs() < 1e-15);
    }
}
