//! Loads under which links are displaced as they are.

use nalgebra::{DMatrix, DVector};
use robot_model::simulate::Instant;

use super::super::runner::matrix;
use super::{Carried, Springs};

impl Springs {
    /// What springs carry whose links are displaced by `x`.
    pub(super) fn at_displacements(
        &mut self,
        at: &Instant<'_>,
        x: &[f64],
        body: &[f64],
    ) -> Vec<Carried> {
        let before: Vec<f64> = self.joints.iter().map(|&joint| self.load[joint]).collect();
        self.load.copy_from_slice(body);
        if !self.is_coupled {
            return (0..x.len()).map(|k| self.one(at, k, x[k])).collect();
        }
        let before = if before.iter().all(|load| load.is_finite()) {
            before
        } else {
            vec![0.0; x.len()]
        };
        self.together(at, x, before)
            .or_else(|| self.in_turn(at, x))
            .unwrap_or_else(|| vec![Carried::NONE; x.len()])
    }

    /// Loads of coupled springs by Newton's steps from some loads on, halved where they lead away. None where a law jumps.
    fn together(
        &mut self,
        at: &Instant<'_>,
        x: &[f64],
        mut loads: Vec<f64>,
    ) -> Option<Vec<Carried>> {
        const STEPS: usize = 100;
        let (s, n) = (x.len(), self.load.len());
        let mut last: Option<(DVector<f64>, f64)> = None;
        for _ in 0..STEPS {
            for (&joint, load) in self.joints.iter().zip(&loads) {
                self.load[joint] = *load;
            }
            let found: Vec<(f64, f64)> =
                (0..s).map(|k| self.displacement(at, k, loads[k])).collect();
            let missing = DVector::from_fn(s, |k, _| x[k] - found[k].0);
            let slopes = self.slopes.run(at, &self.load);
            let by_load = matrix(slopes, 3 * s * n, s, n);
            let mut slopes = DMatrix::from_fn(s, s, |row, k| by_load[(row, self.joints[k])]);
            for k in 0..s {
                slopes[(k, k)] -= self.teeth[k];
            }
            // Rounding of displacements, whose parts may cancel.
            let part = |k: usize| {
                let parts = (0..s).map(|other| (slopes[(k, other)] * loads[other]).abs());
                x[k].abs() + parts.sum::<f64>()
            };
            let rounding = 8.0 * f64::EPSILON * (0..s).map(part).sum::<f64>();
            let size = missing.norm();
            if size <= rounding {
                let carried = loads.iter().zip(&found);
                let carried = carried.map(|(&load, (_, slope))| Carried {
                    load,
                    by_displacement: 1.0 / slope,
                });
                return Some(carried.collect());
            }
            let step = match &mut last {
                Some((step, before)) if size.is_nan() || size >= *before => {
                    *step *= 0.5;
                    if step.amax() == 0.0 {
                        return None;
                    }
                    -&*step
                }
                _ => {
                    let step = slopes.lu().solve(&missing)?;
                    last = Some((step.clone(), size));
                    step
                }
            };
            if !step.iter().all(|x| x.is_finite()) {
                return None;
            }
            loads
                .iter_mut()
                .zip(step.iter())
                .for_each(|(load, step)| *load += step);
        }
        None
    }

    /// The same spring by spring, each under the loads of the others: a descent of their energy, where they have one. None where that
    /// leads nowhere.
    fn in_turn(&mut self, at: &Instant<'_>, x: &[f64]) -> Option<Vec<Carried>> {
        /// Sweeps, and of the loads, what is no change.
        const SWEEPS: usize = 200;
        const STILL: f64 = 1e-13;
        for &joint in &self.joints {
            self.load[joint] = 0.0;
        }
        let mut before = vec![f64::NAN; x.len()];
        for _ in 0..SWEEPS {
            let mut found = Vec::with_capacity(x.len());
            for (k, x) in x.iter().enumerate() {
                let carried = self.one(at, k, *x);
                self.load[self.joints[k]] = carried.load;
                found.push(carried);
            }
            let size = found.iter().map(|found| found.load.abs()).sum::<f64>();
            if !size.is_finite() {
                return None;
            }
            let mut changes = found.iter().zip(&before);
            if changes.all(|(found, before)| (found.load - before).abs() <= STILL * size) {
                return Some(found);
            }
            before = found.iter().map(|found| found.load).collect();
        }
        None
    }

    /// What one spring carries under the loads of the others.
    fn one(&mut self, at: &Instant<'_>, k: usize, x: f64) -> Carried {
        /// Of Newton's steps and halvings.
        const STEPS: usize = 300;
        let [above, below] =
            [f64::MIN_POSITIVE, -f64::MIN_POSITIVE].map(|load| self.displacement(at, k, load));
        if above.0 <= x && x <= below.0 {
            // Beside what both loads, the least that there are, displace.
            let is_jump = below.0 - above.0 > f64::MIN_POSITIVE * (1.0 + 4.0 * above.1.abs());
            let is_gap = is_jump || above.1 == 0.0;
            return Carried {
                load: 0.0,
                by_displacement: if is_gap { 0.0 } else { 1.0 / above.1 },
            };
        }
        if !(above.0 - x).is_finite() || !(below.0 - x).is_finite() {
            return Carried::NONE;
        }
        let sign = if x < above.0 { 1.0 } else { -1.0 };
        let mut found = if sign > 0.0 { above } else { below };
        // Sizes of loads, and how much displacement is missing there.
        let mut missing = sign * (found.0 - x);
        let (mut low, mut high) = ((0.0, missing), (f64::INFINITY, f64::NEG_INFINITY));
        let (mut load, mut is_slow) = (0.0, false);
        for _ in 0..STEPS {
            // `missing` falls with the size of the load as `d` does with the load.
            let newton = load - missing / found.1;
            let is_newton = !is_slow && newton > low.0 && newton < high.0;
            let before = (load, missing.abs());
            load = if is_newton {
                newton
            } else if high.0.is_finite() {
                // Loads of all sizes are alike far from the end.
                (low.0.max(1e-9 * high.0) * high.0).sqrt()
            } else {
                10.0 * f64::max(low.0, 1e-3)
            };
            found = self.displacement(at, k, sign * load);
            missing = sign * (found.0 - x);
            if missing.is_nan() {
                return Carried::NONE;
            }
            is_slow = is_newton && missing.abs() > 0.5 * before.1;
            if missing > 0.0 {
                low = (load, missing);
            } else {
                high = (load, missing);
            }
            let width = 2.0 * f64::EPSILON * load;
            let is_still = is_newton && (load - before.0).abs() <= width;
            let is_there = missing == 0.0 || is_still;
            if is_there || high.0 - low.0 <= width {
                // A bracket closes around a jump, at which the link moves under the same load.
                let rounding = 1e-9 * (found.0.abs() + x.abs());
                let is_jump = low.1 - high.1 > rounding + 4.0 * found.1.abs() * (high.0 - low.0);
                let is_jump = is_jump && !is_there && high.1.is_finite();
                let by_displacement = if is_jump { 0.0 } else { 1.0 / found.1 };
                return Carried {
                    load: sign * load,
                    by_displacement,
                };
            }
        }
        Carried::NONE
    }
}
