//! Where a channel is in a file.

/// Where a channel is in a row, and what a one there is worth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Place {
    pub column: usize,
    pub unit: f64,
    /// Whether that is said, by settings.
    pub is_said: bool,
}

impl Place {
    /// Of what nobody says anything.
    pub(super) fn plain(column: usize) -> Self {
        Self {
            column,
            unit: 1.0,
            is_said: false,
        }
    }
}
