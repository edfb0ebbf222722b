//! C99 for one robot: a header and a source of functions on arrays of `double`, which need nothing but libm. C++ compiles them too.
//!
//! In: [`Compiled`]. Out: [`Code`]. Same spec, same bytes. A [`Prefix`] stands before all names, so that several arms are linked
//! into one program.

mod expression;
mod function;
mod helpers;
mod prefix;
mod reserved;

use std::fmt::Write;

use super::function::{Function, Returns};
use super::functions::{functions, its_standard, standard_of};
use super::header::{WIDTH, comment, header, legend, wrapped};
use super::schedule::Schedule;
use super::table::Table;
use super::{Extent, function as shared};
use crate::base;
use crate::compiled::Compiled;
use expression::number;
pub use prefix::{Prefix, PrefixError};
pub use reserved::Reserved;

/// The two files of a robot.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Code {
    /// The files are called `NAME.h` and `NAME.c`, functions `NAME_gravity` and so on.
    pub name: Prefix,
    /// Declarations with their doc comments, constants.
    pub header: String,
    /// Definitions.
    pub source: String,
}

/// What arguments are, in the order in which functions have them.
const ARGUMENTS: [(&str, &str); 13] = [
    ("q", "positions, rad or m"),
    ("dq", "velocities"),
    ("ddq", "accelerations"),
    ("tau", "torques of the joints, N m or N"),
    (
        "rigid_torque",
        "loads, `M * ddq + C * dq + G` of `mass_matrix` and `bias`; of `load` where there is one",
    ),
    ("measured_torque", "torques as they are measured"),
    ("time", "seconds since the start"),
    (
        "inputs",
        "further measured channels, in the order of `input_names`",
    ),
    (
        "states",
        "internal states of effects, in the order of `state_names`, 0 at the start",
    ),
    (
        "seconds",
        "length of a step; `states_after` may be `states` itself",
    ),
    (
        "standard",
        "standard parameters, in the order of `standard_parameter_names`",
    ),
    (
        "beta",
        "base parameters, in the order of `base_parameter_names`",
    ),
    (
        "shapes",
        "shape parameters, in the order of `shape_parameter_names`",
    ),
];

/// The code.
#[must_use]
pub fn code(compiled: &Compiled) -> Code {
    code_of(compiled, Extent::All)
}

/// The code, or the part of it that is wanted.
#[must_use]
pub fn code_of(compiled: &Compiled, extent: Extent) -> Code {
    code_named(compiled, extent, Prefix::of_robot(&compiled.model.name))
}

/// The code with names that start otherwise: two specimens of one arm, or an arm with its parameters as arguments and in its
/// equations, have a prefix each to be in one program.
#[must_use]
pub fn code_named(compiled: &Compiled, extent: Extent, prefix: Prefix) -> Code {
    let name = prefix.as_str();
    let mut functions = functions(compiled, extent);
    if compiled.baked.is_none() {
        functions.push(back(compiled));
    }
    functions.retain(function::has_result);
    let constants = Constants::new(compiled);
    Code {
        header: header_file(compiled, name, &functions, &constants),
        source: source_file(compiled, name, &functions, &constants),
        name: prefix,
    }
}

/// From base parameters back to standard ones.
fn back(compiled: &Compiled) -> Function {
    let outputs = standard_of(compiled);
    let count = outputs.len();
    Function {
        name: "standard_of",
        doc: vec![
            "Standard parameters with these base parameters: those that the map to base parameters prefers, what the spec fixes, \
             and zeros."
                .to_owned(),
        ],
        arguments: vec![shared::Argument {
            name: "beta",
            length: Some(compiled.base.kept.len()),
            is_read: !compiled.base.kept.is_empty(),
        }],
        result: "standard",
        sizes: vec![count],
        returns: Returns::List,
        is_zero: vec![false; count],
        schedule: Schedule::of_outputs(outputs),
    }
}

