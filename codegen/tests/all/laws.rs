//! Laws of the derived equations on robots small and large: what holds whatever the numbers are.

use robot_model_codegen::expr::Symbol;
use robot_model_codegen::{Compiled, compile_model};
use robot_model_spec::parameter::{Owner, Status};

const ROBOTS: [&str; 5] = ["two_link", "slider", "puma560", "ur10", "panda"];

fn compiled(robot: &str) -> Compiled {
    let path = format!(
        "{}/../tests/specs/pass/{robot}.robot",
        env!("CARGO_MANIFEST_DIR")
    );
    let text = std::fs::read_to_string(&path).expect("the spec is in the repository");
    let model = robot_model_spec::load(&path, &text).unwrap_or_else(|errors| panic!("{errors}"));
    compile_model(&model)
}

/// A state without special values, and physical parameters: rods along a skew direction, positive effect parameters.
struct Case {
    q: Vec<f64>,
    dq: Vec<f64>,
    ddq: Vec<f64>,
    standard: Vec<f64>,
}

impl Case {
    fn new(model: &Compiled, seed: f64) -> Self {
        let series = |first: f64| {
            (0..model.dof())
                .map(|k| (first + 1.7 * k as f64 + seed).sin())
                .collect()
        };
        let inertials = (0..model.dof()).flat_map(|k| {
            let (m, c) = (3.0 - 0.3 * k as f64, [0.11, -0.07, 0.05 + 0.02 * k as f64]);
            let square: f64 = c.iter().map(|x| x * x).sum();
            let inertia = |i: usize, j: usize| {
                if i == j {
                    m * (square - c[i] * c[i]) + 0.02
                } else {
                    -m * c[i] * c[j]
                }
            };
            let moments = [
                inertia(0, 0),
                inertia(0, 1),
                inertia(0, 2),
                inertia(1, 1),
                inertia(1, 2),
                inertia(2, 2),
            ];
            [m, m * c[0], m * c[1], m * c[2]].into_iter().chain(moments)
        });
        let mut standard: Vec<f64> = inertials.collect();
        standard.resize(model.standard.len(), 0.4);
        for (value, parameter) in standard.iter_mut().zip(&model.standard) {
            if let Status::Fixed(fixed) = parameter.status {
                *value = fixed;
            }
        }
        Self {
            q: series(0.3),
            dq: series(1.1),
            ddq: series(2.3),
            standard,
        }
    }

    fn bind<'a>(
        &'a self,
        parameters: &'a [f64],
        rigid_torque: &'a [f64],
    ) -> impl Fn(Symbol) -> f64 + 'a {
        move |symbol| match symbol {
            Symbol::Q(j) => self.q[j],
            Symbol::Dq(j) => self.dq[j],
            Symbol::Ddq(j) => self.ddq[j],
            Symbol::RigidTorque(j) => rigid_torque[j],
            Symbol::Time => 0.7,
            Symbol::Parameter(k) => parameters[k],
            Symbol::Shape(_) => 0.1,
            Symbol::MeasuredTorque(_)
            | Symbol::Input(_)
            | Symbol::State(_)
            | Symbol::Switch(_)
            | Symbol::Weight(_) => 0.3,
        }
    }
}

fn for_all(law: impl Fn(&str, &Compiled, &Case)) {
    for robot in ROBOTS {
        let model = compiled(robot);
        for seed in [0.0, 0.9, 4.2] {
            law(robot, &model, &Case::new(&model, seed));
        }
    }
}

fn matrix(flat: &[f64]) -> nalgebra::DMatrix<f64> {
    let n = flat.len().isqrt();
    nalgebra::DMatrix::from_row_slice(n, n, flat)
}

fn assert_close(robot: &str, what: &str, x: f64, y: f64, scale: f64, tolerance: f64) {
    assert!(
        (x - y).abs() <= tolerance * (1.0 + scale.abs()),
        "{robot}: {what}: {x} and {y}"
    );
}

#[test]
fn the_mass_matrix_is_symmetric_and_positive_definite() {
    for_all(|robot, model, case| {
        let parameters = model.parameter_values(&model.base.beta(&case.standard));
        let m = matrix(&model.mass_matrix().eval(&case.bind(&parameters, &[])));
        assert_eq!(m, m.transpose(), "{robot}");
        assert!(m.cholesky().is_some(), "{robot}");
    });
}

