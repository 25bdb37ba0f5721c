//! Collects vertices and polygons into a model.

use super::repeated::Repeated;
use super::rounding::coarse_step;
use super::triangulate::{MAX_CONCAVE_CORNERS, triangulate};
use crate::formats::Request;
use crate::{LoadError, Model, Place};
use glam::Vec3;

/// A corner of a polygon, and what the file says of it.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Corner {
    /// The index as it stands in the file, perhaps out of range.
    pub(crate) vertex: i64,
    pub(crate) normal: Option<[f32; 3]>,
    /// (0, 0) is the image's upper left.
    pub(crate) uv: Option<[f32; 2]>,
    /// Linear.
    pub(crate) color: Option<[f32; 3]>,
}

/// A model in the making. Its per-triangle lists may still be shorter than `triangles`.
pub(crate) struct MeshBuilder<'a> {
    pub(crate) model: Model,
    /// The material of the polygons that follow.
    pub(crate) material: Option<u32>,
    /// How the file numbers its first vertex, for messages.
    pub(crate) first_index: i64,
    request: &'a Request<'a>,
    points: Vec<[f32; 3]>,
    split: Vec<[u32; 3]>,
    dropped: u64,
    first_dropped: String,
    without_area: u64,
    repeated: Repeated,
}

/// Stands for "no material" until the end.
const NO_MATERIAL: u32 = u32::MAX;

/// How many vertices a model may have, so that their number has 32 bits, too.
const MAX_VERTICES: u32 = u32::MAX;

/// The index of the next of so many vertices, if there may be one more.
fn next_index(vertices: usize) -> Option<u32> {
    u32::try_from(vertices).ok().filter(|&index| index < MAX_VERTICES)
}

impl<'a> MeshBuilder<'a> {
    pub(crate) fn new(request: &'a Request<'a>) -> Self {
        Self {
            model: Model::default(),
            material: None,
            first_index: 0,
            request,
            points: Vec::new(),
            split: Vec::new(),
            dropped: 0,
            first_dropped: String::new(),
            without_area: 0,
            repeated: Repeated::default(),
        }
    }

    /// Adds what the user should know, of which there are few in any file.
    pub(crate) fn warn(&mut self, warning: impl Into<String>) {
        self.model.warnings.push(format!("{}: {}", self.request.file, warning.into()));
    }

    /// Adds what the user should know, of which a file can have many. After a hundred of a kind the
    /// rest is counted: "9 more textures left out".
    pub(crate) fn warn_often(&mut self, kind: &'static str, warning: String) {
        if self.repeated.count(kind) {
            self.warn(warning);
        }
    }

    /// Adds a vertex and tells its index, or refuses one more than indices can count.
    pub(crate) fn vertex(
        &mut self,
        position: [f32; 3],
        place: impl Fn() -> Place,
    ) -> Result<u32, LoadError> {
        let index = next_index(self.model.vertices.len()).ok_or_else(|| {
            let reason = format!("more than {MAX_VERTICES} vertices; split the file");
            self.request.invalid(place(), reason)
        })?;
        self.model.vertices.push(position);
        Ok(index)
    }

    /// Adds a polygon of vertices that are there already, split into triangles. One that uses a
    /// vertex that is not there or not finite is refused, or dropped and counted.
    pub(crate) fn polygon(
        &mut self,
        corners: &[Corner],
        place: impl Fn() -> Place,
    ) -> Result<(), LoadError> {
        if let Some(reason) = self.gather_points(corners) {
            return self.refuse_or_drop(place(), reason);
        }
        if corners.len() < 3 {
            self.without_area += 1;
            return Ok(());
        }
        let mut split = std::mem::take(&mut self.split);
        if triangulate(&self.points, &mut split).is_err() {
            let reason = format!("a concave polygon of more than {MAX_CONCAVE_CORNERS} corners");
            return Err(self.request.invalid(place(), reason));
        }
        for triangle in &split {
            self.triangle(triangle.map(|i| &corners[i as usize]));
        }
        self.split = split;
        Ok(())
    }

    /// Puts the corners' positions into `points`, or says what is wrong with one.
    fn gather_points(&mut self, corners: &[Corner]) -> Option<String> {
        self.points.clear();
        let vertices = &self.model.vertices;
        for &Corner { vertex, .. } in corners {
            let name = vertex.saturating_add(self.first_index);
            let Some(position) = usize::try_from(vertex).ok().and_then(|i| vertices.get(i)) else {
                return Some(format!(
                    "vertex index {name} is out of range: there are {} vertices",
                    vertices.len()
                ));
            };
            if !position.iter().all(|x| x.is_finite()) {
                return Some(format!("vertex {name} at {position:?} is not finite"));
            }
            self.points.push(*position);
        }
        None
    }

