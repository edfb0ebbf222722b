//! Limits that are no straight lines in the coefficients: torques, and room around the arm.

use super::function::Function;

/// Takes a limit at an instant: its number, its slack, and pairs of an output and the slack's slope by it.
pub type Tell<'a> = &'a mut dyn FnMut(usize, f64, &[(usize, f64)]);

/// A limit on the outputs of a function: `slack >= 0` each, with its slopes by the outputs. A torque's slack is a share of its limit,
/// that of a room is in m.
///
/// # Examples
/// The room above a table, as implemented at [`Function`]:
/// ```
/// # mod room { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/room.rs")); }
/// use robot_model::excite::Clearance;
/// // The table is at -0.2 m, and the tip at -0.3 m.
/// room::AboveTable.slacks(&[-0.3], &mut |which, slack, _: &[(usize, f64)]| {
///     assert_eq!(room::AboveTable.name(which), "height above the table");
///     assert_eq!(room::AboveTable.amount(slack), "100 mm");
/// });
/// ```
pub trait Clearance: std::fmt::Debug + Sync {
    /// What the limit is on, with slopes that can be followed.
    ///
    /// # Examples
    /// ```
    /// # mod room { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/room.rs")); }
    /// use robot_model::excite::Clearance;
    /// // A limit on one number, the height.
    /// assert_eq!(room::AboveTable.function().outputs(), 1);
    /// ```
    fn function(&self) -> &dyn Function;

    /// What is verified in the end: the same without anything smoothed.
    ///
    /// # Examples
    /// ```
    /// # mod room { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/room.rs")); }
    /// use robot_model::excite::Clearance;
    /// use robot_model::motion::Kinematics;
    /// // Nothing is smoothed in a height.
    /// let motion = Kinematics { q: vec![vec![0.7]], dq: vec![vec![0.0]], ddq: vec![vec![0.0]] };
    /// let (clearance, values) = (room::AboveTable, vec![vec![0.5 * 0.7_f64.sin()]]);
    /// assert_eq!((clearance.exact().values(&motion), clearance.function().values(&motion)), (values.clone(), values));
    /// ```
    fn exact(&self) -> &dyn Function {
        self.function()
    }

    /// Tells each limit at an instant; `values` has one number an output.
    ///
    /// # Examples
    /// ```
    /// # mod room { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/room.rs")); }
    /// use robot_model::excite::Clearance;
    /// // The table is at -0.2 m: 0.1 m are missing, and any height is one slack.
    /// let mut told = Vec::new();
    /// room::AboveTable.slacks(&[-0.3], &mut |which, slack, slopes: &[(usize, f64)]| told.push((which, slack, slopes[0])));
    /// let (which, slack, slope) = told[0];
    /// assert!(told.len() == 1 && which == 0 && (slack + 0.1).abs() < 1e-12 && slope == (0, 1.0));
    /// ```
    fn slacks(&self, values: &[f64], tell: Tell<'_>);

    /// A limit by its number, for people.
    ///
    /// # Examples
    /// ```
    /// # mod room { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/room.rs")); }
    /// use robot_model::excite::Clearance;
    /// assert_eq!(room::AboveTable.name(0), "height above the table");
    /// ```
    fn name(&self, which: usize) -> String;

    /// A slack that is missing, for people.
    ///
    /// # Examples
    /// ```
    /// # mod room { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/room.rs")); }
    /// use robot_model::excite::Clearance;
    /// assert_eq!(room::AboveTable.amount(-0.1), "100 mm");
    /// ```
    fn amount(&self, slack: f64) -> String;
}

/// Torques, each at most so large either way.
pub struct TorqueLimits {
    /// Torques of the nominal arm, one output a joint.
    pub torque: Box<dyn Function>,
    /// The same with dry friction that jumps where `torque` has it turn round smoothly.
    pub exact: Box<dyn Function>,
    /// Limits, N m or N; infinite for none.
    pub limits: Vec<f64>,
    /// Names of the joints.
    pub joints: Vec<String>,
}

impl std::fmt::Debug for TorqueLimits {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("TorqueLimits")
            .field("limits", &self.limits)
            .finish_non_exhaustive()
    }
}

