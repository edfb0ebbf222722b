//! A plant by other parameters than its own, of which these are functions.

use nalgebra::{DMatrix, DVector};

use super::adjustable::{Adjustable, ParameterSlopes};
use super::plant::{Instant, Jumps, Plant, Slopes};

/// Parameters of a plant as functions of others.
///
/// # Examples
/// The `m` and `c` of a [block](Adjustable), of its own mass, of a load's, and of `c`:
/// ```
#[doc = include_str!("../../tests/doc/loaded.rs")]
///
/// // 0.5 kg of load instead of 0.3 kg are 0.2 kg more of `m`.
/// let [less, more] = [0.3, 0.5].map(|load| Loaded.own(&[1.5, load, 0.7]));
/// assert!((more[0] - less[0] - 0.2).abs() < 1e-12 && more[1] == less[1]);
/// ```
pub trait Functions {
    /// The plant's own parameters.
    ///
    /// # Examples
    /// ```
    /// # mod loaded { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/loaded.rs")); }
    /// use robot_model::simulate::Functions;
    /// assert_eq!(loaded::Loaded.own(&[1.5, 0.5, 0.7]), [2.0, 0.7]);
    /// ```
    fn own(&self, values: &[f64]) -> Vec<f64>;

    /// Their slopes, one row each, one column for each of the others.
    ///
    /// # Examples
    /// ```
    /// # mod loaded { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/loaded.rs")); }
    /// use robot_model::simulate::Functions;
    /// // What is added to the load is added to `m`, and not to `c`.
    /// assert_eq!(loaded::Loaded.slopes(&[1.5, 0.5, 0.7]).column(1).as_slice(), [1.0, 0.0]);
    /// ```
    fn slopes(&self, values: &[f64]) -> DMatrix<f64>;
}

/// A plant whose parameters are functions of others: these are what is looked for.
///
/// Where several of them make the same own parameters, motions do not tell them apart, and output error says which.
#[derive(Debug, Clone)]
pub struct Through<P, F> {
    plant: P,
    functions: F,
    values: Vec<f64>,
}

impl<P: Adjustable, F: Functions> Through<P, F> {
    /// The plant with other parameters at these values.
    ///
    /// # Examples
    /// ```
    /// # mod block { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/block.rs")); }
    /// use nalgebra::DMatrix;
    /// use robot_model::simulate::{Adjustable, Functions, Integrator, Through, Tolerances};
    ///
    /// /// The `m` and `c` of a block, where `c` is known: 0.7.
    /// struct Mass;
    /// impl Functions for Mass {
    ///     fn own(&self, values: &[f64]) -> Vec<f64> { vec![values[0], 0.7] }
    ///     fn slopes(&self, _: &[f64]) -> DMatrix<f64> { DMatrix::from_row_slice(2, 1, &[1.0, 0.0]) }
    /// }
    ///
    /// let plant = Through::new(block::Block([1.0, 0.0]), Mass, vec![2.0]);
    /// assert_eq!(plant.values(), [2.0]);
    /// // 0.7 N s/m at 0.5 m/s, of 2 kg
    /// let mut block = Integrator::new(plant, &[0.0], &[0.5], Tolerances::default())?;
    /// assert_eq!(block.accelerations()?, [-0.175]);
    /// # Ok::<(), robot_model::simulate::SimulateError>(())
    /// ```
    pub fn new(mut plant: P, functions: F, values: Vec<f64>) -> Self {
        plant.adjust(&functions.own(&values));
        Self {
            plant,
            functions,
            values,
        }
    }
}

impl<P: Plant, F> Plant for Through<P, F> {
    fn dof(&self) -> usize {
        self.plant.dof()
    }

    fn joints(&self) -> usize {
        self.plant.joints()
    }

    fn joint(&self, coordinate: usize) -> usize {
        self.plant.joint(coordinate)
    }

    fn start(&mut self, joints: &Instant<'_>) -> Vec<f64> {
        self.plant.start(joints)
    }

    fn states(&self) -> usize {
        self.plant.states()
    }

    fn switches(&self) -> usize {
        self.plant.switches()
    }

    fn is_affine(&self) -> bool {
        self.plant.is_affine()
    }

    fn is_timed(&self) -> bool {
        self.plant.is_timed()
    }

    fn torque(&mut self, at: &Instant<'_>, torque: &mut DVector<f64>, inertia: &mut DMatrix<f64>) {
        self.plant.torque(at, torque, inertia);
    }

    fn rates(&mut self, at: &Instant<'_>, rates: &mut [f64]) {
        self.plant.rates(at, rates);
    }

    fn arguments(&mut self, at: &Instant<'_>, arguments: &mut [f64]) {
        self.plant.arguments(at, arguments);
    }

    fn jumps(&mut self, at: &Instant<'_>, jumps: &mut Jumps) {
        self.plant.jumps(at, jumps);
    }

