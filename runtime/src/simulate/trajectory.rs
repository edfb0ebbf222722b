//! The motion that is wanted.

use super::error::SimulateError;
use crate::log::Channel;

/// A step in time of more than so many median ones is a hole.
const HOLE: f64 = 5.0;

/// A wanted motion through samples: positions, and velocities and accelerations where they are given; between samples polynomials
/// with continuous accelerations.
///
/// # Examples
/// ```
/// use robot_model::simulate::Trajectory;
///
/// let time: Vec<f64> = (0..101).map(|k| 0.02 * f64::from(k)).collect();
/// let q = vec![time.iter().map(|t| (2.0 * t).sin()).collect()];
/// let wave = Trajectory::new(time, q, vec![], vec![], vec![])?;
/// let wanted = wave.at(0.777);
/// assert!((wanted.q[0] - (2.0 * 0.777_f64).sin()).abs() < 1e-6);
/// assert!((wanted.ddq[0] + 4.0 * (2.0 * 0.777_f64).sin()).abs() < 2e-3);
/// # Ok::<(), robot_model::simulate::SimulateError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Trajectory {
    time: Vec<f64>,
    q: Vec<Vec<f64>>,
    dq: Vec<Vec<f64>>,
    ddq: Vec<Vec<f64>>,
    extra: Vec<Channel>,
}

/// A wanted motion at an instant, one number a joint.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Desired {
    /// Positions, rad or m.
    pub q: Vec<f64>,
    /// Velocities.
    pub dq: Vec<f64>,
    /// Accelerations.
    pub ddq: Vec<f64>,
}

impl Trajectory {
    /// From samples, `[joint][sample]`; `dq` and `ddq` without joints are not given, and no `ddq` is given without `dq`. What is
    /// missing is that of the cubic spline through what is there; the spline ends without a change of curvature.
    ///
    /// # Errors
    /// [`SimulateError::Size`] where columns differ in length or there are fewer than four samples, [`SimulateError::Setting`] where
    /// time does not rise.
    ///
    /// # Examples
    /// ```
    /// use robot_model::simulate::Trajectory;
    /// // 2 m/s, by four samples; velocities and accelerations are those of a spline.
    /// let time = vec![0.0, 0.1, 0.2, 0.3];
    /// let wanted = Trajectory::new(time, vec![vec![0.0, 0.2, 0.4, 0.6]], vec![], vec![], vec![])?;
    /// assert!((wanted.at(0.15).dq[0] - 2.0).abs() < 1e-12);
    /// let short = Trajectory::new(vec![0.0, 0.1], vec![vec![0.0, 0.2]], vec![], vec![], vec![]).unwrap_err();
    /// assert_eq!(short.to_string(), "the number of samples of a trajectory must be 4 or more, not 2");
    /// # Ok::<(), robot_model::simulate::SimulateError>(())
    /// ```
    pub fn new(
        time: Vec<f64>,
        q: Vec<Vec<f64>>,
        dq: Vec<Vec<f64>>,
        ddq: Vec<Vec<f64>>,
        extra: Vec<Channel>,
    ) -> Result<Self, SimulateError> {
        if time.len() < 4 {
            return Err(SimulateError::Setting {
                what: "the number of samples of a trajectory",
                range: "4 or more",
                value: time.len() as f64,
            });
        }
        check_time("the time of each sample of a trajectory", &time)?;
        for (what, columns) in [
            ("dq of the trajectory", &dq),
            ("ddq of the trajectory", &ddq),
        ] {
            if !columns.is_empty() && columns.len() != q.len() {
                return Err(SimulateError::Size {
                    what,
                    found: columns.len(),
                    expected: q.len(),
                });
            }
        }
        let channels = extra.iter().map(|channel| &channel.values);
        for column in q.iter().chain(&dq).chain(&ddq).chain(channels) {
            if column.len() != time.len() {
                return Err(SimulateError::Size {
                    what: "a column of the trajectory",
                    found: column.len(),
                    expected: time.len(),
                });
            }
            if let Some(value) = column.iter().find(|value| !value.is_finite()) {
                return Err(SimulateError::Setting {
                    what: "each value of a trajectory",
                    range: "a finite number",
                    value: *value,
                });
            }
        }
        let of_spline = |columns: &[Vec<f64>]| -> Vec<Vec<f64>> {
            columns.iter().map(|values| slopes(&time, values)).collect()
        };
        let dq = if dq.is_empty() { of_spline(&q) } else { dq };
        let ddq = if ddq.is_empty() { of_spline(&dq) } else { ddq };
        Ok(Self {
            time,
            q,
            dq,
            ddq,
            extra,
        })
    }

