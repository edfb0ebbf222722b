//! Control cycles of a Panda in a program of its own: nothing is allocated, and every cycle is as many instructions as the one before.
//!
//! The program also takes the time, which no test does: `PATH/control-cycle time` after a run of this test.

use std::fs;
use std::process::Command;

use robot_model_tests::program::Program;
use robot_model_tests::specs;

const MAIN: &str = r#"
use std::alloc::{GlobalAlloc, Layout, System};
use std::hint::black_box;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

use robot_model::control::{
    Adaptation, Adaptive, Command, ComputedTorque, ContactForce, ControlError, Dissection, FeedForward, Friction,
    Gains, GravityCompensation, HandGuiding, MomentumObserver, Safety, Status,
};
use robot_model::{FromParameters, RobotModel, State, Vector};

mod panda {
    robot_model::include_robot!("panda");
}
use panda::Panda;

/// The system's allocator, and how often it is asked.
struct Counting;

static ASKED: AtomicUsize = AtomicUsize::new(0);

unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ASKED.fetch_add(1, Ordering::Relaxed);
        unsafe { System.alloc(layout) }
    }
    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        ASKED.fetch_add(1, Ordering::Relaxed);
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// An arm with its CAD values and friction.
fn arm() -> Panda {
    let mut standard = Vector::from(Panda::NOMINAL);
    for (name, value) in Panda::STANDARD_PARAMETERS.iter().zip(&mut standard) {
        if name.contains("friction") {
            *value = 0.7;
        }
    }
    Panda::from_standard(&standard)
}

/// Numbers without a pattern.
fn state(cycle: usize) -> State<7> {
    let wave = |start: f64, size: f64| {
        Vector::<7>::from_fn(|joint, _| size * (start + 2.7 * joint as f64 + 0.9 * (cycle * cycle + cycle) as f64).sin())
    };
    State::new(wave(0.1, 1.5), wave(0.7, 2.0), wave(1.9, 5.0))
}

type Cycle = Box<dyn FnMut(&State<7>, &State<7>) -> f64>;

/// The number of parameters stays in here.
fn adaptive(limits: Safety<7>) -> Result<Cycle, ControlError> {
    let mut control = Adaptive::new(arm(), Adaptation::new(10.0, 5.0, 1e-3), 1e-3)?.with_safety(limits)?;
    Ok(Box::new(move |measured, desired| control.torque(measured, desired).torque.sum()))
}

struct Controllers {
    computed: ComputedTorque<Panda, 7>,
    half: ComputedTorque<Panda, 7>,
    gravity: GravityCompensation<Panda, 7>,
    guiding: HandGuiding<Panda, 7>,
    ahead: FeedForward<Panda, 7>,
    adaptive: Cycle,
    observer: MomentumObserver<Panda, 7>,
    contact: ContactForce<Panda, 7>,
}

impl Controllers {
    fn new() -> Result<Self, ControlError> {
        let limits = Safety::new().torque([500.0; 7]).velocity([10.0; 7]);
        let computed = ComputedTorque::new(arm(), Gains::critically_damped(25.0))?.with_safety(limits)?;
        Ok(Self {
            computed,
            half: computed.with_friction(Friction::part(0.5).at_measured_velocity())?,
            gravity: GravityCompensation::new(arm()).with_safety(limits)?,
            guiding: HandGuiding::new(arm(), [1.0; 7])?.with_safety(limits)?,
            ahead: FeedForward::new(arm(), [100.0; 7], [10.0; 7])?.with_safety(limits)?,
            adaptive: adaptive(limits)?,
            observer: MomentumObserver::new(arm(), 50.0, 1e-3)?,
            contact: ContactForce::new(arm(), 0.02)?,
        })
    }
}

/// The cycle whose instructions are counted.
#[inline(never)]
#[unsafe(no_mangle)]
fn cycle(control: &mut ComputedTorque<Panda, 7>, measured: &State<7>, desired: &State<7>) -> Command<7> {
    control.torque(measured, desired)
}

fn everything(controllers: &mut Controllers, measured: &State<7>, desired: &State<7>) -> f64 {
    let command = cycle(&mut controllers.computed, measured, desired);
    let external = controllers.observer.update(measured, &command.torque).torque;
    let shares = Dissection::new(controllers.guiding.arm(), measured);
    command.torque.sum()
        + controllers.half.torque(measured, desired).torque.sum()
        + controllers.gravity.torque(measured).torque.sum()
        + controllers.guiding.torque(measured).torque.sum()
        + controllers.ahead.torque(measured, desired).torque.sum()
        + (controllers.adaptive)(measured, desired)
        + controllers.contact.at_tip(&measured.q, &external).force.sum()
        + shares.sum().sum()
}

