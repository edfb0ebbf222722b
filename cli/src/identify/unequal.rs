//! Logs of which one leaves far more of a joint's torque than another.

use robot_model::identify::Errors;
use robot_model::log::Log;

/// How many times as much.
const FAR: f64 = 3.0;

/// And in shares of the torque, without long rests, which are not fitted.
const FAR_IN_SHARES: f64 = 2.0;

/// Joints whose rows count alike in all logs, though what is left of them is not.
pub(super) fn doubt(joints: &[String], logs: &[Log], errors: &[Errors]) -> Option<String> {
    let told = joints.iter().enumerate().filter_map(|(joint, name)| {
        let of = |log: &usize| errors[*log].rmse[joint];
        let counted = (0..logs.len()).filter(|log| errors[*log].samples[joint] > 0);
        let counted: Vec<usize> = counted.collect();
        let most = counted.iter().max_by(|a, b| of(a).total_cmp(&of(b)))?;
        let least = counted.iter().min_by(|a, b| of(a).total_cmp(&of(b)))?;
        let share = |log: &usize| errors[*log].relative_percent[joint];
        let is_far = of(most) > FAR * of(least) && share(most) > FAR_IN_SHARES * share(least);
        is_far.then(|| {
            format!(
                "`{name}` {:.3} in {}, {:.3} in {}",
                of(most),
                logs[*most].source,
                of(least),
                logs[*least].source
            )
        })
    });
    let told: Vec<String> = told.collect();
    (!told.is_empty()).then(|| {
        format!(
            "residuals of the logs differ, by RMSE: {}; all rows of a joint have equal weight, so the worse log affects values and standard \
             deviations: find out what differs in it, or fit the better one alone",
            told.join("; ")
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_joint_and_both_logs_are_named() {
        let log = |name: &str| {
            let time: Vec<f64> = (0..20).map(|k| 0.01 * f64::from(k)).collect();
            let zeros = vec![vec![0.0; 20]; 2];
            Log::from_samples(name, time, zeros.clone(), zeros).expect("a log")
        };
        let of = |rmse: [f64; 2], shares: [f64; 2]| {
            let mut errors = Errors::default();
            (errors.rmse, errors.relative_percent) = (rmse.to_vec(), shares.to_vec());
            errors.samples = vec![10; 2];
            errors
        };
        let errors = |rmse: [f64; 2]| of(rmse, rmse);
        let joints = ["up", "lo"].map(str::to_owned);
        let logs = [log("a.csv"), log("b.csv")];
        let said = doubt(&joints, &logs, &[errors([0.1, 0.1]), errors([0.2, 0.5])]);
        let said = said.expect("unequal");
        assert!(
            said.contains("`lo` 0.500 in b.csv, 0.100 in a.csv") && !said.contains("`up`"),
            "{said}"
        );
        assert_eq!(
            doubt(&joints, &logs, &[errors([0.1, 0.1]), errors([0.2, 0.2])]),
            None
        );
        assert_eq!(doubt(&joints, &logs[..1], &[errors([0.1, 0.5])]), None);
        // What is left of a long rest is fitted nowhere.
        let rested = of([0.2, 0.5], [0.1, 0.1]);
        assert_eq!(doubt(&joints, &logs, &[errors([0.1, 0.1]), rested]), None);
    }
}
