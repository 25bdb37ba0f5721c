//! Cut, damaged and endless input: refused in good time, never a panic.

#![expect(clippy::unwrap_used, reason = "a test may panic in its helpers, too")]

use flate2::Compression;
use flate2::write::GzEncoder;
use kdray_scene::{Format, LoadError, LoadOptions, load, read};
use std::io::{self, Read, Write};
use std::time::{Duration, Instant};

const PLY: &str = "ply\nformat ascii 1.0\ncomment x\nelement vertex 4\nproperty float x\n\
    property float y\nproperty double z\nproperty uchar red\nproperty uchar green\n\
    property uchar blue\nelement face 2\nproperty list uchar int vertex_indices\n\
    element tristrips 1\nproperty list int int vertex_indices\nend_header\n\
    0 0 0 255 0 0\n1 0 0 0 255 0\n1 1 0 0 0 255\n0 1 0.5 9 9 9\n3 0 1 2\n4 0 1 2 3\n5 0 1 2 -1 3\n";
const STL: &str = "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n\
    vertex 0 1 0\nendloop\nendfacet\nendsolid a\n";
const OFF: &str = "COFF # colours\n4 2 0\n0 0 0 255 0 0 255\n1 0 0 0 255 0 255\n1 1 0 0 0 255 255\n\
    0 1 0 9 9 9 9\n3 0 1 2 0.5 0.5 0.5\n4 0 1 2 3\n";
const OBJ: &str = "mtllib a.mtl\no x\nv 0 0 0 1 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv .5 .1 0\n\
    vt 0 0\nvt 1 0 0\nvn 0 0 1\nusemtl m\ns 1\nf 1/1/1 2/2/1 3//1 -2\nf 1 5 2 3 \\\n4\nl 1 2\n";
const MTL: &str = "newmtl m\nKd 1 .5 .2\nKs 1\nNs 10\nNi 1.5\nd 0.5\nillum 7\nTf 1 1 1\n\
    map_Kd -s 2 2 -clamp on picture.png\nmap_Bump b.png\n";
const GLTF: &str = r#"{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1]}],
"extensionsUsed":["KHR_lights_punctual","EXT_mesh_gpu_instancing"],
"extensions":{"KHR_lights_punctual":{"lights":[{"type":"spot","intensity":5,"spot":{}}]}},
"nodes":[{"mesh":0,"skin":0,"children":[2],"rotation":[0,0,0.6,0.8],"scale":[1,-1,2]},
{"camera":0,"extensions":{"KHR_lights_punctual":{"light":0}}},
{"mesh":0,"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":0}}}}],
"cameras":[{"type":"perspective","perspective":{"yfov":1,"znear":0.1}}],
"skins":[{"joints":[2],"inverseBindMatrices":2}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0,"COLOR_0":3},"indices":1,"material":0},
{"attributes":{"POSITION":0},"mode":5}]}],
"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}},"alphaMode":"MASK"}],
"textures":[{"source":0}],"images":[{"bufferView":0,"mimeType":"image/png"}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
{"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"},
{"componentType":5126,"count":1,"type":"MAT4"},
{"componentType":5121,"normalized":true,"count":3,"type":"VEC3","sparse":{"count":1,
"indices":{"bufferView":1,"componentType":5123},"values":{"bufferView":0}}}],
"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":6}],
"buffers":[{"byteLength":42,BUFFER}]}"#;

