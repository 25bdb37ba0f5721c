//! `kdray query`: every mode, format and precision against the answer without a tree.

mod support;

use npyz::Order;
use std::fs;
use support::{
    Folder, OCTAHEDRON, USAGE, bumpy_ball,
    hits::Npz,
    rays::{csv, npy, raw_npy, rays},
};

const MODES: [&str; 4] = ["closest", "any", "all", "count"];

/// A folder with a mesh of 600 triangles.
fn folder() -> Folder {
    let folder = Folder::new();
    folder.file("ball.off", bumpy_ball(15, 20));
    folder
}

/// Answers the rays in `file` into `out`.
fn query(folder: &Folder, file: &str, mode: &str, out: &str, more: &[&str]) {
    let arguments = ["query", "ball.off", "--rays", file, "--mode", mode, "--out", out];
    folder.kdray(&[&arguments, more].concat()).succeeds();
}

#[test]
fn the_tree_and_every_triangle_answer_alike() {
    let folder = folder();
    for columns in [6, 8] {
        let rays = rays(500, columns);
        folder.file("f4.npy", npy(&rays, Order::C, |x| x as f32));
        folder.file("f8.npy", npy(&rays, Order::C, |x| x));
        folder.file("rays.csv", csv(&rays));
        for mode in MODES {
            for file in ["f4.npy", "f8.npy", "rays.csv"] {
                query(&folder, file, mode, "naive.npz", &["--naive"]);
                let naive = fs::read(folder.path("naive.npz")).unwrap();
                for split in ["sah", "middle", "median", "round-robin"] {
                    query(&folder, file, mode, "tree.npz", &["--split", split]);
                    let same = fs::read(folder.path("tree.npz")).unwrap() == naive;
                    assert!(same, "{mode} {file} {split} {columns}");
                }
            }
        }
    }
}

#[test]
fn the_form_of_the_rays_does_not_matter() {
    let folder = folder();
    let rays = rays(70_000, 6); // More than one chunk.
    folder.file("c.npy", npy(&rays, Order::C, |x| x));
    folder.file("fortran.npy", npy(&rays, Order::Fortran, |x| x));
    folder.file("big.npy", swapped(npy(&rays, Order::C, |x| x)));
    folder.file("named.csv", format!("# rays\nox, oy, oz, dx, dy, dz\n\n{}", csv(&rays)));
    query(&folder, "c.npy", "closest", "expected.npz", &[]);
    let expected = fs::read(folder.path("expected.npz")).unwrap();
    for file in ["fortran.npy", "big.npy", "named.csv"] {
        query(&folder, file, "closest", "hits.npz", &["--threads", "3"]);
        assert!(fs::read(folder.path("hits.npz")).unwrap() == expected, "{file}");
    }
    let arguments = ["query", "ball.off", "--rays", "-", "--out", "hits.npz"];
    for file in ["c.npy", "named.csv"] {
        let stdin = fs::read(folder.path(file)).unwrap();
        folder.kdray_reading(&arguments, stdin).succeeds();
        assert!(fs::read(folder.path("hits.npz")).unwrap() == expected, "{file} by a pipe");
    }
}

/// The same npy file with the other byte order.
fn swapped(mut npy: Vec<u8>) -> Vec<u8> {
    let start = npy.len() - 70_000 * 6 * 8;
    let descr = npy.windows(3).position(|bytes| bytes == b"<f8").expect("a dtype");
    npy[descr] = b'>';
    npy[start..].chunks_exact_mut(8).for_each(<[u8]>::reverse);
    npy
}

