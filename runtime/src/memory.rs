//! Internal states of effects: bristles that bend, hysteresis, anything that remembers how it came here.

use nalgebra::allocator::Allocator;
use nalgebra::{DefaultAllocator, Dim, OMatrix, OVector, SVector};

use crate::model::{RobotModel, Vector, from_rows};
use crate::scalar::Scalar;
use crate::state::State;

/// An arm whose effects have internal states `z` with `dz/dt = f(z, q, dq, ..)`; the compiler writes the implementations.
///
/// Nothing allocates, nothing panics: a control loop keeps a vector and renews it once a cycle.
///
/// # Examples
#[cfg_attr(feature = "derive", doc = "```")]
#[cfg_attr(not(feature = "derive"), doc = "```ignore")]
/// use robot_model::effects::LugrePresliding;
/// use robot_model::{Link, Memory, RobotModel, State, Vector};
///
/// #[derive(RobotModel)]
/// #[robot(convention = standard_dh, gravity = [0, 0, 0])]
/// struct Table {
///     #[joint(revolute, a = 0, alpha = 0, d = 0)]
///     turn: Link<LugrePresliding>,
/// }
///
/// // 2 N m of friction while sliding, 3 N m to break away; bristles slide when they are bent by 1 mrad.
/// let friction = LugrePresliding { fc: 2.0, s1: 0.0, d: 1e-3, vs: 0.1, rise: 0.5 };
/// let arm = Table { turn: Link::default().with(friction) };
/// let mut state = State::new(Vector::from([0.0]), Vector::from([0.02]), Vector::zeros()).with_memory(Vector::zeros());
/// let mut torque = Vector::zeros();
/// for _cycle in 0..2000 {
///     torque = arm.inverse_dynamics_at(&state);
///     state.memory = arm.memory_after(&state, 1e-3);
/// }
/// // Stribeck's curve: fc (1 + rise exp(-(v / vs)^2))
/// assert!((torque[0] - 2.0 * (1.0 + 0.5 * (-0.04_f64).exp())).abs() < 1e-6);
/// ```
pub trait Memory<
    const DOF: usize,
    const STANDARD: usize,
    const BASE: usize,
    const SHAPES: usize,
    const STATES: usize,
    const INPUTS: usize,
>: RobotModel<DOF, STANDARD, BASE, SHAPES, STATES, INPUTS>
{
    /// Names of the internal states, in the order of [`State::memory`].
    const STATES: [&'static str; STATES];

    /// Rates `dz/dt` of the internal states, 1/s for states without a unit; with states and shape parameters given, since they depend on no other
    /// parameter. Load-dependent ones read `state.rigid_torque`.
    ///
    /// # Examples
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/table.rs")); }
    /// use robot_model::{Memory, Vector};
    /// // (dq - abs(dq) z) / d, with bristles that are twice as long.
    /// let rates = arms::Table::state_rates_at(&arms::sliding(), &Vector::from([0.02]));
    /// assert!((rates[0] - (0.02 - 0.02 * 0.5) / 0.02).abs() < 1e-12);
    /// ```
    fn state_rates_at<S: Scalar>(
        state: &State<DOF, STATES, INPUTS, S>,
        shapes: &Vector<SHAPES>,
    ) -> SVector<S, STATES>;

    /// Rates `dz/dt` of this arm's internal states, under its own load.
    ///
    /// # Examples
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/table.rs")); }
    /// use robot_model::Memory;
    /// let rates = arms::table().state_rates(&arms::sliding());
    /// assert!((rates[0] - (0.02 - 0.02 * 0.5) / 0.01).abs() < 1e-12);
    /// ```
    fn state_rates<S: Scalar>(&self, state: &State<DOF, STATES, INPUTS, S>) -> SVector<S, STATES> {
        Self::state_rates_at(&self.loaded(state), &self.shapes())
    }

    /// Internal states `seconds` after `state`, if the rest of it stays as it is: one step of [`step`], stable however stiff
    /// the states are. Of second order where `state` is the motion in the middle of the interval.
    ///
    /// # Examples
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/table.rs")); }
    /// use robot_model::Memory;
    /// // 1 - z falls by exp(-distance / d): here 20 mrad over 10 mrad.
    /// let z = arms::table().memory_after(&arms::sliding(), 1.0);
    /// assert!((1.0 - z[0] - 0.5 * (-2.0_f64).exp()).abs() < 1e-12);
    /// ```
    fn memory_after<S: Scalar>(
        &self,
        state: &State<DOF, STATES, INPUTS, S>,
        seconds: f64,
    ) -> SVector<S, STATES>;
}

/// Largest norm of a matrix whose series is summed directly; others are halved until they are as small.
const SMALL: f64 = 0.5;

/// Terms of the series: `0.5^14 / 15!` is below rounding.
const TERMS: u32 = 14;

/// One exponential step of a small system, `z + h phi(h J) f` with `phi(x) = (exp(x) - 1) / x`: `rate` is `f = dz/dt`,
/// `jacobian` is `J = df/dz`, `h` is in s.
///
/// The step of Rosenbrock and Euler: exact where `f` is affine in `z`, stable however stiff, of second order else. Where a rate
/// is no number, or the step would overflow, the state stays; where only a derivative is none, such as that of `abs(z)^n` at 0,
/// the step is one of Euler.
///
/// Source: Hochbruck & Ostermann 2010, Exponential integrators.
///
/// # Examples
/// ```
/// use nalgebra::{Matrix1, Vector1};
/// use robot_model::memory::step;
/// // dz/dt = 2 - 1000 z, over ten thousand time constants.
/// let mut z = Vector1::new(0.0_f64);
/// step(&mut z, 10.0, &Vector1::new(2.0), &Matrix1::new(-1000.0));
/// assert!((z[0] - 0.002).abs() < 1e-18);
/// ```
pub fn step<S: Scalar, D: Dim>(
    z: &mut OVector<S, D>,
    h: f64,
    rate: &OVector<S, D>,
    jacobian: &OMatrix<S, D, D>,
) where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    // Zero, or no number where an entry is none: lane by lane.
    let flaw =
        |entries: &mut dyn Iterator<Item = S>| entries.fold(S::zero(), |sum, x| sum + x.flaw());
    let stays = flaw(&mut rate.iter().copied());
    let is_rough = flaw(&mut jacobian.iter().copied());
    let h = S::of(h);
    let smooth = jacobian.map(|slope| (slope + is_rough).finite_or(S::zero()) * h);
    let increment = if let [exponent] = smooth.as_slice() {
        rate * (phi(*exponent) * h)
    } else {
        phi_of(smooth) * rate * h
    };
    for (z, increment) in z.iter_mut().zip(&increment) {
        *z = (*z + *increment + stays).finite_or(*z);
    }
}

