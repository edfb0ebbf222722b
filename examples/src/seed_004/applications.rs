//! Items of section 4: shares, weights, control, forces.

use super::results::Results;
use super::truth::{CROSSOVER, WEIGHTS};
use super::weights::{at_rest, rounding};
use crate::paper::Row;

pub(super) fn rows(results: &Results) -> Vec<Row> {
    [uses(results), controlled(results), contact(results)].concat()
}

fn uses(results: &Results) -> Vec<Row> {
    let off = results.shares.iter().map(|one| one.off).fold(0.0, f64::max);
    let sentences = super::shares::sentences(&results.shares);
    let said = sentences.iter();
    let said = said.map(|(said, [held, of])| format!("{said} ({held} of {of})"));
    let said: Vec<String> = said.collect();
    let gravity = super::shares::gravity_of_joint_3(&results.shares);
    let [sensor, upright, turned] = gravity;
    let crossover = super::shares::crossover();
    let triple = |all: [f64; 3], digits: usize| all.map(|x| format!("{x:.digits$}")).join(", ");
    vec![
        Row::holds(
            "4.8",
            "shares of the torque up to 3.5 rad/s of five installations",
            "figure 10, drawn only",
            format!("they sum to the torque within {off:.0e} N m"),
            off < 1e-12 && results.shares.len() == 5,
            "the shares are not all of the torque",
        ),
        Row::holds(
            "4.8.sentences",
            "what section 4.1 says of the shares, and in how many of the installations that it is said of it holds along our motion",
            "all of them",
            said.join(", "),
            sentences.iter().all(|(_, [held, of])| held == of),
            "shares hang on the motion, which is drawn only: ours has the printed frequencies, with amplitudes of our own",
        ),
        Row::remark(
            "4.8.gravity",
            "what section 4.1 says of gravity on joint 3 beside torques that are taken apart (`dissect`) with table 1: over that of UR with a force sensor, and with a gimbal and counterweight in UR and USD",
            "half of it; nearly none",
            format!("{sensor:.2}; {upright:.2}, {turned:.2}"),
            !super::shares::is_as_said(gravity),
            "gravity on joint 3 is pi8 sin(theta3), so that along one motion it is as pi8 is, and not with table 1 as the text has it",
        ),
        Row::holds(
            "4.9",
            "fc / fv of UR, deg/s",
            triple(CROSSOVER, 0),
            triple(crossover, 0),
            crossover
                .iter()
                .zip(CROSSOVER)
                .all(|(x, y)| (x / y - 1.0).abs() < 0.02),
            "more than rounding of table 1 apart",
        ),
        weights(results),
    ]
}

fn weights(results: &Results) -> Row {
    let [printed, repaired] = &results.balances;
    let [first, second] = results.levers;
    let at_rest = results.carried.each_ref().map(at_rest);
    let limits = [0, 1].map(|k| rounding(WEIGHTS.recommended[k], WEIGHTS.lever));
    let milli = |torques: [Option<f64>; 2]| {
        let torques = torques.map(|torque| torque.map(|torque| format!("{:.1}", 1e3 * torque)));
        torques
            .map(|torque| torque.unwrap_or_else(|| "none".to_owned()))
            .join(" and ")
    };
    Row::wrong_in_print(
        "4.10",
        "counterweights: pi7', pi8' in N m, masses in kg, with the lever 0.075 m, by `control::counterbalance` of the library, for which the command line has \
         no verb; and whether a device that carries the masses stands, by `audit`",
        format!("{:?}, {:?}", WEIGHTS.moments, WEIGHTS.recommended),
        format!(
            "{:.4}, {:.4}; {:.3}, {:.3}; with the printed masses joints 2 and 3 take {} mN m to stand, where rounding of masses \
             and lever leaves {} (`drives`); with {first:.4} m {}; {:.4}; {:.3}, {:.3}",
            printed.moments[0],
            printed.moments[1],
            printed.masses[0],
            printed.masses[1],
            milli(at_rest[0]),
            milli(limits.map(Some)),
            milli(at_rest[1]),
            repaired.moments[0],
            repaired.masses[0],
            repaired.masses[1],
        ),
        at_rest[0].iter().all(Option::is_some) && at_rest[1] == [None; 2],
        &format!(
            "the figures come of another lever than the one that is printed, of {first:.4} m by pi7' and of {second:.4} m by the second mass"
        ),
    )
}