/// Three positions and three indices.
fn gltf_buffer() -> Vec<u8> {
    let positions = [0.0_f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
    let indices = [0_u16, 1, 2].into_iter().flat_map(u16::to_le_bytes);
    positions.into_iter().flat_map(f32::to_le_bytes).chain(indices).collect()
}

fn gltf() -> Vec<u8> {
    let data: String = gltf_buffer().iter().map(|byte| format!("%{byte:02x}")).collect();
    let uri = format!("\"uri\":\"data:application/octet-stream,{data}\"");
    GLTF.replace("BUFFER", &uri).into_bytes()
}

fn glb() -> Vec<u8> {
    let mut json = GLTF.replace(",BUFFER", "").into_bytes();
    let mut binary = gltf_buffer();
    json.resize(json.len().next_multiple_of(4), b' ');
    binary.resize(44, 0);
    let mut glb = b"glTF\x02\0\0\0".to_vec();
    glb.extend((12 + 8 + json.len() as u32 + 8 + 44).to_le_bytes());
    for (kind, chunk) in [(b"JSON", &json), (b"BIN\0", &binary)] {
        glb.extend((chunk.len() as u32).to_le_bytes());
        glb.extend(kind);
        glb.extend(chunk);
    }
    glb
}

fn binary_ply(little: bool) -> Vec<u8> {
    let name = if little { "little" } else { "big" };
    let mut bytes = format!(
        "ply\nformat binary_{name}_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
         property float z\nproperty list uchar short extra\nelement face 1\n\
         property list uchar uint vertex_index\nend_header\n"
    )
    .into_bytes();
    let float = |x: f32| if little { x.to_le_bytes() } else { x.to_be_bytes() };
    for position in [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]] {
        bytes.extend(position.into_iter().flat_map(float));
        bytes.extend([1, 0, 7]);
    }
    bytes.push(3);
    for index in [0_u32, 1, 2] {
        bytes.extend(if little { index.to_le_bytes() } else { index.to_be_bytes() });
    }
    bytes
}

/// One triangle, under a header that says `solid`.
fn binary_stl() -> Vec<u8> {
    let mut bytes = b"solid facet normal".to_vec();
    bytes.resize(80, b' ');
    bytes.extend(1_u32.to_le_bytes());
    let numbers = [0.0_f32, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
    bytes.extend(numbers.into_iter().flat_map(f32::to_le_bytes));
    bytes.extend([0, 0]);
    bytes
}

fn gzip(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::default());
    encoder.write_all(bytes).unwrap();
    encoder.finish().unwrap()
}

fn zstd(bytes: &[u8]) -> Vec<u8> {
    ruzstd::encoding::compress_to_vec(bytes, ruzstd::encoding::CompressionLevel::Fastest)
}

/// A small file of each kind, and how many triangles it has.
fn samples() -> Vec<(&'static str, Format, Vec<u8>, usize)> {
    vec![
        ("ascii.ply", Format::Ply, PLY.into(), 4),
        ("little.ply", Format::Ply, binary_ply(true), 1),
        ("big.ply", Format::Ply, binary_ply(false), 1),
        ("ascii.stl", Format::Stl, STL.into(), 1),
        ("binary.stl", Format::Stl, binary_stl(), 1),
        ("a.off", Format::Off, OFF.into(), 3),
        ("a.obj", Format::Obj, OBJ.into(), 5),
        ("a.gltf", Format::Gltf, gltf(), 8),
        ("a.glb", Format::Gltf, glb(), 8),
        ("a.ply.gz", Format::Ply, gzip(PLY.as_bytes()), 4),
        ("a.ply.zst", Format::Ply, zstd(PLY.as_bytes()), 4),
    ]
}

/// Reads; a panic fails the test, and so does more time than any small file needs.
fn attempt(bytes: &[u8], format: Format, what: &str) -> Result<usize, LoadError> {
    let start = Instant::now();
    let options = LoadOptions { max_bytes: 1 << 20, ..LoadOptions::default() };
    let result = read(bytes, format, what, &options);
    assert!(start.elapsed() < Duration::from_secs(5), "{what} takes {:?}", start.elapsed());
    if let Err(error) = &result {
        assert!(error.to_string().contains(what), "{error} names {what}");
    }
    result.map(|model| model.triangles.len())
}

/// Numbers that are the same in every run (PCG's multiplier, upper bits).
struct Random(u64);

impl Random {
    fn below(&mut self, end: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        ((self.0 >> 33) as usize) % end
    }
}

