//! Every file of the shared collection loads as expected, or is refused as expected.

#![expect(clippy::unwrap_used, reason = "a test may panic in its helpers, too")]
#![expect(clippy::print_stdout, reason = "a test says that it was skipped")]

mod common;

use common::{shared, sorted_files};
use kdray_scene::{Camera, Light, LoadOptions, Model, Projection, load};
use std::path::Path;

enum Expected {
    /// Loads, with so many triangles.
    Triangles(usize),
    /// Is refused with a message that has this in it.
    Refused(&'static str),
}
use Expected::{Refused, Triangles};

/// All files in `formats` with the ending of a format.
const FORMATS: &[(&str, Expected)] = &[
    ("gltf_bad/BoxBadNormals-glTF-Binary/BoxBadNormals.glb", Triangles(12)),
    ("gltf_bad/BoxWithInfinites-glTF-Binary/BoxWithInfinites.glb", Refused("is not finite")),
    ("gltf_bad/IncorrectVertexArrays/Cube.gltf", Triangles(46)),
    ("gltf_bad/IndexOutOfRange/AllIndicesOutOfRange.gltf", Refused("out of range")),
    ("gltf_bad/IndexOutOfRange/IndexOutOfRange.gltf", Refused("out of range")),
    ("gltf_bad/MissingBin/BoxTextured.gltf", Refused("BoxTextured0.bin")),
    ("gltf_bad/RecursiveNodes/RecursiveNodes.gltf", Refused("reached twice")),
    ("gltf_bad/SchemaFailures/sceneWrongType.gltf", Refused("scene")),
    ("gltf_bad/TestNoRootNode/NoScene.gltf", Refused("index out of bounds")),
    ("gltf_bad/TestNoRootNode/SceneWithoutNodes.gltf", Refused("missing field `nodes`")),
    ("gltf_bad/issue_3269/texcoord_crash.gltf", Triangles(10)),
    ("gltf_bad/wrongTypes/badArray.gltf", Refused("meshes[0].primitives")),
    (
        "gltf_bad/wrongTypes/badExtension.gltf",
        Refused(
            "materials[0].pbrMetallicRoughness.baseColorTexture.extensions.KHR_texture_transform",
        ),
    ),
    ("gltf_bad/wrongTypes/badNumber.gltf", Refused("materials[0].normalTexture.scale")),
    ("gltf_bad/wrongTypes/badObject.gltf", Refused("materials[0].pbrMetallicRoughness[0]")),
    ("gltf_bad/wrongTypes/badString.gltf", Refused("scenes[0].name")),
    (
        "gltf_bad/wrongTypes/badUint.gltf",
        Refused("materials[0].pbrMetallicRoughness.baseColorTexture.index"),
    ),
    ("gltf_cases/AlphaBlendModeTest.glb", Triangles(61)),
    ("gltf_cases/BoxInterleaved.glb", Triangles(12)),
    ("gltf_cases/BoxTexcoords-glTF/boxTexcoords.gltf", Triangles(12)),
    ("gltf_cases/BoxTextured-glTF-Binary/BoxTextured.glb", Triangles(12)),
    ("gltf_cases/BoxTextured-glTF-Embedded/BoxTextured.gltf", Triangles(12)),
    ("gltf_cases/BoxTextured-glTF-pbrSpecularGlossiness/BoxTextured.gltf", Triangles(12)),
    ("gltf_cases/BoxTextured-glTF/BoxTextured.gltf", Triangles(12)),
    ("gltf_cases/CesiumMilkTruck.glb", Triangles(3624)),
    ("gltf_cases/ClearCoat-glTF/ClearCoatTest.gltf", Triangles(37116)),
    ("gltf_cases/Duck.glb", Triangles(4212)),
    ("gltf_cases/cameras/Cameras.gltf", Triangles(2)),
    ("gltf_cases/cubevc.glb", Triangles(48)),
    ("gltf_cases/empty_nodes.glb", Triangles(0)),
    ("gltf_cases/glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_00.gltf", Triangles(0)),
    ("gltf_cases/glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_01.gltf", Triangles(0)),
    ("gltf_cases/glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_02.gltf", Triangles(0)),
    ("gltf_cases/glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_03.gltf", Triangles(0)),
    ("gltf_cases/glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_04.gltf", Triangles(2)),
    ("gltf_cases/glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_05.gltf", Triangles(2)),
    ("gltf_cases/glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_06.gltf", Triangles(2)),
    ("gltf_cases/glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_07.gltf", Triangles(0)),
    ("gltf_cases/glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_08.gltf", Triangles(0)),
    ("gltf_cases/glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_09.gltf", Triangles(0)),
    ("gltf_cases/glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_10.gltf", Triangles(0)),
    ("gltf_cases/glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_11.gltf", Triangles(2)),
    ("gltf_cases/glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_12.gltf", Triangles(2)),
    ("gltf_cases/glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_13.gltf", Triangles(2)),
    ("gltf_cases/glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_14.gltf", Triangles(2)),
    ("gltf_cases/glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_15.gltf", Triangles(2)),
    ("gltf_cases/mode5.gltf", Triangles(2786)),
    ("gltf_cases/nested.glb", Triangles(36)),
    ("gltf_cases/rgb_cube_with_primitives.gltf", Triangles(12)),
    ("gltf_cases/simple_skin/simple_skin.gltf", Triangles(8)),
    ("gltf_cases/textureTransform/TextureTransformTest.gltf", Triangles(24)),
    ("gltf_engine/2CylinderEngine.glb", Triangles(121496)),
    ("gltf_engine/draco/2CylinderEngine.gltf", Refused("KHR_draco_mesh_compression")),
    ("gltf_flight_helmet/FlightHelmet.gltf", Triangles(94722)),
    ("gltf_made_scene/scene.glb", Triangles(65694)),
    ("gltf_made_scene/scene.gltf", Triangles(65694)),
    ("gltf_meshopt/scene.gltf", Refused("EXT_meshopt_compression")),
    ("gltf_mixed_lighting/MixedLightingExample.gltf", Triangles(40898)),
    ("obj_cases/box.obj", Triangles(12)),
    ("obj_cases/box_UTF16BE.obj", Triangles(12)),
    ("obj_cases/box_longline.obj", Triangles(944)),
    ("obj_cases/box_mat_with_spaces.obj", Triangles(12)),
    ("obj_cases/box_without_lineending.obj", Triangles(12)),
    ("obj_cases/concave_polygon.obj", Triangles(64)),
    ("obj_cases/cube_compressed.obj", Triangles(12)),
    ("obj_cases/cube_mtllib_after_g.obj", Triangles(12)),
    ("obj_cases/cube_usemtl.obj", Triangles(12)),
    ("obj_cases/cube_with_vertexcolors.obj", Triangles(12)),
    ("obj_cases/empty.obj", Triangles(0)),
    ("obj_cases/empty_mat.obj", Triangles(256)),
    ("obj_cases/face_in_group_name_mid_file.obj", Triangles(2)),
    ("obj_cases/groups.obj", Triangles(2308)),
    ("obj_cases/joined_tetrahedra.obj", Triangles(8)),
    ("obj_cases/multiple_spaces.obj", Triangles(1)),
    ("obj_cases/nancolor.obj", Triangles(12)),
    ("obj_cases/negative_indices.obj", Triangles(12)),
    ("obj_cases/not_convex.obj", Triangles(96)),
    ("obj_cases/notenoughindices.obj", Triangles(1)),
    ("obj_cases/number_formats.obj", Triangles(1)),
    ("obj_cases/obj_with_no_face_in_chunk.obj", Triangles(1)),
    ("obj_cases/point_cloud.obj", Triangles(0)),
    ("obj_cases/polygonfaces.obj", Triangles(3)),
    ("obj_cases/regr01.obj", Triangles(2710)),
    ("obj_cases/singlevn.obj", Triangles(2)),
    ("obj_cases/space_in_material_name.obj", Triangles(64)),
    ("obj_cases/testline.obj", Triangles(0)),
    ("obj_cases/testmixed.obj", Triangles(12)),
    ("obj_cases/testpoints.obj", Triangles(0)),
    ("obj_cases/two_objects.obj", Triangles(16)),
    ("obj_cases/wallhole.obj", Triangles(66)),
    ("obj_cornell/CornellBox-Original.obj", Triangles(36)),
    ("obj_cornell/CornellBox-Sphere.obj", Triangles(2188)),
    ("obj_fuze/fuze.obj", Triangles(1000)),
    ("obj_spider/spider.obj", Triangles(1368)),
    ("obj_spot/spot_control_mesh.obj", Triangles(372)),
    ("obj_spot/spot_quadrangulated.obj", Triangles(5856)),
    ("obj_spot/spot_triangulated.obj", Triangles(5856)),
    ("off_cases/ballA.off", Triangles(3796)),
    ("off_cases/comments.off", Triangles(12)),
    ("off_cases/whitespace.off", Triangles(12)),
    ("ply_cases/BoxTextured.ply", Triangles(12)),
    ("ply_cases/assimp_cube.ply", Triangles(12)),
    ("ply_cases/assimp_cube_binary.ply", Triangles(12)),
    ("ply_cases/assimp_cube_uv.ply", Triangles(12)),
    ("ply_cases/assimp_points.ply", Triangles(0)),
    ("ply_cases/bunny.ply", Triangles(16301)),
    ("ply_cases/cube_blender_uv.ply", Triangles(12)),
    ("ply_cases/cube_blender_uv_meshlab.ply", Triangles(12)),
    ("ply_cases/empty.ply", Triangles(0)),
    ("ply_cases/featuretype.ply", Triangles(3476)),
    ("ply_cases/fixed_top.ply", Triangles(4772)),
    ("ply_cases/fuze.ply", Triangles(1000)),
    ("ply_cases/fuze_ascii.ply", Triangles(1000)),
    ("ply_cases/metadata.ply", Triangles(2)),
    ("ply_cases/mirror.ply", Triangles(286)),
    ("ply_cases/multi.ply", Triangles(2)),
    ("ply_cases/octagonal_pocket.ply", Triangles(3262)),
    ("ply_cases/plane.ply", Triangles(2)),
    ("ply_cases/plane_tri.ply", Triangles(2)),
    ("ply_cases/points_ascii.ply", Triangles(0)),
    ("ply_cases/points_ascii_with_lists.ply", Triangles(0)),
    ("ply_cases/points_bin.ply", Triangles(0)),
    ("ply_cases/points_emptyascii.ply", Triangles(0)),
    ("ply_cases/reference.ply", Triangles(1610)),
    ("ply_cases/sphere.ply", Triangles(1280)),
    ("ply_cases/suzanne.ply", Triangles(968)),
    ("ply_cases/tet.ply", Triangles(4)),
    ("stl_cases/1002_tray_bottom.STL", Triangles(4520)),
    ("stl_cases/20mm-xyz-cube.stl", Triangles(260)),
    ("stl_cases/7_8ths_cube.stl", Triangles(24)),
    ("stl_cases/busted.STL", Triangles(3878)),
    ("stl_cases/empty.stl", Triangles(0)),
    ("stl_cases/featuretype.STL", Triangles(3476)),
    ("stl_cases/fuji_obj.stl", Triangles(344)),
    ("stl_cases/large_block.STL", Triangles(12)),
    ("stl_cases/multibody.stl", Triangles(32)),
    ("stl_cases/octagonal_pocket.stl", Triangles(3262)),
    ("stl_cases/plate_holes.STL", Triangles(1252)),
    ("stl_cases/soup.stl", Triangles(100)),
    ("stl_cases/teapot.stl", Triangles(894)),
    ("stl_cases/two_objects_mixed_case_names.stl", Triangles(24)),
    ("stl_cases/unit_cube.STL", Triangles(12)),
];

#[test]
fn files_of_all_formats_load_or_are_refused() {
    let Some(folder) = shared("formats") else { return };
    let endings = ["obj", "ply", "stl", "off", "gltf", "glb"];
    let files = sorted_files(&folder, &endings);
    let names: Vec<&str> = files.iter().map(|(name, _)| name.as_str()).collect();
    let expected: Vec<&str> = FORMATS.iter().map(|(name, _)| *name).collect();
    assert_eq!(names, expected, "the table has all files");
    for ((name, path), (_, expected)) in files.iter().zip(FORMATS) {
        match (load(path, &LoadOptions::default()), expected) {
            (Ok(model), Triangles(count)) => {
                assert_eq!(model.triangles.len(), *count, "{name}");
                check_lists(name, &model);
            }
            (Err(error), Refused(word)) => {
                let message = error.to_string();
                let file = path.file_name().unwrap().to_string_lossy();
                assert!(message.contains(file.as_ref()), "{message:?} names {file:?}");
                assert!(message.contains(word), "{message:?} says {word:?}");
            }
            (Ok(model), Refused(word)) => {
                panic!("{name}: {} triangles instead of {word:?}", model.triangles.len());
            }
            (Err(error), Triangles(_)) => panic!("{error}"),
        }
    }
}

/// What the documentation of `Model` promises.
fn check_lists(name: &str, model: &Model) {
    let count = model.triangles.len();
    let lengths =
        [model.normals.len(), model.uvs.len(), model.colors.len(), model.material_ids.len()];
    assert!(lengths.iter().all(|&length| length == 0 || length == count), "{name}: {lengths:?}");
    for triangle in &model.triangles {
        for &vertex in triangle {
            let position = model.vertices[vertex as usize];
            assert!(position.iter().all(|x| x.is_finite()), "{name}");
        }
    }
    for normal in model.normals.iter().flatten() {
        let length = normal.iter().map(|x| x * x).sum::<f32>().sqrt();
        assert!((length - 1.0).abs() < 1e-5, "{name}: a normal of length {length}");
    }
    let materials = model.materials.len();
    assert!(model.material_ids.iter().all(|&id| (id as usize) < materials), "{name}");
    for material in &model.materials {
        let textures = [
            material.base_color_texture,
            material.metallic_roughness_texture,
            material.emission_texture,
        ];
        for texture in textures.into_iter().flatten() {
            let texture = &model.textures[texture.texture];
            assert_eq!(texture.pixels.len(), texture.width * texture.height, "{name}");
        }
    }
}

#[test]
fn scenes_have_the_triangles_that_their_list_says() {
    let Some(folder) = shared("scenes") else { return };
    let list = std::fs::read_to_string(folder.join("scenes.json")).unwrap();
    let list: serde_json::Value = serde_json::from_str(&list).unwrap();
    let scenes = list["scenes"].as_array().unwrap();
    assert!(scenes.len() > 30);
    for scene in scenes {
        let file = scene["file"].as_str().unwrap();
        let loaded = load(&folder.join(file), &LoadOptions::default());
        if file == "awkward_nan_inf.ply" {
            let message = loaded.unwrap_err().to_string();
            assert!(message.contains("awkward_nan_inf.ply: face"), "{message}");
            assert!(message.contains("is not finite"), "{message}");
            continue;
        }
        let model = loaded.unwrap();
        let count = |key: &str| scene[key].as_u64().unwrap() as usize;
        assert_eq!(model.triangles.len(), count("triangles"), "{file}");
        assert_eq!(model.vertices.len(), count("vertices"), "{file}");
        if !model.vertices.is_empty() {
            let bounds = bounds(&model, 0..model.triangles.len());
            for (which, corner) in ["min", "max"].into_iter().zip(bounds) {
                let stated = scene["bounds"][which].as_array().unwrap();
                for (x, stated) in corner.iter().zip(stated) {
                    assert_eq!(*x, stated.as_f64().unwrap() as f32, "{file}");
                }
            }
        }
    }
}

#[test]
fn bad_triangles_are_dropped_and_counted_if_asked() {
    let Some(folder) = shared("scenes") else { return };
    let options = LoadOptions { drop_bad: true, ..LoadOptions::default() };
    let model = load(&folder.join("awkward_nan_inf.ply"), &options).unwrap();
    check_lists("awkward_nan_inf", &model);
    let dropped = 6362 - model.triangles.len();
    assert!(dropped > 0);
    let warning = format!("bad polygons dropped: {dropped}");
    assert!(model.warnings.iter().any(|w| w.contains(&warning)), "{:?}", model.warnings);
}

fn bounds(model: &Model, triangles: std::ops::Range<usize>) -> [[f32; 3]; 2] {
    let mut bounds = [[f32::INFINITY; 3], [f32::NEG_INFINITY; 3]];
    for &vertex in model.triangles[triangles].iter().flatten() {
        let position = model.vertices[vertex as usize];
        for axis in 0..3 {
            bounds[0][axis] = bounds[0][axis].min(position[axis]);
            bounds[1][axis] = bounds[1][axis].max(position[axis]);
        }
    }
    bounds
}

fn center(model: &Model, triangles: std::ops::Range<usize>) -> [f32; 3] {
    let [low, high] = bounds(model, triangles);
    [0, 1, 2].map(|axis| 0.5 * (low[axis] + high[axis]))
}

fn assert_near(a: [f32; 3], b: [f32; 3], what: &str) {
    let far = a.iter().zip(b).any(|(a, b)| (a - b).abs() > 1e-4);
    assert!(!far, "{what}: {a:?} is not {b:?}");
}

/// Triangles a mesh, by index: ground, three spheres, two cubes, a leaf, a pyramid.
const MESHES: [usize; 8] = [2, 960, 960, 960, 12, 12, 23, 29];

fn made_scene(folder: &Path) -> (Model, serde_json::Value) {
    let model = load(&folder.join("gltf_made_scene/scene.gltf"), &LoadOptions::default()).unwrap();
    let text = std::fs::read_to_string(folder.join("gltf_made_scene/scene.gltf")).unwrap();
    (model, serde_json::from_str(&text).unwrap())
}

#[test]
fn the_made_scene_has_every_instance_in_its_place() {
    let Some(folder) = shared("formats") else { return };
    let (model, json) = made_scene(&folder);
    assert_eq!(model.triangles.len(), 65_694);
    let number = |value: &serde_json::Value| value.as_f64().unwrap() as f32;
    // Nodes 0 to 3, the three arms, then 7 to 11.
    let mut at = MESHES[0] + 3 * 960;
    let arm = at..at + 12;
    at += 3 * 12;
    // The outermost arm hangs on two others.
    let node = |index: usize| {
        let read = |key: &str, count: usize, missing: f32| -> Vec<f32> {
            let list = json["nodes"][index][key].as_array();
            list.map_or(vec![missing; count], |list| list.iter().map(number).collect())
        };
        glam::Mat4::from_scale_rotation_translation(
            glam::Vec3::from_slice(&read("scale", 3, 1.0)),
            glam::Quat::from_slice(&read("rotation", 4, 0.0)),
            glam::Vec3::from_slice(&read("translation", 3, 0.0)),
        )
    };
    let outermost = (node(6) * node(5) * node(4)).transform_point3(glam::Vec3::ZERO);
    assert_near(center(&model, arm.start + 24..arm.end + 24), outermost.into(), "arm2");
    assert_near(center(&model, at..at + 12), [6.0, 1.0, -4.0], "mirrored");
    let sheared = bounds(&model, at + 12..at + 24);
    assert_near(sheared[0], [-1.5, 0.0, -6.0], "sheared, low");
    assert_near(sheared[1], [1.5, 2.0, -4.0], "sheared, high");
    at += 3 * 12 + MESHES[6] + MESHES[7];
    for index in 12..140 {
        let node = &json["nodes"][index];
        let count = MESHES[node["mesh"].as_u64().unwrap() as usize];
        let translation = [0, 1, 2].map(|axis| number(&node["translation"][axis]));
        assert_near(center(&model, at..at + count), translation, "an instance");
        at += count;
    }
    // What is left are the 40 cubes of EXT_mesh_gpu_instancing.
    assert_eq!(model.triangles.len() - at, 40 * 12);
    let centers: Vec<[f32; 3]> =
        (0..40).map(|i| center(&model, at + 12 * i..at + 12 * (i + 1))).collect();
    for (which, pick) in [("min", f32::min as fn(f32, f32) -> f32), ("max", f32::max)] {
        let stated = [0, 1, 2].map(|axis| number(&json["accessors"][17][which][axis]));
        let found = centers.iter().copied().reduce(|a, b| [0, 1, 2].map(|i| pick(a[i], b[i])));
        assert_near(found.unwrap(), stated, which);
    }
}

#[test]
fn the_made_scene_is_wound_as_its_normals_say() {
    let Some(folder) = shared("formats") else { return };
    let (model, _) = made_scene(&folder);
    for (triangle, normals) in model.triangles.iter().zip(&model.normals) {
        let [a, b, c] = triangle.map(|vertex| glam::Vec3::from(model.vertices[vertex as usize]));
        let geometric = (b - a).cross(c - a);
        if geometric.length() > 1e-6 {
            let shading: glam::Vec3 = normals.iter().map(|&n| glam::Vec3::from(n)).sum();
            assert!(geometric.dot(shading) > 0.0, "{triangle:?} {normals:?}");
        }
    }
}

#[test]
fn the_made_scene_has_its_cameras_lights_and_materials() {
    let Some(folder) = shared("formats") else { return };
    let (model, _) = made_scene(&folder);
    let near = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-5);
    let [perspective, orthographic] = model.cameras.as_slice() else { panic!("two cameras") };
    let Camera { eye, look_at, up, projection, .. } = perspective;
    assert!(near(*eye, [0.0, 3.0, 11.0]) && up[1] > 0.9, "{perspective:?}");
    assert!(look_at[2] < eye[2] && look_at[1] < eye[1], "looks ahead and down: {perspective:?}");
    let Projection::Perspective { vfov_degrees } = projection else { panic!("{projection:?}") };
    assert!((vfov_degrees - 0.7_f64.to_degrees()).abs() < 1e-5);
    assert!(near(orthographic.eye, [12.0, 10.0, 12.0]));
    assert_eq!(orthographic.projection, Projection::Orthographic { height: 16.0 });

