//! What files say arrives in the model.

#![expect(clippy::unwrap_used, reason = "a test may panic in its helpers, too")]

use kdray_scene::{AlphaMode, Format, LoadError, LoadOptions, Model, Place, Wrap, load, read};
use std::error::Error;
use std::path::Path;

fn read_text(format: Format, text: &str) -> Result<Model, LoadError> {
    read(text.as_bytes(), format, "test", &LoadOptions::default())
}

fn write(folder: &Path, name: &str, content: impl AsRef<[u8]>) {
    std::fs::write(folder.join(name), content).unwrap();
}

/// An image of one colour.
fn png(color: [u8; 4]) -> Vec<u8> {
    let mut file = std::io::Cursor::new(Vec::new());
    let image = image::RgbaImage::from_pixel(2, 2, image::Rgba(color));
    image.write_to(&mut file, image::ImageFormat::Png).unwrap();
    file.into_inner()
}

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

#[test]
fn obj_indices_count_back_from_what_is_there() {
    let text = format!("{SQUARE}f -4 -3 -2\nv 5 5 5\nf -4 -3 -1\n");
    let model = read_text(Format::Obj, &text).unwrap();
    assert_eq!(model.triangles, [[0, 1, 2], [1, 2, 4]]);
}

#[test]
fn obj_errors_name_the_line_and_count_from_one() {
    for (line, reason) in [
        ("f 1 2 9", "vertex index 9 is out of range: there are 4"),
        ("f 0 1 2", "\"0\" is no corner"),
        ("f -5 1 2", "out of range"),
        ("f 1 2 x", "\"x\" is no corner"),
        ("v 1 2", "a number is missing"),
        ("v 1 2 z", "\"z\" is no number"),
        ("hello", "no statement"),
    ] {
        let error = read_text(Format::Obj, &format!("{SQUARE}{line}\n")).unwrap_err();
        let message = error.to_string();
        assert!(message.starts_with("test: line 5: ") && message.contains(reason), "{message}");
        assert!(matches!(error, LoadError::Invalid { place: Place::Line(5), .. }));
    }
}

#[test]
fn obj_corners_keep_their_vertices_and_have_normals_uvs_and_colours_of_their_own() {
    let text = "v 0 0 0 1 1 1\nv 1 0 0 0 0 0\nv 0 1 0 1 0 0\nvt 0 0\nvt 1 0.25\nvn 0 0 2\nvn 0 3 4\n\
                f 1/1/1 2/2/1 3/1/2\nf 3 2 1\n";
    let model = read_text(Format::Obj, text).unwrap();
    assert_eq!(model.vertices.len(), 3);
    assert_eq!(model.uvs[0], [[0.0, 1.0], [1.0, 0.75], [0.0, 1.0]], "v points down");
    assert_eq!(model.normals[0][0], [0.0, 0.0, 1.0]);
    assert_eq!(model.normals[0][2], [0.0, 0.6, 0.8]);
    assert_eq!(model.normals[1], [[0.0, 0.0, -1.0]; 3], "the geometric one where none is given");
    assert_eq!(model.colors[0], [[1.0; 3], [0.0; 3], [1.0, 0.0, 0.0]]);
}

#[test]
fn obj_lines_end_in_any_way() {
    for end in ["\n", "\r\n", "\r"] {
        let text = format!("{SQUARE}f 1 2 \\\n3 4\n# end").replace('\n', end);
        assert_eq!(read_text(Format::Obj, &text).unwrap().triangles.len(), 2, "{end:?}");
    }
    let wide: Vec<u8> =
        format!("\u{feff}{SQUARE}f 1 2 3").encode_utf16().flat_map(u16::to_le_bytes).collect();
    let model = read(&wide[..], Format::Obj, "utf-16", &LoadOptions::default()).unwrap();
    assert_eq!(model.triangles.len(), 1);
}

#[test]
fn a_byte_order_mark_is_no_part_of_a_text() {
    let triangle = "0 0 0\n1 0 0\n0 1 0\n";
    let header = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
                  property float z\nelement face 1\nproperty list uchar int vertex_indices\n";
    let corners = "vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n";
    let stl = format!("solid s\nfacet normal 0 0 1\nouter loop\n{corners}endloop\nendfacet\n");
    for (name, text) in [
        ("a.off", format!("OFF\n3 1 0\n{triangle}3 0 1 2\n")),
        ("a.ply", format!("{header}end_header\n{triangle}3 0 1 2\n")),
        ("a.stl", format!("{stl}endsolid s\n")),
        ("a.obj", format!("{SQUARE}f 1 2 3\n")),
    ] {
        let folder = tempfile::tempdir().unwrap();
        for name in [name, "by content"] {
            write(folder.path(), name, format!("\u{feff}{text}"));
            let model = load(&folder.path().join(name), &LoadOptions::default()).unwrap();
            assert_eq!(model.triangles.len(), 1, "{name}: {text}");
        }
    }
    let binary = [b"\xef\xbb\xbf", &[b' '; 77][..], &1_u32.to_le_bytes(), &[0; 50]].concat();
    let model = read(&binary[..], Format::Stl, "binary", &LoadOptions::default()).unwrap();
    assert_eq!(model.triangles.len(), 1, "what a binary STL begins with counts");
}

