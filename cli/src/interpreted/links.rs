//! Where links are and how they move, with joints and behind springs, as a simulation has them.

use nalgebra::{DMatrix, DVector};
use robot_model::simulate::Instant;
use robot_model_codegen::{Compiled, Driven};

use super::runner::{Numbers, Runner, matrix};
use super::springs::{Carried, SpringSlopes, Springs};
use crate::Error;

/// Links of an arm. Degrees of freedom are the joints, where motors and encoders are, and then the links behind springs.
#[derive(Debug, Clone)]
pub(super) struct Links {
    joints: usize,
    springs: Springs,
    /// Joints that place their links elsewhere.
    placed: Vec<usize>,
    place: Runner,
    place_slopes: Runner,
    /// Whether a link's place depends on time or on channels.
    pub is_timed: bool,
}

/// Slopes of the motion of links by that of all degrees of freedom, `n` by `n + s`.
pub(super) struct LinkSlopes {
    /// `d q_l / dq`, which is `d dq_l / d dq` and `d ddq_l / d ddq`, too.
    pub position: DMatrix<f64>,
    /// `d dq_l / dq`
    velocity: DMatrix<f64>,
    /// `d ddq_l / dq` and `d ddq_l / d dq`
    acceleration: [DMatrix<f64>; 2],
}

impl LinkSlopes {
    /// Slopes by `q`, `dq` and `ddq` of all degrees of freedom, from those by the same of links.
    pub fn onto(&self, [q, dq, ddq]: &[DMatrix<f64>; 3]) -> [DMatrix<f64>; 3] {
        [
            q * &self.position + dq * &self.velocity + ddq * &self.acceleration[0],
            dq * &self.position + ddq * &self.acceleration[1],
            ddq * &self.position,
        ]
    }
}

/// A step against a slope of an energy with curvature `slopes`, which is raised until the energy is a valley. `None` where there is
/// nothing to go down.
fn downhill(slopes: &DMatrix<f64>, slope: &DVector<f64>) -> Option<DVector<f64>> {
    if slope.amax() == 0.0 {
        return None;
    }
    let size = slopes.amax().max(slope.amax());
    let raised = std::iter::successors(Some(0.0), |raised: &f64| {
        Some((10.0 * raised).max(1e-9 * size))
    });
    raised.take(16).find_map(|raised| {
        let matrix = slopes + DMatrix::identity(slope.len(), slope.len()) * raised;
        let step = matrix.cholesky()?.solve(&-slope);
        step.iter().all(|x| x.is_finite()).then_some(step)
    })
}

impl Links {
    pub fn new(compiled: &Compiled, numbers: &Numbers) -> Result<Self, Error> {
        let linkage = compiled.linkage();
        let is_rigid = linkage.springs.is_empty() && linkage.placed.is_empty();
        if let (false, Some(name)) = (is_rigid, compiled.mixed().first()) {
            return Err(Error::Argument(format!(
                "{}: motors and links move separately, but base parameter `{name}` sums both; give standard parameters",
                compiled.model.source
            )));
        }
        Ok(Self {
            joints: compiled.dof(),
            springs: Springs::new(&linkage, compiled, numbers)?,
            placed: linkage.placed,
            place: Runner::new(linkage.place, numbers),
            place_slopes: Runner::new(linkage.place_slopes, numbers),
            is_timed: linkage.is_timed,
        })
    }

    /// Gives teeth to springs that do not give; `inertia` has all degrees of freedom, each by itself.
    pub fn set_teeth(&mut self, compiled: &Compiled, inertia: &[f64]) {
        self.springs.set_teeth(compiled, inertia);
    }

    /// Degrees of freedom of both sides.
    pub fn dof(&self) -> usize {
        self.joints + self.springs.joints.len()
    }

    /// Whether all links are where their joints are.
    pub fn is_at_joints(&self) -> bool {
        self.springs.joints.is_empty() && self.placed.is_empty()
    }

    /// The joint of a degree of freedom.
    pub fn joint(&self, coordinate: usize) -> usize {
        let behind = coordinate.checked_sub(self.joints);
        behind.map_or(coordinate, |k| self.springs.joints[k])
    }

    /// The joints with a spring.
    pub fn sprung(&self) -> &[usize] {
        &self.springs.joints
    }