#[test]
fn the_rate_of_the_mass_matrix_less_twice_coriolis_is_skew() {
    for_all(|robot, model, case| {
        let parameters = model.parameter_values(&model.base.beta(&case.standard));
        let program = model.mass_matrix();
        let mass_matrix_at = |t: f64| {
            let q = case
                .q
                .iter()
                .zip(&case.dq)
                .map(|(q, dq)| q + t * dq)
                .collect();
            let moved = Case {
                q,
                dq: case.dq.clone(),
                ddq: case.ddq.clone(),
                standard: Vec::new(),
            };
            matrix(&program.eval(&moved.bind(&parameters, &[])))
        };
        let h = 1e-5;
        let rate = (mass_matrix_at(h) - mass_matrix_at(-h)) / (2.0 * h);
        let n = rate - 2.0 * matrix(&model.coriolis_matrix().eval(&case.bind(&parameters, &[])));
        let skew = (&n + n.transpose()).amax();
        assert_close(robot, "skew", skew, 0.0, n.amax(), 1e-7);
    });
}

#[test]
fn torque_is_inertia_plus_coriolis_plus_gravity_plus_effects() {
    for_all(|robot, model, case| {
        let parameters = model.parameter_values(&model.base.beta(&case.standard));
        let bind = case.bind(&parameters, &[]);
        let m = matrix(&model.mass_matrix().eval(&bind));
        let c = matrix(&model.coriolis_matrix().eval(&bind));
        let g = model.gravity().eval(&bind);
        let rigid = model.rigid_torque().eval(&bind);
        for i in 0..model.dof() {
            let sum: f64 = (0..model.dof())
                .map(|j| m[(i, j)] * case.ddq[j] + c[(i, j)] * case.dq[j])
                .sum();
            assert_close(robot, "rigid torque", sum + g[i], rigid[i], rigid[i], 1e-12);
        }
    });
}

/// `M` and `G` against energies from link poses: a second derivation that shares nothing with the recursion.
#[test]
fn gravity_is_the_gradient_of_potential_energy_and_mass_gives_kinetic_energy() {
    for_all(|robot, model, case| {
        // Effects off: a rotor's inertia regroups into a link's.
        let mut standard = case.standard.clone();
        for (value, parameter) in standard.iter_mut().zip(&model.standard) {
            if matches!(parameter.owner, Owner::Effect { .. }) {
                *value = 0.0;
            }
        }
        let parameters = model.parameter_values(&model.base.beta(&standard));
        let bind = case.bind(&parameters, &[]);
        let g = model.gravity().eval(&bind);
        let h = 1e-5;
        for joint in 0..model.dof() {
            let potential_at = |step: f64| {
                let mut q = case.q.clone();
                q[joint] += step;
                poses::potential_energy(model, &q, &standard)
            };
            let numeric = (potential_at(h) - potential_at(-h)) / (2.0 * h);
            assert_close(robot, "gravity", numeric, g[joint], g[joint], 1e-7);
        }
        let m = matrix(&model.mass_matrix().eval(&bind));
        let dq = nalgebra::DVector::from_column_slice(&case.dq);
        let kinetic = 0.5 * (dq.transpose() * m * &dq)[(0, 0)];
        let numeric = poses::kinetic_energy(model, &case.q, &case.dq, &standard);
        assert_close(robot, "kinetic energy", numeric, kinetic, kinetic, 1e-7);
    });
}

#[test]
fn regressor_and_base_regressor_give_the_inverse_dynamics() {
    for_all(|robot, model, case| {
        let beta = model.base.beta(&case.standard);
        let parameters = model.parameter_values(&beta);
        let rigid = model.rigid_torque().eval(&case.bind(&parameters, &[]));
        let bind = case.bind(&parameters, &rigid);
        let tau = model.inverse_dynamics().eval(&bind);
        // The base regressor has no columns for what the spec fixes.
        let known = model.known_torque().eval(&bind);
        let nothing = vec![0.0; model.dof()];
        for (block, values, mut sum) in [
            (model.regressor(), &case.standard, nothing),
            (model.base_regressor(), &beta, known),
        ] {
            for (&(joint, column), entry) in block.entries.iter().zip(block.program.eval(&bind)) {
                sum[joint] += entry * values[column];
            }
            for joint in 0..model.dof() {
                assert_close(robot, "tau", sum[joint], tau[joint], tau[joint], 1e-10);
            }
        }
    });
}

