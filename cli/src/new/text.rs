//! The text of specs to start from.

use std::fmt::Write;

use robot_model_spec::model::{Convention, EffectDefinition};
use robot_model_spec::standard_effects;

/// Where comments stand behind settings.
const MARGIN: usize = 62;

/// Lines of a spec, some with a comment behind them.
struct Lines(String);

impl Lines {
    fn new(file: &str) -> Self {
        let mut lines = Self(String::new());
        lines.line("// All numbers are placeholders: replace them with those of your arm.");
        lines.line(&format!("// `robot-model check {file}` reports every mistake with its place; `show` prints the resulting equations."));
        lines.line("// Plain numbers are in m, kg, s, rad, N m; other units follow the number: 90 deg, 350 mm, 30 rpm.");
        lines
    }

    fn line(&mut self, text: &str) {
        self.0.push_str(text.trim_end());
        self.0.push('\n');
    }

    /// A line with what it is.
    fn told(&mut self, text: &str, comment: &str) {
        self.line(&format!("{text:MARGIN$}  // {comment}"));
    }
}

/// A chain of revolute joints.
pub(super) fn of_chain(name: &str, file: &str, joints: usize, convention: Convention) -> String {
    let mut lines = Lines::new(file);
    lines.line(&format!("robot {name} {{"));
    lines.told(
        "    gravity = [0, 0, -9.81];",
        "m/s^2 in the frame of the base; points down",
    );
    lines.told(
        &format!("    convention = {};", convention.name()),
        frame_of(convention),
    );
    lines.line("");
    lines.line("    // Joints from the base to the tip: `revolute`, or `prismatic` (then lengths instead of angles, N instead of N m).");
    lines.line(&format!("    // {}", frame_keys(convention)));
    lines.line("    // Limits are optional; `excite` keeps them. Add `actuator_gain = 0.1 Nm/A;` if logs have currents instead of torques.");
    for joint in 1..=joints {
        lines.line(&format!(
            "    joint joint{joint}: revolute {{ {} position = -150 deg .. 150 deg; velocity = 120 deg/s; acceleration = 10; torque = 50 Nm; }}",
            frame(convention, joint)
        ));
    }
    lines.line("");
    lines.line("    // Links have the names of their joints. `nominal` inertials are CAD values, which are still identified; `fixed` ones are");
    lines.line("    // exact and kept. A link without a line is identified without start values. The inertia is about the center of mass:");
    lines.line("    // [ixx, ixy, ixz, iyy, iyz, izz], kg m^2.");
    for joint in 1..=joints {
        let status = if joint == joints && joints > 1 {
            "fixed"
        } else {
            "nominal"
        };
        lines.line(&format!(
            "    // link joint{joint}: {status} {{ mass = 2 kg; com = [0.1, 0, 0.02]; inertia = [0.01, 0, 0, 0.02, 0, 0.02]; }}"
        ));
    }
    let first = "joint1";
    logs(&mut lines, joints);
    effects(&mut lines, first);
    lines.0
}

/// A planar chain of bars that hang from the base, by its energies.
pub(super) fn of_energies(name: &str, file: &str, joints: usize) -> String {
    let mut lines = Lines::new(file);
    let all = |text: &dyn Fn(usize) -> String| -> String {
        (1..=joints).map(text).collect::<Vec<_>>().join(", ")
    };
    lines.line(&format!("robot {name} {{"));
    lines.told(
        &format!("    coordinates {};", all(&|k| format!("q{k}"))),
        "angles, rad; `x: m` is a length",
    );
    lines.line("    // Unknown, to be identified: masses, moments of inertia about the centers of mass, distances of these from the joints.");
    lines.line("    // Values are start values, from CAD: `m1 = 2 kg`. Logs determine products, such as m1*c1^2.");
    for k in 1..=joints {
        lines.line(&format!("    parameters m{k}: kg, I{k}: kg*m^2, c{k}: m;"));
    }
    lines.told(
        "    constants g = 9.81 m/s^2;",
        "known; dimensions are checked",
    );
    for k in 1..joints {
        lines.told(
            &format!("    constants l{k} = 400 mm;"),
            "from this joint to the next",
        );
    }
    lines.line("    // Positions of the centers of mass; the first coordinate is measured from the vertical, the others from the previous bar.");
    for k in 1..=joints {
        let place = |function: &str, sign: &str| {
            let bars = (1..k).map(|bar| format!("l{bar}*{function}({})", angle(bar)));
            let own = std::iter::once(format!("c{k}*{function}({})", angle(k)));
            let terms: Vec<String> = bars.chain(own).collect();
            format!(
                "{sign}{}",
                terms.join(&format!(" {} ", if sign.is_empty() { "+" } else { "-" }))
            )
        };
        lines.line(&format!("    let x{k} = {};", place("sin", "")));
        lines.line(&format!("    let y{k} = {};", place("cos", "-")));
    }
    let sum = |text: &dyn Fn(usize) -> String| -> String {
        (1..=joints)
            .map(text)
            .collect::<Vec<_>>()
            .join("\n        + ")
    };
    let kinetic = sum(&|k| {
        let rates: Vec<String> = (1..=k).map(|j| format!("dot(q{j})")).collect();
        format!(
            "m{k}/2*(dot(x{k})^2 + dot(y{k})^2) + I{k}/2*({})^2",
            rates.join(" + ")
        )
    });
    lines.told("    kinetic =", "J; dot(..) is a rate");
    lines.line(&format!("        {kinetic};"));
    let potential: Vec<String> = (1..=joints).map(|k| format!("m{k}*g*y{k}")).collect();
    lines.told(
        &format!("    potential = {};", potential.join(" + ")),
        "J; free of rates",
    );
    lines.line("    // Limits are optional; `excite` keeps them. Add `actuator_gain = 0.1 Nm/A;` if logs have currents instead of torques.");
    for k in 1..=joints {
        lines.line(&format!(
            "    limits q{k} {{ position = -90 deg .. 90 deg; velocity = 120 deg/s; acceleration = 10; torque = 50 Nm; }}"
        ));
    }
    logs(&mut lines, joints);
    effects(&mut lines, "q1");
    lines.0
}