/// Sizes, names and numbers of an arm.
struct Constants {
    sizes: Vec<(&'static str, usize)>,
    /// Name, first paragraph of the doc comment, type, entries; no empty ones.
    arrays: Vec<Array>,
}

struct Array {
    name: &'static str,
    doc: &'static str,
    size: &'static str,
    entries: Entries,
}

enum Entries {
    Names(Vec<String>),
    Numbers(Vec<f64>),
}

impl Constants {
    fn new(compiled: &Compiled) -> Self {
        let table = Table::new(compiled, &base::shape_values(&compiled.model));
        let names = |name, doc, size, entries| Array {
            name,
            doc,
            size,
            entries: Entries::Names(entries),
        };
        let numbers = |name, doc, size, entries| Array {
            name,
            doc,
            size,
            entries: Entries::Numbers(entries),
        };
        let sizes = vec![
            ("DOF", table.joints.len()),
            ("STANDARD", table.standard.len()),
            ("BASE", table.base.len()),
            ("SHAPES", table.shapes.len()),
            ("STATES", table.states.len()),
            ("INPUTS", table.inputs.len()),
            ("POINTS", table.points.len()),
        ];
        let mut arrays = vec![
            names("joint_names", "Names of the joints.", "DOF", table.joints),
            names(
                "standard_parameter_names",
                "Names of the standard parameters.",
                "STANDARD",
                table.standard,
            ),
            names(
                "base_parameter_names",
                "Names of the base parameters.",
                "BASE",
                table.base,
            ),
            names(
                "shape_parameter_names",
                "Names of the shape parameters that are arguments.",
                "SHAPES",
                table.shapes,
            ),
            names(
                "input_names",
                "Names of further measured channels.",
                "INPUTS",
                table.inputs,
            ),
            names(
                "state_names",
                "Names of the effects' internal states.",
                "STATES",
                table.states,
            ),
            names(
                "point_names",
                "Names of the points.",
                "POINTS",
                table.points,
            ),
            numbers(
                "nominal",
                "Standard parameters as the spec gives them; 0 where it does not.",
                "STANDARD",
                table.nominal,
            ),
            numbers(
                "nominal_shapes",
                "Shape parameters before identification.",
                "SHAPES",
                table.nominal_shapes,
            ),
        ];
        if let Some(beta) = &compiled.baked {
            arrays.push(numbers(
                "beta",
                "The base parameters that are in the equations.",
                "BASE",
                beta.clone(),
            ));
            let standard = its_standard(compiled, beta);
            arrays.push(numbers(
                "standard",
                "Standard parameters with these base parameters: what falls out is 0, so they are no masses of the arm's links.",
                "STANDARD",
                standard,
            ));
        }
        // What the spec says is not what the equations have.
        arrays.retain(|array| array.name != "nominal" || compiled.baked.is_none());
        arrays.retain(|array| !sizes.contains(&(array.size, 0)));
        Self { sizes, arrays }
    }
}

impl Array {
    /// `const double puma560_nominal[PUMA560_STANDARD]`
    fn declarator(&self, prefix: &str) -> String {
        let kind = match self.entries {
            Entries::Names(_) => "const char *const ",
            Entries::Numbers(_) => "const double ",
        };
        format!(
            "{kind}{prefix}_{}[{}_{}]",
            self.name,
            prefix.to_ascii_uppercase(),
            self.size
        )
    }

    fn definition(&self, prefix: &str) -> String {
        let entries: Vec<String> = match &self.entries {
            Entries::Names(names) => names.iter().map(|name| format!("{name:?}")).collect(),
            Entries::Numbers(numbers) => numbers.iter().map(|&value| number(value)).collect(),
        };
        let mut text = format!("{} = {{\n", self.declarator(prefix));
        for entry in entries {
            let _ = writeln!(text, "    {entry},");
        }
        text + "};\n"
    }
}

fn header_file(
    compiled: &Compiled,
    name: &str,
    functions: &[Function],
    constants: &Constants,
) -> String {
    let upper = name.to_ascii_uppercase();
    let mut text = comment("// ", &header(compiled));
    let about = format!(
        "Functions keep nothing and allocate nothing. Vectors have one entry a joint where nothing else is said, matrices are \
         [row][column]. Results do not overlap arguments. Names in comments are without `{name}_`. Compile {name}.c, and link \
         libm."
    );
    text.push_str("//\n");
    text.push_str(&comment("// ", &wrapped(&about, WIDTH)));
    text.push_str("//\n");
    for (argument, meaning) in ARGUMENTS {
        if functions.iter().any(|function| function.takes(argument)) {
            text.push_str(&comment("// ", &[format!("{argument}: {meaning}")]));
        }
    }
    let _ = write!(
        text,
        "\n#ifndef {upper}_H\n#define {upper}_H\n\n#ifdef __cplusplus\nextern \"C\" {{\n#endif\n\n"
    );
    let _ = writeln!(text, "#define {upper}_NAME {:?}", compiled.model.name);
    for (size, count) in &constants.sizes {
        let _ = writeln!(text, "#define {upper}_{size} {count}");
    }
    text.push('\n');
    for array in &constants.arrays {
        text.push_str(&function::doc([array.doc]));
        let _ = writeln!(text, "extern {};", array.declarator(name));
    }
    for function in functions {
        text.push('\n');
        text.push_str(&function::declaration(function, name));
    }
    text + "\n#ifdef __cplusplus\n}\n#endif\n\n#endif\n"
}

fn source_file(
    compiled: &Compiled,
    name: &str,
    functions: &[Function],
    constants: &Constants,
) -> String {
    let functions = functions.iter();
    let (definitions, called): (Vec<_>, Vec<_>) = functions
        .map(|function| function::definition(function, name))
        .unzip();
    let helpers = helpers::with_callees(&called.into_iter().flatten().collect());
    let helpers: Vec<String> = helpers
        .iter()
        .map(|helper| helper.definition(name))
        .collect();
    let mut text = comment("// ", &header(compiled));
    text.push_str(&comment("// ", &legend(compiled)));
    let _ = write!(text, "\n#include \"{name}.h\"\n\n#include <math.h>\n");
    for array in &constants.arrays {
        text.push('\n');
        text.push_str(&array.definition(name));
    }
    for part in helpers.iter().chain(&definitions) {
        text.push('\n');
        text.push_str(part);
    }
    text
}
