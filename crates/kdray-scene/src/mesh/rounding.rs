//! Whether f32 is fine enough for where a model lies.

use crate::Model;

/// With fewer steps across a model f32 is coarse.
const FEWEST_STEPS: f32 = 65_536.0;

/// The distance of neighbouring f32 at the largest coordinate of a triangle, if that is coarse beside the size of
/// the model.
pub(super) fn coarse_step(model: &Model) -> Option<f32> {
    let (mut min, mut max) = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
    for &id in model.triangles.as_flattened() {
        for (axis, &x) in model.vertices[id as usize].iter().enumerate() {
            (min[axis], max[axis]) = (min[axis].min(x), max[axis].max(x));
        }
    }
    let farthest = min.iter().chain(&max).fold(0.0_f32, |most, x| most.max(x.abs()));
    let size = (0..3).map(|axis| max[axis] - min[axis]).fold(0.0, f32::max);
    let step = farthest.next_up() - farthest;
    (farthest.is_normal() && step.is_finite() && size < FEWEST_STEPS * step).then_some(step)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(x: f32, size: f32) -> Model {
        let vertices = vec![[x, 0.0, 0.0], [x + size, 0.0, 0.0], [x, size, 0.0]];
        Model { vertices, triangles: vec![[0, 1, 2]], ..Model::default() }
    }

    #[test]
    fn far_from_zero_steps_are_coarse() {
        for size in [1e-20, 1.0, 1e30] {
            assert_eq!(coarse_step(&at(0.0, size)), None);
            assert_eq!(coarse_step(&at(100.0 * size, size)), None);
        }
        assert_eq!(coarse_step(&at(5_400_000.0, 1000.0)), Some(0.5));
        assert_eq!(coarse_step(&at(5_400_000.0, 100_000.0)), None);
        assert_eq!(coarse_step(&at(0.0, 0.0)), None);
        assert_eq!(coarse_step(&Model::default()), None);
    }
}
