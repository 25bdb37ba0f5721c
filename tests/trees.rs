//! Trees of every strategy and preset over the smaller scenes beside the checkout are valid.

use kdray::{BuildOptions, KdTree, Preset, Strategy};
use kdray_tests::shared::{load_mesh, scenes};

/// Scenes up to this many triangles are built.
const MOST: usize = 60_000;

/// How many there are at the least.
const LEAST: usize = 20;

#[test]
fn scenes_have_valid_trees_below_the_quota() {
    let Some(mut small) = scenes() else { return };
    small.retain(|info| info.triangles <= MOST);
    assert!(small.len() >= LEAST, "{} scenes", small.len());
    for info in small {
        let mesh = load_mesh(&info).expect("the scene loads");
        let count = mesh.triangles().len();
        let strategies = Strategy::ALL.map(BuildOptions::for_strategy);
        for options in strategies.into_iter().chain(Preset::ALL.map(BuildOptions::preset)) {
            let tree = KdTree::build(&mesh, &options).expect("the scene is valid");
            assert_eq!(tree.validate(&mesh), Ok(()), "{}, {options:?}", info.name);
            let references = tree.stats(count, &options.cost).references;
            let quota = BuildOptions::reference_quota(count) as usize;
            assert!(references <= quota, "{}, {options:?}: {references}", info.name);
        }
    }
}
