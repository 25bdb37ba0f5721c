//! Trees that kdray builds were refused: of triangles that lie in a plane and are listed on one side of it, each part was
//! sought in all cells on the other side first.

use kdray::build::Preset;
use kdray::{BuildOptions, Scene, Strategy};
use kdray_tests::meshes;

#[test]
fn trees_of_many_sheets_on_many_columns_are_valid() {
    const COLUMNS: usize = 32;
    let step = 1.0 / COLUMNS as f32;
    let column = |i: usize| {
        let [x, y] = [i % COLUMNS, i / COLUMNS].map(|k| (k as f32 + 0.3) * step);
        let beside = 0.2 * step;
        [[x, y, 0.0], [x + beside, y, 0.0], [x, y + beside, 1.0]]
    };
    let columns = (0..COLUMNS * COLUMNS).map(column);
    let sheets = [[[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [0.0, 1.0, 1.0]]; 500];
    let above = [[0.1, 0.1, 1.2], [0.9, 0.1, 1.6], [0.1, 0.9, 1.4]];
    let soup: Vec<_> = columns.chain(sheets).chain([above]).collect();
    let presets = Preset::ALL.map(BuildOptions::preset);
    let strategies = Strategy::ALL.map(BuildOptions::for_strategy);
    for options in presets.into_iter().chain(strategies) {
        let scene = Scene::build(meshes::mesh(soup.clone()), &options).expect("the mesh is small");
        assert_eq!(scene.tree().validate(scene.mesh()), Ok(()), "{options:?}");
    }
}
