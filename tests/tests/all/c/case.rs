//! Every spec in C, and the values that its functions have to have.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use nalgebra::{DMatrix, DVector};
use robot_model_codegen::emit::{Extent, c};
use robot_model_codegen::interpreter::Program;
use robot_model_codegen::states::StateProgram;
use robot_model_codegen::{Compiled, compile_model};
use robot_model_tests::emitted::{ROBOTS, Robot};
use robot_model_tests::evaluate::Interpreter;
use robot_model_tests::mechanics;
use robot_model_tests::specs::{self, Spec};
use robot_model_tests::states::{State, generator, physical};

use super::driver::Arm;
use super::header;

/// Specs that are also compiled with their parameters in the equations, under another name.
const BAKED: [&str; 3] = ["puma560", "memory", "phantom"];

/// What no other spec has: states of one effect that depend on each other, and a torque on one joint by the acceleration of
/// another, so that the matrix of the accelerations is not symmetric. Its name has the words in it that stand for a name in the
/// files of helpers.
const LOPSIDED: &str = "\
robot MyRobotStates {
    gravity = [0, -9.81, 0];
    convention = standard_dh;
    joint shoulder: revolute { a = 0.4; alpha = 0; d = 0; }
    joint elbow:    revolute { a = 0.3; alpha = 0; d = 0; }
    effects {
        ringing(w = 300) on all;
        drag on (shoulder, elbow);
    }
}
effect ringing(j) {
    linear k;
    shape w in 1 .. 1000;
    state x;
    state v;
    dot(x) = v;
    dot(v) = w * w * (dq(j) - x) - 0.2 * w * v;
    torque(j) = k * x;
}
effect drag(i, j) {
    linear c;
    torque(i) = c * ddq(j);
}
";

/// A step of internal states, s.
const SECONDS: f64 = 0.01;

/// An arm in C, with all that its values are compared with.
pub struct Case {
    pub arm: Arm,
    pub code: c::Code,
    /// Emitted Rust, of the specs that have it.
    robot: Option<&'static Robot>,
    /// Whether parameters are numbers in its equations, which they are not in Rust's.
    is_baked: bool,
    pub interpreter: Interpreter,
    /// Forms that only the interpreter has without sizes in its type: poses and Jacobian, points, states.
    kinematics: Option<[Program; 2]>,
    points: Program,
    states: Vec<StateProgram>,
    standard: Vec<f64>,
}

impl Case {
    fn new(spec: &Spec, code: c::Code, compiled: Compiled, standard: Vec<f64>) -> Self {
        let robot = ROBOTS.iter().find(|robot| robot.spec == spec.name);
        Self {
            arm: Arm {
                name: code.name.as_str().to_owned(),
                functions: header::declarations(&code.header, code.name.as_str()),
            },
            is_baked: code.name != c::Prefix::of_robot(&compiled.model.name),
            code,
            robot,
            kinematics: compiled
                .forward_kinematics()
                .zip(compiled.jacobian())
                .map(|(poses, jacobian)| [poses, jacobian]),
            points: compiled.points(),
            states: compiled.states(),
            interpreter: Interpreter::new(compiled),
            standard,
        }
    }

    /// Numbers of an argument.
    pub fn argument(&self, name: &str, state: &State) -> Vec<f64> {
        let compiled = &self.interpreter.compiled;
        match name {
            "q" => state.q.clone(),
            "dq" => state.dq.clone(),
            "ddq" => state.ddq.clone(),
            "tau" | "measured_torque" => state.measured_torque.clone(),
            "time" => vec![state.time],
            "seconds" => vec![SECONDS],
            "inputs" => state.inputs[..compiled.model.inputs().len()].to_vec(),
            "states" => state.states[..compiled.model.states().len()].to_vec(),
            "standard" => self.standard.clone(),
            "beta" => compiled.base.beta(&self.standard),
            "shapes" => {
                let free = compiled.free_shapes();
                free.iter().map(|&k| self.interpreter.shapes[k]).collect()
            }
            "rigid_torque" => {
                let load = self.interpreter.rigid_torque(&self.standard, state);
                load.as_slice().to_vec()
            }
            _ => panic!("what is `{name}`?"),
        }
    }

    /// Accelerations under the measured torque, where the inverse dynamics are affine in them.
    fn accelerations(&self, state: &State) -> Option<Vec<f64>> {
        let dof = state.q.len();
        let compiled = &self.interpreter.compiled;
        assert!(compiled.partials.is_affine);
        let slope = compiled.by_acceleration();
        let slope = self.interpreter.run(&slope, &self.standard, state, &[]);
        let still = State {
            ddq: vec![0.0; dof],
            ..state.clone()
        };
        let rest = self
            .interpreter
            .forms(&self.standard, &still)
            .inverse_dynamics;
        let tau = DMatrix::from_column_slice(dof, 1, &state.measured_torque);
        let solved = DMatrix::from_row_slice(dof, dof, &slope)
            .lu()
            .solve(&(tau - rest))?;
        Some(solved.as_slice().to_vec())
    }

    /// Whether C and Rust have the same operations.
    pub fn is_emitted_in_both(&self) -> bool {
        self.robot.is_some() && !self.is_baked
    }

