//! Ranges of parameters that somebody says as a share of their values, and others that are given for them.

/// Part of the width of a range by which its ends may be off: what is rounded to be written down.
const ROUNDED: f64 = 0.1;

/// Ranges of a share of each value to either side, `[x - share |x|, x + share |x|]`: bounds as a text says them, "30 % about CAD".
///
/// # Examples
/// ```
/// use robot_model::identify::output_error::ranges_within;
/// let [mass, offset] = ranges_within(&[2.0, -1.0], 0.25)[..] else { panic!("one a value") };
/// assert_eq!((mass, offset), ([1.5, 2.5], [-1.25, -0.75]));
/// ```
#[must_use]
pub fn ranges_within(values: &[f64], share: f64) -> Vec<[f64; 2]> {
    let range = |&x: &f64| [x - share * x.abs(), x + share * x.abs()];
    values.iter().map(range).collect()
}

/// Places of ranges that are not what is said of them: an end is off by more than a tenth of the width that is said, or is no number.
/// Ends within that are taken for rounded ones.
///
/// # Examples
/// ```
/// use robot_model::identify::output_error::{other_ranges, ranges_within};
/// let said = ranges_within(&[5.914, 0.19], 0.3);
/// // 4.14 .. 7.69 kg and 0.133 .. 0.247 m, of which somebody wrote down:
/// assert_eq!(other_ranges(&[[5.0, 7.0], [0.13, 0.25]], &said), [0]);
/// assert_eq!(other_ranges(&[[4.1, 7.7], [0.13, 0.25]], &said), [0; 0]);
/// ```
#[must_use]
pub fn other_ranges(given: &[[f64; 2]], said: &[[f64; 2]]) -> Vec<usize> {
    let pairs = given.iter().zip(said).enumerate();
    let others = pairs.filter(|(_, (given, said))| {
        let room = ROUNDED * (said[1] - said[0]);
        let is_rounded = |end: usize| (given[end] - said[end]).abs() <= room;
        !(is_rounded(0) && is_rounded(1))
    });
    others.map(|(place, _)| place).collect()
}
