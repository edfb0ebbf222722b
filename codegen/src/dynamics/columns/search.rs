//! Where wrenches best meet axes: all ways have the same values, the one with the fewest operations is taken.

use super::{Columns, Meet, Way, columns};
use crate::dynamics::chain::Chain;
use crate::dynamics::computed::operations;
use crate::expr::Dag;

/// Longer chains take the best of those ways that treat all links alike.
const LONGEST: usize = 10;

impl Way {
    /// The way with the fewest operations for the `wanted` links and elements, one decision after the other. The same chain gives
    /// the same way. `dag` is where the chain's expressions are; trials are built on copies of it.
    pub fn best(dag: &Dag, chain: &Chain, wanted: &dyn Fn(usize, usize) -> bool) -> Self {
        let links = chain.frames.len();
        let cost = |way: &Way| {
            let mut dag = dag.clone();
            let columns = columns(&mut dag, chain, way, wanted);
            let wanted = |link: usize, column: &Columns| -> Vec<_> {
                let elements = (0..10).filter(|&element| wanted(link, element));
                elements
                    .flat_map(|element| column[element].clone())
                    .collect()
            };
            let links = columns.iter().enumerate();
            let entries: Vec<_> = links
                .flat_map(|(link, column)| wanted(link, column))
                .collect();
            operations(&dag, &entries)
        };
        // At the joints that all wrenches pass, or in the links themselves.
        let near = (0..links).flat_map(|joint| {
            let meets = (0..links).map(move |link| Meet {
                link: joint.min(link),
                at_joint: true,
            });
            [true, false].map(|from_parents| Way {
                from_parents,
                meets: meets.clone().collect(),
            })
        });
        let own = [true, false].map(|from_parents| Way {
            from_parents,
            meets: (0..links)
                .map(|link| Meet {
                    link,
                    at_joint: false,
                })
                .collect(),
        });
        let alike = near.chain(own).map(|way| (cost(&way), way));
        let Some((mut fewest, mut best)) = alike.min_by_key(|(cost, _)| *cost) else {
            return Self::default();
        };
        if links > LONGEST {
            return best;
        }
        for link in (0..links).rev() {
            for (place, at_joint) in (0..=link).flat_map(|place| [(place, true), (place, false)]) {
                let mut way = best.clone();
                way.meets[link] = Meet {
                    link: place,
                    at_joint,
                };
                let cost = cost(&way);
                if cost < fewest {
                    (fewest, best) = (cost, way);
                }
            }
        }
        best
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::rigid::RigidBody;
    use crate::dynamics::{Value, parameter_expressions};
    use crate::expr::Symbol;

    fn value(symbol: Symbol) -> f64 {
        match symbol {
            Symbol::Q(k) => 0.3 + (1.7 * k as f64).sin(),
            Symbol::Dq(k) => 0.9 * (1.1 + 2.3 * k as f64).sin(),
            Symbol::Ddq(k) => 1.9 * (0.4 + 3.1 * k as f64).cos(),
            _ => unreachable!("columns are of the motion"),
        }
    }

    /// Turning and sliding joints, with and without axes along those of the frames, in each way.
    #[test]
    fn all_ways_have_the_same_values() {
        for (kinds, alphas) in [
            (["revolute"; 4], ["90 deg", "0", "-90 deg", "0"]),
            (["revolute"; 4], ["90 deg", "-90 deg", "90 deg", "20 deg"]),
            (
                ["revolute", "prismatic", "revolute", "prismatic"],
                ["0", "90 deg", "30 deg", "0"],
            ),
        ] {
            let joint = |k: usize| {
                let (kind, alpha) = (kinds[k], alphas[k]);
                let own = if kind == "revolute" { "d" } else { "theta" };
                format!("joint j{k}: {kind} {{ a = 0.{k}; alpha = {alpha}; {own} = 0.2; }}\n")
            };
            let joints: String = (0..4).map(joint).collect();
            let text = format!(
                "robot Arm {{ gravity = [0.3, 0, -9.81]; convention = standard_dh;\n{joints}}}\n"
            );
            let model = robot_model_spec::load("arm", &text).unwrap_or_else(|e| panic!("{e}"));
            let mut dag = Dag::new();
            let parameters = parameter_expressions(&mut dag, &[Value::Symbol; 40]);
            let RigidBody::Chain(chain) = RigidBody::new(&mut dag, &model, None, &parameters)
            else {
                panic!("an arm is a chain");
            };
            let mut values = |from_parents: bool, meet: Meet| -> Vec<f64> {
                let meets = (0..4).map(|link| Meet {
                    link: meet.link.min(link),
                    ..meet
                });
                let way = Way {
                    from_parents,
                    meets: meets.collect(),
                };
                let columns = columns(&mut dag, &chain, &way, &|_, _| true);
                let entries = columns.iter().flatten().flatten();
                entries.map(|&x| dag.evaluate(x, &value)).collect()
            };
            let to_the_base = Meet {
                link: 0,
                at_joint: true,
            };
            let wanted = values(false, to_the_base);
            assert!(wanted.iter().any(|x| x.abs() > 1.0));
            for (link, at_joint) in (0..4).flat_map(|link| [(link, true), (link, false)]) {
                for from_parents in [false, true] {
                    let found = values(from_parents, Meet { link, at_joint });
                    let worst = found.iter().zip(&wanted).map(|(x, y)| (x - y).abs());
                    // Sums of some ten terms of about 10.
                    assert!(worst.fold(0.0, f64::max) < 1e-12, "{text}{link} {at_joint}");
                }
            }
        }
    }
}
