//! How vertices get to the world.

use super::meshes::Instance;
use super::parts::Part;
use glam::{DMat3, DMat4};

/// How a vertex gets to the world.
#[derive(Clone, Copy)]
pub(super) struct Placement {
    pub(super) position: DMat4,
    /// The cofactors of the linear part: the inverse transposed, times the determinant, which also
    /// exists for flat transforms.
    pub(super) normal: DMat3,
    /// The transform turns left hands into right ones.
    pub(super) mirrors: bool,
}

impl Placement {
    fn new(position: DMat4) -> Self {
        let [x, y, z] =
            [position.x_axis, position.y_axis, position.z_axis].map(glam::DVec4::truncate);
        let mirrors = x.cross(y).dot(z) < 0.0;
        let sign = if mirrors { -1.0 } else { 1.0 };
        let normal = DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y)) * sign;
        Self { position, normal, mirrors }
    }
}

/// Where the vertices of a part go.
pub(super) struct Placements<'a> {
    whole: Placement,
    part: &'a Part,
    instance: &'a Instance,
}

impl<'a> Placements<'a> {
    pub(super) fn new(part: &'a Part, instance: &'a Instance) -> Self {
        Self { whole: Placement::new(instance.transform), part, instance }
    }

    /// Made for each corner anew: many parts may share many vertices, of which each uses a few.
    pub(super) fn of(&self, vertex: usize) -> Placement {
        let Some(skin) = &self.instance.skin else { return self.whole };
        let joints = self.part.joints.get(vertex).zip(self.part.weights.get(vertex));
        let skinned = joints.and_then(|(&joints, &weights)| skin.transform(joints, weights));
        skinned.map_or(self.whole, Placement::new)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    #[test]
    fn mirrors_are_known_and_normals_stay_outside() {
        let mirror = Placement::new(DMat4::from_scale(DVec3::new(-2.0, 1.0, 1.0)));
        assert!(mirror.mirrors);
        assert!((mirror.normal * DVec3::X).x < 0.0, "the side that faced +x now faces -x");
        assert!((mirror.normal * DVec3::Y).y > 0.0);
        let turned = Placement::new(DMat4::from_scale(DVec3::new(-1.0, -1.0, 1.0)));
        assert!(!turned.mirrors);
    }
}
