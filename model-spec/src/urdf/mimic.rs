//! `<mimic>`: which joint follows which, and by how much.
//!
//! The language has no ties between joints. What follows another joint on the chain is a joint of its own in the spec, so the
//! equations are those of the arm without the tie, and the tie is told: by virtual work, what acts on a leader `a` is
//! `tau(a) + sum_b m_b tau(b)` over its followers `q(b) = m_b q(a) + o_b`, at states that keep the ties.

use std::fmt::Write as _;

use urdf_rs::{Joint, JointType};

use super::pose::meant;
use super::tree::{Chain, Tree};
use super::write::{Names, number, readable};
use super::{ImportError, UrdfPart};
use crate::suggest;

/// `q(follower) = factor * q(leader) + offset`
pub(super) struct Tie<'a> {
    pub(super) leader: &'a Joint,
    factor: f64,
    /// rad or m.
    pub(super) offset: f64,
}

/// What a joint follows, directly or by way of others: from the leader that its `<mimic>` names to the one that follows none.
pub(super) fn ties<'a>(tree: &Tree<'a>, joint: &'a Joint) -> Result<Vec<Tie<'a>>, ImportError> {
    let mut ties: Vec<Tie> = Vec::new();
    let (mut at, mut factor, mut offset) = (joint, 1.0, 0.0);
    while let Some(mimic) = &at.mimic {
        let refuse = |joint: &Joint, reason: String| {
            Err(ImportError::Joint {
                joint: joint.name.clone(),
                reason,
                part: UrdfPart::of_joint(&joint.name, "mimic"),
            })
        };
        let Some(leader) = tree.joint(&mimic.joint) else {
            let others = tree.moving().filter(|name| *name != at.name);
            return refuse(
                at,
                format!(
                    "mimics joint `{}`, which the URDF does not have: {}",
                    mimic.joint,
                    suggest::help(&mimic.joint, others)
                ),
            );
        };
        let is_passed = |tie: &Tie| tie.leader.name == leader.name;
        if leader.name == joint.name || ties.iter().any(is_passed) {
            return refuse(
                leader,
                format!(
                    "mimics itself, by way of joint `{}`: take one `<mimic>` away",
                    at.name
                ),
            );
        }
        let own = mimic.offset.unwrap_or(0.0);
        offset += factor
            * match at.joint_type {
                JointType::Prismatic => own,
                _ => meant(own),
            };
        factor *= mimic.multiplier.unwrap_or(1.0);
        if !(factor.is_finite() && offset.is_finite()) {
            return Err(ImportError::NotFinite {
                what: format!("the place where joint `{}` mimics another", joint.name),
                part: Some(UrdfPart::of_joint(&joint.name, "mimic")),
            });
        }
        ties.push(Tie {
            leader,
            factor,
            offset,
        });
        at = leader;
    }
    Ok(ties)
}

/// Followers on the chain, with their names in the spec.
type Followers<'a> = Vec<(&'a str, Tie<'a>)>;

/// The ties that the spec leaves out, one text per leader.
pub(super) fn warnings(
    tree: &Tree,
    chain: &Chain,
    names: &Names,
) -> Result<Vec<String>, ImportError> {
    let mut led: Vec<(&Joint, Followers)> = Vec::new();
    for (joint, name) in chain.joints.iter().zip(&names.joints) {
        let mut ties = ties(tree, joint.joint)?;
        // Every joint is told with the leader at the end, so that all that acts on this one is one sum; a leader beside the
        // chain has no equation.
        if let Some(last) = ties
            .iter()
            .rposition(|tie| chain.index(tie.leader).is_some())
        {
            ties.truncate(last + 1);
        }
        let Some(tie) = ties.pop() else {
            continue;
        };
        match led
            .iter_mut()
            .find(|(leader, _)| leader.name == tie.leader.name)
        {
            Some((_, followers)) => followers.push((name, tie)),
            None => led.push((tie.leader, vec![(name, tie)])),
        }
    }
    let told = led.iter().map(|(leader, followers)| {
        let on_chain = chain
            .index(leader)
            .map(|index| names.joints[index].as_str());
        warning(on_chain, &leader.name, followers)
    });
    Ok(told.collect())
}

/// `on_chain`: the leader's name in the spec, where it has one.
fn warning(on_chain: Option<&str>, leader: &str, followers: &Followers) -> String {
    let leader = on_chain.unwrap_or(leader);
    let listed = suggest::list(followers.iter().map(|(name, _)| *name));
    let ties: Vec<String> = followers
        .iter()
        .map(|(name, tie)| {
            let follows = sum([
                (tie.factor, format!("q({leader})")),
                (tie.offset, String::new()),
            ]);
            format!("q({name}) = {follows}")
        })
        .collect();
    let (joints, follow, tie, they) = match followers.len() {
        1 => ("joint", "follows", "this tie", "it moves"),
        _ => ("joints", "follow", "these ties", "they move"),
    };
    let mut text = format!(
        "{joints} {listed} {follow} joint `{leader}` in the URDF, {}; in the spec {they} freely: M, C, G and tau are those of the arm \
         without {tie}",
        ties.join(", ")
    );
    let own = on_chain.map(|leader| (1.0, format!("tau({leader})")));
    let shares = followers
        .iter()
        .map(|(name, tie)| (tie.factor, format!("tau({name})")));
    let torque = sum(own.into_iter().chain(shares));
    let _ = match on_chain {
        Some(_) => write!(
            text,
            ", a log needs the positions and torques of `{leader}` and of {listed}, and motions that keep {tie} take {torque} at \
             `{leader}`"
        ),
        None => write!(
            text,
            ", `{leader}` is not on the chain and stands still, and motions that keep {tie} take {torque} at `{leader}` beside what \
             moves `{leader}` itself"
        ),
    };
    text
}

/// `q(a) - 0.5*q(b) + 0.1`; a term without a name is the number alone.
fn sum(terms: impl IntoIterator<Item = (f64, String)>) -> String {
    let mut text = String::new();
    for (factor, name) in terms {
        let factor = readable(factor);
        if factor == 0.0 {
            continue;
        }
        text.push_str(match (text.is_empty(), factor < 0.0) {
            (true, false) => "",
            (true, true) => "-",
            (false, false) => " + ",
            (false, true) => " - ",
        });
        let size = number(factor.abs());
        let _ = match (name.as_str(), size.as_str()) {
            ("", size) => write!(text, "{size}"),
            (name, "1") => write!(text, "{name}"),
            (name, size) => write!(text, "{size}*{name}"),
        };
    }
    if text.is_empty() {
        text.push('0');
    }
    text
}
