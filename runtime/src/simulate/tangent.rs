//! How a motion changes with what is unknown in it: exact sensitivities beside the motion itself.
//!
//! `S = dx/du` follows `dS/dt = f_x S + f_u` along each step between events: by the slopes of the explicit step itself; where the motion is
//! stiff or the step short, by a rule of order four that is stable there (Lobatto IIIA); where it is very short, as between samples of a fast
//! log, with the slopes of its middle (Magnus' expansion, of order two), if a search is content with that. At an event, whose instant moves
//! with the unknowns, it jumps:
//! `S+ = S- - (f- - f+) (g_x S- + g_u) / (dg/dt)-`, so that the velocity of a joint that comes to rest has no slope left.
//!
//! Source: Galan, Feehery, Barton 1999, Parametric sensitivity functions for hybrid discrete/continuous systems.

use nalgebra::{DMatrix, DVector};

use super::adjustable::{Adjustable, ParameterSlopes};
use super::error::SimulateError;
use super::explicit;
use super::motion::{Moving, Side};

/// A step between events, from `x` to `y`.
pub(super) struct Passage<'a> {
    pub start: f64,
    pub length: f64,
    pub x: &'a DVector<f64>,
    pub y: &'a DVector<f64>,
    pub is_explicit: bool,
}

/// Steps times the fastest rate of the motion: shorter ones are not worth the stages of an explicit step.
const SHORT: f64 = 0.02;

/// Those as short as this may take the slopes of their middle. What these turn on the way is left out, of second order in the step: where a
/// torque bends within one, as that of cogs that are passed fast, more is than elsewhere.
const BRIEF: f64 = 0.1;

/// The same from where on an explicit step is not surely stable: what a step's error hardly shows of a stiff state that has settled, as of
/// bristles under a joint that slides, would grow in sensitivities.
const STIFF: f64 = 2.0;

/// Fastest rate of a motion whose slope by its state is this, 1/s.
fn fastest(by_state: &DMatrix<f64>) -> f64 {
    (by_state * by_state).norm().sqrt()
}

/// What looks on while a plant moves; by itself it does nothing.
pub(super) trait Watch<P> {
    /// A step without events went from one state to another; sides are those of the step.
    fn moved(&mut self, _: &mut Moving<P>, _: &Passage<'_>) -> Result<(), SimulateError> {
        Ok(())
    }

    /// A motion has come to the jump of a switch; sides are still those before it.
    fn arrived(
        &mut self,
        _: &mut Moving<P>,
        _time: f64,
        _x: &DVector<f64>,
        _switch: usize,
    ) -> Result<(), SimulateError> {
        Ok(())
    }

    /// Sides are those after an event.
    fn left(
        &mut self,
        _: &mut Moving<P>,
        _time: f64,
        _x: &DVector<f64>,
    ) -> Result<(), SimulateError> {
        Ok(())
    }
}

/// Nobody looks on.
impl<P> Watch<P> for () {}

/// Sensitivities of a motion. Unknowns are the parameters of the plant, and whatever else the start or the drive depends on.
#[derive(Debug, Clone)]
pub struct Tangent {
    /// `dx/du`: positions, velocities and internal states, a column an unknown. Its first columns are those of the parameters.
    pub state: DMatrix<f64>,
    /// Slope of the torque that is held, a row a joint.
    pub drive: DMatrix<f64>,
    slopes: ParameterSlopes,
    /// Fastest rate of the motion in the last step, 1/s; infinite where none tells.
    fastest: f64,
    is_coarse: bool,
    /// At an event: the rate before it, and by how much its instant moves with each unknown.
    arrival: Option<(DVector<f64>, DVector<f64>)>,
}

