//! Damage of files of any kind: bits, numbers, and parts of them.

use rand::RngExt as _;
use rand_chacha::ChaCha8Rng;

/// Numbers at which readers err: none, all bits, the largest and smallest of each width, powers of two.
const NUMBERS: [u64; 14] = [
    0,
    1,
    2,
    0x7f,
    0x80,
    0xff,
    0x7fff,
    0xffff,
    0x10_0000,
    0x7fff_ffff,
    0xffff_ffff,
    1 << 60,
    u64::MAX >> 1,
    u64::MAX,
];

/// A damaged copy of a file; parts of `other` may be spliced in.
#[must_use]
pub(crate) fn mutate(file: &[u8], other: &[u8], dice: &mut ChaCha8Rng) -> Vec<u8> {
    let mut damaged = file.to_vec();
    for _ in 0..=dice.random_range(0..3_usize) {
        once(&mut damaged, other, dice);
    }
    damaged
}

fn once(damaged: &mut Vec<u8>, other: &[u8], dice: &mut ChaCha8Rng) {
    let at = place(damaged, dice);
    let end = (at + dice.random_range(1..40)).min(damaged.len());
    match dice.random_range(0..16) {
        // Most damage is small, so that what is behind it is read.
        0..4 => {
            if let Some(byte) = damaged.get_mut(at) {
                *byte ^= 1 << dice.random_range(0..8);
            }
        }
        4..6 => {
            if let Some(byte) = damaged.get_mut(at) {
                *byte = dice.random();
            }
        }
        6..10 => {
            let number = number(dice);
            for (byte, new) in damaged[at..].iter_mut().zip(number) {
                *byte = new;
            }
        }
        10 => drop(damaged.splice(at..at, number(dice))),
        11 => drop(damaged.drain(at..end)),
        12 => {
            let again = damaged[at..end].to_vec();
            damaged.splice(at..at, again);
        }
        13 => {
            let to = place(damaged, dice);
            let moved: Vec<u8> = damaged.drain(at..end).collect();
            let to = to.min(damaged.len());
            damaged.splice(to..to, moved);
        }
        14 => {
            let from = place(other, dice);
            let part = &other[from..(from + dice.random_range(1..200)).min(other.len())];
            damaged.splice(at..end, part.iter().copied());
        }
        _ if dice.random_range(0..8) == 0 => damaged.truncate(at),
        _ => {}
    }
}

fn place(file: &[u8], dice: &mut ChaCha8Rng) -> usize {
    dice.random_range(0..file.len().max(1)).min(file.len())
}

/// A number of one to eight bytes, the first or the last byte first, or of seven bits a byte.
fn number(dice: &mut ChaCha8Rng) -> Vec<u8> {
    let number = NUMBERS[dice.random_range(0..NUMBERS.len())];
    let width = 1 << dice.random_range(0..4);
    match dice.random_range(0..3) {
        0 => number.to_le_bytes()[..width].to_vec(),
        1 => number.to_be_bytes()[8 - width..].to_vec(),
        _ => {
            let mut bytes = Vec::new();
            let mut left = number;
            while left > 0x7f {
                bytes.push(0x80 | left.to_le_bytes()[0]);
                left >>= 7;
            }
            bytes.push(left.to_le_bytes()[0]);
            bytes
        }
    }
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng as _;

    use super::*;

    #[test]
    fn files_of_any_length_are_damaged() {
        for file in [&b""[..], b"a", b"PAR1 and so on PAR1"] {
            let damaged = |seed| mutate(file, b"xyz", &mut ChaCha8Rng::seed_from_u64(seed));
            assert_eq!(damaged(3), damaged(3));
            assert!((0..200).any(|seed| damaged(seed) != file));
        }
    }
}
