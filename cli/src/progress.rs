//! Progress of long work, on standard error: on a terminal with the time it takes, and with the time that is left where that is known; plain lines of
//! what takes long have that, too.

mod behind;

use std::fmt::{self, Display};
use std::io::IsTerminal;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use indicatif::{HumanDuration, ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};

use crate::output;
pub(crate) use behind::Behind;

/// Where steps follow each other fast, one plain line in so long.
const SELDOM: Duration = Duration::from_secs(10);

/// What a terminal shows of work whose end is not known.
const SPINNER: &str = "{spinner} {msg} [{elapsed}]";

/// What it shows of work of which a part is done.
const BAR: &str = "{spinner} [{bar:20}] {percent:>3} % {msg} [{elapsed}{left}]";

/// Steps of a bar.
const WHOLE: u64 = 1000;

/// A line that says what is being done: a spinner or a bar on a terminal, one plain line a step elsewhere.
#[derive(Debug)]
pub struct Progress {
    bar: Option<ProgressBar>,
    is_silent: bool,
    /// When one of many steps was said last.
    said: Mutex<Option<Instant>>,
    noted: Mutex<Vec<String>>,
    /// What is said behind the result.
    behind: Behind,
    /// Steps of a bar that were behind when it was drawn first.
    begun: Mutex<u64>,
    left: Left,
    /// Where plain lines have begun with known work: when, the share that was behind, and that of the last line.
    plain: Mutex<Option<(Instant, f64, f64)>>,
}

/// When known work will have ended, by the time that its finished parts took: it is not known before one is finished, nor when the
/// present one takes longer than that.
#[derive(Debug, Clone, Default)]
struct Left(Arc<Mutex<Option<Instant>>>);

impl Left {
    /// What took so long and did so much, as a share of the whole, leaves the rest.
    fn tell(&self, took: Duration, did: f64, rest: f64) {
        let seconds = took.as_secs_f64() * rest / did;
        let left = Duration::try_from_secs_f64(seconds).ok();
        self.set(left.and_then(|left| Instant::now().checked_add(left)));
    }

    fn set(&self, end: Option<Instant>) {
        *self.0.lock().unwrap_or_else(PoisonError::into_inner) = end;
    }

    fn write(&self, w: &mut dyn fmt::Write) {
        let end = *self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let left = end.map(|end| end.saturating_duration_since(Instant::now()));
        if let Some(left) = left.filter(|left| !left.is_zero()) {
            let _ = write!(w, ", {:#} to go", HumanDuration(left));
        }
    }
}

impl Progress {
    /// Nothing is shown before the first step.
    #[must_use]
    pub fn new() -> Self {
        let is_shown = std::io::stderr().is_terminal();
        let mut progress = Self::silent();
        progress.bar = is_shown.then(|| {
            let bar = bar(ProgressDrawTarget::stderr());
            bar.enable_steady_tick(Duration::from_millis(100));
            bar
        });
        progress.is_silent = false;
        progress
    }

    /// Nothing is shown at all.
    #[must_use]
    pub fn silent() -> Self {
        Self {
            bar: None,
            is_silent: true,
            said: Mutex::new(None),
            noted: Mutex::new(Vec::new()),
            behind: Behind::default(),
            begun: Mutex::new(0),
            left: Left::default(),
            plain: Mutex::new(None),
        }
    }

    /// Says what comes now.
    pub(crate) fn step(&self, what: &str) {
        match &self.bar {
            Some(bar) => {
                if bar.length().is_some() {
                    bar.unset_length();
                    bar.set_style(style(SPINNER));
                }
                bar.set_message(what.to_owned());
            }
            None if self.is_silent => {}
            None => output::say(what),
        }
    }

    /// Says what comes now inside a step, where somebody looks on.
    pub(crate) fn inside(&self, what: &str) {
        if self.is_live() {
            self.step(what);
        }
    }

    /// Says which part of a known whole comes now; `done`, from 0 to 1, is what is behind.
    pub(crate) fn part(&self, what: &str, done: f64) {
        let Some(bar) = &self.bar else {
            let left = self.left_of_plain(done);
            return self.step(&format!("{what}{left}"));
        };
        self.draw(bar, what, done, true);
    }

    /// The same for work of which nobody knows how much is to come: `done` is a guess, which tells no time.
    pub(crate) fn guess(&self, what: &str, done: f64) {
        match &self.bar {
            Some(bar) => self.draw(bar, what, done, false),
            None => self.step(what),
        }
    }

