//! What is simulated: equations of motion with sizes known at run time.

use nalgebra::{DMatrix, DVector};

/// Everything that a torque may depend on at an instant.
#[derive(Debug, Clone, Copy)]
pub struct Instant<'a> {
    /// Time, s.
    pub time: f64,
    /// Positions, rad or m.
    pub q: &'a [f64],
    /// Velocities.
    pub dq: &'a [f64],
    /// Accelerations.
    pub ddq: &'a [f64],
    /// Internal states of effects.
    pub memory: &'a [f64],
    /// Where jumps stand, -1 to 1.
    pub switches: &'a [f64],
    /// Torque of the motors, N m or N; 0 where a degree of freedom has none.
    pub torque: &'a [f64],
    /// Channels from outside, such as a temperature.
    pub inputs: &'a [f64],
}

/// How the torque jumps at an instant, where switches stand between their ends.
#[derive(Debug, Clone, PartialEq)]
pub struct Jumps {
    /// `d tau / d s`, `[joint][switch]`: half of what the torque jumps by.
    pub halves: DMatrix<f64>,
    /// `d g / d dq`, `[switch][joint]`.
    pub directions: DMatrix<f64>,
    /// `dg/dt` less what accelerations make of it.
    pub drifts: DVector<f64>,
}

/// Slopes of the torque and of the rates of internal states, all else held.
#[derive(Debug, Clone, PartialEq)]
pub struct Slopes {
    /// `d tau / dq`, `d tau / d dq` and `d tau / dz`.
    pub torque: [DMatrix<f64>; 3],
    /// `d (dz/dt)` by `q`, `dq` and `z`.
    pub rates: [DMatrix<f64>; 3],
    /// `d (dz/dt)` by `ddq`.
    pub rates_by_acceleration: DMatrix<f64>,
}

/// An arm to be simulated: `tau = f(q, dq, ddq, z, s, ..)`, solved for `ddq` by whoever simulates it.
///
/// `n` degrees of freedom, `p` internal states `z` of effects, `m` switches `s`. A switch is the sign of a continuous `g(q, dq, time)` where the
/// torque jumps, as dry friction does where a joint turns round; the torque is affine in each. A plant without jumps has none.
///
/// # Examples
/// Where a motor pulls a load by a spring, the load stands until the spring overcomes its friction.
/// ```
#[doc = include_str!("../../tests/doc/cart.rs")]
/// use robot_model::simulate::{Integrator, Tolerances};
///
/// let mut cart = Integrator::new(Cart, &[0.02, 0.0], &[0.0, 0.0], Tolerances::default())?;
/// assert_eq!(cart.accelerations()?, [-2.0, 0.0]); // 2 N are less than 3 N
/// let mut cart = Integrator::new(Cart, &[0.05, 0.0], &[0.0, 0.0], Tolerances::default())?;
/// assert_eq!(cart.accelerations()?, [-5.0, 1.0]); // (5 N - 3 N) / 2 kg
/// # Ok::<(), robot_model::simulate::SimulateError>(())
/// ```
pub trait Plant {
    /// Degrees of freedom, `n`.
    ///
    /// # Examples
    /// ```
    /// # mod cart { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/cart.rs")); }
    /// use robot_model::simulate::Plant;
    /// assert_eq!(cart::Cart.dof(), 2); // the motor and the load
    /// ```
    fn dof(&self) -> usize;

    /// Joints, with a motor and an encoder each: the first of the degrees of freedom. Others are links behind springs.
    ///
    /// # Examples
    /// ```
    /// # mod cart { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/cart.rs")); }
    /// use robot_model::simulate::Plant;
    /// // The load has no motor.
    /// assert_eq!((cart::Cart.dof(), cart::Cart.joints()), (2, 1));
    /// ```
    fn joints(&self) -> usize {
        self.dof()
    }

    /// The joint that a degree of freedom belongs to.
    ///
    /// # Examples
    /// ```
    /// # mod cart { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/cart.rs")); }
    /// use robot_model::simulate::Plant;
    /// // The load hangs on the motor.
    /// assert_eq!(cart::Cart.joint(1), 0);
    /// ```
    fn joint(&self, coordinate: usize) -> usize {
        coordinate
    }

    /// Positions of all degrees of freedom where joints stand and move as at an instant, and what hangs on them hangs quietly.
    ///
    /// # Examples
    /// ```
    /// # mod cart { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/cart.rs")); }
    /// use robot_model::simulate::Plant;
    /// // At rest the load is where the motor is.
    /// assert_eq!(cart::Cart.start(&cart::PULLED), [0.02, 0.02]);
    /// ```
    fn start(&mut self, joints: &Instant<'_>) -> Vec<f64> {
        joints.q.to_vec()
    }

    /// Internal states, `p`.
    ///
    /// # Examples
    /// ```
    /// # mod cart { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/cart.rs")); }
    /// use robot_model::simulate::Plant;
    /// // A filter of the load's velocity.
    /// assert_eq!(cart::Cart.states(), 1);
    /// ```
    fn states(&self) -> usize {
        0
    }

    /// Switches, `m`.
    ///
    /// # Examples
    /// ```
    /// # mod cart { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/cart.rs")); }
    /// use robot_model::simulate::Plant;
    /// // The sign of the load's velocity.
    /// assert_eq!(cart::Cart.switches(), 1);
    /// ```
    fn switches(&self) -> usize {
        0
    }

    /// Whether the torque is affine in the accelerations; Newton's method solves for them where it is not.
    ///
    /// # Examples
    /// ```
    /// # mod cart { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/cart.rs")); }
    /// use robot_model::simulate::Plant;
    /// assert!(cart::Cart.is_affine()); // m ddq, and no friction that grows with the load
    /// ```
    fn is_affine(&self) -> bool {
        true
    }

