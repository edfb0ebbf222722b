//! Emitted C: it compiles without a warning as C99 and as C++, all arms are linked into one program that needs nothing but libm,
//! and its functions have the values of emitted Rust.

mod case;
mod driver;
mod header;

use std::collections::BTreeSet;
use std::fmt::Write;
use std::fs;
use std::io::Write as _;
use std::path::Path;
use std::process::{Command, Stdio};

use case::{CASES, Case};
use driver::Arm;
use robot_model_codegen::emit::c;
use robot_model_spec::model::JointKind;
use robot_model_tests::states::{State, generator, state};
use robot_model_tests::{compiler, specs};

/// States at which each arm is compared.
const ROUNDS: usize = 8;

/// Tolerance where joints move alike.
const USUAL: f64 = 1e-12;
/// Tolerance where one joint is faster than the others by many powers of ten, and its share cancels in theirs.
const ODDLY: f64 = 1e-9;

/// What a joint's position, velocity or acceleration is not, or hardly ever.
const ODD: [f64; 8] = [
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    -0.0,
    0.0,
    1e5,
    -3e8,
    1e300,
];

fn write(code: &c::Code, folder: &Path) {
    for (extension, text) in [("h", &code.header), ("c", &code.source)] {
        let file = folder.join(format!("{}.{extension}", code.name.as_str()));
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

/// Tolerance in roundings of the square of the largest velocity, which centripetal terms have before they cancel.
const CENTRIPETAL: f64 = 64.0 * f64::EPSILON;

/// The same operations, but for sines and cosines within 2 units in the last place: `tolerance`, of the largest entry, and `more`, in their
/// unit, are for sums that cancel.
fn compare(
    case: &Case,
    function: &str,
    (found, wanted): (&[f64], &[f64]),
    (tolerance, more): (f64, f64),
) {
    assert_eq!(found.len(), wanted.len(), "{} {function}", case.arm.name);
    let finite = wanted.iter().filter(|x| x.is_finite());
    let size = finite.fold(0.0, |size: f64, x| size.max(x.abs()));
    for (k, (&x, &y)) in found.iter().zip(wanted).enumerate() {
        let is_same = if y.is_finite() {
            (x - y).abs() <= (tolerance * size).max(more)
        } else {
            x.is_nan() && y.is_nan() || x.to_bits() == y.to_bits()
        };
        assert!(
            is_same,
            "{} {function}[{k}]: {x:e} {y:e} of {size:e}",
            case.arm.name
        );
    }
}

/// What a function of an arm returned.
type Found = (&'static Case, State, String, Vec<f64>);

/// What all functions of all arms return, each list of states in one go: one of each arm.
fn found(program: &Path, states: &[Vec<State>]) -> Vec<Found> {
    let states = || states.iter().flat_map(|states| CASES.iter().zip(states));
    let mut input = String::new();
    for (case, state) in states() {
        for (name, length) in case.arm.arguments() {
            let numbers = case.argument(name, state);
            assert_eq!(numbers.len(), length, "{} {name}", case.arm.name);
            for number in numbers {
                writeln!(input, "{number:e}").expect("a string");
            }
        }
    }
    let answers = answers(program, &input);
    let mut answers = answers.iter();
    let mut found = Vec::new();
    for (case, state) in states() {
        // It runs a second time, in place.
        let has_memory = |function: &&header::Declaration| function.name == "memory_after";
        let functions = &case.arm.functions;
        let count = functions.len() + functions.iter().filter(has_memory).count();
        for line in answers.by_ref().take(count) {
            let mut words = line.split(' ');
            let function = words.next().expect("a name");
            let values = words.map(|word| word.parse().expect("a number")).collect();
            found.push((case, state.clone(), function.to_owned(), values));
        }
    }
    assert_eq!(answers.next(), None);
    found
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
    let program = folder.join("main");
    at_usual_states(&program);
    at_odd_states(&program);
}

fn at_usual_states(program: &Path) {
    let mut random = generator(11);
    let one_each = |_| {
        let cases = CASES.iter();
        cases
            .map(|case| state(&mut random, case.interpreter.compiled.dof()))
            .collect()
    };
    let states: Vec<Vec<State>> = (0..ROUNDS).map(one_each).collect();
    let found = found(program, &states);
    for results in found.chunk_by(|one, next| one.0.arm.name == next.0.arm.name) {
        let (case, state, ..) = &results[0];
        let mut wanted = case.wanted(state);
        for (_, _, function, values) in results {
            if function == "standard_of" {
                let beta = case.argument("beta", state);
                let found = case.interpreter.compiled.base.beta(values);
                compare(case, function, (&found, &beta), (USUAL, 0.0));
                continue;
            }
            let known = wanted.remove(function.as_str()).unwrap_or_default();
            compare(case, function, (values, &known), (USUAL, 0.0));
        }
        assert!(
            wanted.is_empty(),
            "{} has no {:?}",
            case.arm.name,
            wanted.keys()
        );
    }
}

/// Inputs that no motion has come out of C as they come out of Rust: as no numbers, as infinities, of the same sign. Only what
/// has been emitted in both languages has the same operations in the same order.
fn at_odd_states(program: &Path) {
    let mut random = generator(12);
    let mut states: Vec<Vec<State>> = Vec::new();
    for odd in ODD {
        for kind in 0..3 {
            let one_each = CASES.iter().map(|case| {
                let joints = &case.interpreter.compiled.model.joints;
                let (dof, moved) = (joints.len(), joints.len() / 2);
                let mut state = state(&mut random, dof);
                // A slide that far away has a moment of inertia in which all else is rounded off.
                let is_far = kind == 0 && odd.is_finite() && odd.abs() > 1.0;
                if is_far && joints[moved].kind == JointKind::Prismatic {
                    return state;
                }
                let motion = [&mut state.q, &mut state.dq, &mut state.ddq];
                motion.into_iter().nth(kind).expect("three kinds")[moved] = odd;
                state
            });
            states.push(one_each.collect());
        }
    }
    let mut compared = 0;
    for (case, state, function, values) in found(program, &states) {
        if !case.is_emitted_in_both() || !case.reads_only_the_state(&function) {
            continue;
        }
        if let Some(wanted) = case.emitted(&state).remove(function.as_str()) {
            let fastest = state
                .dq
                .iter()
                .fold(0.0, |most: f64, dq| most.max(dq.abs()));
            let more = Some(CENTRIPETAL * fastest.powi(2)).filter(|more| more.is_finite());
            let tolerance = (ODDLY, more.unwrap_or_default());
            compare(case, &function, (&values, &wanted), tolerance);
            compared += 1;
        }
    }
    assert!(compared > 1000, "{compared} comparisons");
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

/// What stands behind the prefix in the names of a page: functions and arrays, or the macros where `prefix` is of capitals.
fn names(case: &Case, prefix: &str) -> BTreeSet<String> {
    let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let text = [&*case.code.header, &case.code.source].join(" ");
    let words = text.split(|c| !is_part(c));
    let names = words.filter_map(|word| word.strip_prefix(prefix)?.strip_prefix('_'));
    names.map(str::to_owned).collect()
}

/// `arm` and `arm_x` make the same name where `x_b` and `b` are both names behind a prefix. No prefix ends in such an `x`, so
/// prefixes that differ make names that differ.
#[test]
fn names_of_two_arms_are_never_the_same() {
    let [small, capital] = [str::to_ascii_lowercase, str::to_ascii_uppercase].map(|letters| {
        let names = CASES
            .iter()
            .map(|case| names(case, &letters(&case.arm.name)));
        names.flatten().collect::<BTreeSet<String>>()
    });
    for known in [
        "base_regressor",
        "regressor",
        "general",
        "memory_after",
        "after",
        "nominal",
    ] {
        assert!(small.contains(known), "{known}");
    }
    assert!(capital.contains("DOF") && capital.contains("H"));
    let mut heads = BTreeSet::new();
    for names in [&small, &capital] {
        for (whole, name) in names.iter().flat_map(|x| names.iter().map(move |y| (x, y))) {
            let head = whole.strip_suffix(name.as_str());
            heads.extend(head.and_then(|head| head.strip_suffix('_')));
        }
    }
    assert!(heads.contains("base") && heads.contains("base_drift"));
    for head in heads {
        let prefix = format!("arm_{head}");
        assert!(c::Prefix::new(&prefix).is_err(), "{prefix}");
        assert_ne!(c::Prefix::of_robot(&prefix).as_str(), prefix);
    }
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
