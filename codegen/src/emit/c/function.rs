//! One function in C: its declaration under its doc comment, its definition.

use std::collections::BTreeSet;

use super::super::function::{Argument, Equations, Function, Layout, Returns, Step};
use super::super::header::{TIGHT, comment, wrapped};
use super::super::schedule::{Schedule, Temporary};
use super::expression::Speller;
use super::helpers::Helper;

/// Width of the lines.
const WIDTH: usize = 100;
/// A level of indentation.
const INDENT: usize = 4;
/// Most steps of Newton's method: each ends in another piece of a piecewise linear torque, and joints have few.
const STEPS: usize = 20;

/// Whether there is something to compute: C knows no empty arrays.
pub fn has_result(function: &Function) -> bool {
    !function.sizes.contains(&0)
}

/// The declaration with its doc comment.
pub fn declaration(function: &Function, prefix: &str) -> String {
    let mut text = doc(function.doc.iter().map(String::as_str));
    if let Returns::Accelerations(_) = function.returns {
        text.push_str("///\n");
        text.push_str(&doc([
            "Returns 1, or 0 where there is no solution; `ddq` is of no use then.",
        ]));
    }
    text + &signature(function, prefix) + ";\n"
}

/// A doc comment.
pub fn doc<'a>(paragraphs: impl IntoIterator<Item = &'a str>) -> String {
    let paragraphs = paragraphs.into_iter().map(|paragraph| {
        let lines = wrapped(&paragraph.replace("{none}", "0"), WIDTH - 4);
        comment("/// ", &lines)
    });
    paragraphs.collect::<Vec<_>>().join("///\n")
}

fn signature(function: &Function, prefix: &str) -> String {
    let kind = match (&function.returns, &function.sizes[..]) {
        (Returns::Accelerations(_), _) => "int",
        (_, []) => "double",
        _ => "void",
    };
    let parameter = |argument: &Argument| {
        let name = argument.name;
        match argument.length {
            Some(0) => None,
            Some(length) => Some(format!("const{TIGHT}double{TIGHT}{name}[{length}]")),
            None => Some(format!("double{TIGHT}{name}")),
        }
    };
    let mut parameters: Vec<String> = function.arguments.iter().filter_map(parameter).collect();
    if !function.sizes.is_empty() {
        let sizes = function.sizes.iter().map(|size| format!("[{size}]"));
        let sizes = sizes.collect::<String>();
        parameters.push(format!("double{TIGHT}{}{sizes}", function.result));
    }
    if parameters.is_empty() {
        parameters.push("void".to_owned());
    }
    let name = function.name;
    let text = format!("{kind}{TIGHT}{prefix}_{name}({})", parameters.join(", "));
    statement(0, &text).trim_end().to_owned()
}

/// A line of code, broken where it is too long.
fn statement(level: usize, text: &str) -> String {
    let indent = INDENT * level;
    let lines = wrapped(text, WIDTH - indent - INDENT).into_iter();
    let lines = lines.enumerate().map(|(k, line)| {
        let indent = if k == 0 { indent } else { indent + INDENT };
        format!("{:indent$}{line}\n", "")
    });
    lines.collect()
}

/// The definition, and the helpers that it calls.
pub fn definition(function: &Function, prefix: &str) -> (String, BTreeSet<Helper>) {
    let mut lines = Lines {
        text: signature(function, prefix) + " {\n",
        level: 1,
        speller: Speller::new(prefix),
    };
    let unread = function.arguments.iter();
    let unread = unread.filter(|argument| !argument.is_read && argument.length != Some(0));
    for argument in unread {
        lines.push(&format!("(void){};", argument.name));
    }
    lines.results(function);
    (lines.text + "}\n", lines.speller.called())
}

/// The lines of a function.
struct Lines<'a> {
    text: String,
    level: usize,
    speller: Speller<'a>,
}

