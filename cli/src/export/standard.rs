//! One arm of all that move as the parameters say: standard parameters that make the base parameters, of links that are bodies,
//! nearest to the spec's nominal values.

use std::path::Path;

use robot_model::Inertial;
use robot_model::identify::{PossibleArms, PossibleLink};
use robot_model_codegen::Compiled;

use super::passive::is_unsaid;
use crate::Error;
use crate::interpreted::{Moved, Widths, possible_arms};
use crate::parameters::{self, Beside, Values};

/// How exactly base parameters are kept in the search, in deviations; wider ones where a search comes to no end.
const WIDTHS: [f64; 6] = [1e-3, 1e-2, 1e-1, 1.0, 1e1, 1e2];

/// The same where no arm of bodies has the base parameters, the widest first: the wider, the more the nominal values count.
const PLAIN_WIDTHS: [f64; 5] = [1.0, 0.3, 0.1, 0.03, 0.01];

/// How much farther from the parameters than the nearest arm another one may be: as a share, and in deviations.
const FARTHER: f64 = 1.1;
const FARTHER_BY: f64 = 0.01;

/// Masses are the same where they differ by less, as a share.
const SAME_MASS: f64 = 1e-3;

/// The arm that is written.
pub(super) struct Standard {
    /// One value a standard parameter.
    pub values: Vec<f64>,
    /// Whether all links are as they were given.
    pub is_given: bool,
    /// Base parameters that no arm has, and what the arm has in their place.
    pub moved: Vec<Moved>,
    /// Links of another mass than the given one.
    pub masses: Vec<OtherMass>,
}

/// A link, the mass that is given, and the one that is written.
type OtherMass = (String, [f64; 2]);

/// Finds it.
pub(super) fn standard(
    compiled: &Compiled,
    values: &Values,
    file: Option<&Path>,
    has_rotors_apart: bool,
) -> Result<Standard, Error> {
    let given = given(compiled, values, file, has_rotors_apart)?;
    if let Some(values) = given.filter(|values| are_possible(compiled, values)) {
        return Ok(Standard {
            values,
            is_given: true,
            moved: Vec::new(),
            masses: Vec::new(),
        });
    }
    let deviations = file.map(|file| parameters::deviations(compiled, file));
    let deviations = deviations.transpose()?.unwrap_or_default();
    let widths = Widths::new(compiled, &values.beta, &deviations);
    let found = search(compiled, values, &widths.values, has_rotors_apart);
    let (found, masses) = found.ok_or_else(|| {
        Error::Argument(format!(
            "{}: the search for a physically possible arm near these parameters did not converge; run `identify --method physical` on the logs",
            compiled.model.source
        ))
    })?;
    Ok(Standard {
        moved: Moved::all(compiled, &values.beta, &compiled.base.beta(&found), &widths),
        values: found,
        is_given: false,
        masses,
    })
}

/// Standard parameters that the file or the spec gives; none where they give base parameters only, or where something that has no
/// place beside the links could be in them.
fn given(
    compiled: &Compiled,
    values: &Values,
    file: Option<&Path>,
    has_rotors_apart: bool,
) -> Result<Option<Vec<f64>>, Error> {
    if let Some(standard) = &values.standard {
        return Ok(standard.iter().copied().collect());
    }
    let Some(file) = file else {
        return Ok(None);
    };
    let Beside::Same(standard) = parameters::beside(compiled, file, &values.beta)? else {
        return Ok(None);
    };
    let standard: Option<Vec<f64>> = standard.into_iter().collect();
    let hides = |standard: &Vec<f64>| {
        let regrouped = regrouped(compiled, has_rotors_apart);
        regrouped.into_iter().any(|k| standard[k] != 0.0)
    };
    Ok(standard.filter(|standard| !hides(standard)))
}

/// Parameters of effects that have no place beside the links and that a base parameter has others for: what they do is put there.
fn regrouped(compiled: &Compiled, has_rotors_apart: bool) -> Vec<usize> {
    let unsaid = compiled.standard.iter().enumerate().filter(|(k, own)| {
        is_unsaid(&compiled.model, has_rotors_apart, own.owner) && !compiled.base.kept.contains(k)
    });
    unsaid.map(|(k, _)| k).collect()
}

