//! Where sides of jumps end: joints that stop, turn round or break away.
//!
//! In: a step of high order at whose end a motion is beyond the sides of some jumps. Out: the motion at the first such instant,
//! to rounding, with what sticks there decided anew; where they crowd, the motion after a step of impulses.

use nalgebra::DVector;

use super::steps::Start;
use super::{Integrator, REACH};
use crate::simulate::error::SimulateError;
use crate::simulate::motion::{Side, ZERO};
use crate::simulate::plant::Plant;
use crate::simulate::tangent::{Passage, Watch};

impl<P: Plant> Integrator<P> {
    /// How far each switch is from the end of its side: negative beyond it.
    fn margins(&mut self, time: f64, x: &DVector<f64>) -> Result<Vec<f64>, SimulateError> {
        let arguments = self.moving.arguments(time, x);
        if self.moving.holds_any() {
            self.moving.rate(time, x)?;
        }
        let sides = self.moving.sides.iter().enumerate();
        let margins = sides.map(|(k, side)| match side {
            Side::Free(sign) => sign * arguments[k],
            Side::Held => 1.0 - self.moving.shares[k].abs(),
            // It follows those that hold with it.
            Side::Shared(_) => 1.0,
        });
        Ok(margins.collect())
    }

    /// Switches whose side ends before the end of a step.
    pub(super) fn passed(
        &mut self,
        time: f64,
        end: &DVector<f64>,
    ) -> Result<Vec<usize>, SimulateError> {
        if self.moving.sides.is_empty() {
            return Ok(Vec::new());
        }
        let margins = self.margins(time, end)?;
        let passed = |k: &usize| margins[*k] < -0.1 * ZERO;
        Ok((0..margins.len()).filter(passed).collect())
    }

    /// Goes to the first of events in a step.
    pub(super) fn event(
        &mut self,
        from: &Start,
        h: f64,
        end: DVector<f64>,
        passed: &[usize],
        watch: &mut impl Watch<P>,
    ) -> Result<(), SimulateError> {
        let start = self.time;
        let margin =
            |integrator: &mut Self, share: f64| -> Result<(f64, DVector<f64>), SimulateError> {
                let x = integrator.trial(from, share * h)?.end;
                let margins = integrator.margins(start + share * h, &x)?;
                let least = passed
                    .iter()
                    .map(|&k| margins[k])
                    .fold(f64::INFINITY, f64::min);
                Ok((least, x))
            };
        let margins = self.margins(start + h, &end)?;
        let beyond = passed
            .iter()
            .map(|&k| margins[k])
            .fold(f64::INFINITY, f64::min);
        let (mut low, mut at_low) = (0.0, 0.0);
        let (mut high, mut at_high, mut x) = (1.0, beyond, end);
        // What has just begun to move has no margin yet: the first share at which it has one.
        let begins = self.margins(start, &self.x.clone())?;
        let least = passed
            .iter()
            .map(|&k| begins[k])
            .fold(f64::INFINITY, f64::min);
        if least > ZERO {
            at_low = least;
        } else {
            let mut share = 0.5;
            while share * h > 0.1 * self.tolerances.floor {
                let (value, place) = margin(self, share)?;
                if value > 0.0 {
                    (low, at_low) = (share, value);
                    break;
                }
                (high, at_high, x) = (share, value, place);
                share *= 0.5;
            }
        }
        // Illinois: secants that halve the weight of an end that stays.
        let mut last = 0;
        for _ in 0..80 {
            if at_high.abs() < 1e-15 || (high - low) * h < 1e-15 * start.abs().max(1e-3) {
                break;
            }
            let mut share = (low * at_high - high * at_low) / (at_high - at_low);
            if !(share > low && share < high) {
                share = 0.5 * (low + high);
            }
            let (value, place) = margin(self, share)?;
            if value > 0.0 {
                (low, at_low) = (share, value);
                if last == 1 {
                    at_high *= 0.5;
                }
                last = 1;
            } else {
                (high, at_high, x) = (share, value, place);
                if last == -1 {
                    at_low *= 0.5;
                }
                last = -1;
            }
        }
        let at = high * h;
        let step = Passage {
            start,
            length: at,
            x: &self.x,
            y: &x,
            is_explicit: !self.is_stiff,
        };
        watch.moved(&mut self.moving, &step)?;
        self.x = x;
        self.time = start + at;
        // The step is not to be blamed for the event.
        self.step = self.step.max(h);
        self.work.events += 1;
        if at < self.reach && start - self.last_event <= self.reach {
            self.crowd += 1;
        }
        self.last_event = self.time;
        let margins = self.margins(self.time, &self.x.clone())?;
        let first = passed
            .iter()
            .min_by(|&&i, &&k| margins[i].total_cmp(&margins[k]));
        if let Some(&first) = first {
            watch.arrived(&mut self.moving, self.time, &self.x, first)?;
        }
        for &k in passed {
            if let (Side::Free(sign), true) = (self.moving.sides[k], margins[k] <= ZERO) {
                self.moving.sides[k] = Side::Free(-sign);
            }
        }
        self.moving.settle(self.time, &mut self.x)?;
        watch.left(&mut self.moving, self.time, &self.x)
    }

    /// A step of impulses.
    pub(super) fn impulse(
        &mut self,
        left: f64,
        watch: &mut impl Watch<P>,
    ) -> Result<(), SimulateError> {
        let h = self.reach.min(left);
        let end = self.moving.impulse(self.time, &self.x, h)?;
        let step = Passage {
            start: self.time,
            length: h,
            x: &self.x,
            y: &end,
            is_explicit: false,
        };
        watch.moved(&mut self.moving, &step)?;
        self.x = end;
        self.time += h;
        self.reach = (2.0 * self.reach).min(REACH * self.tolerances.floor);
        self.step = self.step.max(8.0 * self.tolerances.floor);
        self.crowd = self.crowd.saturating_sub(1);
        self.last_event = self.time;
        self.work.impulses += 1;
        self.moving.settle(self.time, &mut self.x)?;
        watch.left(&mut self.moving, self.time, &self.x)
    }
}
