//! Emitted C: it compiles without a warning as C99 and as C++, all arms are linked into one program that needs nothing but libm,
//! and its functions have the values of emitted Rust.

mod driver;
mod header;

use std::collections::BTreeMap;
use std::fmt::Write;
use std::fs;
use std::io::Write as _;
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::LazyLock;

use driver::Arm;
use nalgebra::{DMatrix, DVector};
use robot_model_codegen::emit::c;
use robot_model_codegen::interpreter::Program;
use robot_model_codegen::states::StateProgram;
use robot_model_codegen::{Compiled, compile_model};
use robot_model_tests::emitted::{ROBOTS, Robot};
use robot_model_tests::evaluate::Interpreter;
use robot_model_tests::specs::{self, Spec};
use robot_model_tests::states::{State, generator, physical, state};
use robot_model_tests::{compiler, mechanics};

/// States at which each arm is compared.
const ROUNDS: usize = 8;

/// Specs that are also compiled with their parameters in the equations, as robots of another name.
const BAKED: [&str; 3] = ["puma560", "memory", "phantom"];

/// What no other spec has: states of one effect that depend on each other, and a torque on one joint by the acceleration of
/// another, so that the matrix of the accelerations is not symmetric.
const LOPSIDED: &str = "\
robot Lopsided {
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
struct Case {
    arm: Arm,
    code: c::Code,
    /// Emitted Rust, of the specs that have it.
    robot: Option<&'static Robot>,
    interpreter: Interpreter,
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
                name: code.name.clone(),
                functions: header::declarations(&code.header, &code.name),
            },
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
    fn argument(&self, name: &str, state: &State) -> Vec<f64> {
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

    /// What the functions return: by emitted Rust, and by the interpreter where there is no function of all arms.
    fn wanted(&self, state: &State) -> BTreeMap<&'static str, Vec<f64>> {
        let (interpreter, standard) = (&self.interpreter, &self.standard);
        let compiled = &interpreter.compiled;
        let dof = compiled.dof();
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
        let rows = |matrix: &DMatrix<f64>| matrix.transpose().as_slice().to_vec();
        let load = interpreter.rigid_torque(standard, state);
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
            ("base_parameters", compiled.base.beta(standard)),
        ]);
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

