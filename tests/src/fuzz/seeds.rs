//! Inputs to begin with, made by code.

use super::loaders::SEPARATOR;
use super::tree_file::seal;
use crate::meshes;
use crate::rays::random;
use flate2::Compression;
use flate2::write::GzEncoder;
use kdray::{BuildOptions, Coordinate, CostModel, Precision, Scene, Strategy, TriangleMesh};
use rand::RngExt;
use std::convert::Infallible;
use std::io::Write;

/// A file of lines.
fn lines(lines: &[&str]) -> Vec<u8> {
    [lines.join("\n").as_bytes(), b"\n"].concat()
}

/// An OBJ file, the same with materials, and with a picture.
pub fn obj() -> Vec<Vec<u8>> {
    let shapes = [
        "mtllib a.mtl",
        "o part",
        "g x y",
        "v 0 0 0",
        "v 1 0 0 1 0.5 0",
        "v 1 1 0",
        "v 0 1 .5e-1",
        "vt 0 0",
        "vt 1 0",
        "vt 1 1 0",
        "vn 0 0 1",
        "usemtl one",
        "s 1",
        "f 1/1/1 2/2/1 3/3/1",
        "f -4 -3 -2 -1",
        "f 1//1 3//1 \\",
        "4//1",
        "usemtl two",
        "f 1/2 2/3 4/1",
        "l 1 2 3",
        "p 4",
        "# remark",
    ];
    let materials = [
        "newmtl one",
        "Ka 0 0 0",
        "Kd 1 .5 .2",
        "Ks 1 1 1",
        "Ke 0 1 0",
        "Ns 10",
        "Ni 1.5",
        "d 0.5",
        "Tr 0.5",
        "illum 7",
        "Tf 1 1 1",
        "map_Kd -s 2 2 1 -o 0 0 -clamp on b.png",
        "map_Bump -bm 2 b.png",
        "map_d b.png",
        "newmtl two",
        "Kd xyz 1 1 1",
        "Ks spectral file.rfl",
        "Pr 0.5",
        "Pm 1",
        "map_Ke b.png",
    ];
    let (shapes, materials) = (lines(&shapes), lines(&materials));
    let joined = [&shapes[..], &[SEPARATOR], &materials].concat();
    let picture = [&joined[..], &[SEPARATOR], &PICTURE].concat();
    vec![shapes, joined, picture]
}

/// A picture of one grey pixel.
const PICTURE: [u8; 67] =
    *b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\x01\0\0\0\x01\x08\0\0\0\0\x3a\x7e\x9b\x55\
