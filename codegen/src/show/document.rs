//! A whole model as a LaTeX document.

use std::fmt::Write as _;

use super::{What, form};
use crate::compiled::Compiled;
use crate::expr::Style;

/// The chapters: title, what the symbols are, and the form.
const CHAPTERS: [(&str, &str, What); 13] = [
    (
        "Measurement",
        "Where links stand that are not at $q$, and by how many seconds logged torques are late.",
        What::Measurement,
    ),
    (
        "Internal states",
        "Rates of what effects remember; each state is zero at the start of a log.",
        What::StateRates,
    ),
    (
        "Base parameters",
        "What measurements tell: the smallest set of combinations of standard parameters that the torque determines.",
        What::BaseParameters,
    ),
    (
        "Mass matrix",
        "$\\tau = M(q)\\,\\ddot q + C(q, \\dot q)\\,\\dot q + G(q) + \\mbox{effects}$; $M$ is symmetric.",
        What::MassMatrix,
    ),
    (
        "Coriolis matrix",
        "In the form of Christoffel: $\\dot M - 2C$ is skew.",
        What::CoriolisMatrix,
    ),
    (
        "Gravity",
        "The gradient of the potential energy.",
        What::Gravity,
    ),
    (
        "Energies",
        "Kinetic energy $T$ and potential energy $V$ of the rigid body; $V$ up to a constant.",
        What::Energies,
    ),
    (
        "Inverse dynamics",
        "Torque of a motion, with the declared effects.",
        What::InverseDynamics,
    ),
    (
        "Forward dynamics",
        "$A\\,\\ddot q = \\tau - b$.",
        What::ForwardDynamics,
    ),
    (
        "Base regressor",
        "$\\tau = Y^{\\mathrm{b}}\\beta$, besides what the spec fixes.",
        What::BaseRegressor,
    ),
    (
        "Filtered regressor",
        "$L\\{\\tau\\} = Y^{\\mathrm{L}}\\beta$ with $L(s) = w/(s + w)$ and $Y^{\\mathrm{L}} = w\\,(Y^{\\mathrm{p}} - \
         L\\{Y^{\\mathrm{p}}\\}) - L\\{Y^{\\mathrm{h}}\\}$: no acceleration is needed.",
        What::BaseFilteredRegressor,
    ),
    (
        "Forward kinematics",
        "Rotation $R^{(i)}$ and origin $p^{(i)}$ of the frame of link $i$ in the base frame, or the points that the spec names.",
        What::ForwardKinematics,
    ),
    (
        "Jacobian",
        "Velocity and angular velocity of the tip in the base frame are $J\\,\\dot q$.",
        What::Jacobian,
    ),
];

/// A document that compiles with `amsmath` alone; equations break over pages.
#[must_use]
pub fn document(compiled: &Compiled) -> String {
    let name = compiled.model.name.replace('_', "\\_");
    let mut text = String::from(
        "\\documentclass[a4paper,landscape]{article}\n\
         \\usepackage[margin=15mm]{geometry}\n\
         \\usepackage{amsmath}\n\
         \\allowdisplaybreaks\n\
         \\setlength{\\parindent}{0pt}\n\
         \\begin{document}\n",
    );
    let _ = writeln!(
        text,
        "\\section*{{{name}}}\n{} joints, {} standard parameters, {} base parameters. SI units, rad.",
        compiled.dof(),
        compiled.standard.len(),
        compiled.base.kept.len(),
    );
    for (title, meaning, what) in CHAPTERS {
        let equations = form(compiled, what, Style::Latex);
        let lines = equations.lines().filter(|line| !line.starts_with('%'));
        let lines: Vec<&str> = lines.collect();
        // What a robot does not have, such as the points of one that names none, is no chapter.
        if lines.is_empty() {
            continue;
        }
        let equations = lines.join("\n");
        // The last line of a display is not ended.
        let equations = equations.trim_end().trim_end_matches("\\\\").trim_end();
        let _ = writeln!(
            text,
            "\n\\subsection*{{{title}}}\n{meaning}\n{{\\footnotesize\n\\begin{{align*}}\n{equations}\n\\end{{align*}}}}"
        );
    }
    text.push_str("\\end{document}\n");
    text
}
