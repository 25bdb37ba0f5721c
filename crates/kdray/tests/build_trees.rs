//! Trees of every strategy over hard and easy input: they hold what they must, within bounds, and
//! do not depend on the builder or the number of threads.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod build_common;

use build_common::{all_options, balls, binned_deep, mesh, random_soup, small_plans, small_soups};
use kdray::build::{SahBuilder, Termination};
use kdray::primitives::Primitives;
use kdray::tree::{MAX_DEPTH, NodeKind};
use kdray::{Aabb, BuildOptions, CostModel, KdTree, Preset, Strategy, TriangleMesh};

/// The tree, after checks that hold for all.
fn checked_tree<const K: usize>(
    name: &str,
    primitives: &impl Primitives<K>,
    options: &BuildOptions,
) -> KdTree<K> {
    let tree = KdTree::build(primitives, options).unwrap();
    tree.validate(primitives).unwrap_or_else(|error| panic!("{name}, {options:?}: {error}"));
    let count = primitives.count();
    let stats = tree.stats(count, &options.cost);
    assert!(stats.max_depth <= options.depth_limit(count).min(MAX_DEPTH), "{name}, {options:?}");
    let quota = BuildOptions::reference_quota(count) as usize;
    assert!(stats.references <= quota, "{name}, {options:?}: {}", stats.references);
    tree
}

#[test]
fn every_strategy_builds_valid_trees() {
    for options in all_options() {
        for (name, soup) in small_soups() {
            checked_tree(name, &mesh(soup), &options);
        }
        for (name, plan) in small_plans() {
            checked_tree(name, &plan, &options);
        }
        checked_tree("balls", &balls(300), &options);
    }
}

#[test]
fn a_side_too_thin_to_be_cut_leaves_the_others() {
    // At 2^24 numbers of f32 are two apart: x is the longest side, and there is no plane in it.
    let far = |i: u32| [16_777_216.0, (i % 40) as f32 / 40.0, (i / 40) as f32 / 50.0];
    let triangle = |i: u32| {
        let [x, y, z] = far(i);
        [[x, y, z], [x + 2.0, y + 0.01, z], [x, y, z + 0.01]]
    };
    let mesh = mesh((0..2000).map(triangle).collect());
    for strategy in Strategy::ALL {
        let options = BuildOptions::for_strategy(strategy);
        let tree = checked_tree("far plate", &mesh, &options);
        let largest = tree.stats(2000, &options.cost).largest_leaf;
        assert!(largest < 100, "{strategy:?}: {largest}");
    }
}

#[test]
fn figures_of_a_tree_can_be_had_by_any_cost_model() {
    let tree = checked_tree("balls", &balls(20), &BuildOptions::default());
    let no_block = CostModel { block: 0, ..CostModel::default() };
    assert!(tree.stats(20, &no_block).sah_cost > 0.0);
}

#[test]
fn the_sweep_and_the_naive_builder_give_the_same_tree() {
    let tuned = BuildOptions::for_strategy(Strategy::Sah);
    let lecture = BuildOptions { cost: CostModel::LECTURE, leaf_size: 3, ..tuned };
    for sweep in [tuned, lecture, BuildOptions::preset(Preset::Best)] {
        let naive = BuildOptions { sah_builder: SahBuilder::Naive, ..sweep };
        for (name, soup) in small_soups() {
            let mesh = mesh(soup);
            let tree = checked_tree(name, &mesh, &sweep);
            assert!(tree == KdTree::build(&mesh, &naive).unwrap(), "{name}, {:?}", sweep.cost);
        }
        for (name, plan) in small_plans() {
            let tree = checked_tree(name, &plan, &sweep);
            assert!(tree == KdTree::build(&plan, &naive).unwrap(), "{name}, {:?}", sweep.cost);
        }
        let balls = balls(200);
        assert!(KdTree::build(&balls, &sweep).unwrap() == KdTree::build(&balls, &naive).unwrap());
    }
}

