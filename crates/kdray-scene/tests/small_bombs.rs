//! Small files that ask for much memory or time: refused, or read without.

#![expect(clippy::unwrap_used, reason = "a test may panic in its helpers, too")]

use kdray_scene::{Format, LoadError, LoadOptions, Model, load, read};
use std::path::Path;
use std::time::{Duration, Instant};

/// `count` times the same, with commas between.
fn list(what: &str, count: usize) -> String {
    vec![what; count].join(",")
}

/// 0 to `count`, with commas between.
fn indices(count: usize) -> String {
    (0..count).map(|i| i.to_string()).collect::<Vec<_>>().join(",")
}

/// Reads a document; more time than any small file needs, on a busy machine too, fails the test.
fn gltf(members: &str) -> Result<Model, LoadError> {
    let text = format!("{{\"asset\":{{\"version\":\"2.0\"}},{members}}}");
    let start = Instant::now();
    let result = read(text.as_bytes(), Format::Gltf, "small", &LoadOptions::default());
    assert!(start.elapsed() < Duration::from_secs(60), "takes {:?}", start.elapsed());
    result
}

/// So many nodes with a mesh and a skin of so many joints, which no buffer backs.
fn skinned(nodes: usize, joints: usize) -> Result<Model, LoadError> {
    gltf(&format!(
        r#""scenes":[{{"nodes":[{}]}}],"nodes":[{}],"skins":[{{"joints":[{}]}}],
        "meshes":[{{"primitives":[{{"attributes":{{}},"mode":0}}]}}]"#,
        indices(nodes),
        list(r#"{"mesh":0,"skin":0}"#, nodes),
        list("0", joints),
    ))
}

#[test]
fn a_skin_takes_memory_once_for_all_nodes() {
    assert!(skinned(100, 20_000).unwrap().triangles.is_empty());
}

#[test]
fn skins_of_more_joints_than_bytes_are_refused() {
    let message = skinned(1, 300_000).unwrap_err().to_string();
    assert!(message.contains("skins[0]: there are many more numbers"), "{message}");
}

/// A mesh of so many primitives, all over the same `vertices` that no buffer backs, in so many
/// nodes with a skin.
fn primitives(
    primitive: &str,
    count: usize,
    vertices: usize,
    nodes: usize,
) -> Result<Model, LoadError> {
    gltf(&format!(
        r#""nodes":[{}],"skins":[{{"joints":[0]}}],"meshes":[{{"primitives":[{}]}}],
        "accessors":[{{"componentType":5126,"count":{vertices},"type":"VEC3"}},
        {{"componentType":5126,"count":{vertices},"type":"VEC4"}},
        {{"componentType":5125,"count":3,"type":"SCALAR"}}]"#,
        list(r#"{"mesh":0,"skin":0}"#, nodes),
        list(primitive, count),
    ))
}

#[test]
fn triangles_without_indices_do_not_multiply() {
    let result = primitives(r#"{"attributes":{"POSITION":0}}"#, 1000, 100_000, 1);
    let message = result.unwrap_err().to_string();
    assert!(message.contains("]: there are many more numbers than bytes"), "{message}");
}

#[test]
fn primitives_of_one_triangle_do_not_place_all_vertices() {
    let primitive = r#"{"attributes":{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":1},"indices":2}"#;
    let model = primitives(primitive, 20_000, 300_000, 1).unwrap();
    assert_eq!((model.triangles.len(), model.vertices.len()), (20_000, 1));
}

#[test]
fn primitives_without_triangles_do_not_take_all_day() {
    let result = primitives(r#"{"attributes":{"POSITION":0}}"#, 20_000, 1, 20_000);
    let message = result.unwrap_err().to_string();
    assert!(message.contains("triangles, vertices or primitives"), "{message}");
}

/// Loads a file with at most 100,000 bytes a file, after writing it and those beside it.
fn load_first(folder: &Path, files: &[(&str, &[u8])]) -> Result<Model, LoadError> {
    for (name, content) in files {
        std::fs::write(folder.join(name), content).unwrap();
    }
    let options = LoadOptions { max_bytes: 100_000, ..LoadOptions::default() };
    load(&folder.join(files[0].0), &options)
}

/// A document with buffers at these URIs, and an accessor that no buffer backs.
fn buffers(uris: &[&str], count: usize) -> String {
    let buffers: Vec<String> =
        uris.iter().map(|uri| format!("{{\"uri\":\"{uri}\",\"byteLength\":1}}")).collect();
    format!(
        r#"{{"asset":{{"version":"2.0"}},"buffers":[{}],"nodes":[{{"mesh":0}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}}}}]}}],
        "accessors":[{{"componentType":5126,"count":{count},"type":"VEC3"}}]}}"#,
        buffers.join(",")
    )
}

#[test]
fn a_file_of_many_buffers_is_read_once() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("d")).unwrap();
    let uris = ["a.bin", "./a.bin", "d/../a.bin", "%61.bin", ".\\\\a.bin"].repeat(100);
    let bytes = [0; 40_000];
    let text = buffers(&uris, 3);
    load_first(folder.path(), &[("a.gltf", text.as_bytes()), ("a.bin", &bytes)]).unwrap();
    // Nor does each count for how many numbers there may be.
    let text = buffers(&uris, 4_000_000);
    let result = load_first(folder.path(), &[("a.gltf", text.as_bytes()), ("a.bin", &bytes)]);
    let message = result.unwrap_err().to_string();
    assert!(message.contains("many more numbers than bytes"), "{message}");
}

