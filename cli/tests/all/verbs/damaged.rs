//! A thousand damaged logs and a thousand damaged specs: none crashes the program, none leaves a part of a file, and each refusal
//! names the place. What is taken without a word is a sound file: another order of lines, a shorter log, a number that an arm can have.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::io::Write as _;
use std::path::Path;

use rand::SeedableRng as _;
use rand_chacha::ChaCha8Rng;
use robot_model_fuzz::damage::Damage;
use robot_model_fuzz::json::{SPEC, judge, others, verbs};
use robot_model_fuzz::kind::Kind;

use crate::verbs::common::{Folder, Run, cart_log, json};
use crate::verbs::turns::dry_cart;

const COUNT: u64 = 1000;

/// How the files fared.
#[derive(Default)]
struct Fates {
    /// By damage: taken as it is, taken with a note, refused.
    counts: BTreeMap<Damage, [usize; 3]>,
    /// Runs that ended otherwise than with a result or a refusal, with what they said.
    crashes: Vec<String>,
    /// Runs that left other files than their result, with these.
    parts: Vec<String>,
}

impl Fates {
    /// A run whose results are these, in a folder of its own with the damaged file.
    fn add(&mut self, folder: &Folder, number: u64, damage: Damage, run: &Run, results: &[&str]) {
        let case = format!("number {number}, {}", damage.name());
        let is_answer = matches!(run.code, Some(0 | 1));
        if !is_answer || run.stderr.contains("panicked") {
            self.crashes.push(format!("{case}: {}", run.stderr));
        }
        let is_taken = run.code == Some(0);
        let mut files = folder.files();
        files.retain(|file| !["arm.robot", "log.csv"].contains(&file.as_str()));
        if files != if is_taken { results } else { &[] } {
            self.parts.push(format!("{case}: {files:?}"));
        }
        let is_noted = ["note:", "warning:"]
            .iter()
            .any(|word| run.stderr.contains(word));
        let fate = match (is_taken, is_noted) {
            (true, false) => 0,
            (true, true) => 1,
            (false, _) => 2,
        };
        self.counts.entry(damage).or_default()[fate] += 1;
    }

    /// Tells the counts, past what a test's output is captured by, and fails where a run did not end well, or hardly a file was damaged.
    #[track_caller]
    fn judge(&self, what: &str) {
        let (crashes, parts) = (self.crashes.len(), self.parts.len());
        let mut table =
            format!("{COUNT} damaged {what}: {crashes} crashes, {parts} parts of files\n");
        writeln!(
            table,
            "{:<12}{:>8}{:>8}{:>9}",
            "damage", "taken", "noted", "refused"
        )
        .expect("a string takes all");
        for (damage, [taken, noted, refused]) in &self.counts {
            writeln!(
                table,
                "{:<12}{taken:>8}{noted:>8}{refused:>9}",
                damage.name()
            )
            .expect("a string takes all");
        }
        let _ = std::io::stderr().write_all(table.as_bytes());
        assert!(self.crashes.is_empty(), "{:#?}", self.crashes);
        assert!(self.parts.is_empty(), "{:#?}", self.parts);
        let refused: usize = self.counts.values().map(|counts| counts[2]).sum();
        assert!(refused > 300, "{refused}");
    }
}

/// A damaged copy that is not the file itself, as lines that are exchanged with themselves would leave it.
fn other(file: &str, mut damaged: impl FnMut() -> Vec<u8>) -> Vec<u8> {
    std::iter::repeat_with(&mut damaged)
        .find(|damaged| damaged != file.as_bytes())
        .expect("some damage does something")
}

/// Number, damage and dice of each file.
fn damages() -> impl Iterator<Item = (u64, Damage, ChaCha8Rng)> {
    (0..COUNT).map(|number| {
        let damage = Damage::ALL[usize::try_from(number).expect("small") % Damage::ALL.len()];
        (number, damage, ChaCha8Rng::seed_from_u64(number))
    })
}

#[test]
fn a_thousand_damaged_logs() {
    let log = cart_log(4, 2.0, 0.0);
    // As a user has it who knows the arm: what it weighs, and how far and fast it goes.
    let known = "link = cart; position = -0.5 .. 0.5; velocity = 1; torque = 60; }
    link cart { mass = 3; com = [0, 0, 0]; inertia = [0.01, 0, 0, 0.01, 0, 0.01]; }";
    let spec = dry_cart().replace("link = cart; }", known);
    assert!(spec.contains(known), "{spec}");
    let mut fates = Fates::default();
    for (number, damage, mut dice) in damages() {
        let folder = Folder::new();
        folder.write("arm.robot", &spec);
        let damaged = other(&log, || damage.of_table(&log, &mut dice));
        std::fs::write(folder.path("log.csv"), damaged).expect("a file");
        let run = folder.run(&["identify", "arm.robot", "log.csv", "--json", "fit.json"]);
        fates.add(&folder, number, damage, &run, &["fit.json"]);
        if run.code == Some(0) {
            let report = json(&folder.read("fit.json"));
            assert!(report["parameters"].is_array(), "{number}");
        } else {
            assert!(
                names_a_place_of_a_log(&run.stderr),
                "{number}: {}",
                run.stderr
            );
        }
    }
    fates.judge("logs");
    let [taken, noted, _] = fates.counts[&Damage::Units];
    assert_eq!(taken, 0, "another unit is told");
    assert!(noted > 0, "{noted}");
}