#[test]
fn the_interpreter_agrees_with_direct_evaluation_in_every_lane() {
    use robot_model_codegen::interpreter::Operand;
    for_all(|robot, model, case| {
        let parameters = model.parameter_values(&model.base.beta(&case.standard));
        let program = model.inverse_dynamics();
        // Not a multiple of the block, so that the last block is short.
        let len: u32 = 150;
        let column = |x: f64| {
            (0..len)
                .map(|k| x + 0.01 * f64::from(k))
                .collect::<Vec<f64>>()
        };
        let columns = |xs: &[f64]| xs.iter().map(|&x| column(x)).collect::<Vec<_>>();
        let (q, dq, ddq) = (columns(&case.q), columns(&case.dq), columns(&case.ddq));
        let bind = |symbol: Symbol| match symbol {
            Symbol::Q(j) => Operand::Column(&q[j]),
            Symbol::Dq(j) => Operand::Column(&dq[j]),
            Symbol::Ddq(j) => Operand::Column(&ddq[j]),
            other => Operand::Constant(case.bind(&parameters, &[])(other)),
        };
        let mut out = vec![Vec::new(); model.dof()];
        program.eval_batch(150, &bind, &mut out);
        for sample in [0, 63, 64, 149] {
            let at = |symbol| match bind(symbol) {
                Operand::Column(values) => values[sample],
                Operand::Constant(value) => value,
            };
            let direct = model
                .dag
                .evaluate_all(&model.dynamics.inverse_dynamics, &at);
            for joint in 0..model.dof() {
                assert_close(
                    robot,
                    "interpreter",
                    out[joint][sample],
                    direct[joint],
                    direct[joint],
                    1e-13,
                );
            }
        }
    });
}

#[test]
fn base_parameters_are_as_many_as_the_literature_says() {
    for (robot, count) in [("puma560", 36), ("ur10", 36), ("panda", 43)] {
        let model = compiled(robot);
        let rigid = (0..model.base.kept.len())
            .filter(|&column| model.is_rigid(column))
            .count();
        assert_eq!(rigid, count, "{robot}: {}", model.base.rank);
    }
}

/// Link poses by plain matrix products, straight from the meaning of a placement.
mod poses {
    use nalgebra::{Isometry3, Matrix3, Rotation3, Translation3, Unit, UnitQuaternion, Vector3};
    use robot_model_codegen::Compiled;
    use robot_model_spec::model::{JointKind, Transform};

    fn isometry(transform: &Transform) -> Isometry3<f64> {
        let r = Matrix3::from_fn(|i, j| transform.rotation[i][j]);
        let rotation = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(r));
        Isometry3::from_parts(
            Translation3::from(Vector3::from(transform.translation)),
            rotation,
        )
    }

    fn link_poses(model: &Compiled, q: &[f64]) -> Vec<Isometry3<f64>> {
        let mut pose = Isometry3::identity();
        let links = &model.model.chain().unwrap().links;
        let joints = model.model.joints.iter().zip(links).zip(q);
        joints
            .map(|((joint, link), q)| {
                let placement = &link.placement;
                let axis = Vector3::from(placement.axis);
                let motion = match joint.kind {
                    JointKind::Revolute => Isometry3::from_parts(
                        Translation3::identity(),
                        UnitQuaternion::from_axis_angle(
                            &Unit::new_normalize(axis),
                            q + placement.offset,
                        ),
                    ),
                    JointKind::Prismatic => Isometry3::from_parts(
                        Translation3::from(axis * (q + placement.offset)),
                        UnitQuaternion::identity(),
                    ),
                };
                pose = pose * isometry(&placement.before) * motion * isometry(&placement.after);
                pose
            })
            .collect()
    }

    pub fn potential_energy(model: &Compiled, q: &[f64], standard: &[f64]) -> f64 {
        let gravity = Vector3::from(model.model.chain().unwrap().gravity);
        let links = link_poses(model, q).into_iter().zip(standard.chunks(10));
        links
            .map(|(pose, p)| {
                let moment =
                    pose.rotation * Vector3::new(p[1], p[2], p[3]) + p[0] * pose.translation.vector;
                -gravity.dot(&moment)
            })
            .sum()
    }

    /// Velocities by differences of poses.
    pub fn kinetic_energy(model: &Compiled, q: &[f64], dq: &[f64], standard: &[f64]) -> f64 {
        let h = 1e-5;
        let moved = |t: f64| {
            link_poses(
                model,
                &q.iter()
                    .zip(dq)
                    .map(|(q, dq)| q + t * dq)
                    .collect::<Vec<_>>(),
            )
        };
        let (before, here, after) = (moved(-h), moved(0.0), moved(h));
        let mut energy = 0.0;
        for (link, p) in standard.chunks(10).take(here.len()).enumerate() {
            let rotation = here[link].rotation;
            let v = (after[link].translation.vector - before[link].translation.vector) / (2.0 * h);
            let v = rotation.inverse() * v;
            let w = rotation.inverse()
                * ((after[link].rotation * before[link].rotation.inverse()).scaled_axis()
                    / (2.0 * h));
            let moment = Vector3::new(p[1], p[2], p[3]);
            let inertia = Matrix3::new(p[4], p[5], p[6], p[5], p[7], p[8], p[6], p[8], p[9]);
            energy += 0.5 * p[0] * v.norm_squared()
                + v.dot(&w.cross(&moment))
                + 0.5 * w.dot(&(inertia * w));
        }
        energy
    }
}
