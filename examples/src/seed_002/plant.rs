//! The simulated arm: Newton's and Euler's equations link by link, written out here, and the friction law of the publication.

use std::array;

use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};

use super::truth::{EPS, FRICTION, LINKS, Link};
use crate::paper::rk4;

const GRAVITY: f64 = 9.81;

/// Six numbers, one a joint.
pub type Joints = [f64; 6];

/// Equations 3 and 4 of a joint, from 0, N m.
#[must_use]
pub fn friction(joint: usize, v: f64) -> f64 {
    let dry = if v > 0.0 {
        FRICTION.fc1[joint]
    } else {
        FRICTION.fc2[joint]
    };
    if v.abs() < EPS {
        return (v / EPS).abs() * dry * v.signum();
    }
    let [fv1, fv2, fv3] = [FRICTION.fv1, FRICTION.fv2, FRICTION.fv3].map(|row| row[joint]);
    dry * v.signum() + fv3 * v.powi(3) + fv2 * v.powi(2) + fv1 * v
}

/// Rotation of a link's frame in the one before, and its origin from there in its own axes.
fn frame(link: &Link, q: f64) -> (Matrix3<f64>, Vector3<f64>) {
    let [a, alpha, d, offset] = link.frame;
    let ((st, ct), (sa, ca)) = ((q + offset).sin_cos(), alpha.sin_cos());
    let rotation = Matrix3::new(ct, -st * ca, st * sa, st, ct * ca, -ct * sa, 0.0, sa, ca);
    (rotation, Vector3::new(a, d * sa, d * ca))
}

/// Torque of the links and of the rotors, N m, under this acceleration of gravity.
fn body_torque(q: &Joints, dq: &Joints, ddq: &Joints, gravity: f64) -> Joints {
    let z = Vector3::z();
    let frames: [_; 6] = array::from_fn(|k| frame(&LINKS[k], q[k]));
    let (mut w, mut dw) = (Vector3::zeros(), Vector3::zeros());
    let mut a = Vector3::new(0.0, 0.0, gravity);
    // Force and moment of what moves each link, about its center of mass.
    let loads: [_; 6] = array::from_fn(|k| {
        let ((rotation, p), link) = (&frames[k], &LINKS[k]);
        dw = rotation.tr_mul(&(dw + z * ddq[k] + w.cross(&(z * dq[k]))));
        w = rotation.tr_mul(&(w + z * dq[k]));
        a = rotation.tr_mul(&a) + dw.cross(p) + w.cross(&w.cross(p));
        let com = Vector3::from(link.com);
        let inertia = Vector3::from(link.inertia);
        let force = (a + dw.cross(&com) + w.cross(&w.cross(&com))) * link.mass;
        let moment = inertia.component_mul(&dw) + w.cross(&inertia.component_mul(&w));
        (force, moment)
    });
    let (mut f, mut n) = (Vector3::zeros(), Vector3::zeros());
    let mut torque = [0.0; 6];
    for k in (0..6).rev() {
        let (rotation, p) = &frames[k];
        let (force, moment) = loads[k];
        // About the origin of the frame before, in the axes of this one.
        n += moment + p.cross(&f) + (p + Vector3::from(LINKS[k].com)).cross(&force);
        f += force;
        (f, n) = (rotation * f, rotation * n);
        torque[k] = n.z + LINKS[k].rotor * ddq[k];
    }
    torque
}

/// `M ddq + C dq + G`, rotors among it, N m.
#[must_use]
pub fn rigid_torque(q: &Joints, dq: &Joints, ddq: &Joints) -> Joints {
    body_torque(q, dq, ddq, GRAVITY)
}

/// `G`, N m.
#[must_use]
pub fn gravity_torque(q: &Joints) -> Joints {
    rigid_torque(q, &[0.0; 6], &[0.0; 6])
}

/// Acceleration under a torque of motors and hands, rad/s^2.
fn acceleration(q: &Joints, dq: &Joints, torque: &Joints) -> Joints {
    let rest = [0.0; 6];
    let columns: [Vector6<f64>; 6] = array::from_fn(|k| {
        let mut unit = rest;
        unit[k] = 1.0;
        Vector6::from(body_torque(q, &rest, &unit, 0.0))
    });
    let inertia = Matrix6::from_columns(&columns);
    let bias = rigid_torque(q, dq, &rest);
    let free = Vector6::from_fn(|k, _| torque[k] - bias[k] - friction(k, dq[k]));
    let solved = inertia.cholesky().expect("links are bodies").solve(&free);
    solved.into()
}

/// Positions and velocities.
#[derive(Debug, Clone, Copy)]
pub struct Moving {
    /// rad
    pub q: Joints,
    /// rad/s
    pub dq: Joints,
}

impl Moving {
    /// After `h` seconds, in so many steps, under a torque that follows time since their start and the motion.
    #[must_use]
    pub fn after(self, h: f64, steps: u32, torque: &dyn Fn(f64, &Self) -> Joints) -> Self {
        let split = |x: &[f64; 12]| Self {
            q: array::from_fn(|k| x[k]),
            dq: array::from_fn(|k| x[6 + k]),
        };
        let step = h / f64::from(steps);
        let slopes = |t: f64, x: &[f64; 12]| -> [f64; 12] {
            let now = split(x);
            let ddq = acceleration(&now.q, &now.dq, &torque(t, &now));
            array::from_fn(|k| if k < 6 { now.dq[k] } else { ddq[k - 6] })
        };
        let start = array::from_fn(|k| if k < 6 { self.q[k] } else { self.dq[k - 6] });
        let end = (0..steps).fold(start, |x, k| rk4(slopes, f64::from(k) * step, &x, step));
        split(&end)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What gravity and motors give a moving arm is what friction and its motion take.
    #[test]
    fn work_is_kept() {
        let kinetic = |now: &Moving| -> f64 {
            let torque = body_torque(&now.q, &[0.0; 6], &now.dq, 0.0);
            (0..6).map(|k| 0.5 * torque[k] * now.dq[k]).sum()
        };
        let mut now = Moving {
            q: [0.1, 0.3, -0.4, 0.5, 0.6, -0.2],
            dq: [0.4, -0.6, 0.5, 0.9, -0.8, 1.0],
        };
        // Near gravity: an arm that falls gets to the speeds at which this friction drives it, and runs away.
        let more = [5.0, -20.0, 10.0, 4.0, -3.0, 1.0];
        let gravity = gravity_torque(&now.q);
        let push: Joints = array::from_fn(|k| gravity[k] + more[k]);
        let power = |now: &Moving| -> f64 {
            let gravity = gravity_torque(&now.q);
            let torque = |k: usize| push[k] - gravity[k] - friction(k, now.dq[k]);
            (0..6).map(|k| torque(k) * now.dq[k]).sum()
        };
        let (start, h) = (kinetic(&now), 1e-4);
        let mut work = 0.0;
        for _ in 0..2000 {
            let next = now.after(h, 1, &|_, _| push);
            work += 0.5 * h * (power(&now) + power(&next));
            now = next;
        }
        let gained = kinetic(&now) - start;
        assert!(
            (gained - work).abs() < 1e-3 * (1.0 + work.abs()),
            "{gained} {work}"
        );
    }
}