    /// How long it is, s.
    ///
    /// # Examples
    /// ```
    /// use robot_model::simulate::Trajectory;
    /// let time: Vec<f64> = (0..5).map(f64::from).collect();
    /// let steady = vec![vec![0.0, 2.0, 4.0, 6.0, 8.0]];
    /// let wanted = Trajectory::new(time, steady, Vec::new(), Vec::new(), Vec::new())?;
    /// assert_eq!((wanted.duration(), wanted.dof()), (4.0, 1));
    /// assert!((wanted.at(1.5).q[0] - 3.0).abs() < 1e-12);
    /// // Beyond its end it stands.
    /// assert_eq!((wanted.at(9.0).q[0], wanted.at(9.0).dq[0]), (8.0, 0.0));
    /// # Ok::<(), robot_model::simulate::SimulateError>(())
    /// ```
    #[must_use]
    pub fn duration(&self) -> f64 {
        self.time[self.time.len() - 1] - self.time[0]
    }

    /// Where samples are missing: the first step in time of more than five median ones, from when to when.
    ///
    /// # Examples
    /// ```
    /// use robot_model::simulate::Trajectory;
    /// let time = vec![0.0, 0.1, 0.2, 0.3, 2.0, 2.1];
    /// let wanted = Trajectory::new(time, vec![vec![0.0; 6]], Vec::new(), Vec::new(), Vec::new())?;
    /// assert_eq!(wanted.hole(), Some([0.3, 2.0]));
    /// # Ok::<(), robot_model::simulate::SimulateError>(())
    /// ```
    #[must_use]
    pub fn hole(&self) -> Option<[f64; 2]> {
        let pairs = || self.time.windows(2);
        let mut steps: Vec<f64> = pairs().map(|pair| pair[1] - pair[0]).collect();
        steps.sort_unstable_by(f64::total_cmp);
        let longest = HOLE * steps[steps.len() / 2];
        let hole = pairs().find(|pair| pair[1] - pair[0] > longest)?;
        Some([hole[0], hole[1]])
    }

    /// Number of joints.
    ///
    /// # Examples
    /// ```
    /// use robot_model::simulate::Trajectory;
    /// let time = vec![0.0, 0.1, 0.2, 0.3];
    /// let two = vec![vec![0.0; 4], vec![1.0; 4]];
    /// assert_eq!(Trajectory::new(time, two, vec![], vec![], vec![])?.dof(), 2);
    /// # Ok::<(), robot_model::simulate::SimulateError>(())
    /// ```
    #[must_use]
    pub fn dof(&self) -> usize {
        self.q.len()
    }

    /// Channels beside the motion.
    ///
    /// # Examples
    /// ```
    /// use robot_model::log::Channel;
    /// use robot_model::simulate::Trajectory;
    /// let (time, q) = (vec![0.0, 0.1, 0.2, 0.3], vec![vec![0.0; 4]]);
    /// let oil = Channel { name: "temperature".to_owned(), values: vec![20.0, 30.0, 40.0, 50.0] };
    /// let wanted = Trajectory::new(time, q, vec![], vec![], vec![oil])?;
    /// assert_eq!(wanted.extra()[0].name, "temperature");
    /// # Ok::<(), robot_model::simulate::SimulateError>(())
    /// ```
    #[must_use]
    pub fn extra(&self) -> &[Channel] {
        &self.extra
    }

    /// The sample before an instant, and how far the instant is to the next as a share of the way.
    fn place(&self, time: f64) -> (usize, f64) {
        let time = self.time[0] + time.clamp(0.0, self.duration());
        let after = self.time.partition_point(|&sample| sample <= time);
        let k = after.clamp(1, self.time.len() - 1) - 1;
        (k, (time - self.time[k]) / (self.time[k + 1] - self.time[k]))
    }