impl Clearance for TorqueLimits {
    fn function(&self) -> &dyn Function {
        &*self.torque
    }

    fn exact(&self) -> &dyn Function {
        &*self.exact
    }

    fn slacks(&self, values: &[f64], tell: Tell<'_>) {
        for (joint, (torque, limit)) in values.iter().zip(&self.limits).enumerate() {
            if limit.is_finite() {
                tell(joint, 1.0 - torque / limit, &[(joint, -1.0 / limit)]);
                tell(joint, 1.0 + torque / limit, &[(joint, 1.0 / limit)]);
            }
        }
    }

    fn name(&self, which: usize) -> String {
        format!("torque of `{}`", self.joints[which])
    }

    fn amount(&self, slack: f64) -> String {
        format!("{:.0} %", -100.0 * slack)
    }
}

/// A ball that moves with the arm.
#[derive(Debug, Clone, PartialEq)]
pub struct Ball {
    /// For messages: the link that it is on.
    pub link: String,
    /// Which link it is on, to tell neighbors: the number of the joint that moves it, from 0.
    pub on: usize,
    /// m
    pub radius: f64,
}

/// Space that balls around the links may be in, and the distance that they keep from each other.
pub struct Room {
    /// Centers of the balls in the base frame, three outputs a ball, m.
    pub centers: Box<dyn Function>,
    /// The balls.
    pub balls: Vec<Ball>,
    /// Half spaces: `normal . p >= offset` for every point of a ball.
    pub planes: Vec<([f64; 3], f64)>,
    /// Least distance between balls of links that are no neighbors, m; none if absent.
    pub apart: Option<f64>,
}

impl std::fmt::Debug for Room {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Room")
            .field("balls", &self.balls)
            .field("planes", &self.planes)
            .field("apart", &self.apart)
            .finish_non_exhaustive()
    }
}

impl Room {
    /// Pairs of balls that keep a distance: those of one link and of neighbors touch anyway.
    fn pairs(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        let count = if self.apart.is_some() {
            self.balls.len()
        } else {
            0
        };
        (0..count)
            .flat_map(move |i| (i + 1..count).map(move |k| (i, k)))
            .filter(|&(i, k)| self.balls[i].on.abs_diff(self.balls[k].on) > 1)
    }
}

impl Clearance for Room {
    fn function(&self) -> &dyn Function {
        &*self.centers
    }

    fn slacks(&self, values: &[f64], tell: Tell<'_>) {
        let mut which = 0;
        for (k, ball) in self.balls.iter().enumerate() {
            for (normal, offset) in &self.planes {
                let height: f64 = (0..3).map(|i| normal[i] * values[3 * k + i]).sum();
                let slopes: [(usize, f64); 3] = std::array::from_fn(|i| (3 * k + i, normal[i]));
                tell(which, height - offset - ball.radius, &slopes);
                which += 1;
            }
        }
        for (i, k) in self.pairs() {
            let between: [f64; 3] = std::array::from_fn(|x| values[3 * i + x] - values[3 * k + x]);
            let distance = between.iter().map(|d| d * d).sum::<f64>().sqrt();
            let least = self.balls[i].radius + self.balls[k].radius + self.apart.unwrap_or(0.0);
            let away = |x: usize| between[x] / distance.max(f64::MIN_POSITIVE);
            let slopes: [(usize, f64); 6] = std::array::from_fn(|x| match x {
                0..3 => (3 * i + x, away(x)),
                _ => (3 * k + x - 3, -away(x - 3)),
            });
            tell(which, distance - least, &slopes);
            which += 1;
        }
    }

    fn name(&self, which: usize) -> String {
        let planes = self.planes.len();
        if which < self.balls.len() * planes {
            let (normal, offset) = &self.planes[which % planes];
            let link = &self.balls[which / planes].link;
            return format!("ball on `{link}` beyond the plane {normal:?} . p = {offset}");
        }
        let pair = self.pairs().nth(which - self.balls.len() * planes);
        let link = |k: usize| &self.balls[k].link;
        pair.map_or_else(String::new, |(i, k)| {
            format!("balls on `{}` and `{}`", link(i), link(k))
        })
    }

    fn amount(&self, slack: f64) -> String {
        format!("{:.0} mm", -1000.0 * slack)
    }
}
