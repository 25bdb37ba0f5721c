//! Whether instances are refused for a reason that is there.

use crate::attack::Extent;
use glam::{DAffine3, DMat3, DVec3};
use kdray::query::{InstanceError, InstancedSceneError};
use kdray::{Instance, Precision, Scene};
use num_rational::BigRational;
use num_traits::{Signed, Zero};

/// By how much the cube of a matrix's size is larger than its determinant where f64 cannot turn it back. An inverse by
/// cofactors is off by some 64 roundings, 2^-53 each, times that; what is off by 2^-26 is refused.
const FLAT: u64 = 1 << 20;

/// What carrying a ray to an instance rounds, over how unevenly that stretches and how far away it is; ample.
const CARRYING_ERROR: f64 = 1.0 / (1_u64 << 44) as f64;

/// Makes sure that the reason is a true one.
///
/// # Panics
/// If it is not.
pub(super) fn check<T: Precision>(
    geometries: &[Scene<T>],
    instances: &[Instance],
    error: &InstancedSceneError,
) {
    let is_true = match *error {
        InstancedSceneError::Instance(InstanceError::NoSuchGeometry {
            instance,
            geometry_id,
            geometries: count,
        }) => {
            let named = instances[instance].geometry_id;
            (named, geometries.len()) == (geometry_id, count) && geometry_id as usize >= count
        }
        InstancedSceneError::Instance(InstanceError::Singular(index)) => {
            cannot_be_inverted(&instances[index].to_world)
        }
        // One of nothing is put into a corner of another, and is refused for that one's reason.
        InstancedSceneError::Instance(InstanceError::OutOfRange(_)) => {
            instances.iter().any(|instance| lies_beyond(geometries, instance))
        }
        _ => false,
    };
    assert!(is_true, "{error:?} of {instances:?}");
}

/// Whether a matrix is not finite, singular or nearly so, or has an inverse beyond f64: by rational arithmetic.
fn cannot_be_inverted(rows: &[[f64; 4]; 3]) -> bool {
    let exact = rows.map(|row| row.map(BigRational::from_float));
    let [Some(x), Some(y), Some(z)] = exact.map(all) else { return true };
    // The cross products of two rows are the columns of the inverse times the determinant.
    let columns = [cross(&y, &z), cross(&z, &x), cross(&x, &y)];
    let determinant = dot(&x, &columns[0]);
    let size: BigRational = [&x, &y, &z].map(|row| dot(row, row)).iter().sum();
    let flat = &determinant * BigRational::from_integer(FLAT.into());
    if &flat * &flat <= &size * &size * &size {
        return true;
    }
    let moved: [BigRational; 3] = std::array::from_fn(|k| {
        &columns[0][k] * &x[3] + &columns[1][k] * &y[3] + &columns[2][k] * &z[3]
    });
    // Some digits before its end, so that sums on the way to it may be beyond.
    let last = BigRational::from_float(f64::MAX / 16.0).unwrap_or_else(BigRational::zero);
    let last = last * determinant.abs();
    columns.iter().flatten().chain(&moved).any(|number| number.abs() >= last)
}

/// All four, if all are numbers.
fn all([x, y, z, w]: [Option<BigRational>; 4]) -> Option<[BigRational; 4]> {
    Some([x?, y?, z?, w?])
}

/// Of the first three.
fn cross(a: &[BigRational; 4], b: &[BigRational; 4]) -> [BigRational; 3] {
    let minor = |i: usize, j: usize| &a[i] * &b[j] - &a[j] * &b[i];
    [minor(1, 2), minor(2, 0), minor(0, 1)]
}

