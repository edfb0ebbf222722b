//! The equations of an effect as its definition has them, in text and LaTeX.
//!
//! LaTeX is for pages: no underscore in front of a brace, no backslash in front of a sign, `\cr` where a line ends. So it is the same where
//! the page is taken for Markdown first.

use robot_model_spec::model::{
    Act, BinaryOp, Choice, EffectDefinition, EffectExpr, EffectLeaf, Expr, Function, Signal,
};

use crate::expr::Style;
use crate::expr::number;

/// One equation.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct Equation {
    /// What is defined.
    pub left: String,
    /// By what.
    pub right: String,
}

/// The equations of an effect: parts that have a name and rates of states, each behind what it uses, then torques and what it does else.
#[must_use]
pub fn effect_equations(definition: &EffectDefinition, style: Style) -> Vec<Equation> {
    let writer = Writer { definition, style };
    let bindings = definition.bindings.iter().map(|binding| Equation {
        left: writer.name(&binding.name),
        right: writer.whole(&binding.value),
    });
    let torques = definition.torques.iter().map(|torque| {
        let joint = &definition.joints[torque.joint];
        Equation {
            left: match style {
                Style::Text => format!("torque({joint})"),
                Style::Latex => format!("\\Delta\\tau_{joint}"),
            },
            right: writer.whole(&torque.value),
        }
    });
    let acts = definition.acts.iter().map(|act| writer.act(act));
    bindings.chain(torques).chain(acts).collect()
}

/// How tightly the surroundings bind.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Tie {
    Whole,
    Sum,
    Product,
    Power,
}

struct Writer<'a> {
    definition: &'a EffectDefinition,
    style: Style,
}

