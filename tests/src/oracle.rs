//! Pinocchio's numbers for three arms, and those arms as spec text from the same placements.

use std::fmt::Write;
use std::fs;

use nalgebra::DMatrix;
use serde::Deserialize;

use crate::shared;
use crate::states::State;

/// Places of the ten inertial parameters in Pinocchio's order (`m mx my mz ixx ixy iyy ixz iyz izz`), in ours.
const PINOCCHIO: [usize; 10] = [0, 1, 2, 3, 4, 5, 7, 6, 8, 9];

/// One arm's reference numbers.
#[derive(Debug, Clone, Deserialize)]
pub struct Oracle {
    /// Name of the arm.
    pub robot: String,
    gravity: [f64; 3],
    joints: Vec<OracleJoint>,
    pi: Vec<f64>,
    pi_dh: Option<Vec<f64>>,
    states: Vec<OracleState>,
    /// Number of base parameters of the rigid body.
    pub base_parameter_count: usize,
}

#[derive(Debug, Clone, Deserialize)]
struct OracleJoint {
    name: String,
    axis: [f64; 3],
    #[serde(rename = "R")]
    rotation: [[f64; 3]; 3],
    p: [f64; 3],
}

#[derive(Debug, Clone, Deserialize)]
struct OracleState {
    q: Vec<f64>,
    dq: Vec<f64>,
    ddq: Vec<f64>,
    tau: Vec<f64>,
    g: Vec<f64>,
    #[serde(rename = "M")]
    mass_matrix: Vec<Vec<f64>>,
    #[serde(rename = "C")]
    coriolis_matrix: Vec<Vec<f64>>,
    #[serde(rename = "Y")]
    regressor: Vec<Vec<f64>>,
    #[serde(rename = "Y_dh")]
    regressor_dh: Option<Vec<Vec<f64>>>,
}

/// Reference numbers at one state; parameters in our order.
#[derive(Debug, Clone)]
pub struct Reference {
    /// Where the arm is and how it moves.
    pub state: State,
    /// `M`
    pub mass_matrix: DMatrix<f64>,
    /// `C dq`; `C` itself is not unique.
    pub velocity_torque: DMatrix<f64>,
    /// `G`
    pub gravity: DMatrix<f64>,
    /// `M ddq + C dq + G`
    pub torque: DMatrix<f64>,
    /// `Y`
    pub regressor: DMatrix<f64>,
}

/// In which frames the ten parameters of a link are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Frames {
    /// The frame that moves with the joint, as in URDF.
    Joint,
    /// The standard DH frame of the link.
    StandardDh,
}

impl Oracle {
    /// Reads an arm's numbers, where they are there.
    #[must_use]
    pub fn read(robot: &str) -> Option<Self> {
        let path = shared::find(
            &format!("oracle/{robot}.json"),
            &format!("{robot} against Pinocchio"),
        )?;
        let text = fs::read_to_string(path).expect("the oracle is readable");
        Some(serde_json::from_str(&text).expect("the oracle is in its format"))
    }

    /// The inertial parameters in our order.
    #[must_use]
    pub fn standard(&self, frames: Frames) -> Vec<f64> {
        let pi = match frames {
            Frames::Joint => &self.pi,
            Frames::StandardDh => self.pi_dh.as_ref().expect("this arm has DH numbers"),
        };
        (0..pi.len()).map(|k| pi[ours(k)]).collect()
    }

    /// Numbers of all states.
    pub fn references(&self, frames: Frames) -> impl Iterator<Item = Reference> {
        self.states.iter().map(move |state| {
            let dq = column(&state.dq);
            let regressor = match frames {
                Frames::Joint => &state.regressor,
                Frames::StandardDh => state
                    .regressor_dh
                    .as_ref()
                    .expect("this arm has DH numbers"),
            };
            let regressor = matrix(regressor);
            Reference {
                mass_matrix: matrix(&state.mass_matrix),
                velocity_torque: matrix(&state.coriolis_matrix) * dq,
                gravity: column(&state.g),
                torque: column(&state.tau),
                regressor: DMatrix::from_fn(regressor.nrows(), regressor.ncols(), |i, k| {
                    regressor[(i, ours(k))]
                }),
                state: State {
                    q: state.q.clone(),
                    dq: state.dq.clone(),
                    ddq: state.ddq.clone(),
                    ..State::default()
                },
            }
        })
    }

    /// The arm as a spec with `convention = origin`. Angles are written with `digits` decimals, as URDF files round them.
    #[must_use]
    pub fn spec(&self, digits: usize) -> String {
        let vector = |v: [f64; 3]| format!("[{:?}, {:?}, {:?}]", v[0], v[1], v[2]);
        let mut text = format!(
            "robot Oracle {{\n    gravity = {};\n    convention = origin;\n",
            vector(self.gravity)
        );
        for joint in &self.joints {
            let [roll, pitch, yaw] = roll_pitch_yaw(&joint.rotation);
            writeln!(
                text,
                "    joint {}: revolute {{ xyz = {}; rpy = [{roll:.digits$}, {pitch:.digits$}, {yaw:.digits$}]; axis = {}; }}",
                joint.name,
                vector(joint.p),
                vector(joint.axis),
            )
            .expect("text takes any length");
        }
        text.push_str("}\n");
        text
    }
}

/// Where our parameter `k` stands in Pinocchio's list.
fn ours(k: usize) -> usize {
    10 * (k / 10) + PINOCCHIO[k % 10]
}

fn column(values: &[f64]) -> DMatrix<f64> {
    DMatrix::from_column_slice(values.len(), 1, values)
}

fn matrix(rows: &[Vec<f64>]) -> DMatrix<f64> {
    DMatrix::from_row_slice(rows.len(), rows[0].len(), &rows.concat())
}

/// Angles of `Rz(yaw) Ry(pitch) Rx(roll)`. At a pitch of a quarter turn only yaw - roll or yaw + roll counts; yaw is 0.
fn roll_pitch_yaw(r: &[[f64; 3]; 3]) -> [f64; 3] {
    let level = r[0][0].hypot(r[1][0]);
    let pitch = f64::atan2(-r[2][0], level);
    if level < 1e-9 {
        [f64::atan2(-r[1][2], r[1][1]), pitch, 0.0]
    } else {
        [
            f64::atan2(r[2][1], r[2][2]),
            pitch,
            f64::atan2(r[1][0], r[0][0]),
        ]
    }
}