    let [sun, bulb, spot] = model.lights.as_slice() else { panic!("three lights") };
    let Light::Directional { direction, irradiance } = sun else { panic!("{sun:?}") };
    assert!(direction[1] < 0.0, "the sun shines down");
    assert_eq!(*irradiance, [3.0, 0.95 * 3.0, 0.9 * 3.0]);
    let Light::Point { position, intensity, cone: None } = bulb else { panic!("{bulb:?}") };
    assert!(near(*position, [-4.0, 4.0, 3.0]));
    assert_eq!(*intensity, [120.0, 0.7 * 120.0, 0.4 * 120.0]);
    let Light::Point { cone: Some(cone), .. } = spot else { panic!("{spot:?}") };
    assert_eq!((cone.inner_angle, cone.outer_angle), (0.3, 0.6));

    let material = |name: &str| model.materials.iter().find(|m| m.name == name).unwrap();
    assert_eq!(material("glass").transmission, 1.0);
    assert_eq!(material("emissive").emission, [8.0; 3]);
    assert!(material("unlit").unlit);
    assert_eq!(material("leaf").alpha_mode, kdray_scene::AlphaMode::Mask(0.5));
    let ground = material("ground").base_color_texture.unwrap();
    let (sin, cos) = 0.3_f32.sin_cos();
    let expected = [[0.5 * cos, 0.5 * sin, 0.25], [-0.5 * sin, 0.5 * cos, 0.0]];
    assert_eq!(ground.transform, expected, "KHR_texture_transform");
    // The file is "checker base.png", written with %20.
    assert_eq!(model.textures[ground.texture].wrap, [kdray_scene::Wrap::Repeat; 2]);
    let embedded = material("embedded").base_color_texture.unwrap();
    let wrap = model.textures[embedded.texture].wrap;
    assert_eq!(wrap, [kdray_scene::Wrap::Clamp, kdray_scene::Wrap::Mirror]);
    assert_eq!(model.warnings, [""; 0]);
}

