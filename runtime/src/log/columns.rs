//! Which columns of a file are which channels, and what they are worth.

/// A column of a file.
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    /// Its name in the header.
    pub name: String,
    /// What a one in it is worth: SI units for time, positions and velocities; for torques and others whatever the arm reads. Without it that is
    /// what a line of units in the log says, else 1.
    pub unit: Option<f64>,
}

/// What the drive of a joint logs as its torque.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub enum DriveSignal {
    /// A torque or force: a line of units in the log may say `Nm`, `N` or `kN`.
    #[default]
    Torque,
    /// A current, of which the arm makes a torque: a line of units may say `A`.
    Current,
    /// A number of any unit, of which the arm makes a torque: a line of units says nothing of it.
    Number,
}

/// The columns of an arm's logs.
///
/// # Examples
/// ```
/// use robot_model::log::{Column, Columns, Log};
/// let column = |name: &str, unit: f64| Column { name: name.to_owned(), unit: Some(unit) };
/// let mut columns = Columns::standard(1);
/// columns.time = column("stamp", 1e-3);
/// columns.q = vec![column("angle", std::f64::consts::PI / 180.0)];
/// let mut text = String::from("stamp,angle,tau1\n");
/// for k in 0..20 {
///     text += &format!("{},90,{k}\n", 10 * k);
/// }
/// let log = Log::from_reader_as("memory", text.as_bytes(), &columns)?;
/// assert_eq!(log.q[0][0], std::f64::consts::FRAC_PI_2);
/// assert!((log.rate_hz() - 100.0).abs() < 1e-9);
/// # Ok::<(), robot_model::log::LogError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Columns {
    /// The time.
    pub time: Column,
    /// Positions, one a joint.
    pub q: Vec<Column>,
    /// Velocities, one a joint, which a log may lack as a whole.
    pub dq: Vec<Column>,
    /// Torques, or what the drive logs in their place, one a joint.
    pub tau: Vec<Column>,
    /// Other channels that have a name of their own for the arm: that name, and their column.
    pub extra: Vec<(String, Column)>,
    /// What drives log, one a joint; torques where it is empty.
    pub signals: Vec<DriveSignal>,
    /// What the joints are called, in their order, for files that have them by name, as bags of ROS 2 do; may be empty for others.
    pub joints: Vec<String>,
    /// The topic of a bag of ROS 2; without it the only one that has joint states.
    pub topic: Option<String>,
}

impl Columns {
    /// `time`, `q1..qn`, `dq1..dqn`, `tau1..taun`, in SI units.
    ///
    /// # Examples
    /// ```
    /// use robot_model::log::Columns;
    /// let columns = Columns::standard(2);
    /// assert_eq!((columns.dof(), columns.time.name.as_str()), (2, "time"));
    /// assert_eq!((columns.q[1].name.as_str(), columns.tau[1].name.as_str()), ("q2", "tau2"));
    /// ```
    #[must_use]
    pub fn standard(dof: usize) -> Self {
        let family = |family: &str| {
            let numbered = (1..=dof).map(|joint| Column::standard(&format!("{family}{joint}")));
            numbered.collect::<Vec<_>>()
        };
        Self {
            time: Column::standard("time"),
            q: family("q"),
            dq: family("dq"),
            tau: family("tau"),
            extra: Vec::new(),
            signals: Vec::new(),
            joints: Vec::new(),
            topic: None,
        }
    }

    /// Number of joints.
    ///
    /// # Examples
    /// ```
    /// assert_eq!(robot_model::log::Columns::standard(6).dof(), 6);
    /// ```
    #[must_use]
    pub fn dof(&self) -> usize {
        self.q.len()
    }

    /// Those of the arm itself, time first.
    fn of_arm(&self) -> impl Iterator<Item = &Column> {
        let time = std::iter::once(&self.time);
        time.chain(&self.q).chain(&self.dq).chain(&self.tau)
    }

    /// All of them.
    pub(super) fn all(&self) -> impl Iterator<Item = &Column> {
        self.of_arm().chain(self.extra.iter().map(|(_, own)| own))
    }

    /// Names by which a file shows that it is written for these columns: those that are not the standard ones, or that have a unit.
    pub(super) fn marks(&self) -> Vec<&str> {
        let standard = Self::standard(self.dof());
        let is_plain = |own: &Column| (own.worth() - 1.0).abs() == 0.0;
        let is_standard = |own: &Column| {
            let mut standard = standard.of_arm();
            is_plain(own) && standard.any(|known| known.name == own.name)
        };
        let marks = self.all().filter(|own| !is_standard(own));
        marks.map(|own| own.name.as_str()).collect()
    }

    /// Names that are not the standard ones.
    pub(super) fn own_names(&self) -> Vec<&str> {
        let standard = Self::standard(self.dof());
        let is_own = |own: &&Column| standard.of_arm().all(|known| known.name != own.name);
        self.all()
            .filter(is_own)
            .map(|own| own.name.as_str())
            .collect()
    }
}

impl Column {
    fn standard(name: &str) -> Self {
        Self {
            name: name.to_owned(),
            unit: None,
        }
    }

    /// What a one in it is worth where the log says nothing of it.
    pub(super) fn worth(&self) -> f64 {
        self.unit.unwrap_or(1.0)
    }
}