/// [`step`] of arrays, for emitted code: the states `z` after `h` seconds; `jacobian` is `[row][column]`.
///
/// # Examples
/// ```
/// use robot_model::memory::after;
/// // dz/dt = -z / 0.1 and dz/dt = 3
/// let [decayed] = after(&[1.0_f64], 0.1, &[-10.0], &[[-10.0]]);
/// let [grown] = after(&[1.0_f64], 0.1, &[3.0], &[[0.0]]);
/// assert!((decayed - (-1.0_f64).exp()).abs() < 1e-15 && (grown - 1.3).abs() < 1e-15);
/// ```
#[must_use]
pub fn after<S: Scalar, const N: usize>(
    z: &[S; N],
    h: f64,
    rate: &[S; N],
    jacobian: &[[S; N]; N],
) -> [S; N] {
    let mut z = SVector::from(*z);
    step(&mut z, h, &SVector::from(*rate), &from_rows(jacobian));
    z.data.0[0]
}

/// `(exp(x) - 1) / x`; by its series where the slope of the quotient would cancel.
fn phi<S: Scalar>(x: S) -> S {
    // Horner: 1 + x/2 (1 + x/3 (1 + ..))
    let terms = (2..=TERMS + 1).rev().map(|k| S::of(1.0 / f64::from(k)));
    let series = terms.fold(S::one(), |sum, share| S::one() + x * share * sum);
    S::choose(x.abs() - S::of(SMALL), x.exp_m1() / x, series)
}

/// `phi` of a matrix: its series where the matrix is small, and `phi(2 A) = phi(A) + phi(A) A phi(A) / 2` from there.
fn phi_of<S: Scalar, D: Dim>(mut matrix: OMatrix<S, D, D>) -> OMatrix<S, D, D>
where
    DefaultAllocator: Allocator<D, D>,
{
    let rows = matrix
        .row_iter()
        .map(|row| row.iter().fold(S::zero(), |sum, x| sum + x.abs()));
    let norm = rows.map(S::most).fold(0.0, f64::max);
    let (mut halvings, mut scale) = (0, 1.0);
    while norm * scale > SMALL {
        scale *= 0.5;
        halvings += 1;
    }
    matrix *= S::of(scale);
    // Horner: 1 + A/2 (1 + A/3 (1 + ..))
    let (rows, columns) = matrix.shape_generic();
    let one = OMatrix::<S, D, D>::identity_generic(rows, columns);
    let mut phi = one.clone();
    for k in (2..=TERMS + 1).rev() {
        phi = &one + &matrix * phi / S::of(f64::from(k));
    }
    for _ in 0..halvings {
        phi = &phi + &phi * &matrix * &phi * S::of(0.5);
        matrix *= S::of(2.0);
    }
    phi
}