#[test]
fn buffers_together_have_a_limit() {
    let folder = tempfile::tempdir().unwrap();
    let (text, bytes) = (buffers(&["a.bin", "b.bin", "c.bin"], 3), [0; 40_000]);
    let files =
        [("a.gltf", text.as_bytes()), ("a.bin", &bytes), ("b.bin", &bytes), ("c.bin", &bytes)];
    let message = load_first(folder.path(), &files).unwrap_err().to_string();
    assert!(message.contains("buffers[2]: all buffers have more than 100000 bytes"), "{message}");
}

#[test]
fn a_material_library_is_read_once() {
    let folder = tempfile::tempdir().unwrap();
    let obj = "mtllib a.mtl\nmtllib a.mtl ./a.mtl\nmtllib a.mtl\nv 0 0 0\nusemtl m\nf 1 1 1\n";
    // Each time that it is read, it is too long.
    let mtl = "newmtl m\n".repeat(20_000);
    let files = [("a.obj", obj.as_bytes()), ("a.mtl", mtl.as_bytes())];
    let model = load_first(folder.path(), &files).unwrap();
    let left_out = model.warnings.iter().filter(|warning| warning.contains("longer than"));
    assert_eq!(left_out.count(), 1, "{:?}", model.warnings);
}

/// The warnings of a file that names these material libraries, which are not there.
fn warnings_of_libraries(names: &str) -> Vec<String> {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("a.obj"), format!("{names}\nv 0 0 0\nf 1 1 1\n")).unwrap();
    load(&folder.path().join("a.obj"), &LoadOptions::default()).unwrap().warnings
}

#[test]
fn a_missing_material_library_is_missed_once() {
    let names = format!("mtllib{}{}", " a".repeat(100_000), "\nmtllib a\nmtllib a b".repeat(1000));
    let warnings = warnings_of_libraries(&names);
    assert_eq!(warnings.len(), 2, "{:?}", &warnings[..3]);
    assert!(warnings[0].contains("line 1: material library left out: a: "), "{warnings:?}");
    assert!(warnings[1].contains("line 3: material library left out: b: "), "{warnings:?}");
}

#[test]
fn many_missing_material_libraries_are_counted() {
    let names = (0..5000).map(|i| format!(" {i}")).collect::<String>();
    let warnings = warnings_of_libraries(&format!("mtllib{names}"));
    assert_eq!(warnings.len(), 101);
    assert!(warnings[99].contains("left out: 99: "), "{}", warnings[99]);
    assert!(warnings[100].ends_with(": 4900 more material libraries left out"), "{warnings:?}");
}

fn png() -> Vec<u8> {
    let mut file = std::io::Cursor::new(Vec::new());
    image::RgbImage::new(5, 3).write_to(&mut file, image::ImageFormat::Png).unwrap();
    file.into_inner()
}