fn controlled(results: &Results) -> Vec<Row> {
    let [ours, other] = &results.controlled[0].squares;
    let lower = results.controlled.iter().filter(|one| {
        let [ours, other] = &one.squares;
        ours.rms < other.rms && ours.steady_percent < other.steady_percent
    });
    let lower = lower.count();
    let gains = &results.largest_gains;
    let count =
        |is_larger: &dyn Fn(usize) -> bool| (0..gains.len()).filter(|k| is_larger(*k)).count();
    let larger = count(&|k| gains[k][0] > gains[k][1]);
    let on_ur = if gains[0][0] > gains[0][1] {
        "it is larger on UR, of which figure 15 is; "
    } else {
        ""
    };
    let stiffness = results.largest_stiffness();
    let stiffer = count(&|k| stiffness[k][0] > stiffness[k][1]);
    let listed = |all: &[[f64; 2]], digits: usize| {
        let pairs = all
            .iter()
            .map(|[ours, other]| format!("{ours:.digits$}/{other:.digits$}"));
        pairs.collect::<Vec<_>>().join(", ")
    };
    vec![
        Row::holds(
            "4.11",
            "inverse dynamics with half of the friction: error of joint 3, identified against piece-wise",
            "steady state 20 % and 25 %, UR, K_P 625",
            format!(
                "{:.1} % and {:.1} %; lower in {lower} of {} settings",
                ours.steady_percent,
                other.steady_percent,
                results.controlled.len()
            ),
            lower == results.controlled.len(),
            "identified parameters are not better",
        ),
        Row::holds(
            "4.11.gain",
            "largest K_P of the five in the loop of ours, identified/piece-wise",
            "larger with identified parameters",
            format!(
                "{}; larger in {larger} of {}",
                listed(gains, 0),
                gains.len()
            ),
            larger == gains.len(),
            &format!(
                "{on_ur}K_P is an acceleration: where the piece-wise inertia is too small the same K_P is a softer loop; K_P pi6 is larger in {stiffer} of {}",
                gains.len()
            ),
        ),
        Row::holds(
            "4.11.stiffness",
            "largest stiffness of joint 3, K_P pi6, N m/rad, identified/piece-wise",
            "stability for a larger range of gains",
            format!(
                "{}; larger in {stiffer} of {}",
                listed(&stiffness, 2),
                stiffness.len()
            ),
            stiffer == stiffness.len(),
            "not larger",
        ),
    ]
}

fn contact(results: &Results) -> Vec<Row> {
    let felt = &results.felt;
    vec![
        Row::holds(
            "4.12",
            "force at the end point, FS: RMS error against the registered sensor, with the model and without; by the library, the command line has no verb for it",
            "with the model slightly better",
            format!(
                "{:.3} and {:.3} N; frame registered within {:.3}",
                felt.rms[0], felt.rms[1], felt.frame_off
            ),
            felt.rms[0] < felt.rms[1] && felt.frame_off < 0.05,
            "not better",
        ),
        Row::holds(
            "4.12.J",
            "Jacobian (21), in the frame of the end point",
            "(21)",
            format!(
                "J^T J is that of the spec's point within {:.0e} m^2",
                results.jacobian_off
            ),
            results.jacobian_off < 1e-12,
            "it is another one",
        ),
        Row::holds(
            "4.13",
            "torque command per torque, in the spec",
            "2.7",
            format!(
                "a log of commands has the same parameters within {:.0e}",
                results.scaled_off
            ),
            results.scaled_off < 1e-9,
            "it has others",
        ),
    ]
}