impl Lines<'_> {
    fn push(&mut self, line: &str) {
        self.text.push_str(&statement(self.level, line));
    }

    /// `for (int k = 0; k < 3; ++k) {`
    fn open(&mut self, head: &str) {
        self.push(&format!("{} {{", head.replace(' ', &TIGHT.to_string())));
        self.level += 1;
    }

    fn close(&mut self) {
        self.level -= 1;
        self.push("}");
    }

    fn temporary(&mut self, Temporary { name, value }: &Temporary) {
        let value = self.speller.text(value);
        self.push(&format!("const{TIGHT}double{TIGHT}{name}{TIGHT}= {value};"));
    }

    /// What comes before the outputs, under its section comments; entries of a sparse layout among it.
    fn statements(&mut self, function: &Function) {
        let schedule = &function.schedule;
        if !(schedule.sums.is_empty() && schedule.angles.is_empty()) {
            self.push("// Trigonometry.");
            for sum in &schedule.sums {
                self.temporary(sum);
            }
            self.sines_cosines(schedule);
            self.text.push('\n');
        }
        let steps = function.steps();
        if steps.is_empty() {
            return;
        }
        self.push(&format!("// {}", function.title_of_steps()));
        for step in steps {
            match step {
                Step::Shared(shared) => self.temporary(shared),
                Step::Entry(k) => self.entry(function, k),
            }
        }
        if function.layout() == Layout::Full {
            self.text.push('\n');
        }
    }

    /// `y[0][1] = x;`
    fn entry(&mut self, function: &Function, k: usize) {
        let place = format!("{}{}", function.result, indices(&function.sizes, k));
        let value = self.speller.text(&function.schedule.outputs[k]);
        self.set(&place, &value);
    }

    fn sines_cosines(&mut self, schedule: &Schedule) {
        let angles = &schedule.angles;
        let count = angles.len();
        if count == 0 {
            return;
        }
        let values = angles.iter();
        let values = values.map(|angle| self.speller.text(&angle.value));
        let values = values.collect::<Vec<_>>().join(", ");
        self.push(&format!(
            "const{TIGHT}double{TIGHT}angles[{count}] = {{{values}}};"
        ));
        self.push(&format!("double{TIGHT}sines[{count}];"));
        self.push(&format!("double{TIGHT}cosines[{count}];"));
        let sines_cosines = self.speller.helper(Helper::SinesCosines);
        self.push(&format!(
            "{sines_cosines}({count}, angles, sines, cosines);"
        ));
        for (k, angle) in angles.iter().enumerate() {
            for (name, row) in [(&angle.sine, "sines"), (&angle.cosine, "cosines")] {
                if let Some(name) = name {
                    self.push(&format!(
                        "const{TIGHT}double{TIGHT}{name}{TIGHT}= {row}[{k}];"
                    ));
                }
            }
        }
    }

    /// Statements, and results written last.
    fn results(&mut self, function: &Function) {
        if let Returns::Accelerations(Equations::Nonlinear) = function.returns {
            return self.newton(function);
        }
        let is_sparse = function.layout() == Layout::Sparse;
        if is_sparse {
            self.zeros(function);
        }
        self.statements(function);
        match &function.returns {
            Returns::Accelerations(equations) => {
                self.equations(function, "ddq");
                let solver = match equations {
                    Equations::Symmetric => Helper::PositiveDefinite,
                    _ => Helper::General,
                };
                let solver = self.speller.helper(solver);
                self.push(&format!("return{TIGHT}{solver}(slope, ddq);"));
            }
            Returns::Memory(counts) => self.after_step(function, counts),
            _ if is_sparse => {}
            Returns::Scalar => {
                let value = self.speller.text(&function.schedule.outputs[0]);
                self.push(&format!("return{TIGHT}{value};"));
            }
            _ => (0..function.schedule.outputs.len()).for_each(|k| self.entry(function, k)),
        }
    }

    fn zeros(&mut self, function: &Function) {
        self.open(&format!("for (int i = 0; i < {}; ++i)", function.sizes[0]));
        self.open(&format!("for (int k = 0; k < {}; ++k)", function.sizes[1]));
        self.push(&format!("{}[i][k] = 0.0;", function.result));
        self.close();
        self.close();
        self.text.push('\n');
    }

    fn set(&mut self, place: &str, value: &str) {
        self.push(&format!("{place}{TIGHT}= {value};"));
    }

    /// `slope` and right-hand side of the equations of accelerations.
    fn equations(&mut self, function: &Function, rest: &str) {
        let dof = function.sizes[0];
        let (slope, torque) = function.schedule.outputs.split_at(dof * dof);
        self.push(&format!("double{TIGHT}slope[{dof}][{dof}];"));
        for (k, entry) in slope.iter().enumerate() {
            let entry = self.speller.text(entry);
            self.set(&format!("slope{}", indices(&[dof, dof], k)), &entry);
        }
        for (k, torque) in torque.iter().enumerate() {
            let torque = self.speller.text(torque);
            let value = if function.is_zero[dof * dof + k] {
                format!("tau[{k}]")
            } else {
                format!("tau[{k}] -{TIGHT}({torque})")
            };
            self.set(&format!("{rest}[{k}]"), &value);
        }
    }

    /// Newton's method from accelerations of zero.
    fn newton(&mut self, function: &Function) {
        let dof = function.sizes[0];
        self.open(&format!("for (int k = 0; k < {dof}; ++k)"));
        self.push("ddq[k] = 0.0;");
        self.close();
        self.open(&format!("for (int step = 0; step < {STEPS}; ++step)"));
        self.statements(function);
        self.push(&format!("double{TIGHT}change[{dof}];"));
        self.equations(function, "change");
        let general = self.speller.helper(Helper::General);
        self.open(&format!("if (!{general}(slope, change))"));
        self.push("return 0;");
        self.close();
        let settled = self.speller.helper(Helper::Settled);
        self.open(&format!("if ({settled}(ddq, change))"));
        self.push("return 1;");
        self.close();
        self.close();
        self.push("return 0;");
    }

    /// States effect by effect. Those of one effect are read before they are written, and no other reads them: the result may
    /// take the place of the states before.
    fn after_step(&mut self, function: &Function, counts: &[usize]) {
        let result = function.result;
        let outputs = function.schedule.outputs.iter();
        let outputs: Vec<String> = outputs.map(|output| self.speller.text(output)).collect();
        let mut outputs = outputs.into_iter();
        let mut first = 0;
        for &count in counts.iter().filter(|&&count| count > 0) {
            let mut take = |n: usize| outputs.by_ref().take(n).collect::<Vec<_>>().join(", ");
            let (rates, slopes) = (take(count), take(count * count));
            if count == 1 {
                let after = self.speller.helper(Helper::After);
                self.push(&format!(
                    "{result}[{first}] = {after}(states[{first}], seconds, {rates}, {slopes});"
                ));
            } else {
                let all = count * count;
                self.push(&format!(
                    "const{TIGHT}double{TIGHT}rates{first}[{count}] = {{{rates}}};"
                ));
                self.push(&format!(
                    "const{TIGHT}double{TIGHT}slopes{first}[{all}] = {{{slopes}}};"
                ));
                for k in first..first + count {
                    self.push(&format!("{result}[{k}] = states[{k}];"));
                }
                let after_several = self.speller.helper(Helper::AfterSeveral);
                self.push(&format!(
                    "{after_several}({count}, seconds, rates{first}, slopes{first}, &{result}[{first}]);"
                ));
            }
            first += count;
        }
    }
}

/// `[1][0]` of the entry at place `k`.
fn indices(sizes: &[usize], k: usize) -> String {
    let (mut rest, mut text) = (k, String::new());
    for &size in sizes.iter().rev() {
        text = format!("[{}]{text}", rest % size);
        rest /= size;
    }
    text
}