    fn draw(&self, bar: &ProgressBar, what: &str, done: f64, is_timed: bool) {
        let whole = WHOLE as f64;
        let done = (0..=WHOLE).rfind(|step| *step as f64 <= done * whole);
        let done = done.unwrap_or_default();
        let mut begun = self.begun.lock().unwrap_or_else(PoisonError::into_inner);
        if bar.length().is_none() || done < bar.position() {
            // Of other work; its time counts from here.
            bar.reset();
            bar.set_length(WHOLE);
            let left = self.left.clone();
            let left = move |_: &ProgressState, w: &mut dyn fmt::Write| left.write(w);
            bar.set_style(style(BAR).with_key("left", left));
            self.left.set(None);
            *begun = done;
        } else if done > bar.position() && is_timed {
            let [did, rest] = [done - *begun, WHOLE - done].map(|steps| steps as f64 / whole);
            self.left.tell(bar.elapsed(), did, rest);
        }
        if !is_timed {
            self.left.set(None);
        }
        bar.set_message(what.to_owned());
        bar.set_position(done);
    }

    /// What is left of known work, for a line that nobody sees replaced: only of work that has taken long already.
    fn left_of_plain(&self, done: f64) -> String {
        let mut plain = self.plain.lock().unwrap_or_else(PoisonError::into_inner);
        // What has less behind it than the line before is other work.
        let known = plain.filter(|(.., last)| done >= *last);
        let (since, begun) =
            known.map_or((Instant::now(), done), |(since, begun, _)| (since, begun));
        *plain = Some((since, begun, done));
        let took = since.elapsed();
        if done <= begun || took < SELDOM {
            return String::new();
        }
        let mut text = String::new();
        self.left.tell(took, done - begun, 1.0 - done);
        self.left.write(&mut text);
        text
    }

    /// Says a stage: in plain lines where it begins and, of a long one, now and then how far it is; on a terminal with the part of it that is done.
    pub(crate) fn stage(&self, what: &str, done: Option<f64>) {
        match done {
            Some(done) if self.is_live() => self.part(what, done),
            Some(done) if done > 0.0 => {
                if self.is_due() {
                    self.step(&format!("{:.0} % of {what}", 100.0 * done));
                }
            }
            _ => {
                self.step(what);
                *self.said.lock().unwrap_or_else(PoisonError::into_inner) = Some(Instant::now());
            }
        }
    }

    /// Says one of many steps, and which part is behind where that is known; elsewhere than on a terminal only now and then.
    pub(crate) fn often(&self, what: &str, done: Option<f64>) {
        if !self.is_due() {
            return;
        }
        match done {
            Some(done) => self.part(what, done),
            None => self.step(what),
        }
    }

    /// Whether one of many steps is to be said: always where somebody looks on.
    pub(crate) fn is_due(&self) -> bool {
        if self.is_live() {
            return true;
        }
        let mut said = self.said.lock().unwrap_or_else(PoisonError::into_inner);
        let is_due = said.is_none_or(|last| last.elapsed() >= SELDOM);
        if is_due {
            *said = Some(Instant::now());
        }
        is_due
    }

    /// Whether somebody looks on: then it may be said more often.
    pub(crate) const fn is_live(&self) -> bool {
        self.bar.is_some()
    }

    /// Says something that stays.
    pub(crate) fn note(&self, what: &str) {
        if let Ok(mut noted) = self.noted.lock() {
            noted.push(what.to_owned());
        }
        match &self.bar {
            Some(bar) => bar.println(what),
            None if self.is_silent => {}
            None => output::say(what),
        }
    }

    /// Says doubts, each for itself.
    pub(crate) fn notes(&self, doubts: impl IntoIterator<Item = impl Display>) {
        for doubt in doubts {
            self.note(&format!("note: {doubt}"));
        }
    }

    /// Doubts about a result, each for itself: they are said behind it, where people look, or where it fails to come.
    pub(crate) fn doubts(&self, doubts: impl IntoIterator<Item = impl Display>) {
        self.behind("note: ", doubts);
    }

    /// The same of what puts all of a result in doubt.
    pub(crate) fn warnings(&self, warnings: impl IntoIterator<Item = impl Display>) {
        self.behind(output::WARNING, warnings);
    }

    fn behind(&self, mark: &str, doubts: impl IntoIterator<Item = impl Display>) {
        for doubt in doubts {
            let doubt = format!("{mark}{doubt}");
            if let Ok(mut noted) = self.noted.lock() {
                noted.push(doubt.clone());
            }
            if !self.is_silent {
                self.behind.push(doubt);
            }
        }
    }

