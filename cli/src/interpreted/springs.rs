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

/// Frequency of a motor against its link where only teeth are between them, Hz: fast beside all that controllers do, and slow enough
/// for a motion.
const TEETH_HZ: f64 = 300.0;

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
            teeth: vec![0.0; linkage.springs.len()],
            load: vec![0.0; compiled.dof()],
            states: compiled.dynamics.state_rates.len(),
        };
        for (k, &joint) in linkage.springs.iter().enumerate() {
            let probes = (-6..=9).map(|power| 1.7 * 10_f64.powi(power));
            let loads: Vec<f64> = probes.flat_map(|load| [load, -load]).collect();
            let falls = found.at_rest(compiled, |found, at| {
                loads.iter().all(|&load| {
                    let (there, slope) = found.displacement(at, k, load);
                    let (opposite, _) = found.displacement(at, k, -load);
                    slope <= 0.0 && (opposite - there) * load.signum() >= 0.0
                })
            });
            if !falls {
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

    /// Gives teeth to springs that do not give under large loads; `inertia` has motors and links.
    pub fn set_teeth(&mut self, compiled: &Compiled, inertia: &DMatrix<f64>) {
        /// N m or N, beyond what any joint carries.
        const LARGE: f64 = 1e9;
        for k in 0..self.joints.len() {
            let motor = inertia[(self.joints[k], self.joints[k])];
            let link = inertia[(self.load.len() + k, self.load.len() + k)];
            let teeth = (1.0 / motor + 1.0 / link) / (TAU * TEETH_HZ).powi(2);
            let least = self.at_rest(compiled, |found, at| {
                let [up, down] = [LARGE, -LARGE].map(|load| found.displacement(at, k, load).1);
                up.abs().min(down.abs())
            });
            // Whatever gives at all is left as it is.
            if least < 1e-3 * teeth {
                self.teeth[k] = teeth;
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
        /// Of Newton's steps and halvings; each halves a bracket that doublings found.
        const STEPS: usize = 400;
        let [above, below] =
            [f64::MIN_POSITIVE, -f64::MIN_POSITIVE].map(|load| self.displacement(at, k, load));
        if above.0 <= x && x <= below.0 {
            let by_displacement = if above.0 < below.0 || above.1 == 0.0 {
                0.0
            } else {
                1.0 / above.1
            };
            return Carried {
                load: 0.0,
                by_displacement,
            };
        }
        let sign = if x < above.0 { 1.0 } else { -1.0 };
        let mut found = if sign > 0.0 { above } else { below };
        let (mut low, mut high, mut load) = (0.0, f64::INFINITY, 0.0);
        for _ in 0..STEPS {
            let before = load;
            let newton = load + sign * (x - found.0) / found.1;
            let is_newton = newton > low && newton < high;
            load = if is_newton {
                newton
            } else if high.is_finite() {
                0.5 * (low + high)
            } else {
                2.0 * f64::max(low, 1.0)
            };
            found = self.displacement(at, k, sign * load);
            let missing = sign * (found.0 - x);
            let still = 2.0 * f64::EPSILON * load;
            let is_there = missing == 0.0 || is_newton && (load - before).abs() <= still;
            if is_there || high - low <= still {
                // A bracket closes around a jump, at which the link moves under the same load.
                let by_displacement = if is_there { 1.0 / found.1 } else { 0.0 };
                return Carried {
                    load: sign * load,
                    by_displacement,
                };
            }
            if missing > 0.0 {
                low = load;
            } else {
                high = load;
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
        [(0, n), (s * n, n), (2 * s * n, p)].map(|(first, columns)| {
            let mut slopes = matrix(found, first, s, columns);
            for (mut row, carried) in slopes.row_iter_mut().zip(carried) {
                row *= -carried.by_displacement;
            }
            slopes
        })
    }
}
