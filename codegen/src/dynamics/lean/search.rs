//! How a chain is best written: all ways that are tried have the same values, the one with the fewest operations is taken.

use robot_model_spec::model::JointKind;

use super::LeanChain;
use super::body::Form;
use crate::dynamics::chain::Chain;
use crate::dynamics::computed::operations;
use crate::dynamics::frame::Frame;
use crate::dynamics::rigid::Terms;
use crate::dynamics::vector::Vector;
use crate::expr::{Dag, ExprId};

/// One way to write a chain.
#[derive(Debug, Clone, PartialEq)]
pub struct Choice {
    /// What the second moments of a link are written as.
    pub forms: Vec<Form>,
    /// Where the origins of the link frames move, in link coordinates, m.
    pub origins: Vec<[f64; 3]>,
    /// Masses that links are lent by their parents, kg.
    pub lent: Vec<f64>,
    /// Whether a link is written in axes that do not turn with its joint.
    pub turned: Vec<bool>,
    /// What lengths are measured in, m.
    pub unit: f64,
}

/// What is to be computed with a chain.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Wanted {
    /// These terms of the torque.
    Torque(Terms),
    /// The mass matrix.
    MassMatrix,
}

impl Choice {
    /// The chain as it is given.
    pub fn plain(dof: usize) -> Self {
        Self {
            forms: vec![Form::Inertia; dof],
            origins: vec![[0.0; 3]; dof],
            lent: vec![0.0; dof],
            turned: vec![false; dof],
            unit: 1.0,
        }
    }

    /// The same for derivations that know no second moments.
    pub fn with_inertias(mut self) -> Self {
        self.forms.fill(Form::Inertia);
        self
    }

    /// The way with the fewest operations, one decision after the other. The same chain gives the same choice. `dag` is where
    /// the chain's expressions are; trials are built on copies of it.
    pub fn best(dag: &Dag, chain: &Chain, wanted: Wanted) -> Self {
        let mut search = Search {
            dag,
            chain,
            wanted,
            best: Self::plain(chain.frames.len()),
            cost: usize::MAX,
        };
        search.cost = search.operations(&search.best);
        let places = places(dag, &chain.frames);
        let weight = weight(dag, chain);
        let mut before = usize::MAX;
        while search.cost < before {
            before = search.cost;
            if wanted != Wanted::MassMatrix {
                for form in [Form::Inertia, Form::SecondMoments] {
                    search.offer(|choice| choice.forms.fill(form));
                    for link in 0..places.len() {
                        search.offer(|choice| choice.forms[link] = form);
                    }
                }
            }
            for (link, places) in places.iter().enumerate() {
                for &place in places {
                    search.offer(|choice| choice.origins[link] = place);
                }
            }
            for link in (0..places.len()).rev() {
                search.offer(|choice| choice.turned[link] = !choice.turned[link]);
            }
            for (link, mass) in search.masses() {
                // Links between carry the mass on, as far down as that makes nothing worse; none is carried past a slide.
                let slide = (1..link).rev().find(|&k| !search.turns(k));
                for first in slide.map_or(1, |k| k + 1)..=link {
                    let mut lent = search.best.lent.clone();
                    lent[first..=link].iter_mut().for_each(|lent| *lent += mass);
                    // More than the arm weighs would cost digits: it cancels again.
                    if lent.iter().all(|mass| mass.abs() <= weight) {
                        search.offer(|choice| choice.lent = lent);
                    }
                }
            }
            for unit in search.lengths() {
                search.offer(|choice| choice.unit = unit);
            }
        }
        search.best
    }
}

struct Search<'a> {
    dag: &'a Dag,
    chain: &'a Chain,
    wanted: Wanted,
    best: Choice,
    cost: usize,
}

impl Search<'_> {
    fn offer(&mut self, change: impl FnOnce(&mut Choice)) {
        let mut choice = self.best.clone();
        change(&mut choice);
        if choice == self.best {
            return;
        }
        let cost = self.operations(&choice);
        if cost < self.cost {
            self.best = choice;
            self.cost = cost;
        }
    }

    fn operations(&self, choice: &Choice) -> usize {
        let mut dag = self.dag.clone();
        let lean = LeanChain::new(&mut dag, self.chain, choice);
        let outputs = match self.wanted {
            Wanted::Torque(terms) => lean.torque(&mut dag, terms),
            Wanted::MassMatrix => lean.into_chain().mass_matrix(&mut dag).concat(),
        };
        operations(&dag, &outputs)
    }

    /// Whether a joint is revolute.
    fn turns(&self, link: usize) -> bool {
        self.chain.frames[link].kind == JointKind::Revolute
    }

    /// Masses that make a first moment of a parent vanish when the link is lent them.
    fn masses(&self) -> Vec<(usize, f64)> {
        let mut dag = self.dag.clone();
        let choice = Choice {
            unit: 1.0,
            turned: vec![false; self.best.turned.len()],
            ..self.best.clone()
        };
        let lean = LeanChain::new(&mut dag, self.chain, &choice);
        let mut masses = Vec::new();
        for link in (1..lean.frames.len()).filter(|&link| self.turns(link)) {
            let (step, first) = (lean.frames[link].joint_point, lean.bodies[link - 1].first);
            for (step, first) in step.into_iter().zip(first) {
                if let (Some(step), Some(first)) = (dag.as_constant(step), dag.as_constant(first))
                    && step.abs() > NEAR
                    && first != 0.0
                {
                    masses.push((link, first / step));
                }
            }
        }
        masses
    }

    /// Lengths between joints as they are written now, and one meter.
    fn lengths(&self) -> Vec<f64> {
        let mut dag = self.dag.clone();
        let choice = Choice {
            unit: 1.0,
            ..self.best.clone()
        };
        let lean = LeanChain::new(&mut dag, self.chain, &choice);
        let steps = lean.frames.iter();
        let numbers = steps.flat_map(|frame| [frame.joint_point, frame.to_origin].concat());
        let lengths = numbers.filter_map(|x| dag.as_constant(x));
        let mut lengths: Vec<f64> = lengths.map(f64::abs).filter(|&x| x > NEAR).collect();
        lengths.push(1.0);
        lengths.sort_by(f64::total_cmp);
        lengths.dedup();
        lengths
    }
}

