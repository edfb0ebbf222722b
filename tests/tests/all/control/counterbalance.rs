//! Counterweights against those of a paper.

use robot_model::control::ControlError;
use robot_model::control::counterbalance::{Weight, mass, moment};

/// Seed 004, equations 16 to 19 with its numbers; the lever of 0.075 m that it prints is rounded from 0.0704 m.
#[test]
fn counterweights_of_the_phantom() -> Result<(), ControlError> {
    let g = 9.81;
    let tool = |lever: f64| Weight { mass: 0.09, lever };
    let (upper, fore) = (-0.01923, -0.10996);
    let results = |lever: f64| -> Result<[f64; 4], ControlError> {
        let maker = Weight {
            mass: 0.216,
            lever: -lever,
        };
        Ok([
            moment(upper, g, &[tool(0.216), maker]),
            moment(fore, g, &[tool(0.195)]),
            mass(moment(upper, g, &[tool(0.216)]), g, lever)?,
            mass(moment(fore, g, &[tool(0.195)]), g, lever)?,
        ])
    };
    for (lever, wanted) in [
        (0.075, [0.01255, 0.0622, 0.233, 0.0845]),
        (0.0704, [0.0223, 0.0622, 0.248, 0.090]),
    ] {
        for (found, wanted) in results(lever)?.into_iter().zip(wanted) {
            assert!(
                (found - wanted).abs() < 6e-3 * wanted,
                "{lever}: {found} {wanted}"
            );
        }
    }
    // Without a tool the arm is too light already.
    assert!(matches!(
        mass(upper, g, 0.0704),
        Err(ControlError::NegativeWeight { .. })
    ));
    assert!(mass(f64::NAN, g, 0.0704).is_err() && mass(0.1, 0.0, 0.0704).is_err());
    assert_eq!(mass(0.0, g, 0.0704)?.to_bits(), 0.0_f64.to_bits());
    Ok(())
}
