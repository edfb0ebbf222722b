//! Names for shared parts, so that an equation of a large arm stays a page.

use std::collections::BTreeMap;

use robot_model_codegen::expr::{Dag, ExprId, Names, Node, Symbol};

/// Equations with no entry longer than this many operations and operands are written out.
const WRITTEN_OUT: f64 = 120.0;

/// A part that occurs twice gets a name if it has at least this many operations and operands.
const WORTH_A_NAME: f64 = 4.0;

/// Equations whose long shared parts have names.
pub(super) struct Shared {
    pub dag: Dag,
    pub names: Names,
    /// Name and meaning, in the order of their use.
    pub parts: Vec<(String, ExprId)>,
    /// The equations, in the order in which they were given.
    pub roots: Vec<ExprId>,
}

/// Names what `roots` share, unless they are short enough without.
pub(super) fn share(dag: &Dag, names: &Names, roots: &[ExprId]) -> Shared {
    let order = dag.reachable(roots);
    let mut sizes = vec![0.0_f64; dag.len()];
    let mut uses = vec![0_usize; dag.len()];
    for &x in &order {
        sizes[x.index()] = 1.0
            + dag
                .node(x)
                .operands()
                .map(|operand| sizes[operand.index()])
                .sum::<f64>();
        dag.node(x)
            .operands()
            .for_each(|operand| uses[operand.index()] += 1);
    }
    for root in roots {
        uses[root.index()] += 1;
    }
    if roots.iter().all(|root| sizes[root.index()] <= WRITTEN_OUT) {
        return Shared {
            dag: dag.clone(),
            names: names.clone(),
            parts: Vec::new(),
            roots: roots.to_vec(),
        };
    }

    let mut shared = Shared {
        dag: Dag::new(),
        names: names.clone(),
        parts: Vec::new(),
        roots: Vec::new(),
    };
    // Each expression in the new dag, with its size there.
    let mut copies: BTreeMap<ExprId, (ExprId, f64)> = BTreeMap::new();
    for x in order {
        let size = 1.0
            + dag
                .node(x)
                .operands()
                .map(|operand| copies[&operand].1)
                .sum::<f64>();
        let copy = shared.copy(dag.node(x), |operand| copies[&operand].0);
        let entry = if uses[x.index()] > 1 && size >= WORTH_A_NAME {
            (shared.name(copy), 1.0)
        } else {
            (copy, size)
        };
        copies.insert(x, entry);
    }
    shared.roots = roots.iter().map(|root| copies[root].0).collect();
    shared
}

impl Shared {
    fn copy(&mut self, node: Node, copied: impl Fn(ExprId) -> ExprId) -> ExprId {
        let dag = &mut self.dag;
        match node {
            Node::Constant(value) => dag.constant(value.get()),
            Node::Symbol(symbol) => dag.symbol(symbol),
            Node::Add(x, y) => dag.add(copied(x), copied(y)),
            Node::Mul(x, y) => dag.mul(copied(x), copied(y)),
            Node::Power(x, y) => dag.power(copied(x), copied(y)),
            Node::Call(function, x) => dag.call(function, copied(x)),
        }
    }

    /// A symbol that stands for `part`.
    fn name(&mut self, part: ExprId) -> ExprId {
        let name = format!("t{}", self.parts.len() + 1);
        self.parts.push((name.clone(), part));
        self.names.parameters.push(name);
        self.dag
            .symbol(Symbol::Parameter(self.names.parameters.len() - 1))
    }
}
