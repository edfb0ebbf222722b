//! Pairs of effects that look alike, and the command that designs the motion which parts them.

use robot_model_spec::model::{
    Act, Confusion, EffectDefinition, EffectLeaf, Expr, ShapeParameter, Signal,
};
use robot_model_spec::standard_effects;

/// Two effects that are taken for each other.
#[derive(Debug, Clone)]
pub struct Parting {
    /// The effect whose comment says so, and the other one.
    pub effects: [&'static EffectDefinition; 2],
    /// What it says.
    pub confusion: Confusion,
}

/// All pairs, in the order of the effects whose comments have them.
#[must_use]
pub fn partings() -> Vec<Parting> {
    let effects = standard_effects();
    let mut partings = Vec::new();
    for effect in effects {
        for confusion in effect
            .confusions()
            .expect("the language's tests read the comments of all effects")
        {
            for name in &confusion.effects {
                let other = effects.iter().find(|other| other.name == *name);
                partings.push(Parting {
                    effects: [
                        effect,
                        other.expect("the language's tests look for the name"),
                    ],
                    confusion: confusion.clone(),
                });
            }
        }
    }
    partings
}

impl Parting {
    /// The command that designs the motion which parts them, for an arm with the joints of README.md.
    ///
    /// # Errors
    /// Why no motion is designed.
    pub fn command(&self) -> Result<String, String> {
        if !self.confusion.is_parted_by_motion() {
            return Err("No motion parts them.".to_owned());
        }
        for effect in self.effects {
            if let Some(why) = not_designed(effect) {
                return Err(format!(
                    "`excite --separate` designs no motion for `{}`: {why}.",
                    effect.name
                ));
            }
        }
        let [first, second] = self.effects.map(declaration);
        Ok(format!(
            "robot-model excite arm.robot --separate '{first}' --from '{second}' --out next.csv"
        ))
    }

    /// Whether the motion depends on the values of the arm.
    #[must_use]
    pub fn needs_values(&self) -> bool {
        self.effects
            .iter()
            .any(|effect| effect.linear.is_empty() || reads(effect, &is_load))
    }
}

/// Whether some equation has such a leaf.
fn reads(effect: &EffectDefinition, wanted: &dyn Fn(&EffectLeaf) -> bool) -> bool {
    let bindings = effect.bindings.iter().map(|binding| &binding.value);
    let is_it = |part: &Expr<EffectLeaf>| matches!(part, Expr::Leaf(leaf) if wanted(leaf));
    let mut all = effect.equations().chain(bindings);
    all.any(|value| value.contains(&is_it))
}

fn is_load(leaf: &EffectLeaf) -> bool {
    matches!(leaf, EffectLeaf::Signal(Signal::RigidTorque, _))
}

/// Why `excite` designs no motion for an effect, where it does not.
fn not_designed(effect: &EffectDefinition) -> Option<&'static str> {
    let is_time = |leaf: &EffectLeaf| matches!(leaf, EffectLeaf::Time | EffectLeaf::Input(_));
    let has = |wanted: fn(&Act) -> bool| effect.acts.iter().any(wanted);
    if reads(effect, &is_time) {
        Some("it depends on more than the motion")
    } else if effect.moves_links() {
        Some("it displaces links")
    } else if has(|act| matches!(act, Act::Delay { .. })) {
        Some("it shifts torques in time")
    } else if effect.reads_measured_torque() {
        Some("it reads torques that are not measured yet")
    } else if has(|act| matches!(act, Act::Body { .. })) {
        Some("not all ten parameters of a body have columns of their own")
    } else {
        None
    }
}

/// As `--separate` takes it; without a linear parameter with a value of every shape.
fn declaration(effect: &EffectDefinition) -> String {
    let joints = match effect.joints.len() {
        0 => "",
        1 => " on elbow",
        _ => " on (shoulder, elbow)",
    };
    let value = |shape: &ShapeParameter| format!("{} = {}", shape.name, shape.high / 10.0);
    let shapes: Vec<String> = effect.shapes.iter().map(value).collect();
    if effect.linear.is_empty() {
        format!("{}({}){joints}", effect.name, shapes.join(", "))
    } else {
        format!("{}{joints}", effect.name)
    }
}