    /// The motion `time` seconds after its start; at rest beyond its end, where it was last.
    ///
    /// # Examples
    /// ```
    /// use robot_model::simulate::Trajectory;
    /// // t^2, with its velocities and accelerations.
    /// let time = vec![0.0, 1.0, 2.0, 3.0];
    /// let of = |f: fn(&f64) -> f64| vec![time.iter().map(f).collect()];
    /// let wanted = Trajectory::new(time.clone(), of(|t| t * t), of(|t| 2.0 * t), of(|_| 2.0), vec![])?;
    /// let at = wanted.at(1.5);
    /// assert!((at.q[0] - 2.25).abs() < 1e-12 && (at.dq[0] - 3.0).abs() < 1e-12 && (at.ddq[0] - 2.0).abs() < 1e-12);
    /// # Ok::<(), robot_model::simulate::SimulateError>(())
    /// ```
    #[must_use]
    pub fn at(&self, time: f64) -> Desired {
        let (k, s) = self.place(time);
        let h = self.time[k + 1] - self.time[k];
        let mut desired = Desired::default();
        for joint in 0..self.q.len() {
            let pair = |values: &[Vec<f64>]| [values[joint][k], values[joint][k + 1]];
            let [q, dq, ddq] = quintic(pair(&self.q), pair(&self.dq), pair(&self.ddq), h, s);
            desired.q.push(q);
            let is_over = time > self.duration();
            desired.dq.push(if is_over { 0.0 } else { dq });
            desired.ddq.push(if is_over { 0.0 } else { ddq });
        }
        desired
    }

    /// A channel's value `time` seconds after the start, linear between samples; by its place in [`Self::extra`].
    ///
    /// # Examples
    /// ```
    /// use robot_model::log::Channel;
    /// use robot_model::simulate::Trajectory;
    /// let (time, q) = (vec![0.0, 0.1, 0.2, 0.3], vec![vec![0.0; 4]]);
    /// let oil = Channel { name: "temperature".to_owned(), values: vec![20.0, 30.0, 40.0, 50.0] };
    /// let wanted = Trajectory::new(time, q, vec![], vec![], vec![oil])?;
    /// assert!((wanted.channel(0, 0.15) - 35.0).abs() < 1e-12);
    /// # Ok::<(), robot_model::simulate::SimulateError>(())
    /// ```
    #[must_use]
    pub fn channel(&self, channel: usize, time: f64) -> f64 {
        let (k, s) = self.place(time);
        let values = &self.extra[channel].values;
        values[k] + s * (values[k + 1] - values[k])
    }
}

/// The polynomial of degree five with given values, slopes and curvatures at both ends of an interval `h`, and its derivatives, at the
/// share `s` of it.
fn quintic(q: [f64; 2], dq: [f64; 2], ddq: [f64; 2], h: f64, s: f64) -> [f64; 3] {
    let (v, a) = (dq.map(|x| x * h), ddq.map(|x| x * h * h));
    let rise = q[1] - q[0] - v[0] - 0.5 * a[0];
    let slope = v[1] - v[0] - a[0];
    let bend = a[1] - a[0];
    let c3 = 10.0 * rise - 4.0 * slope + 0.5 * bend;
    let c4 = -15.0 * rise + 7.0 * slope - bend;
    let c5 = 6.0 * rise - 3.0 * slope + 0.5 * bend;
    [
        q[0] + s * (v[0] + s * (0.5 * a[0] + s * (c3 + s * (c4 + s * c5)))),
        (v[0] + s * (a[0] + s * (3.0 * c3 + s * (4.0 * c4 + s * 5.0 * c5)))) / h,
        (a[0] + s * (6.0 * c3 + s * (12.0 * c4 + s * 20.0 * c5))) / (h * h),
    ]
}

