//! `excite`.

mod limits;
mod motion;
mod refusals;
mod rivals;
mod stopped;
mod verdict;

use crate::verbs::common::{Folder, PENDULUM};

/// The pendulum with limits and friction.
fn arm() -> String {
    let limits = "position = -120 deg .. 120 deg; velocity = 4; acceleration = 30; torque = 25; }";
    PENDULUM
        .replace("d = 0; }", &format!("d = 0; {limits}"))
        .replace(
            "\n}\n",
            "\n    effects { viscous_friction on all; coulomb_friction on all; }\n}\n",
        )
}

const FRICTION: &str = r#"{"upper.viscous_friction.fv": 0.6, "upper.coulomb_friction.fc": 0.8,
    "lower.viscous_friction.fv": 0.3, "lower.coulomb_friction.fc": 0.4}"#;

const ARM: [&str; 4] = ["excite", "arm.robot", "--parameters", "friction.json"];
/// Little work: what is tested here is not how good the best motion is.
const SMALL: [&str; 6] = ["--starts", "1", "--period", "5", "--harmonics", "3"];

fn folder() -> Folder {
    let folder = Folder::new();
    folder.write("arm.robot", &arm());
    folder.write("friction.json", FRICTION);
    folder
}

/// Columns of a CSV file.
fn columns(text: &str) -> (Vec<String>, Vec<Vec<f64>>) {
    let mut lines = text.lines();
    let head = lines.next().expect("a header").split(',');
    let head: Vec<String> = head.map(str::to_owned).collect();
    let mut columns = vec![Vec::new(); head.len()];
    for line in lines {
        for (column, number) in columns.iter_mut().zip(line.split(',')) {
            column.push(number.parse::<f64>().expect("a number"));
        }
    }
    (head, columns)
}

fn most(column: &[f64]) -> f64 {
    column.iter().fold(0.0, |most: f64, x| most.max(x.abs()))
}