/// What an arm weighs at least, kg: base parameters have few masses, but where a link has its first moment, there is a mass within
/// the longest length.
fn weight(dag: &Dag, chain: &Chain) -> f64 {
    let size = |x: ExprId| dag.as_constant(x).map_or(0.0, f64::abs);
    let largest = |numbers: &[ExprId]| numbers.iter().map(|&x| size(x)).fold(0.0, f64::max);
    let frames = chain.frames.iter();
    let lengths: Vec<ExprId> = frames
        .flat_map(|frame| [frame.joint_point, frame.to_origin].concat())
        .collect();
    let longest = largest(&lengths).max(NEAR);
    let links = chain.links.iter();
    links
        .map(|link| largest(&link[..1]).max(largest(&link[1..4]) / longest))
        .sum()
}

/// Where origins may be worth moving to, per link: on the joint's axis, the next one's, or where these are next to each other.
fn places(dag: &Dag, frames: &[Frame]) -> Vec<Vec<[f64; 3]>> {
    let lines: Vec<Option<Lines>> = frames.iter().map(|frame| Lines::of(dag, frame)).collect();
    (0..frames.len())
        .map(|link| {
            let mut places = vec![[0.0; 3]];
            let Some(own) = lines[link] else {
                return places;
            };
            let mut push = |place: [f64; 3]| {
                let near =
                    |other: &[f64; 3]| other.iter().zip(place).all(|(x, y)| (x - y).abs() < NEAR);
                if !places.iter().any(near) {
                    places.push(place.map(|x| if x.abs() < NEAR { 0.0 } else { x }));
                }
            };
            push(own.in_link.point);
            push(own.in_link.foot_of([0.0; 3]));
            if let Some(parent) = link.checked_sub(1).and_then(|parent| lines[parent]) {
                // Measured along the axis, which is fixed in both.
                let along = own.in_parent.next_to(&parent.in_link);
                push(own.in_link.at(along));
            }
            push(own.in_link.at(own.in_parent.along([0.0; 3])));
            if let Some(next) = lines.get(link + 1).copied().flatten() {
                push(next.in_parent.point);
                push(own.in_link.foot_of(next.in_parent.point));
                push(own.in_link.at(own.in_link.next_to(&next.in_parent)));
                push(next.in_parent.foot_of(own.in_link.point));
            }
            places
        })
        .collect()
}

/// Places nearer than this are one, m.
const NEAR: f64 = 1e-9;

/// The axis of a joint, in the link and in its parent; both points are the joint point.
#[derive(Clone, Copy)]
struct Lines {
    in_link: Line,
    in_parent: Line,
}

#[derive(Clone, Copy)]
struct Line {
    point: [f64; 3],
    direction: [f64; 3],
}

impl Lines {
    fn of(dag: &Dag, frame: &Frame) -> Option<Self> {
        let numbers = |v: Vector| -> Option<[f64; 3]> {
            let [x, y, z] = v.map(|x| dag.as_constant(x));
            Some([x?, y?, z?])
        };
        Some(Self {
            in_link: Line {
                point: numbers(frame.to_origin)?.map(|x| 0.0 - x),
                direction: numbers(frame.axis)?,
            },
            in_parent: Line {
                point: numbers(frame.joint_point)?,
                direction: numbers(frame.axis_in_parent)?,
            },
        })
    }
}

impl Line {
    fn at(&self, along: f64) -> [f64; 3] {
        std::array::from_fn(|k| self.point[k] + along * self.direction[k])
    }

    /// Where the line is next to a point, measured from its own point.
    fn along(&self, to: [f64; 3]) -> f64 {
        dot(difference(to, self.point), self.direction)
    }

    fn foot_of(&self, point: [f64; 3]) -> [f64; 3] {
        self.at(self.along(point))
    }

    /// Where the line is next to another, measured from its own point; 0 for parallel lines.
    fn next_to(&self, other: &Self) -> f64 {
        let apart = difference(other.point, self.point);
        let cos = dot(self.direction, other.direction);
        let square_of_sine = 1.0 - cos * cos;
        if square_of_sine < NEAR {
            return 0.0;
        }
        (dot(apart, self.direction) - cos * dot(apart, other.direction)) / square_of_sine
    }
}

fn dot(x: [f64; 3], y: [f64; 3]) -> f64 {
    x.iter().zip(y).map(|(x, y)| x * y).sum()
}

fn difference(x: [f64; 3], y: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|k| x[k] - y[k])
}
