//! Motions at constant speeds.

use std::fmt::Write;

/// Positions, velocities and accelerations over time.
pub struct Motion {
    step: f64,
    at: [f64; 3],
    rows: Vec<[f64; 3]>,
}

impl Motion {
    pub fn new(q: f64) -> Self {
        let at = [q, 0.0, 0.0];
        Self {
            step: 0.005,
            at,
            rows: vec![at],
        }
    }

    /// Goes on at an acceleration.
    pub fn accelerate(&mut self, acceleration: f64, seconds: f64) {
        let mut left = seconds;
        while left > 0.5 * self.step {
            let [q, dq, _] = self.at;
            let h = self.step;
            let next = dq + h * acceleration;
            self.at = [q + 0.5 * h * (dq + next), next, acceleration];
            self.rows.push(self.at);
            left -= h;
        }
    }

    /// Reaches a speed, keeps it, and rests.
    pub fn run(&mut self, speed: f64, seconds: f64) {
        // In whole steps.
        let steps = (speed.abs() / 15.0 / self.step).ceil().max(4.0);
        let rise = steps * self.step;
        for (acceleration, seconds) in [
            (speed / rise, rise),
            (0.0, seconds),
            (-speed / rise, rise),
            (0.0, 0.2),
        ] {
            self.accelerate(acceleration, seconds);
        }
    }

    /// A trajectory of an arm whose other joints stand at `before`.
    pub fn csv(&self, before: &[f64]) -> String {
        let mut text = String::from("time");
        let joints = before.len() + 1;
        for stem in ["q", "dq", "ddq"] {
            (1..=joints).for_each(|joint| write!(text, ",{stem}{joint}").expect("text"));
        }
        for (k, row) in self.rows.iter().enumerate() {
            write!(text, "\n{:.4}", self.step * k as f64).expect("text");
            for (order, value) in row.iter().enumerate() {
                for stand in before {
                    let stand = if order == 0 { *stand } else { 0.0 };
                    write!(text, ",{stand}").expect("text");
                }
                write!(text, ",{value}").expect("text");
            }
        }
        text
    }
}

/// `count` speeds from 30 to at most 310 degrees and quickly back, from `least` to `most`.
pub fn speeds(count: i32, least: f64, most: f64) -> Motion {
    let (low, high) = (30_f64.to_radians(), 310_f64.to_radians());
    let mut motion = Motion::new(low);
    for k in 0..count {
        let speed = least * (most / least).powf(f64::from(k) / f64::from(count - 1));
        motion.run(speed, (0.85 * (high - low) / speed).min(3.0));
        let back = motion.at[0] - low;
        // Two quarters of the way to speed up and slow down.
        let seconds = 0.2 * (back / 0.4).sqrt().max(1.0).ceil();
        let acceleration = -back / seconds.powi(2);
        motion.accelerate(acceleration, seconds);
        motion.accelerate(-acceleration, seconds);
        motion.accelerate(0.0, 0.2);
        motion.at = [low, 0.0, 0.0];
    }
    motion
}
