//! The interpreter behind the excitation's functions of a motion.

use robot_model::excite::Function;
use robot_model::motion::Kinematics;
use robot_model_codegen::Differentiable;
use robot_model_codegen::expr::Symbol;
use robot_model_codegen::interpreter::{Operand, Program};

/// Outputs of programs that read a motion, and their slopes.
#[derive(Debug, Clone)]
pub struct InterpretedFunction {
    programs: Differentiable,
    dof: usize,
}

impl InterpretedFunction {
    /// Puts programs of an arm with `dof` joints behind the trait.
    #[must_use]
    pub fn new(programs: Differentiable, dof: usize) -> Self {
        Self { programs, dof }
    }
}

impl Function for InterpretedFunction {
    fn outputs(&self) -> usize {
        self.programs.values.outputs()
    }

    fn values(&self, motion: &Kinematics) -> Vec<Vec<f64>> {
        run(&self.programs.values, motion, &[])
    }

    fn pullback(&self, motion: &Kinematics, weights: &[Vec<f64>]) -> Kinematics {
        let mut slopes = run(&self.programs.pullback, motion, weights);
        let ddq = slopes.split_off(2 * self.dof);
        let dq = slopes.split_off(self.dof);
        Kinematics { q: slopes, dq, ddq }
    }
}

fn run(program: &Program, motion: &Kinematics, weights: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let samples = motion.q.first().map_or(0, Vec::len);
    let mut out = vec![Vec::new(); program.outputs()];
    let bind = |symbol| match symbol {
        Symbol::Q(joint) => Operand::Column(&motion.q[joint]),
        Symbol::Dq(joint) => Operand::Column(&motion.dq[joint]),
        Symbol::Ddq(joint) => Operand::Column(&motion.ddq[joint]),
        Symbol::Weight(k) => Operand::Column(&weights[k]),
        _ => unreachable!("the compiler keeps functions of the motion alone"),
    };
    program.eval_batch(samples, &bind, &mut out);
    out
}
