use robot_model::columns::{Arm, Columns, Entry, Nominal, Shape, Unknown};
use robot_model::motion::{Kinematics, Motion};

/// `50 tau = izz ddq + mx sin(q + lean) + fs exp(-(dq / vs)^2) sign(dq) + kt temperature dq + 0.2 dq`, where `tau` is a current;
/// `vs` and `lean` are open shapes, and the spec fixes 0.2.
pub struct Axis {
    unknowns: Vec<Unknown>,
    shapes: Vec<Shape>,
    inputs: Vec<String>,
    joints: Vec<String>,
}

pub fn axis() -> Axis {
    let unknown = |name: &str| Unknown {
        name: name.to_owned(),
        nonnegative: name != "link.mx",
    };
    let shape = |name: &str, grid: &[f64]| Shape {
        name: name.to_owned(),
        grid: grid.to_vec(),
    };
    Axis {
        unknowns: ["link.izz", "link.mx", "axis.stribeck.fs", "axis.warm.kt"].map(unknown).to_vec(),
        shapes: vec![
            shape("axis.stribeck.vs", &[0.01, 0.1, 0.5]),
            shape("axis.encoder_offset.lean", &[-0.1, 0.0, 0.1]),
        ],
        inputs: vec!["temperature".to_owned()],
        joints: vec!["axis".to_owned()],
    }
}

impl Columns for Axis {
    fn unknowns(&self) -> &[Unknown] {
        &self.unknowns
    }
    fn shapes(&self) -> &[Shape] {
        &self.shapes
    }
    fn uses_rigid_torque(&self) -> bool {
        false
    }
    fn inputs(&self) -> &[String] {
        &self.inputs
    }
    fn entries(&self, motion: &Motion, shapes: &[f64]) -> Vec<Entry> {
        let &[vs, lean] = shapes else { return Vec::new() };
        let (Kinematics { q, ddq, .. }, dq) = (&motion.smooth, &motion.wide.dq[0]);
        let temperature = motion.channel("temperature").unwrap_or_default();
        let stribeck = |dq: &f64| (-(dq / vs).powi(2)).exp() * robot_model::Scalar::sign(*dq);
        let columns: [Vec<f64>; 4] = [
            ddq[0].clone(),
            q[0].iter().map(|q| (q + lean).sin()).collect(),
            dq.iter().map(stribeck).collect(),
            temperature.iter().zip(dq).map(|(temperature, dq)| temperature * dq).collect(),
        ];
        let entry = |(column, values)| Entry { joint: 0, column, values };
        columns.into_iter().enumerate().map(entry).collect()
    }
}

impl Arm for Axis {
    fn dof(&self) -> usize {
        1
    }
    fn joints(&self) -> &[String] {
        &self.joints
    }
    fn actuator_gain(&self) -> &[f64] {
        &[50.0]
    }
    fn known_torque(&self, motion: &Motion, _: &[f64]) -> Vec<Vec<f64>> {
        vec![motion.wide.dq[0].iter().map(|dq| 0.2 * dq).collect()]
    }
    fn rigid_torque(&self, motion: &Motion, shapes: &[f64], estimate: &[f64]) -> Vec<Vec<f64>> {
        let pairs = motion.smooth.q[0].iter().zip(&motion.smooth.ddq[0]);
        let torque = |(q, ddq): (&f64, &f64)| estimate[0] * ddq + estimate[1] * (q + shapes[1]).sin();
        vec![pairs.map(torque).collect()]
    }
    fn dry_joints(&self) -> &[usize] {
        &[0]
    }
    fn dry_shapes(&self) -> &[usize] {
        &[0]
    }
    fn terms(&self) -> Vec<String> {
        vec!["ddq1".to_owned(), "sin(q1)".to_owned()]
    }
    fn term_values(&self, motion: &Motion) -> Vec<Vec<f64>> {
        let sines = motion.smooth.q[0].iter().map(|q| q.sin());
        vec![motion.smooth.ddq[0].clone(), sines.collect()]
    }
    fn nominal(&self) -> Vec<Option<Nominal>> {
        let izz = Nominal { value: 0.5, size: 0.5 };
        vec![Some(izz), None, None, None]
    }
}

/// One sample of a motion: `q = pi / 2`, `dq = 0.1` and `ddq = 3`, at 40 degrees Celsius.
pub fn upright() -> Motion {
    let temperature = robot_model::log::Channel {
        name: "temperature".to_owned(),
        values: vec![40.0],
    };
    let smooth = Kinematics {
        q: vec![vec![std::f64::consts::FRAC_PI_2]],
        dq: vec![vec![0.1]],
        ddq: vec![vec![3.0]],
    };
    Motion {
        time: vec![0.0],
        wide: smooth.clone(),
        smooth,
        extra: vec![temperature],
        ..Motion::default()
    }
}
