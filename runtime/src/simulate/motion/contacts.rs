//! Which jumps hold: friction that stops a joint, and shares it with others that do.
//!
//! In: a motion on some of its jumps. Out: for each whether it is held there or on which side the motion goes on, so that what
//! is left of accelerations, or of velocities over a step of impulses, solves a complementarity problem.

use nalgebra::{DMatrix, DVector};

use super::newton::STEPS;
use super::{Moving, Side, ZERO, share_size};
use crate::simulate::complementarity;
use crate::simulate::error::SimulateError;
use crate::simulate::plant::Plant;

/// A contact this weak, relative to the strongest of the arm, holds nothing.
const WEAK: f64 = 1e-12;

/// Contacts that can hold: what is left of their accelerations is `r - D s`.
struct Contacts {
    d: DMatrix<f64>,
    r: DVector<f64>,
    holding: Vec<usize>,
    free: Unheld,
}

/// Accelerations without shares, and what each share takes off them.
struct Unheld {
    start: DVector<f64>,
    effect: DMatrix<f64>,
}

impl<P: Plant> Moving<P> {
    /// Takes the rests of velocities that are zero to within [`ZERO`] away, and decides for every jump on which the motion is
    /// whether it is held there, and else on which side it goes on.
    pub fn settle(&mut self, time: f64, x: &mut DVector<f64>) -> Result<(), SimulateError> {
        let arguments = self.arguments(time, x);
        let on: Vec<usize> = (0..arguments.len())
            .filter(|&k| arguments[k].abs() <= ZERO)
            .collect();
        for (k, side) in self.sides.iter_mut().enumerate() {
            if !on.contains(&k) {
                *side = Side::Free(arguments[k].signum());
            }
        }
        if on.is_empty() {
            return Ok(());
        }
        for (share, side) in self.shares.iter_mut().zip(&self.sides) {
            *share = match *side {
                Side::Free(sign) => sign,
                Side::Held | Side::Shared(_) => 0.0,
            };
        }
        self.with(time, x, |plant, at, _, _, jumps| plant.jumps(at, jumps));
        self.stop(&on, &arguments, x);
        self.ddq.fill(0.0);
        for step in 0..STEPS {
            let Contacts {
                d,
                r,
                holding,
                free,
            } = self.contacts(time, x, &on)?;
            let shares = complementarity::solve(&d, &r);
            let before = (self.ddq.clone(), self.shares.clone());
            let mut ddq = free.start;
            for (i, &k) in holding.iter().enumerate() {
                ddq.axpy(-shares[i], &free.effect.column(i).into_owned(), 1.0);
                self.shares[k] = shares[i];
            }
            self.ddq = ddq;
            for &k in on.iter().filter(|k| !holding.contains(k)) {
                let rate = (self.jumps.directions.row(k) * &self.ddq)[0] + self.jumps.drifts[k];
                if rate != 0.0 {
                    self.shares[k] = rate.signum();
                } else if self.shares[k] == 0.0 {
                    self.shares[k] = 1.0;
                }
            }
            // What holds nothing may change its side with the rounding of an acceleration: it counts by what it does to others.
            let shares = holding
                .iter()
                .map(|&k| (self.shares[k] - before.1[k]).abs());
            let moved = (&self.ddq - before.0).amax() + shares.fold(0.0, f64::max);
            let largest = self.ddq.amax() + share_size(&on);
            if step > 0 && moved <= 1e-9 * largest {
                self.choose_sides(&on, &holding, &d);
                return Ok(());
            }
        }
        Err(SimulateError::NoAcceleration { time })
    }

    /// Velocities for which the arguments on their jumps are zero.
    fn stop(&self, on: &[usize], arguments: &[f64], x: &mut DVector<f64>) {
        let dof = self.plant.dof();
        for &k in on {
            if let Some(joint) = self.lone_joint(k) {
                let speed = x[dof + joint] - arguments[k] / self.jumps.directions[(k, joint)];
                x[dof + joint] = if speed.abs() <= ZERO { 0.0 } else { speed };
            }
        }
    }

    /// What contacts do to each other.
    fn contacts(
        &mut self,
        time: f64,
        x: &DVector<f64>,
        on: &[usize],
    ) -> Result<Contacts, SimulateError> {
        self.evaluations += 1;
        self.with(time, x, |plant, at, torque, inertia, jumps| {
            plant.torque(at, torque, inertia);
            plant.jumps(at, jumps);
        });
        let halves = self.jumps.halves.select_columns(on);
        let directions = self.jumps.directions.select_rows(on);
        let rest = DVector::from_column_slice(&self.drive.torque) - &self.torque;
        let lu = self.inertia.clone().lu();
        let (Some(step), Some(effect)) = (lu.solve(&rest), lu.solve(&halves)) else {
            return Err(self.no_solution(time, x));
        };
        let held_back = &directions * &effect;
        let strongest = held_back.diagonal().amax();
        let (mut holding, mut places) = (Vec::new(), Vec::new());
        for (place, &k) in on.iter().enumerate() {
            if held_back[(place, place)] > WEAK * strongest {
                holding.push(k);
                places.push(place);
            }
        }
        let effect = effect.select_columns(&places);
        let directions = directions.select_rows(&places);
        let mut start = &self.ddq + step;
        for (i, &k) in holding.iter().enumerate() {
            start.axpy(self.shares[k], &effect.column(i).into_owned(), 1.0);
        }
        let drifts = DVector::from_fn(holding.len(), |i, _| self.jumps.drifts[holding[i]]);
        if !start.iter().all(|x| x.is_finite()) {
            return Err(self.no_solution(time, x));
        }
        Ok(Contacts {
            d: &directions * &effect,
            r: &directions * &start + drifts,
            holding,
            free: Unheld { start, effect },
        })
    }

