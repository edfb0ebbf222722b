//! Springs and gaps between motors and their links, as a simulation has them.
//!
//! A spec says where a link stands behind its encoder for the torque that it takes, `position(j) = -R/k - b sign(R)`. A motion has
//! that the other way round: both sides have an inertia and a place of their own, and the torque between them follows from how far
//! the motor is ahead.

use nalgebra::{DMatrix, DVector};
use robot_model_codegen::Compiled;
use robot_model_codegen::expr::Symbol;

use crate::Error;

/// A spring with play.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Transmission {
    joint: usize,
    /// `k`, N m/rad or N/m.
    stiffness: f64,
    /// `b`, rad or m.
    half_gap: f64,
}

/// Those of an arm. Degrees of freedom are the joints, where motors and encoders are, and then the links behind transmissions.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Transmissions {
    joints: usize,
    all: Vec<Transmission>,
}

impl Transmission {
    /// Torque on the link for a motor that is `lead` ahead.
    fn torque(&self, lead: f64) -> f64 {
        self.stiffness * (lead - lead.clamp(-self.half_gap, self.half_gap))
    }

    /// Slope of [`Self::torque`].
    fn slope(&self, lead: f64) -> f64 {
        if lead.abs() < self.half_gap {
            0.0
        } else {
            self.stiffness
        }
    }
}