/// Changes a few bytes, digits for digits more often than not, or cuts, or doubles a part.
fn damage(bytes: &[u8], random: &mut Random) -> Vec<u8> {
    const WORTHWHILE: &[u8] = b"0123456789-+.eE/\\ \n\r#{}[]\",:\0\x7f\x80\xff";
    let mut bytes = bytes.to_vec();
    for _ in 0..=random.below(4) {
        let at = random.below(bytes.len());
        match random.below(8) {
            0 => bytes[at] ^= 1 << random.below(8),
            1 => bytes[at] = random.below(256) as u8,
            2 => bytes.truncate(at.max(1)),
            3 => {
                let end = (at + random.below(40)).min(bytes.len());
                let part = bytes[at..end].to_vec();
                bytes.splice(at..at, part);
            }
            4 => {
                bytes.remove(at);
                bytes.push(0);
            }
            _ => bytes[at] = WORTHWHILE[random.below(WORTHWHILE.len())],
        }
    }
    bytes
}

#[test]
fn samples_load_and_tell_their_format() {
    for (name, format, bytes, triangles) in samples() {
        assert_eq!(attempt(&bytes, format, name).unwrap(), triangles, "{name}");
        let folder = tempfile::tempdir().unwrap();
        let nameless = folder.path().join("nameless");
        std::fs::write(&nameless, &bytes).unwrap();
        let model = load(&nameless, &LoadOptions::default()).unwrap();
        assert_eq!(model.triangles.len(), triangles, "{name} without its name");
    }
}

#[test]
fn cut_files_are_refused() {
    for (name, format, bytes, triangles) in samples() {
        for end in 0..bytes.len() {
            // A text that is cut behind its last triangle, or in a number, may still be whole.
            if let Ok(count) = attempt(&bytes[..end], format, name) {
                assert!(count <= triangles, "{name} cut at {end}");
                let can_be_whole = format == Format::Obj || end + 16 >= bytes.len();
                assert!(can_be_whole, "{name} cut at {end} of {} loads", bytes.len());
            }
        }
    }
}

#[test]
fn damaged_files_do_no_harm() {
    let mut random = Random(1);
    for (name, format, bytes, _) in samples() {
        for _ in 0..3000 {
            let damaged = damage(&bytes, &mut random);
            let _ = attempt(&damaged, format, name);
        }
    }
}

#[test]
fn damaged_files_beside_files_do_no_harm() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.obj");
    std::fs::write(&path, OBJ).unwrap();
    let mut picture = io::Cursor::new(Vec::new());
    image::RgbImage::new(5, 3).write_to(&mut picture, image::ImageFormat::Png).unwrap();
    let mut random = Random(2);
    for round in 0..300 {
        let damaged = |bytes: &[u8], random: &mut Random| match round {
            0 => bytes.to_vec(),
            _ => damage(bytes, random),
        };
        std::fs::write(folder.path().join("a.mtl"), damaged(MTL.as_bytes(), &mut random)).unwrap();
        let png = damaged(picture.get_ref(), &mut random);
        std::fs::write(folder.path().join("picture.png"), png).unwrap();
        let model = load(&path, &LoadOptions::default()).unwrap();
        assert_eq!(model.triangles.len(), 5);
        if round == 0 {
            let texture = &model.textures[0];
            assert_eq!((texture.width, texture.height), (5, 3));
            assert_eq!(model.materials[0].transmission, 1.0);
        }
    }
}

#[test]
fn damaged_compression_does_no_harm() {
    let mut random = Random(3);
    let content = PLY.repeat(50);
    for (name, whole) in [("a.gz", gzip(content.as_bytes())), ("a.zst", zstd(content.as_bytes()))] {
        for _ in 0..2000 {
            let _ = attempt(&damage(&whole, &mut random), Format::Ply, name);
        }
    }
}

