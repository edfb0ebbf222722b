//! Whether the arm has an inertia in every direction of motion, wherever it stands.

use nalgebra::DMatrix;
use robot_model_codegen::Compiled;
use robot_model_codegen::expr::Symbol;
use robot_model_codegen::interpreter::Program;

use super::workspace::{POSES, descend, pose, workspace};
use super::{Check, Quantity};

/// The worst poses by each measure, from which the search goes on.
const SEARCHED: usize = 5;

/// Eigenvalues below this share of the largest are zero.
const ROUNDING: f64 = 1e-9;

/// Of all parameters, as [`Compiled::parameter_values`] gives them, and of shapes.
pub(super) fn check(compiled: &Compiled, parameters: &[f64], shapes: &[f64]) -> Check {
    let workspace = workspace(compiled);
    let inertia = Inertia {
        program: compiled.inertia_at_rest(),
        parameters,
        shapes,
    };
    let (least, pose) = inertia.worst(&workspace);
    let rounding = ROUNDING * inertia.eigenvalues(&pose).1.abs();
    let at: Vec<String> = pose.iter().map(|q| format!("{q:.4}")).collect();
    let found = format!("{least:.4e} at q = [{}]", at.join(", "));
    let scope = format!("least eigenvalue of the mass matrix found in the workspace: {found}");
    let findings = if least > rounding {
        Vec::new()
    } else if least >= -rounding {
        let at = at.join(", ");
        let said = format!("the mass matrix is singular: some motion has no inertia at q = [{at}]");
        vec![(said, Vec::new())]
    } else {
        let said = format!(
            "the mass matrix is not positive definite: least eigenvalue {found}; a simulated arm would accelerate against the applied torque"
        );
        vec![(said, Vec::new())]
    };
    let mut check = Check::new("inertia", scope, findings);
    // Told whether it speaks against the arm or not; units differ where slides are among the joints.
    let least = Quantity::of_all("least_eigenvalue", least, "");
    let joints = compiled.model.joints.iter().zip(&pose);
    let at = joints.map(|(joint, q)| Quantity::of("position", &joint.name, *q, ""));
    check.quantities = std::iter::once(least).chain(at).collect();
    check
}

struct Inertia<'a> {
    program: Program,
    parameters: &'a [f64],
    shapes: &'a [f64],
}

/// What a search goes down. The least eigenvalue is that of the lightest joint nearly everywhere, and says nothing of one that is heavy
/// elsewhere and next to nothing at a few poses; scaled inertias of joints are of one size.
#[derive(Clone, Copy)]
enum Measure<'a> {
    Least,
    /// Least eigenvalue of `S^-1/2 M S^-1/2` with the largest inertia of each joint that was seen, `S`.
    Scaled(&'a [f64]),
    /// A joint's own inertia.
    Diagonal(usize),
}

impl Inertia<'_> {
    /// The least eigenvalue that is found, and where.
    fn worst(&self, workspace: &[(f64, f64)]) -> (f64, Vec<f64>) {
        let poses: Vec<Vec<f64>> = (0..POSES).map(|k| pose(workspace, k)).collect();
        let matrices: Vec<DMatrix<f64>> = poses.iter().map(|pose| self.matrix(pose)).collect();
        let joints = 0..workspace.len();
        let largest = |joint: usize| {
            let all = matrices.iter().map(|matrix| matrix[(joint, joint)].abs());
            let most = all.fold(0.0, f64::max);
            // What nothing resists anywhere has no size.
            if most > 0.0 { most } else { 1.0 }
        };
        let largest: Vec<f64> = joints.clone().map(largest).collect();
        let measures = [Measure::Least, Measure::Scaled(&largest)].into_iter();
        let measures = measures.chain(joints.map(Measure::Diagonal));
        let found = measures.flat_map(|measure| {
            let mut order: Vec<(f64, usize)> = matrices
                .iter()
                .enumerate()
                .map(|(k, matrix)| (measure.of(matrix), k))
                .collect();
            order.sort_by(|x, y| x.0.total_cmp(&y.0));
            order.truncate(SEARCHED);
            let descended = order.into_iter();
            descended
                .map(|(_, k)| {
                    let value = |pose: &[f64]| measure.of(&self.matrix(pose));
                    descend(workspace, poses[k].clone(), &value)
                })
                .collect::<Vec<_>>()
        });
        let found = found.map(|pose| (self.eigenvalues(&pose).0, pose));
        let worst = found.min_by(|x, y| x.0.total_cmp(&y.0));
        worst.unwrap_or_default()
    }

    fn matrix(&self, pose: &[f64]) -> DMatrix<f64> {
        let entries = self.program.eval(&|symbol| match symbol {
            Symbol::Q(joint) => pose[joint],
            Symbol::Parameter(k) => self.parameters[k],
            Symbol::Shape(k) => self.shapes[k],
            _ => 0.0,
        });
        let matrix = DMatrix::from_row_slice(pose.len(), pose.len(), &entries);
        0.5 * (&matrix + matrix.transpose())
    }

    /// Least and largest eigenvalue at a pose.
    fn eigenvalues(&self, pose: &[f64]) -> (f64, f64) {
        let values = self.matrix(pose).symmetric_eigenvalues();
        (values.min(), values.max())
    }
}

impl Measure<'_> {
    fn of(self, matrix: &DMatrix<f64>) -> f64 {
        match self {
            Self::Least => matrix.symmetric_eigenvalues().min(),
            Self::Scaled(largest) => {
                let scaled = DMatrix::from_fn(matrix.nrows(), matrix.ncols(), |i, k| {
                    matrix[(i, k)] / (largest[i].sqrt() * largest[k].sqrt())
                });
                scaled.symmetric_eigenvalues().min()
            }
            Self::Diagonal(joint) => matrix[(joint, joint)],
        }
    }
}
