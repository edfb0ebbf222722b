//! The PHANTOM: eight lumped parameters, the regressor, the filtered regressor, the end point.

use nalgebra::DMatrix;
use robot_model_codegen::Block;
use robot_model_codegen::expr::Symbol;
use robot_model_codegen::interpreter::Program;
use robot_model_tests::evaluate::Interpreter;
use robot_model_tests::states::{self, State};

use super::{assert_close, interpreter, standard};

/// Lengths and gravity of the PHANTOM's spec.
const L: [f64; 7] = [f64::NAN, 0.215, 0.170, 0.0325, f64::NAN, -0.0368, 0.0527];
const G: f64 = 9.81;

/// Equation (5): the eight lumped parameters.
fn printed_lumps(p: impl Fn(&str) -> f64) -> [f64; 8] {
    let (l1, l2, l3) = (L[1], L[2], L[3]);
    [
        (4.0 * p("Ia_yy")
            + 4.0 * p("Ia_zz")
            + 8.0 * p("Ibase_yy")
            + 4.0 * p("Ibe_yy")
            + 4.0 * p("Ibe_zz")
            + 4.0 * p("Ic_yy")
            + 4.0 * p("Ic_zz")
            + 4.0 * p("Idf_yy")
            + 4.0 * p("Idf_zz")
            + l1 * l1 * p("m_c")
            + l2 * l2 * p("m_a")
            + 4.0 * l3 * l3 * p("m_c")
            + 4.0 * l1 * l1 * p("m_a"))
            / 8.0,
        (4.0 * p("Ibe_yy") - 4.0 * p("Ibe_zz") + 4.0 * p("Ic_yy") - 4.0 * p("Ic_zz")
            + 4.0 * l1 * l1 * p("m_a")
            + l1 * l1 * p("m_c"))
            / 8.0,
        (4.0 * p("Ia_yy") - 4.0 * p("Ia_zz") + 4.0 * p("Idf_yy")
            - 4.0 * p("Idf_zz")
            - l2 * l2 * p("m_a")
            - 4.0 * l3 * l3 * p("m_c"))
            / 8.0,
        l1 * (l2 * p("m_a") + l3 * p("m_c")),
        (4.0 * p("Ibe_xx") + 4.0 * p("Ic_xx") + 4.0 * l1 * l1 * p("m_a") + l1 * l1 * p("m_c"))
            / 4.0,
        (4.0 * p("Ia_xx") + 4.0 * p("Idf_xx") + l2 * l2 * p("m_a") + 4.0 * l3 * l3 * p("m_c"))
            / 4.0,
        G / 2.0 * (2.0 * l1 * p("m_a") + 2.0 * L[5] * p("m_be") + l1 * p("m_c")),
        G / 2.0 * (l2 * p("m_a") + 2.0 * l3 * p("m_c") - 2.0 * L[6] * p("m_df")),
    ]
}

/// Which of our base parameters is which of the paper's.
const LUMPS: [&str; 8] = [
    "Ibase_yyr",
    "Ibe_yyr",
    "Ia_yyr",
    "m_ar",
    "Ibe_xxr",
    "Ia_xxr",
    "m_ber",
    "m_cr",
];