#[cfg(test)]
mod tests {
    use nalgebra::{Matrix1, Matrix2, Vector1, Vector2};

    use super::step;
    use crate::scalar::{Dual, Scalar};

    #[test]
    fn a_pair_that_does_not_couple_is_two_single_states() {
        let mut both = Vector2::new(0.3_f64, -0.2);
        let (mut first, mut second) = (Vector1::new(0.3_f64), Vector1::new(-0.2_f64));
        let slopes = Matrix2::new(-30.0, 0.0, 0.0, 0.5);
        step(&mut both, 0.1, &Vector2::new(2.0, -1.0), &slopes);
        step(&mut first, 0.1, &Vector1::new(2.0), &Matrix1::new(-30.0));
        step(&mut second, 0.1, &Vector1::new(-1.0), &Matrix1::new(0.5));
        // A few roundings of numbers near one.
        assert!((both[0] - first[0]).abs() < 1e-14 && (both[1] - second[0]).abs() < 1e-14);
    }

    #[test]
    fn an_oscillator_turns_by_its_angle() {
        // x'' = -w^2 x from x = 1.
        let (w, h) = (40.0_f64, 0.07);
        let mut z = Vector2::new(1.0, 0.0);
        let slopes = Matrix2::new(0.0, 1.0, -w * w, 0.0);
        let rate = slopes * z;
        step(&mut z, h, &rate, &slopes);
        assert!((z[0] - (w * h).cos()).abs() < 1e-12, "{z}");
        assert!((z[1] + w * (w * h).sin()).abs() < 1e-11, "{z}");
    }

    #[test]
    fn a_stiff_pair_comes_to_rest() {
        // Time constants of 1 us and 1 s, coupled, over 1000 s.
        let slopes = Matrix2::new(-1e6, 1e6, 0.0, -1.0);
        let mut z = Vector2::new(5.0, 2.0);
        let rate = slopes * z;
        step(&mut z, 1e3, &rate, &slopes);
        assert!(z.amax() < 1e-9, "{z}");
    }

    #[test]
    fn what_is_no_number_changes_nothing() {
        let mut z = Vector1::new(0.3);
        step(&mut z, 0.1, &Vector1::new(f64::NAN), &Matrix1::new(1.0));
        assert_eq!(z[0].to_bits(), 0.3_f64.to_bits());
        step(&mut z, 0.1, &Vector1::new(2.0), &Matrix1::new(f64::NAN));
        assert!((z[0] - 0.5).abs() < 1e-15);
    }

    /// A slope that is no number leaves the value as it is.
    #[test]
    fn the_value_of_a_dual_step_is_that_of_the_step() {
        let stiff = |z: f64| -1000.0 - z.sqrt();
        let (mut plain, mut dual) = (Vector1::new(0.0), Vector1::new(Dual::variable(0.0_f64)));
        step(
            &mut plain,
            0.01,
            &Vector1::new(2.0),
            &Matrix1::new(stiff(0.0)),
        );
        let slope = -(Dual::variable(0.0_f64).sqrt() + 1000.0);
        assert!(slope.slope.is_infinite());
        step(
            &mut dual,
            0.01,
            &Vector1::new(Dual::of(2.0)),
            &Matrix1::new(slope),
        );
        assert!((dual[0].value - plain[0]).abs() < 1e-15, "{dual:?} {plain}");
    }

    /// `d/dJ` of `h phi(h J)` at `J = 0` is `h^2 / 2`.
    #[test]
    fn slopes_of_a_step_do_not_cancel() {
        for exponent in [-1e-17, -1e-12, -1e-3, -0.4, -0.6, -30.0] {
            let mut z = Vector1::new(Dual::of(0.0));
            step(
                &mut z,
                1.0,
                &Vector1::new(Dual::of(1.0)),
                &Matrix1::new(Dual::variable(exponent)),
            );
            let x: f64 = exponent;
            // (x e^x - e^x + 1) / x^2, by its series where that cancels.
            let wanted = if x.abs() < 0.01 {
                0.5 + x / 3.0 + x * x / 8.0
            } else {
                (x * x.exp() - x.exp_m1()) / (x * x)
            };
            assert!(
                (z[0].slope - wanted).abs() < 1e-9,
                "{exponent}: {z:?} {wanted}"
            );
        }
    }

    #[test]
    fn what_is_slow_moves_beside_what_is_endlessly_stiff() {
        let slopes = Matrix2::new(-1e19, 0.0, 0.0, -1.0);
        let mut z = Vector2::new(1.0_f64, 1.0);
        let rate = slopes * z;
        step(&mut z, 1.0, &rate, &slopes);
        assert!(
            z[0].abs() < 1e-6 && (z[1] - (-1.0_f64).exp()).abs() < 1e-9,
            "{z}"
        );
    }
}