    /// The degree of freedom that each link moves with.
    pub fn coordinates(&self) -> Vec<usize> {
        let mut coordinates: Vec<usize> = (0..self.joints).collect();
        for (k, &joint) in self.springs.joints.iter().enumerate() {
            coordinates[joint] = self.joints + k;
        }
        coordinates
    }

    /// Position, velocity and acceleration of links. Where an instant has joints alone, links are where their motors are.
    pub fn motion(&mut self, at: &Instant<'_>) -> [Vec<f64>; 3] {
        let mut coordinates = self.coordinates();
        if at.q.len() == self.joints {
            coordinates = (0..self.joints).collect();
        }
        let of_links = |values: &[f64]| coordinates.iter().map(|&k| values[k]).collect();
        let mut motion: [Vec<f64>; 3] = [at.q, at.dq, at.ddq].map(of_links);
        if !self.placed.is_empty() {
            let found = self.place.run(at, &[]);
            for (order, values) in motion.iter_mut().enumerate() {
                for (k, &joint) in self.placed.iter().enumerate() {
                    values[joint] += found.output(order * self.placed.len() + k);
                }
            }
        }
        motion
    }

    /// Positions of links; only positions are read of the motion.
    fn positions(&mut self, at: &Instant<'_>) -> Vec<f64> {
        let still = vec![0.0; at.q.len()];
        let [q, ..] = self.motion(&Instant {
            dq: &still,
            ddq: &still,
            ..*at
        });
        q
    }

    /// Slopes of [`Self::motion`].
    pub fn slopes(&mut self, at: &Instant<'_>) -> LinkSlopes {
        let (n, k, dof) = (self.joints, self.placed.len(), self.dof());
        let mut position = DMatrix::zeros(n, dof);
        for (joint, coordinate) in self.coordinates().into_iter().enumerate() {
            position[(joint, coordinate)] = 1.0;
        }
        let mut slopes = LinkSlopes {
            position,
            velocity: DMatrix::zeros(n, dof),
            acceleration: [DMatrix::zeros(n, dof), DMatrix::zeros(n, dof)],
        };
        if k > 0 {
            let found = self.place_slopes.run(at, &[]);
            let LinkSlopes {
                position,
                velocity,
                acceleration: [by_position, by_velocity],
            } = &mut slopes;
            let all = [position, velocity, by_position, by_velocity];
            for (part, slopes) in all.into_iter().enumerate() {
                let more = matrix(found, part * k * n, k, n);
                for (row, &joint) in self.placed.iter().enumerate() {
                    let mut own = slopes.view_mut((joint, 0), (1, n));
                    own += more.row(row);
                }
            }
        }
        slopes
    }

    /// Joints that place their links elsewhere.
    pub fn placed(&self) -> &[usize] {
        &self.placed
    }

    /// Slopes of the position, velocity and acceleration of all links by what moves those of the placed ones, one below the other, by
    /// `place`. `None` where no joint places its link.
    pub fn placed_slopes(&self, place: &DMatrix<f64>) -> Option<[DMatrix<f64>; 3]> {
        let count = self.placed.len();
        let spread = |order: usize| {
            let mut slopes = DMatrix::zeros(self.joints, place.ncols());
            for (k, &joint) in self.placed.iter().enumerate() {
                slopes.set_row(joint, &place.row(order * count + k));
            }
            slopes
        };
        (count > 0).then(|| [0, 1, 2].map(spread))
    }

    pub fn runners(&mut self) -> impl Iterator<Item = &mut Runner> {
        let own = [&mut self.place, &mut self.place_slopes];
        own.into_iter().chain(self.springs.runners())
    }

    /// How springs follow accelerations.
    pub fn driven(&self) -> Driven {
        self.springs.driven
    }

    /// What springs carry, where links have the load `body`.
    pub fn carried(&mut self, at: &Instant<'_>, body: &[f64]) -> Vec<Carried> {
        self.springs.carried(at, body)
    }

    /// Slopes of what springs carry.
    pub fn carried_slopes(
        &mut self,
        at: &Instant<'_>,
        carried: &[Carried],
        body: &[f64],
    ) -> SpringSlopes {
        self.springs.slopes(at, carried, body)
    }