/// Every spec in C, made once for all tests of this file.
static CASES: LazyLock<Vec<Case>> = LazyLock::new(|| {
    let mut cases = Vec::new();
    for spec in [specs::folder("pass"), specs::folder("run")].concat() {
        let model = spec.model();
        let standard = physical(&mut generator(7), &model);
        let compiled = compile_model(&model);
        if BAKED.contains(&spec.name.as_str()) {
            let shapes = robot_model_codegen::base::shape_values(&model);
            let mut baked = compiled.baked(&compiled.base.beta(&standard), &shapes);
            baked.model.name.insert_str(0, "Baked");
            let code = c::code(&baked);
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

fn write(code: &c::Code, folder: &Path) {
    for (extension, text) in [("h", &code.header), ("c", &code.source)] {
        let file = folder.join(&code.name).with_extension(extension);
        fs::write(file, text).expect("a writable folder");
    }
}

/// Writes and compiles every arm; the object files.
fn objects(compiler: &Path, flags: &[&str], folder: &Path) -> Vec<String> {
    let compile = |case: &Case| {
        write(&case.code, folder);
        let (source, object) = (
            format!("{}.c", case.arm.name),
            format!("{}.o", case.arm.name),
        );
        let flags = [flags, &compiler::STRICT, &["-c", &source, "-o", &object]].concat();
        let said = compiler::run(compiler, &flags, folder);
        assert_eq!(said, "", "{source}");
        object
    };
    CASES.iter().map(compile).collect()
}

/// What an arm may take from outside: functions of libm, and those that a C compiler makes of loops and copies by itself.
fn is_of_libm(symbol: &str) -> bool {
    let functions = [
        "sin", "cos", "sincos", "exp", "expm1", "log", "sqrt", "tanh", "pow", "fabs", "fmax",
        "memset", "memcpy", "memmove",
    ];
    functions.contains(&symbol.trim_start_matches('_'))
}

fn only_libm(object: &str, folder: &Path) {
    let Some(nm) = compiler::find("NM", &["nm", "llvm-nm"], "which symbols C objects need") else {
        return;
    };
    for line in compiler::run(&nm, &["-u", object], folder).lines() {
        let symbol = line.split_whitespace().last().unwrap_or_default();
        assert!(is_of_libm(symbol), "{object} needs `{symbol}`");
    }
}

/// Runs the program on lines of numbers; its lines.
fn answers(program: &Path, input: &str) -> Vec<String> {
    let mut child = Command::new(program)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .expect("the program starts");
    let mut stdin = child.stdin.take().expect("it is piped");
    let input = input.to_owned();
    let writer = std::thread::spawn(move || stdin.write_all(input.as_bytes()));
    let output = child.wait_with_output().expect("the program ends");
    writer
        .join()
        .expect("no panic")
        .expect("the program reads all");
    assert!(output.status.success());
    let text = String::from_utf8(output.stdout).expect("it prints text");
    text.lines().map(str::to_owned).collect()
}

fn compare(case: &Case, function: &str, found: &[f64], wanted: &[f64]) {
    assert_eq!(found.len(), wanted.len(), "{} {function}", case.arm.name);
    let size = wanted.iter().fold(0.0, |size: f64, x| size.max(x.abs()));
    for (k, (x, y)) in found.iter().zip(wanted).enumerate() {
        // The same operations, but for sines and cosines within 2 units in the last place, and sums that cancel.
        assert!(
            (x - y).abs() <= 1e-12 * size,
            "{} {function}[{k}]: {x:e} {y:e} of {size:e}",
            case.arm.name
        );
    }
}

#[test]
fn c_has_the_values_of_rust() {
    let Some(cc) = compiler::c("emitted C") else {
        return;
    };
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    let mut objects = objects(&cc, &["-std=c99", "-O1"], folder);
    for object in &objects {
        only_libm(object, folder);
    }
    let arms: Vec<&Arm> = CASES.iter().map(|case| &case.arm).collect();
    fs::write(folder.join("main.c"), driver::program(&arms)).expect("a writable folder");
    objects.extend(["main.c", "-std=c99", "-o", "main", "-lm"].map(str::to_owned));
    let arguments: Vec<&str> = objects.iter().map(String::as_str).collect();
    let _ = compiler::run(&cc, &arguments, folder);

    let mut random = generator(11);
    let states: Vec<Vec<State>> = (0..ROUNDS)
        .map(|_| {
            CASES
                .iter()
                .map(|case| state(&mut random, case.interpreter.compiled.dof()))
                .collect()
        })
        .collect();
    let mut input = String::new();
    for (case, state) in states.iter().flat_map(|states| CASES.iter().zip(states)) {
        for (name, length) in case.arm.arguments() {
            let numbers = case.argument(name, state);
            assert_eq!(numbers.len(), length, "{} {name}", case.arm.name);
            for number in numbers {
                writeln!(input, "{number:e}").expect("a string");
            }
        }
    }
    let answers = answers(&folder.join("main"), &input);
    let mut answers = answers.iter();
    for (case, state) in states.iter().flat_map(|states| CASES.iter().zip(states)) {
        let mut wanted = case.wanted(state);
        let in_place = wanted.contains_key("memory_after");
        for _ in 0..case.arm.functions.len() + usize::from(in_place) {
            let line = answers.next().expect("a line a function");
            let mut words = line.split(' ');
            let function = words.next().expect("a name");
            let found: Vec<f64> = words.map(|word| word.parse().expect("a number")).collect();
            if function == "standard_of" {
                let beta = case.argument("beta", state);
                compare(
                    case,
                    function,
                    &case.interpreter.compiled.base.beta(&found),
                    &beta,
                );
                continue;
            }
            let known = wanted.remove(function).unwrap_or_default();
            compare(case, function, &found, &known);
        }
        assert!(
            wanted.is_empty(),
            "{} has no {:?}",
            case.arm.name,
            wanted.keys()
        );
    }
    assert_eq!(answers.next(), None);
}

#[test]
fn c_compiles_as_cpp() {
    let Some(cpp) = compiler::cpp("emitted C as C++") else {
        return;
    };
    let folder = tempfile::tempdir().expect("a temporary folder");
    let _ = objects(&cpp, &["-x", "c++", "-std=c++11", "-O0"], folder.path());
}

/// A program's own sines and cosines take the place of libm's.
#[test]
fn sines_and_cosines_can_be_given() {
    let Some(cc) = compiler::c("the hook of emitted C for sines and cosines") else {
        return;
    };
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    let code = c::code(&specs::named("pass/two_link").compiled());
    let main = r#"
#include <stdio.h>
#include "two_link.h"
void counted(int count, const double *angles, double *sines, double *cosines);
static int calls = 0;
void counted(int count, const double *angles, double *sines, double *cosines) {
    for (int k = 0; k < count; ++k) {
        calls += angles[k] < 1.0 ? 1 : 100;
        sines[k] = 0.0;
        cosines[k] = 1.0;
    }
}
int main(void) {
    const double q[2] = {0.3, 0.4};
    double beta[TWO_LINK_BASE] = {1.0, 10.0};
    double G[2];
    two_link_gravity(q, beta, G);
    printf("%d %g %g\n", calls, G[0], G[1]);
    return 0;
}
"#;
    for (name, text) in [
        ("two_link.h", code.header.as_str()),
        ("two_link.c", &code.source),
        ("main.c", main),
    ] {
        fs::write(folder.join(name), text).expect("a writable folder");
    }
    let flags = [
        "-std=c99",
        "-DROBOT_MODEL_SINES_COSINES=counted",
        "main.c",
        "two_link.c",
        "-o",
        "main",
        "-lm",
    ];
    let _ = compiler::run(&cc, &[&compiler::STRICT[..], &flags].concat(), folder);
    // Gravity in the direction of a raised arm: both angles, once each.
    assert_eq!(answers(&folder.join("main"), ""), ["2 9.81 0"]);
}

/// The C of a small arm, whole.
#[test]
fn code_of_a_small_arm() {
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path("../snapshots/two_link");
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(|| {
        let code = c::code(&specs::named("pass/two_link").compiled());
        insta::assert_snapshot!("c_header", code.header);
        insta::assert_snapshot!("c_source", code.source);
    });
}

#[test]
fn same_spec_same_bytes() {
    let code = || c::code(&specs::named("pass/memory").compiled());
    let (first, second) = (code(), code());
    assert_eq!((first.header, first.source), (second.header, second.source));
}
