//! What is said of back-EMF: notes, and what is printed.

use robot_model::calibrate::{Commanded, Measured, MotorVoltage};

use super::super::words::measured;
use crate::output::{self, counted, significant};

/// From a share for a second to percent for a millisecond.
const PERCENT_OF_MS: f64 = 0.1;

/// Correlation of current and velocity from which on they are called hardly apart.
const ALIKE: f64 = 0.98;

/// Percent that noise of the velocity may hide before it is noted.
const ATTENUATED: f64 = 2.0;

/// Pieces that are printed.
const SHOWN: usize = 12;

pub(super) fn note_voltage(found: &MotorVoltage) {
    if found.alike.abs() > ALIKE {
        output::say(&format!(
            "note: current and velocity are correlated (r = {:.4}), so resistance and back-EMF are hardly separable; let the motor speed up \
             and slow down",
            found.alike
        ));
    }
    if let Some([resistance, back_emf, _]) = found.least_squares {
        output::say(&format!(
            "note: noise of current or velocity biases least squares ({} ohm and {} V s/rad); these values are by instrumental variables, \
             with neighboring samples as instruments",
            significant(resistance, 4),
            significant(back_emf, 4)
        ));
    }
    for (what, value) in [
        ("resistance", found.resistance),
        ("back-EMF", found.back_emf),
    ] {
        if value.interval[1] < 0.0 {
            output::say(&format!(
                "note: the {what} is negative: current, velocity and voltage must be positive in the same direction"
            ));
        }
    }
}

pub(super) fn note_commanded(found: &Commanded) {
    if found.back_emf.interval[1] < 0.0 {
        output::say(
            "note: the back-EMF is negative: current and velocity must be positive in the same direction",
        );
    }
    if found.attenuation > ATTENUATED {
        output::say(&format!(
            "note: velocity noise may bias the back-EMF low, by at most {:.1} %; log with higher resolution, or longer",
            found.attenuation
        ));
    }
}

pub(super) fn voltage_summary(found: &MotorVoltage) -> String {
    let inductance = found.by_time_constant.map_or_else(String::new, |[resistance, back_emf]| {
        format!(
            "inductance  {:+.2} % of the resistance and {:+.2} % of the back-EMF for each ms of L/R beyond `--time-constant`\n",
            PERCENT_OF_MS * resistance,
            PERCENT_OF_MS * back_emf
        )
    });
    let line =
        |name: &str, value: &Measured, unit: &str| format!("{name:<12}{}\n", measured(value, unit));
    format!(
        "{}{}{}residual    {} V, {}\n{inductance}",
        line("resistance", &found.resistance, "ohm"),
        line("back-EMF", &found.back_emf, "V s/rad"),
        line("offset", &found.offset, "V"),
        significant(found.residual_std, 3),
        counted(found.samples, "sample"),
    )
}

pub(super) fn commanded_summary(found: &Commanded) -> String {
    let shown = found.pieces.iter().take(SHOWN);
    let mut levels: Vec<String> = shown
        .map(|piece| format!("{} from {:.3} s", significant(piece.level, 4), piece.start))
        .collect();
    if found.pieces.len() > SHOWN {
        levels.push(format!("and {} more", found.pieces.len() - SHOWN));
    }
    format!(
        "back-EMF    {}\n\
         voltage     {} over {:.1} % of the samples, which explain {:.2} % of it; {:.1} % of its change is in jumps\n\
         residual    {} in units of u; noise of the velocity makes the back-EMF smaller by {:.2} % at most\n\
         inductance  {:+.2} % of the back-EMF for each ms of L/R beyond `--time-constant`\n\
         levels      {}\n",
        measured(&found.back_emf, "units of u per rad/s"),
        counted(found.pieces.len(), "constant"),
        found.held,
        found.explained,
        found.by_jumps,
        significant(found.residual_std, 3),
        found.attenuation,
        PERCENT_OF_MS * found.by_time_constant,
        levels.join(", "),
    )
}