/// Of the first three.
fn dot(a: &[BigRational; 4], b: &[BigRational]) -> BigRational {
    a[..3].iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Whether an instance reaches nearly to the last number, together with the room that its rays need.
fn lies_beyond<T: Precision>(geometries: &[Scene<T>], instance: &Instance) -> bool {
    let Some(geometry) = geometries.get(instance.geometry_id as usize) else { return false };
    let Extent { min, max } = Extent::of(geometry.mesh());
    let column = |k: usize| DVec3::from(instance.to_world.map(|row| row[k]));
    let to_world = DAffine3::from_cols(column(0), column(1), column(2), column(3));
    let corner = |bits: usize| {
        let corner = [0, 1, 2].map(|k| if bits >> k & 1 == 0 { min[k] } else { max[k] });
        let placed = to_world.transform_point3(corner.into()).abs();
        // A sum of infinities is none.
        if placed.is_nan() { f64::INFINITY } else { placed.max_element() }
    };
    let farthest = (0..8).map(corner).fold(0.0, f64::max);
    let room = CARRYING_ERROR
        * uneven(&to_world.matrix3)
        * (farthest + to_world.translation.abs().max_element());
    // What is not a number is beyond as well.
    let is_within = farthest + room < f64::MAX / 4.0;
    !is_within
}

/// How unevenly a matrix stretches.
pub(super) fn uneven(matrix: &DMat3) -> f64 {
    let largest =
        matrix.to_cols_array().iter().fold(f64::MIN_POSITIVE, |most, x| most.max(x.abs()));
    let scaled = DMat3::from_cols_array(&matrix.to_cols_array().map(|x| x / largest));
    let size = |it: &DMat3| it.to_cols_array().iter().map(|x| x * x).sum::<f64>().sqrt();
    size(&scaled) * size(&scaled.inverse())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::meshes::torus;
    use kdray::{BuildOptions, InstancedScene};

    /// The matrix that stretches the axes by that much, and moves all of them alike.
    fn stretched(by: [f64; 3], offset: f64) -> [[f64; 4]; 3] {
        std::array::from_fn(|row| {
            let mut numbers = [0.0, 0.0, 0.0, offset];
            numbers[row] = by[row];
            numbers
        })
    }

    fn check_matrix(to_world: [[f64; 4]; 3]) -> Option<InstancedSceneError> {
        let geometry = Scene::build(torus(5, 4), &BuildOptions::default()).unwrap();
        let instances = vec![Instance::of(0), Instance::of(0).placed(to_world)];
        let built = InstancedScene::build(vec![geometry.clone()], instances.clone());
        let error = built.err()?;
        check(&[geometry], &instances, &error);
        Some(error)
    }

    #[test]
    fn what_is_refused_is_flat_or_far_or_no_number() {
        let singular = Some(InstanceError::Singular(1).into());
        let beyond = Some(InstanceError::OutOfRange(1).into());
        let turned = [[1.0, 2.0, 3.0, 0.0], [4.0, 5.0, 6.0, 0.0], [7.0, 8.0, 9.0, 0.0]];
        assert_eq!(check_matrix(turned), singular);
        assert_eq!(check_matrix(stretched([1.0, 0.0, 1.0], 0.0)), singular);
        assert_eq!(check_matrix(stretched([1.0, f64::NAN, 1.0], 0.0)), singular);
        assert_eq!(check_matrix(stretched([1e-310; 3], 0.0)), singular);
        assert_eq!(check_matrix(stretched([1e-200; 3], 1e200)), singular);
        assert_eq!(check_matrix(stretched([1e308; 3], 1.7e308)), beyond);
        assert_eq!(check_matrix(stretched([1.0, 1e60, 1.0], 0.0)), None);
        assert_eq!(check_matrix(stretched([1.0; 3], 1e300)), None);
        assert_eq!(check_matrix(stretched([1.0, 1e-3, 2.0], 5.0)), None);
    }

    fn check_claim(error: InstanceError) {
        let geometry = Scene::build(torus(5, 4), &BuildOptions::default()).unwrap();
        let placed = Instance::of(0).placed(stretched([1e-5, 1.0, 1e3], 1e30));
        check(&[geometry], &[placed], &error.into());
    }

    #[test]
    #[should_panic(expected = "Singular")]
    fn a_matrix_that_can_be_inverted_is_not_singular() {
        let geometry = Scene::build(torus(5, 4), &BuildOptions::default()).unwrap();
        let turned = [[0.6, -0.8, 0.0, 0.1], [0.8, 0.6, 0.0, 0.2], [0.0, 0.0, 1.5, 0.3]];
        let error = InstanceError::Singular(0).into();
        check(&[geometry], &[Instance::of(0).placed(turned)], &error);
    }

    #[test]
    #[should_panic(expected = "OutOfRange")]
    fn what_is_near_is_not_out_of_range() {
        check_claim(InstanceError::OutOfRange(0));
    }

    #[test]
    #[should_panic(expected = "NoSuchGeometry")]
    fn a_geometry_that_is_there_is_not_missing() {
        let (instance, geometry_id, geometries) = (0, 0, 1);
        check_claim(InstanceError::NoSuchGeometry { instance, geometry_id, geometries });
    }
}