/// Loads of all joints at once, so that none passes for another's.
fn tell_apart(joint: usize) -> f64 {
    1.0 + 0.1 * joint as f64
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

impl Transmissions {
    /// What the displacements of a spec are, for these shapes.
    pub fn new(compiled: &Compiled, shapes: &[f64]) -> Result<Self, Error> {
        let mut found = Self {
            joints: compiled.dof(),
            all: Vec::new(),
        };
        let Some(block) = compiled.displacements() else {
            return Ok(found);
        };
        let model = &compiled.model;
        let refuse = |what: &str| Err(Error::Argument(format!("{}: {what}", model.source)));
        if let Some(name) = compiled.mixed().first() {
            return refuse(&format!(
                "motors and links move apart, and base parameter `{name}` is of both; give standard parameters, whose values are \
                 known one by one"
            ));
        }
        // Whatever a displacement reads beside loads is no number, so that it fits nothing.
        let under = |load: f64| -> Vec<f64> {
            block.program.eval(&|symbol| match symbol {
                Symbol::RigidTorque(joint) => load * tell_apart(joint),
                Symbol::Shape(k) => shapes[k],
                _ => f64::NAN,
            })
        };
        let (one, two) = (under(1.0), under(2.0));
        let loads = (-6..=9).map(|power| 1.7 * 10_f64.powi(power));
        let probes: Vec<(f64, Vec<f64>)> = loads
            .flat_map(|load| [load, -load])
            .map(|load| (load, under(load)))
            .collect();
        for (k, &(joint, _)) in block.entries.iter().enumerate() {
            let name = &model.joints[joint].name;
            let compliance = (one[k] - two[k]) / tell_apart(joint);
            let half_gap = two[k] - 2.0 * one[k];
            // What is left of a difference is rounding.
            let half_gap = if half_gap.abs() <= 1e-12 * one[k].abs() {
                0.0
            } else {
                half_gap
            };
            let fits = probes.iter().all(|(load, found)| {
                let load = load * tell_apart(joint);
                let expected = -compliance * load - half_gap * load.signum();
                (found[k] - expected).abs() <= 1e-9 * expected.abs()
            });
            if !fits || compliance < 0.0 || half_gap < 0.0 {
                return refuse(&format!(
                    "joint {name}: only springs and gaps are simulated, `position(j) = -rigid_torque(j)/k - b * \
                     sign(rigid_torque(j))`; another displacement can be identified, not simulated"
                ));
            }
            if compliance > 0.0 {
                found.all.push(Transmission {
                    joint,
                    stiffness: 1.0 / compliance,
                    half_gap,
                });
            } else if half_gap > 0.0 {
                return refuse(&format!(
                    "joint {name}: teeth without any give are not simulated; declare `joint_elasticity` beside `backlash`"
                ));
            }
        }
        Ok(found)
    }

    /// Degrees of freedom of both sides.
    pub fn dof(&self) -> usize {
        self.joints + self.all.len()
    }

    /// The joint of a degree of freedom.
    pub fn joint(&self, coordinate: usize) -> usize {
        let behind = coordinate.checked_sub(self.joints);
        behind.map_or(coordinate, |k| self.all[k].joint)
    }

    /// The joints with a transmission.
    pub fn joints(&self) -> impl Iterator<Item = usize> {
        self.all.iter().map(|one| one.joint)
    }

    /// The degree of freedom of each link.
    pub fn links(&self) -> Vec<usize> {
        let mut links: Vec<usize> = (0..self.joints).collect();
        for (k, one) in self.all.iter().enumerate() {
            links[one.joint] = self.joints + k;
        }
        links
    }

    /// What links have of a quantity that all degrees of freedom have.
    pub fn of_links(&self, values: &[f64]) -> Vec<f64> {
        if values.is_empty() {
            return Vec::new();
        }
        self.links().iter().map(|&link| values[link]).collect()
    }

    /// How far each motor is ahead of its link.
    fn leads(&self, q: &[f64]) -> impl Iterator<Item = (&Transmission, f64)> {
        let links = self.all.iter().zip(&q[self.joints..]);
        links.map(|(one, link)| (one, q[one.joint] - link))
    }

    /// Puts what transmissions carry in place of the load of their joints, and gives what is then missing at each link behind one.
    pub fn carry(&self, q: &[f64], load: &mut [f64]) -> Vec<f64> {
        let rests = self.leads(q).map(|(one, lead)| {
            let carried = one.torque(lead);
            std::mem::replace(&mut load[one.joint], carried) - carried
        });
        rests.collect()
    }

    /// Slopes of loads and rests, in [`Self::carry`]'s order, one row each, by a quantity of all degrees of freedom, where the rigid
    /// body's torque has the slope `rigid` by that of its links. `is_position`: transmissions have a slope by it, too.
    pub fn slopes(&self, rigid: &DMatrix<f64>, q: &[f64], is_position: bool) -> DMatrix<f64> {
        let mut slopes = DMatrix::zeros(self.dof(), self.dof());
        for (joint, &link) in self.links().iter().enumerate() {
            for row in 0..self.joints {
                slopes[(row, link)] = rigid[(row, joint)];
            }
        }
        for (k, (one, lead)) in self.leads(q).enumerate() {
            let (joint, link) = (one.joint, self.joints + k);
            let body = slopes.row(joint).into_owned();
            slopes.row_mut(joint).fill(0.0);
            slopes.set_row(link, &body);
            if is_position {
                let slope = one.slope(lead);
                for (row, sign) in [(joint, 1.0), (link, -1.0)] {
                    slopes[(row, joint)] += sign * slope;
                    slopes[(row, link)] -= sign * slope;
                }
            }
        }
        slopes
    }

    /// Positions of all where links hang quietly behind motors that are at `motors`; `torque` is that of the rigid body with its
    /// links at a position. Where several places are quiet, one whose energy is least around it.
    pub fn hang(&self, motors: &[f64], mut torque: impl FnMut(&[f64]) -> Vec<f64>) -> Vec<f64> {
        /// Newton's steps, and rad or m that are no step.
        const STEPS: usize = 200;
        const STILL: f64 = 1e-13;
        /// For slopes of the rigid body's torque.
        const NEAR: f64 = 1e-6;
        let count = self.all.len();
        let mut q = motors.to_vec();
        q.extend(self.joints().map(|joint| motors[joint]));
        // What pulls links away, the slope of the energy by their positions.
        let mut pull = |q: &[f64]| -> DVector<f64> {
            let mut load = torque(&self.of_links(q));
            DVector::from_vec(self.carry(q, &mut load))
        };
        let mut now = pull(&q);
        for _ in 0..STEPS {
            let mut slopes = DMatrix::zeros(count, count);
            for k in 0..count {
                let mut side = |sign: f64| {
                    let mut near = q.clone();
                    near[self.joints + k] += sign * NEAR;
                    pull(&near)
                };
                slopes.set_column(k, &((side(1.0) - side(-1.0)) / (2.0 * NEAR)));
            }
            let slopes = (&slopes + slopes.transpose()) * 0.5;
            let Some(mut step) = downhill(&slopes, &now) else {
                break;
            };
            // Not beyond the lowest place along the step.
            let mut next = q.clone();
            loop {
                for k in 0..count {
                    next[self.joints + k] = q[self.joints + k] + step[k];
                }
                now = pull(&next);
                if now.dot(&step) <= 1e-9 * now.norm() * step.norm() || step.amax() <= STILL {
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
