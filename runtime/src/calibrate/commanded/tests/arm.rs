//! An upright arm about the joint of a PUMA that is driven to +-86 degrees and back by a switched voltage: 512 samples at 30 Hz.

/// What a log has of it.
pub struct Logged {
    pub time: Vec<f64>,
    pub position: Vec<f64>,
    pub velocity: Vec<f64>,
    /// `v - k w`.
    pub drop: Vec<f64>,
    /// When the voltage was switched.
    pub switches: Vec<f64>,
}

/// `q'' - alpha sin q + c q' = beta v` with a `c` for each direction, by Runge-Kutta steps of a twentieth of a sample.
pub fn arm(volts: f64, back_emf: f64) -> Logged {
    const STEPS: u32 = 20;
    let h = 1.0 / 30.0 / f64::from(STEPS);
    let rate = |[q, w]: [f64; 2], v: f64| {
        let damping = if w > 0.0 { 34.72 } else { 36.0 };
        [w, 12.05 * q.sin() - damping * w + 21.42 * v]
    };
    let mut log = Logged {
        time: Vec::new(),
        position: Vec::new(),
        velocity: Vec::new(),
        drop: Vec::new(),
        switches: Vec::new(),
    };
    let (mut x, mut v) = ([0.0, 0.0], volts);
    for k in 0..512_u32 {
        let time = f64::from(k) / 30.0;
        let wanted = if x[0] > 1.5 {
            -volts
        } else if x[0] < -1.5 {
            volts
        } else {
            v
        };
        if wanted * v < 0.0 {
            log.switches.push(time);
            v = wanted;
        }
        log.time.push(time);
        log.position.push(x[0]);
        log.velocity.push(x[1]);
        log.drop.push(v - back_emf * x[1]);
        for _ in 0..STEPS {
            let by = |k: [f64; 2], h: f64| [x[0] + h * k[0], x[1] + h * k[1]];
            let first = rate(x, v);
            let second = rate(by(first, 0.5 * h), v);
            let third = rate(by(second, 0.5 * h), v);
            let last = rate(by(third, h), v);
            let sum = |j: usize| first[j] + 2.0 * (second[j] + third[j]) + last[j];
            x = by([sum(0), sum(1)], h / 6.0);
        }
    }
    log
}

/// Positions as an encoder of so many bits a turn tells them.
pub fn encoded(position: &[f64], bits: i32) -> Vec<f64> {
    let step = std::f64::consts::TAU / 2.0_f64.powi(bits);
    position.iter().map(|q| (q / step).round() * step).collect()
}