#[test]
fn glb_and_gltf_hold_the_same_scene() {
    let Some(folder) = shared("formats") else { return };
    let (gltf, _) = made_scene(&folder);
    let glb = load(&folder.join("gltf_made_scene/scene.glb"), &LoadOptions::default()).unwrap();
    assert!(gltf == glb);
}

#[test]
fn closed_meshes_stay_closed() {
    let Some(folder) = shared("formats") else { return };
    let closed = [
        "obj_spot/spot_quadrangulated.obj",
        "obj_cases/negative_indices.obj",
        "obj_cases/box_UTF16BE.obj",
        "stl_cases/unit_cube.STL",
        "stl_cases/two_objects_mixed_case_names.stl",
        "off_cases/comments.off",
        "ply_cases/tet.ply",
        "ply_cases/sphere.ply",
    ];
    for name in closed {
        let model = load(&folder.join(name), &LoadOptions::default()).unwrap();
        let mut net = std::collections::HashMap::new();
        for &[a, b, c] in &model.triangles {
            for (a, b) in [(a, b), (b, c), (c, a)] {
                let place = |i: u32| model.vertices[i as usize].map(f32::to_bits);
                let (a, b) = (place(a), place(b));
                *net.entry((a.min(b), a.max(b))).or_insert(0) += if a < b { 1 } else { -1 };
            }
        }
        assert!(net.values().all(|&count| count == 0), "{name}");
    }
}
