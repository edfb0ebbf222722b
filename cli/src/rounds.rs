//! How long the rounds of a trace are and how many there are at most: nobody knows how many it takes before it has ended.

use std::time::{Duration, Instant};

use indicatif::HumanDuration;

/// What has to be behind of a round, as a share and in time, before it says how long it is.
const ENOUGH: f64 = 0.2;
const LONG: Duration = Duration::from_secs(2);

/// Rounds of one arm.
#[derive(Debug)]
pub(crate) struct Rounds {
    most: usize,
    /// Those that have begun.
    count: usize,
    begun: Instant,
    done: f64,
    each: Option<Duration>,
}

impl Rounds {
    /// Of which there are so many at most.
    pub(crate) fn new(most: usize) -> Self {
        Self {
            most,
            count: 0,
            begun: Instant::now(),
            done: 1.0,
            each: None,
        }
    }

    /// What is said of a stage, of which a share is done where it is a round.
    pub(crate) fn told(&mut self, words: &str, done: Option<f64>) -> String {
        let Some(done) = done else {
            return words.to_owned();
        };
        if done < self.done {
            self.count += 1;
            self.begun = Instant::now();
        }
        self.done = done;
        let took = self.begun.elapsed();
        if done >= ENOUGH && took >= LONG {
            self.each = Some(took.div_f64(done));
        }
        let each = self.each.map(|each| {
            let rounds = |count: f64| {
                let seconds = (count * each.as_secs_f64()).round();
                HumanDuration(Duration::from_secs_f64(seconds))
            };
            // Nobody knows which round is the last.
            let all = self.most.saturating_sub(self.count) as f64 + 1.0 - done;
            format!(
                ": {:#} more for this one, {:#} if all are needed",
                rounds(1.0 - done),
                rounds(all)
            )
        });
        let (most, each) = (self.most, each.unwrap_or_default());
        format!("{words}; at most {most} rounds{each}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_round_says_how_long_it_is_once_a_part_of_it_is_done() {
        let mut rounds = Rounds::new(6);
        assert_eq!(rounds.told("fitting", None), "fitting");
        let begins = rounds.told("round 1", Some(0.0));
        assert_eq!(begins, "round 1; at most 6 rounds");
        // What is quick needs no time told.
        assert_eq!(rounds.told("round 1", Some(0.5)), begins);
        let ago = Instant::now().checked_sub(Duration::from_secs(20));
        rounds.begun = ago.expect("a machine that is on");
        let told = rounds.told("round 1", Some(0.5));
        assert_eq!(
            told,
            "round 1; at most 6 rounds: 20s more for this one, 4m if all are needed"
        );
        // The next one begins with what is known of the one before.
        let told = rounds.told("round 2", Some(0.0));
        assert_eq!(
            told,
            "round 2; at most 6 rounds: 40s more for this one, 3m if all are needed"
        );
    }
}
