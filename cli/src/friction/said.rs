//! What is printed of a joint's friction, and what is to be known of it.

use std::fmt::Write;

use robot_model::friction_curve::{Bristles, Fall, Value};
use robot_model::identify::table_value;

use super::report::{Found, Parameter};
use crate::output::counted;
use crate::units::Units;

/// Stribeck's fall is over at so many times its speed.
const FALLEN: f64 = 3.0;

/// Deviations that count as nothing.
const NOTHING: f64 = 2.0;

/// Points that are off the law by so many of their deviations are of another one.
const MISFIT: f64 = 3.0;

impl Found<'_> {
    fn units(&self) -> Units {
        Units::of(self.joint.kind)
    }

    /// What is to be known of the numbers before they are used.
    pub(super) fn doubts(&self) -> Vec<String> {
        let (law, curve, units) = (self.law, self.curve, self.units());
        let speeds = curve.points.iter().map(|point| point.speed.abs());
        let (least, most) = speeds.fold((f64::INFINITY, 0.0_f64), |(least, most), v| {
            (least.min(v), most.max(v))
        });
        let mut doubts = Vec::new();
        if let Some(Fall { speed, .. }) = law.fall {
            if least > speed.value {
                doubts.push(format!(
                    "no measured speed is below the Stribeck speed of {:.4} {unit}: the breakaway torque is extrapolated from {least:.4} {unit}",
                    speed.value,
                    unit = units.velocity
                ));
            }
            if most < FALLEN * speed.value {
                doubts.push(format!(
                    "no measured speed is above {:.4} {}, where the Stribeck effect ends: Coulomb and viscous friction are extrapolated",
                    FALLEN * speed.value,
                    units.velocity
                ));
            }
        }
        if !law.is_told_by_differences(curve) {
            doubts.push(format!(
                "one encoder step per sample is {:.4} {}, above the Stribeck speed: velocities from differences of samples do not resolve \
                 the Stribeck effect, the slopes of the stretches do",
                curve.speed_step, units.velocity
            ));
        }
        if law.coulomb.value < -NOTHING * law.coulomb.std {
            doubts.push(
                "the Coulomb torque is negative: does the torque have the sign of the spec's joint?"
                    .to_owned(),
            );
        }
        if law.viscous.value < -NOTHING * law.viscous.std {
            doubts.push(
                "viscous friction is negative: speeds do not reach the end of the Stribeck effect, or a torque other than friction acts"
                    .to_owned(),
            );
        }
        if law.misfit > MISFIT {
            doubts.push(format!(
                "points deviate from the law by {:.1} of their standard deviations: friction has another shape, for example it depends on \
                 direction, position or temperature, and the law is only its mean",
                law.misfit
            ));
        }
        if let Some(late) = curve.late {
            doubts.push(format!(
                "torques come {:.1} +- {:.1} ms {} the positions, judged by position-dependent torque; the curve is corrected for that",
                1e3 * late.value.abs(),
                1e3 * late.std,
                if late.value > 0.0 { "behind" } else { "ahead of" }
            ));
        }
        let is_one_way = law.offset.is_none();
        if is_one_way {
            doubts.push(
                "one direction only: a torque offset is included in the Coulomb torque".to_owned(),
            );
        }
        if curve.has_constant {
            doubts.push(
                "a constant torque of the rigid body is included in the points and in the offset"
                    .to_owned(),
            );
        }
        if let Some(bristles) = self.bristles {
            doubts.extend(self.doubts_of(bristles, &units));
        }
        doubts
    }

    fn doubts_of(&self, bristles: &Bristles, units: &Units) -> Vec<String> {
        let breakaway = self.law.breakaway;
        let mut doubts = Vec::new();
        if !bristles.is_resolved() {
            doubts.push(format!(
                "the encoder's step of {:.3e} {position} is above a fifth of the deflection of {:.3e} {position} at which the bristles \
                 slide: it resolves stiffnesses below {:.4} {}/{position}",
                bristles.encoder_step,
                bristles.deflection.value,
                bristles.most_stiffness(),
                units.torque,
                position = units.position
            ));
        }
        if !bristles.is_of_contact() {
            doubts.push(format!(
                "the bristles deflect by {:.4} {position} before they slide, more than contact surfaces do: the cause is a spring, \
                 backlash, or a torque in another unit",
                bristles.deflection.value,
                position = units.position
            ));
        }
        if bristles.damping.is_none() {
            doubts.push(
                "such a slow rise does not determine the damping of the bristles; `identify --method output-error` with `lugre_presliding` does"
                    .to_owned(),
            );
        }
        if (bristles.reached / breakaway.value - 1.0).abs() > 0.1 {
            doubts.push(format!(
                "the joint broke away at {:.4} {unit}, the static law predicts {:.4} +- {:.4} {unit}",
                bristles.reached,
                breakaway.value,
                breakaway.std,
                unit = units.torque
            ));
        }
        doubts
    }

    pub(super) fn text(&self) -> String {
        let units = self.units();
        let Units {
            torque,
            velocity: speed,
            position,
        } = units;
        let (curve, law) = (self.curve, self.law);
        let stretches = curve.points.iter().map(|point| point.stretches).sum();
        let mut text = format!(
            "friction of {}: {} in {}; {}\n\n",
            self.joint.name,
            counted(curve.points.len(), "speed"),
            counted(stretches, "stretch").replace("stretchs", "stretches"),
            if self.is_fitted {
                format!(
                    "the rigid body was fitted with it ({})",
                    counted(curve.rank, "column")
                )
            } else {
                "the rigid body's torque was taken from the parameters".to_owned()
            }
        );
        let (speed_head, torque_head) = (format!("speed {speed}"), format!("torque {torque}"));
        let _ = writeln!(
            text,
            "{speed_head:>14} {torque_head:>14} {:>10} {:>10} {:>9}",
            "+-", "law", "seconds"
        );
        for point in &curve.points {
            let _ = writeln!(
                text,
                "{:>14} {:>14} {:>10} {:>10} {:>9.2}",
                table_value(point.speed),
                table_value(point.torque.value),
                table_value(point.torque.std),
                table_value(law.torque(point.speed)),
                point.seconds
            );
        }
        text.push('\n');
        let mut row = |name: &str, Value { value, std }: Value, unit: &str| {
            let [value, std] = [value, std].map(table_value);
            let _ = writeln!(text, "{name:<34} {value:>12} +- {std:<10} {unit}");
        };
        row("Coulomb torque F_c", law.coulomb, torque);
        row(
            "viscous friction s2",
            law.viscous,
            &format!("{torque} s/{position}"),
        );
        if let Some(fall) = law.fall {
            row("breakaway torque F_s", law.breakaway, torque);
            row("Stribeck speed v_s", fall.speed, speed);
        }
        if let Some(offset) = law.offset {
            row("offset t0", offset, torque);
        }
        if let Some(bristles) = self.bristles {
            let per = format!("{torque}/{position}");
            row("stiffness of bristles s0", bristles.stiffness, &per);
            row(
                "deflection at sliding F_c/s0",
                bristles.deflection,
                position,
            );
            if let Some(damping) = bristles.damping {
                row(
                    "damping of bristles s1",
                    damping,
                    &format!("{torque} s/{position}"),
                );
            }
        }
        let _ = writeln!(text, "{}", self.verdict());
        let (parameters, spec) = self.declared();
        let _ = writeln!(text, "\nfor the spec: {spec}");
        for Parameter { name, value, std } in parameters {
            let said = match std {
                Some(_) => "",
                None => "   (not identified: a first value)",
            };
            let _ = writeln!(text, "  {name} = {value:.6}{said}");
        }
        text
    }

    /// Whether there is a fall, in words.
    fn verdict(&self) -> String {
        let torque = self.units().torque;
        let (most, rms) = self.law.distance;
        let distance =
            format!("points deviate from the law by {rms:.5} {torque} rms, {most:.5} at most");
        let fall = match (self.law.fall, self.law.probability) {
            (Some(_), Some(p)) => format!("friction falls with speed (by chance: {p:.4})"),
            (None, Some(p)) => {
                format!("no significant fall with speed ({p:.4}): F_s and v_s are not identified")
            }
            (_, None) => {
                "too few speeds for a fall, which needs five: F_s and v_s are not identified"
                    .to_owned()
            }
        };
        format!("{fall}; {distance}")
    }
}