#[test]
fn an_image_of_many_names_is_decoded_once() {
    let folder = tempfile::tempdir().unwrap();
    let obj = "mtllib a.mtl\nv 0 0 0\nusemtl m\nf 1 1 1\nusemtl n\nf 1 1 1\n";
    let mtl = "newmtl m\nmap_Kd a.png\nmap_Ke ./a.png\nnewmtl n\nmap_Kd .\\\\a.png\n";
    let files = [("a.obj", obj.as_bytes()), ("a.mtl", mtl.as_bytes()), ("a.png", &png())];
    let model = load_first(folder.path(), &files).unwrap();
    assert_eq!(model.textures.len(), 1);
    assert_eq!(model.materials[1].base_color_texture.unwrap().texture, 0);
}

/// Textures of images, each shown by a material of its own; the last two clamp.
const TEXTURES: &str = r#"{"asset":{"version":"2.0"},
"images":[{"uri":"a.png"},{"uri":"./a.png"},{"bufferView":0,"mimeType":"image/png"},
{"bufferView":0,"mimeType":"image/png"},{"uri":"gone.png"}],
"samplers":[{"wrapS":33071}],
"textures":[{"source":0},{"source":0},{"source":1},{"source":2},{"source":3},{"source":4},
{"source":4},{"source":0,"sampler":0},{"source":1,"sampler":0}],
"materials":[MATERIALS],
"buffers":[{"uri":"a.png","byteLength":1}],
"bufferViews":[{"buffer":0,"byteLength":LENGTH}]}"#;

#[test]
fn an_image_of_many_textures_is_decoded_once() {
    let folder = tempfile::tempdir().unwrap();
    let material =
        |i| format!(r#"{{"pbrMetallicRoughness":{{"baseColorTexture":{{"index":{i}}}}}}}"#);
    let materials: Vec<String> = (0..9).map(material).collect();
    let text = TEXTURES.replace("MATERIALS", &materials.join(","));
    let text = text.replace("LENGTH", &png().len().to_string());
    let files = [("a.gltf", text.as_bytes()), ("a.png", &png())];
    let model = load_first(folder.path(), &files).unwrap();
    let used = model.materials.iter().map(|m| m.base_color_texture.map(|texture| texture.texture));
    let (file, view, clamped) = (Some(0), Some(1), Some(2));
    let expected = [file, file, file, view, view, None, None, clamped, clamped];
    assert_eq!(used.collect::<Vec<_>>(), expected);
    assert_eq!(model.textures.len(), 3);
    let left_out =
        |i| model.warnings.iter().any(|w| w.contains(&format!("textures[{i}] left out")));
    assert!(left_out(5) && left_out(6), "{:?}", model.warnings);
}

#[test]
fn a_broken_image_is_not_decoded_time_and_again() {
    let mut file = std::io::Cursor::new(Vec::new());
    image::GrayImage::new(1280, 1280).write_to(&mut file, image::ImageFormat::Png).unwrap();
    let mut broken = file.into_inner();
    broken.truncate(broken.len() / 2);
    let views = 2000;
    let each = |text: &str| {
        (0..views).map(|i| text.replace('#', &i.to_string())).collect::<Vec<_>>().join(",")
    };
    let data: String = broken.iter().map(|byte| format!("%{byte:02x}")).collect();
    let view = format!("{{\"buffer\":0,\"byteLength\":{}}}", broken.len());
    let model = gltf(&format!(
        r#""images":[{}],"textures":[{}],"materials":[{}],"bufferViews":[{}],
        "buffers":[{{"byteLength":{},"uri":"data:;,{data}"}}]"#,
        each(r##"{"bufferView":#,"mimeType":"image/png"}"##),
        each(r##"{"source":#}"##),
        each(r##"{"pbrMetallicRoughness":{"baseColorTexture":{"index":#}}}"##),
        list(&view, views),
        broken.len(),
    ));
    let warnings = model.unwrap().warnings;
    let tried = warnings.iter().filter(|warning| !warning.contains("all textures would have"));
    // One counts the warnings from the hundred and first on, and one is about the triangles that
    // are not there.
    assert_eq!(tried.count(), (128 << 20) / (1280 * 1280) + 2);
}