/// Equation (4) in a state; `sign` is that of the centrifugal term in the row of the fourth parameter on the third joint,
/// printed as +1.
fn printed_regressor(state: &State, sign: f64) -> DMatrix<f64> {
    let [_, t2, t3] = state.q[..] else { panic!() };
    let [v1, v2, v3] = state.dq[..] else { panic!() };
    let [a1, a2, a3] = state.ddq[..] else {
        panic!()
    };
    let (s2, c2, s3, c3) = (t2.sin(), t2.cos(), t3.sin(), t3.cos());
    let (s23, c23) = ((t2 - t3).sin(), (t2 - t3).cos());
    let (s22, c22) = ((2.0 * t2).sin(), (2.0 * t2).cos());
    let (s33, c33) = ((2.0 * t3).sin(), (2.0 * t3).cos());
    let rows = [
        [a1, 0.0, 0.0],
        [
            a1 * c22 - 2.0 * v1 * v2 * s2 * c2 - v1 * v2 * s22,
            v1 * v1 * s22,
            0.0,
        ],
        [
            a1 * c33 - 2.0 * v1 * v3 * s3 * c3 - v1 * v3 * s33,
            0.0,
            v1 * v1 * s33,
        ],
        [
            a1 * c2 * s3 - v1 * v2 * s2 * s3 + v1 * v3 * c2 * c3,
            -0.5 * a3 * s23 + 0.5 * v1 * v1 * s2 * s3 + 0.5 * v3 * v3 * c23,
            -0.5 * a2 * s23 - 0.5 * v1 * v1 * c2 * c3 + sign * 0.5 * v2 * v2 * c23,
        ],
        [0.0, a2, 0.0],
        [0.0, 0.0, a3],
        [0.0, c2, 0.0],
        [0.0, 0.0, s3],
    ];
    DMatrix::from_fn(3, 8, |joint, k| rows[k][joint])
}

#[test]
fn phantom_lumps_fall_out_by_themselves() {
    let phantom = interpreter("phantom");
    let base = &phantom.compiled.base;
    let rigid: Vec<usize> = (0..base.kept.len())
        .filter(|&k| phantom.compiled.is_rigid(k))
        .collect();
    assert_eq!(rigid.len(), 8);
    let names = &phantom.compiled.model.energies().unwrap().parameters;
    // Linear in the parameters: one unit of each in turn.
    for one in names {
        let unit = |name: &str| f64::from(u8::from(name == one.name));
        let beta = base.beta(&standard(&phantom, unit));
        for (lump, printed) in LUMPS.into_iter().zip(printed_lumps(unit)) {
            let place = base.names.iter().position(|name| name == lump).unwrap();
            let difference = (beta[place] - printed).abs();
            assert!(
                difference < 1e-15,
                "{lump} of {}: {} {printed}",
                one.name,
                beta[place]
            );
        }
    }
}

/// The row of the fourth parameter on the third joint is printed with `+1/2 dth2^2 c23`; Lagrange gives `-1/2`, and only that
/// makes `dM/dt - 2 C` skew.
#[test]
fn phantom_regressor_is_that_of_the_paper_with_one_sign_corrected() {
    let phantom = interpreter("phantom");
    let mut random = states::generator(3);
    for _ in 0..20 {
        let state = states::state(&mut random, 3);
        let standard = states::physical(&mut random, &phantom.compiled.model);
        let base_regressor = phantom.forms(&standard, &state).base_regressor;
        let names = &phantom.compiled.base.names;
        let found = DMatrix::from_fn(3, 8, |joint, k| {
            let place = names.iter().position(|name| name == LUMPS[k]).unwrap();
            base_regressor[(joint, place)]
        });
        assert_close("Y", &found, &printed_regressor(&state, -1.0));
        let off = printed_regressor(&state, 1.0) - &found;
        let wanted = state.dq[1] * state.dq[1] * (state.q[1] - state.q[2]).cos();
        assert!((off[(2, 3)] - wanted).abs() < 1e-12, "{off} {wanted}");
    }
}

/// The columns of a block at a state, in the paper's order of the lumps.
fn lumps_of(phantom: &Interpreter, block: &Block, state: &State) -> DMatrix<f64> {
    let values = block.program.eval(&|symbol| match symbol {
        Symbol::Q(j) => state.q[j],
        Symbol::Dq(j) => state.dq[j],
        other => panic!("{other:?} in the filtered form"),
    });
    let names = &phantom.compiled.base.names;
    let mut dense = DMatrix::zeros(3, 8);
    for (&(joint, column), value) in block.entries.iter().zip(values) {
        if let Some(k) = LUMPS.iter().position(|lump| *lump == names[column]) {
            dense[(joint, k)] = value;
        }
    }
    dense
}