#[test]
fn the_binned_builder_at_small_nodes_is_the_sweep() {
    let sweep = BuildOptions::for_strategy(Strategy::Sah);
    let sah_builder = SahBuilder::Binned { sweep_below: usize::MAX };
    for (name, soup) in small_soups() {
        let mesh = mesh(soup);
        let binned = KdTree::build(&mesh, &BuildOptions { sah_builder, ..sweep }).unwrap();
        assert!(binned == KdTree::build(&mesh, &sweep).unwrap(), "{name}");
    }
}

#[test]
fn the_binned_builder_is_nearly_as_good_as_the_sweep() {
    for (size, snapped) in [(0.02, false), (0.1, false), (0.3, true)] {
        let mesh = mesh(random_soup(5000, size, snapped, 16));
        let sweep = BuildOptions::for_strategy(Strategy::Sah);
        let cost = |options| {
            let tree = checked_tree("soup", &mesh, &options);
            tree.stats(mesh.count(), &options.cost).sah_cost
        };
        let (binned, best) = (cost(binned_deep()), cost(sweep));
        assert!(binned < 1.1 * best, "size {size}: {binned}, by the sweep {best}");
    }
}

/// What pruning weighs: the cost of all nodes by the boxes around what they list.
fn tight_cost(tree: &KdTree, mesh: &TriangleMesh, cost: &CostModel) -> f64 {
    let cells: Vec<_> = tree.cells().collect();
    let mut tight = vec![Aabb::EMPTY; cells.len()];
    let surface = |aabb: &Aabb| if aabb.is_empty() { 0.0 } else { aabb.half_surface() };
    let mut sum = 0.0;
    for (node, cell) in cells.iter().enumerate().rev() {
        if let NodeKind::Inner { above, .. } = tree.nodes()[node].kind() {
            tight[node] = tight[node + 1].union(&tight[above as usize]);
            sum += surface(&tight[node]) * cost.traversal;
        } else {
            let list = tree.leaf_primitives(node as u32);
            let parts = list.iter().filter_map(|&id| mesh.clipped_bounds(id, &cell.bounds));
            tight[node] = parts.fold(Aabb::EMPTY, |all, part| all.union(&part));
            sum += surface(&tight[node]) * cost.leaf(list.len());
        }
    }
    sum
}

#[test]
fn pruning_makes_trees_smaller_and_no_dearer() {
    let mut pruned_some = 0;
    for (name, soup) in small_soups() {
        let mesh = mesh(soup);
        for cost in [CostModel::default(), CostModel::BLOCKS_OF_8] {
            let uncut = BuildOptions { cost, ..BuildOptions::for_strategy(Strategy::Sah) };
            let pruned = BuildOptions { prune: true, ..uncut };
            let [before, after] = [uncut, pruned].map(|o| checked_tree(name, &mesh, &o));
            let [dearer, cheaper] = [&before, &after].map(|tree| tight_cost(tree, &mesh, &cost));
            assert!(cheaper <= dearer * (1.0 + 1e-6), "{name}: {cheaper}, uncut {dearer}");
            assert!(after.nodes().len() <= before.nodes().len(), "{name}");
            pruned_some += usize::from(after.nodes().len() < before.nodes().len());
        }
    }
    assert!(pruned_some > 10, "{pruned_some}");
}

#[test]
fn what_is_pruned_lists_each_primitive_once() {
    let mesh = mesh(random_soup(12, 1.5, false, 17));
    // Whatever it costs, all is cut three times; then no cut is worth a step.
    let termination = Termination::LimitsOnly;
    let cost = CostModel { traversal: 1e9, termination, ..CostModel::BLOCKS_OF_8 };
    let cut =
        BuildOptions { cost, max_depth: Some(3), ..BuildOptions::for_strategy(Strategy::Sah) };
    assert!(checked_tree("cut", &mesh, &cut).stats(12, &cost).references > 12);
    let tree = checked_tree("pruned", &mesh, &BuildOptions { prune: true, ..cut });
    assert_eq!(tree.nodes().len(), 1);
    assert_eq!(tree.leaf_primitives(0), (0..12).collect::<Vec<_>>());
}

