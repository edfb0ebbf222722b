//! What is wrong in the paper, each by a check of the tool's, as printed and repaired.

use robot_model::friction_curve::{Bristles, Curve, Law};
use robot_model::log::Log;
use robot_model_cli::audit::Check;

use super::plant::{Friction, PRINTED};
use super::{experiments, rig, tool, truth};
use crate::paper::Error;

/// What a check says of the paper as printed and repaired: nothing where it passes.
#[derive(Debug, Clone, PartialEq)]
pub struct Finding {
    /// Of what is printed.
    pub printed: Option<String>,
    /// Of what is meant.
    pub repaired: Option<String>,
}

impl Finding {
    /// Whether it is found, and goes away where it is mended.
    #[must_use]
    pub fn is_told(&self) -> bool {
        self.printed.is_some() && self.repaired.is_none()
    }

    /// In words.
    #[must_use]
    pub fn text(&self) -> String {
        self.printed.clone().unwrap_or_else(|| "nothing".to_owned())
    }
}

/// An equation in a spec, as printed and repaired.
macro_rules! equation {
    ($number:literal) => {
        [
            (
                concat!("equation_", $number, "_printed.robot"),
                include_str!(concat!("equation_", $number, "_printed.robot")),
            ),
            (
                concat!("equation_", $number, "_repaired.robot"),
                include_str!(concat!("equation_", $number, "_repaired.robot")),
            ),
        ]
    };
}

/// Equation (7), as printed and repaired.
pub const EQUATION_7: [(&str, &str); 2] = equation!("7");
/// Equation (8) with the printed unit of the stiffness, and with its own.
pub const EQUATION_8: [(&str, &str); 2] = equation!("8");
/// Equations (17) and (18).
pub const EQUATION_17: [(&str, &str); 2] = equation!("17");
/// Equation (22).
pub const EQUATION_22: [(&str, &str); 2] = equation!("22");

/// What the check of dimensions says of an equation.
#[must_use]
pub fn dimensions(equation: [(&str, &str); 2]) -> Finding {
    let said = |(name, text): (&str, &str)| {
        let errors = robot_model_spec::load(name, text).err()?;
        let messages: Vec<&str> = errors.messages().collect();
        let rendered = errors.render(false);
        let labels = rendered
            .lines()
            .filter_map(|line| line.split("this is ").nth(1));
        let labels: Vec<&str> = labels.collect();
        Some(format!("{}: {}", messages.join("; "), labels.join(" and ")))
    };
    let [printed, repaired] = equation.map(said);
    Finding { printed, repaired }
}

/// A torque of the rise that the deflection of (17) leaves unexplained beyond this is more than the noise of its currents, %.
const MISFIT: f64 = 5.0;

/// What least squares makes of (17) and (18) on the torque that rises: a stiffness, and what it leaves.
///
/// # Errors
/// Those of the libraries.
pub fn deflection(log: &Log) -> Result<(Finding, [f64; 2]), Error> {
    let mut stiffness = [0.0; 2];
    let mut said = [None, None];
    for (k, (name, text)) in EQUATION_17.into_iter().enumerate() {
        let ([found, _], misfit) = tool::least_squares(name, text, ["s0", "s0"], log)?;
        stiffness[k] = found.value;
        said[k] = (misfit > MISFIT).then(|| {
            format!(
                "`identify` finds s0 = {:.3} N m/rad, and the torque off by {misfit:.0} %",
                found.value
            )
        });
    }
    let [printed, repaired] = said;
    Ok((Finding { printed, repaired }, stiffness))
}

/// The friction with damping that falls short of giving energy: `s2 F_c / (F_s - F_c)` is 0.0547.
pub const PASSIVE: Friction = Friction {
    damping: 0.05,
    ..PRINTED
};

/// The friction with torques in kgf cm, as the motor's largest one is printed.
#[must_use]
pub fn in_kgf_cm() -> Friction {
    let kgf_cm = |torque: f64| torque * truth::KGF_CM;
    Friction {
        coulomb: kgf_cm(PRINTED.coulomb),
        breakaway: kgf_cm(PRINTED.breakaway),
        viscous: kgf_cm(PRINTED.viscous),
        stribeck: PRINTED.stribeck,
        stiffness: kgf_cm(PRINTED.stiffness),
        damping: kgf_cm(PRINTED.damping),
    }
}

/// Bristles that bend by the printed resolution where they break away.
#[must_use]
pub fn stiff() -> Friction {
    Friction {
        stiffness: (truth::BREAKAWAY / truth::RESOLUTION).round(),
        ..PRINTED
    }
}

/// What one of `audit`'s checks says of the checks of what is printed and of what is meant.
#[must_use]
pub fn check(name: &str, printed: &[Check], repaired: &[Check]) -> Finding {
    let said = |checks: &[Check]| {
        let failed = |check: &&Check| check.name == name && check.passed == Some(false);
        let failed = checks.iter().find(failed)?;
        Some(failed.findings.join("; "))
    };
    Finding {
        printed: said(printed),
        repaired: said(repaired),
    }
}

/// Whether surfaces in contact give as far as the bristles do.
///
/// # Errors
/// Those of the libraries.
pub fn softness(curve: &Curve, law: &Law, printed: &Bristles) -> Result<Finding, Error> {
    let run = experiments::rise(stiff(), 10.0 * experiments::RISE, 20);
    let repaired = tool::bristles(curve, law, &run.log("rise", rig::FINE_BITS, 41)?)?;
    let said = |bristles: &Bristles| {
        let (rad, stiffness) = (bristles.deflection.value, bristles.stiffness.value);
        let degrees = rad.to_degrees();
        (!bristles.is_of_contact())
            .then(|| format!("`friction`: {stiffness:.3} N m/rad slide after {rad:.3} rad ({degrees:.1} deg), further than surfaces in contact"))
    };
    Ok(Finding {
        printed: said(printed),
        repaired: said(&repaired),
    })
}

/// Whether differences of the encoder's positions tell the Stribeck speed; repaired is the fine encoder.
///
/// # Errors
/// Those of the libraries.
pub fn differences(curve: &Curve, law: &Law) -> Result<Finding, Error> {
    let logs = experiments::constant_speeds(
        PRINTED,
        experiments::Way::Free,
        rig::Loop::Stiff,
        rig::FINE_BITS,
    )?;
    let (fine, fine_law) = tool::curve(&logs, false)?;
    let said = |curve: &Curve, law: &Law| {
        (!law.is_told_by_differences(curve)).then(|| {
            format!("`friction`: one step of the encoder from sample to sample is {:.3} rad/s, above the Stribeck speed", curve.speed_step)
        })
    };
    Ok(Finding {
        printed: said(curve, law),
        repaired: said(&fine, &fine_law),
    })
}

/// Largest of the static four's distances from a friction's, as a share; infinite where no fall is told.
#[must_use]
pub fn off(law: &Law, friction: &Friction) -> f64 {
    let Some(fall) = law.fall else {
        return f64::INFINITY;
    };
    let pairs = [
        (law.coulomb.value, friction.coulomb),
        (law.breakaway.value, friction.breakaway),
        (law.viscous.value, friction.viscous),
        (fall.speed.value, friction.stribeck),
    ];
    pairs.iter().fold(0.0, |most: f64, (found, truth)| {
        most.max((found / truth - 1.0).abs())
    })
}
