//! Where logs have their channels, as it was written.

use proc_macro2::Span;
use syn::LitStr;

use super::Expr;

/// `log { .. }`
#[derive(Debug, Clone)]
pub struct LogBlock {
    /// The word `log`.
    pub keyword: Span,
    /// Channels in order.
    pub channels: Vec<LogChannel>,
}

/// `q = "pos_a": deg, "pos_b": deg`
#[derive(Debug, Clone)]
pub struct LogChannel {
    /// `time`, `q`, `dq`, `tau`, `topic`, or an input of an effect.
    pub key: String,
    /// Where that stands.
    pub span: Span,
    /// One column, or one for each joint.
    pub columns: Vec<LogColumn>,
}

/// `"pos_a": deg`
#[derive(Debug, Clone)]
pub struct LogColumn {
    /// Its name in the header.
    pub name: LitStr,
    /// What a one in it is worth.
    pub unit: Option<Expr>,
}