#[test]
fn no_depth_is_deeper_than_the_stack() {
    let mesh = mesh(random_soup(200, 0.5, false, 11));
    for options in all_options() {
        let deep = BuildOptions { max_depth: Some(1000), leaf_size: 0, ..options };
        assert_eq!(deep.depth_limit(200), MAX_DEPTH);
        checked_tree("deep", &mesh, &deep);
        let flat = BuildOptions { max_depth: Some(0), ..options };
        assert_eq!(checked_tree("flat", &mesh, &flat).nodes().len(), 1);
    }
}

#[test]
fn identical_triangles_neither_hang_nor_take_all_memory() {
    let triangle = [[0.1, 0.2, 0.3], [1.0, 0.1, 0.2], [0.3, 0.9, 0.8]];
    let mesh = mesh(vec![triangle; 20_000]);
    for options in all_options() {
        let stats = KdTree::build(&mesh, &options).unwrap().stats(20_000, &options.cost);
        assert!(stats.references_per_primitive <= 33.0, "{options:?}");
        assert!(stats.nodes < 100_000, "{options:?}: {} nodes", stats.nodes);
    }
}

#[test]
fn real_scenes_do_not_meet_the_quota() {
    let mesh = mesh(random_soup(20_000, 0.02, false, 12));
    for options in all_options() {
        let tree = checked_tree("soup", &mesh, &options);
        let stats = tree.stats(20_000, &options.cost);
        let per_primitive = stats.references_per_primitive;
        assert!(per_primitive < 16.0, "{options:?}: {per_primitive}");
    }
}

#[test]
fn the_median_puts_as_many_left_as_right() {
    let mesh = mesh(random_soup(1001, 0.0, false, 13));
    let once = BuildOptions { max_depth: Some(1), ..BuildOptions::for_strategy(Strategy::Median) };
    let tree = checked_tree("points", &mesh, &once);
    let sides = [1, 2].map(|leaf| tree.leaf_primitives(leaf).len());
    assert_eq!(sides, [501, 500]);
}

#[test]
fn sah_expects_the_least_cost() {
    let soup = random_soup(5000, 0.02, false, 14);
    let cluster = soup.iter().map(|t| t.map(|p| p.map(|x| 0.03 * x)));
    let mesh = mesh(soup[..500].iter().copied().chain(cluster).collect());
    let cost = CostModel::default();
    let expected = |strategy| {
        let options = BuildOptions::for_strategy(strategy);
        KdTree::build(&mesh, &options).unwrap().stats(mesh.count(), &cost).sah_cost
    };
    let sah = expected(Strategy::Sah);
    for other in [Strategy::Middle, Strategy::Median, Strategy::RoundRobin] {
        assert!(sah < 0.8 * expected(other), "{other:?}: {sah} {}", expected(other));
    }
}

#[cfg(feature = "rayon")]
#[test]
fn the_number_of_threads_makes_no_difference() {
    let mesh = mesh(random_soup(30_000, 0.02, false, 15));
    for options in all_options() {
        assert_same_on_threads(&mesh, &options);
    }
}

/// Of so many references several threads share each node of the first levels; there is no need of more levels.
#[cfg(feature = "rayon")]
#[test]
fn the_number_of_threads_makes_no_difference_to_large_nodes() {
    let mesh = mesh(random_soup(80_000, 0.02, false, 16));
    for options in all_options() {
        assert_same_on_threads(&mesh, &BuildOptions { max_depth: Some(3), ..options });
    }
}

#[cfg(feature = "rayon")]
fn assert_same_on_threads(mesh: &kdray::TriangleMesh, options: &BuildOptions) {
    let trees = [1, 2, 3].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| KdTree::build(mesh, options).unwrap())
    });
    assert!(trees[0] == trees[1] && trees[0] == trees[2], "{options:?}");
}
