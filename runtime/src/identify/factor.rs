//! What logs tell, in a size that does not grow with them: triangular factors that are updated and merged.
//!
//! Rows `[W_j tau_j]` of each joint are reduced to a factor `R_j` with `R_j'R_j = [W_j tau_j]'[W_j tau_j]`, block after block of a log; two factors
//! below each other are reduced to that of both (TSQR). Least squares and weights need no more. A factor keeps 16 to 32 blocks apart: their
//! own equations, `s_b = sum_j W_bj'(tau_bj - W_bj beta) / sigma_j^2`, say how far an estimate is off, as far as noise is not correlated
//! beyond a block. Where joints with dry friction turn, rows away from turns have factors of their own beside those of all rows, so that it is
//! known what turns move an estimate by. Rows are of either form of the equations: `tau = Y_b beta`, or `L{tau} = Y_L beta` without
//! accelerations, where those away from turns are of an `L` that starts anew behind each of them.
//!
//! Sources: Golub, Van Loan, Matrix Computations, on updating; Demmel, Grigori, Hoemmen, Langou 2012, Communication-optimal parallel and
//! sequential QR; MacKinnon, Nielsen, Webb 2023 for deviations from blocks.

use super::IdentifyError;
use super::estimate::Form;
use super::filtered::default_corner;
use super::stack::Stack;
use crate::columns::{Arm, MomentumArm};
use crate::log::Log;
use crate::signal::Bands;

mod block;
mod deviations;
mod equations;
mod estimate;
mod rows;
mod solution;
mod worth;

pub use block::FactorBlock;
pub use rows::FactorRows;

/// Blocks that are kept apart, at most.
const MOST_BLOCKS: usize = 32;

/// What some logs tell of an arm's unknowns.
///
/// # Examples
/// Logs that come one after the other, and are not kept:
/// ```
/// # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); }
/// # use pendulum::{measure, pendulum};
/// use robot_model::identify::{Factor, Identify};
/// let (arm, log) = (pendulum(), measure(0.0));
/// let bands = Identify::default().bands_of(&arm, &log)?;
/// let mut factor = Factor::new(&arm, bands)?;
/// factor.push(&arm, &log)?;
/// let estimate = factor.estimate(&arm, &Identify::default())?;
/// assert!((estimate.values()[0] - 2.0).abs() < 0.02);
/// # Ok::<(), robot_model::identify::IdentifyError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Factor {
    /// Names of the unknowns, one a column.
    pub unknowns: Vec<String>,
    /// Names of the joints.
    pub joints: Vec<String>,
    /// What the columns are made of, as sums along a motion that is always the same: they tell arms with unknowns of the same names apart.
    pub equations: Vec<[f64; 2]>,
    /// Which form of the equations the rows are of.
    pub form: Form,
    /// Filters of the rows.
    pub bands: Bands,
    /// Blocks of the logs, in their order.
    pub blocks: Vec<FactorBlock>,
}

impl Factor {
    /// Fewer blocks say little of how sure a parameter is; deviations from fewer are no smaller than those of white noise.
    pub const ENOUGH_BLOCKS: usize = 8;

    /// One of no log, with these filters, of the rows of [`Identify::fit`](super::Identify::fit).
    ///
    /// # Errors
    /// [`IdentifyError::NotReduced`] where columns depend on more than the motion: open shapes, the load.
    ///
    /// # Examples
    /// ```
    /// # mod factor { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/factor.rs")); }
    /// # use factor::{bands, pendulum::pendulum};
    /// let empty = robot_model::identify::Factor::new(&pendulum(), bands())?;
    /// assert_eq!((empty.unknowns[0].as_str(), empty.samples()), ("link.izz", 0));
    /// # Ok::<(), robot_model::identify::IdentifyError>(())
    /// ```
    pub fn new(arm: &dyn Arm, bands: Bands) -> Result<Self, IdentifyError> {
        let why = if let Some(shape) = arm.shapes().first() {
            Some(format!("the shape `{}` has no value", shape.name))
        } else if arm.uses_rigid_torque() {
            Some("an effect of the spec depends on the load".to_owned())
        } else {
            None
        };
        if let Some(why) = why {
            return Err(IdentifyError::NotReduced { why });
        }
        let unknowns = arm.unknowns().iter();
        Ok(Self {
            unknowns: unknowns.map(|unknown| unknown.name.clone()).collect(),
            joints: arm.joints().to_vec(),
            equations: equations::of(arm),
            form: Form::Acceleration,
            bands,
            blocks: Vec::new(),
        })
    }