#[test]
fn endless_input_is_stopped() {
    let formats = [Format::Obj, Format::Ply, Format::Stl, Format::Off, Format::Gltf];
    let limit = 4 << 20;
    for format in formats {
        for byte in [b'\0', b' ', b'\n', b'a', b'{', b'1', b'v', b'#', 0xff] {
            let options = LoadOptions { max_bytes: limit, ..LoadOptions::default() };
            let start = Instant::now();
            let result = read(io::repeat(byte), format, "endless", &options);
            assert!(result.is_err(), "{format:?} of {byte}");
            assert!(start.elapsed() < Duration::from_secs(5), "{format:?} of {byte}");
        }
        // A good beginning that never ends.
        for (name, _, bytes, _) in samples().into_iter().filter(|sample| sample.1 == format) {
            let options = LoadOptions { max_bytes: limit, ..LoadOptions::default() };
            let rest = io::repeat(b'\n');
            let _ = read(bytes.as_slice().chain(rest), format, name, &options);
        }
    }
}

#[test]
fn the_limit_counts_decompressed_bytes() {
    let bomb = gzip(&vec![b'\n'; 64 << 20]);
    assert!(bomb.len() < 100_000);
    let options = LoadOptions { max_bytes: 1 << 20, ..LoadOptions::default() };
    for (format, bytes) in [(Format::Obj, &bomb), (Format::Off, &bomb)] {
        let error = read(bytes.as_slice(), format, "bomb", &options).unwrap_err();
        assert!(matches!(error, LoadError::TooLong { limit: 1_048_576, .. }), "{error}");
    }
}

#[test]
fn false_counts_take_no_memory() {
    let ply = "ply\nformat binary_little_endian 1.0\nelement vertex 4294967295\nproperty float x\n\
               property float y\nproperty float z\nelement face 18446744073709551615\n\
               property list uint int vertex_indices\nend_header\n";
    let without_size = "ply\nformat ascii 1.0\nelement nothing 18446744073709551615\nelement vertex 0\n\
                        property float x\nproperty float y\nproperty float z\nend_header\n";
    assert!(attempt(ply.as_bytes(), Format::Ply, "counts").is_err());
    assert_eq!(attempt(without_size.as_bytes(), Format::Ply, "nothing").unwrap(), 0);
    let off = "OFF 999999999999 999999999999 0\n0 0 0\n";
    assert!(attempt(off.as_bytes(), Format::Off, "counts").is_err());
    let mut stl = binary_stl();
    stl[80..84].fill(0xff);
    assert!(attempt(&stl, Format::Stl, "counts").is_err());
    let gltf = String::from_utf8(gltf()).unwrap();
    for (from, to) in [
        (
            "\"count\":3,\"type\":\"VEC3\",\"sparse\"",
            "\"count\":4000000000,\"type\":\"VEC3\",\"sparse\"",
        ),
        ("\"byteLength\":42", "\"byteLength\":4000000000"),
        ("\"byteOffset\":36", "\"byteOffset\":18446744073709551615"),
    ] {
        let changed = gltf.replace(from, to);
        assert_ne!(changed, gltf);
        assert!(attempt(changed.as_bytes(), Format::Gltf, "counts").is_err(), "{to}");
    }
}

#[test]
fn deep_json_is_refused() {
    let deep = format!("{{\"asset\":{{\"version\":\"2.0\"}},\"extras\":{}", "[".repeat(200_000));
    assert!(attempt(deep.as_bytes(), Format::Gltf, "deep").is_err());
    let chain: String =
        (0..50_000).map(|i| format!("{{\"children\":[{}]}},", i + 1)).collect::<Vec<_>>().concat();
    let nodes = format!("{{\"asset\":{{\"version\":\"2.0\"}},\"nodes\":[{chain}{{}}]}}");
    let options = LoadOptions::default();
    let model = read(nodes.as_bytes(), Format::Gltf, "a long chain of nodes", &options).unwrap();
    assert!(model.triangles.is_empty());
}