    fn slopes(&mut self, at: &Instant<'_>, slopes: &mut Slopes) {
        self.plant.slopes(at, slopes);
    }
}

impl<P: Adjustable, F: Functions> Adjustable for Through<P, F> {
    fn values(&self) -> Vec<f64> {
        self.values.clone()
    }

    fn prepare(&mut self) {
        self.plant.prepare();
    }

    fn adjust(&mut self, values: &[f64]) {
        self.values.clear();
        self.values.extend_from_slice(values);
        self.plant.adjust(&self.functions.own(values));
    }

    fn parameter_slopes(&mut self, at: &Instant<'_>, slopes: &mut ParameterSlopes) {
        let mut own = ParameterSlopes::zeros(&self.plant);
        self.plant.parameter_slopes(at, &mut own);
        let by = self.functions.slopes(&self.values);
        slopes.torque = own.torque * &by;
        slopes.rates = own.rates * &by;
        slopes.arguments = own.arguments * by;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::identify::output_error::{Hold, OutputError, Recording};
    use crate::log::Log;

    /// `m ddq + c dq = tau`
    #[derive(Debug, Clone)]
    struct Cart([f64; 2]);

    impl Plant for Cart {
        fn dof(&self) -> usize {
            1
        }

        fn torque(
            &mut self,
            at: &Instant<'_>,
            torque: &mut DVector<f64>,
            inertia: &mut DMatrix<f64>,
        ) {
            let [m, c] = self.0;
            torque[0] = m * at.ddq[0] + c * at.dq[0];
            inertia[(0, 0)] = m;
        }

        fn slopes(&mut self, _: &Instant<'_>, slopes: &mut Slopes) {
            slopes.torque[1][(0, 0)] = self.0[1];
        }
    }

    impl Adjustable for Cart {
        fn values(&self) -> Vec<f64> {
            self.0.to_vec()
        }

        fn adjust(&mut self, values: &[f64]) {
            self.0.copy_from_slice(values);
        }

        fn parameter_slopes(&mut self, at: &Instant<'_>, slopes: &mut ParameterSlopes) {
            slopes.torque.copy_from_slice(&[at.ddq[0], at.dq[0]]);
        }
    }

    /// Density and volume of the cart, and what brakes it.
    #[derive(Debug, Clone)]
    struct Solid;

    impl Functions for Solid {
        fn own(&self, values: &[f64]) -> Vec<f64> {
            vec![values[0] * values[1], values[2]]
        }

        fn slopes(&self, values: &[f64]) -> DMatrix<f64> {
            DMatrix::from_row_slice(2, 3, &[values[1], values[0], 0.0, 0.0, 0.0, 1.0])
        }
    }

    /// A push of 1 N from rest: `q = t/c - m/c^2 (1 - exp(-c t/m))`.
    fn pushed(m: f64, c: f64) -> Recording {
        let time: Vec<f64> = (0..200).map(|k| f64::from(k) * 0.01).collect();
        let at = |t: &f64| t / c - m / (c * c) * (1.0 - (-c * t / m).exp());
        let q = time.iter().map(at).collect();
        let tau = vec![1.0; time.len()];
        let log = Log::from_samples("cart", time, vec![q], vec![tau]).expect("a log");
        Recording::new(&log, &[1.0], 0.0, Vec::new())
    }

    #[test]
    fn factors_of_a_product_have_no_value_of_their_own() {
        let names = ["density", "volume", "c"].map(str::to_owned);
        let start = [2.0, 1.5, 1.2];
        let plant = Through::new(Cart([1.0, 1.0]), Solid, start.to_vec());
        let [mass, friction] = plant.plant.0;
        assert!((mass - 3.0).abs() < 1e-12 && (friction - 1.2).abs() < 1e-12);
        let settings = OutputError {
            hold: Some(Hold::Mean),
            ..OutputError::default()
        };
        let found = settings.fit(&plant, &names, &start, &[pushed(2.0, 0.8)], &mut |_| ());
        let found = found.expect("an estimate");
        let [density, volume, c] = found.values[..] else {
            panic!("{found:?}");
        };
        assert!((density * volume - 2.0).abs() < 1e-6, "{found:?}");
        assert!((c - 0.8).abs() < 1e-6, "{found:?}");
        assert_eq!(found.identifiability.rank, 2);
        let told = found.std.iter().map(Option::is_some);
        assert_eq!(told.collect::<Vec<_>>(), [false, false, true]);
        let [silent] = found.identifiability.directions.as_slice() else {
            panic!("{found:?}");
        };
        let shares: Vec<f64> = silent.moves.iter().map(|(_, share)| *share).collect();
        assert_eq!(shares.len(), 2);
        assert!((shares[0] + shares[1]).abs() < 1e-6, "{shares:?}");
    }
}