impl Writer<'_> {
    fn is_text(&self) -> bool {
        self.style == Style::Text
    }

    fn whole(&self, value: &EffectExpr) -> String {
        self.write(value, Tie::Whole)
    }

    fn act(&self, act: &Act) -> Equation {
        let values: Vec<String> = act.values().map(|value| self.whole(value)).collect();
        let joint = act
            .joint()
            .map_or("", |joint| &self.definition.joints[joint]);
        let (left, right) = if self.is_text() {
            Self::act_in_text(act, joint, &values)
        } else {
            self.act_in_latex(act, joint, &values)
        };
        Equation { left, right }
    }

    /// As definitions have it.
    fn act_in_text(act: &Act, joint: &str, values: &[String]) -> (String, String) {
        let list = format!("[{}]", values.join(", "));
        match act {
            Act::Force { .. } => (format!("force({joint})"), list),
            Act::Body { .. } => (format!("body({joint})"), list),
            Act::Tilt { .. } => ("tilt".to_owned(), list),
            Act::Position { .. } => (format!("position({joint})"), values.concat()),
            Act::Delay { .. } => ("delay".to_owned(), values.concat()),
            other => unreachable!("an act of the language is not written here: {other:?}"),
        }
    }

    /// What it means.
    fn act_in_latex(&self, act: &Act, joint: &str, values: &[String]) -> (String, String) {
        let list = format!(
            "\\begin{{pmatrix}} {} \\end{{pmatrix}}",
            values.join(" \\cr ")
        );
        match act {
            Act::Force { .. } => ("\\Delta\\tau".to_owned(), format!("-J_{joint}(q)^T {list}")),
            Act::Body { .. } => (format!("\\Delta\\varphi_{joint}"), list),
            Act::Tilt { .. } => (
                "g".to_owned(),
                format!(
                    "\\left(R_1({}) R_2({})\\right)^T g^{{\\mathrm{{spec}}}}",
                    values[0], values[1]
                ),
            ),
            Act::Position { value, .. } => {
                let value = self.write(value, Tie::Sum);
                let right = match value.strip_prefix('-') {
                    Some(less) => format!("q_{joint} - {less}"),
                    None => format!("q_{joint} + {value}"),
                };
                (format!("q_{joint}^{{\\mathrm{{link}}}}"), right)
            }
            Act::Delay { .. } => (
                "\\tau^{\\mathrm{log}}(t)".to_owned(),
                format!("\\tau(t - {})", values.concat()),
            ),
            other => unreachable!("an act of the language is not written here: {other:?}"),
        }
    }

    /// A name of the definition.
    fn name(&self, name: &str) -> String {
        const GREEK: [&str; 8] = [
            "alpha", "beta", "gamma", "delta", "eta", "mu", "sigma", "theta",
        ];
        if self.is_text() {
            return name.to_owned();
        }
        // `dot(z)`, the rate of a state.
        if let Some(state) = name
            .strip_prefix("dot(")
            .and_then(|rest| rest.strip_suffix(')'))
        {
            return format!("\\dot {}", self.name(state));
        }
        if GREEK.contains(&name) {
            return format!("\\{name}");
        }
        match name.len() {
            1 => name.to_owned(),
            _ => format!("\\mathrm{{{}}}", name.replace('_', "~")),
        }
    }

    fn leaf(&self, leaf: EffectLeaf) -> String {
        let definition = self.definition;
        match leaf {
            EffectLeaf::Linear(k) => self.name(&definition.linear[k].name),
            EffectLeaf::Shape(k) => self.name(&definition.shapes[k].name),
            EffectLeaf::State(k) => self.name(&definition.states[k].name),
            EffectLeaf::Binding(k) => self.name(&definition.bindings[k].name),
            EffectLeaf::Input(k) => {
                let input = &definition.inputs[k];
                let name = self.name(&input.name);
                match input.joint.map(|joint| &definition.joints[joint]) {
                    None => name,
                    Some(joint) if self.is_text() => format!("{name}({joint})"),
                    Some(joint) => format!("{name}_{joint}"),
                }
            }
            EffectLeaf::Time if self.is_text() => "time".to_owned(),
            EffectLeaf::Time => "t".to_owned(),
            EffectLeaf::Signal(signal, joint) => {
                let joint = &definition.joints[joint];
                match (self.style, signal) {
                    (Style::Text, Signal::Position) => format!("q({joint})"),
                    (Style::Text, Signal::Velocity) => format!("dq({joint})"),
                    (Style::Text, Signal::Acceleration) => format!("ddq({joint})"),
                    (Style::Text, Signal::RigidTorque) => format!("rigid_torque({joint})"),
                    (Style::Text, Signal::MeasuredTorque) => format!("measured_torque({joint})"),
                    (Style::Latex, Signal::Position) => format!("q_{joint}"),
                    (Style::Latex, Signal::Velocity) => format!("\\dot q_{joint}"),
                    (Style::Latex, Signal::Acceleration) => format!("\\ddot q_{joint}"),
                    (Style::Latex, Signal::RigidTorque) => {
                        format!("\\tau_{joint}^{{\\mathrm{{rigid}}}}")
                    }
                    (Style::Latex, Signal::MeasuredTorque) => {
                        format!("\\tau_{joint}^{{\\mathrm{{log}}}}")
                    }
                }
            }
        }
    }

    fn write(&self, value: &EffectExpr, around: Tie) -> String {
        let (text, own) = match value {
            Expr::Number(value) => {
                let tie = if *value < 0.0 { Tie::Sum } else { Tie::Power };
                (self.number(*value), tie)
            }
            Expr::Leaf(leaf) => (self.leaf(*leaf), Tie::Power),
            Expr::Neg(x) => (format!("-{}", self.write(x, Tie::Product)), Tie::Sum),
            Expr::Binary(op, x, y) => self.binary(*op, x, y),
            Expr::Call(function, x) => (self.call(*function, x), Tie::Power),
            Expr::Min(x, y) => (self.two("min", x, y), Tie::Power),
            Expr::Max(x, y) => (self.two("max", x, y), Tie::Power),
            Expr::Choice(choice) => self.choice(choice),
        };
        match (own < around, self.style) {
            (false, _) => text,
            (true, Style::Text) => format!("({text})"),
            (true, Style::Latex) => format!("\\left({text}\\right)"),
        }
    }

    fn number(&self, value: f64) -> String {
        let text = number(value);
        match (self.style, text.split_once('e')) {
            (Style::Latex, Some((digits, power))) => format!("{digits} \\cdot 10^{{{power}}}"),
            _ => text,
        }
    }

    fn binary(&self, op: BinaryOp, x: &EffectExpr, y: &EffectExpr) -> (String, Tie) {
        let is_text = self.is_text();
        match op {
            BinaryOp::Add | BinaryOp::Sub => {
                let sign = if op == BinaryOp::Add { '+' } else { '-' };
                // What is subtracted keeps its parentheses, and so does a minus behind a sign.
                let right = match y {
                    Expr::Binary(BinaryOp::Add, ..) if op == BinaryOp::Add => Tie::Sum,
                    _ => Tie::Product,
                };
                let (x, y) = (self.write(x, Tie::Sum), self.write(y, right));
                (format!("{x} {sign} {y}"), Tie::Sum)
            }
            BinaryOp::Mul => {
                let right = match y {
                    Expr::Binary(BinaryOp::Div, ..) if is_text => Tie::Power,
                    _ => Tie::Product,
                };
                let (x, y) = (self.first_factor(x), self.write(y, right));
                let sign = if is_text { " * " } else { " \\thinspace " };
                product(format!("{x}{sign}{y}"))
            }
            BinaryOp::Div if is_text => {
                let (x, y) = (self.first_factor(x), self.write(y, Tie::Power));
                product(format!("{x} / {y}"))
            }
            BinaryOp::Div => {
                let (x, y) = (self.whole(x), self.whole(y));
                (format!("\\frac{{{x}}}{{{y}}}"), Tie::Product)
            }
            BinaryOp::Pow if is_text => {
                let base = self.write(x, Tie::Power);
                (
                    format!("{base}^{}", self.write(y, Tie::Power)),
                    Tie::Product,
                )
            }
            BinaryOp::Pow => {
                let base = match x {
                    Expr::Leaf(EffectLeaf::Signal(..)) => format!("{{{}}}", self.whole(x)),
                    _ => self.write(x, Tie::Power),
                };
                (format!("{base}^{{{}}}", self.whole(y)), Tie::Product)
            }
        }
    }

    /// A minus in front of a product needs no parentheses.
    fn first_factor(&self, x: &EffectExpr) -> String {
        let tie = match x {
            Expr::Neg(_) => Tie::Sum,
            _ => Tie::Product,
        };
        self.write(x, tie)
    }

    fn call(&self, function: Function, x: &EffectExpr) -> String {
        let name = match function {
            Function::Sin => "sin",
            Function::Cos => "cos",
            Function::Exp => "exp",
            Function::Sqrt => "sqrt",
            Function::Abs => "abs",
            Function::Sign => "sign",
            Function::Tanh => "tanh",
        };
        let x = self.whole(x);
        match (self.style, function) {
            (Style::Text, _) => format!("{name}({x})"),
            (Style::Latex, Function::Abs) => format!("\\left|{x}\\right|"),
            (Style::Latex, Function::Sqrt) => format!("\\sqrt{{{x}}}"),
            (Style::Latex, Function::Sign) => format!("\\mathrm{{sign}}\\left({x}\\right)"),
            (Style::Latex, _) => format!("\\{name}\\left({x}\\right)"),
        }
    }

    fn two(&self, name: &str, x: &EffectExpr, y: &EffectExpr) -> String {
        let (x, y) = (self.whole(x), self.whole(y));
        match self.style {
            Style::Text => format!("{name}({x}, {y})"),
            Style::Latex => format!("\\{name}\\left({x}, {y}\\right)"),
        }
    }

    fn choice(&self, choice: &Choice<EffectLeaf>) -> (String, Tie) {
        let part = |value: &EffectExpr| self.whole(value);
        let (greater, smaller) = (part(&choice.greater), part(&choice.smaller));
        let (then, otherwise) = (part(&choice.then), part(&choice.otherwise));
        match self.style {
            Style::Text => (
                match choice.otherwise {
                    Expr::Choice(_) => {
                        format!("if {greater} > {smaller} {{ {then} }} else {otherwise}")
                    }
                    _ => format!("if {greater} > {smaller} {{ {then} }} else {{ {otherwise} }}"),
                },
                Tie::Whole,
            ),
            Style::Latex => (
                format!(
                    "\\begin{{cases}} {then} & {greater} \\gt {smaller} \\cr {otherwise} & \\text{{otherwise}} \\end{{cases}}"
                ),
                Tie::Product,
            ),
        }
    }
}

/// What begins with a minus binds as a sum does.
fn product(text: String) -> (String, Tie) {
    let tie = if text.starts_with('-') {
        Tie::Sum
    } else {
        Tie::Product
    };
    (text, tie)
}
