//! PLY (Greg Turk, 1994): a header that declares elements and their properties, then the values.
//!
//! Read by hand: `ply-rs-bw` keeps every element as a map from names to values, which takes more
//! than ten times the memory and time of the mesh itself.

mod body;
mod header;

use super::Request;
use crate::cut::cut;
use crate::input::{Scanner, read_file};
use crate::mesh::{Corner, MeshBuilder};
use crate::textures::{self, TextureDecoder};
use crate::{LoadError, Material, Model, Place, TextureRef, Wrap};
use body::{Encoding, Row, Values};
use header::{Element, Header};
use std::io::Read;

/// What a file says of its vertices, besides their positions; each list empty or complete.
#[derive(Default)]
struct VertexAttributes {
    normals: Vec<[f32; 3]>,
    uvs: Vec<[f32; 2]>,
    colors: Vec<[f32; 3]>,
}

pub(super) fn read(bytes: Box<dyn Read + '_>, request: &Request<'_>) -> Result<Model, LoadError> {
    let mut scanner = Scanner::new(bytes, request);
    let header = Header::read(&mut scanner)?;
    let mut values = Values::new(scanner, header.encoding);
    let mut builder = MeshBuilder::new(request);
    let textures = &header.textures;
    if let Some(first) = &textures.first {
        add_texture(first, &mut builder, request);
    }
    // Without the first one's name, which is told once at most.
    for other in &textures.others {
        builder.warn(format!("texture {other:?} left out: all faces have the first"));
    }
    if textures.more > 0 {
        builder.warn(format!("{} more comments `TextureFile` passed over", textures.more));
    }
    let mut attributes = VertexAttributes::default();
    let mut skipped = Vec::new();
    // Faces may come before the vertices that they use; they wait.
    let mut waiting = Vec::new();
    let vertices_at = header.elements.iter().position(|element| element.name == "vertex");
    for (position, element) in header.elements.iter().enumerate() {
        let vertices_known = vertices_at.is_some_and(|at| at <= position);
        let waiting = (!vertices_known).then_some(&mut waiting);
        match element.name.as_str() {
            "vertex" => read_vertices(&mut values, element, &mut builder, &mut attributes)?,
            "face" => read_faces(&mut values, element, &mut builder, &attributes, waiting)?,
            "tristrips" => read_strips(&mut values, element, &mut builder, &attributes, waiting)?,
            _ => {
                values.skip(element)?;
                skipped.push(format!("{} {}", element.count, element.name));
            }
        }
    }
    for (place, mut corners) in waiting {
        attributes.add_to(&mut corners);
        builder.polygon(&corners, || place.clone())?;
    }
    if !skipped.is_empty() {
        builder.warn(format!("elements passed over: {}", skipped.join(", ")));
    }
    Ok(builder.finish())
}

/// Gives all faces a white material with the texture.
fn add_texture(name: &str, builder: &mut MeshBuilder<'_>, request: &Request<'_>) {
    let limit = request.options.max_bytes;
    let file = request.siblings.find(name).and_then(|path| read_file(&path, limit));
    let decoded = file.map_err(|error| error.to_string()).and_then(|file| {
        TextureDecoder::default().decode(&file, textures::Encoding::Srgb, [Wrap::Repeat; 2])
    });
    match decoded {
        Ok(texture) => {
            builder.model.textures.push(texture);
            let texture = TextureRef { texture: 0, transform: TextureRef::IDENTITY };
            builder.model.materials.push(Material {
                base_color: [1.0; 3],
                base_color_texture: Some(texture),
                ..Material::default()
            });
            builder.material = Some(0);
        }
        Err(reason) => builder.warn(format!("texture {:?} left out: {reason}", cut(name))),
    }
}

/// Polygons read before the vertices.
type Waiting = Vec<(Place, Vec<Corner>)>;

fn read_vertices(
    values: &mut Values<'_>,
    element: &Element,
    builder: &mut MeshBuilder<'_>,
    attributes: &mut VertexAttributes,
) -> Result<(), LoadError> {
    let position = element.scalars(&["x", "y", "z"]);
    let Some(position) = position else {
        return Err(values.error(element, 0, "a vertex without the properties x, y and z"));
    };
    let normal = element.scalars(&["nx", "ny", "nz"]);
    let uv = [["s", "t"], ["u", "v"], ["texture_u", "texture_v"], ["texture_s", "texture_t"]]
        .iter()
        .find_map(|names| element.scalars(names));
    let color = element.color();
    let mut row = Row::new(element);
    for index in 0..element.count {
        values.read(element, index, &mut row)?;
        builder.vertex(row.pick(position), || element.place(index))?;
        if let Some(normal) = normal {
            attributes.normals.push(row.pick(normal));
        }
        if let Some(uv) = uv {
            attributes.uvs.push(upper_left(row.pick(uv)));
        }
        if let Some((color, unit)) = color {
            attributes.colors.push(linear(row.pick(color), unit));
        }
    }
    Ok(())
}

