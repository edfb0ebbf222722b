use robot_model::effects::ViscousFriction;
use robot_model::{FromParameters, RobotModel, Vector};

#[derive(RobotModel)]
#[robot(file = "specs/energies.robot")]
struct Rod {
    m: f64,
    c: f64,
    th: ViscousFriction,
}

fn main() {
    let _ = made::<Rod, 1, 3, 3, 0>();
}

fn made<R, const N: usize, const S: usize, const B: usize, const P: usize>() -> R
where
    R: FromParameters<N, S, B, P>,
{
    R::from_base(&Vector::zeros())
}
