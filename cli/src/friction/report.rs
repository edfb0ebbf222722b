//! What is said of a joint's friction.

use std::fmt::Write;

use robot_model::friction_curve::{Bristles, Curve, Fall, Law, Point, Value};
use robot_model_spec::model::Joint;
use serde::Serialize;

/// An offset is declared that is so many deviations from none.
const DECLARED: f64 = 3.0;

/// A damping to start from where none is told: bristles that settle within so many seconds.
const SETTLE_S: f64 = 0.01;

/// All that was found.
pub(super) struct Found<'a> {
    pub joint: &'a Joint,
    pub curve: &'a Curve,
    pub law: &'a Law,
    pub bristles: Option<&'a Bristles>,
    /// Whether the rigid body was fitted beside the curve.
    pub is_fitted: bool,
}

/// What `--json` writes; a contract.
#[derive(Serialize)]
pub(super) struct Report<'a> {
    joint: &'a str,
    /// Columns of the rigid body that were fitted beside the curve; none where its parameters were given.
    rank: Option<usize>,
    /// By how much torques came after the positions, s, where that is seen.
    late: Option<Number>,
    points: Vec<PointReport>,
    law: LawReport,
    bristles: Option<BristlesReport>,
    /// Values for the effects of `spec`; those without a deviation are first values for a search.
    parameters: Vec<Parameter>,
    /// Declarations to paste.
    spec: String,
    notes: Vec<String>,
}

#[derive(Serialize)]
struct PointReport {
    speed: f64,
    torque: f64,
    std: f64,
    seconds: f64,
    stretches: usize,
}

#[derive(Serialize)]
struct Number {
    value: f64,
    std: f64,
}

impl From<Value> for Number {
    fn from(Value { value, std }: Value) -> Self {
        Self { value, std }
    }
}

/// `f(v) = sign(v) (coulomb + (breakaway - coulomb) exp(-(v/stribeck_speed)^2)) + viscous v + offset`
#[derive(Serialize)]
struct LawReport {
    coulomb: Number,
    viscous: Number,
    breakaway: Option<Number>,
    stribeck_speed: Option<Number>,
    offset: Option<Number>,
    /// Of a fall like the best one by chance.
    probability: Option<f64>,
    rms: f64,
    largest: f64,
}

#[derive(Serialize)]
struct BristlesReport {
    stiffness: Number,
    damping: Option<Number>,
    reached: f64,
    deflection: Number,
    encoder_step: f64,
    seconds: [f64; 2],
}

#[derive(Serialize)]
pub(super) struct Parameter {
    pub name: String,
    pub value: f64,
    pub std: Option<f64>,
}

impl Found<'_> {
    /// Parameters of the effects that the spec text declares, and that text.
    pub(super) fn declared(&self) -> (Vec<Parameter>, String) {
        let (law, joint) = (self.law, &self.joint.name);
        let parameter = |name: &str, value: f64, std: Option<f64>| Parameter {
            name: format!("{joint}.{name}"),
            value,
            std,
        };
        let told = |name: &str, Value { value, std }: Value| parameter(name, value, Some(std));
        let mut parameters = vec![told("viscous_friction.fv", law.viscous)];
        let mut spec = format!("viscous_friction on {joint};");
        match (self.bristles, law.fall) {
            (Some(bristles), fall) => {
                let (d, rise) = (digits(bristles.deflection.value), law.rise);
                // Without a fall the speed has no effect.
                let speed = fall.map_or(
                    Value {
                        value: 0.1,
                        std: 0.0,
                    },
                    |fall| fall.speed,
                );
                let (vs, ratio) = (digits(speed.value), digits(rise.value));
                let _ = write!(
                    spec,
                    " lugre_presliding(d = {d}, vs = {vs}, rise = {ratio}) on {joint};"
                );
                let damping = bristles.damping.map_or_else(
                    || {
                        parameter(
                            "lugre_presliding.s1",
                            SETTLE_S * bristles.stiffness.value,
                            None,
                        )
                    },
                    |damping| told("lugre_presliding.s1", damping),
                );
                let shape = |name: &str, value: f64, std: f64| {
                    parameter(name, value, fall.is_some().then_some(std))
                };
                parameters.extend([
                    told("lugre_presliding.fc", law.coulomb),
                    damping,
                    parameter("lugre_presliding.d", d, Some(bristles.deflection.std)),
                    shape("lugre_presliding.vs", vs, speed.std),
                    shape("lugre_presliding.rise", ratio, rise.std),
                ]);
            }
            (None, Some(Fall { torque, speed, .. })) => {
                let vs = digits(speed.value);
                let _ = write!(
                    spec,
                    " coulomb_friction on {joint}; stribeck(vs = {vs}) on {joint};"
                );
                parameters.extend([
                    told("coulomb_friction.fc", law.coulomb),
                    told("stribeck.fs", torque),
                    parameter("stribeck.vs", vs, Some(speed.std)),
                ]);
            }
            (None, None) => {
                let _ = write!(spec, " coulomb_friction on {joint};");
                parameters.push(told("coulomb_friction.fc", law.coulomb));
            }
        }
        if let Some(offset) = law
            .offset
            .filter(|t| !self.curve.has_constant && t.value.abs() > DECLARED * t.std)
        {
            let _ = write!(spec, " torque_offset on {joint};");
            parameters.push(told("torque_offset.offset", offset));
        }
        (parameters, spec)
    }

    pub(super) fn report(&self) -> Report<'_> {
        let (parameters, spec) = self.declared();
        let law = self.law;
        let point = |point: &Point| PointReport {
            speed: point.speed,
            torque: point.torque.value,
            std: point.torque.std,
            seconds: point.seconds,
            stretches: point.stretches,
        };
        Report {
            joint: &self.joint.name,
            rank: self.is_fitted.then_some(self.curve.rank),
            late: self.curve.late.map(Number::from),
            points: self.curve.points.iter().map(point).collect(),
            law: LawReport {
                coulomb: law.coulomb.into(),
                viscous: law.viscous.into(),
                breakaway: law.fall.map(|_| law.breakaway.into()),
                stribeck_speed: law.fall.map(|fall| fall.speed.into()),
                offset: law.offset.map(Number::from),
                probability: law.probability,
                largest: law.distance.0,
                rms: law.distance.1,
            },
            bristles: self.bristles.map(|bristles| BristlesReport {
                stiffness: bristles.stiffness.into(),
                damping: bristles.damping.map(Number::from),
                reached: bristles.reached,
                deflection: bristles.deflection.into(),
                encoder_step: bristles.encoder_step,
                seconds: [bristles.seconds.start, bristles.seconds.end],
            }),
            parameters,
            spec,
            notes: self.doubts(),
        }
    }
}

/// A number with five digits, as it stands in the spec.
fn digits(value: f64) -> f64 {
    format!("{value:.4e}").parse().unwrap_or(value)
}