    /// Refuses a polygon, or drops and counts it if the caller of the library asked for that.
    pub(crate) fn refuse_or_drop(
        &mut self,
        place: Place,
        reason: impl Into<String>,
    ) -> Result<(), LoadError> {
        let reason = reason.into();
        if !self.request.options.drop_bad {
            return Err(self.request.invalid(place, reason));
        }
        if self.dropped == 0 {
            self.first_dropped = format!("{place}: {reason}");
        }
        self.dropped += 1;
        Ok(())
    }

    fn triangle(&mut self, corners: [&Corner; 3]) {
        let model = &mut self.model;
        model.triangles.push(corners.map(|corner| corner.vertex as u32));
        let index = model.triangles.len() - 1;
        if corners.iter().any(|corner| corner.normal.is_some()) {
            fill_normals(model, index);
            let flat = geometric_normal(model, index);
            model.normals.push(corners.map(|corner| unit_or(corner.normal, flat)));
        }
        if corners.iter().any(|corner| corner.uv.is_some()) {
            model.uvs.resize(index, [[0.0; 2]; 3]);
            model.uvs.push(corners.map(|corner| finite_or(corner.uv, [0.0; 2])));
        }
        if corners.iter().any(|corner| corner.color.is_some()) {
            model.colors.resize(index, [[1.0; 3]; 3]);
            model.colors.push(corners.map(|corner| finite_or(corner.color, [1.0; 3])));
        }
        if let Some(material) = self.material {
            model.material_ids.resize(index, NO_MATERIAL);
            model.material_ids.push(material);
        }
    }

    /// The model, with lists that are empty or complete, and warnings about what was left out.
    pub(crate) fn finish(mut self) -> Model {
        self.fill_lists();
        for rest in self.repeated.rest() {
            self.warn(rest);
        }
        if self.dropped > 0 {
            let (count, first) = (self.dropped, std::mem::take(&mut self.first_dropped));
            self.warn(format!("bad polygons dropped: {count}, the first at {first}"));
        }
        if self.without_area > 0 {
            let count = self.without_area;
            self.warn(format!("polygons of fewer than three corners passed over: {count}"));
        }
        if self.model.triangles.is_empty() {
            let vertices = match self.model.vertices.len() {
                1 => "1 vertex".to_owned(),
                count => format!("{count} vertices"),
            };
            self.warn(format!("no triangles (and {vertices})"));
        }
        if let Some(step) = coarse_step(&self.model) {
            self.warn(format!(
                "vertices are rounded to f32, which has steps of {step:?} so far from zero: what is finer is lost; \
                 move the mesh to zero beforehand"
            ));
        }
        self.model
    }

    fn fill_lists(&mut self) {
        let model = &mut self.model;
        let count = model.triangles.len();
        if !model.normals.is_empty() {
            fill_normals(model, count);
        }
        if !model.uvs.is_empty() {
            model.uvs.resize(count, [[0.0; 2]; 3]);
        }
        if !model.colors.is_empty() {
            model.colors.resize(count, [[1.0; 3]; 3]);
        }
        if !model.material_ids.is_empty() {
            model.material_ids.resize(count, NO_MATERIAL);
            if model.material_ids.contains(&NO_MATERIAL) {
                let plain = model.materials.len() as u32;
                model.materials.push(crate::Material::default());
                let missing = model.material_ids.iter_mut().filter(|id| **id == NO_MATERIAL);
                missing.for_each(|id| *id = plain);
            }
        }
    }
}

/// Gives the triangles before `end` that have no normals their geometric ones.
fn fill_normals(model: &mut Model, end: usize) {
    for index in model.normals.len()..end {
        let flat = geometric_normal(model, index);
        model.normals.push([flat; 3]);
    }
}

/// The unit normal of a triangle; the z axis for one without area.
fn geometric_normal(model: &Model, index: usize) -> [f32; 3] {
    let corner = |i: u32| glam::DVec3::from(model.vertices[i as usize].map(f64::from));
    let [a, b, c] = model.triangles[index].map(corner);
    (b - a).cross(c - a).normalize_or(glam::DVec3::Z).as_vec3().into()
}

fn unit_or(normal: Option<[f32; 3]>, fallback: [f32; 3]) -> [f32; 3] {
    let unit = normal.and_then(|normal| Vec3::from(normal).try_normalize());
    unit.map_or(fallback, Into::into)
}

fn finite_or<const N: usize>(value: Option<[f32; N]>, fallback: [f32; N]) -> [f32; N] {
    value.filter(|value| value.iter().all(|x| x.is_finite())).unwrap_or(fallback)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn indices_do_not_wrap() {
        assert_eq!(next_index(0), Some(0));
        assert_eq!(next_index(0xffff_fffe), Some(0xffff_fffe));
        assert_eq!(next_index(0xffff_ffff), None);
        assert_eq!(next_index(usize::MAX), None);
    }
}
