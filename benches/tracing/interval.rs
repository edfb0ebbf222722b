//! What a share of experiments says of all that might have been drawn.

/// Standard deviations of a normal variable within which 95 % are.
const Z: f64 = 1.96;

/// Wilson's 95 % interval of a share, from 0 to 1, that `draws` independent experiments tell (Wilson 1927).
///
/// Experiments of one draw share motion and noise, so they count as one, which is as if they always agreed.
pub fn wilson(share: f64, draws: usize) -> (f64, f64) {
    let n = draws.max(1) as f64;
    let middle = share + Z * Z / (2.0 * n);
    let half = Z * (share * (1.0 - share) / n + Z * Z / (4.0 * n * n)).sqrt();
    let whole = 1.0 + Z * Z / n;
    (
        ((middle - half) / whole).max(0.0),
        ((middle + half) / whole).min(1.0),
    )
}
