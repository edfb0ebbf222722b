//! URDF in, spec text out; and back into the same URDF.
//!
//! The chain from a base link to a tip link becomes a robot with `convention = origin`. Fixed joints are folded: their
//! transforms into the next joint's frame, the inertials behind them into the link that carries them. Branches that leave
//! the chain are carried along the same way, with their joints held: at zero, or, where they mimic another joint, where this
//! puts them. What mimics a joint of the chain is held where that one is zero, with a warning if it has mass. On the chain itself
//! it moves freely, with a warning that says the tie. Damping and friction of a joint become declared effects.

mod back;
mod body;
mod edit;
mod effects;
mod far;
mod fault;
mod held;
mod mimic;
mod place;
mod pose;
mod rules;
mod size;
mod tree;
mod unlikely;
mod write;

use thiserror::Error;

pub use back::{WrittenBack, write_back};
pub use fault::{UrdfFault, UrdfPart, UrdfPlace};

use crate::diagnostic::Diagnostics;

/// Gravity of a URDF, which does not say it: m/s^2, the z axis of the base link upward. The spec's comment tells it.
pub const ASSUMED_GRAVITY: [f64; 3] = [0.0, 0.0, -9.81];

/// What to take from a URDF, and what to add to it.
#[derive(Debug, Clone, PartialEq)]
pub struct ImportOptions {
    /// Link that stands still; the root of the tree where it is not given.
    pub base: Option<String>,
    /// Link at the end of the chain; needed where the tree has several ends.
    pub tip: Option<String>,
    /// Effects to declare, such as `all:viscous_friction,coulomb_friction;3:motor_inertia;(5,6):gear_coupling`; joints by
    /// number from 1, by name, or `all`. Empty: none.
    pub effects: String,
    /// What to make of the inertials.
    pub inertials: Inertials,
    /// Acceleration of gravity in the base link's frame, m/s^2; where it is not given, [`ASSUMED_GRAVITY`].
    pub gravity: Option<[f64; 3]>,
}

impl Default for ImportOptions {
    fn default() -> Self {
        Self {
            base: None,
            tip: None,
            effects: String::new(),
            inertials: Inertials::Nominal,
            gravity: None,
        }
    }
}

/// What to make of a URDF's inertials.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Inertials {
    /// CAD values: to be identified.
    Nominal,
    /// Exact: kept.
    Fixed,
    /// Left out: to be identified without a first value.
    None,
}

/// Why a URDF cannot be imported.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ImportError {
    /// Not XML, or not URDF.
    #[error("the URDF does not parse: {0}")]
    Parse(UrdfFault),
    /// A name that the URDF does not have.
    #[error("the URDF has no link `{name}`; {help}")]
    UnknownLink {
        /// The name that was asked for.
        name: String,
        /// What to write instead.
        help: String,
        /// What names it; none where an argument does.
        part: Option<UrdfPart>,
    },
    /// The joints do not form one tree, or no chain leads from base to tip.
    #[error("{reason}")]
    Structure {
        /// What is wrong with it, and what to do.
        reason: String,
        /// What it is about, where that is one joint or link.
        part: Option<UrdfPart>,
    },
    /// Several chains start at the base.
    #[error("the tree branches at link `{at}`: choose the chain's end with --tip, one of {}", ends(at, *.is_hand, tips))]
    Branches {
        /// The link where chains part.
        at: String,
        /// Whether that link is a hand, as what branches off are its fingers: the arm ends there.
        is_hand: bool,
        /// Last moving links of the chains.
        tips: Vec<String>,
    },
    /// A joint on the chain that the language cannot say.
    #[error("joint `{joint}` {reason}")]
    Joint {
        /// Its name.
        joint: String,
        /// What it is, and what to do.
        reason: String,
        /// What of it.
        part: UrdfPart,
    },
    /// An inertial that the language refuses.
    #[error("link `{link}` has {reason}")]
    Inertial {
        /// Its name.
        link: String,
        /// What it has, and what to do.
        reason: String,
        /// What of it.
        part: UrdfPart,
    },
    /// A number that is not one.
    #[error("{what} is not finite: write a number")]
    NotFinite {
        /// Which number.
        what: String,
        /// Where it stands; none where that is an argument.
        part: Option<UrdfPart>,
    },
    /// The list of effects is at fault.
    #[error("--effects: {0}")]
    Effects(String),
    /// The spec that comes out breaks a rule of the language.
    #[error("the spec that it would become is refused, in lines that are not written:\n{0}")]
    Refused(Diagnostics),
}