/// `q1 + q2`
fn angle(last: usize) -> String {
    let all: Vec<String> = (1..=last).map(|k| format!("q{k}")).collect();
    all.join(" + ")
}

/// What a frame's numbers do.
const fn frame_of(convention: Convention) -> &'static str {
    match convention {
        Convention::StandardDh => {
            "frames are Rot_z(theta) Trans_z(d) Trans_x(a) Rot_x(alpha), after each joint"
        }
        Convention::ModifiedDh => {
            "frames are Trans_x(a) Rot_x(alpha) Rot_z(theta) Trans_z(d), before each joint"
        }
        Convention::Origin => "frames are placed in the previous frame, as in a URDF",
    }
}

const fn frame_keys(convention: Convention) -> &'static str {
    match convention {
        Convention::StandardDh | Convention::ModifiedDh => {
            "a, d in m, alpha in rad; a prismatic joint has theta in place of d. `offset = 90 deg;` is added to the coordinate."
        }
        Convention::Origin => {
            "xyz in m, rpy (roll, pitch, yaw) in rad place the frame; the joint moves about `axis`, in that frame."
        }
    }
}

/// An arm that turns, then lifts: upright axis, then level ones.
fn frame(convention: Convention, joint: usize) -> &'static str {
    match (convention, joint) {
        (Convention::StandardDh, 1) => "a = 0; alpha = 90 deg; d = 300 mm;",
        (Convention::ModifiedDh, 1) => "a = 0; alpha = 0; d = 300 mm;",
        (Convention::ModifiedDh, 2) => "a = 0; alpha = 90 deg; d = 0;",
        (Convention::StandardDh | Convention::ModifiedDh, _) => "a = 400 mm; alpha = 0; d = 0;",
        (Convention::Origin, 1) => "xyz = [0, 0, 0.3]; rpy = [0, 0, 0]; axis = [0, 0, 1];",
        (Convention::Origin, 2) => "xyz = [0, 0, 0.1]; rpy = [0, 0, 0]; axis = [0, 1, 0];",
        (Convention::Origin, _) => "xyz = [0.4, 0, 0]; rpy = [0, 0, 0]; axis = [0, 1, 0];",
    }
}

/// The `log` block, as a comment.
fn logs(lines: &mut Lines, joints: usize) {
    let family = |stem: &str, unit: &str| {
        let columns: Vec<String> = (1..=joints)
            .map(|k| format!("\"{stem} {k}\": {unit}"))
            .collect();
        columns.join(", ")
    };
    lines.line("");
    lines.line("    // Logs have the columns time, q1.., tau1.. in SI units, or the columns and units given here, one per joint; a file");
    lines.line("    // `robot-model.toml` beside the logs can give them too.");
    lines.line("    // log {");
    lines.line("    //     time = \"stamp\": ms;");
    lines.line(&format!("    //     q = {};", family("angle", "deg")));
    lines.line(&format!("    //     dq = {};", family("speed", "rpm")));
    lines.line(&format!("    //     tau = {};", family("torque", "Nm")));
    lines.line("    // }");
}

/// The declared effects, and all that may be declared.
fn effects(lines: &mut Lines, first: &str) {
    lines.line("");
    lines.line("    // Effects beside rigid bodies: on all joints, on some (`on a, b`), on pairs (`on (a, b)`), or on the arm as a whole.");
    lines.line(&format!("    // `stribeck(vs = 0.1) on {first};` fixes a shape parameter; without a value it is identified. Do not declare \
                         effects you only"));
    lines.line("    // suspect: `trace` looks for them in the logs.");
    lines.line("    effects {");
    lines.line("        viscous_friction on all;");
    lines.line("        coulomb_friction on all;");
    lines.line("");
    lines.line("        // There are:");
    let width = standard_effects().iter().map(|effect| effect.name.len());
    let width = width.max().unwrap_or_default();
    for effect in standard_effects() {
        let whole = format!(
            "{:width$}  {:9}  {}",
            effect.name,
            joints_of(effect),
            about(effect)
        );
        lines.line(&format!("        //   {whole}"));
    }
    lines.line("    }");
    lines.line("}");
}

/// What is behind an effect's name in a declaration.
fn joints_of(effect: &EffectDefinition) -> String {
    match effect.joints.as_slice() {
        [] => "the arm".to_owned(),
        [_] => "joints".to_owned(),
        several => {
            let mut text = String::from("(");
            for (k, joint) in several.iter().enumerate() {
                let comma = if k == 0 { "" } else { ", " };
                write!(text, "{comma}{joint}").expect("a string takes all");
            }
            text + ")"
        }
    }
}

/// The first sentence of its documentation.
fn about(effect: &EffectDefinition) -> String {
    let paragraph: Vec<&str> = effect
        .doc
        .lines()
        .map(str::trim)
        .take_while(|line| !line.is_empty())
        .collect();
    let paragraph = paragraph.join(" ");
    let end = paragraph.find(". ").unwrap_or(paragraph.len());
    paragraph[..end].trim_end_matches('.').to_owned()
}
