//! Springs between motors and their links, from displacements that follow the load.
//!
//! A spec says how far a link is displaced by the load that it takes, `d(R)`, falling. A motion has that the other way round: the link
//! is displaced by `x`, and the load is that with `d(R) = x`. Where `d` jumps at no load, as with backlash, there is a gap without
//! load; where nothing gives, teeth are as stiff as [`TEETH_HZ`] says. Where `d` follows loads of other joints, too, as with a belt
//! over two of them, all loads are found together.

use std::f64::consts::TAU;

use nalgebra::{DMatrix, DVector};
use robot_model::simulate::Instant;
use robot_model_codegen::{Compiled, Linkage};

use super::runner::{Numbers, Runner, matrix};
use crate::Error;

/// Frequency of a motor against its link where only teeth are between them, at the position zero, Hz: fast beside all that controllers
/// do, and slow enough for a motion.
const TEETH_HZ: f64 = 300.0;

/// Of its motor's inertia: a link that has less there, as where it turns about itself, may have more elsewhere.
const LEAST_LINK: f64 = 0.01;

/// Damping ratio of teeth that hold a link where something else than its load puts it. What does so may be active and would feed a
/// swing of nothing but teeth.
const TEETH_DAMPING: f64 = 0.1;

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
    /// Damping over stiffness of teeth, s: a load is that of `x + lag dx/dt`.
    pub lag: Vec<f64>,
    /// Loads at which the programs are run, one a joint.
    load: Vec<f64>,
    states: usize,
    /// Whether springs follow loads of other joints, or accelerations.
    pub is_coupled: bool,
    /// Whether loads are affine in accelerations.
    pub is_affine: bool,
}

/// What a spring carries.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Carried {
    /// N m or N.
    pub load: f64,
    /// Its slope by the displacement of the link, not above 0, under the same loads of other springs.
    pub by_displacement: f64,
}

/// Slopes of what springs carry, one row a spring.
pub(super) struct SpringSlopes {
    /// By displacements of links, `s` columns.
    pub by_displacement: DMatrix<f64>,
    /// By `q`, `dq` and `ddq` of joints, while links stay where they are.
    pub by: [DMatrix<f64>; 3],
    /// By internal states.
    pub by_state: DMatrix<f64>,
    /// By loads of joints, which is zero for those with springs.
    pub by_load: DMatrix<f64>,
}

impl Springs {
    pub fn new(linkage: &Linkage, compiled: &Compiled, numbers: &Numbers) -> Result<Self, Error> {
        let mut found = Self {
            joints: linkage.springs.clone(),
            give: Runner::new(linkage.give.clone(), numbers),
            slopes: Runner::new(linkage.give_slopes.clone(), numbers),
            teeth: vec![TEETH; linkage.springs.len()],
            lag: linkage
                .led
                .iter()
                .map(|&is_led| {
                    if is_led {
                        2.0 * TEETH_DAMPING / (TAU * TEETH_HZ)
                    } else {
                        0.0
                    }
                })
                .collect(),
            load: vec![0.0; compiled.dof()],
            states: compiled.dynamics.state_rates.len(),
            is_coupled: linkage.is_coupled,
            is_affine: linkage.is_affine,
        };
        let mut loads: Vec<f64> = (-30..=45)
            .map(|fifth| 10_f64.powf(0.2 * f64::from(fifth)))
            .flat_map(|load| [load, -load])
            .collect();
        loads.sort_by(f64::total_cmp);
        for (k, &joint) in linkage.springs.iter().enumerate() {
            found.load.fill(0.0);
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
            self.load.fill(0.0);
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

    /// What springs carry whose links are displaced by `x`, where joints without one have the load `body`; not numbers where no loads
    /// displace links so far.
    pub fn carried(&mut self, at: &Instant<'_>, x: &[f64], body: &[f64]) -> Vec<Carried> {
        /// Sweeps over coupled springs, and of a load, what is no change.
        const SWEEPS: usize = 1000;
        const STILL: f64 = 8.0 * f64::EPSILON;
        self.load.copy_from_slice(body);
        if !self.is_coupled {
            return (0..x.len()).map(|k| self.one(at, k, x[k])).collect();
        }
        for &joint in &self.joints {
            self.load[joint] = 0.0;
        }
        // Each spring under the loads of the others: a descent of their energy, where they have one.
        let mut before = vec![f64::NAN; x.len()];
        for _ in 0..SWEEPS {
            let found: Vec<Carried> = (0..x.len())
                .map(|k| {
                    let found = self.one(at, k, x[k]);
                    self.load[self.joints[k]] = found.load;
                    found
                })
                .collect();
            let size = found.iter().map(|found| found.load.abs()).sum::<f64>();
            let mut changes = found.iter().zip(&before);
            if changes.all(|(found, before)| (found.load - before).abs() <= STILL * size) {
                return found;
            }
            before = found.iter().map(|found| found.load).collect();
        }
        vec![Carried::NONE; x.len()]
    }

    /// What one spring carries under the loads of the others.
    fn one(&mut self, at: &Instant<'_>, k: usize, x: f64) -> Carried {
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
        Carried::NONE
    }

    /// Slopes of what springs carry, with joints at `body` where they have none.
    pub fn slopes(&mut self, at: &Instant<'_>, carried: &[Carried], body: &[f64]) -> SpringSlopes {
        self.load.copy_from_slice(body);
        for (&joint, carried) in self.joints.iter().zip(carried) {
            self.load[joint] = carried.load;
        }
        let (s, n, p) = (self.joints.len(), self.load.len(), self.states);
        let found = self.slopes.run(at, &self.load);
        let [q, dq, ddq, mut load] = [0, 1, 2, 3].map(|part| matrix(found, part * s * n, s, n));
        let state = matrix(found, 4 * s * n, s, p);
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
        let [q, dq, ddq, by_load] = [q, dq, ddq, load].map(|give| -(&by_displacement * give));
        SpringSlopes {
            by_state: -(&by_displacement * state),
            by: [q, dq, ddq],
            by_load,
            by_displacement,
        }
    }

    pub fn runners(&mut self) -> impl Iterator<Item = &mut Runner> {
        [&mut self.give, &mut self.slopes].into_iter()
    }
}

impl Carried {
    /// No load displaces a link so far.
    const NONE: Self = Self {
        load: f64::NAN,
        by_displacement: f64::NAN,
    };
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
