//! What is wrong in the paper, each by a check of the tool's, as printed and repaired.

use robot_model::friction_curve::{Bristles, Curve, Law};
use robot_model::log::Log;
use robot_model_cli::audit::Check;

use super::experiments::{self, Found, SENSORS, Sensors};
use super::plant::{Friction, PRINTED};
use super::{nearest, rig, tool, truth};
use crate::paper::{Error, refused};

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
    let [printed, repaired] = equation.map(|(name, text)| refused(name, text));
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

/// By how many times `s1` is above `s2 F_c / (F_s - F_c)`, beyond which bristles give energy.
#[must_use]
pub fn excess_of_damping(friction: &Friction) -> f64 {
    friction.damping * (friction.breakaway - friction.coulomb) / friction.coulomb / friction.viscous
}

/// The friction with damping that falls short of giving energy.
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
pub fn differences(found: &Found) -> Result<Finding, Error> {
    let rise = found.rise.log("rise", rig::FINE_BITS, 31)?;
    let fine = Sensors {
        bits: rig::FINE_BITS,
        ..SENSORS
    };
    let (fine, fine_law) = experiments::settled(&found.runs, &rise, fine)?;
    let said = |curve: &Curve, law: &Law| {
        (!law.is_told_by_differences(curve)).then(|| {
            format!("`friction`: one step of the encoder from sample to sample is {:.3} rad/s, above the Stribeck speed", curve.speed_step)
        })
    };
    Ok(Finding {
        printed: said(&found.curve, &found.law),
        repaired: said(&fine, &fine_law),
    })
}

/// Whether the step that `friction` finds in logs of the encoder is one that it is said to have; repaired is that of its bits.
#[must_use]
pub fn encoder(curve: &Curve) -> Finding {
    let step = (curve.speed_step / truth::LOOP_HZ).to_degrees();
    let said = |claimed: f64| {
        ((step / claimed - 1.0).abs() > SAME_STEP)
            .then(|| format!("`friction` finds steps of {step:.4} degrees"))
    };
    Finding {
        printed: said(truth::PRINTED_STEP_DEG),
        repaired: said(360.0 / 2_f64.powi(truth::BITS)),
    }
}

/// Steps are the same within this share.
const SAME_STEP: f64 = 1e-3;

/// A motion of the rod: rad, rad/s, and how long, s.
const SWING: [f64; 2] = [1.0, 9.0];
const SWING_S: f64 = 6.0;

/// More than that is no rounding of the filters, %.
const ROD_MISFIT: f64 = 1.0;

/// Whether the rod's torque is that of equation (7) with its share of `m l^2`: what `identify` leaves of the torque of a uniform rod without
/// friction, as printed and with a third.
///
/// # Errors
/// Those of the libraries.
pub fn third() -> Result<Finding, Error> {
    let (inertia, weight) = (
        truth::MASS * truth::LENGTH.powi(2) / 3.0,
        truth::MASS * truth::GRAVITY * truth::LENGTH / 2.0,
    );
    let [size, rate] = SWING;
    let time: Vec<f64> = (0..nearest(SWING_S * truth::LOOP_HZ))
        .map(|k| k as f64 / truth::LOOP_HZ)
        .collect();
    let q: Vec<f64> = time.iter().map(|t| size * (rate * t).sin()).collect();
    // The angle of the equation is that from the level.
    let torque = q
        .iter()
        .map(|q| -rate * rate * inertia * q + weight * q.cos());
    let torque = torque.collect();
    let log = Log::from_samples("rod", time, vec![q], vec![torque])?;
    let [_, (name, repaired)] = EQUATION_7;
    let printed = repaired.replace("l^2/3", &format!("{}*l^2", truth::PRINTED_THIRD));
    let said = |text: &str| -> Result<Option<String>, Error> {
        let (_, misfit) = tool::least_squares(name, text, ["m", "m"], &log)?;
        Ok((misfit > ROD_MISFIT)
            .then(|| format!("`identify` leaves {misfit:.1} % of a uniform rod's torque")))
    };
    Ok(Finding {
        printed: said(&printed)?,
        repaired: said(repaired)?,
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
