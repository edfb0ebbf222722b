//! Arms out, for programs that read other descriptions: URDF and MJCF.
//!
//! In: a chain, and [`Numbers`] for its links and joints. Out: text. Both formats have a tree of bodies that are placed by a fixed
//! transform and move about or along an axis, so frames of every convention are turned into these once, in `frames.rs`.
//!
//! What the formats are: <https://wiki.ros.org/urdf/XML>, <https://mujoco.readthedocs.io/en/stable/XMLreference.html>.

mod frames;
mod mjcf;
mod urdf;
mod xml;

use thiserror::Error;

use crate::model::{Chain, Model};
use crate::urdf::UrdfFault;

pub use mjcf::mjcf;
pub use urdf::{NO_LIMIT, NO_RANGE, made_up_limits, urdf};

pub(crate) use frames::Body;
pub(crate) use xml::{comment, inertial_lines, number};

/// What is known of an arm, in numbers.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Numbers {
    /// Links from the base to the tip, one a joint.
    pub links: Vec<LinkNumbers>,
    /// Joints in order.
    pub joints: Vec<JointNumbers>,
    /// Sentences about the whole, for a comment.
    pub notes: Vec<String>,
}

/// A link's body.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct LinkNumbers {
    /// `m mx my mz ixx ixy ixz iyy iyz izz` about the origin of the link's frame, in SI units.
    pub inertial: [f64; 10],
    /// A sentence about where these are from, for a comment; may be empty.
    pub remark: String,
}

/// What acts on a joint by itself. `None` is what nobody said.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct JointNumbers {
    /// Torque per speed, N m s/rad or N s/m.
    pub damping: Option<f64>,
    /// Dry friction, N m or N.
    pub friction: Option<f64>,
    /// Inertia of the rotor, seen at the joint, kg m^2 or kg.
    pub armature: Option<f64>,
    /// A spring between the joint's links.
    pub spring: Option<Spring>,
}

/// `stiffness * (q - rest)`: what the motor has to hold.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spring {
    /// N m/rad or N/m.
    pub stiffness: f64,
    /// rad or m.
    pub rest: f64,
}

/// Why an arm cannot be written.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum ExportError {
    /// It has no links.
    #[error(
        "`{0}` is defined by its energies, but other formats need links and joints: describe it as a chain"
    )]
    NoChain(String),
    /// The original is no URDF.
    #[error("the URDF does not parse: {0}")]
    Parse(UrdfFault),
    /// The original is of another arm.
    #[error(
        "the URDF has no chain of the joints {}; give the URDF that the spec was imported from, or remove `--urdf`",
        crate::suggest::list(.0.iter().map(String::as_str))
    )]
    OtherJoints(Vec<String>),
    /// The original has its frames elsewhere.
    #[error(
        "joint `{joint}` {differs} in the URDF, so the inertials of the spec are in other frames; give the URDF that the spec was imported \
         from, or remove `--urdf`"
    )]
    OtherFrames {
        /// The joint.
        joint: String,
        /// What differs.
        differs: &'static str,
    },
    /// The original has something that is not read.
    #[error("{0}")]
    Original(String),
}

/// The chain of a robot.
pub(crate) fn chain(model: &Model) -> Result<&Chain, ExportError> {
    model
        .chain()
        .ok_or_else(|| ExportError::NoChain(model.name.clone()))
}
