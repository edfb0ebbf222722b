use super::*;

/// `|| x - b ||^2 / 2` over parameters, each for itself an unknown.
fn identity(b: &[f64]) -> Mat<f64> {
    let n = b.len();
    Mat::from_fn(n, n + 1, |i, k| {
        if k == n {
            b[i]
        } else if i == k {
            1.0
        } else {
            0.0
        }
    })
}

/// A link whose ten parameters are all unknowns.
fn one_link(nominal: Option<[f64; 10]>) -> PossibleArms {
    PossibleArms {
        names: (0..10).map(|k| format!("p{k}")).collect(),
        fixed: vec![None; 10],
        combinations: (0..10).map(|k| vec![(k, 1.0)]).collect(),
        kept: (0..10).collect(),
        links: vec![PossibleLink {
            name: "link".to_owned(),
            parameters: std::array::from_fn(|k| k),
            nominal,
        }],
        nonnegative: Vec::new(),
    }
}

const BODY: [f64; 10] = [2.0, 0.4, -0.1, 0.2, 0.5, 0.02, -0.04, 0.6, 0.01, 0.4];

#[test]
fn a_body_that_can_be_stays() {
    // In units of a deviation of 1e-4.
    let b: Vec<f64> = BODY.iter().map(|x| x * 1e4).collect();
    let mut factor = identity(&b);
    for k in 0..10 {
        factor[(k, k)] = 1e4;
    }
    let nearest = one_link(None).nearest(&factor);
    for (found, wanted) in nearest.standard.iter().zip(BODY) {
        assert!((found - wanted).abs() < 1e-7, "{found} {wanted}");
    }
}

/// Of matrices `[[S, h], [h^T, m]]`, in the metric that counts their entries, the nearest has the eigenvalues that are
/// not negative.
#[test]
fn the_nearest_body_is_the_projection() {
    let mut impossible = BODY;
    impossible[4] = 1.3; // more than `iyy + izz`
    let matrix = pseudo_inertia(&impossible);
    let eigen = matrix.self_adjoint_eigen(Side::Lower).expect("symmetric");
    let values: Vec<f64> = eigen.S().column_vector().iter().copied().collect();
    assert!(values[0] < -0.05, "{values:?}");
    let clipped = Mat::from_fn(4, 4, |i, j| eigen.U()[(i, j)] * values[j].max(0.0));
    let wanted = clipped * eigen.U().transpose();
    // Rows are entries of the pseudo-inertia, in units of a deviation of 1e-3.
    let rows: Vec<Mat<f64>> = (0..10)
        .map(|k| {
            let mut unit = [0.0; 10];
            unit[k] = 1.0;
            pseudo_inertia(&unit)
        })
        .collect();
    let factor = Mat::from_fn(16, 11, |row, k| {
        let (i, j) = (row / 4, row % 4);
        1e3 * if k == 10 {
            matrix[(i, j)]
        } else {
            rows[k][(i, j)]
        }
    });
    let nearest = one_link(None).nearest(&factor);
    let ten: [f64; 10] = nearest.standard.try_into().expect("ten");
    let found = pseudo_inertia(&ten);
    for i in 0..4 {
        for j in 0..4 {
            let (found, wanted) = (found[(i, j)], wanted[(i, j)]);
            assert!((found - wanted).abs() < 1e-6, "{i} {j}: {found} {wanted}");
        }
    }
    let least = Inertial::from(ten)
        .pseudo_inertia()
        .symmetric_eigenvalues()
        .min();
    assert!(least > 0.0, "{least}");
    assert!(nearest.gap < 1e-4 && nearest.steps < 200);
}

/// What the logs do not tell is that of CAD; what they tell of a combination is kept.
#[test]
fn where_the_logs_are_silent_there_is_cad() {
    let mut arms = one_link(Some(BODY));
    // Only `izz + 2 m` is told, and it is 0.1 more than that of CAD.
    arms.combinations = vec![vec![(9, 1.0), (0, 2.0)]];
    arms.kept = vec![9];
    let told = BODY[9] + 2.0 * BODY[0] + 0.1;
    let factor = Mat::from_fn(1, 2, |_, k| if k == 0 { 1e5 } else { 1e5 * told });
    let nearest = arms.nearest(&factor);
    assert!(
        (nearest.estimate[0] - told).abs() < 1e-6,
        "{:?}",
        nearest.estimate
    );
    let standard = &nearest.standard;
    assert!((standard[9] + 2.0 * standard[0] - told).abs() < 1e-6);
    for (k, (found, cad)) in standard.iter().zip(BODY).enumerate() {
        assert!((found - cad).abs() < 0.1, "{k}: {found} {cad}");
    }
    // And without any told, CAD itself.
    let silent = arms.nearest(&Mat::zeros(1, 2));
    for (found, cad) in silent.standard.iter().zip(BODY) {
        assert!((found - cad).abs() < 1e-4, "{found} {cad}");
    }
}

#[test]
fn a_body_of_cad_without_an_inside_is_one_with() {
    // A point of 2 kg, and nothing at all.
    for nominal in [
        [2.0, 0.2, 0.0, 0.0, 0.0, 0.0, 0.0, 0.02, 0.0, 0.02],
        [0.0; 10],
    ] {
        let arms = one_link(Some(nominal));
        let silent = arms.nearest(&Mat::zeros(10, 11));
        let ten: [f64; 10] = silent.standard.try_into().expect("ten");
        assert!(
            Inertial::from(ten)
                .pseudo_inertia()
                .symmetric_eigenvalues()
                .min()
                > 0.0
        );
    }
}

#[test]
fn friction_takes_energy() {
    let mut arms = one_link(None);
    arms.links.clear();
    arms.nonnegative = vec![0, 1];
    let b: Vec<f64> = [-0.3, 0.7, -0.2, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]
        .map(|x| 1e3 * x)
        .to_vec();
    let mut factor = identity(&b);
    for k in 0..10 {
        factor[(k, k)] = 1e3;
    }
    let found = arms.nearest(&factor).standard;
    assert!((0.0..1e-6).contains(&found[0]), "{found:?}");
    // What may be negative stays.
    assert!(
        (found[1] - 0.7).abs() < 1e-6 && (found[2] + 0.2).abs() < 1e-6,
        "{found:?}"
    );
    let estimate = [-0.3, 0.7, -0.2, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    assert_eq!(arms.border(&estimate, &found), ["`p0`"]);
}