#[test]
fn ply_textures_beyond_the_first_are_left_out_with_a_warning() {
    let textures = "comment TextureFile a.png\ncomment TextureFile b c.png\n";
    let text = format!(
        "ply\nformat ascii 1.0\n{textures}{textures}element vertex 0\n\
                        property float x\nproperty float y\nproperty float z\nend_header\n"
    );
    let model = read_text(Format::Ply, &text).unwrap();
    let second = "texture \"b c.png\" left out: all faces have the first";
    let said = model.warnings.iter().filter(|warning| warning.contains(second)).count();
    assert_eq!(said, 1, "{:?}", model.warnings);
}

#[test]
fn warnings_about_ply_textures_are_few_and_short() {
    let long = "ä".repeat(50_000);
    let first = format!("comment TextureFile {long}.png\n");
    let long = "ä".repeat(300);
    let others: String = (0..4000).map(|i| format!("comment TextureFile {i}{long}\n")).collect();
    let start = "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\n";
    let text = format!("{start}{first}{others}property float z\nend_header\n");
    let warnings = read_text(Format::Ply, &text).unwrap().warnings;
    let length: usize = warnings.iter().map(String::len).sum();
    assert!(warnings.len() < 30 && length < 30_000, "{length} bytes: {warnings:?}");
    let said = |part: &str| warnings.iter().any(|warning| warning.contains(part));
    assert!(said("texture \"ä") && said("\"0ä") && said(" 3984 more comments"), "{warnings:?}");
}

#[test]
fn obj_comments_that_end_in_a_backslash_swallow_no_line() {
    let start = "# made in C:\\models\\\nv 0 0 0\n  #\\\nv 1 0 0 # D:\\\nv 0 1 0\n";
    let model = read_text(Format::Obj, &format!("{start}f 1 \\\n2 \\\n3 # \\\nf 1 2 3\n"));
    let model = model.unwrap();
    assert_eq!((model.vertices.len(), model.triangles.len()), (3, 2));
}

#[test]
fn mtl_materials_become_mirrors_glass_and_lamps() {
    let folder = tempfile::tempdir().unwrap();
    write(
        folder.path(),
        "my materials.mtl",
        "newmtl a mirror\nKd 0 0 0\nKs .9 .8 .7\nillum 3\n\
        newmtl glass\nKd 0 0 0\nKs 1 1 1\nNi 1.33\nTf .2 .4 .4\nd 0.1\nillum 7\n\
        newmtl lamp\nKe 17 12 4\nnewmtl veil\nd 0.25\nmap_Kd gone.png\n\
        newmtl picture\nKd 0 0 0\nmap_Kd -s 2 3 -clamp on my picture.png\nNs 198\n",
    );
    write(folder.path(), "my picture.png", png([255, 188, 0, 128]));
    let uses = ["a mirror", "glass", "lamp", "veil", "picture", "unknown"];
    let faces: String = uses.iter().map(|name| format!("usemtl {name}\nf 1 2 3\n")).collect();
    let text = format!("mtllib my materials.mtl\n{SQUARE}f 1 2 4\n{faces}");
    write(folder.path(), "a.obj", text);
    let model = load(&folder.path().join("a.obj"), &LoadOptions::default()).unwrap();
    assert_eq!(model.material_ids, [6, 0, 1, 2, 3, 4, 5], "the last is for faces without any");
    let names: Vec<&str> = model.materials.iter().map(|m| m.name.as_str()).collect();
    assert_eq!(names[..6], uses);
    let [mirror, glass, lamp, veil, picture] = &model.materials[..5] else { panic!() };
    assert_eq!(mirror.mirror, [0.9, 0.8, 0.7]);
    assert_eq!((glass.transmission, glass.ior, glass.opacity), (1.0, 1.33, 1.0));
    assert_eq!(glass.base_color, [0.5, 1.0, 1.0]);
    assert_eq!(lamp.emission, [17.0, 12.0, 4.0]);
    assert_eq!((veil.opacity, veil.alpha_mode), (0.25, AlphaMode::Blend));
    assert_eq!(veil.base_color_texture, None);
    assert!((picture.roughness - 0.01_f32.powf(0.25)).abs() < 1e-6);
    assert_eq!(picture.base_color, [1.0; 3], "a black factor would hide the picture");
    let texture = picture.base_color_texture.unwrap();
    assert_eq!(texture.transform, [[2.0, 0.0, 0.0], [0.0, 3.0, -2.0]]);
    let texture = &model.textures[texture.texture];
    assert_eq!(texture.wrap, [Wrap::Clamp; 2]);
    let [r, g, b, a] = texture.pixels[0];
    assert!(r == 1.0 && (g - 0.5028865).abs() < 1e-5 && b == 0.0 && a == 128.0 / 255.0);
    let warned = |what: &str| model.warnings.iter().any(|warning| warning.contains(what));
    assert!(warned("gone.png") && warned("\"unknown\" is not defined"), "{:?}", model.warnings);
}

