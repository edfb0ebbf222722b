//! Factors as files.

use std::io::Read;
use std::path::Path;

use robot_model::identify::{Factor, FactorBlock, FactorRows, Form};
use robot_model::signal::Bands;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::fit::Fit;
use crate::{Error, json};

/// What is written and read; a contract between machines.
#[derive(Serialize, Deserialize)]
struct File {
    /// Of this form.
    factor: u32,
    unknowns: Vec<String>,
    joints: Vec<String>,
    /// What the columns are made of, see [`Factor::equations`].
    equations: Vec<[f64; 2]>,
    form: FormName,
    /// Of the filtered form only, rad/s.
    #[serde(default)]
    corner: Option<f64>,
    bands_hz: [f64; 3],
    blocks: Vec<Block>,
}

/// As [`Form::name`] has them.
#[derive(Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
enum FormName {
    Acceleration,
    Filtered,
}

#[derive(Serialize, Deserialize)]
struct Block {
    samples: usize,
    /// What its parts are known by, see [`FactorBlock::prints`].
    prints: Vec<f64>,
    whole: Part,
    /// Rows without those at turns of joints with dry friction, where there are some.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    away: Option<Part>,
}

#[derive(Serialize, Deserialize)]
struct Part {
    /// Rows of each joint that say something.
    counts: Vec<usize>,
    torque_squares: Vec<f64>,
    most_torque: Vec<f64>,
    /// `[joint][row][column]`: columns are the unknowns, then the torque.
    rows: Vec<Vec<Vec<f64>>>,
}

impl Part {
    fn of(rows: &FactorRows) -> Self {
        Self {
            counts: rows.counts.clone(),
            torque_squares: rows.torque_squares.clone(),
            most_torque: rows.most_torque.clone(),
            rows: rows.rows.clone(),
        }
    }

    fn into_rows(self) -> FactorRows {
        let mut rows = FactorRows::default();
        (rows.counts, rows.rows) = (self.counts, self.rows);
        (rows.torque_squares, rows.most_torque) = (self.torque_squares, self.most_torque);
        rows
    }

    /// What is wrong with rows of so many joints and columns.
    fn fault(&self, joints: usize, width: usize) -> Option<String> {
        let lists = [
            self.rows.len(),
            self.torque_squares.len(),
            self.most_torque.len(),
            self.counts.len(),
        ];
        let mut rows = self.rows.iter().flatten();
        if lists != [joints; 4] || !rows.all(|row| row.len() == width) {
            return Some(format!(
                "does not have one list of rows per joint with {width} numbers each"
            ));
        }
        let mut sizes = self.torque_squares.iter().chain(&self.most_torque);
        let is_negative = sizes.any(|size| *size < 0.0);
        is_negative.then(|| "has a negative sum of squares or size".to_owned())
    }
}

impl Block {
    fn fault(&self, joints: usize, width: usize) -> Option<String> {
        let mut parts = std::iter::once(&self.whole).chain(&self.away);
        if let Some(fault) = parts.find_map(|rows| rows.fault(joints, width)) {
            return Some(fault);
        }
        if self.prints.windows(2).any(|pair| pair[0] > pair[1]) {
            return Some("has `prints` that do not ascend".to_owned());
        }
        let mut counts = self.whole.counts.iter();
        if self.samples == 0 || counts.any(|count| *count > self.samples) {
            return Some("has no samples, or fewer samples than rows".to_owned());
        }
        let away = self.away.iter().flat_map(|away| &away.counts);
        let mut pairs = away.zip(&self.whole.counts);
        let is_more = pairs.any(|(away, whole)| away > whole);
        is_more.then(|| "has more rows away from velocity reversals than rows".to_owned())
    }
}

/// What a factor is not that is refused.
const AS_WRITTEN: &str = "it is not a factor written by `identify --factor`; write it again";

/// The first did not say what its columns are made of, nor which rows are at turns, the second not of which parts a block is, the third no
/// largest torques, the fourth not of which form of the equations the rows are.
const FORM: u32 = 5;

