//! A log that is slower than those that are fitted.

use crate::verbs::common::{CART, Folder, cart_log, json, numbers};

#[test]
fn a_slower_log_is_judged_in_a_band_that_it_bears() {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    let log = cart_log(20, 0.0, 0.0);
    folder.write("log.csv", &log);
    let slow = |step: usize| -> String {
        let (header, rows) = log.split_once('\n').expect("a header");
        let rows: Vec<&str> = rows.lines().step_by(step).collect();
        format!("{header}\n{}\n", rows.join("\n"))
    };
    folder.write("slow.csv", &slow(5));
    let arguments = ["identify", "cart.robot", "log.csv", "--json", "out.json"];
    for form in ["acceleration", "filtered"] {
        let judged = [
            &arguments[..],
            &["--validate", "slow.csv", "--form", form, "--report", form],
        ];
        let run = folder.run(&judged.concat());
        assert_eq!(run.code, Some(0), "{}", run.stderr);
        assert!(
            run.stderr
                .contains("note: slow.csv: 40 samples a second are too few")
                && run.stderr.contains("errors are computed below 4.0 Hz"),
            "{}",
            run.stderr
        );
        let out = json(&folder.read("out.json"));
        let [fitted, judged] = ["rmse", "rmse_validate"].map(|key| numbers(&out[key])[0]);
        assert!(judged < 2.0 * fitted, "{form}: {judged} {fitted}");
    }
    let factor = [
        &arguments[..],
        &["--factor", "f.json", "--validate", "slow.csv"],
    ]
    .concat();
    let merge = ["merge", "cart.robot", "f.json", "--validate", "slow.csv"];
    let trace = ["trace", "cart.robot", "log.csv", "--validate", "slow.csv"];
    for arguments in [&factor[..], &merge, &trace] {
        let run = folder.run(arguments);
        assert_eq!(run.code, Some(0), "{}", run.stderr);
        assert!(
            run.stderr.contains("note: slow.csv: 40 samples a second"),
            "{}",
            run.stderr
        );
    }
}