    /// Sides from shares: what is inside is held, and of contacts that hold the same thing some are enough.
    fn choose_sides(&mut self, on: &[usize], holding: &[usize], d: &DMatrix<f64>) {
        for &k in on {
            self.sides[k] = Side::Free(self.shares[k].signum());
        }
        let inside: Vec<usize> = (0..holding.len())
            .filter(|&i| self.shares[holding[i]].abs() < 1.0)
            .collect();
        let mut rest =
            DMatrix::from_fn(inside.len(), inside.len(), |i, j| d[(inside[i], inside[j])]);
        let mut open: Vec<usize> = (0..inside.len()).collect();
        while let Some(&pivot) = open
            .iter()
            .max_by(|&&i, &&j| rest[(i, i)].total_cmp(&rest[(j, j)]))
        {
            let k = inside[pivot];
            if rest[(pivot, pivot)] <= 1e-10 * d[(k, k)] {
                for &i in &open {
                    let switch = holding[inside[i]];
                    self.sides[switch] = Side::Shared(self.shares[switch]);
                }
                break;
            }
            self.sides[holding[k]] = Side::Held;
            open.retain(|&i| i != pivot);
            for &i in &open {
                let factor = rest[(i, pivot)] / rest[(pivot, pivot)];
                for &j in &open {
                    rest[(i, j)] -= factor * rest[(pivot, j)];
                }
            }
        }
    }

    /// A step of the first order over impulses: linearly implicit in all that is smooth, and with those shares of all jumps that
    /// hold velocities where they come to rest in it (Moreau). It needs no event, however many there are.
    pub fn impulse(
        &mut self,
        time: f64,
        x: &DVector<f64>,
        h: f64,
    ) -> Result<DVector<f64>, SimulateError> {
        let dof = self.plant.dof();
        // No contact holds; where one stands it starts with no share.
        for side in &mut self.sides {
            if *side == Side::Held {
                *side = Side::Shared(0.0);
            }
        }
        let (rate, jacobian) = self.linearized(time, x)?;
        let arguments = self.arguments(time, x);
        self.with(time, x, |plant, at, _, _, jumps| plant.jumps(at, jumps));
        let lu = (DMatrix::identity(x.len(), x.len()) - jacobian * h).lu();
        let mut effect = DMatrix::zeros(x.len(), arguments.len());
        let Some(accelerations) = self.inertia.clone().lu().solve(&self.jumps.halves) else {
            return Err(SimulateError::NoInertia { time });
        };
        effect
            .view_mut((dof, 0), (dof, arguments.len()))
            .copy_from(&(accelerations * h));
        let mut step = rate * h;
        if !lu.solve_mut(&mut step) || !lu.solve_mut(&mut effect) {
            return Err(SimulateError::NoAcceleration { time });
        }
        let speeds = effect.rows(dof, dof);
        let held_back = &self.jumps.directions * speeds;
        let strongest = held_back.diagonal().amax();
        let holding: Vec<usize> = (0..arguments.len())
            .filter(|&k| held_back[(k, k)] > WEAK * strongest)
            .collect();
        let moves = &self.jumps.directions * step.rows(dof, dof);
        let d = DMatrix::from_fn(holding.len(), holding.len(), |i, j| {
            held_back[(holding[i], holding[j])]
        });
        let before = DVector::from_fn(holding.len(), |i, _| self.shares[holding[i]]);
        let after = DVector::from_fn(holding.len(), |i, _| {
            let k = holding[i];
            arguments[k] + moves[k] + h * self.jumps.drifts[k]
        });
        let shares = complementarity::solve(&d, &(after + &d * &before));
        let mut end = x + step;
        for (i, &k) in holding.iter().enumerate() {
            end.axpy(before[i] - shares[i], &effect.column(k).into_owned(), 1.0);
            // What has come to rest stands.
            if let (Some(joint), true) = (self.lone_joint(k), shares[i].abs() < 1.0)
                && end[dof + joint].abs() < 1e-9
            {
                end[dof + joint] = 0.0;
            }
        }
        Ok(end)
    }
}
