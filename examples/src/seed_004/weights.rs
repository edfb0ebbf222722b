//! Section 4.2: counterweights, by the equations and by a device that carries them.

use robot_model::control::ControlError;
use robot_model::control::counterbalance::{Weight, lever, mass, moment};

use super::device::{by_name, compiled, without_friction};
use super::truth::{GRAVITY, LINKS, TABLE_1_UR_GRAVITY, WEIGHTS, table_1};
use crate::paper::{Audited, Error};

/// Section 4.2 with one lever of the counterweights.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Balance {
    /// `pi7'` and `pi8'` of (16) and (17), N m.
    pub moments: [f64; 2],
    /// Masses of (18) and (19), kg.
    pub masses: [f64; 2],
}

/// Equations (16) to (19).
///
/// # Errors
/// A lever that is not positive.
pub fn balance(lever: f64) -> Result<Balance, ControlError> {
    let tool = |lever| Weight {
        mass: WEIGHTS.tool,
        lever,
    };
    let upper = Weight {
        mass: WEIGHTS.upper,
        lever: -lever,
    };
    let [pi7, pi8] = TABLE_1_UR_GRAVITY;
    let loaded = [
        moment(pi7, GRAVITY, &[tool(LINKS[0])]),
        moment(pi8, GRAVITY, &[tool(WEIGHTS.tool_lever)]),
    ];
    Ok(Balance {
        moments: [moment(pi7, GRAVITY, &[tool(LINKS[0]), upper]), loaded[1]],
        masses: [
            mass(loaded[0], GRAVITY, lever)?,
            mass(loaded[1], GRAVITY, lever)?,
        ],
    })
}

/// The levers by which the manufacturer's weight makes the printed `pi7'`, and by which the second mass is the one that is recommended, m.
///
/// # Errors
/// A moment on the other side of the axis.
pub fn levers_of_print() -> Result<[f64; 2], ControlError> {
    let loaded = |k: usize, arm: f64| {
        let tool = Weight {
            mass: WEIGHTS.tool,
            lever: arm,
        };
        moment(TABLE_1_UR_GRAVITY[k], GRAVITY, &[tool])
    };
    let [upper, fore] = [loaded(0, LINKS[0]), loaded(1, WEIGHTS.tool_lever)];
    Ok([
        lever(upper - WEIGHTS.moments[0], GRAVITY, WEIGHTS.upper)?,
        lever(fore, GRAVITY, WEIGHTS.recommended[1])?,
    ])
}

/// Half of the last digit of a mass, kg, and of a lever, m, as they are printed.
const HALF_A_DIGIT: [f64; 2] = [5e-4, 5e-4];

/// Torque that rounding of a mass and of its lever leaves on a joint that is balanced, N m.
#[must_use]
pub fn rounding(mass: f64, lever: f64) -> f64 {
    GRAVITY * (HALF_A_DIGIT[0] * lever + mass * HALF_A_DIGIT[1])
}

/// UR with the gimbal and the recommended counterweights on a lever, on motors that give what rounding leaves and no more: what `audit`
/// says of it. Without friction, which would hold a device that is not balanced.
///
/// # Errors
/// Those of the text.
pub fn carried(lever: f64) -> Result<Audited, Error> {
    let [second, third] = WEIGHTS.recommended;
    let energies = "    kinetic =";
    let constants = format!(
        "    constants g = {GRAVITY} m/s^2, tool = {} kg, second = {second} kg, third = {third} kg;
    constants L_tool = {} m, L_weight = {lever} m;
{energies}",
        WEIGHTS.tool, WEIGHTS.tool_lever
    );
    let potential = "potential = pi7*sin(theta2) - pi8*cos(theta3)";
    let weights = format!(
        "{potential}
        + g*tool*(L1*sin(theta2) - L_tool*cos(theta3)) - g*L_weight*(second*sin(theta2) - third*cos(theta3))"
    );
    let mut text = without_friction()
        .replace(energies, &constants)
        .replace(potential, &weights);
    for (joint, mass) in [("theta2", second), ("theta3", third)] {
        let limits = format!("limits {joint} {{");
        let motor = format!("{limits} torque = {} Nm;", rounding(mass, lever));
        text = text.replace(&limits, &motor);
    }
    let own = by_name(&table_1(0)).into_iter();
    let rigid = own.filter(|(name, _)| !name.contains("friction"));
    Audited::of(&compiled(&text)?, &rigid.collect())
}

/// What joints 2 and 3 take to stand where `audit` finds it too much, N m.
#[must_use]
pub fn at_rest(audited: &Audited) -> [Option<f64>; 2] {
    let drives = audited.check("drives");
    ["theta2", "theta3"].map(|joint| drives?.quantity("at_rest", Some(joint)))
}