#[test]
fn streams_have_no_files_beside_them() {
    let text = format!("mtllib a.mtl\n{SQUARE}usemtl m\nf 1 2 3\n");
    let model = read_text(Format::Obj, &text).unwrap();
    assert!(model.warnings.iter().any(|w| w.contains("a.mtl")), "{:?}", model.warnings);
    let gltf = r#"{"asset":{"version":"2.0"},"buffers":[{"byteLength":4,"uri":"a.bin"}]}"#;
    let error = read_text(Format::Gltf, gltf).unwrap_err();
    assert!(matches!(&error, LoadError::Missing { missing, .. } if missing == "a.bin"), "{error}");
    assert!(error.to_string().ends_with("a stream has no files beside it"), "{error}");
    assert!(error.source().is_none(), "a chain of causes says it twice");
}

#[test]
fn pictures_that_small_files_blow_up_are_left_out() {
    let folder = tempfile::tempdir().unwrap();
    let mut file = std::io::Cursor::new(Vec::new());
    let image = image::GrayImage::new(30_000, 30_000);
    image.write_to(&mut file, image::ImageFormat::Png).unwrap();
    write(folder.path(), "bomb.png", file.into_inner());
    write(folder.path(), "a.mtl", "newmtl m\nmap_Kd bomb.png\n");
    write(folder.path(), "a.obj", format!("mtllib a.mtl\n{SQUARE}usemtl m\nf 1 2 3\n"));
    let model = load(&folder.path().join("a.obj"), &LoadOptions::default()).unwrap();
    assert!(model.textures.is_empty());
    assert!(model.warnings[0].contains("bomb.png"), "{:?}", model.warnings);
}

#[test]
fn ply_attributes_of_vertices_and_faces() {
    let head = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
                property float z\n";
    let face = "element face 1\nproperty list uchar int vertex_indices\n";
    let vertices = "property float nx\nproperty float ny\nproperty float nz\nproperty float s\n\
                    property float t\n";
    let text = format!(
        "{head}{vertices}{face}end_header\n0 0 0 0 0 1 0 0\n1 0 0 0 0 1 1 0\n0 1 0 0 0 1 0 1\n3 0 1 2\n"
    );
    let model = read_text(Format::Ply, &text).unwrap();
    assert_eq!(model.normals, [[[0.0, 0.0, 1.0]; 3]]);
    assert_eq!(model.uvs, [[[0.0, 1.0], [1.0, 1.0], [0.0, 0.0]]]);
    let rgb = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    let text = format!(
        "{head}{face}property list uchar float texcoord\n{rgb}end_header\n\
         0 0 0\n1 0 0\n0 1 0\n3 0 1 2 6 0 0 1 0 1 1 255 0 255\n"
    );
    let model = read_text(Format::Ply, &text).unwrap();
    assert_eq!(model.uvs, [[[0.0, 1.0], [1.0, 1.0], [1.0, 0.0]]]);
    assert_eq!(model.colors, [[[1.0, 0.0, 1.0]; 3]]);
}

#[test]
fn ply_faces_may_come_before_their_vertices() {
    let text = "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\n\
                element vertex 3\nproperty float x\nproperty float y\nproperty float z\nend_header\n\
                3 2 1 0\n0 0 0\n1 0 0\n0 1 0\n";
    assert_eq!(read_text(Format::Ply, text).unwrap().triangles, [[2, 1, 0]]);
    let error = read_text(Format::Ply, &text.replace("3 2 1 0", "3 2 1 7")).unwrap_err();
    assert!(error.to_string().starts_with("test: face 0: vertex index 7"), "{error}");
}