fn read_faces(
    values: &mut Values<'_>,
    element: &Element,
    builder: &mut MeshBuilder<'_>,
    attributes: &VertexAttributes,
    mut waiting: Option<&mut Waiting>,
) -> Result<(), LoadError> {
    let Some(indices) = element.list(&["vertex_indices", "vertex_index"]) else {
        if element.count == 0 {
            return Ok(());
        }
        return Err(values.error(element, 0, "a face without the list vertex_indices"));
    };
    let uvs = element.list(&["texcoord"]);
    let color = element.color();
    let mut row = Row::new(element);
    let mut corners = Vec::new();
    for index in 0..element.count {
        values.read(element, index, &mut row)?;
        corners.clear();
        corners.extend(row.lists[indices].iter().map(|&i| corner(i)));
        attributes.add_to(&mut corners);
        if let Some(uvs) = uvs.map(|list| &row.lists[list])
            && uvs.len() == 2 * corners.len()
        {
            for (corner, uv) in corners.iter_mut().zip(uvs.chunks_exact(2)) {
                corner.uv = Some(upper_left([uv[0] as f32, uv[1] as f32]));
            }
        }
        if let Some((color, unit)) = color {
            let color = linear(row.pick(color), unit);
            corners.iter_mut().for_each(|corner| corner.color = corner.color.or(Some(color)));
        }
        add_polygon(builder, &corners, element, index, waiting.as_deref_mut())?;
    }
    Ok(())
}

/// Triangle strips; −1 ends one, every other triangle is turned over.
fn read_strips(
    values: &mut Values<'_>,
    element: &Element,
    builder: &mut MeshBuilder<'_>,
    attributes: &VertexAttributes,
    mut waiting: Option<&mut Waiting>,
) -> Result<(), LoadError> {
    let Some(indices) = element.list(&["vertex_indices", "vertex_index"]) else {
        return Err(values.error(element, 0, "a strip without the list vertex_indices"));
    };
    let mut row = Row::new(element);
    for index in 0..element.count {
        values.read(element, index, &mut row)?;
        for strip in row.lists[indices].split(|&i| i == -1.0) {
            for (step, window) in strip.windows(3).enumerate() {
                let [a, b, c] = [window[0], window[1], window[2]];
                let turned = if step % 2 == 0 { [a, b, c] } else { [b, a, c] };
                let mut corners = turned.map(corner);
                attributes.add_to(&mut corners);
                add_polygon(builder, &corners, element, index, waiting.as_deref_mut())?;
            }
        }
    }
    Ok(())
}

fn add_polygon(
    builder: &mut MeshBuilder<'_>,
    corners: &[Corner],
    element: &Element,
    index: u64,
    waiting: Option<&mut Waiting>,
) -> Result<(), LoadError> {
    let place = || element.place(index);
    match waiting {
        Some(waiting) => waiting.push((place(), corners.to_vec())),
        None => builder.polygon(corners, place)?,
    }
    Ok(())
}

/// A corner without attributes. Indices that are no integers become one that is out of range.
fn corner(index: f64) -> Corner {
    let vertex = if index.fract() == 0.0 { index as i64 } else { -1 };
    Corner { vertex, ..Corner::default() }
}

impl VertexAttributes {
    fn add_to(&self, corners: &mut [Corner]) {
        if self.normals.is_empty() && self.uvs.is_empty() && self.colors.is_empty() {
            return;
        }
        for corner in corners {
            let index = usize::try_from(corner.vertex).unwrap_or(usize::MAX);
            corner.normal = self.normals.get(index).copied();
            corner.uv = self.uvs.get(index).copied();
            corner.color = self.colors.get(index).copied();
        }
    }
}

/// PLY has (0, 0) at the image's lower left.
fn upper_left([u, v]: [f32; 2]) -> [f32; 2] {
    [u, 1.0 - v]
}

/// Colours are stored for display: 0 to `unit`, sRGB.
fn linear(color: [f32; 3], unit: f32) -> [f32; 3] {
    color.map(|channel| crate::srgb::to_linear(channel / unit))
}
