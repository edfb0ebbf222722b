//! First values to try of shape parameters.

use robot_model_spec::model::{EffectDefinition, ShapeParameter};

/// First values to try of a shape parameter whose definition gives no step, where it is the only one.
const MOST_POINTS: usize = 12;

/// Fewest values: between them an optimum could hide.
const FEWEST_POINTS: usize = 4;

/// An effect of several shape parameters is tried at about so many points in all.
const POINTS_OF_AN_EFFECT: f64 = 64.0;

/// Fewest values in a decade of a range of several, of an effect without memory, whose points are soon computed: limits and speeds of a motor
/// have to be met at once.
const POINTS_OF_A_DECADE: f64 = 3.0;

/// No definition with more steps than this passes the check.
const MOST_STEPS: u32 = 10_000;

/// First values to try of every shape parameter of an effect: at the definition's step, else evenly spaced in the logarithm,
/// or evenly where the range has none.
pub(super) fn grids(definition: &EffectDefinition) -> Vec<Vec<f64>> {
    let shapes = &definition.shapes;
    let stepped: Vec<Option<Vec<f64>>> = shapes.iter().map(steps).collect();
    let product: f64 = stepped
        .iter()
        .flatten()
        .map(|grid| grid.len() as f64)
        .product();
    let free = stepped.iter().filter(|grid| grid.is_none()).count().max(1);
    let each = (POINTS_OF_AN_EFFECT / product).powf(1.0 / free as f64);
    // Truncated on purpose; the range keeps it small.
    let each = (FEWEST_POINTS..MOST_POINTS)
        .rev()
        .find(|&n| (n as f64) < each);
    let each = each.map_or(FEWEST_POINTS, |n| n + 1);
    let grids = stepped.into_iter().zip(shapes);
    grids
        .map(|(grid, shape)| {
            let is_light = definition.states.is_empty() && shapes.len() == 2;
            let most = if is_light { decades(shape) } else { 0 };
            grid.unwrap_or_else(|| spaced(shape, each.max(most)))
        })
        .collect()
}

/// Values that the decades of a range ask for; none where it has no logarithm.
fn decades(shape: &ShapeParameter) -> usize {
    if shape.low <= 0.0 {
        return 0;
    }
    let wanted = POINTS_OF_A_DECADE * (shape.high / shape.low).log10() + 1.0;
    let counts = 0..MOST_STEPS as usize;
    counts
        .into_iter()
        .find(|&n| n as f64 >= wanted)
        .unwrap_or(0)
}

fn steps(shape: &ShapeParameter) -> Option<Vec<f64>> {
    let (low, high, step) = (shape.low, shape.high, shape.step?);
    let points = (0..MOST_STEPS)
        .map(|k| low + step * f64::from(k))
        .take_while(|value| *value < high - 1e-9 * step);
    Some(points.chain([high]).collect())
}

fn spaced(shape: &ShapeParameter, count: usize) -> Vec<f64> {
    let (low, high) = (shape.low, shape.high);
    let points = (0..count - 1).map(|k| {
        let share = k as f64 / (count - 1) as f64;
        if low > 0.0 {
            low * (high / low).powf(share)
        } else {
            low + share * (high - low)
        }
    });
    points.chain([high]).collect()
}

#[cfg(test)]
mod tests {
    use super::grids;
    use robot_model_spec::standard_effects;

    #[test]
    fn one_shape_has_twelve_points_and_several_share() {
        let sizes = |name: &str| -> Vec<usize> {
            let definition = standard_effects().iter().find(|d| d.name == name);
            let grids = grids(definition.expect("a standard effect"));
            grids.iter().map(Vec::len).collect()
        };
        assert_eq!(sizes("stribeck"), [12]);
        assert_eq!(sizes("cable_hysteresis"), [8, 3, 3]);
        assert_eq!(sizes("lugre_presliding"), [5, 5, 3]);
        assert_eq!(sizes("torque_saturation"), [25, 22]);
    }
}