#[test]
fn ply_point_clouds_have_no_triangles() {
    let text = "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n\
                property float z\nend_header\n1 2 3\n";
    let model = read_text(Format::Ply, text).unwrap();
    assert_eq!((model.vertices.len(), model.triangles.len()), (1, 0));
    assert!(model.warnings[0].contains("no triangles (and 1 vertex)"));
}

#[test]
fn stl_triangles_share_equal_corners() {
    let facet = |z: [i32; 3]| {
        format!(
            "FACET NORMAL 0 0 0\n  outer loop\n vertex 0 0 {}\n vertex 1 0 {}\n vertex 0 1 {}\n\
             endloop\nEndFacet\n",
            z[0], z[1], z[2]
        )
    };
    let text = format!(
        "Solid one facet\n{}{}endsolid\nsolid\n{}endsolid two\n",
        facet([0, 0, 0]),
        facet([0, 0, 1]),
        facet([0, 0, 0])
    );
    let model = read_text(Format::Stl, &text).unwrap();
    assert_eq!((model.vertices.len(), model.triangles.len()), (4, 3));
    let error = read_text(Format::Stl, &text.replace("vertex 0 1 1", "vertex 0 one 1"));
    let message = error.unwrap_err().to_string();
    assert!(message.starts_with("test: line 13: \"one\""), "{message}");
}

#[test]
fn off_has_prefixes_and_colours() {
    let text = "NCOFF\n3 1 3\n0 0 0 0 0 1 1 0 0 1\n1 0 0 0 0 1 1.0 0 0 1\n0 1 0 0 0 1 1.0 0 0 1\n3 0 1 2\n";
    let model = read_text(Format::Off, text).unwrap();
    assert_eq!(model.normals, [[[0.0, 0.0, 1.0]; 3]]);
    assert_eq!(model.colors[0][1], [1.0, 0.0, 0.0]);
    for (text, reason) in [("4OFF\n1 0 0\n", "three dimensions"), ("OFF BINARY\n", "binary OFF")] {
        let error = read_text(Format::Off, text).unwrap_err();
        assert!(matches!(error, LoadError::Unsupported { .. }));
        assert!(error.to_string().contains(reason), "{error}");
    }
}

/// A triangle, with what is replaced in the document.
fn gltf(replace: &[(&str, &str)]) -> Result<Model, LoadError> {
    let floats = [0.0_f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
    let data: String =
        floats.iter().flat_map(|x| x.to_le_bytes()).map(|byte| format!("%{byte:02x}")).collect();
    let mut text = format!(
        r#"{{"asset":{{"version":"2.0"}},"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}}}}]}}],
        "accessors":[{{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}}],
        "bufferViews":[{{"buffer":0,"byteLength":36}}],
        "buffers":[{{"byteLength":36,"uri":"data:;,{data}"}}]}}"#
    );
    for (from, to) in replace {
        assert!(text.contains(from), "{from}");
        text = text.replace(from, to);
    }
    read_text(Format::Gltf, &text)
}

#[test]
fn gltf_mirrors_turn_triangles_over() {
    assert_eq!(gltf(&[]).unwrap().triangles, [[0, 1, 2]]);
    let mirrored = gltf(&[("\"mesh\":0", "\"mesh\":0,\"scale\":[-1,1,1]")]).unwrap();
    assert_eq!(mirrored.triangles, [[0, 2, 1]]);
    assert_eq!(mirrored.vertices[1], [-1.0, 0.0, 0.0]);
}

#[test]
fn gltf_skins_follow_their_joints_and_not_their_node() {
    let weights = "%ff%00%00%00".repeat(3);
    let model = gltf(&[
        ("{\"mesh\":0}", r#"{"mesh":0,"skin":0,"translation":[100,0,0]},{"translation":[0,5,0]}"#),
        ("\"nodes\":[0]", "\"nodes\":[0,1]"),
        ("\"scenes\"", "\"skins\":[{\"joints\":[1]}],\"scenes\""),
        ("\"POSITION\":0", "\"POSITION\":0,\"JOINTS_0\":1,\"WEIGHTS_0\":2"),
        (
            "\"type\":\"VEC3\"}",
            r#""type":"VEC3"},{"componentType":5121,"count":3,"type":"VEC4","sparse":{"count":0,
            "indices":{"bufferView":0,"componentType":5121},"values":{"bufferView":0}}},
            {"bufferView":1,"componentType":5121,"normalized":true,"count":3,"type":"VEC4"}"#,
        ),
        ("\"byteLength\":36}],", "\"byteLength\":36},{\"buffer\":1,\"byteLength\":12}],"),
        ("\"}]}", &format!("\"}},{{\"byteLength\":12,\"uri\":\"data:;,{weights}\"}}]}}")),
    ]);
    let expected = [[0.0, 5.0, 0.0], [1.0, 5.0, 0.0], [0.0, 6.0, 0.0]];
    assert_eq!(model.unwrap().vertices, expected);
}