/// Slopes at the samples of the cubic spline through them, whose first two and last two pieces are one cubic each.
fn slopes(time: &[f64], values: &[f64]) -> Vec<f64> {
    let last = time.len() - 1;
    let h = |k: usize| time[k + 1] - time[k];
    let rise = |k: usize| (values[k + 1] - values[k]) / h(k);
    // Rows `lower, diagonal, upper | right`, the ends with what elimination makes of the missing condition.
    let mut diagonal = vec![0.0; last + 1];
    let mut upper = vec![0.0; last + 1];
    let mut lower = vec![0.0; last + 1];
    let mut right = vec![0.0; last + 1];
    let end = |h0: f64, h1: f64, d0: f64, d1: f64| {
        let sum = h0 + h1;
        (h1, sum, ((h0 + 2.0 * sum) * h1 * d0 + h0 * h0 * d1) / sum)
    };
    (diagonal[0], upper[0], right[0]) = end(h(0), h(1), rise(0), rise(1));
    (diagonal[last], lower[last], right[last]) =
        end(h(last - 1), h(last - 2), rise(last - 1), rise(last - 2));
    for k in 1..last {
        lower[k] = h(k);
        diagonal[k] = 2.0 * (h(k - 1) + h(k));
        upper[k] = h(k - 1);
        right[k] = 3.0 * (h(k) * rise(k - 1) + h(k - 1) * rise(k));
    }
    for k in 1..=last {
        let factor = lower[k] / diagonal[k - 1];
        diagonal[k] -= factor * upper[k - 1];
        right[k] -= factor * right[k - 1];
    }
    right[last] /= diagonal[last];
    for k in (0..last).rev() {
        right[k] = (right[k] - upper[k] * right[k + 1]) / diagonal[k];
    }
    right
}

/// That time rises, by numbers.
pub(super) fn check_time(what: &'static str, time: &[f64]) -> Result<(), SimulateError> {
    let first = time.iter().take(1).filter(|time| !time.is_finite());
    let later = time.windows(2).filter(|pair| {
        let rises = pair[1] > pair[0] && pair[1].is_finite();
        !rises
    });
    match first.chain(later.map(|pair| &pair[1])).next() {
        None => Ok(()),
        Some(value) => Err(SimulateError::Setting {
            what,
            range: "a number, and later than that of the sample before",
            value: *value,
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_has_no_motion_is_refused() {
        let time = || vec![0.0, 0.1, 0.2, 0.3];
        let column = || vec![1.0; 4];
        let refused = |time, q, dq| {
            let made = Trajectory::new(time, q, dq, vec![], vec![]);
            made.expect_err("no trajectory").to_string()
        };
        let two = || vec![column(), column()];
        let size = refused(time(), two(), vec![column()]);
        assert_eq!(size, "dq of the trajectory has 1 where the arm has 2");
        for bad in [f64::NAN, f64::INFINITY, 0.1] {
            let mut times = time();
            times[2] = bad;
            assert!(refused(times, two(), vec![]).contains("the time of each sample"));
        }
        let mut q = two();
        q[1][3] = f64::NAN;
        assert!(refused(time(), q, vec![]).contains("a finite number"));
    }

    #[test]
    fn cubics_come_out_exactly() {
        let time = vec![0.0, 0.3, 0.5, 1.1, 1.2, 2.0];
        let cubic = |t: f64| 1.0 + t * (2.0 + t * (-3.0 + 0.7 * t));
        let q = vec![time.iter().map(|&t| cubic(t)).collect()];
        let motion = Trajectory::new(time, q, vec![], vec![], vec![]).expect("sound");
        for t in [0.0, 0.1, 0.45, 0.9, 1.15, 1.9, 2.0] {
            let wanted = motion.at(t);
            assert!((wanted.q[0] - cubic(t)).abs() < 1e-12, "{t}");
            assert!(
                (wanted.dq[0] - (2.0 - 6.0 * t + 2.1 * t * t)).abs() < 1e-11,
                "{t}"
            );
            assert!((wanted.ddq[0] - (-6.0 + 4.2 * t)).abs() < 1e-9, "{t}");
        }
        assert_eq!(motion.at(9.0).dq, [0.0]);
        assert!((motion.at(9.0).q[0] - cubic(2.0)).abs() < 1e-12);
    }
}
