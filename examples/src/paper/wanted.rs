//! What has to come out of each item: the list that the items are taken from, in our words.

/// Items with what is wanted of them, in the order of the papers. Items that are not here are findings, of which it is wanted that they come out.
pub const WANTED: [(&str, &str); 62] = [
    (
        "0.1",
        "alpha, beta and the friction of the law as base parameters",
    ),
    ("0.2", "the same data, three fits in one call"),
    ("0.3", "no step goes to zero where the arm turns"),
    ("0.4", "iterates with their costs, as in Tables 1 and 2"),
    ("0.5", "a free initial velocity in the window of the paper"),
    ("0.6", "2.40 and 0.34 1/s"),
    ("0.7", "searches fail"),
    ("0.8", "the directional law is fastest and leaves least"),
    (
        "0.9",
        "with 0.01 rad/s more the arm turns over in (5.1), by 13 rad in the one run that was looked at beforehand; 0.50 rad of (5.2) from 1 rad/s more",
    ),
    ("0.10", "r, and the gain with its interval"),
    ("0.11", "1.5 within 0.05"),
    ("0.12", "that of 1/ts"),
    ("0.misprint", "one number is off by 1, all others agree"),
    (
        "0.scale",
        "flagged with a condition above 1e3, and ratios told",
    ),
    ("1.1", "a difference of zero, whatever the state"),
    ("1.2", "the start of searches"),
    ("1.3", "the simulated truth"),
    ("1.4", "no step leaves the box"),
    ("1.5", "means and bands of each height"),
    (
        "1.6",
        "a cost that falls from step to step, and the way of each parameter",
    ),
    ("1.7", "both metrics by these names, with unit tests"),
    (
        "1.8",
        "54 to 56 % before, which we take for that of the first seconds, 99 % and more after, without noise",
    ),
    ("1.9", "99 % and more after, without noise"),
    (
        "1.rank",
        "8 of 11, the silent directions, no value for what is not told",
    ),
    ("1.rest", "in the band that dry friction holds"),
    ("2.1", "the law by name, and a continuous variant"),
    ("2.1.passive", "a warning with these speeds"),
    ("2.2", "70 base parameters"),
    ("2.3", "the same set by numbers and by symbols"),
    ("2.4", "weights to choose from, friction by weights"),
    (
        "2.5",
        "the arithmetic of Table II: 54.1 % of the mean, 61.3 % mean over joints; weights bring more than friction",
    ),
    ("2.5.here", "more than 54 %"),
    ("2.6", "slopes within 1e-9 of differences"),
    ("2.7", "no limit exceeded on a grid ten times as fine"),
    ("2.8", "each motion best by its own criterion"),
    ("2.9", "five links and more are no bodies"),
    ("2.10", "less torque of the hand with the better model"),
    ("2.11", "less than a second"),
    ("3.1", "l^2 m / 3"),
    ("3.2", "the curve within 1e-9"),
    (
        "3.3",
        "static parameters within 2 %, dynamic ones within 10 %",
    ),
    ("3.7", "available"),
    (
        "3.8",
        "curve, loop and stick-slip of one model, the latter below a critical speed only",
    ),
    ("3.encoder", "the stiffness that it still tells"),
    ("4.1", "all but one sign"),
    ("4.2", "all but that sign, and filters that are missing"),
    ("4.3", "as the paper does it"),
    ("4.4", "the condition number"),
    ("4.5", "within 1 %"),
    ("4.5.viscous", "within 1 %"),
    ("4.6", "at most 1 %"),
    ("4.6.dropped", "as much as table 2"),
    ("4.7", "Coulomb friction named with p below 1e-6"),
    ("4.7.after", "nothing missing"),
    ("4.viscous.trace", "flagged, and what is missing proposed"),
    ("4.8", "shares that sum to the torque within 1e-12"),
    ("4.9", "713, 411 and 2890 by the coefficients of table 1"),
    (
        "4.10",
        "0.01255, 0.0622, 0.233 and 0.0845 with the printed lever of 0.075 m; 0.0223, 0.248 and 0.090 with 0.0704 m",
    ),
    ("4.11", "a smaller error by the identified set"),
    ("4.11.gain", "a larger gain by the identified set"),
    ("4.12", "a smaller error with the model"),
    ("4.13", "a unit test of `scale` in the spec"),
];

/// What is wanted of an item.
#[must_use]
pub fn wanted(item: &str) -> Option<&'static str> {
    let found = WANTED.iter().find(|(name, _)| *name == item);
    found.map(|(_, wanted)| *wanted)
}

/// Items of the list that a paper has no row for; `paper` is its number.
#[must_use]
pub fn lacking(paper: &super::Paper, number: char) -> Vec<&'static str> {
    let own = WANTED.iter().map(|(name, _)| *name);
    let own = own.filter(|name| name.starts_with(number));
    own.filter(|name| paper.row(name).is_none()).collect()
}
