//! Files of meshes.

use kdray::TriangleMesh;
use kdray_scene::{Format, LoadError, LoadOptions, Model, load};
use std::fs;
use tempfile::TempDir;

/// What separates files that come in one input.
pub const SEPARATOR: u8 = 0;

/// More than any input has, and little enough for what compression makes of one.
const MAX_BYTES: u64 = 1 << 20;

/// Reads a file as a stream, as strictly as can be and with bad triangles dropped.
pub fn read(format: Format, data: &[u8]) {
    let strict = read_with(format, data, false);
    let lenient = read_with(format, data, true);
    if let Ok(strict) = strict {
        let lenient = lenient.expect("what is read strictly is read leniently");
        assert!(strict == lenient || is_nan_somewhere(&strict), "nothing is dropped of good files");
    }
}

fn read_with(format: Format, data: &[u8], drop_bad: bool) -> Result<Model, LoadError> {
    let options = LoadOptions { format: Some(format), max_bytes: MAX_BYTES, drop_bad };
    let model = kdray_scene::read(data, format, "fuzz", &options);
    match &model {
        Ok(model) => check(model),
        Err(error) => assert!(error.to_string().contains("fuzz"), "{error} names the file"),
    }
    model
}

/// Whether a model is not equal to itself.
#[expect(clippy::eq_op, reason = "NaN is not equal to itself")]
fn is_nan_somewhere(model: &Model) -> bool {
    model != model
}

/// What [`Model`] promises.
fn check(model: &Model) {
    let count = model.triangles.len();
    let lists =
        [model.normals.len(), model.uvs.len(), model.colors.len(), model.material_ids.len()];
    assert!(lists.iter().all(|&length| length == 0 || length == count), "{lists:?} of {count}");
    let in_range = |&id: &u32| (id as usize) < model.materials.len().max(1);
    assert!(model.material_ids.iter().all(in_range), "{:?}", model.material_ids);
    for texture in &model.textures {
        assert!(texture.width > 0 && texture.height > 0, "an image has pixels");
    }
    let mesh = TriangleMesh::new(model.vertices.clone(), model.triangles.clone());
    assert!(mesh.is_ok(), "{:?}", mesh.err());
}

/// An OBJ file; behind the first zero its material library, behind the second the picture that that may name.
///
/// # Panics
/// If the temporary folder cannot be written, or kdray fails.
pub fn obj(data: &[u8]) {
    thread_local! {
        static FOLDER: TempDir = tempfile::tempdir().expect("there is room for temporary files");
    }
    read(Format::Obj, data);
    let mut parts = data.splitn(3, |&byte| byte == SEPARATOR);
    let names = ["fuzz.obj", "a.mtl", "b.png"];
    FOLDER.with(|folder| {
        for name in names {
            let part = parts.next().unwrap_or_default();
            fs::write(folder.path().join(name), part).expect("temporary files are written");
        }
        let options = LoadOptions { max_bytes: MAX_BYTES, ..LoadOptions::default() };
        if let Ok(model) = load(&folder.path().join(names[0]), &options) {
            check(&model);
        }
    });
}

/// A GLB file as it is; or else JSON, and behind the first zero the binary part, which are put into one.
pub fn glb(data: &[u8]) {
    if data.starts_with(b"glTF") {
        return read(Format::Gltf, data);
    }
    let mut parts = data.splitn(2, |&byte| byte == SEPARATOR);
    let [json, binary] = [(); 2].map(|()| parts.next().unwrap_or_default());
    read(Format::Gltf, &container(json, binary));
}

/// A GLB file of two chunks.
pub fn container(json: &[u8], binary: &[u8]) -> Vec<u8> {
    let chunk = |kind: &[u8; 4], content: &[u8], fill: u8| {
        let length = content.len().next_multiple_of(4);
        let mut chunk = [&(length as u32).to_le_bytes(), &kind[..], content].concat();
        chunk.resize(8 + length, fill);
        chunk
    };
    let chunks = [chunk(b"JSON", json, b' '), chunk(b"BIN\0", binary, 0)].concat();
    let length = 12 + chunks.len() as u32;
    [b"glTF\x02\0\0\0", &length.to_le_bytes()[..], &chunks].concat()
}

/// A compressed file: the format is that of its content.
pub fn compressed(data: &[u8]) {
    read(Format::Ply, data);
    read(Format::Off, data);
}
