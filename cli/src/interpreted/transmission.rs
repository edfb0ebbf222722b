//! Springs and gaps between motors and their links, as a simulation has them.
//!
//! A spec says where a link stands behind its encoder for the torque that it takes, `position(j) = -R/k - b sign(R)`. A motion has
//! that the other way round: both sides have an inertia and a place of their own, and the torque between them follows from how far
//! the motor is ahead.

use nalgebra::DMatrix;
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

    /// How far the motor is ahead under a torque.
    fn lead(&self, torque: f64) -> f64 {
        let gap = if torque == 0.0 { 0.0 } else { self.half_gap };
        torque / self.stiffness + gap.copysign(torque)
    }
}

impl Transmissions {
    /// What the displacements of a spec are, for these shapes.
    pub fn new(compiled: &Compiled, shapes: &[f64]) -> Result<Self, Error> {
        let joints = compiled.dof();
        let mut found = Self {
            joints,
            all: Vec::new(),
        };
        let Some(block) = compiled.displacements() else {
            return Ok(found);
        };
        let refuse = |joint: usize, why: &str| {
            let model = &compiled.model;
            let name = &model.joints[joint].name;
            Error::Argument(format!("{}: joint {name}: {why}", model.source))
        };
        let symbols = block.program.symbols();
        let follows_the_load = symbols
            .iter()
            .all(|symbol| matches!(symbol, Symbol::RigidTorque(_) | Symbol::Shape(_)));
        let under = |load: &dyn Fn(usize) -> f64| -> Vec<f64> {
            block.program.eval(&|symbol| match symbol {
                Symbol::RigidTorque(joint) => load(joint),
                Symbol::Shape(k) => shapes[k],
                _ => f64::NAN,
            })
        };
        let (one, two) = (under(&|_| 1.0), under(&|_| 2.0));
        // Loads of both signs that no joint shares with another.
        let probe = |joint: usize| if joint % 2 == 0 { 40.0 } else { -3.0 } + 0.7 * joint as f64;
        let probes = [under(&probe), under(&|joint| -probe(joint))];
        for (k, &(joint, _)) in block.entries.iter().enumerate() {
            let compliance = one[k] - two[k];
            let half_gap = -one[k] - compliance;
            // Digits of a difference: a gap of nothing has none left.
            let half_gap = if half_gap.abs() <= 1e-12 * compliance.abs() {
                0.0
            } else {
                half_gap
            };
            let fits = probes.iter().zip([1.0, -1.0]).all(|(found, sign)| {
                let load = sign * probe(joint);
                let expected = -compliance * load - half_gap * load.signum();
                (found[k] - expected).abs() <= 1e-9 * expected.abs()
            });
            if !follows_the_load || !fits || compliance < 0.0 || half_gap < 0.0 {
                return Err(refuse(
                    joint,
                    "only springs and gaps are simulated, `position(j) = -rigid_torque(j)/k - b * sign(rigid_torque(j))`; another \
                     displacement can be identified, not simulated",
                ));
            }
            if compliance == 0.0 {
                return Err(refuse(
                    joint,
                    "teeth without any give are not simulated; declare `joint_elasticity` beside `backlash`",
                ));
            }
            found.all.push(Transmission {
                joint,
                stiffness: 1.0 / compliance,
                half_gap,
            });
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
    fn links(&self) -> Vec<usize> {
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

    /// Positions of all where links hang behind motors that are at `motors`: `torque` is that of the rigid body with links at a
    /// position.
    pub fn hang(&self, motors: &[f64], mut torque: impl FnMut(&[f64]) -> Vec<f64>) -> Vec<f64> {
        /// Springs that are softer than gravity is steep are never done; they start near enough.
        const ROUNDS: usize = 50;
        let mut q = motors.to_vec();
        q.extend(self.joints().map(|joint| motors[joint]));
        for _ in 0..ROUNDS {
            if self.all.is_empty() {
                break;
            }
            let load = torque(&self.of_links(&q));
            let mut moved = 0.0_f64;
            for (k, one) in self.all.iter().enumerate() {
                let link = motors[one.joint] - one.lead(load[one.joint]);
                moved = moved.max((link - q[self.joints + k]).abs());
                q[self.joints + k] = link;
            }
            if moved < 1e-14 {
                break;
            }
        }
        q
    }

    /// What each joint moves of an inertia of all degrees of freedom, its link with it.
    pub fn own_inertia(&self, inertia: &DMatrix<f64>) -> Vec<f64> {
        let own = self.links().into_iter().enumerate().map(|(joint, link)| {
            let sides: &[usize] = if joint == link {
                &[joint]
            } else {
                &[joint, link]
            };
            let entries = sides
                .iter()
                .flat_map(|&row| sides.iter().map(move |&column| (row, column)));
            entries.map(|entry| inertia[entry]).sum()
        });
        own.collect()
    }
}
