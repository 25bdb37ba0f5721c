//! Which vertices of glTF files arrive in the model.

use kdray_scene::{Format, LoadError, LoadOptions, Model, read};

/// Five vertices, the last not finite.
const POSITIONS: [[f32; 3]; 5] =
    [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [f32::NAN, 0.0, 0.0]];

fn escaped(bytes: impl IntoIterator<Item = u8>) -> String {
    bytes.into_iter().map(|byte| format!("%{byte:02x}")).collect()
}

fn list(items: impl IntoIterator<Item = String>) -> String {
    items.into_iter().collect::<Vec<_>>().join(",")
}

/// Meshes of primitives of one triangle each, all over the same positions, which are also the
/// normals; a node a mesh.
fn read_meshes(meshes: &[&[[u8; 3]]], drop_bad: bool) -> Result<Model, LoadError> {
    let triangles = meshes.concat();
    let accessor = |i| {
        let offset = 3 * i;
        format!(
            r#"{{"bufferView":1,"byteOffset":{offset},"componentType":5121,"count":3,"type":"SCALAR"}}"#
        )
    };
    let primitive =
        |i| format!(r#"{{"attributes":{{"POSITION":0,"NORMAL":0}},"indices":{}}}"#, i + 1);
    let mut next = 0..triangles.len();
    let mesh = |mesh: &&[_]| {
        format!(
            r#"{{"primitives":[{}]}}"#,
            list(mesh.iter().flat_map(|_| next.next()).map(primitive))
        )
    };
    let text = format!(
        r#"{{"asset":{{"version":"2.0"}},"nodes":[{}],"meshes":[{}],
        "accessors":[{{"bufferView":0,"componentType":5126,"count":5,"type":"VEC3"}},{}],
        "bufferViews":[{{"buffer":0,"byteLength":60}},{{"buffer":1,"byteLength":{length}}}],
        "buffers":[{{"byteLength":60,"uri":"data:;,{}"}},
        {{"byteLength":{length},"uri":"data:;,{}"}}]}}"#,
        list((0..meshes.len()).map(|i| format!(r#"{{"mesh":{i}}}"#))),
        list(meshes.iter().map(mesh)),
        list((0..triangles.len()).map(accessor)),
        escaped(POSITIONS.as_flattened().iter().flat_map(|x| x.to_le_bytes())),
        escaped(triangles.concat()),
        length = 3 * triangles.len(),
    );
    let options = LoadOptions { drop_bad, ..LoadOptions::default() };
    read(text.as_bytes(), Format::Gltf, "test", &options)
}

#[test]
fn only_the_vertices_in_use_arrive_in_the_order_of_the_file() {
    let model = read_meshes(&[&[[3, 1, 2]], &[[0, 2, 3]]], false).unwrap();
    assert_eq!(model.triangles, [[2, 0, 1], [3, 4, 5]]);
    let [o, x, y, z, _] = POSITIONS;
    assert_eq!(model.vertices, [x, y, z, o, y, z]);
    assert_eq!(model.normals[0], [z, x, y], "normals go with their vertices");
}

#[test]
fn primitives_of_a_mesh_share_the_vertices_that_they_use() {
    let model = read_meshes(&[&[[3, 1, 2], [1, 0, 3]]], false).unwrap();
    assert_eq!((model.vertices.len(), model.triangles), (4, vec![[3, 1, 2], [1, 0, 3]]));
    let model = read_meshes(&[&[[3, 1, 2], [1, 3, 2]]], false).unwrap();
    assert_eq!((model.vertices.len(), model.triangles), (3, vec![[2, 0, 1], [0, 2, 1]]));
}

#[test]
fn messages_number_vertices_as_the_file_does() {
    for (bad, reason) in [
        ([2, 4, 3], "vertex 4 at [NaN, NaN, NaN] is not finite"),
        ([2, 3, 7], "vertex index 7 is out of range: there are 5 vertices"),
    ] {
        let meshes: [&[_]; 2] = [&[[1, 2, 3]], &[[3, 2, 1], bad]];
        let message = read_meshes(&meshes, false).unwrap_err().to_string();
        let expected = format!("test: meshes[1].primitives[1] triangle 0: {reason}");
        assert_eq!(message, expected);
        let model = read_meshes(&meshes, true).unwrap();
        assert_eq!(model.triangles[0], [0, 1, 2]);
        assert_eq!(model.triangles.len(), 2);
        assert!(model.warnings[0].ends_with(reason), "{:?}", model.warnings);
    }
}

/// Together their lists would have 40 million vertices.
#[test]
fn many_meshes_may_share_a_long_list_of_vertices() {
    let mesh = r#"{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}"#;
    let text = format!(
        r#"{{"asset":{{"version":"2.0"}},"nodes":[{}],"meshes":[{}],
        "accessors":[{{"componentType":5126,"count":100000,"type":"VEC3"}},
        {{"componentType":5125,"count":3,"type":"SCALAR"}}]}}"#,
        list((0..400).map(|i| format!(r#"{{"mesh":{i}}}"#))),
        list(vec![mesh.to_owned(); 400]),
    );
    let model = read(text.as_bytes(), Format::Gltf, "test", &LoadOptions::default()).unwrap();
    assert_eq!((model.triangles.len(), model.vertices.len()), (400, 400));
}