/// `log.csv:LINE: ..`, a column or a joint by its name; or how much there is of a file that is too short, or its rate, which no line has.
fn names_a_place_of_a_log(said: &str) -> bool {
    let error = said
        .lines()
        .find_map(|line| line.strip_prefix("error: log.csv:"));
    let Some(error) = error else {
        return false;
    };
    let line = error.split(':').next().unwrap_or_default();
    let in_line = line.parse::<usize>().is_ok_and(|line| line > 0);
    let has = |name: &&str| error.contains(&format!("`{name}`"));
    let of_column = ["time", "q1", "tau1", "rail"].iter().any(has);
    let of_all = [
        " the log is empty",
        " the log has ",
        " a log of ",
        " the sample rate is ",
    ];
    let is_of_all = of_all.iter().any(|words| error.starts_with(words));
    in_line || of_column || is_of_all
}

/// `--> arm.robot:LINE:COLUMN`, or the file where it is no text.
fn names_a_place(said: &str) -> bool {
    let place = said
        .lines()
        .find_map(|line| line.trim().strip_prefix("--> arm.robot:"));
    let is_number = |text: &str| text.parse::<usize>().is_ok_and(|number| number > 0);
    let in_text = place.is_some_and(|place| {
        place
            .split_once(':')
            .is_some_and(|(line, column)| is_number(line) && is_number(column))
    });
    in_text || said.contains("cannot read `arm.robot`: line ")
}

#[test]
fn a_thousand_damaged_specs() {
    let mut fates = Fates::default();
    for (number, damage, mut dice) in damages() {
        let folder = Folder::new();
        let spec = crate::verbs::common::MEASURED_PENDULUM;
        let damaged = other(spec, || damage.of_text(spec, &mut dice));
        std::fs::write(folder.path("arm.robot"), damaged).expect("a file");
        let run = folder.run(&[
            "emit",
            "arm.robot",
            "--lang",
            "c",
            "--name",
            "arm",
            "--out",
            "c",
        ]);
        fates.add(&folder, number, damage, &run, &["c"]);
        if run.code != Some(0) {
            assert!(names_a_place(&run.stderr), "{number}: {}", run.stderr);
        }
    }
    fates.judge("specs");
    let [_, _, refused] = fates.counts[&Damage::Units];
    assert!(
        refused > 80,
        "units of another dimension are refused: {refused}"
    );
    let [_, _, refused] = fates.counts[&Damage::Huge];
    assert!(refused > 155, "sizes that no arm has: {refused}");
}

/// Gives a file to every verb that reads JSON; how many took it.
fn through_all_verbs(file: &[u8], case: &str) -> usize {
    let mut taken = 0;
    for verb in verbs() {
        let folder = Folder::new();
        for (name, text) in others() {
            folder.write(name, &text);
        }
        std::fs::write(folder.path("f.json"), file).expect("a file");
        let run = folder.run(&verb);
        judge(&format!("{case}, {}", verb[0]), run.code, &run.stderr);
        let mut files = folder.files();
        let beside = others().map(|(name, _)| name);
        files.retain(|file| file != "f.json" && !beside.contains(&file.as_str()));
        if run.code == Some(0) {
            taken += 1;
        } else {
            assert!(files.is_empty(), "{case}: {files:?}");
        }
    }
    taken
}

/// Parameters, factors and states: each sound file is taken by some verb, and damaged ones are taken or refused.
#[test]
fn damaged_json_files() {
    let seeds = Kind::Json.seeds();
    let mut dice = ChaCha8Rng::seed_from_u64(1);
    let (mut taken, mut count) = (0, 0);
    for (k, file) in seeds.iter().enumerate() {
        let by = through_all_verbs(file, &format!("sound file {k}"));
        assert!(by > 0, "sound file {k} is taken by none");
        for number in 0..50 {
            let other = &seeds[number % seeds.len()];
            let damaged = Kind::Json.mutate(file, other, &mut dice);
            taken += through_all_verbs(&damaged, &format!("file {k}, {number}"));
            count += verbs().len();
        }
    }
    assert!(taken > 0 && taken < count / 2, "{taken} of {count}");
}

/// What the fuzzer has found of the program's readers.
#[test]
fn json_of_the_corpus() {
    let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("../fuzz/corpus");
    for entry in std::fs::read_dir(corpus).expect("the corpus") {
        let path = entry.expect("an entry").path();
        if Kind::of(&path) == Some(Kind::Json) {
            let file = std::fs::read(&path).expect("a file");
            through_all_verbs(&file, &path.display().to_string());
        }
    }
}

/// Files that would fill all memory, as a user meets them.
#[test]
fn files_beyond_reason_are_refused() {
    let folder = Folder::new();
    folder.write("arm.robot", SPEC);
    folder.write("deep.json", &"[".repeat(1_000_000));
    folder.write("long.robot", &"// a comment\n".repeat(100_000));
    folder.write(
        "long.urdf",
        &format!("<robot name=\"a\">{}</robot>", "<link/>".repeat(100_000)),
    );
    let columns: Vec<String> = (0..1_000_000).map(|k| format!(",c{k}")).collect();
    let columns = columns.concat();
    folder.write("wide.csv", &format!("time,q1,tau1{columns}\n"));
    for (arguments, words) in [
        (
            vec!["audit", "arm.robot", "--parameters", "deep.json"],
            "deep.json:1:128: lists and objects are nested more than a hundred deep",
        ),
        (
            vec!["check", "long.robot"],
            "cannot read `long.robot`: it has more than 1048576 bytes",
        ),
        (
            vec!["import", "long.urdf", "-o", "arm2.robot"],
            "line 1: the URDF has more than 1000 links",
        ),
        (
            vec!["identify", "arm.robot", "wide.csv", "--json", "fit.json"],
            "wide.csv:1: the row is longer than 1000000 bytes",
        ),
    ] {
        let said = folder.refuse(&arguments);
        assert!(said.contains(words), "{arguments:?}: {said}");
    }
}