    /// Whether a function has no argument that Rust computes by itself.
    pub fn reads_only_the_state(&self, function: &str) -> bool {
        let mut functions = self.arm.functions.iter();
        functions.any(|known| {
            let mut arguments = known.arguments.iter();
            known.name == function && !arguments.any(|(name, _)| name == "rigid_torque")
        })
    }

    /// What the functions that all arms have return, by emitted Rust where there is some.
    pub fn emitted(&self, state: &State) -> BTreeMap<&'static str, Vec<f64>> {
        let (interpreter, standard) = (&self.interpreter, &self.standard);
        let (forms, others, solved) = match self.robot {
            Some(robot) => (
                (robot.forms)(standard, state),
                (robot.mechanics)(standard, state),
                (robot.accelerations)(standard, state, &state.measured_torque),
            ),
            None => (
                interpreter.forms(standard, state),
                mechanics::interpreted(interpreter, standard, state),
                self.accelerations(state),
            ),
        };
        let mut wanted = BTreeMap::from([
            ("mass_matrix", rows(&forms.mass_matrix)),
            ("coriolis_matrix", rows(&forms.coriolis_matrix)),
            ("gravity", rows(&forms.gravity)),
            ("bias", rows(&forms.bias)),
            ("inverse_dynamics", rows(&forms.inverse_dynamics)),
            ("regressor", rows(&forms.regressor)),
            ("base_regressor", rows(&forms.base_regressor)),
            ("kinetic_energy", vec![others.kinetic_energy]),
            ("potential_energy", vec![others.potential_energy]),
            ("inverse_dynamics_by_position", rows(&others.by_position)),
            ("inverse_dynamics_by_velocity", rows(&others.by_velocity)),
            ("momentum_regressor", rows(&others.standard[0])),
            ("drift_regressor", rows(&others.standard[1])),
            ("base_momentum_regressor", rows(&others.base[0])),
            ("base_drift_regressor", rows(&others.base[1])),
            ("forward_dynamics", solved.unwrap_or_default()),
        ]);
        wanted.retain(|_, values| !values.is_empty());
        wanted
    }

    /// What all functions return: by emitted Rust, and by the interpreter where there is no function of all arms.
    pub fn wanted(&self, state: &State) -> BTreeMap<&'static str, Vec<f64>> {
        let (interpreter, standard) = (&self.interpreter, &self.standard);
        let compiled = &interpreter.compiled;
        let dof = compiled.dof();
        let load = interpreter.rigid_torque(standard, state);
        let mut wanted = self.emitted(state);
        wanted.insert("base_parameters", compiled.base.beta(standard));
        let run = |program: &Program| interpreter.run(program, standard, state, load.as_slice());
        if let Some([poses, jacobian]) = &self.kinematics {
            wanted.insert("forward_kinematics", run(poses));
            wanted.insert("jacobian", run(jacobian));
        }
        let points = run(&self.points);
        let points = points.chunks(3 + 3 * dof);
        wanted.insert(
            "points",
            points
                .clone()
                .flat_map(|point| point[..3].to_vec())
                .collect(),
        );
        wanted.insert(
            "point_jacobians",
            points.flat_map(|point| point[3..].to_vec()).collect(),
        );
        wanted.insert(
            "state_rates",
            rows(&interpreter.state_rates(standard, state, load.as_slice())),
        );
        let mut after = Vec::new();
        for part in &self.states {
            let mut z =
                DVector::from_column_slice(&state.states[part.first..part.first + part.count]);
            let values = run(&part.program);
            let (rates, slopes) = values.split_at(part.count);
            let slopes = DMatrix::from_row_slice(part.count, part.count, slopes);
            robot_model::memory::step(&mut z, SECONDS, &DVector::from_column_slice(rates), &slopes);
            after.extend_from_slice(z.as_slice());
        }
        wanted.insert("memory_after_in_place", after.clone());
        wanted.insert("memory_after", after);
        wanted.retain(|_, values| !values.is_empty());
        wanted
    }
}

fn rows(matrix: &DMatrix<f64>) -> Vec<f64> {
    matrix.transpose().as_slice().to_vec()
}

/// Every spec in C, made once for all tests of this file.
pub static CASES: LazyLock<Vec<Case>> = LazyLock::new(|| {
    let mut cases = Vec::new();
    for spec in [specs::folder("pass"), specs::folder("run")].concat() {
        let model = spec.model();
        let standard = physical(&mut generator(7), &model);
        let compiled = compile_model(&model);
        if BAKED.contains(&spec.name.as_str()) {
            let shapes = robot_model_codegen::base::shape_values(&model);
            let baked = compiled.baked(&compiled.base.beta(&standard), &shapes);
            let baked = baked.expect("finite numbers");
            let name = c::Prefix::new(&format!("{}_baked", spec.name)).expect("a name of C");
            let code = c::code_named(&baked, Extent::All, name);
            cases.push(Case::new(&spec, code, compiled.clone(), standard.clone()));
        }
        cases.push(Case::new(&spec, c::code(&compiled), compiled, standard));
    }
    let model = robot_model_spec::load("lopsided.robot", LOPSIDED);
    let model = model.unwrap_or_else(|errors| panic!("{errors}"));
    let compiled = compile_model(&model);
    let standard = physical(&mut generator(7), &model);
    let spec = Spec {
        name: "lopsided".to_owned(),
        text: LOPSIDED.to_owned(),
    };
    cases.push(Case::new(&spec, c::code(&compiled), compiled, standard));
    cases
});
