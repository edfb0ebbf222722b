use super::*;

fn tried(kind: &str, round: usize, percent: f64, refusals: &[Refusal]) -> Tried {
    Tried {
        effect: kind.replace('-', "_"),
        round,
        kind: kind.to_owned(),
        joints: vec![1],
        shapes: Vec::new(),
        evidence: evidence(percent),
        refusals: refusals.to_vec(),
        follows_torque: false,
    }
}

fn doubted(tried: &[Tried]) -> Option<&Tried> {
    doubtful(tried, &[Structure::default(); 2])
}

/// Of the second of two joints; what moves on the first is not the law's.
fn evidence(percent: f64) -> Evidence {
    Evidence {
        score: 30.0,
        p_value: 0.0,
        held_out_percent: vec![0.0, percent],
        raw_percent: vec![50.0, percent],
        folds: (5, 5),
    }
}

fn verdict(outcome: Outcome, findings: Vec<Finding>, is_settled: bool) -> Verdict {
    Verdict {
        outcome,
        findings,
        leads: Vec::new(),
        alternatives: Vec::new(),
        tried: Vec::new(),
        before: Vec::new(),
        after: vec![Structure::default(); 2],
        left: Vec::new(),
        noise_floor: Vec::new(),
        turn_speeds: Vec::new(),
        series: Vec::new(),
        goes_on: false,
        is_settled,
    }
}

fn finding() -> Finding {
    Finding {
        kind: "payload".to_owned(),
        effect: "payload".to_owned(),
        joints: vec![1],
        parameters: Vec::new(),
        evidence: evidence(40.0),
        precedes_change: false,
    }
}

#[test]
fn what_was_found_before_a_change_of_the_arm_says_so() {
    let of = |count| verdict(Outcome::Explained, vec![finding(); count], true);
    let both = of(2).followed_by(of(1)).followed_by(of(1));
    let told: Vec<bool> = both
        .findings
        .iter()
        .map(|one| one.precedes_change)
        .collect();
    assert_eq!(told, [true, true, false, false]);
}

#[test]
fn a_law_that_may_not_be_named_says_that_something_is_missing() {
    let all = [
        tried("of the round before", 0, 40.0, &[Refusal::Sign]),
        tried("by chance, too", 1, 30.0, &[Refusal::Sign, Refusal::Chance]),
        tried("noise", 1, 30.0, &[Refusal::Noise]),
        tried("little", 1, 9.0, &[Refusal::EndOfRange]),
        tried("it", 1, 12.0, &[Refusal::Sign, Refusal::EndOfRange]),
    ];
    assert_eq!(doubted(&all).map(|tried| tried.kind.as_str()), Some("it"));
    assert_eq!(doubted(&all[..4]), None);
    for (refusal, is_of_law) in [
        (Refusal::Sign, true),
        (Refusal::EndOfRange, true),
        (Refusal::Undetermined, true),
        (Refusal::Unsteady, true),
        (Refusal::Chance, false),
        (Refusal::HeldOut, false),
        (Refusal::AtTurns, false),
    ] {
        let alone = [tried("it", 1, 12.0, &[refusal])];
        assert_eq!(doubted(&alone).is_some(), is_of_law, "{refusal}");
    }
    let in_some_folds =
        |percent| doubted(&[tried("a gap", 1, percent, &[Refusal::HeldOut])]).is_some();
    assert!(in_some_folds(24.0) && !in_some_folds(18.0));
    let mut uneven = tried("a gap", 1, 24.0, &[Refusal::HeldOut]);
    uneven.evidence.held_out_percent = vec![0.0, 10.0];
    assert_eq!(doubted(&[uneven]), None);
    // The noise of a logged torque is none of its own law, but for a joint with structure.
    let mut limit = tried("a limit", 1, 24.0, &[Refusal::Undetermined]);
    limit.follows_torque = true;
    let with_structure = Structure {
        share: 0.5,
        ..Structure::default()
    };
    let limit = [limit];
    assert_eq!(doubted(&limit), None);
    assert!(doubtful(&limit, &[Structure::default(), with_structure]).is_some());
    // What was found speaks for itself.
    let of = |outcome, findings| Verdict {
        tried: all.to_vec(),
        ..verdict(outcome, findings, true)
    };
    assert!(of(Outcome::Unexplained, Vec::new()).doubtful().is_some());
    assert_eq!(of(Outcome::Explained, vec![finding()]).doubtful(), None);
}

#[test]
fn a_doubt_of_a_model_without_findings_leaves_those_before_it() {
    let both = |is_settled, next: fn(Verdict) -> Verdict| {
        let first = verdict(Outcome::Explained, vec![finding()], true);
        let then = next(verdict(Outcome::Unexplained, Vec::new(), is_settled));
        let both = first.followed_by(then);
        (both.outcome, both.findings.len(), both.leads.len())
    };
    assert_eq!(both(true, |next| next), (Outcome::Explained, 1, 0));
    assert_eq!(both(false, |next| next), (Outcome::Unexplained, 0, 1));
    assert_eq!(
        both(true, Verdict::unexplained),
        (Outcome::Unexplained, 0, 1)
    );
}
