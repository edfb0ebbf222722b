//! The smallest file that still fails, by dropping ever smaller runs of pieces; where it is no text, of bytes.

use crate::mutate::pieces;

/// Drops what is not needed for `fails` to hold; `fails(file)` holds for the file itself.
#[must_use]
pub fn minimize(file: &[u8], fails: &dyn Fn(&[u8]) -> bool) -> Vec<u8> {
    let mut smallest = file.to_vec();
    let mut run = parts(file).len().div_ceil(2);
    while run > 0 {
        let mut at = 0;
        loop {
            let parts = parts(&smallest);
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

fn parts(file: &[u8]) -> Vec<&[u8]> {
    match std::str::from_utf8(file) {
        Ok(text) => pieces(text).into_iter().map(str::as_bytes).collect(),
        Err(_) => file.chunks(1).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::minimize;

    #[test]
    fn what_is_not_needed_goes() {
        let has = |file: &[u8], part: &[u8]| file.windows(part.len()).any(|window| window == part);
        let fails = |file: &[u8]| has(file, b"bad") && has(file, b"worse");
        assert_eq!(minimize(b"a b bad c { d; } worse;", &fails), b"bad worse");
        assert_eq!(minimize(b"\xff\xfebad\xffworse", &fails), b"badworse");
    }
}