fn allocations(controllers: &mut Controllers) -> usize {
    let before = ASKED.load(Ordering::Relaxed);
    let mut lost = state(0);
    lost.q[3] = f64::NAN;
    for k in 0..1000 {
        let measured = if k % 10 == 9 { lost } else { state(k) };
        black_box(everything(controllers, &measured, &state(k + 1)));
    }
    ASKED.load(Ordering::Relaxed) - before
}

fn time(name: &str, states: &[State<7>], mut cycle: impl FnMut(&State<7>, &State<7>) -> f64) {
    let mut best = f64::INFINITY;
    for _ in 0..200 {
        let start = Instant::now();
        for pair in states.windows(2) {
            black_box(cycle(black_box(&pair[0]), black_box(&pair[1])));
        }
        best = best.min(start.elapsed().as_nanos() as f64 / (states.len() - 1) as f64);
    }
    println!("{name:24} {best:8.1} ns");
}

fn main() -> Result<(), ControlError> {
    let mut c = Controllers::new()?;
    match std::env::args().nth(1).as_deref() {
        Some("allocations") => println!("{}", allocations(&mut c)),
        Some("instructions") => {
            for k in 0..30 {
                let command = cycle(&mut c.computed, &state(k), &state(k + 1));
                // Limits are met in some of them.
                assert!(matches!(command.status, Status::Normal | Status::Saturated));
            }
        }
        _ => {
            let states: Vec<State<7>> = (0..1001).map(state).collect();
            time("inverse dynamics", &states, |x, _| c.computed.arm().inverse_dynamics(&x.q, &x.dq, &x.ddq).sum());
            time("computed torque", &states, |x, y| c.computed.torque(x, y).torque.sum());
            time("computed torque, half", &states, |x, y| c.half.torque(x, y).torque.sum());
            time("gravity compensation", &states, |x, _| c.gravity.torque(x).torque.sum());
            time("hand guiding", &states, |x, _| c.guiding.torque(x).torque.sum());
            time("feed-forward", &states, |x, y| c.ahead.torque(x, y).torque.sum());
            time("adaptive", &states, |x, y| (c.adaptive)(x, y));
            time("momentum observer", &states, |x, y| c.observer.update(x, &y.ddq).torque.sum());
            time("contact force", &states, |x, y| c.contact.at_tip(&x.q, &y.ddq).force.sum());
            time("dissection", &states, |x, _| Dissection::new(c.guiding.arm(), x).sum().sum());
        }
    }
    Ok(())
}
"#;

#[test]
fn cycles_allocate_nothing_and_are_all_as_long() {
    let panda = specs::named("pass/panda").text;
    let program = Program::new("control-cycle", &[("panda", &panda)]);
    let built = program.build(MAIN);
    assert!(
        built.status.success(),
        "{}",
        String::from_utf8_lossy(&built.stderr)
    );
    let allocations = Command::new(program.executable())
        .arg("allocations")
        .output()
        .expect("the program starts");
    assert_eq!(String::from_utf8_lossy(&allocations.stdout), "0\n");

    if Command::new("valgrind").arg("--version").output().is_err() {
        eprintln!("valgrind is not installed: instructions of a control cycle are not counted");
        return;
    }
    let counts = program.path("counts");
    let counted = Command::new("valgrind")
        .args([
            "--tool=callgrind",
            "--toggle-collect=cycle",
            "--dump-after=cycle",
        ])
        .arg(format!("--callgrind-out-file={}", counts.display()))
        .arg(program.executable())
        .arg("instructions")
        .output()
        .expect("valgrind starts");
    let said = String::from_utf8_lossy(&counted.stderr);
    assert!(counted.status.success(), "{said}");
    let instructions: Vec<u64> = (1..=30)
        .map(|cycle| {
            let dump = fs::read_to_string(program.path(&format!("counts.{cycle}")));
            total(&dump.expect("a file a cycle"))
        })
        .collect();
    // The first one binds what it calls.
    let [_, second, rest @ ..] = instructions.as_slice() else {
        unreachable!("there are thirty");
    };
    eprintln!("{second} instructions a cycle");
    assert!(*second > 1000, "{instructions:?}");
    assert!(rest.iter().all(|count| count == second), "{instructions:?}");
}

fn total(dump: &str) -> u64 {
    let line = dump.lines().find_map(|line| line.strip_prefix("totals: "));
    let count = line.and_then(|total| total.trim().parse().ok());
    count.expect("callgrind says the total")
}
