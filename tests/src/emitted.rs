//! Emitted code of every spec, included as users include it, with warnings denied.

use nalgebra::DMatrix;
use robot_model::{FromParameters, Matrix, Mechanics, Vector};

use crate::evaluate::Forms;
use crate::mechanics::{self, MechanicsForms};
use crate::states::{State, typed};

/// Accelerations of standard parameters, a state and a torque, where they are determined.
pub type Accelerations = fn(&[f64], &State, &[f64]) -> Option<Vec<f64>>;

/// One emitted arm behind a face without sizes in its type.
#[derive(Clone, Copy)]
pub struct Robot {
    /// Name of the spec file.
    pub spec: &'static str,
    /// Name of the robot.
    pub name: &'static str,
    /// Names of the joints.
    pub joints: &'static [&'static str],
    /// Names of the standard parameters.
    pub standard_parameters: &'static [&'static str],
    /// Names of the base parameters.
    pub base_parameter_names: &'static [&'static str],
    /// `beta` of standard parameters.
    pub base_parameters: fn(&[f64]) -> Vec<f64>,
    /// All forms at a state, with base parameters from standard ones.
    pub forms: fn(&[f64], &State) -> Forms,
    /// Energies, momentum and slopes at a state.
    pub mechanics: fn(&[f64], &State) -> MechanicsForms,
    /// Accelerations at a state under a torque.
    pub accelerations: Accelerations,
}

macro_rules! robots {
    ($($module:ident $file:literal $robot:ident;)*) => {
        $(
            #[doc = concat!("Emitted from `", $file, ".robot`.")]
            #[deny(warnings)]
            #[allow(clippy::pedantic, reason = "derived, not written")]
            pub mod $module {
                robot_model::include_robot!($file);
            }
        )*

        /// Every emitted arm.
        pub const ROBOTS: &[Robot] = &[$(Robot::of::<$module::$robot, _, _, _, _, _, _>($file)),*];
    };
}

robots! {
    cart_pole "cart_pole" CartPole;
    emps "emps" Emps;
    every_effect "every_effect" EveryEffect;
    fixed_arm "fixed_arm" FixedArm;
    greek "greek" Greek;
    known_springs "known_springs" KnownSprings;
    lone_slide "lone_slide" LoneSlide;
    lugre_link "lugre_link" LugreLink;
    memory "memory" Memory;
    mounted_arm "mounted_arm" MountedArm;
    odd_angles "odd_angles" Scalar;
    panda "panda" Panda;
    phantom "phantom" Phantom;
    pneumatic_arm "pneumatic_arm" PneumaticArm;
    puma_shoulder "puma_shoulder" PumaShoulder;
    puma560 "puma560" Puma560;
    rokae_like "rokae_like" RokaeLike;
    skew "skew" Skew;
    slider "slider" Slider;
    spring_arm "spring_arm" SpringArm;
    stanford "stanford" Stanford;
    two_link "two_link" TwoLink;
    tx40 "tx40" Tx40;
    units "units" Units;
    ur10 "ur10" Ur10;
}

impl Robot {
    const fn of<
        R,
        const DOF: usize,
        const STANDARD: usize,
        const BASE: usize,
        const SHAPES: usize,
        const STATES: usize,
        const INPUTS: usize,
    >(
        spec: &'static str,
    ) -> Self
    where
        R: FromParameters<DOF, STANDARD, BASE, SHAPES, STATES, INPUTS>
            + Mechanics<DOF, STANDARD, BASE, SHAPES, STATES, INPUTS>,
    {
        Self {
            spec,
            name: R::NAME,
            joints: &R::JOINTS,
            standard_parameters: &R::STANDARD_PARAMETERS,
            base_parameter_names: &R::BASE_PARAMETERS,
            base_parameters: base_parameters::<R, DOF, STANDARD, BASE, SHAPES, STATES, INPUTS>,
            forms: forms::<R, DOF, STANDARD, BASE, SHAPES, STATES, INPUTS>,
            mechanics: mechanics::emitted::<R, DOF, STANDARD, BASE, SHAPES, STATES, INPUTS>,
            accelerations: mechanics::accelerations::<R, DOF, STANDARD, BASE, SHAPES, STATES, INPUTS>,
        }
    }
}

fn base_parameters<
    R,
    const DOF: usize,
    const STANDARD: usize,
    const BASE: usize,
    const SHAPES: usize,
    const STATES: usize,
    const INPUTS: usize,
>(
    standard: &[f64],
) -> Vec<f64>
where
    R: FromParameters<DOF, STANDARD, BASE, SHAPES, STATES, INPUTS>,
{
    R::base_parameters(&Vector::from_column_slice(standard))
        .as_slice()
        .to_vec()
}

fn forms<
    R,
    const DOF: usize,
    const STANDARD: usize,
    const BASE: usize,
    const SHAPES: usize,
    const STATES: usize,
    const INPUTS: usize,
>(
    standard: &[f64],
    state: &State,
) -> Forms
where
    R: FromParameters<DOF, STANDARD, BASE, SHAPES, STATES, INPUTS>,
{
    let arm = R::from_standard(&Vector::from_column_slice(standard));
    let state = arm.loaded(&typed::<DOF, STATES, INPUTS>(state));
    Forms {
        mass_matrix: dense(&arm.mass_matrix(&state.q)),
        coriolis_matrix: dense(&arm.coriolis_matrix(&state.q, &state.dq)),
        gravity: dense(&arm.gravity(&state.q)),
        bias: dense(&arm.bias(&state.q, &state.dq)),
        inverse_dynamics: dense(&arm.inverse_dynamics_at(&state)),
        regressor: dense(&R::regressor_at(&state, &arm.shapes())),
        base_regressor: dense(&R::base_regressor_at(&state, &arm.shapes())),
    }
}

fn dense<const ROWS: usize, const COLUMNS: usize>(matrix: &Matrix<ROWS, COLUMNS>) -> DMatrix<f64> {
    DMatrix::from_column_slice(ROWS, COLUMNS, matrix.as_slice())
}
