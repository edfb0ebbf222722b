//! An arm behind `L`, as any other arm.

use super::default_corner;
use crate::columns::{Arm, Columns, Entry, MomentumArm, Nominal, Shape, Unknown};
use crate::identify::possible::PossibleArms;
use crate::identify::{IdentifyError, turns};
use crate::log::Log;
use crate::motion::Motion;
use crate::signal::resample::whole_steps;
use crate::signal::{Bands, FirstOrder, Prepared, SignalError, border, prepare_velocities};

/// An arm whose columns and torques have passed `L`.
pub(super) struct FilteredArm<'a> {
    pub arm: &'a dyn MomentumArm,
    pub bands: Bands,
    pub corner: f64,
    /// Whether `L` starts anew behind each turn of a dry joint.
    pub starts_anew: bool,
}

/// What filters of the motion spread a turn over, on either side, in periods of the smooth one's cutoff. A momentum that is taken there
/// stays in all rows up to the next turn, so this is wider than what rows of the shared filter need.
const SPREAD: f64 = 1.5;

/// A sample of clipped torque is in `L{tau}` for so many time constants: a thousandth is left of it then.
const TIME_CONSTANTS: f64 = 7.0;

/// What is made up in a hole is nearly right, so a fiftieth of it says nothing.
const HOLE_TIME_CONSTANTS: f64 = 4.0;

impl<'a> FilteredArm<'a> {
    pub fn new(arm: &'a dyn MomentumArm, bands: Bands, corner: Option<f64>) -> Self {
        Self {
            arm,
            bands,
            corner: corner.unwrap_or_else(|| default_corner(&bands)),
            starts_anew: false,
        }
    }

    /// Where a joint's rows start anew: samples near its turns, and what is left of one sample in the next. Nothing where they do not.
    fn restarts(&self, motion: &Motion, joint: usize, rate_hz: f64) -> Option<(Vec<bool>, f64)> {
        let is_dry = self.arm.dry_joints().contains(&joint);
        (self.starts_anew && is_dry).then(|| {
            let reach = whole_steps((SPREAD * rate_hz / self.bands.smooth_hz).ceil());
            let near = turns::near(motion, joint, reach);
            (near, f64::exp(-self.corner / rate_hz))
        })
    }

    pub fn prepare_all(&self, logs: &[Log]) -> Result<Vec<Prepared>, IdentifyError> {
        logs.iter()
            .map(|log| self.prepare(log).map_err(IdentifyError::from))
            .collect()
    }

    /// The motion without accelerations, and `L{tau}`.
    pub fn prepare(&self, log: &Log) -> Result<Prepared, SignalError> {
        let mut prepared = prepare_velocities(log, &self.bands)?;
        let filter = FirstOrder::new(self.corner, prepared.rate_hz)?;
        let start = border(&self.bands, prepared.rate_hz);
        for tau in &mut prepared.tau {
            after(start, tau, |tau, out| filter.apply(0.0, tau, out));
        }
        // At the samples of the columns: one that is off by a sample is an error that stays up to the next turn.
        if let Some(filter) = self.filter(&prepared.motion) {
            for (tau, restart) in prepared.tau.iter_mut().zip(&filter.restarts) {
                if let Some((near, kept)) = restart {
                    turns::start_anew(tau, near, *kept);
                }
            }
        }
        let samples = |constants: f64| whole_steps(constants * prepared.rate_hz / self.corner);
        let (reach, behind_holes) = (samples(TIME_CONSTANTS), samples(HOLE_TIME_CONSTANTS));
        prepared.shared = prepared.shared.longer_holes(behind_holes);
        for clipped in prepared.clipped.iter_mut().flatten() {
            clipped.end += reach;
        }
        Ok(prepared)
    }

    /// The filter on a motion's grid, the sample at which it starts, and where those of joints start anew.
    fn filter(&self, motion: &Motion) -> Option<Filter> {
        let &[first, .., last] = motion.time.as_slice() else {
            return None;
        };
        let rate_hz = (motion.time.len() - 1) as f64 / (last - first);
        let joints = 0..self.arm.dof();
        Some(Filter {
            first_order: FirstOrder::new(self.corner, rate_hz).ok()?,
            start: border(&self.bands, rate_hz),
            restarts: joints
                .map(|joint| self.restarts(motion, joint, rate_hz))
                .collect(),
        })
    }

    /// `L{tau}` of a series of torques of a joint.
    pub fn behind(&self, log: &Prepared, joint: usize, tau: &[f64]) -> Vec<f64> {
        let filter = self.filter(&log.motion);
        let against: Vec<f64> = tau.iter().map(|tau| -tau).collect();
        Self::filtered(&log.motion, filter.as_ref(), joint, None, Some(&against))
    }

