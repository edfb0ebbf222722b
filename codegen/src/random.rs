//! A small deterministic generator for states at which equations are compared.

/// `SplitMix64` (Steele, Lea and Flood 2014): enough for states without special values.
pub struct Generator(u64);

impl Generator {
    /// Same seed, same numbers.
    pub const fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// Uniform in -1 .. 1.
    pub fn symmetric(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^= z >> 31;
        // The 53 high bits fill a double's mantissa.
        (z >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    /// A whole number below `count`.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "0 <= x < count"
    )]
    pub fn below(&mut self, count: usize) -> usize {
        let part = 0.5 * (self.symmetric() + 1.0);
        ((part * count as f64) as usize).min(count - 1)
    }
}