/// The text of a factor's file.
pub(crate) fn text(factor: &Factor) -> String {
    let blocks = factor.blocks.iter().map(|block| Block {
        samples: block.samples,
        prints: block.prints.clone(),
        whole: Part::of(&block.whole),
        away: block.away.as_ref().map(Part::of),
    });
    let bands = factor.bands;
    let (form, corner) = match factor.form {
        Form::Acceleration => (FormName::Acceleration, None),
        Form::Filtered { corner } => (FormName::Filtered, Some(corner)),
    };
    let file = File {
        factor: FORM,
        unknowns: factor.unknowns.clone(),
        joints: factor.joints.clone(),
        equations: factor.equations.clone(),
        form,
        corner,
        bands_hz: [bands.shared_hz, bands.smooth_hz, bands.wide_hz],
        blocks: blocks.collect(),
    };
    let mut text = serde_json::to_string(&file).expect("a factor is lists of numbers and names");
    text.push('\n');
    text
}

/// Whether a file looks like a log: by its first bytes, or by the names in its first line.
fn log_of(path: &Path) -> bool {
    /// No header is longer, bytes.
    const HEADER: u64 = 1 << 16;
    const MAGIC: [&[u8]; 3] = [b"PAR1", b"\x89MCAP", &[0x1f, 0x8b]];
    let mut bytes = Vec::new();
    let Ok(_) =
        std::fs::File::open(path).and_then(|file| file.take(HEADER).read_to_end(&mut bytes))
    else {
        return false;
    };
    let first = bytes.split(|byte| *byte == b'\n').next().unwrap_or(&[]);
    let is_line = |line: &[u8]| line.contains(&b',') && !line.starts_with(b"{");
    MAGIC.iter().any(|magic| bytes.starts_with(magic)) || is_line(first)
}

/// A file that is sound in itself, of whatever arm.
pub(crate) struct Opened<'a> {
    pub path: &'a Path,
    pub form: Form,
    file: File,
}

/// Reads the file of a factor.
pub(crate) fn open(path: &Path) -> Result<Opened<'_>, Error> {
    let refuse = |reason: &str| Error::json(path, &reason);
    let value: Value = json::read(path).map_err(|error| {
        // What is no JSON at all is most likely what the factor was to be made of.
        if log_of(path) {
            refuse("it is a log, not a factor; make a factor of it with `identify --factor`")
        } else {
            error
        }
    })?;
    if let Some(form) = value["factor"]
        .as_u64()
        .filter(|form| *form != u64::from(FORM))
    {
        return Err(refuse(&format!(
            "it is a factor of form {form}, this program reads form {FORM}; write it again with `identify --factor`"
        )));
    }
    let file: File = json::typed(path, value, AS_WRITTEN)?;
    let form = match (&file.form, file.corner) {
        (FormName::Acceleration, _) => Form::Acceleration,
        (FormName::Filtered, Some(corner)) if corner > 0.0 => Form::Filtered { corner },
        (FormName::Filtered, _) => {
            return Err(refuse(
                "it is of the filtered form, but has no `corner` above 0 rad/s; write it again with `identify --factor`",
            ));
        }
    };
    let (joints, width) = (file.joints.len(), file.unknowns.len() + 1);
    for (k, block) in file.blocks.iter().enumerate() {
        if let Some(fault) = block.fault(joints, width) {
            return Err(refuse(&format!(
                "block {} {fault}; write it again with `identify --factor`",
                k + 1
            )));
        }
    }
    Ok(Opened { path, form, file })
}

impl Opened<'_> {
    /// The factor, where it is of this arm and form.
    pub fn factor(self, fit: &dyn Fit) -> Result<Factor, Error> {
        let Self { path, form, file } = self;
        let [shared_hz, smooth_hz, wide_hz] = file.bands_hz;
        let bands = Bands {
            smooth_hz,
            wide_hz,
            shared_hz,
        };
        let own = fit.factor(bands)?;
        let mut factor = own.clone();
        factor.form = form;
        factor.joints = file.joints;
        factor.unknowns = file.unknowns;
        factor.equations = file.equations;
        let blocks = file.blocks.into_iter().map(|read| {
            let mut block = FactorBlock::default();
            (block.samples, block.prints) = (read.samples, read.prints);
            block.whole = read.whole.into_rows();
            block.away = read.away.map(Part::into_rows);
            block
        });
        factor.blocks = blocks.collect();
        // Of this arm, and of none that is alike.
        let mut merged = own;
        merged
            .merge(factor)
            .map_err(|error| Error::json(path, &error.to_string()))?;
        Ok(merged)
    }
}