#[test]
fn gltf_says_what_is_wrong_and_where() {
    for (replace, place, reason) in [
        (("\"nodes\":[0]", "\"nodes\":[0,0]"), "nodes[0]", "reached twice"),
        (("\"mesh\":0", "\"mesh\":7"), "nodes[0].mesh", "out of bounds"),
        (("\"POSITION\":0", "\"POSITION\":7"), "meshes[0].primitives[0]", "out of bounds"),
        (("\"count\":3", "\"count\":4"), "accessors[0]", "beyond its buffer view"),
        (("\"byteLength\":36}]", "\"byteLength\":99}]"), "bufferViews[0]", "beyond its buffer"),
        (("VEC3", "VEC2"), "accessors[0]", "2 numbers"),
        (("VEC3", "VEC9"), "accessors[0].type", "invalid"),
        (("\"2.0\"", "\"1.0\""), "asset.version", "glTF 1.0"),
        (("\"asset\"", "\"assets\""), "JSON at ", "missing field `asset`"),
    ] {
        let message = gltf(&[replace]).unwrap_err().to_string();
        let at = format!("test: {place}");
        assert!(message.starts_with(&at) && message.contains(reason), "{message}");
    }
    let required = [("\"scenes\"", "\"extensionsRequired\":[\"EXT_new\"],\"scenes\"")];
    let message = gltf(&required).unwrap_err().to_string();
    assert!(message.contains("the extension EXT_new is not supported"), "{message}");
}

#[test]
fn gltf_instances_cannot_take_all_memory() {
    // 36 bytes of positions, shown by a mesh of 1000 primitives, in 20,000 nodes.
    let primitive = "{\"attributes\":{\"POSITION\":0}}";
    let primitives = vec![primitive; 1000].join(",");
    let nodes = vec!["{\"mesh\":0}"; 40_000].join(",");
    let roots = (0..40_000).map(|i| i.to_string()).collect::<Vec<_>>().join(",");
    let result = gltf(&[
        (&format!("[{primitive}]"), &format!("[{primitives}]")),
        ("[{\"mesh\":0}]", &format!("[{nodes}]")),
        ("\"nodes\":[0]", &format!("\"nodes\":[{roots}]")),
    ]);
    let message = result.unwrap_err().to_string();
    assert!(message.contains("the instances have more than"), "{message}");
}

#[test]
fn bad_triangles_are_refused_or_dropped_in_every_format() {
    let cases = [
        (Format::Obj, format!("{SQUARE}v nan 0 0\nf 1 2 3\nf 1 2 5\nf 1 2 6\n")),
        (
            Format::Off,
            "OFF 4 3 0\n0 0 0\n1 0 0\n0 1 0\nnan 0 0\n3 0 1 2\n3 0 1 3\n3 0 1 4\n".into(),
        ),
        (
            Format::Stl,
            "solid\nfacet normal 0 0 0 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop \
             endfacet\nfacet normal 0 0 0 outer loop vertex nan 0 0 vertex 1 0 0 vertex 0 1 0 \
             endloop endfacet\nendsolid\n"
                .into(),
        ),
    ];
    for (format, text) in cases {
        assert!(read_text(format, &text).is_err());
        let options = LoadOptions { drop_bad: true, ..LoadOptions::default() };
        let model = read(text.as_bytes(), format, "test", &options).unwrap();
        assert_eq!(model.triangles.len(), 1, "{format:?}");
        assert!(model.warnings[0].contains("bad polygons dropped: "), "{:?}", model.warnings);
    }
}

#[test]
fn errors_of_files_that_are_not_there_name_them() {
    let error = load(Path::new("not/there.ply"), &LoadOptions::default()).unwrap_err();
    let message = "not/there.ply: cannot be read: No such file or directory (os error 2)";
    assert!(cfg!(not(unix)) || error.to_string() == message, "{error}");
    assert!(error.source().is_none(), "a chain of causes says it twice");
    let folder = tempfile::tempdir().unwrap();
    let error = load(folder.path(), &LoadOptions::default()).unwrap_err();
    assert!(matches!(error, LoadError::Io { .. }), "{error}");
    write(folder.path(), "what", "hello");
    let error = load(&folder.path().join("what"), &LoadOptions::default()).unwrap_err();
    assert!(matches!(error, LoadError::UnknownFormat { .. }), "{error}");
}