/// The arm, and the masses that are not as they were given.
fn search(
    compiled: &Compiled,
    values: &Values,
    widths: &[f64],
    has_rotors_apart: bool,
) -> Option<(Vec<f64>, Vec<OtherMass>)> {
    let mut arms = possible_arms(compiled)?;
    for k in regrouped(compiled, has_rotors_apart) {
        arms.fixed[k] = Some(0.0);
    }
    // Values by name are nearer than those of the spec.
    if let Some(standard) = &values.standard {
        for link in &mut arms.links {
            let ten: Option<Vec<f64>> = link.parameters.iter().map(|&k| standard[k]).collect();
            let ten = ten.and_then(|ten| ten.try_into().ok());
            link.nominal = ten.or(link.nominal);
        }
    }
    // Masses that no torque tells alone, or if not those that none tells at all, or none.
    let is_silent = |k: usize| !arms.kept.contains(&k);
    let is_without = |k: usize| compiled.base.unidentifiable.contains(&k);
    let choices = [
        held(compiled, &arms, is_silent),
        held(compiled, &arms, is_without),
        Vec::new(),
    ];
    let (mut nearest, mut is_exact) = (None, false);
    for held in choices {
        let (possible, near) = with_held(compiled, &arms, held, (&values.beta, widths));
        is_exact = possible.is_some();
        nearest = possible.or(near).or(nearest);
        if is_exact {
            break;
        }
    }
    let mut found = nearest?;
    if !is_exact {
        let masses = held(compiled, &arms, is_silent);
        let plain = plainest(compiled, &arms, masses, (&values.beta, widths), &found);
        found = plain.unwrap_or(found);
    }
    let others = arms.links.iter().filter_map(|link| {
        let both = [link.nominal?[0], found[link.parameters[0]]];
        let is_other = (both[1] - both[0]).abs() > SAME_MASS * both[0];
        is_other.then(|| (link.name.clone(), both))
    });
    let others = others.collect();
    Some((found, others))
}

/// Of the arms that are hardly farther from base parameters than the nearest one, that which is nearest to the nominal values, with as many of
/// these masses as they are given as such an arm can have. The nearest of all has bodies at the edge of what is possible: for a thousandth of a
/// deviation it gives a link another mass, and takes a rotor away.
fn plainest(
    compiled: &Compiled,
    arms: &PossibleArms,
    masses: Vec<Held>,
    (beta, widths): (&[f64], &[f64]),
    nearest: &[f64],
) -> Option<Vec<f64>> {
    let farthest = |standard: &[f64]| {
        let own = compiled.base.beta(standard);
        let pairs = beta.iter().zip(own).zip(widths);
        let away = pairs.map(|((given, own), width)| ((given - own) / width).abs());
        away.fold(0.0, f64::max)
    };
    let most = FARTHER * farthest(nearest) + FARTHER_BY;
    let with = |held: &[Held]| {
        let (weighed, without) = weighed(compiled, (arms, held), beta);
        PLAIN_WIDTHS.iter().find_map(|width| {
            let widths: Vec<f64> = widths.iter().map(|one| one * width).collect();
            let (_, standard) = weighed.nearest_to(&without, &widths)?;
            (farthest(&standard) <= most).then_some(standard)
        })
    };
    let (mut plainest, mut kept) = (with(&[]), Vec::new());
    for mass in masses {
        kept.push(mass);
        match with(&kept) {
            Some(standard) => plainest = Some(standard),
            None => drop(kept.pop()),
        }
    }
    plainest
}

/// What a link keeps of its given values: some of the mass and the first moments, by their places among its ten.
struct Held<'a> {
    link: &'a PossibleLink,
    places: Vec<usize>,
}

/// The mass of the links of which `is_held` says so, where one is given, and with it the first moments that no torque tells.
fn held<'a>(
    compiled: &Compiled,
    arms: &'a PossibleArms,
    is_held: impl Fn(usize) -> bool,
) -> Vec<Held<'a>> {
    let given = arms
        .links
        .iter()
        .filter(|link| link.nominal.is_some_and(|ten| ten[0] > 0.0) && is_held(link.parameters[0]));
    let unidentifiable = &compiled.base.unidentifiable;
    let held = given.map(|link| Held {
        link,
        places: std::iter::once(0)
            .chain((1..4).filter(|&place| unidentifiable.contains(&link.parameters[place])))
            .collect(),
    });
    held.collect()
}

