//! The smallest text that still fails, by dropping ever smaller runs of pieces.

use crate::mutate::pieces;

/// Drops what is not needed for `fails` to hold; `fails(text)` holds for the text itself.
#[must_use]
pub fn minimize(text: &str, fails: &dyn Fn(&str) -> bool) -> String {
    let mut smallest = text.to_owned();
    let mut run = pieces(text).len().div_ceil(2);
    while run > 0 {
        let mut at = 0;
        loop {
            let parts = pieces(&smallest);
            if at >= parts.len() {
                break;
            }
            let end = (at + run).min(parts.len());
            let candidate = [&parts[..at], &parts[end..]].concat().concat();
            if fails(&candidate) {
                smallest = candidate;
            } else {
                at += run;
            }
        }
        run /= 2;
    }
    smallest
}

#[cfg(test)]
mod tests {
    use super::minimize;

    #[test]
    fn what_is_not_needed_goes() {
        let fails = |text: &str| text.contains("bad") && text.contains("worse");
        assert_eq!(minimize("a b bad c { d; } worse;", &fails), "bad worse");
    }
}
