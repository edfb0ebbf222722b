//! Whether what is left of a joint comes in pulses, as impacts in a gap do: curves in quantities of the motion do not follow these, and a motion
//! that does not repeat has no period to compare them with.

/// Rows with the largest errors, a share of all.
const LARGEST: f64 = 0.05;

/// Noise of any color has 28 % of its power in its largest twentieth (normal distribution), what creeps beside wide reversals up to three
/// quarters; beyond this share it is neither.
pub(super) const MOST: f64 = 0.9;

/// Share of the power that the largest rows have; `residual` is 0 in rows that do not count.
pub(super) fn share_of_largest(residual: &[f64]) -> f64 {
    let squares = residual.iter().map(|value| value * value);
    let mut squares: Vec<f64> = squares.filter(|square| *square > 0.0).collect();
    squares.sort_by(|a, b| b.total_cmp(a));
    let count = (LARGEST * squares.len() as f64).ceil();
    let largest = squares.iter().zip(1_u32..);
    let largest = largest.filter(|(_, place)| f64::from(*place) <= count);
    let largest: f64 = largest.map(|(square, _)| square).sum();
    largest / squares.iter().sum::<f64>().max(f64::MIN_POSITIVE)
}

#[cfg(test)]
mod tests {
    use super::super::series::white;
    use super::*;

    #[test]
    fn noise_has_no_pulses_and_impacts_are() {
        let mut noise = white(4000, 1);
        let share = share_of_largest(&noise);
        // Of uniform noise the largest twentieth has 1 - 0.95^3.
        assert!((share - 0.143).abs() < 0.02, "{share}");
        // Errors of a tenth of the rows, as of a joint that moves now and then.
        let mut seldom = noise.clone();
        seldom.iter_mut().skip(400).for_each(|value| *value *= 0.3);
        assert!(share_of_largest(&seldom) < MOST);
        for place in [300, 1100, 1900, 3100] {
            noise[place..place + 20]
                .iter_mut()
                .for_each(|value| *value += 20.0);
        }
        assert!(share_of_largest(&noise) > MOST);
        // Rows that do not count.
        noise.extend(std::iter::repeat_n(0.0, 4000));
        assert!(share_of_largest(&noise) > MOST);
        assert!(share_of_largest(&[]) < MOST);
    }
}