#[test]
fn arrays_are_named_typed_and_shaped_as_in_open3d() {
    let folder = Folder::new();
    folder.file("ball.off", OCTAHEDRON);
    // Through the middle of a face and out of another; aside; from inside.
    let rays = [
        vec![0.25, 0.25, 3.0, 0.0, 0.0, -2.0],
        vec![5.0, 5.0, 3.0, 0.0, 0.0, -2.0],
        vec![0.25, 0.25, 0.0, 0.0, 0.0, 1.0],
    ];
    folder.file("rays.npy", npy(&rays, Order::C, |x| x as f32));
    let read = |mode: &str| {
        query(&folder, "rays.npy", mode, "hits.npz", &[]);
        Npz::read(&folder.path("hits.npz"))
    };

    let closest = read("closest");
    let names = ["t_hit", "geometry_ids", "primitive_ids", "primitive_uvs", "primitive_normals"];
    assert_eq!(closest.names(), names);
    assert_eq!(closest.array::<f32>("t_hit"), (vec![1.25, f32::INFINITY, 0.5], vec![3]));
    assert_eq!(closest.numbers::<u32>("geometry_ids"), [0, u32::MAX, 0]);
    assert_eq!(closest.numbers::<u32>("primitive_ids"), [0, u32::MAX, 0]);
    // The face's corners are +x, +y, +z, so the weights of +y and +z at (1/4, 1/4, 1/2).
    let uvs = vec![0.25, 0.5, 0.0, 0.0, 0.25, 0.5];
    assert_eq!(closest.array::<f32>("primitive_uvs"), (uvs, vec![3, 2]));
    let (normals, shape) = closest.array::<f32>("primitive_normals");
    let third = (1.0_f64 / 3.0).sqrt() as f32;
    assert_eq!(normals, [third, third, third, 0.0, 0.0, 0.0, third, third, third]);
    assert_eq!(shape, [3, 3]);

    let any = read("any");
    assert_eq!(any.array::<bool>("occluded"), (vec![true, false, true], vec![3]));

    let all = read("all");
    assert_eq!(all.array::<i64>("ray_splits"), (vec![0, 2, 2, 3], vec![4]));
    assert_eq!(all.numbers::<i64>("ray_ids"), [0, 0, 2]);
    assert_eq!(all.numbers::<f32>("t_hit"), [1.25, 1.75, 0.5]);
    assert_eq!(all.numbers::<u32>("geometry_ids"), [0, 0, 0]);
    assert_eq!(all.numbers::<u32>("primitive_ids"), [0, 4, 0]);
    assert_eq!(all.array::<f32>("primitive_uvs").1, [3, 2]);

    let count = read("count");
    assert_eq!(count.array::<i32>("intersection_counts"), (vec![2, 0, 1], vec![3]));
}

#[test]
fn csv_holds_what_npz_holds() {
    let folder = Folder::new();
    folder.file("ball.off", OCTAHEDRON);
    let rays = "0.25,0.25,3,0,0,-2\n5,5,3,0,0,-2\n";
    let csv = |mode: &str| {
        let arguments = ["query", "ball.off", "--rays", "-", "--mode", mode, "--out", "-"];
        folder.kdray_reading(&arguments, rays).succeeds().stdout
    };
    let third = 1.0 / 3.0_f64.sqrt();
    let hit = "t_hit,geometry_ids,primitive_ids,primitive_uvs_u,primitive_uvs_v";
    let normal = "primitive_normals_x,primitive_normals_y,primitive_normals_z";
    assert_eq!(
        csv("closest"),
        format!(
            "{hit},{normal}\n1.25,0,0,0.25,0.5,{third},{third},{third}\n\
             inf,4294967295,4294967295,0.0,0.0,0.0,0.0,0.0\n"
        )
    );
    assert_eq!(csv("any"), "occluded\ntrue\nfalse\n");
    assert_eq!(csv("all"), format!("ray_ids,{hit}\n0,1.25,0,0,0.25,0.5\n0,1.75,0,4,0.25,0.5\n"));
    assert_eq!(csv("count"), "intersection_counts\n2\n0\n");
    let arguments = ["query", "ball.off", "--rays", "-", "--out", "hits.csv"];
    folder.kdray_reading(&arguments, rays).succeeds();
    assert_eq!(fs::read_to_string(folder.path("hits.csv")).unwrap(), csv("closest"));
}

#[test]
fn no_rays_make_empty_arrays() {
    let folder = folder();
    folder.file("none.npy", raw_npy("'<f8'", "(0, 6)", &[]));
    folder.file("none.csv", "");
    for file in ["none.npy", "none.csv"] {
        query(&folder, file, "closest", "hits.npz", &[]);
        let hits = Npz::read(&folder.path("hits.npz"));
        assert_eq!(hits.array::<f64>("t_hit"), (vec![], vec![0]));
        assert_eq!(hits.array::<f64>("primitive_uvs"), (vec![], vec![0, 2]));
    }
}

#[test]
fn arguments_that_do_not_go_together_are_refused() {
    let folder = folder();
    let ran = folder.kdray(&["query", "-", "--rays", "-", "--out", "hits.npz"]);
    ran.fails(USAGE, &["standard input cannot be both scene and rays"]);
    let ran = folder.kdray(&["query", "ball.off", "--rays", "r.npy", "--out", "hits.txt"]);
    ran.fails(USAGE, &["hits.txt", ".npz or .csv"]);
}