    /// Ends the line. What is left to be said is when the result of this goes.
    pub(crate) fn ended(mut self) -> Behind {
        std::mem::take(&mut self.behind)
    }

    /// All that was noted, in its order.
    pub(crate) fn noted(&self) -> Vec<String> {
        self.noted
            .lock()
            .map(|noted| noted.clone())
            .unwrap_or_default()
    }
}

/// A bar whose end is not known yet.
fn bar(target: ProgressDrawTarget) -> ProgressBar {
    ProgressBar::with_draw_target(None, target).with_style(style(SPINNER))
}

fn style(template: &str) -> ProgressStyle {
    ProgressStyle::with_template(template)
        .expect("the templates of this module")
        .progress_chars("=> ")
}

impl Default for Progress {
    fn default() -> Self {
        Self::new()
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

#[cfg(test)]
mod tests {
    use indicatif::InMemoryTerm;

    use super::*;

    #[test]
    fn what_is_left_falls_while_a_part_goes_on_and_is_untold_behind_its_end() {
        let left = Left::default();
        let told = || {
            let mut text = String::new();
            left.write(&mut text);
            text
        };
        assert_eq!(told(), "");
        left.tell(Duration::from_secs(10), 0.25, 0.75);
        assert!(
            [", 30s to go", ", 29s to go"].contains(&told().as_str()),
            "{}",
            told()
        );
        left.set(Instant::now().checked_sub(Duration::from_millis(1)));
        assert_eq!(told(), "");
    }

    #[test]
    fn plain_lines_of_long_work_tell_what_is_left() {
        let progress = Progress::silent();
        assert_eq!(progress.left_of_plain(0.0), "");
        // What was quick is done before anybody has read the line.
        assert_eq!(progress.left_of_plain(0.5), "");
        let begin = Instant::now().checked_sub(Duration::from_secs(20));
        *progress.plain.lock().expect("no panic") = begin.map(|begin| (begin, 0.0, 0.0));
        let said = progress.left_of_plain(0.25);
        assert!(
            [", 60s to go", ", 59s to go", ", 1m to go"].contains(&said.as_str()),
            "{said}"
        );
        // Other work begins anew, be it in the middle.
        assert_eq!(progress.left_of_plain(0.1), "");
        assert_eq!(progress.left_of_plain(0.25), "");
    }

    #[test]
    fn a_terminal_shows_what_is_left_of_known_work() {
        let terminal = InMemoryTerm::new(4, 100);
        let target = ProgressDrawTarget::term_like(Box::new(terminal.clone()));
        let mut progress = Progress::silent();
        progress.bar = Some(bar(target));
        progress.step("compiling");
        let shown = terminal.contents();
        assert!(shown.contains("compiling [0s]"), "{shown}");
        assert!(!shown.contains("to go"), "{shown}");
        for (done, percent) in [(0.0, "  0 %"), (0.25, " 25 %"), (1.0, "100 %")] {
            progress.part("simulating", done);
            progress.bar.as_ref().expect("a bar").force_draw();
            let shown = terminal.contents();
            assert!(
                shown.contains(&format!("{percent} simulating [")),
                "{shown}"
            );
            // Of what is left is told what finished parts took.
            let is_known = (0.1..0.9).contains(&done);
            assert_eq!(shown.contains(" to go]"), is_known, "{shown}");
            std::thread::sleep(Duration::from_millis(600));
        }
        // What begins anew is another work, and what has no end has none.
        progress.part("again", 0.1);
        progress.bar.as_ref().expect("a bar").force_draw();
        assert!(terminal.contents().contains(" 10 % again"));
        assert!(!terminal.contents().contains("to go"));
        // A guess has a share and no time.
        for done in [0.2, 0.6] {
            progress.guess("searching", done);
            progress.bar.as_ref().expect("a bar").force_draw();
            let shown = terminal.contents();
            assert!(shown.contains(" % searching"), "{shown}");
            assert!(!shown.contains("to go"), "{shown}");
        }
        progress.step("done");
        progress.bar.as_ref().expect("a bar").force_draw();
        assert!(!terminal.contents().contains('%'));
        progress.inside("done, the last part");
        progress.bar.as_ref().expect("a bar").force_draw();
        assert!(terminal.contents().contains("done, the last part"));
        progress.note("note: stays");
        drop(progress);
        assert_eq!(terminal.contents(), "note: stays");
    }
}
