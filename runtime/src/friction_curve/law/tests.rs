use super::*;

/// A curve through `law` at so many speeds in both directions or one, from `rows` noisy blocks at each.
fn drawn(seed: u64, speeds: &[f64], law: &dyn Fn(f64) -> f64, rows: usize, noise: f64) -> Curve {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut blocks = |v: f64| -> Vec<f64> {
        (0..rows)
            .map(|_| {
                let error: f64 = StandardNormal.sample(&mut random);
                law(v) + noise * error
            })
            .collect()
    };
    let cells: Vec<Vec<f64>> = speeds.iter().map(|v| blocks(*v)).collect();
    Curve::of_blocks(speeds, &cells)
}

fn seed_003(v: f64) -> f64 {
    v.signum() * (0.5843 + 1.4177 * (-(v / 0.8379).powi(2)).exp()) + 0.1328 * v
}

fn ladder(count: i32) -> Vec<f64> {
    (0..count)
        .map(|k| 0.1 * 45_f64.powf(f64::from(k) / f64::from(count - 1)))
        .collect()
}

#[test]
fn the_law_comes_back_with_its_deviations() {
    let speeds = ladder(20);
    let (mut squares, mut told, mut misfit) = ([0.0; 5], 0.0, 0.0);
    for seed in 0..200 {
        let curve = drawn(seed, &speeds, &seed_003, 40, 0.05);
        let points = curve.points.iter().map(|point| point.torque.std.powi(2));
        told += points.sum::<f64>() / (0.05_f64.powi(2) / 40.0 * 20.0 * 200.0);
        let law = Law::fit(&curve).expect("a law");
        misfit += law.misfit.powi(2) / 200.0;
        let fall = law.fall.expect("a fall");
        let found = [
            (law.coulomb, 0.5843),
            (law.viscous, 0.1328),
            (fall.speed, 0.8379),
            (law.breakaway, 2.002),
            (law.rise, 2.002 / 0.5843 - 1.0),
        ];
        for (square, (found, truth)) in squares.iter_mut().zip(found) {
            assert!(
                (found.value / truth - 1.0).abs() < 0.12,
                "{found:?} {truth}"
            );
            *square += ((found.value - truth) / found.std).powi(2) / 200.0;
        }
        assert!((law.torque(0.3) - seed_003(0.3)).abs() < 0.03);
    }
    // Variances of the points that are told, over what they are.
    assert!((0.85..1.25).contains(&told), "{told}");
    // So are distances of the points.
    assert!((0.85..1.25).contains(&misfit), "{misfit}");
    // Errors over what is said of them.
    for square in squares {
        assert!((0.6..1.5).contains(&square), "{squares:?}");
    }
}

#[test]
fn both_directions_have_an_offset() {
    let speeds: Vec<f64> = ladder(8).into_iter().flat_map(|v| [-v, v]).collect();
    let curve = drawn(1, &speeds, &|v| seed_003(v) - 0.2, 40, 0.02);
    let law = Law::fit(&curve).expect("a law");
    let offset = law.offset.expect("both directions");
    assert!(
        (offset.value + 0.2).abs() < 4.0 * offset.std && offset.std < 0.01,
        "{law:?}"
    );
}

/// Viscous friction that differs by direction is no law of this kind.
#[test]
fn points_of_another_law_are_off_by_more_than_their_deviations() {
    let speeds: Vec<f64> = ladder(8).into_iter().flat_map(|v| [-v, v]).collect();
    let law = |v: f64| 0.6 * v.signum() + if v > 0.0 { 0.1 } else { 0.15 } * v;
    let found = Law::fit(&drawn(1, &speeds, &law, 40, 0.02)).expect("a law");
    assert!(found.misfit > 3.0, "{found:?}");
}

/// The best of many Stribeck speeds is better than one, and no more than chance all the same.
#[test]
fn falls_of_chance_are_as_rare_as_is_said() {
    let speeds = ladder(9);
    let mut tenth = 0;
    for seed in 0..300 {
        let curve = drawn(seed, &speeds, &|v| 0.6 + 0.1 * v, 20, 0.05);
        let law = Law::fit(&curve).expect("a law");
        assert!(
            law.fall.is_none() && law.breakaway == law.coulomb,
            "{law:?}"
        );
        tenth += i32::from(law.probability.expect("enough speeds") < 0.1);
    }
    // 30 of 300, or fewer, as weights are those of deviations that are found.
    assert!((15..=50).contains(&tenth), "{tenth}");
}

#[test]
fn few_speeds_are_refused_and_four_have_no_fall() {
    let few = drawn(1, &ladder(3), &seed_003, 20, 0.01);
    let refused = FrictionError::TooFewSpeeds { found: 3, least: 4 };
    assert_eq!(Law::fit(&few), Err(refused));
    let law = Law::fit(&drawn(1, &ladder(4), &seed_003, 20, 0.01)).expect("a law");
    assert!(law.fall.is_none() && law.probability.is_none());
}

#[test]
fn differences_of_samples_tell_a_fall_above_one_step_of_the_encoder() {
    let mut curve = drawn(1, &ladder(20), &seed_003, 40, 0.01);
    let law = Law::fit(&curve).expect("a law");
    assert!(law.fall.is_some());
    // 12 bits a turn at 1 kHz, and at 100 Hz.
    for (rate, is_told) in [(1000.0, false), (100.0, true)] {
        curve.speed_step = std::f64::consts::TAU / 4096.0 * rate;
        assert_eq!(law.is_told_by_differences(&curve), is_told, "{rate}");
    }
    let flat = drawn(2, &ladder(20), &|v| 0.5 * v.signum() + 0.1 * v, 40, 0.01);
    let law = Law::fit(&flat).expect("a law");
    assert!(law.fall.is_none() && law.is_told_by_differences(&curve));
}
