//! The textbook's integrator, which shares nothing with the runtime's.

use std::array;

/// The state after one classical Runge-Kutta step of `dx/dt = f(t, x)` over `h` seconds.
pub fn rk4<const N: usize>(
    f: impl Fn(f64, &[f64; N]) -> [f64; N],
    t: f64,
    x: &[f64; N],
    h: f64,
) -> [f64; N] {
    let along = |slope: &[f64; N], part: f64| array::from_fn(|i| x[i] + part * slope[i]);
    let k1 = f(t, x);
    let k2 = f(t + 0.5 * h, &along(&k1, 0.5 * h));
    let k3 = f(t + 0.5 * h, &along(&k2, 0.5 * h));
    let k4 = f(t + h, &along(&k3, h));
    array::from_fn(|i| x[i] + h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn its_error_falls_with_the_fourth_power_of_the_step() {
        let error = |steps: u32| {
            let h = 1.0 / f64::from(steps);
            let swing = |_: f64, x: &[f64; 2]| [x[1], -x[0]];
            let end = (0..steps).fold([1.0, 0.0], |x, _| rk4(swing, 0.0, &x, h));
            (end[0] - 1_f64.cos()).abs()
        };
        let ratio = error(10) / error(20);
        assert!((ratio - 16.0).abs() < 1.0, "{ratio}");
    }
}