    /// `w (momentum - L{momentum}) - L{drift}` of series of a joint that belong together.
    fn filtered(
        motion: &Motion,
        filter: Option<&Filter>,
        joint: usize,
        momentum: Option<&[f64]>,
        drift: Option<&[f64]>,
    ) -> Vec<f64> {
        let mut sum = vec![0.0; motion.time.len()];
        // A motion of one sample has nothing behind the start of the filter.
        let Some(filter) = filter else {
            return sum;
        };
        let (start, first_order) = (filter.start, filter.first_order);
        let mut out = Vec::new();
        if let Some(momentum) = momentum.and_then(|all| all.get(start..)) {
            first_order.apply_to_rate(momentum, &mut out);
            sum[start..].copy_from_slice(&out);
        }
        if let Some(drift) = drift.and_then(|all| all.get(start..)) {
            first_order.apply(0.0, drift, &mut out);
            sum[start..].iter_mut().zip(&out).for_each(|(s, d)| *s -= d);
        }
        if let Some((near, kept)) = &filter.restarts[joint] {
            turns::start_anew(&mut sum, near, *kept);
        }
        sum
    }
}

/// `L` on the grid of a motion.
struct Filter {
    first_order: FirstOrder,
    /// The sample at which it starts.
    start: usize,
    /// Where it starts anew, of each joint: see [`FilteredArm::restarts`].
    restarts: Vec<Option<(Vec<bool>, f64)>>,
}

/// Filters what stands from `start` on; before it there is nothing.
fn after(start: usize, series: &mut [f64], filter: impl Fn(&[f64], &mut Vec<f64>)) {
    let start = start.min(series.len());
    let mut out = Vec::new();
    filter(&series[start..], &mut out);
    series[..start].fill(0.0);
    series[start..].copy_from_slice(&out);
}

impl Columns for FilteredArm<'_> {
    fn unknowns(&self) -> &[Unknown] {
        self.arm.unknowns()
    }

    fn shapes(&self) -> &[Shape] {
        self.arm.shapes()
    }

    /// A load contains accelerations, so no momentum form reads it.
    fn uses_rigid_torque(&self) -> bool {
        false
    }

    fn inputs(&self) -> &[String] {
        self.arm.inputs()
    }

    fn entries(&self, motion: &Motion, shapes: &[f64]) -> Vec<Entry> {
        let filter = self.filter(motion);
        let key = |entry: &Entry| (entry.column, entry.joint);
        let mut momentum = self.arm.momentum(motion, shapes);
        let mut drift = self.arm.drift(motion, shapes);
        momentum.sort_by_key(key);
        drift.sort_by_key(key);
        let (mut momentum, mut drift) = (
            momentum.into_iter().peekable(),
            drift.into_iter().peekable(),
        );
        // Two sorted lists become one; a place may be in either or in both.
        let mut all = Vec::new();
        while let Some(place) = [momentum.peek(), drift.peek()]
            .into_iter()
            .flatten()
            .map(key)
            .min()
        {
            let p = momentum.next_if(|entry| key(entry) == place);
            let h = drift.next_if(|entry| key(entry) == place);
            let (p, h) = (p.map(|entry| entry.values), h.map(|entry| entry.values));
            all.push(Entry {
                joint: place.1,
                column: place.0,
                values: Self::filtered(
                    motion,
                    filter.as_ref(),
                    place.1,
                    p.as_deref(),
                    h.as_deref(),
                ),
            });
        }
        all
    }
}

impl Arm for FilteredArm<'_> {
    fn dof(&self) -> usize {
        self.arm.dof()
    }

    fn joints(&self) -> &[String] {
        self.arm.joints()
    }

    fn actuator_gain(&self) -> &[f64] {
        self.arm.actuator_gain()
    }

    fn known_torque(&self, motion: &Motion, shapes: &[f64]) -> Vec<Vec<f64>> {
        let filter = self.filter(motion);
        let known = self.arm.known_momentum(motion, shapes);
        let series = known.iter().zip(self.arm.known_drift(motion, shapes));
        series
            .enumerate()
            .map(|(joint, (p, h))| {
                Self::filtered(motion, filter.as_ref(), joint, Some(p), Some(&h))
            })
            .collect()
    }

    fn dry_joints(&self) -> &[usize] {
        self.arm.dry_joints()
    }

    fn dry_shapes(&self) -> &[usize] {
        self.arm.dry_shapes()
    }

    fn follows_load(&self) -> bool {
        self.arm.follows_load()
    }

    fn saturated_joints(&self) -> &[usize] {
        self.arm.saturated_joints()
    }

    fn nominal(&self) -> Vec<Option<Nominal>> {
        self.arm.nominal()
    }

    fn possible_arms(&self) -> Option<PossibleArms> {
        self.arm.possible_arms()
    }

    /// Nothing that passed `L` reads a load.
    fn rigid_torque(&self, motion: &Motion, _: &[f64], _: &[f64]) -> Vec<Vec<f64>> {
        vec![vec![0.0; motion.time.len()]; self.arm.dof()]
    }
}
