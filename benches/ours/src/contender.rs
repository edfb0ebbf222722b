//! Holds states and the clock for emitted functions: see `benches/src/program.rs` for what is asked and answered.
//!
//! Asked, a line each: `values NAME COUNT` for what a function returns at the first states, one line a state; `pass NAME` for
//! the mean nanoseconds of a call in each block of states, on one line.

use std::hint::black_box;
use std::io::{BufRead, Write};
use std::time::Instant;

use robot_model::Scalar;
use robot_model::scalar::{Lanes4, Lanes8};

/// States of a block, which is timed as a whole.
const BLOCK: usize = 500;

/// Positions, velocities and accelerations.
pub struct State<const D: usize, S> {
    pub q: [S; D],
    pub dq: [S; D],
    pub ddq: [S; D],
}

/// A number, or several beside each other.
pub trait Number: Scalar {
    const COUNT: usize;
    fn gather(lane: impl Fn(usize) -> f64) -> Self;
    fn lane(self, lane: usize) -> f64;
}

macro_rules! numbers {
    ($($scalar:ty: $count:literal, $gather:expr, $lane:expr;)+) => {
        $(
            impl Number for $scalar {
                const COUNT: usize = $count;
                fn gather(lane: impl Fn(usize) -> f64) -> Self {
                    $gather(std::array::from_fn(lane))
                }
                fn lane(self, lane: usize) -> f64 {
                    $lane(self)[lane]
                }
            }

            impl Entries<$scalar> for $scalar {
                fn entries(&self, push: &mut impl FnMut($scalar)) {
                    push(*self);
                }
            }
        )+
    };
}

numbers! {
    f64: 1, |[x]: [f64; 1]| x, |x| [x];
    Lanes4: 4, Lanes4::from, Lanes4::to_array;
    Lanes8: 8, Lanes8::from, Lanes8::to_array;
}

/// What a function returns, one number after the other.
pub trait Entries<S> {
    fn entries(&self, push: &mut impl FnMut(S));
}

impl<S, T: Entries<S>, const N: usize> Entries<S> for [T; N] {
    fn entries(&self, push: &mut impl FnMut(S)) {
        for part in self {
            part.entries(push);
        }
    }
}

/// States as they are in the file.
pub struct States {
    numbers: Vec<f64>,
}

impl States {
    fn read(path: &str) -> Self {
        let bytes = std::fs::read(path).expect("the file of states");
        let numbers = bytes.chunks_exact(8).map(|x| f64::from_le_bytes(x.try_into().expect("eight bytes")));
        Self { numbers: numbers.collect() }
    }

    /// In packs of as many as the scalar holds.
    pub fn of<const D: usize, S: Number>(&self) -> Vec<State<D, S>> {
        let width = 3 * D;
        self.numbers
            .chunks_exact(width * S::COUNT)
            .map(|pack| {
                let part = |part: usize| std::array::from_fn(|k| S::gather(|lane| pack[width * lane + D * part + k]));
                State { q: part(0), dq: part(1), ddq: part(2) }
            })
            .collect()
    }
}

/// A function with its states.
pub trait Timed {
    fn values(&self, count: usize) -> Vec<Vec<f64>>;
    fn pass(&self) -> Vec<f64>;
}

/// `call` at `states` with `parameters`, in the scalar `S`; `given` is what each state comes with, in an array of its own, as
/// a peer's sines are.
pub struct Case<X, T, P, R, S> {
    pub states: Vec<X>,
    pub given: Vec<T>,
    pub parameters: P,
    pub call: fn(&X, &T, &P) -> R,
    pub scalar: std::marker::PhantomData<S>,
}

impl<X, T, P, R: Entries<S>, S: Number> Timed for Case<X, T, P, R, S> {
    fn values(&self, count: usize) -> Vec<Vec<f64>> {
        let mut rows = Vec::new();
        for (state, given) in self.states.iter().zip(&self.given).take(count.div_ceil(S::COUNT)) {
            let mut lanes = vec![Vec::new(); S::COUNT];
            (self.call)(state, given, &self.parameters).entries(&mut |entry: S| {
                for (lane, row) in lanes.iter_mut().enumerate() {
                    row.push(entry.lane(lane));
                }
            });
            rows.extend(lanes);
        }
        rows.truncate(count);
        rows
    }

    fn pass(&self) -> Vec<f64> {
        // Not known where it is called: neither inlined nor specialized, as a function of another library.
        let (call, parameters) = (black_box(self.call), black_box(&self.parameters));
        let time = |(states, given): (&[X], &[T])| {
            let start = Instant::now();
            for (state, given) in states.iter().zip(given) {
                black_box(&call(state, given, parameters));
            }
            start.elapsed().as_nanos() as f64 / (states.len() * S::COUNT) as f64
        };
        let size = BLOCK / S::COUNT;
        let blocks = || self.states.chunks_exact(size).zip(self.given.chunks_exact(size));
        // One block to wake up.
        blocks().take(1).for_each(|block| _ = time(block));
        blocks().map(time).collect()
    }
}

/// A case by its name, made when it is first asked for.
pub type Maker = (&'static str, fn(&States) -> Box<dyn Timed>);

/// Answers until nobody asks.
pub fn serve(makers: &[Maker]) {
    let states = States::read(&std::env::args().nth(1).expect("the file of states"));
    let mut cases: Vec<Option<Box<dyn Timed>>> = makers.iter().map(|_| None).collect();
    let mut out = std::io::stdout().lock();
    for line in std::io::stdin().lock().lines() {
        let line = line.expect("text");
        let words: Vec<&str> = line.split(' ').collect();
        let known = makers.iter().position(|(name, _)| words.get(1) == Some(name));
        let Some(k) = known else {
            writeln!(out, "no case `{line}`").expect("somebody reads");
            out.flush().expect("somebody reads");
            continue;
        };
        let case = cases[k].get_or_insert_with(|| makers[k].1(&states));
        let rows = match words[0] {
            "values" => case.values(words[2].parse().expect("a count")),
            _ => vec![case.pass()],
        };
        for row in rows {
            let numbers: Vec<String> = row.iter().map(|x| format!("{x:e}")).collect();
            writeln!(out, "{}", numbers.join(" ")).expect("somebody reads");
        }
        out.flush().expect("somebody reads");
    }
}