impl ImportError {
    /// Where in its text a URDF is at fault; none where the text as a whole is, or an argument.
    #[must_use]
    pub fn place(&self, urdf: &str) -> Option<UrdfPlace> {
        let part = match self {
            Self::Parse(fault) => return fault.place.clone(),
            Self::UnknownLink { part, .. }
            | Self::Structure { part, .. }
            | Self::NotFinite { part, .. } => part.as_ref()?,
            Self::Joint { part, .. } | Self::Inertial { part, .. } => part,
            Self::Branches { .. } | Self::Effects(_) | Self::Refused(_) => return None,
        };
        UrdfPlace::of_part(urdf, part)
    }

    fn structure(reason: String) -> Self {
        Self::Structure { reason, part: None }
    }
}

/// The links that a chain can end at, the likeliest first.
fn ends(at: &str, is_hand: bool, tips: &[String]) -> String {
    let hand = is_hand.then(|| format!("`{at}` (the arm without what moves on it)"));
    let tips = tips.iter().map(|tip| format!("`{tip}`"));
    let ends: Vec<String> = hand.into_iter().chain(tips).collect();
    ends.join(", ")
}

/// A URDF as a spec.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct Imported {
    /// The text of the spec, which is sure to [`load`](crate::load).
    pub spec: String,
    /// What the URDF says and the spec cannot; its comments say it too.
    pub warnings: Vec<String>,
}

/// Turns a URDF into a spec.
///
/// # Errors
/// [`ImportError`], with what to change in the URDF or in the options.
pub fn import(urdf: &str, options: &ImportOptions) -> Result<Imported, ImportError> {
    if !options.gravity.iter().flatten().all(|g| g.is_finite()) {
        return Err(ImportError::NotFinite {
            what: "--gravity".to_owned(),
            part: None,
        });
    }
    size::check(urdf)?;
    place::check_elements(urdf)?;
    let robot = urdf_rs::read_from_string(urdf)
        .map_err(|error| ImportError::Parse(place::explain(urdf, &error.to_string())))?;
    let tree = tree::Tree::new(&robot)?;
    let chain = tree.chain(options.base.as_deref(), options.tip.as_deref())?;
    let carried = chain
        .joints
        .iter()
        .map(|joint| body::carried(&tree, &chain, joint, options.inertials))
        .collect::<Result<Vec<_>, _>>()?;
    let names = write::Names::new(&chain);
    let effects = effects::declarations(&options.effects, &chain, &names)?;
    let mut warnings = mimic::warnings(&tree, &chain, &names)?;
    warnings.extend(held::warnings(&tree, &carried));
    warnings.extend(effects::left_out(&chain));
    warnings.extend(write::without_range(&chain));
    if options.inertials != Inertials::None {
        warnings.extend(body::massless(&names.links, &carried));
        warnings.extend(body::impossible(&names.links, &carried));
    }
    warnings.extend(unlikely::warnings(&robot, options.gravity));
    warnings.extend(names.renamed(&chain));
    let gravity = options.gravity.is_none().then(write::assumed_gravity);
    let notes = [
        gravity.into_iter().collect(),
        pose::notes(&robot),
        warnings.clone(),
    ]
    .concat();
    let written = |effects: &[String]| {
        write::spec(
            &robot.name,
            &chain,
            &names,
            &carried,
            effects,
            &notes,
            options,
        )
    };
    let spec = written(&effects);
    let Err(refused) = crate::load("imported.robot", &spec) else {
        return Ok(Imported { spec, warnings });
    };
    // Where the spec is sound without the effects, the mistake is in the argument, and the author has not seen the text.
    let bare = written(&[]);
    Err(match crate::load("imported.robot", &bare) {
        Ok(_) => {
            let mistakes: Vec<String> = refused.messages_with_help().collect();
            ImportError::Effects(mistakes.join("; "))
        }
        Err(_) => far::number(&robot).unwrap_or(ImportError::Refused(refused)),
    })
}
