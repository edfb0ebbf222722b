//! What holds for every arm, whatever its numbers are: laws of mechanics, and agreement of all forms with each other.
//!
//! Seeds are fixed. Every spec of `pass` and `run` is tested at physical parameters (links of point masses) in random states.

use nalgebra::DMatrix;
use robot_model_spec::Model;
use robot_model_spec::parameter::{Owner, Status};
use robot_model_tests::emitted;
use robot_model_tests::evaluate::{Forms, Interpreter, relative_difference};
use robot_model_tests::specs;
use robot_model_tests::states::{self, State};
use robot_model_tests::twin::Twin;

/// Two ways to compute the same number in double precision: some thousand roundings, and forms that lose two or three digits
/// to cancellation. A wrong sign or a lost term is off by a part in ten.
const ROUNDING: f64 = 1e-11;

/// A central difference with step `h = 1e-5`: truncation `h^2` times a third derivative, rounding `1e-16 / h`; both below
/// 1e-9 of the largest entry at these speeds, with room for large third derivatives.
const DIFFERENCE: f64 = 1e-7;
const STEP: f64 = 1e-5;

/// Random states an arm is tested in.
const STATES: usize = 5;

/// An arm in one state, with parameters of an arm that could be built.
struct Case<'a> {
    name: &'a str,
    model: &'a Model,
    interpreter: &'a Interpreter,
    twin: Twin<'a>,
    standard: Vec<f64>,
    state: State,
}

impl Case<'_> {
    fn forms(&self) -> Forms {
        self.interpreter.forms(&self.standard, &self.state)
    }

    fn forms_at(&self, q: Vec<f64>) -> Forms {
        let state = State {
            q,
            ..self.state.clone()
        };
        self.interpreter.forms(&self.standard, &state)
    }

    /// The parameters with those of effects at zero: a rotor's inertia, for one, is part of `M` where it regroups into a link's.
    fn rigid_only(&self) -> Vec<f64> {
        let mut standard = self.standard.clone();
        for (value, parameter) in standard.iter_mut().zip(&self.interpreter.compiled.standard) {
            if matches!(parameter.owner, Owner::Effect { .. }) {
                *value = 0.0;
            }
        }
        standard
    }

    fn dq(&self) -> DMatrix<f64> {
        column(&self.state.dq)
    }

    fn assert_close(
        &self,
        what: &str,
        found: &DMatrix<f64>,
        wanted: &DMatrix<f64>,
        tolerance: f64,
    ) {
        let difference = relative_difference(found, wanted);
        assert!(
            difference < tolerance,
            "{}, {what}: {difference:.1e}\nfound {found}wanted {wanted}",
            self.name
        );
    }
}

