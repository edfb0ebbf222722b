//! How what springs carry changes with the motion.

use nalgebra::{DMatrix, DVector};
use robot_model::simulate::Instant;

use super::super::runner::matrix;
use super::{Carried, Springs};

/// Slopes of what springs carry, one row a spring.
pub(in crate::interpreted) struct SpringSlopes {
    /// By displacements of links, `s` columns.
    by_displacement: DMatrix<f64>,
    /// By `q`, `dq` and `ddq` of all degrees of freedom.
    pub by: [DMatrix<f64>; 3],
    /// By internal states.
    pub by_state: DMatrix<f64>,
    /// By loads of joints, which is zero for those with springs.
    pub by_load: DMatrix<f64>,
}

impl Springs {
    /// `d(x - d)/dt` by velocities of all degrees of freedom, one row a spring: what positions and loads of other springs, which move with
    /// positions, displace a link by is no motion against its teeth.
    pub(super) fn led_rates(
        &self,
        found: &[Carried],
        by_q: &DMatrix<f64>,
        by_load: &DMatrix<f64>,
    ) -> DMatrix<f64> {
        let (s, n) = (self.joints.len(), self.load.len());
        let x = DMatrix::from_fn(s, n + s, |k, column| match column {
            link if link == n + k => 1.0,
            joint if joint == self.joints[k] => -1.0,
            _ => 0.0,
        });
        let by_q = by_q.clone().resize_horizontally(n + s, 0.0);
        let others = DMatrix::from_fn(s, s, |row, k| {
            if row == k {
                0.0
            } else {
                by_load[(row, self.joints[k])] * found[k].by_displacement
            }
        });
        let against = x - by_q;
        &against - others * &against
    }

    /// Slopes of displacements by `q`, `dq`, `ddq`, loads and `z`, where springs carry that.
    pub(super) fn give_slopes(
        &mut self,
        at: &Instant<'_>,
        carried: &[Carried],
        body: &[f64],
    ) -> [DMatrix<f64>; 5] {
        self.load.copy_from_slice(body);
        for (&joint, carried) in self.joints.iter().zip(carried) {
            self.load[joint] = carried.load;
        }
        let (s, n, p) = (self.joints.len(), self.load.len(), self.states);
        let found = self.slopes.run(at, &self.load);
        let [q, dq, ddq, load] = [0, 1, 2, 3].map(|part| matrix(found, part * s * n, s, n));
        [q, dq, ddq, load, matrix(found, 4 * s * n, s, p)]
    }

    /// Slopes of what springs carry, those by the motion by that of all degrees of freedom. How the rate that teeth are damped by changes with
    /// positions is left out.
    pub fn slopes(&mut self, at: &Instant<'_>, carried: &[Carried], body: &[f64]) -> SpringSlopes {
        let (s, n) = (self.joints.len(), self.load.len());
        let [q, dq, ddq, mut load, state] = self.give_slopes(at, carried, body);
        let rates = self.led_rates(carried, &q, &load);
        // `dT_k = b_k (dx_k - sum over j beside k of d_kj dT_j - ..)`, with `b` the slopes by displacements.
        let own = DVector::from_iterator(s, carried.iter().map(|carried| carried.by_displacement));
        let mut by_displacement = DMatrix::from_diagonal(&own);
        if self.is_coupled {
            let mut others = DMatrix::identity(s, s);
            for row in 0..s {
                for column in (0..s).filter(|&column| column != row) {
                    others[(row, column)] = own[row] * load[(row, self.joints[column])];
                }
            }
            let solved = others.lu().solve(&by_displacement);
            by_displacement = solved.unwrap_or_else(|| DMatrix::from_element(s, s, f64::NAN));
        }
        for &joint in &self.joints {
            load.column_mut(joint).fill(0.0);
        }
        let [mut q, mut dq, ddq] =
            [q, dq, ddq].map(|give| -(&by_displacement * give).resize_horizontally(n + s, 0.0));
        for (k, &joint) in self.joints.iter().enumerate() {
            let own = by_displacement.column(k);
            let mut link = q.column_mut(n + k);
            link += own;
            let mut motor = q.column_mut(joint);
            motor -= own;
        }
        dq += &by_displacement
            * DMatrix::from_diagonal(&DVector::from_column_slice(&self.lag))
            * rates;
        SpringSlopes {
            by_state: -(&by_displacement * state),
            by: [q, dq, ddq],
            by_load: -(&by_displacement * load),
            by_displacement,
        }
    }
}

impl SpringSlopes {
    /// By the `order`-th of `q`, `dq` and `ddq` while links move, whose loads have the slopes `rigid` by that.
    pub fn along(&self, order: usize, rigid: &DMatrix<f64>) -> DMatrix<f64> {
        &self.by[order] + &self.by_load * rigid
    }

    /// Slopes by what moves displacements by `give`, one row a spring, while links stay where they are.
    pub fn through(&self, give: &DMatrix<f64>) -> DMatrix<f64> {
        -(&self.by_displacement * give)
    }
}