/// Equation (13), `Y_L = w (Y_p - {Y_p}_L) - {Y_h}_L`, as its two parts `Y_p` and `-Y_h`; `extra` is the factor of the term
/// `dth2^2 c23` that is printed in the row of the fourth parameter on the third joint.
fn printed_filtered(state: &State, extra: f64) -> (DMatrix<f64>, DMatrix<f64>) {
    let [_, t2, t3] = state.q[..] else { panic!() };
    let [v1, v2, v3] = state.dq[..] else { panic!() };
    let (s2, c2, s3, c3) = (t2.sin(), t2.cos(), t3.sin(), t3.cos());
    let (s23, c23) = ((t2 - t3).sin(), (t2 - t3).cos());
    let (s22, c22) = ((2.0 * t2).sin(), (2.0 * t2).cos());
    let (s33, c33) = ((2.0 * t3).sin(), (2.0 * t3).cos());
    let momentum = [
        [v1, 0.0, 0.0],
        [v1 * c22, 0.0, 0.0],
        [v1 * c33, 0.0, 0.0],
        [v1 * c2 * s3, -0.5 * v3 * s23, -0.5 * v2 * s23],
        [0.0, v2, 0.0],
        [0.0, 0.0, v3],
        [0.0; 3],
        [0.0; 3],
    ];
    let drift = [
        [0.0; 3],
        [0.0, v1 * v1 * s22, 0.0],
        [0.0, 0.0, v1 * v1 * s33],
        [
            0.0,
            0.5 * (v2 * v3 * c23 + v1 * v1 * s2 * s3),
            extra * v2 * v2 * c23 - 0.5 * v1 * v1 * c2 * c3 - 0.5 * v2 * v3 * c23,
        ],
        [0.0; 3],
        [0.0; 3],
        [0.0, c2, 0.0],
        [0.0, 0.0, s3],
    ];
    let matrix = |rows: [[f64; 3]; 8]| DMatrix::from_fn(3, 8, |joint, k| rows[k][joint]);
    (matrix(momentum), matrix(drift))
}

/// Equation (13) inherits the misprint of (4): its `{dth2^2 c23}_L` on the third joint is not there.
#[test]
fn phantom_filtered_regressor_is_that_of_the_paper_without_one_term() {
    let phantom = interpreter("phantom");
    let (momentum, drift) = (
        phantom.compiled.base_momentum(),
        phantom.compiled.rigid_drift(),
    );
    let mut random = states::generator(4);
    for _ in 0..20 {
        let state = states::state(&mut random, 3);
        let found = lumps_of(&phantom, &momentum, &state);
        let (wanted, other) = printed_filtered(&state, 0.0);
        assert_close("Y_p", &found, &wanted);
        let found = -lumps_of(&phantom, &drift, &state);
        assert_close("-Y_h", &found, &other);
        let off = (printed_filtered(&state, 1.0).1 - &found)[(2, 3)];
        let wanted = state.dq[1] * state.dq[1] * (state.q[1] - state.q[2]).cos();
        assert!((off - wanted).abs() < 1e-12, "{off} {wanted}");
    }
}

/// Equation (21) is the Jacobian of the end point in a frame of its own: lengths and angles of its columns are ours.
#[test]
fn phantom_end_point_moves_as_in_the_paper() {
    let phantom = interpreter("phantom");
    let tip = &phantom.compiled.points[0];
    let program = Program::new(&phantom.compiled.dag, &tip.jacobian.concat());
    let mut random = states::generator(5);
    for _ in 0..20 {
        let state = states::state(&mut random, 3);
        let values = program.eval(&|symbol| match symbol {
            Symbol::Q(j) => state.q[j],
            other => panic!("{other:?}"),
        });
        let found = DMatrix::from_row_slice(3, 3, &values);
        let (t2, t3) = (state.q[1], state.q[2]);
        let (l1, l2) = (L[1], L[2]);
        let printed = DMatrix::from_row_slice(
            3,
            3,
            &[
                l1 * t2.cos() + l2 * t3.sin(),
                0.0,
                0.0,
                0.0,
                l1 * (t2 - t3).cos(),
                0.0,
                0.0,
                -l1 * (t2 - t3).sin(),
                l2,
            ],
        );
        let products = |jacobian: &DMatrix<f64>| jacobian.transpose() * jacobian;
        assert_close("(21)", &products(&found), &products(&printed));
    }
}