    /// One of no log, with these filters, of the rows of [`Identify::fit_filtered`](super::Identify::fit_filtered): `L{tau} = Y_L beta` with
    /// `L(s) = w / (s + w)`, without accelerations. `corner` is `w` in rad/s; without it the end of the shared band.
    ///
    /// # Errors
    /// Those of [`Self::new`].
    ///
    /// # Examples
    /// ```
    /// # mod factor { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/factor.rs")); }
    /// # use factor::{bands, log, pendulum::pendulum};
    /// use robot_model::identify::{Factor, Form, Identify};
    /// let arm = pendulum();
    /// let mut factor = Factor::filtered(&arm, bands(), Some(60.0))?;
    /// factor.push_filtered(&arm, &log())?;
    /// let ask = Identify { bands: Some(bands()), ..Identify::default() };
    /// let (estimate, direct) = (factor.estimate(&arm, &ask)?, ask.fit_filtered(&arm, &[log()], Some(60.0))?);
    /// assert_eq!(estimate.form, Form::Filtered { corner: 60.0 });
    /// assert!((estimate.values()[0] - direct.values()[0]).abs() < 1e-9);
    /// # Ok::<(), robot_model::identify::IdentifyError>(())
    /// ```
    pub fn filtered(
        arm: &dyn MomentumArm,
        bands: Bands,
        corner: Option<f64>,
    ) -> Result<Self, IdentifyError> {
        let corner = corner.unwrap_or_else(|| default_corner(&bands));
        Ok(Self {
            form: Form::Filtered { corner },
            ..Self::new(arm, bands)?
        })
    }

    /// Adds a log, or a piece of one, as blocks of a second or more.
    ///
    /// # Errors
    /// Those of [`FactorBlock::of_log`]; [`IdentifyError::OtherFactor`] where this one is of the filtered form.
    ///
    /// # Examples
    /// ```
    /// # mod factor { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/factor.rs")); }
    /// # use factor::{factor, log, pendulum::pendulum};
    /// let mut twice = factor();
    /// twice.push(&pendulum(), &log())?;
    /// assert_eq!(twice.samples(), 2 * factor().samples());
    /// # Ok::<(), robot_model::identify::IdentifyError>(())
    /// ```
    pub fn push(&mut self, arm: &dyn Arm, log: &Log) -> Result<(), IdentifyError> {
        self.check_form(Form::Acceleration)?;
        self.extend(FactorBlock::of_log(arm, log, &self.bands)?);
        Ok(())
    }

    /// The same for a factor of the filtered form.
    ///
    /// # Errors
    /// Those of [`FactorBlock::of_filtered_log`]; [`IdentifyError::OtherFactor`] where this one is of the form with accelerations.
    ///
    /// # Examples
    /// ```
    /// # mod factor { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/factor.rs")); }
    /// # use factor::{bands, factor, log, pendulum::pendulum};
    /// let mut filtered = robot_model::identify::Factor::filtered(&pendulum(), bands(), None)?;
    /// filtered.push_filtered(&pendulum(), &log())?;
    /// assert_eq!(filtered.samples(), factor().samples());
    /// // Rows of one form do not belong to those of the other.
    /// assert!(factor().push_filtered(&pendulum(), &log()).is_err() && factor().merge(filtered).is_err());
    /// # Ok::<(), robot_model::identify::IdentifyError>(())
    /// ```
    pub fn push_filtered(&mut self, arm: &dyn MomentumArm, log: &Log) -> Result<(), IdentifyError> {
        let corner = match self.form {
            Form::Filtered { corner } => corner,
            Form::Acceleration => default_corner(&self.bands),
        };
        self.check_form(Form::Filtered { corner })?;
        let blocks = FactorBlock::of_filtered_log(arm, log, &self.bands, Some(corner))?;
        self.extend(blocks);
        Ok(())
    }

    /// Adds blocks of [`FactorBlock::of_log`], or [`FactorBlock::of_filtered_log`], with the same arm, form and filters.
    ///
    /// # Examples
    /// ```
    /// # mod factor { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/factor.rs")); }
    /// # use factor::{bands, factor, log, pendulum::pendulum};
    /// use robot_model::identify::{Factor, FactorBlock};
    /// let mut extended = Factor::new(&pendulum(), bands())?;
    /// extended.extend(FactorBlock::of_log(&pendulum(), &log(), &bands())?);
    /// assert_eq!(extended, factor());
    /// # Ok::<(), robot_model::identify::IdentifyError>(())
    /// ```
    pub fn extend(&mut self, blocks: impl IntoIterator<Item = FactorBlock>) {
        for block in blocks {
            self.blocks.push(block);
            self.shorten();
        }
    }

    /// Adds rows as a block of their own.
    ///
    /// # Examples
    /// ```
    /// # mod factor { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/factor.rs")); }
    /// # use factor::{bands, log, pendulum::pendulum};
    /// use robot_model::{identify::{Factor, Stack}, signal::prepare};
    /// let rows = Stack::new(&pendulum(), &[prepare(&log(), &bands()).expect("a long log")], &[]);
    /// let mut factor = Factor::new(&pendulum(), bands())?;
    /// factor.push_rows(&rows);
    /// assert_eq!((factor.blocks.len(), factor.samples()), (1, rows.samples()));
    /// # Ok::<(), robot_model::identify::IdentifyError>(())
    /// ```
    pub fn push_rows(&mut self, stack: &Stack) {
        self.extend([FactorBlock::of_rows(stack)]);
    }

