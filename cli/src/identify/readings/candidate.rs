//! Which of several readings of a log is the one to tell.

use super::{Reading, WELL_IN_SIGNS};

/// By which factor errors have to be less in another reading.
pub(super) const FACTOR: f64 = 2.0;

/// By which factor that of one joint has to be less where no other one's is more: friction and encoders leave of a light joint what no reading
/// mends.
const FACTOR_OF_ONE: f64 = 4.0;
const NO_MORE: f64 = 1.1;

/// An exchange of columns is a step to their order where it leaves this share of the errors, and a reading is better than a plainer one.
pub(super) const LESS: f64 = 0.9;

/// What a fit leaves and finds.
pub(super) struct Found {
    /// Of each joint's torque, percent.
    pub(super) left: Vec<f64>,
    /// Parameters below zero that no arm has there.
    pub(super) impossible: usize,
}

/// A reading and what comes of it.
pub(super) struct Candidate {
    pub(super) reading: Reading,
    pub(super) found: Found,
}

impl Candidate {
    /// The better of two. One torque the other way round is all others the other way round, with an arm of negative parameters: of readings
    /// that are as good the possible one, and of these the first, which is the plainest.
    fn better(self, next: Self) -> Self {
        let [best, other] = [&self, &next].map(|one| all(&one.found.left));
        let is_less = other < LESS * best;
        let is_alike = LESS * other <= best;
        if is_less || is_alike && next.found.impossible < self.found.impossible {
            next
        } else {
            self
        }
    }
}

/// The best of the readings that leave far less than the log as it is.
pub(super) fn best(mut candidates: Vec<Candidate>, as_logged: &[f64]) -> Option<Candidate> {
    candidates.retain(|candidate| is_far_less(&candidate.found.left, as_logged));
    candidates.into_iter().reduce(Candidate::better)
}

/// Whether a reading leaves so much less than the log as it is that the log is to be read like that.
fn is_far_less(left: &[f64], as_logged: &[f64]) -> bool {
    let pairs = || left.iter().zip(as_logged);
    let is_no_more = pairs().all(|(left, before)| *left <= NO_MORE * before);
    let mut ill = pairs().filter(|(_, before)| **before > WELL_IN_SIGNS);
    FACTOR * all(left) < all(as_logged)
        || is_no_more && ill.any(|(left, before)| FACTOR_OF_ONE * left < *before)
}

/// Percents of all joints as one.
pub(super) fn all(percents: &[f64]) -> f64 {
    let squares: f64 = percents.iter().map(|percent| percent * percent).sum();
    (squares / percents.len().max(1) as f64).sqrt()
}

#[cfg(test)]
mod tests {
    use super::super::Channel;
    use super::super::units::Units;
    use super::*;

    fn candidate(reading: Reading, left: [f64; 2]) -> Candidate {
        let found = Found {
            left: left.to_vec(),
            impossible: 0,
        };
        Candidate { reading, found }
    }

    #[test]
    fn a_reading_that_mends_one_joint_goes_before_one_that_mends_none() {
        let all = |left| {
            let turns = candidate(Reading::In(Units::ALL[1], vec![0, 1]), [10.0, 6.0]);
            let mirrored = candidate(Reading::Mirrored(Channel::Torque, 1), left);
            best(vec![turns, mirrored], &[12.0, 6.0])
        };
        // Over both joints it is a little worse than the other one.
        let found = all([12.0, 1.0]).expect("one joint with a sixth");
        assert!(matches!(
            found.reading,
            Reading::Mirrored(Channel::Torque, 1)
        ));
        // Half of one joint's error is nothing to be told.
        assert!(all([12.0, 3.0]).is_none());
    }
}