impl Tangent {
    /// Where only the start depends on unknowns, as `state` says.
    ///
    /// # Examples
    /// How far a block goes changes with its mass: `q = F t^2 / (2 m)`, so `dq/dm = -q / m`.
    /// ```
    /// # mod block { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/block.rs")); }
    /// # use block::Block;
    /// use nalgebra::DMatrix;
    /// use robot_model::simulate::{Drive, Integrator, Tangent, Tolerances};
    /// let plant = Block([2.0, 0.0]);
    /// // Two rows, of position and velocity; unknown are `m` and `c`, on which the start does not depend.
    /// let mut tangent = Tangent::new(&plant, DMatrix::zeros(2, 2));
    /// let mut block = Integrator::new(plant, &[0.0], &[0.0], Tolerances::default())?;
    /// block.drive(Drive { torque: vec![4.0], ..Drive::default() });
    /// block.advance_with(3.0, &mut tangent)?;
    /// assert!((block.q()[0] - 9.0).abs() < 1e-9);
    /// assert!((tangent.state[(0, 0)] + 4.5).abs() < 1e-9);
    /// # Ok::<(), robot_model::simulate::SimulateError>(())
    /// ```
    #[must_use]
    pub fn new(plant: &impl Adjustable, state: DMatrix<f64>) -> Self {
        Self {
            drive: DMatrix::zeros(plant.joints(), state.ncols()),
            slopes: ParameterSlopes::zeros(plant),
            fastest: f64::INFINITY,
            is_coarse: false,
            state,
            arrival: None,
        }
    }

    /// The same by a rule of order two where steps are short, as between samples of a fast log: enough to search with, at half the work.
    ///
    /// # Examples
    /// ```
    /// # mod block { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/block.rs")); }
    /// use robot_model::simulate::Tangent;
    /// // dq = v exp(-c t / m), so d dq / dc = -t dq / m; unknown are m and c, on which the start does not depend.
    /// let mut tangent = Tangent::new(&block::Block([2.0, 0.7]), nalgebra::DMatrix::zeros(2, 2)).coarse();
    /// let mut block = block::sliding();
    /// for sample in 1..=100 {
    ///     block.advance_with(0.01 * f64::from(sample), &mut tangent)?;
    /// }
    /// let off = (tangent.state[(1, 1)] / (-0.5 * block.dq()[0]) - 1.0).abs();
    /// assert!(off < 1e-4 && off > 1e-12, "{off}");
    /// # Ok::<(), robot_model::simulate::SimulateError>(())
    /// ```
    #[must_use]
    pub fn coarse(mut self) -> Self {
        self.is_coarse = true;
        self
    }

    /// `f`, `f_x` and `f_u` at a state.
    fn linear<P: Adjustable>(
        &mut self,
        moving: &mut Moving<P>,
        time: f64,
        x: &DVector<f64>,
    ) -> Result<[DMatrix<f64>; 3], SimulateError> {
        let linear = moving.linearize(time, x)?;
        moving.parameter_slopes(time, x, &mut self.slopes);
        let unknowns = self.state.ncols();
        let mut torque = -&self.slopes.torque;
        torque.resize_horizontally_mut(unknowns, 0.0);
        let mut driven = torque.rows_mut(0, self.drive.nrows());
        driven += &self.drive;
        let mut rates = self.slopes.rates.clone();
        rates.resize_horizontally_mut(unknowns, 0.0);
        let by_unknowns = moving.by_unknowns(time, &linear, &torque, &rates)?;
        let rate = DMatrix::from_column_slice(x.len(), 1, linear.rate.as_slice());
        Ok([rate, linear.jacobian, by_unknowns])
    }

    /// The slope of an explicit step, stage by stage.
    fn staged<P: Adjustable>(
        &mut self,
        moving: &mut Moving<P>,
        step: &Passage<'_>,
        [rate, by_state, by_unknowns]: [DMatrix<f64>; 3],
    ) -> Result<(), SimulateError> {
        let h = step.length;
        let start = self.state.clone();
        let mut slopes = vec![by_state * &start + by_unknowns];
        let mut rates = vec![rate];
        for (weights, instant) in explicit::STAGES.iter().zip(explicit::INSTANTS) {
            let (mut x, mut tangent) = (step.x.clone(), start.clone());
            for ((weight, rate), slope) in weights.iter().zip(&rates).zip(&slopes) {
                x.axpy(h * weight, &rate.column(0), 1.0);
                tangent += slope * (h * weight);
            }
            if slopes.len() == explicit::STAGES.len() {
                self.state = tangent;
                break;
            }
            let [rate, by_state, by_unknowns] =
                self.linear(moving, step.start + instant * h, &x)?;
            slopes.push(by_state * tangent + by_unknowns);
            rates.push(rate);
        }
        Ok(())
    }

