use super::*;

#[test]
fn what_gives_by_a_tenth_of_a_radian_is_no_contact() {
    let exact = |value: f64| Value { value, std: 0.0 };
    let of = |deflection: f64| Bristles {
        stiffness: exact(0.5843 / deflection),
        damping: None,
        reached: 2.0,
        deflection: exact(deflection),
        encoder_step: 1e-3,
        seconds: 0.0..1.0,
    };
    assert!(of(0.003).is_of_contact() && !of(0.27).is_of_contact());
    assert!(!of(0.003).is_resolved() && of(0.27).is_resolved());
}

/// Bristles of 200 N m/rad and 1.5 N m s/rad under a torque that rises to 80 % of 2 N m.
#[test]
fn bristles_are_found_in_their_own_equation() {
    let (stiffness, damping, breakaway, step) = (200.0, 1.5, 2.0, 1e-3);
    for quick in [false, true] {
        let fine = 20_u32;
        let (mut z, mut way) = (0.0, 0.0);
        let (mut torque, mut ways) = (Vec::new(), Vec::new());
        for k in 0..2000 {
            let t = step * f64::from(k);
            let shake = if quick { 0.1 * (90.0 * t).sin() } else { 0.0 };
            let f = |t: f64| 0.8 * t + shake;
            torque.push(f(t));
            ways.push(way);
            for part in 0..fine {
                let f = f(t + step * (f64::from(part) + 0.5) / f64::from(fine));
                // f = s0 z + s1 (1 - f / F_s) dq/dt
                let rate = (f - stiffness * z) / damping;
                let h = step / f64::from(fine);
                z += h * rate;
                way += h * rate / (1.0 - f / breakaway);
            }
        }
        let loading = Loading {
            torque,
            way: ways,
            step,
        };
        let exact = Value {
            value: breakaway,
            std: 0.0,
        };
        let (found, told) = loading.bristles(exact).expect("bristles");
        assert!((found.value / stiffness - 1.0).abs() < 0.03, "{found:?}");
        match told {
            Some(told) if quick => {
                assert!((told.value / damping - 1.0).abs() < 0.1, "{told:?}");
            }
            told => assert!(!quick, "{told:?}"),
        }
    }
}
