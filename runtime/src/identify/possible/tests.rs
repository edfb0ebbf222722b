use super::*;
use faer::Side;

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

/// Unknowns of which nothing is told beside the factor.
fn nearest(arms: &PossibleArms, factor: &Mat<f64>) -> Nearest {
    let zeros = vec![0.0; arms.kept.len()];
    let told = Told {
        values: &zeros,
        deviations: &zeros,
    };
    arms.nearest(factor, &told, CAD_WEIGHT).expect("an end")
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
    let found = nearest(&one_link(None), &factor);
    for (found, wanted) in found.standard.iter().zip(BODY) {
        assert!((found - wanted).abs() < 1e-7, "{found} {wanted}");
    }
}

/// Of matrices `[[S, h], [h^T, m]]`, in the metric that counts their entries, the nearest has the eigenvalues that are
/// not negative.
#[test]
fn the_nearest_body_is_the_projection() {
    let mut impossible = BODY;
    impossible[4] = 1.3; // more than `iyy + izz`
    let matrix = pseudo_inertia(&Inertial::from(impossible));
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
            pseudo_inertia(&Inertial::from(unit))
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
    let projected = nearest(&one_link(None), &factor);
    let ten: [f64; 10] = projected.standard.try_into().expect("ten");
    let found = pseudo_inertia(&Inertial::from(ten));
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
    assert!(projected.gap < 1e-4 && projected.steps < 200);
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
    let found = nearest(&arms, &factor);
    assert!(
        (found.estimate[0] - told).abs() < 1e-6,
        "{:?}",
        found.estimate
    );
    let standard = &found.standard;
    assert!((standard[9] + 2.0 * standard[0] - told).abs() < 1e-6);
    for (k, (found, cad)) in standard.iter().zip(BODY).enumerate() {
        assert!((found - cad).abs() < 0.1, "{k}: {found} {cad}");
    }
    // And without any told, CAD itself.
    let silent = nearest(&arms, &Mat::zeros(1, 2));
    for (found, cad) in silent.standard.iter().zip(BODY) {
        assert!((found - cad).abs() < 1e-4, "{found} {cad}");
    }
}

/// Logs that tell nearly nothing do not bend a body of CAD to where their noise is; one that nobody knows they do.
#[test]
fn what_is_hardly_told_stays_near_cad() {
    let mut arms = one_link(Some(BODY));
    arms.combinations = vec![vec![(9, 1.0)]];
    arms.kept = vec![9];
    // `izz` is 20 times that of CAD by the logs, and nothing at two deviations.
    let (told, deviation) = (8.0, 4.0);
    let factor = Mat::from_fn(1, 2, |_, k| {
        if k == 0 {
            1.0 / deviation
        } else {
            told / deviation
        }
    });
    let near = nearest(&arms, &factor).standard;
    assert!((0.5..4.0).contains(&(near[9] / BODY[9])), "{near:?}");
    assert!((0.5..2.0).contains(&(near[0] / BODY[0])), "{near:?}");
    let lightly = Told {
        values: &[told],
        deviations: &[deviation],
    };
    let far = arms.nearest(&factor, &lightly, LAST_WEIGHT);
    let far = far.expect("an end").standard;
    assert!(far[9] > 10.0 * BODY[9], "{far:?}");
}

#[test]
fn a_body_of_cad_without_an_inside_is_one_with() {
    // A point of 2 kg, and nothing at all.
    for nominal in [
        [2.0, 0.2, 0.0, 0.0, 0.0, 0.0, 0.0, 0.02, 0.0, 0.02],
        [0.0; 10],
    ] {
        let arms = one_link(Some(nominal));
        let silent = nearest(&arms, &Mat::zeros(10, 11));
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
    let found = nearest(&arms, &factor).standard;
    assert!((0.0..1e-6).contains(&found[0]), "{found:?}");
    // What may be negative stays.
    assert!(
        (found[1] - 0.7).abs() < 1e-6 && (found[2] + 0.2).abs() < 1e-6,
        "{found:?}"
    );
    let estimate = [-0.3, 0.7, -0.2, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    assert_eq!(arms.border(&estimate, &found), ["`p0`"]);
}

/// Bodies are a cone: a thousand times the mass is a thousand times the arm.
#[test]
fn heavy_and_light_arms_are_found_alike() {
    for scale in [1e-4, 1.0, 1e4] {
        let mut b: Vec<f64> = BODY.iter().map(|x| scale * x).collect();
        b[4] = 1.3 * scale;
        let deviations: Vec<f64> = b.iter().map(|x| 1e-3 * x.abs()).collect();
        let (found, _) = one_link(None).nearest_to(&b, &deviations).expect("an end");
        let unit: Vec<f64> = b.iter().map(|x| x / scale).collect();
        let unit_deviations: Vec<f64> = deviations.iter().map(|x| x / scale).collect();
        let (wanted, _) = one_link(None)
            .nearest_to(&unit, &unit_deviations)
            .expect("an end");
        for (found, wanted) in found.iter().zip(&wanted) {
            assert!(
                (found / scale - wanted).abs() < 1e-4,
                "{scale}: {found} {wanted}"
            );
        }
    }
}

/// A parameter that no body and no sign holds is what the logs say, whatever its size.
#[test]
fn what_is_free_is_what_is_told() {
    let mut arms = one_link(None);
    arms.links.clear();
    let mut b = vec![0.0; 10];
    b[0] = -9e4;
    let deviations = vec![46.0; 10];
    let (found, _) = arms.nearest_to(&b, &deviations).expect("an end");
    assert!((found[0] + 9e4).abs() < 1e-6, "{found:?}");
}

/// A compact link of CAD stays what it is.
#[test]
fn cad_of_a_small_link_is_kept() {
    let small = Inertial::about_com(0.3, [0.01, 0.0, 0.02], [3e-5, 0.0, 0.0, 4e-5, 0.0, 3e-5]);
    let arms = one_link(Some(small.into()));
    let found = nearest(&arms, &Mat::zeros(10, 11)).standard;
    let wanted: [f64; 10] = small.into();
    for (found, wanted) in found.iter().zip(wanted) {
        assert!(
            (found - wanted).abs() < 1e-3 * wanted.abs().max(1e-5),
            "{found} {wanted}"
        );
    }
}
