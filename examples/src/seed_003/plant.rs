//! The link by hand: equations (8) to (10) with an exact step of the bristles. Nothing of the runtime is in it.

use super::truth;

/// Friction of equations (8) to (10).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Friction {
    /// `F_c`, N m.
    pub coulomb: f64,
    /// `F_s`, N m.
    pub breakaway: f64,
    /// `s2`, N m s/rad.
    pub viscous: f64,
    /// Stribeck speed, rad/s.
    pub stribeck: f64,
    /// `s0`, N m/rad.
    pub stiffness: f64,
    /// `s1`, N m s/rad.
    pub damping: f64,
}

/// As the paper has it.
pub const PRINTED: Friction = Friction {
    coulomb: truth::COULOMB,
    breakaway: truth::BREAKAWAY,
    viscous: truth::VISCOUS,
    stribeck: truth::STRIBECK,
    stiffness: truth::STIFFNESS,
    damping: truth::DAMPING,
};

impl Friction {
    /// `s0 g(v)`, equation (10), N m.
    #[must_use]
    pub fn level(&self, v: f64) -> f64 {
        let fall = self.breakaway - self.coulomb;
        self.coulomb + fall * (-(v / self.stribeck).powi(2)).exp()
    }

    /// Torque at a constant speed, N m.
    #[must_use]
    pub fn steady(&self, v: f64) -> f64 {
        v.signum() * self.level(v) + self.viscous * v
    }

    /// `dz/dt`, equation (9).
    #[must_use]
    pub fn rate(&self, v: f64, z: f64) -> f64 {
        v - v.abs() * self.stiffness * z / self.level(v)
    }

    /// Torque, equation (8), N m.
    #[must_use]
    pub fn torque(&self, v: f64, z: f64) -> f64 {
        self.stiffness * z + self.damping * self.rate(v, z) + self.viscous * v
    }

    /// The deflection after `h` seconds at a constant speed, exactly.
    #[must_use]
    pub fn bent(&self, v: f64, z: f64, h: f64) -> f64 {
        let decay = self.stiffness * v.abs() / self.level(v);
        z + h * share(decay * h) * self.rate(v, z)
    }
}

/// `(1 - exp(-x)) / x`
fn share(x: f64) -> f64 {
    if x == 0.0 { 1.0 } else { -(-x).exp_m1() / x }
}

/// A joint with friction, and what it moves: `J dv/dt = tau - w sin(q) - F`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Link {
    /// Its friction.
    pub friction: Friction,
    /// `J`, kg m^2.
    pub inertia: f64,
    /// `w`, N m.
    pub weight: f64,
}

/// The state of a link.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct State {
    /// Angle from where it hangs, rad.
    pub q: f64,
    /// rad/s.
    pub v: f64,
    /// Deflection of the bristles, rad.
    pub z: f64,
}

impl Link {
    /// The uniform rod on its end, hanging.
    #[must_use]
    pub fn hanging(friction: Friction) -> Self {
        Self {
            friction,
            inertia: truth::MASS * truth::LENGTH.powi(2) / 3.0,
            weight: truth::MASS * truth::GRAVITY * truth::LENGTH / 2.0,
        }
    }

    /// With its axis upright, where nothing weighs.
    #[must_use]
    pub fn lying(friction: Friction, inertia: f64) -> Self {
        Self {
            friction,
            inertia,
            weight: 0.0,
        }
    }

    /// A step of the second order under a constant torque: bristles over half of it, the link with their deflection held, bristles over the
    /// other half. Each part is exact but for what changes slowly, so stiff bristles do not shorten it.
    #[must_use]
    pub fn step(&self, x: State, torque: f64, h: f64) -> State {
        let z = self.friction.bent(x.v, x.z, 0.5 * h);
        let (q, v) = self.slid(x.q, x.v, z, torque, h);
        State {
            q,
            v,
            z: self.friction.bent(v, z, 0.5 * h),
        }
    }

    fn slid(&self, q: f64, v: f64, z: f64, torque: f64, h: f64) -> (f64, f64) {
        let friction = &self.friction;
        let push = torque - self.weight * (q + 0.5 * h * v).sin() - friction.stiffness * z;
        let speed = |after: f64, seen: f64| {
            let bristles = 1.0 - friction.stiffness * z * seen.signum() / friction.level(seen);
            let brake = friction.damping * bristles + friction.viscous;
            let x = brake * after / self.inertia;
            v + after * share(x) * (push - brake * v) / self.inertia
        };
        // What the speed does to its own brake is taken from the middle of the step.
        let middle = speed(0.5 * h, v);
        let middle = speed(0.5 * h, middle);
        let end = speed(h, middle);
        (q + h / 6.0 * (v + 4.0 * middle + end), end)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::paper::rk4;

    fn pushed(t: f64) -> f64 {
        2.5 + 0.5 * (4.0 * t).sin()
    }

    fn end(link: &Link, h: f64) -> State {
        let steps = (1.0 / h).round();
        let mut x = State::default();
        let mut t = 0.0;
        while t < steps {
            x = link.step(x, pushed((t + 0.5) * h), h);
            t += 1.0;
        }
        x
    }

    #[test]
    fn its_error_falls_with_the_square_of_the_step() {
        let link = Link::hanging(PRINTED);
        let f = |t: f64, x: &[f64; 3]| {
            let [q, v, z] = *x;
            let rest = pushed(t) - link.weight * q.sin() - link.friction.torque(v, z);
            [v, rest / link.inertia, link.friction.rate(v, z)]
        };
        let h = 2e-5;
        let exact = (0..50_000).fold([0.0; 3], |x, k| rk4(f, f64::from(k) * h, &x, h));
        let error = |h: f64| (end(&link, h).q - exact[0]).abs();
        assert!(error(1e-4) < 1e-5 * exact[0].abs(), "{}", error(1e-4));
        let ratio = error(1e-3) / error(5e-4);
        assert!((ratio - 4.0).abs() < 1.0, "{ratio}");
    }

    #[test]
    fn at_a_constant_speed_friction_is_the_stribeck_curve() {
        for v in [0.05, 0.8, 4.0, -0.3] {
            let mut z = 0.0;
            let seconds = 40.0 / f64::abs(v);
            for _ in 0..1000 {
                z = PRINTED.bent(v, z, 1e-3 * seconds);
            }
            let off = PRINTED.torque(v, z) - PRINTED.steady(v);
            assert!(off.abs() < 1e-12, "{v}: {off}");
        }
    }
}