/// The nearest arm with some links' masses and centers as they are given, as far as they are bodies with them, if there is one that has the
/// base parameters; and the nearest to these.
fn with_held(
    compiled: &Compiled,
    arms: &PossibleArms,
    mut held: Vec<Held>,
    (beta, widths): (&[f64], &[f64]),
) -> (Option<Vec<f64>>, Option<Vec<f64>>) {
    loop {
        let (weighed, without) = weighed(compiled, (arms, &held), beta);
        let found = WIDTHS.iter().find_map(|width| {
            let widths: Vec<f64> = widths.iter().map(|one| one * width).collect();
            weighed.nearest_to(&without, &widths)
        });
        let Some((_, near)) = found else {
            // Centers alone may be what leaves no body.
            if let_centers_go(&mut held) {
                continue;
            }
            return (None, None);
        };
        let exact = exact(compiled, &arms.kept, &near, beta);
        if are_possible(compiled, &exact) {
            return (Some(exact), Some(near));
        }
        let all = count(&held);
        release(&mut held, &exact);
        // Those that are held are bodies, and it may be their centers that leave another link none.
        if count(&held) == all && !let_centers_go(&mut held) {
            return (None, Some(near));
        }
    }
}

/// Lets all centers go; whether there were any.
fn let_centers_go(held: &mut [Held]) -> bool {
    let before = count(held);
    for held in held.iter_mut() {
        held.places.truncate(1);
    }
    count(held) < before
}

/// How much is held.
fn count(held: &[Held]) -> usize {
    held.iter().map(|held| held.places.len()).sum()
}

/// Lets those go that are no bodies: the center first, and the mass where it alone is left.
fn release(held: &mut Vec<Held>, exact: &[f64]) {
    for held in held.iter_mut() {
        if !is_body(held.link.parameters.map(|k| exact[k])) {
            let left = usize::from(held.places.len() > 1);
            held.places.truncate(left);
        }
    }
    held.retain(|held| !held.places.is_empty());
}

/// The same arms with what is held of some links as it is given, and base parameters without it: bodies whose inertia is far from the given
/// one, as where a rotor's is in it, are nearest with another mass and center, too, and these are what is known best.
fn weighed(
    compiled: &Compiled,
    (arms, held): (&PossibleArms, &[Held]),
    beta: &[f64],
) -> (PossibleArms, Vec<f64>) {
    let (mut arms, mut beta) = (arms.clone(), beta.to_vec());
    for held in held {
        for &place in &held.places {
            let parameter = held.link.parameters[place];
            let nominal = held.link.nominal.map_or(0.0, |ten| ten[place]);
            arms.fixed[parameter] = Some(nominal);
            for (sum, combination) in beta.iter_mut().zip(&compiled.base.combinations) {
                let own = combination.iter().filter(|(k, _)| *k == parameter);
                *sum -= own.map(|(_, share)| share * nominal).sum::<f64>();
            }
        }
    }
    (arms, beta)
}

/// The same with what is left of the base parameters in the standard parameters that stand for them.
fn exact(compiled: &Compiled, kept: &[usize], near: &[f64], beta: &[f64]) -> Vec<f64> {
    let mut exact = near.to_vec();
    let sums = compiled.base.combinations.iter().map(|combination| {
        let terms = combination.iter();
        terms.map(|&(k, share)| share * near[k]).sum::<f64>()
    });
    for ((&kept, wanted), sum) in kept.iter().zip(beta).zip(sums) {
        exact[kept] += wanted - sum;
    }
    exact
}

/// Whether links that are not fixed are bodies, and what is not negative is not.
fn are_possible(compiled: &Compiled, standard: &[f64]) -> bool {
    let Some(arms) = possible_arms(compiled) else {
        return false;
    };
    let is_body = |parameters: &[usize; 10]| {
        let ten = parameters.map(|k| standard[k]);
        ten.iter().all(|x| *x == 0.0) || is_body(ten)
    };
    arms.links.iter().all(|link| is_body(&link.parameters))
        && arms.nonnegative.iter().all(|&k| standard[k] >= 0.0)
}

/// Whether mass that is nowhere negative has these parameters.
pub(super) fn is_body(ten: [f64; 10]) -> bool {
    let inertial = Inertial::from(ten);
    let moments = inertial.second_moments();
    inertial.mass > 0.0
        && moments.is_some_and(|moments| {
            let spread = moments.symmetric_eigenvalues();
            // A rod or a plate of rounded numbers is a body, too.
            spread.min() >= -1e-9 * spread.max().abs()
        })
}
