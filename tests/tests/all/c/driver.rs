//! A C program that calls every function of every arm: it reads the arguments of all arms from standard input, again and again,
//! and prints a line of results a function.

use std::collections::BTreeMap;
use std::fmt::Write;

use super::header::Declaration;

const HEAD: &str = r#"#include <stdio.h>

static int numbers(int count, double *values) {
    for (int k = 0; k < count; ++k) {
        if (scanf("%lf", &values[k]) != 1) {
            return 0;
        }
    }
    return 1;
}

static void print(const char *name, int count, const double *values) {
    printf("%s", name);
    for (int k = 0; k < count; ++k) {
        printf(" %.17g", values[k]);
    }
    printf("\n");
}
"#;

/// An arm of the program.
pub struct Arm {
    /// Its name in snake case.
    pub name: String,
    pub functions: Vec<Declaration>,
}

impl Arm {
    /// Arguments of its functions with their numbers of entries, in the order in which the program reads them.
    pub fn arguments(&self) -> BTreeMap<&str, usize> {
        let arguments = self
            .functions
            .iter()
            .flat_map(|function| &function.arguments);
        arguments
            .map(|(name, length)| (name.as_str(), length.unwrap_or(1)))
            .collect()
    }
}

/// The program.
pub fn program(arms: &[&Arm]) -> String {
    let mut text = String::new();
    for arm in arms {
        writeln!(text, "#include \"{}.h\"", arm.name).expect("a string");
    }
    text.push_str(HEAD);
    for arm in arms {
        text.push_str(&run(arm));
    }
    text.push_str("\nint main(void) {\n    while (1) {\n");
    for arm in arms {
        writeln!(text, "        if (!run_{}()) return 0;", arm.name).expect("a string");
    }
    text + "    }\n}\n"
}

fn run(arm: &Arm) -> String {
    let mut text = format!("\nstatic int run_{}(void) {{\n", arm.name);
    for (name, length) in arm.arguments() {
        write!(
            text,
            "    double in_{name}[{length}];\n    if (!numbers({length}, in_{name})) return 0;\n"
        )
        .expect("a string");
    }
    for function in &arm.functions {
        text.push_str(&call(&arm.name, function));
    }
    text + "    return 1;\n}\n"
}

fn call(arm: &str, function: &Declaration) -> String {
    let Declaration { name, kind, .. } = function;
    let arguments = function
        .arguments
        .iter()
        .map(|(name, length)| match length {
            Some(_) => format!("in_{name}"),
            None => format!("in_{name}[0]"),
        });
    let mut arguments: Vec<String> = arguments.collect();
    let Some(sizes) = &function.result else {
        let arguments = arguments.join(", ");
        return format!(
            "    {{ const double result = {arm}_{name}({arguments}); print(\"{name}\", 1, &result); }}\n"
        );
    };
    let dimensions = sizes
        .iter()
        .map(ToString::to_string)
        .collect::<Vec<_>>()
        .join("][");
    let first = "[0]".repeat(sizes.len());
    let count: usize = sizes.iter().product();
    arguments.push("result".to_owned());
    let list = arguments.join(", ");
    let (status, count) = match kind.as_str() {
        "int" => ("const int solved = ", format!("solved ? {count} : 0")),
        _ => ("", count.to_string()),
    };
    let mut text = format!(
        "    {{ double result[{dimensions}]; {status}{arm}_{name}({list}); print(\"{name}\", {count}, &result{first}); }}\n"
    );
    if name == "memory_after" {
        // The new states in the place of the old ones.
        let list = list.replace("result", "in_states");
        let line =
            format!("    {arm}_{name}({list}); print(\"{name}_in_place\", {count}, in_states);\n");
        text.push_str(&line);
    }
    text
}
