//! What a design is written as.

use std::fmt::Write;

use robot_model::excite::{Design, Fourier, Request};
use serde::Serialize;

use crate::output::json;
use crate::output::table::MOTION;

const PUT: &str = "a string takes all";

/// One period, `time,q1..qn,dq1..dqn,ddq1..ddqn`; the last row is the first again.
pub(super) fn csv(motion: &Fourier, rate: f64) -> String {
    // A period that is whole in samples but for rounding has its last sample once.
    let steps = (motion.period * rate - 1e-6).ceil().max(1.0);
    let dof = motion.coefficients.len();
    let mut text = MOTION.header(dof);
    text.push('\n');
    let mut k = 0.0;
    while k <= steps {
        let time = (k / rate).min(motion.period);
        let states: Vec<[f64; 3]> = (0..dof).map(|joint| motion.at(joint, time)).collect();
        let values = (0..3).flat_map(|order| states.iter().map(move |state| state[order]));
        MOTION.push(&mut text, time, values);
        k += 1.0;
    }
    text
}

#[derive(Serialize)]
struct Coefficients<'a> {
    period: f64,
    equation: &'static str,
    joints: Vec<JointCoefficients<'a>>,
}

#[derive(Serialize)]
struct JointCoefficients<'a> {
    name: &'a str,
    q0: f64,
    a: &'a [f64],
    b: &'a [f64],
}

/// The coefficients by joint.
pub(super) fn coefficients(request: &Request, design: &Design) -> String {
    let harmonics = design.motion.harmonics();
    let joints = request.joints.iter().zip(&design.motion.coefficients);
    json(&Coefficients {
        period: design.motion.period,
        equation: "q = q0 + sum_l a_l/(w l) sin(w l t) - b_l/(w l) cos(w l t), w = 2 pi / period",
        joints: joints
            .map(|(name, c)| JointCoefficients {
                name,
                q0: c[0],
                a: &c[1..=harmonics],
                b: &c[1 + harmonics..],
            })
            .collect(),
    })
}

#[derive(Serialize)]
struct Report<'a> {
    condition: f64,
    condition_of_unit_columns: f64,
    log_det: f64,
    least_singular: f64,
    hadamard: f64,
    distances: Option<[f64; 2]>,
    columns: usize,
    variables: usize,
    max_violation: f64,
    violated: Option<&'a str>,
    starts: usize,
    stopped: bool,
}

/// What the motion is worth.
pub(super) fn report(request: &Request, design: &Design) -> String {
    let quality = &design.quality;
    json(&Report {
        condition: quality.condition,
        condition_of_unit_columns: quality.condition_of_unit_columns,
        log_det: quality.log_det,
        least_singular: quality.least_singular,
        hadamard: quality.hadamard,
        distances: quality.distances.map(|each| each.map(f64::sqrt)),
        columns: request.regressor.columns.len(),
        variables: design.variables,
        max_violation: quality.violation,
        violated: quality.violated.as_deref(),
        starts: design.starts,
        stopped: design.stopped,
    })
}

/// The same for people.
pub(super) fn summary(request: &Request, design: &Design) -> String {
    let quality = &design.quality;
    let mut text = String::new();
    writeln!(
        text,
        "{} columns, {} joints, {} variables, {} harmonics of {} s; best of {} starts",
        request.regressor.columns.len(),
        request.joints.len(),
        design.variables,
        request.harmonics,
        request.period,
        design.starts,
    )
    .expect(PUT);
    writeln!(
        text,
        "condition number of the regressor    {:.2}",
        quality.condition
    )
    .expect(PUT);
    writeln!(
        text,
        "  with columns of unit length        {:.2}",
        quality.condition_of_unit_columns
    )
    .expect(PUT);
    writeln!(
        text,
        "ln det of information per sample     {:.3}",
        quality.log_det
    )
    .expect(PUT);
    writeln!(
        text,
        "  from column lengths alone          {:.3}",
        quality.hadamard
    )
    .expect(PUT);
    writeln!(
        text,
        "smallest singular value of a sample  {:.3e}",
        quality.least_singular
    )
    .expect(PUT);
    if let (Some([first, second]), Some(shares)) = (quality.distances, quality.shares) {
        let [share, other] = shares.map(|share| 100.0 * share.sqrt());
        writeln!(
            text,
            "part the rival cannot reproduce, RMS over the noise (`--noise`, else the torque limits, else 1): {:.3e} of the first \
             ({share:.1} % of it), {:.3e} of the second ({other:.1} %)",
            first.sqrt(),
            second.sqrt()
        )
        .expect(PUT);
    }
    match &quality.violated {
        None => text.push_str("limits: kept, also on a grid ten times as fine\n"),
        Some(limit) => {
            writeln!(
                text,
                "limits: {limit} exceeded by {:.2e} of it",
                quality.violation
            )
            .expect(PUT);
        }
    }
    text
}
