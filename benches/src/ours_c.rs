//! Our contenders in C: what `emit --lang c` writes, compiled as the peers' code is.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use robot_model_codegen::Compiled;
use robot_model_codegen::emit::{Extent, c};

use crate::arm::{Arm, FUNCTIONS};
use crate::peers::{self, Contender};
use crate::report::Form;
use crate::{Error, failed};

/// Programs of an arm: base parameters in the equations, and as an argument.
///
/// # Errors
/// There is no compiler, or it does not take the code.
pub fn contenders(folder: &Path, arm: &Arm) -> Result<Vec<Contender>, Error> {
    let forms = [(Form::Baked, &arm.baked), (Form::Runtime, &arm.runtime)];
    let made = forms.map(|(form, compiled)| {
        // Two folders: both forms have the same names.
        let folder = folder.join("c").join(arm.name).join(form.name());
        let code = c::code_of(compiled, Extent::Torque);
        let write = |name: &str, text: &str| {
            let path = folder.join(name);
            fs::write(&path, text).map_err(|error| failed("write", &path, error))
        };
        fs::create_dir_all(&folder).map_err(|error| failed("make", &folder, error))?;
        write(&format!("{}.h", code.name.as_str()), &code.header)?;
        write("program.c", &program(arm, compiled, &code)?)?;
        let name = format!("c {}", form.name());
        let source = folder.join("program.c");
        peers::compile_one(
            &name,
            &peers::cc(),
            &source,
            &["-std=c11".to_owned()],
            Some(form),
        )
    });
    made.into_iter().collect()
}

/// The emitted source with the table of its functions.
fn program(arm: &Arm, compiled: &Compiled, code: &c::Code) -> Result<String, Error> {
    let put = "a string takes text";
    let mut text = format!("{}\n#include \"contender.h\"\n\n", code.source);
    let beta: Vec<String> = arm.beta.iter().map(|x| format!("{x:e}")).collect();
    writeln!(
        text,
        "static const double beta[] = {{{}}};\n",
        beta.join(", ")
    )
    .expect(put);
    let mut table = String::new();
    for function in FUNCTIONS {
        let name = format!("{}_{function}", code.name.as_str());
        let arguments = arguments(&code.header, &name)?;
        let without_parameters = !arguments.iter().any(|argument| argument == "beta");
        // One function of both forms is timed once.
        if without_parameters && std::ptr::eq(compiled, &raw const arm.runtime) {
            continue;
        }
        let [inputs @ .., _] = arguments.as_slice() else {
            return Err(Error::new(format!("`{name}` has no arguments")));
        };
        writeln!(
            text,
            "static void call_{function}(const double *q, const double *dq, const double *ddq, const double *c, double *out) {{\n    \
             (void)q, (void)dq, (void)ddq, (void)c, (void)beta;\n    {name}({}, (void *)out);\n}}\n",
            inputs.join(", ")
        )
        .expect(put);
        let outputs = arm.outputs(function);
        writeln!(
            table,
            "    {{\"{function}\", 0, {outputs}, call_{function}, 0, 0}},"
        )
        .expect(put);
    }
    let dof = arm.dof();
    writeln!(
        text,
        "int joints = {dof};\nvoid prepare(const char *program) {{ (void)program; }}\nstruct contender contenders[] = {{\n{table}    {{0, 0, 0, 0, 0, 0}},\n}};"
    )
    .expect(put);
    Ok(text)
}

/// Names of the arguments of a function, from its declaration in a header.
fn arguments(header: &str, function: &str) -> Result<Vec<String>, Error> {
    let list = header
        .split_once(&format!(" {function}("))
        .and_then(|(_, rest)| Some(rest.split_once(')')?.0));
    let list = list.ok_or_else(|| {
        Error::new(format!(
            "the emitted header declares no `{function}`: teach `benches/src/ours_c.rs` how it does"
        ))
    })?;
    let name = |argument: &str| {
        let before = argument.split('[').next().unwrap_or_default();
        before.split_whitespace().last().map(str::to_owned)
    };
    Ok(list.split(',').filter_map(name).collect())
}

#[cfg(test)]
mod tests {
    use robot_model_codegen::emit::{Extent, c};

    use super::{arguments, program};
    use crate::arm::Arm;

    const PENDULUM: &str = "robot Pendulum {
        gravity = [0, 0, -9.81];
        convention = standard_dh;
        joint swing: revolute { a = 0.5; alpha = 90 deg; d = 0; }
        link swing { mass = 2; com = [-0.1, 0.2, 0]; inertia = [0.1, 0.2, 0.3, 0, 0, 0]; }
    }";

    #[test]
    fn functions_are_in_the_table_and_those_without_parameters_once() {
        let arm = Arm::rigid("pendulum", PENDULUM).expect("a spec with values");
        let text = |compiled| {
            let code = c::code_of(compiled, Extent::Torque);
            program(&arm, compiled, &code).expect("all are declared")
        };
        let (baked, runtime) = (text(&arm.baked), text(&arm.runtime));
        for text in [&baked, &runtime] {
            assert!(
                text.contains("{\"mass_matrix\", 0, 1, call_mass_matrix, 0, 0}"),
                "{text}"
            );
        }
        assert!(
            runtime.contains("pendulum_gravity(q, beta, (void *)out);"),
            "{runtime}"
        );
        assert!(
            baked.contains("pendulum_gravity(q, (void *)out);"),
            "{baked}"
        );
        assert!(baked.contains("{\"base_regressor\"") && !runtime.contains("{\"base_regressor\""));
    }

    #[test]
    fn arguments_are_those_of_the_declaration() {
        let header = "/// Gravity.\nvoid arm_gravity(const double q[2], const double beta[4],\n    double G[2]);\n";
        assert_eq!(
            arguments(header, "arm_gravity").ok(),
            Some(["q", "beta", "G"].map(str::to_owned).to_vec())
        );
        let error = arguments(header, "arm_bias").expect_err("there is none");
        assert!(error.to_string().contains("`arm_bias`"), "{error}");
    }
}
