//! A log without gaps and white numbers, for tests.

use crate::identify::Segment;

pub(super) const HZ: f64 = 40.0;

pub(super) fn segment(rows: u32) -> Segment {
    Segment {
        start: 0,
        time: (0..rows).map(|k| f64::from(k) / HZ).collect(),
    }
}

/// White numbers of a deviation of one.
pub(super) fn white(rows: u32, seed: u32) -> Vec<f64> {
    let random = |k: u32| {
        let hash = (k + 7919 * seed)
            .wrapping_mul(2_654_435_761)
            .rotate_left(13)
            ^ 0x5bd1_e995;
        let hash = hash.wrapping_mul(0x85eb_ca6b) ^ (hash >> 15);
        (f64::from(hash.wrapping_mul(0xc2b2_ae35) >> 1) / f64::from(u32::MAX >> 1) - 0.5)
            * 12_f64.sqrt()
    };
    (0..rows).map(random).collect()
}