    /// `S1 = S0 + h phi(h f_x) (f_x S0 + f_u)`, `phi(x) = 1 + x/2 + x^2/6`, with slopes of the middle; false where these are of a motion that is
    /// too fast for that, and nothing is done.
    fn in_one<P: Adjustable>(
        &mut self,
        moving: &mut Moving<P>,
        step: &Passage<'_>,
    ) -> Result<bool, SimulateError> {
        let h = step.length;
        let middle = (step.x + step.y) * 0.5;
        let [_, by_state, by_unknowns] = self.linear(moving, step.start + 0.5 * h, &middle)?;
        self.fastest = fastest(&by_state);
        if h * self.fastest >= BRIEF {
            return Ok(false);
        }
        let mut term = by_unknowns;
        term.gemm(h, &by_state, &self.state, h);
        self.state += &term;
        for order in [2.0, 3.0] {
            term = &by_state * term * (h / order);
            self.state += &term;
        }
        Ok(true)
    }

    /// `S1 = S0 + h/6 (F0 + 4 Fm + F1)` with `Sm = (S0 + S1)/2 + h/8 (F0 - F1)` and `F = f_x S + f_u`.
    fn collocated<P: Adjustable>(
        &mut self,
        moving: &mut Moving<P>,
        step: &Passage<'_>,
        [first, a, b]: [DMatrix<f64>; 3],
    ) -> Result<(), SimulateError> {
        let Passage {
            start,
            length: h,
            x,
            y,
            ..
        } = *step;
        let [last, c, d] = self.linear(moving, start + h, y)?;
        // Hermite's cubic between the ends.
        let middle = (x + y) * 0.5 + (first - last).column(0) * (0.125 * h);
        let [_, m, n] = self.linear(moving, start + 0.5 * h, &middle)?;
        let one = DMatrix::identity(x.len(), x.len());
        let rate = &a * &self.state + &b;
        let half = &self.state * 0.5 + (&rate - &d) * (0.125 * h);
        let right = &self.state + (rate + d + (&m * half + n) * 4.0) * (h / 6.0);
        let matrix = &one - (&c + &m * (&one * 2.0 - &c * (0.5 * h))) * (h / 6.0);
        self.state = matrix
            .lu()
            .solve(&right)
            .ok_or(SimulateError::NoAcceleration { time: start })?;
        Ok(())
    }

    /// A joint that stands has no slope of its velocity.
    fn stand<P: Adjustable>(&mut self, moving: &Moving<P>) {
        let dof = moving.plant.dof();
        for joint in moving.standing() {
            self.state.row_mut(dof + joint).fill(0.0);
        }
    }
}

impl<P: Adjustable> Watch<P> for Tangent {
    fn moved(&mut self, moving: &mut Moving<P>, step: &Passage<'_>) -> Result<(), SimulateError> {
        let is_brief = self.is_coarse && step.length * self.fastest < BRIEF;
        if !(is_brief && self.in_one(moving, step)?) {
            let first = self.linear(moving, step.start, step.x)?;
            self.fastest = fastest(&first[1]);
            if step.is_explicit && (SHORT..STIFF).contains(&(step.length * self.fastest)) {
                self.staged(moving, step, first)?;
            } else {
                self.collocated(moving, step, first)?;
            }
        }
        self.stand(moving);
        Ok(())
    }

    fn arrived(
        &mut self,
        moving: &mut Moving<P>,
        time: f64,
        x: &DVector<f64>,
        switch: usize,
    ) -> Result<(), SimulateError> {
        // A joint breaks away where its torque has no jump: nothing is missing.
        if !matches!(moving.sides[switch], Side::Free(_)) {
            self.arrival = None;
            return Ok(());
        }
        let rate = moving.rate(time, x)?;
        moving.parameter_slopes(time, x, &mut self.slopes);
        let unknowns = self.slopes.arguments.ncols();
        let (mut by_unknowns, speed) = moving.argument_slopes(time, x, &rate, switch, &self.state);
        for u in 0..unknowns {
            by_unknowns[u] += self.slopes.arguments[(switch, u)];
        }
        // One that grazes its jump has no instant to speak of.
        let is_crossed = speed.abs() > 1e-9 * rate.amax();
        self.arrival = is_crossed.then(|| (rate, by_unknowns / -speed));
        Ok(())
    }

    fn left(
        &mut self,
        moving: &mut Moving<P>,
        time: f64,
        x: &DVector<f64>,
    ) -> Result<(), SimulateError> {
        self.fastest = f64::INFINITY;
        if let Some((before, instants)) = self.arrival.take() {
            let after = moving.rate(time, x)?;
            self.state += (before - after) * instants.transpose();
        }
        self.stand(moving);
        Ok(())
    }
}