\0\0\0\nIDATx\x9cc\xa8\0\0\0\x81\0\x80\xaf\xed\x1c\xc8\0\0\0\0IEND\xaeB`\x82";

/// Text, and both orders of bytes.
pub fn ply() -> Vec<Vec<u8>> {
    let text = [
        "ply",
        "format ascii 1.0",
        "comment x",
        "element vertex 4",
        "property float x",
        "property float y",
        "property double z",
        "property uchar red",
        "property uchar green",
        "property uchar blue",
        "element face 2",
        "property list uchar int vertex_indices",
        "element tristrips 1",
        "property list int int vertex_indices",
        "end_header",
        "0 0 0 255 0 0",
        "1 0 0 0 255 0",
        "1 1 0 0 0 255",
        "0 1 0.5 9 9 9",
        "3 0 1 2",
        "4 0 1 2 3",
        "5 0 1 2 -1 3",
    ];
    vec![lines(&text), binary_ply(true), binary_ply(false)]
}

fn binary_ply(little: bool) -> Vec<u8> {
    let order =
        if little { "format binary_little_endian 1.0" } else { "format binary_big_endian 1.0" };
    let header = [
        "ply",
        order,
        "element vertex 3",
        "property float x",
        "property float y",
        "property float z",
        "property float nx",
        "property float ny",
        "property float nz",
        "property float s",
        "property float t",
        "property list uchar short extra",
        "element face 1",
        "property list uchar uint vertex_index",
        "property list uchar float texcoord",
        "end_header",
    ];
    let mut bytes = lines(&header);
    let float = |x: f32| if little { x.to_le_bytes() } else { x.to_be_bytes() };
    for position in [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]] {
        let numbers = [&position[..], &[0.0, 0.0, 1.0, 0.5, 0.5]].concat();
        bytes.extend(numbers.into_iter().flat_map(float));
        bytes.extend([1, 0, 7]);
    }
    bytes.push(3);
    let index = |i: u32| if little { i.to_le_bytes() } else { i.to_be_bytes() };
    bytes.extend([0, 1, 2].into_iter().flat_map(index));
    bytes.push(2);
    bytes.extend([0.25, 0.75].into_iter().flat_map(float));
    bytes
}

/// Text, and binary with colours.
pub fn stl() -> Vec<Vec<u8>> {
    let text = [
        "solid a",
        "facet normal 0 0 1",
        "outer loop",
        "vertex 0 0 0",
        "vertex 1 0 0",
        "vertex 0 1e0 0",
        "endloop",
        "endfacet",
        "endsolid a",
        "solid b",
        "endsolid b",
    ];
    let mut binary = b"solid COLOR=\x01\x02\x03\xff facet normal".to_vec();
    binary.resize(80, b' ');
    binary.extend(2_u32.to_le_bytes());
    for colour in [[0, 0], [0x1f, 0x80]] {
        let numbers = [0.0_f32, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
        binary.extend(numbers.into_iter().flat_map(f32::to_le_bytes));
        binary.extend(colour);
    }
    vec![lines(&text), binary]
}

/// With and without colours and normals.
pub fn off() -> Vec<Vec<u8>> {
    let coloured = [
        "COFF # colours",
        "4 2 0",
        "0 0 0 255 0 0 255",
        "1 0 0 0 255 0 255",
        "1 1 0 0 0 255 255",
        "0 1 0 9 9 9 9",
        "3 0 1 2 0.5 0.5 0.5",
        "4 0 1 2 3",
    ];
    let plain = ["3 1 0", "0 0 0", "1 0 0", "0 1 0", "3 0 1 2"];
    let full = ["STCN4OFF", "1 0 0", "1 2 3 1 0 0 1 .5 .5 .5 1 0 0"];
    let many = ["nOFF", "2", "3 1 0", "0 0", "1 0", "0 1", "3 0 1 2 7"];
    vec![lines(&coloured), lines(&[&["OFF"], &plain[..]].concat()), lines(&full), lines(&many)]
}

/// What is in all glTF files here, but for the buffer.
const SCENE: &str = r#"{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1]}],
"extensionsUsed":["KHR_lights_punctual","EXT_mesh_gpu_instancing","KHR_texture_transform"],
"extensions":{"KHR_lights_punctual":{"lights":[{"type":"spot","intensity":5,"spot":{"innerConeAngle":0.1}}]}},
"nodes":[{"mesh":0,"skin":0,"children":[2],"rotation":[0,0,0.6,0.8],"scale":[1,-1,2]},
{"camera":0,"extensions":{"KHR_lights_punctual":{"light":0}},"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]},
{"mesh":0,"weights":[0.5],"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":0}}}}],
"cameras":[{"type":"perspective","perspective":{"yfov":1,"znear":0.1}},
{"type":"orthographic","orthographic":{"xmag":1,"ymag":1,"zfar":9,"znear":0}}],
"skins":[{"joints":[2],"inverseBindMatrices":2}],
"meshes":[{"weights":[1],"primitives":[{"attributes":{"POSITION":0,"COLOR_0":3,"NORMAL":0},"indices":1,
"material":0,"targets":[{"POSITION":0}]},{"attributes":{"POSITION":0},"mode":5}]}],
"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0,"texCoord":0,
"extensions":{"KHR_texture_transform":{"offset":[0,1],"rotation":1}}}},"alphaMode":"MASK",
"extensions":{"KHR_materials_ior":{"ior":1.4},"KHR_materials_transmission":{"transmissionFactor":1}}}],
"textures":[{"source":0,"sampler":0}],"samplers":[{"wrapS":33071}],
"images":[{"bufferView":0,"mimeType":"image/png"}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
{"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"},
{"componentType":5126,"count":1,"type":"MAT4"},
{"componentType":5121,"normalized":true,"count":3,"type":"VEC3","sparse":{"count":1,
"indices":{"bufferView":1,"componentType":5123},"values":{"bufferView":0}}}],
"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":6}],
"buffers":[{"byteLength":42BUFFER}]}"#;

/// Three positions and three indices.
fn buffer() -> Vec<u8> {
    let positions = [0.0_f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
    let indices = [0_u16, 1, 2].into_iter().flat_map(u16::to_le_bytes);
    positions.into_iter().flat_map(f32::to_le_bytes).chain(indices).collect()
}

/// The buffer in the text.
pub fn gltf() -> Vec<Vec<u8>> {
    let data: String = buffer().iter().map(|byte| format!("%{byte:02x}")).collect();
    let uri = format!(",\"uri\":\"data:application/octet-stream,{data}\"");
    vec![SCENE.replace("BUFFER", &uri).into_bytes()]
}

/// The buffer beside the text.
pub fn glb() -> Vec<Vec<u8>> {
    let text = SCENE.replace("BUFFER", "").into_bytes();
    let whole = super::loaders::container(&text, &buffer());
    vec![[&text[..], &[SEPARATOR], &buffer()].concat(), whole]
}

/// Both kinds of compression, of content that repeats itself and of content that does not.
pub fn compressed() -> Vec<Vec<u8>> {
    let contents = [off().swap_remove(1), ply().swap_remove(1), b"OFF 0 0 0\n".repeat(20)];
    contents.iter().flat_map(|content| [gzip(content), zstd(content)]).collect()
}

fn gzip(content: &[u8]) -> Vec<u8> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::default());
    let written = encoder.write_all(content).and_then(|()| encoder.finish());
    written.expect("memory is written without errors")
}

fn zstd(content: &[u8]) -> Vec<u8> {
    ruzstd::encoding::compress_to_vec(content, ruzstd::encoding::CompressionLevel::Fastest)
}

/// Files of trees with and without a wide one, and rays behind them.
pub fn tree_file() -> Vec<Vec<u8>> {
    let meshes = [meshes::soup(5, [0.0; 3], 1.0, 1), meshes::boxes(1), Vec::new()];
    let options = [BuildOptions::default(), BuildOptions::for_strategy(Strategy::Sah)];
    let scenes = meshes.iter().flat_map(|soup| options.map(|it| (meshes::mesh(soup.clone()), it)));
    let mut files: Vec<_> = scenes.map(|(mesh, options)| saved(mesh, &options)).collect();
    files.push(saved(meshes::mesh_in_f64(&meshes::mesh(meshes::grid(2, 1))), &options[0]));
    files.push(saved(strip::<f32>(), &small_leaves()));
    files.push(saved(strip::<f64>(), &small_leaves()));
    files
}

/// Six triangles that share vertices, at thirds: in f64 they are no f32.
fn strip<T: Coordinate>() -> TriangleMesh<T> {
    let vertex = |i: u32| [i, i % 2, i * i % 5].map(|x| T::from_f64(f64::from(x) / 3.0));
    let triangles = (0..6).map(|i| [i, i + 1, i + 2]).collect();
    TriangleMesh::new((0..8).map(vertex).collect(), triangles).expect("a small mesh")
}

/// Such that the strip's wide tree has a second node: its leaves are more than one has room for.
fn small_leaves() -> BuildOptions {
    let middle = BuildOptions::for_strategy(Strategy::Middle);
    BuildOptions { cost: CostModel::BLOCKS_OF_8, leaf_size: 3, max_depth: Some(5), ..middle }
}

fn saved<T: Precision>(mesh: TriangleMesh<T>, options: &BuildOptions) -> Vec<u8> {
    let scene = Scene::build(mesh, options).expect("a small mesh");
    let mut bytes = Vec::new();
    let written = scene.save(|piece| {
        bytes.extend_from_slice(piece);
        Ok::<(), Infallible>(())
    });
    written.expect("memory is written without errors");
    seal(&mut bytes);
    bytes.extend(any().swap_remove(0));
    bytes
}

/// Bytes as they come, for what is drawn from them.
pub fn any() -> Vec<Vec<u8>> {
    let mut random = random(5);
    let mut bytes = |count: usize| (0..count).map(|_| random.random()).collect();
    [64, 128, 256, 512].into_iter().map(&mut bytes).collect()
}