    /// Adds what other logs tell of the same arm.
    ///
    /// # Errors
    /// [`IdentifyError::OtherFactor`] where it is of other unknowns, joints, equations, filters, or of another form.
    ///
    /// # Examples
    /// ```
    /// # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); }
    /// # use pendulum::{measure, pendulum};
    /// # use robot_model::identify::{Factor, Identify};
    /// let arm = pendulum();
    /// let bands = Identify::default().bands_of(&arm, &measure(0.0))?;
    /// let [mut monday, mut tuesday] = [Factor::new(&arm, bands)?, Factor::new(&arm, bands)?];
    /// monday.push(&arm, &measure(0.0))?;
    /// tuesday.push(&arm, &measure(0.1))?;
    /// assert_eq!(monday.common_parts(&tuesday), 0); // so no log counts twice
    /// let samples = monday.samples() + tuesday.samples();
    /// monday.merge(tuesday)?;
    /// assert_eq!(monday.samples(), samples);
    /// # Ok::<(), robot_model::identify::IdentifyError>(())
    /// ```
    pub fn merge(&mut self, other: Self) -> Result<(), IdentifyError> {
        self.check(&other)?;
        self.blocks.extend(other.blocks);
        self.shorten();
        Ok(())
    }

    /// That the rows are of a form, and of its corner.
    fn check_form(&self, wanted: Form) -> Result<(), IdentifyError> {
        let name = |form: Form| match form {
            Form::Acceleration => form.name().to_owned(),
            Form::Filtered { corner } => format!("{} with a corner of {corner} rad/s", form.name()),
        };
        if self.form == wanted {
            return Ok(());
        }
        let (found, wanted) = (name(self.form), name(wanted));
        let what = format!("rows (of the form {found}, where {wanted} is wanted)");
        Err(IdentifyError::OtherFactor { what })
    }

    /// That another factor is of the same arm, form and filters.
    fn check(&self, other: &Self) -> Result<(), IdentifyError> {
        let what = if other.joints != self.joints {
            Some("joints".to_owned())
        } else if other.unknowns != self.unknowns {
            Some("unknowns".to_owned())
        } else if !equations::are_alike(&other.equations, &self.equations) {
            Some(equations::OTHER.to_owned())
        } else if other.bands != self.bands && other.form.name() == self.form.name() {
            // Those that are chosen differ where forms do.
            let (own, others) = (self.bands, other.bands);
            Some(format!("filters ({others}, where {own} are wanted)"))
        } else {
            None
        };
        match what {
            Some(what) => Err(IdentifyError::OtherFactor { what }),
            None => other.check_form(self.form),
        }
    }

    /// Parts of logs that another factor has, too: what they say would count twice. Of many parts some stand for all of them.
    ///
    /// # Examples
    /// ```
    /// # mod factor { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/factor.rs")); }
    /// let factor = factor::factor();
    /// assert_eq!(factor.common_parts(&factor), factor.blocks.len()); // all of it
    /// ```
    #[must_use]
    pub fn common_parts(&self, other: &Self) -> usize {
        let prints = |factor: &Self| -> Vec<f64> {
            let blocks = factor.blocks.iter();
            let mut prints: Vec<f64> = blocks.flat_map(|block| block.prints.clone()).collect();
            prints.sort_unstable_by(f64::total_cmp);
            prints
        };
        block::common(&prints(self), &prints(other))
    }

    /// Samples per joint.
    ///
    /// # Examples
    /// ```
    /// # mod factor { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/factor.rs")); }
    /// let filter = robot_model::signal::SharedFilter::new(&factor::bands(), 500.0).expect("a low band");
    /// assert_eq!(factor::factor().samples(), filter.kept(10_000).count()); // of 20 s
    /// ```
    #[must_use]
    pub fn samples(&self) -> usize {
        self.blocks.iter().map(|block| block.samples).sum()
    }

    /// Rows of each joint that say something.
    ///
    /// # Examples
    /// ```
    /// # mod factor { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/factor.rs")); }
    /// let factor = factor::factor();
    /// assert_eq!(factor.counts(), [factor.samples()]); // one joint, all of whose rows say something
    /// ```
    #[must_use]
    pub fn counts(&self) -> Vec<usize> {
        let blocks = self.blocks.iter();
        let joint = |joint: usize| blocks.clone().map(|block| block.whole.counts[joint]).sum();
        (0..self.joints.len()).map(joint).collect()
    }

    /// Merges neighbors while there are too many blocks: the shortest pair first, so that blocks stay about alike.
    fn shorten(&mut self) {
        while self.blocks.len() > MOST_BLOCKS {
            let pairs = self.blocks.windows(2).enumerate();
            let shortest = pairs.min_by_key(|(_, pair)| pair[0].samples + pair[1].samples);
            let Some((k, _)) = shortest else { return };
            let other = self.blocks.remove(k + 1);
            self.blocks[k].add(other);
        }
    }
}

#[cfg(test)]
mod tests;
