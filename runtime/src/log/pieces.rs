//! A log that is read piece by piece, in memory that does not grow with it.

use std::fs::File;
use std::io::{ErrorKind, Read, Seek};
use std::path::Path;

use super::header::Header;
use super::rows::{self, Rows, Table};
use super::{Columns, Log, LogError};
use crate::signal::resample::whole_steps;

/// Pieces of a log, one after the other; made by [`Log::pieces`].
pub struct Pieces<'a> {
    source: String,
    rows: Box<dyn Rows + 'a>,
    header: Header,
    table: Table,
    samples: usize,
    overlap: f64,
    is_over: bool,
    /// The file, whose place moves as it is read, and its size.
    file: Option<(File, u64)>,
}

impl Log {
    /// Reads a file as [`Log::read_as`] does, piece by piece of about so many samples; each begins `overlap` seconds before the end of
    /// the one before. Time is that of the whole; what jitters is resampled piece by piece.
    ///
    /// # Errors
    /// As [`Log::read`], here and with each piece.
    ///
    /// # Examples
    /// ```
    /// use robot_model::log::{Columns, Log};
    /// let path = std::env::temp_dir().join("robot-model-pieces.csv");
    /// let rows: String = (0..1000).map(|k| format!("{},0.5,{k}\n", 0.0625 * f64::from(k))).collect();
    /// std::fs::write(&path, format!("time,q1,tau1\n{rows}"))?;
    /// let mut seconds = Vec::new();
    /// for piece in Log::pieces(&path, &Columns::standard(1), 300, 0.0)? {
    ///     seconds.push(piece?.seconds());
    /// }
    /// assert!(seconds.len() == 3 && seconds.iter().sum::<f64>() < 62.5);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn pieces(
        path: impl AsRef<Path>,
        columns: &Columns,
        samples: usize,
        overlap: f64,
    ) -> Result<Pieces<'static>, LogError> {
        let (source, file) = Self::open(path.as_ref())?;
        // Both handles have one place in the file.
        let size = file.metadata().map(|about| about.len());
        let looked_at = file.try_clone().ok().zip(size.ok());
        let rows = rows::of_file(&source, file, columns)?;
        let mut pieces = Pieces::of_rows(source, rows, columns, samples, overlap)?;
        pieces.file = looked_at;
        Ok(pieces)
    }

    /// Opens a file to be read, and says its name.
    pub(super) fn open(path: &Path) -> Result<(String, File), LogError> {
        let source = path.display().to_string();
        if path.is_dir() {
            return Err(LogError::Open {
                source_name: source,
                reason: "it is a folder; name the log files in it".to_owned(),
            });
        }
        match File::open(path) {
            Ok(file) => Ok((source, file)),
            Err(error) => Err(LogError::Open {
                source_name: source,
                reason: match error.kind() {
                    ErrorKind::NotFound => {
                        "there is no such file; check its name and folder".to_owned()
                    }
                    _ => error.to_string(),
                },
            }),
        }
    }
}

impl<'a> Pieces<'a> {
    /// Reads pieces as [`Log::pieces`] does; `source` names the log in messages.
    ///
    /// # Errors
    /// Those of [`Log::read`] for the header.
    ///
    /// # Examples
    /// ```
    /// use robot_model::log::{Columns, Pieces};
    /// let mut text = String::from("time,q1,tau1\n");
    /// for k in 0..1000 {
    ///     text += &format!("{},0.5,{k}\n", 0.0625 * f64::from(k));
    /// }
    /// let pieces = Pieces::new("memory", text.as_bytes(), &Columns::standard(1), 300, 1.25)?;
    /// let starts: Result<Vec<f64>, _> = pieces.map(|piece| piece.map(|log| log.tau[0][0])).collect();
    /// assert_eq!(starts?, [0.0, 280.0, 560.0]);
    /// # Ok::<(), robot_model::log::LogError>(())
    /// ```
    pub fn new(
        source: impl Into<String>,
        reader: impl Read + 'a,
        columns: &Columns,
        samples: usize,
        overlap: f64,
    ) -> Result<Self, LogError> {
        let source = source.into();
        let rows = rows::of_reader(&source, reader, columns)?;
        Self::of_rows(source, rows, columns, samples, overlap)
    }

    fn of_rows(
        source: String,
        rows: Box<dyn Rows + 'a>,
        columns: &Columns,
        samples: usize,
        overlap: f64,
    ) -> Result<Self, LogError> {
        let header = Header::of(&source, &*rows, columns)?;
        Ok(Self {
            table: rows.table(&header.needed()),
            header,
            rows,
            source,
            samples,
            overlap,
            is_over: false,
            file: None,
        })
    }

    /// Which part of the file is read, from 0 to 1; none where it is no file of known size.
    ///
    /// # Examples
    /// ```
    /// use robot_model::log::{Columns, Pieces};
    /// let text = "time,q1,tau1\n0.00,0.5,1\n";
    /// let mut pieces = Pieces::new("memory", text.as_bytes(), &Columns::standard(1), 300, 1.25)?;
    /// assert_eq!(pieces.done(), None);
    /// # Ok::<(), robot_model::log::LogError>(())
    /// ```
    pub fn done(&mut self) -> Option<f64> {
        let (file, size) = self.file.as_mut()?;
        let place = file.stream_position().ok()?;
        (*size > 0).then(|| (place as f64 / *size as f64).min(1.0))
    }
}

impl Iterator for Pieces<'_> {
    type Item = Result<Log, LogError>;

    /// The last piece is up to twice as long as the others, so that none is short.
    fn next(&mut self) -> Option<Self::Item> {
        if self.is_over {
            return None;
        }
        match self.rows.fill(&mut self.table, 2 * self.samples) {
            Ok(more) => self.is_over = !more,
            Err(error) => {
                self.is_over = true;
                return Some(Err(error));
            }
        }
        let count = if self.is_over {
            self.table.lines.len()
        } else {
            self.samples
        };
        if count == 0 {
            self.is_over = true;
            let source = self.source.clone();
            return Some(Log::from_table(
                source,
                self.rows.table(&self.header.needed()),
                &self.header,
                Vec::new(),
            ));
        }
        // What overlaps is no more than half, so that every piece has samples of its own.
        let time = &self.table.columns[self.header.time.column];
        let lasts = (time[count - 1] - time[0]) * self.header.time.unit;
        let rate_hz = (count - 1) as f64 / lasts;
        let overlap = whole_steps((self.overlap * rate_hz).ceil()).min(count / 2);
        let table = self.table.split(count, overlap);
        let source = self.source.clone();
        let notes = [
            std::mem::take(&mut self.header.notes),
            self.rows.take_notes(),
        ]
        .concat();
        let piece = Log::from_table(source, table, &self.header, notes);
        self.is_over |= piece.is_err();
        Some(piece)
    }
}
