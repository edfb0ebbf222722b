//! The interpreter behind the excitation's functions of a motion.

use robot_model::excite::Function;
use robot_model::motion::Kinematics;
use robot_model_codegen::Differentiable;
use robot_model_codegen::expr::Symbol;
use robot_model_codegen::interpreter::{Operand, Program};

use super::orbit::Orbit;

/// Outputs of programs that read a motion over one period, and their slopes. Effects with states have them as they are once the
/// motion has repeated for ever.
#[derive(Debug, Clone)]
pub struct InterpretedFunction {
    programs: Differentiable,
    dof: usize,
    period: f64,
}

impl InterpretedFunction {
    /// Puts programs of an arm with `dof` joints behind the trait, for motions over `period` seconds.
    #[must_use]
    pub fn new(programs: Differentiable, dof: usize, period: f64) -> Self {
        Self {
            programs,
            dof,
            period,
        }
    }

    /// The first state that does not settle where a motion repeats: that remembers for ever, or grows.
    #[must_use]
    pub fn restless_state(&self) -> Option<usize> {
        const SAMPLES: usize = 200;
        let omega = std::f64::consts::TAU / self.period;
        let wave = |joint: usize, order: i32| -> Vec<f64> {
            let omega = omega * (joint + 1) as f64;
            let turn = f64::from(order) * std::f64::consts::FRAC_PI_2;
            let at = |k: usize| {
                let phase = joint as f64 + turn;
                let share = k as f64 / SAMPLES as f64;
                omega.powi(order) * (omega * self.period * share + phase).sin()
            };
            (0..SAMPLES).map(at).collect()
        };
        let all = |order| (0..self.dof).map(|joint| wave(joint, order)).collect();
        let motion = Kinematics {
            q: all(0),
            dq: all(1),
            ddq: all(2),
        };
        let signals = signals(&motion);
        let orbits = self.orbits(&signals);
        let restless = orbits.iter().find(|orbit| !orbit.settles());
        restless.map(Orbit::first_state)
    }

    fn orbits<'a>(&'a self, signals: &'a [&'a [f64]]) -> Vec<Orbit<'a>> {
        let parts = self.programs.memory.iter();
        parts
            .map(|part| Orbit::new(part, self.period, signals))
            .collect()
    }
}

fn signals(motion: &Kinematics) -> Vec<&[f64]> {
    let orders = [&motion.q, &motion.dq, &motion.ddq];
    orders.into_iter().flatten().map(Vec::as_slice).collect()
}

impl Function for InterpretedFunction {
    fn outputs(&self) -> usize {
        self.programs.values.outputs()
    }

    fn values(&self, motion: &Kinematics) -> Vec<Vec<f64>> {
        let signals = signals(motion);
        run(&self.programs.values, motion, &self.orbits(&signals), &[])
    }

    fn pullback(&self, motion: &Kinematics, weights: &[Vec<f64>]) -> Kinematics {
        let signals = signals(motion);
        let orbits = self.orbits(&signals);
        let mut slopes = run(&self.programs.pullback, motion, &orbits, weights);
        let mut by_state = slopes.split_off(3 * self.dof);
        for (orbit, part) in orbits.iter().zip(&self.programs.memory) {
            let rest = by_state.split_off(part.states.count);
            orbit.pull_back(&by_state, &mut slopes);
            by_state = rest;
        }
        let ddq = slopes.split_off(2 * self.dof);
        let dq = slopes.split_off(self.dof);
        Kinematics { q: slopes, dq, ddq }
    }
}

fn run(
    program: &Program,
    motion: &Kinematics,
    orbits: &[Orbit<'_>],
    weights: &[Vec<f64>],
) -> Vec<Vec<f64>> {
    let samples = motion.q.first().map_or(0, Vec::len);
    let states: Vec<(usize, Vec<f64>)> = orbits.iter().flat_map(Orbit::columns).collect();
    let mut out = vec![Vec::new(); program.outputs()];
    let state = |wanted: usize| states.iter().find(|(state, _)| *state == wanted);
    let bind = |symbol| match symbol {
        Symbol::Q(joint) => Operand::Column(&motion.q[joint]),
        Symbol::Dq(joint) => Operand::Column(&motion.dq[joint]),
        Symbol::Ddq(joint) => Operand::Column(&motion.ddq[joint]),
        Symbol::Weight(k) => Operand::Column(&weights[k]),
        Symbol::State(k) => Operand::Column(&state(k).expect("read states have orbits").1),
        _ => unreachable!("the compiler keeps functions of the motion alone"),
    };
    program.eval_batch(samples, &bind, &mut out);
    out
}
