//! Of candidates that pass, the one that is named.

use super::gate::{self, Judged, MATERIAL_PERCENT};
use super::search::Accepted;
use super::verdict::Alternative;

/// The best candidate and those that are as good within the size that matters; of these the simplest is taken that none encompasses.
pub(super) fn choose<'a>(
    judged: Vec<Judged<'a>>,
    encompasses: &dyn Fn(&Judged, &Judged) -> bool,
) -> Option<Accepted<'a>> {
    let best = judged.first()?.raw_power.clone();
    let mut class: Vec<Judged<'a>> = judged
        .into_iter()
        .filter(|judged| gate::worse_percent(&judged.raw_power, &best) <= MATERIAL_PERCENT)
        .collect();
    // Stable: among equally simple laws the one with the larger merit stays first. A logged channel that accounts for a change goes before
    // a law of time alone.
    class.sort_by_key(|judged| {
        let reads_no_channel = judged.trial.candidate.inputs().is_empty();
        (judged.trial.complexity(), reads_no_channel)
    });
    let mut place = 0;
    for other in 1..class.len() {
        if encompasses(&class[other], &class[place]) {
            place = other;
        }
    }
    let chosen = class.remove(place);
    let rivals = class
        .into_iter()
        .map(|rival| Alternative {
            kind: rival.trial.candidate.kind().to_owned(),
            joints: rival.trial.candidate.joints().to_vec(),
            instead_of: 0,
            worse_percent: gate::worse_percent(&rival.raw_power, &chosen.raw_power),
        })
        .collect();
    Some(Accepted {
        changed: chosen.changed.map(|changed| changed.shapes),
        is_small: false,
        evidence: chosen.evidence,
        trial: chosen.trial,
        rivals,
    })
}