fn for_all(law: impl Fn(&Case<'_>)) {
    for spec in [specs::folder("pass"), specs::folder("run")].concat() {
        let interpreter = Interpreter::new(spec.compiled());
        let model = interpreter.compiled.model.clone();
        let mut random = states::generator(2026);
        for _ in 0..STATES {
            law(&Case {
                name: &spec.name,
                model: &model,
                interpreter: &interpreter,
                twin: Twin::new(&model, interpreter.shapes.clone()),
                standard: states::physical(&mut random, &model),
                state: states::state(&mut random, model.joints.len()),
            });
        }
    }
}

fn column(values: &[f64]) -> DMatrix<f64> {
    DMatrix::from_column_slice(values.len(), 1, values)
}

#[test]
fn the_mass_matrix_is_symmetric_and_positive_definite() {
    for_all(|case| {
        let m = case.forms().mass_matrix;
        assert_eq!(m, m.transpose(), "{}", case.name);
        assert!(m.clone().cholesky().is_some(), "{}: {m}", case.name);
    });
}

#[test]
fn the_rate_of_the_mass_matrix_less_twice_coriolis_is_skew() {
    for_all(|case| {
        let moved = |t: f64| {
            let q = case.state.q.iter().zip(&case.state.dq);
            case.forms_at(q.map(|(q, dq)| q + t * dq).collect())
                .mass_matrix
        };
        let rate = (moved(STEP) - moved(-STEP)) / (2.0 * STEP);
        let n = &rate - 2.0 * case.forms().coriolis_matrix;
        // One joint, or a mass matrix that stays the same: both terms are zero, and so must be their difference.
        let scale = n.amax().max(case.forms().mass_matrix.amax());
        let skew = (&n + n.transpose()).amax();
        assert!(
            skew < DIFFERENCE * scale,
            "{}: {skew:.1e} of {scale:.1e}",
            case.name
        );
    });
}

#[test]
fn torque_is_inertia_plus_coriolis_plus_gravity() {
    for_all(|case| {
        let forms = case.forms();
        let ddq = column(&case.state.ddq);
        let sum = &forms.mass_matrix * ddq + &forms.coriolis_matrix * case.dq() + &forms.gravity;
        let torque = case.interpreter.rigid_torque(&case.standard, &case.state);
        case.assert_close("M ddq + C dq + G", &sum, &torque, ROUNDING);
        let bias = &forms.coriolis_matrix * case.dq() + &forms.gravity;
        case.assert_close("C dq + G", &bias, &forms.bias, ROUNDING);
    });
}

#[test]
fn gravity_is_the_gradient_of_potential_energy() {
    for_all(|case| {
        let standard = case.rigid_only();
        let energy = |joint: usize, step: f64| {
            let mut state = case.state.clone();
            state.q[joint] += step;
            case.twin.potential_energy(&standard, &state)
        };
        let gradient: Vec<f64> = (0..case.model.joints.len())
            .map(|joint| (energy(joint, STEP) - energy(joint, -STEP)) / (2.0 * STEP))
            .collect();
        let gravity = case.interpreter.forms(&standard, &case.state).gravity;
        let scale = case
            .twin
            .potential_energy(&standard, &case.state)
            .abs()
            .max(1.0);
        let difference = (column(&gradient) - &gravity).amax();
        assert!(
            difference < DIFFERENCE * scale,
            "{}: {difference:.1e}\n{gradient:?}\n{gravity}",
            case.name
        );
    });
}

#[test]
fn all_forms_agree_with_the_numeric_twin() {
    for_all(|case| {
        let standard = case.rigid_only();
        let rigid = case.interpreter.forms(&standard, &case.state);
        let mass_matrix = case.twin.mass_matrix(&standard, &case.state);
        case.assert_close("M", &rigid.mass_matrix, &mass_matrix, ROUNDING);
        let torque = column(&case.twin.rigid_torque(&standard, &case.state));
        let found = case.interpreter.rigid_torque(&standard, &case.state);
        case.assert_close("rigid torque", &found, &torque, ROUNDING);
        let torque = column(&case.twin.inverse_dynamics(&case.standard, &case.state));
        case.assert_close("tau", &case.forms().inverse_dynamics, &torque, ROUNDING);
    });
}

/// The regressors are linear laws, so they hold for any numbers, of bodies that exist or not.
#[test]
fn both_regressors_give_the_torque_of_any_parameters() {
    for_all(|case| {
        let mut random = states::generator(7);
        let standard = states::arbitrary(&mut random, case.model);
        let torque = column(&case.twin.inverse_dynamics(&standard, &case.state));
        let forms = case.interpreter.forms(&standard, &case.state);
        case.assert_close("tau", &forms.inverse_dynamics, &torque, ROUNDING);
        let by_standard = &forms.regressor * column(&standard);
        case.assert_close("Y * standard", &by_standard, &torque, ROUNDING);
        let beta = case.interpreter.compiled.base.beta(&standard);
        let known = case.interpreter.known_torque(&standard, &case.state);
        let by_base = &forms.base_regressor * column(&beta) + known;
        case.assert_close("Y_b * beta + known", &by_base, &torque, ROUNDING);
    });
}

/// `d/dt (1/2 dq^T M dq + V) = dq . (M ddq + C dq + G)`: what the motors do, the arm has.
#[test]
fn power_is_the_rate_of_energy() {
    for_all(|case| {
        let standard = case.rigid_only();
        let energy = |t: f64| {
            let state = moved(&case.state, t);
            let m = case.twin.mass_matrix(&standard, &state);
            let dq = column(&state.dq);
            0.5 * (dq.transpose() * m * &dq)[(0, 0)] + case.twin.potential_energy(&standard, &state)
        };
        let rate = (energy(STEP) - energy(-STEP)) / (2.0 * STEP);
        let torque = case.interpreter.rigid_torque(&standard, &case.state);
        let power = (case.dq().transpose() * torque)[(0, 0)];
        let scale = energy(0.0).abs().max(rate.abs());
        assert!(
            (rate - power).abs() < DIFFERENCE * scale,
            "{}: {rate} and {power}",
            case.name
        );
    });
}

/// The state after a time `t` at constant acceleration.
fn moved(state: &State, t: f64) -> State {
    let n = state.q.len();
    State {
        q: (0..n)
            .map(|j| state.q[j] + t * state.dq[j] + 0.5 * t * t * state.ddq[j])
            .collect(),
        dq: (0..n).map(|j| state.dq[j] + t * state.ddq[j]).collect(),
        ..state.clone()
    }
}

/// What the spec fixes is inside the functions: it is no base parameter, and changing it changes the torque.
#[test]
fn fixed_parameters_are_known_and_never_identified() {
    let spec = specs::named("pass/slider");
    let interpreter = Interpreter::new(spec.compiled());
    let compiled = &interpreter.compiled;
    let fixed: Vec<usize> = (0..compiled.standard.len())
        .filter(|&k| matches!(compiled.standard[k].status, Status::Fixed(_)))
        .collect();
    assert_eq!(fixed.len(), 10, "the cart's ten");
    assert_eq!(compiled.base.fixed, fixed);
    for combination in &compiled.base.combinations {
        assert!(combination.iter().all(|(k, _)| !fixed.contains(k)));
    }

    // A cart that is 1 kg heavier needs 1 N more per m/s^2 of the rail, and nothing else changes.
    let heavier = spec.text.replace("mass = 4.2;", "mass = 5.2;");
    assert_ne!(heavier, spec.text);
    let heavier = robot_model_spec::load("slider.robot", &heavier).unwrap();
    let heavier = Interpreter::new(robot_model_codegen::compile_model(&heavier));
    let mut random = states::generator(11);
    let state = states::state(&mut random, 2);
    let torque = |interpreter: &Interpreter| {
        let mut random = states::generator(12);
        let standard = states::physical(&mut random, &interpreter.compiled.model);
        interpreter.forms(&standard, &state).inverse_dynamics
    };
    let more = torque(&heavier) - torque(&interpreter);
    let wanted = column(&[state.ddq[0], 0.0]);
    assert!(relative_difference(&more, &wanted) < ROUNDING, "{more}");
}

/// The interpreter and the compiled Rust run the same expressions; only the order of summation may differ.
#[test]
fn emitted_code_agrees_with_the_interpreter() {
    for_all(|case| {
        let emitted = emitted::ROBOTS
            .iter()
            .find(|robot| robot.spec == case.name)
            .unwrap_or_else(|| panic!("list `{}` in emitted.rs and build.rs", case.name));
        let beta = case.interpreter.compiled.base.beta(&case.standard);
        let found = (emitted.base_parameters)(&case.standard);
        case.assert_close("beta", &column(&found), &column(&beta), ROUNDING);
        let (found, wanted) = ((emitted.forms)(&case.standard, &case.state), case.forms());
        for (what, found, wanted) in [
            ("M", &found.mass_matrix, &wanted.mass_matrix),
            ("C", &found.coriolis_matrix, &wanted.coriolis_matrix),
            ("G", &found.gravity, &wanted.gravity),
            ("bias", &found.bias, &wanted.bias),
            ("tau", &found.inverse_dynamics, &wanted.inverse_dynamics),
            ("Y", &found.regressor, &wanted.regressor),
            ("Y_b", &found.base_regressor, &wanted.base_regressor),
        ] {
            // An axis that no gravity acts on has G = 0 in both.
            if wanted.amax() > 0.0 || found.amax() > 0.0 {
                case.assert_close(what, found, wanted, ROUNDING);
            }
        }
    });
}

#[test]
fn emitted_code_has_the_names_of_the_spec() {
    for robot in emitted::ROBOTS {
        let spec = [specs::folder("pass"), specs::folder("run")]
            .concat()
            .into_iter()
            .find(|spec| spec.name == robot.spec);
        let compiled = spec.expect("emitted from a spec").compiled();
        let standard = compiled
            .standard
            .iter()
            .map(|parameter| parameter.name.as_str());
        let joints = compiled
            .model
            .joints
            .iter()
            .map(|joint| joint.name.as_str());
        assert_eq!(robot.name, compiled.model.name);
        assert!(joints.eq(robot.joints.iter().copied()));
        assert!(standard.eq(robot.standard_parameters.iter().copied()));
        assert_eq!(robot.base_parameter_names, compiled.base.names);
    }
}

/// Same spec, same bytes: compiled twice, and with the comments and blanks of the text changed.
#[test]
fn same_spec_same_bytes() {
    for spec in [specs::folder("pass"), specs::folder("run")].concat() {
        let page = |text: &str| {
            robot_model_codegen::compile_text(&spec.name, text)
                .unwrap_or_else(|error| panic!("{error}"))
        };
        let first = page(&spec.text);
        assert_eq!(first, page(&spec.text), "{}", spec.name);
        let respaced = spec.text.replace(';', " ; /* the same */ ");
        assert_eq!(first, page(&respaced), "{}", spec.name);
    }
}
