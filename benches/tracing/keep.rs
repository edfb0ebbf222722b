//! An experiment as files, to be looked at.

use std::path::Path;

use robot_model::log::Log;

use crate::experiment::Experiment;

impl Experiment {
    /// The spec, the spec that says all and both logs, as files of a folder.
    ///
    /// # Errors
    /// Those of the file system.
    pub fn keep(&self, folder: &Path) -> std::io::Result<()> {
        std::fs::create_dir_all(folder)?;
        std::fs::write(folder.join("declared.robot"), &self.declared)?;
        if let Some(truth) = &self.truth {
            std::fs::write(folder.join("truth.robot"), truth)?;
        }
        for log in &self.logs {
            std::fs::write(folder.join(format!("{}.csv", log.source)), csv(log))?;
        }
        Ok(())
    }
}

fn csv(log: &Log) -> String {
    let joints = 1..=log.q.len();
    let names =
        |stem: &str| -> Vec<String> { joints.clone().map(|j| format!("{stem}{j}")).collect() };
    let extra = log.extra.iter().map(|channel| channel.name.clone());
    let head: Vec<String> = std::iter::once("time".to_owned())
        .chain(names("q"))
        .chain(names("tau"))
        .chain(extra)
        .collect();
    let mut text = head.join(",");
    for (k, time) in log.time.iter().enumerate() {
        let columns = log
            .q
            .iter()
            .chain(&log.tau)
            .chain(log.extra.iter().map(|channel| &channel.values));
        let row: Vec<String> = std::iter::once(*time)
            .chain(columns.map(|values| values[k]))
            .map(|x| x.to_string())
            .collect();
        text.push('\n');
        text.push_str(&row.join(","));
    }
    text.push('\n');
    text
}
