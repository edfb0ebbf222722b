//! Springs between motors and their links, from displacements that follow the load.
//!
//! A spec says how far a link is displaced by the load that it takes, `d(R)`, falling. A motion has that the other way round: the link
//! is displaced by `x`, and the load is that with `d(R) = x`. Where `d` jumps at no load, as with backlash, there is a gap without
//! load; where nothing gives, teeth are as stiff as [`TEETH_HZ`] says.

use std::f64::consts::TAU;

use nalgebra::DMatrix;
use robot_model::simulate::Instant;
use robot_model_codegen::{Compiled, Linkage};

use super::runner::{Numbers, Runner, matrix};
use crate::Error;

/// Frequency of a motor against its link where only teeth are between them, at the position zero, Hz: fast beside all that controllers
/// do, and slow enough for a motion.
const TEETH_HZ: f64 = 300.0;

/// Of its motor's inertia: a link that has less there, as where it turns about itself, may have more elsewhere.
const LEAST_LINK: f64 = 0.01;

/// Compliance of teeth until inertias are known, rad/(N m) or m/N.
const TEETH: f64 = 1e-6;

/// Compliance of what does not give, rad/(N m) or m/N.
const NOTHING: f64 = 1e-15;

/// Springs of an arm.
#[derive(Debug, Clone)]
pub(super) struct Springs {
    /// Their joints.
    pub joints: Vec<usize>,
    give: Runner,
    slopes: Runner,
    /// Compliance of teeth, rad/(N m) or m/N: what is added to springs that do not give.
    teeth: Vec<f64>,
    /// Loads at which the programs are run, one a joint.
    load: Vec<f64>,
    states: usize,
}

/// What a spring carries.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Carried {
    /// N m or N.
    pub load: f64,
    /// Its slope by the displacement of the link, not above 0.
    pub by_displacement: f64,
}

impl Springs {
    pub fn new(linkage: &Linkage, compiled: &Compiled, numbers: &Numbers) -> Result<Self, Error> {
        let mut found = Self {
            joints: linkage.springs.clone(),
            give: Runner::new(linkage.give.clone(), numbers),
            slopes: Runner::new(linkage.give_slopes.clone(), numbers),
            teeth: vec![TEETH; linkage.springs.len()],
            load: vec![0.0; compiled.dof()],
            states: compiled.dynamics.state_rates.len(),
        };
        let mut loads: Vec<f64> = (-30..=45)
            .map(|fifth| 10_f64.powf(0.2 * f64::from(fifth)))
            .flat_map(|load| [load, -load])
            .collect();
        loads.sort_by(f64::total_cmp);
        for (k, &joint) in linkage.springs.iter().enumerate() {
            let falls = found.at_rest(compiled, |found, at| {
                let curve = loads.iter().map(|&load| found.displacement(at, k, load));
                let curve: Vec<(f64, f64)> = curve.collect();
                curve.iter().all(|(_, slope)| *slope <= 0.0)
                    && curve.windows(2).all(|pair| pair[1].0 <= pair[0].0)
            });
            // What channels do to it is seen when it moves.
            if !falls && !linkage.is_timed {
                return Err(Error::Argument(format!(
                    "{}: joint {}: its spring gives way against its load; `position(j)` has to fall with `rigid_torque(j)`, as \
                     `-rigid_torque(j)/k` with `k` above 0",
                    compiled.model.source, compiled.model.joints[joint].name
                )));
            }
        }
        Ok(found)
    }

    /// What holds where the arm stands at zero, at time 0.
    fn at_rest<T>(
        &mut self,
        compiled: &Compiled,
        find: impl FnOnce(&mut Self, &Instant<'_>) -> T,
    ) -> T {
        let still = vec![0.0; compiled.dof()];
        let (memory, inputs) = (
            vec![0.0; self.states],
            vec![0.0; compiled.model.inputs().len()],
        );
        let at = Instant {
            time: 0.0,
            q: &still,
            dq: &still,
            ddq: &still,
            memory: &memory,
            switches: &[],
            torque: &still,
            inputs: &inputs,
        };
        find(self, &at)
    }

    /// Teeth for springs that do not give under large loads, none for others; `inertia` has motors and links.
    pub fn set_teeth(&mut self, compiled: &Compiled, inertia: &DMatrix<f64>) {
        /// N m or N, beyond what any joint carries.
        const LARGE: f64 = 1e9;
        self.teeth.fill(0.0);
        for k in 0..self.joints.len() {
            let least = self.at_rest(compiled, |found, at| {
                let [up, down] = [LARGE, -LARGE].map(|load| found.displacement(at, k, load).1);
                up.abs().min(down.abs())
            });
            if least < NOTHING {
                let motor = inertia[(self.joints[k], self.joints[k])];
                let link = inertia[(self.load.len() + k, self.load.len() + k)];
                let link = link.max(LEAST_LINK * motor);
                self.teeth[k] = (1.0 / motor + 1.0 / link) / (TAU * TEETH_HZ).powi(2);
            }
        }
    }

    /// Displacement of a link under a load, and its slope.
    fn displacement(&mut self, at: &Instant<'_>, k: usize, load: f64) -> (f64, f64) {
        self.load[self.joints[k]] = load;
        let found = self.give.run(at, &self.load);
        let (give, slope) = (found.output(k), found.output(self.joints.len() + k));
        (give - self.teeth[k] * load, slope - self.teeth[k])
    }

    /// What a spring carries whose link is displaced by `x`; not a number where no load displaces it so far.
    pub fn carried(&mut self, at: &Instant<'_>, k: usize, x: f64) -> Carried {
        /// Of Newton's steps and halvings.
        const STEPS: usize = 300;
        let [above, below] =
            [f64::MIN_POSITIVE, -f64::MIN_POSITIVE].map(|load| self.displacement(at, k, load));
        if above.0 <= x && x <= below.0 {
            let is_gap = above.0 < below.0 || above.1 == 0.0;
            return Carried {
                load: 0.0,
                by_displacement: if is_gap { 0.0 } else { 1.0 / above.1 },
            };
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
        Carried {
            load: f64::NAN,
            by_displacement: f64::NAN,
        }
    }

    /// Slopes of the loads by `q`, `dq` and `z` of joints, all else held, one row a spring.
    pub fn slopes(&mut self, at: &Instant<'_>, carried: &[Carried]) -> [DMatrix<f64>; 3] {
        for (&joint, carried) in self.joints.iter().zip(carried) {
            self.load[joint] = carried.load;
        }
        let (s, n, p) = (self.joints.len(), self.load.len(), self.states);
        let found = self.slopes.run(at, &self.load);
        [(0, n), (s * n, n), (2 * s * n, p)]
            .map(|(first, columns)| Carried::slopes(carried, matrix(found, first, s, columns)))
    }

    pub fn runners(&mut self) -> impl Iterator<Item = &mut Runner> {
        [&mut self.give, &mut self.slopes].into_iter()
    }
}

impl Carried {
    /// Slopes of the loads by what moves displacements by `give`, one row a spring, while links stay where they are.
    pub fn slopes(carried: &[Self], mut give: DMatrix<f64>) -> DMatrix<f64> {
        for (mut row, carried) in give.row_iter_mut().zip(carried) {
            row *= -carried.by_displacement;
        }
        give
    }
}