    /// Whether anything depends on time or on inputs.
    ///
    /// # Examples
    /// ```
    /// # mod cart { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/cart.rs")); }
    /// use robot_model::simulate::Plant;
    /// assert!(!cart::Cart.is_timed()); // neither torque nor rates read the time
    /// ```
    fn is_timed(&self) -> bool {
        false
    }

    /// Torque that the motion takes, `n`, and `d tau / d ddq`, `n` by `n`.
    ///
    /// # Examples
    /// ```
    /// # mod cart { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/cart.rs")); }
    /// use nalgebra::{DMatrix, DVector};
    /// use robot_model::simulate::Plant;
    /// // The spring pulls with 2 N, and nothing moves.
    /// let (mut torque, mut inertia) = (DVector::zeros(2), DMatrix::zeros(2, 2));
    /// cart::Cart.torque(&cart::PULLED, &mut torque, &mut inertia);
    /// assert_eq!(torque.as_slice(), [2.0, -2.0]);
    /// assert_eq!(inertia.as_slice(), [1.0, 0.0, 0.0, 2.0]); // kg
    /// ```
    fn torque(&mut self, at: &Instant<'_>, torque: &mut DVector<f64>, inertia: &mut DMatrix<f64>);

    /// Rates `dz/dt`, `p`.
    ///
    /// # Examples
    /// ```
    /// # mod cart { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/cart.rs")); }
    /// use robot_model::simulate::Plant;
    /// use robot_model::simulate::Instant;
    /// // The load at 0.3 m/s, a filter of 0.5 s that shows 0.1 m/s.
    /// let mut rates = [0.0];
    /// cart::Cart.rates(&Instant { dq: &[0.0, 0.3], memory: &[0.1], ..cart::PULLED }, &mut rates);
    /// assert!((rates[0] - 0.4).abs() < 1e-12);
    /// ```
    fn rates(&mut self, _at: &Instant<'_>, _rates: &mut [f64]) {}

    /// What the switches are signs of, `m`.
    ///
    /// # Examples
    /// ```
    /// # mod cart { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/cart.rs")); }
    /// use robot_model::simulate::Plant;
    /// use robot_model::simulate::Instant;
    /// let mut arguments = [0.0];
    /// cart::Cart.arguments(&Instant { dq: &[0.1, -0.3], ..cart::PULLED }, &mut arguments);
    /// assert_eq!(arguments, [-0.3]); // of the load
    /// ```
    fn arguments(&mut self, _at: &Instant<'_>, _arguments: &mut [f64]) {}

    /// How the torque jumps.
    ///
    /// # Examples
    /// ```
    /// # mod cart { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/cart.rs")); }
    /// use robot_model::simulate::Plant;
    /// use robot_model::simulate::Jumps;
    /// let mut jumps = Jumps::zeros(&cart::Cart);
    /// cart::Cart.jumps(&cart::PULLED, &mut jumps);
    /// // 3 N one way or the other, on the load.
    /// assert_eq!(jumps.halves.as_slice(), [0.0, 3.0]);
    /// ```
    fn jumps(&mut self, _at: &Instant<'_>, _jumps: &mut Jumps) {}

    /// Slopes, for implicit steps.
    ///
    /// # Examples
    /// ```
    /// # mod cart { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/cart.rs")); }
    /// use robot_model::simulate::{Plant, Slopes};
    /// let mut slopes = Slopes::zeros(&cart::Cart);
    /// cart::Cart.slopes(&cart::PULLED, &mut slopes);
    /// // By positions that of the spring, N/m; of the filter 1 / 0.5 s by velocity and by itself.
    /// assert_eq!(slopes.torque[0].as_slice(), [100.0, -100.0, -100.0, 100.0]);
    /// assert_eq!((slopes.rates[1][(0, 1)], slopes.rates[2][(0, 0)]), (2.0, -2.0));
    /// ```
    fn slopes(&mut self, at: &Instant<'_>, slopes: &mut Slopes);
}

impl Jumps {
    /// Room for those of a plant.
    ///
    /// # Examples
    /// ```
    /// # mod cart { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/cart.rs")); }
    /// use robot_model::simulate::Jumps;
    /// // Two degrees of freedom, one switch.
    /// assert_eq!(Jumps::zeros(&cart::Cart).halves.shape(), (2, 1));
    /// ```
    #[must_use]
    pub fn zeros(plant: &impl Plant) -> Self {
        let (n, m) = (plant.dof(), plant.switches());
        Self {
            halves: DMatrix::zeros(n, m),
            directions: DMatrix::zeros(m, n),
            drifts: DVector::zeros(m),
        }
    }
}

impl Slopes {
    /// Room for those of a plant.
    ///
    /// # Examples
    /// ```
    /// # mod cart { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/cart.rs")); }
    /// use robot_model::simulate::Slopes;
    /// // Two degrees of freedom, one internal state.
    /// let slopes = Slopes::zeros(&cart::Cart);
    /// assert_eq!(slopes.torque.map(|by| by.ncols()), [2, 2, 1]);
    /// assert_eq!(slopes.rates_by_acceleration.shape(), (1, 2));
    /// ```
    #[must_use]
    pub fn zeros(plant: &impl Plant) -> Self {
        let (n, p) = (plant.dof(), plant.states());
        Self {
            torque: [n, n, p].map(|columns| DMatrix::zeros(n, columns)),
            rates: [n, n, p].map(|columns| DMatrix::zeros(p, columns)),
            rates_by_acceleration: DMatrix::zeros(p, n),
        }
    }
}