    /// Puts what springs carry in place of the load of their joints, and gives what is then missing at each link behind one.
    pub fn carry(&self, carried: &[Carried], load: &mut [f64]) -> Vec<f64> {
        let rests = self.springs.joints.iter().zip(carried);
        let rests = rests.map(|(&joint, carried)| {
            std::mem::replace(&mut load[joint], carried.load) - carried.load
        });
        rests.collect()
    }

    /// Slopes of loads and rests, in [`Self::carry`]'s order, one row each: `body` has those of the loads of links, `carried` of
    /// springs.
    pub fn sides(&self, body: &DMatrix<f64>, carried: &DMatrix<f64>) -> DMatrix<f64> {
        let mut sides = body.clone().resize_vertically(self.dof(), 0.0);
        for (k, &joint) in self.springs.joints.iter().enumerate() {
            let own = carried.row(k);
            sides.set_row(self.joints + k, &(body.row(joint) - own));
            sides.set_row(joint, &own);
        }
        sides
    }

    /// Positions of all where links hang quietly behind motors as at an instant; `torque` is that of the rigid body with its
    /// links at a position, without forces of the world and with them. Where several places are quiet, one whose energy is least around it, where springs follow their own loads alone.
    pub fn hang(
        &mut self,
        motors: &Instant<'_>,
        mut torque: impl FnMut(&[f64]) -> [Vec<f64>; 2],
    ) -> Vec<f64> {
        /// Newton's steps, and rad or m that are no step.
        const STEPS: usize = 200;
        const STILL: f64 = 1e-13;
        /// For slopes of the rigid body's torque.
        const NEAR: f64 = 1e-6;
        let (joints, count) = (self.joints, self.springs.joints.len());
        let mut q = motors.q.to_vec();
        q.extend(self.springs.joints.iter().map(|&joint| motors.q[joint]));
        if count == 0 {
            return q;
        }
        let has_energy = !self.springs.is_coupled && self.driven() == Driven::Not;
        // What pulls links away: where springs follow their own loads alone, the slope of an energy by their positions.
        let mut pull = |q: &[f64]| -> DVector<f64> {
            let at = Instant { q, ..*motors };
            let [body, mut load] = torque(&self.positions(&at));
            let carried = self.carried(&at, &body);
            DVector::from_vec(self.carry(&carried, &mut load))
        };
        let mut now = pull(&q);
        for _ in 0..STEPS {
            let mut slopes = DMatrix::zeros(count, count);
            for k in 0..count {
                let mut side = |sign: f64| {
                    let mut near = q.clone();
                    near[joints + k] += sign * NEAR;
                    pull(&near)
                };
                slopes.set_column(k, &((side(1.0) - side(-1.0)) / (2.0 * NEAR)));
            }
            let valley = |slopes: &DMatrix<f64>| {
                let step = downhill(&((slopes + slopes.transpose()) * 0.5), &now)?;
                Some((step, true))
            };
            let newton = |slopes: &DMatrix<f64>| {
                let step = slopes.clone().lu().solve(&-&now)?;
                let is_step = step.iter().all(|x| x.is_finite());
                is_step.then_some((step, false))
            };
            let step = if has_energy {
                valley(&slopes)
            } else {
                // Within a gap there is no slope.
                newton(&slopes).or_else(|| valley(&slopes))
            };
            let Some((mut step, is_downhill)) = step else {
                break;
            };
            // Not beyond the lowest place along the step, or to where more is missing.
            let mut next = q.clone();
            let before = now.norm();
            loop {
                for k in 0..count {
                    next[joints + k] = q[joints + k] + step[k];
                }
                now = pull(&next);
                let is_lower = if is_downhill {
                    now.dot(&step) <= 1e-9 * now.norm() * step.norm()
                } else {
                    now.norm() < before
                };
                if is_lower || step.amax() <= STILL || !now.norm().is_finite() {
                    break;
                }
                step *= 0.5;
            }
            q = next;
            if step.amax() <= STILL {
                break;
            }
        }
        q
    }

    /// An inertia of all degrees of freedom as joints move it, links with them.
    pub fn of_joints(&self, inertia: &DMatrix<f64>) -> DMatrix<f64> {
        let mut moved = DMatrix::zeros(self.joints, self.joints);
        for row in 0..self.dof() {
            for column in 0..self.dof() {
                moved[(self.joint(row), self.joint(column))] += inertia[(row, column)];
            }
        }
        moved
    }
}
