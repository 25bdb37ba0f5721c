//! Progress, cancellation, and input that cannot be built.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod build_common;

use build_common::{all_options, mesh, random_soup};
use kdray::primitives::Primitives;
use kdray::{Aabb, BuildError, BuildOptions, KdTree, Scene};
use std::ops::ControlFlow;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

#[test]
fn progress_rises_to_one() {
    let mesh = mesh(random_soup(20_000, 0.02, false, 21));
    for options in all_options() {
        let told = Mutex::new(vec![0.0]);
        let progress = |progress: kdray::BuildProgress| {
            told.lock().unwrap().push(progress.fraction);
            ControlFlow::Continue(())
        };
        KdTree::build_with_progress(&mesh, &options, &progress).unwrap();
        rises_to_one(&std::mem::take(&mut *told.lock().unwrap()), &options);
        Scene::build_with_progress(mesh.clone(), &options, &progress).unwrap();
        rises_to_one(&told.into_inner().unwrap(), &options);
    }
}

fn rises_to_one(told: &[f64], options: &BuildOptions) {
    assert!(told.is_sorted(), "{options:?}: {told:?}");
    assert_eq!(told.last(), Some(&1.0), "{options:?}");
    for step in [0.2, 0.4, 0.6, 0.8] {
        let near = |&fraction: &f64| step - 0.2 < fraction && fraction < step + 0.2;
        assert!(told.iter().any(near), "{options:?}: {step} of {told:?}");
    }
}

#[test]
fn wide_trees_are_part_of_the_progress() {
    let mesh = mesh(random_soup(20_000, 0.02, false, 23));
    let options = BuildOptions::default();
    let reports = Mutex::new(vec![]);
    let keep = |done: kdray::BuildProgress| {
        reports.lock().unwrap().push(done.fraction);
        ControlFlow::Continue(())
    };
    Scene::build_with_progress(mesh.clone(), &options, &keep).unwrap();
    let late = reports.into_inner().unwrap().iter().filter(|&&done| done > 0.75).count();
    assert!(late > 3, "{late} reports of a tree that is being made wide");
    for stop_after in [0.75, 0.8, 0.9, 0.999] {
        let late = AtomicUsize::new(0);
        let progress = |done: kdray::BuildProgress| {
            if done.fraction <= stop_after {
                return ControlFlow::Continue(());
            }
            late.fetch_add(1, Ordering::Relaxed);
            ControlFlow::Break(())
        };
        let result = Scene::build_with_progress(mesh.clone(), &options, &progress);
        assert_eq!(result.err(), Some(BuildError::Cancelled), "{stop_after}");
        assert_eq!(late.into_inner(), 1, "{stop_after}: went on");
    }
}

#[test]
fn a_build_can_be_cancelled_at_any_report() {
    let mesh = mesh(random_soup(20_000, 0.02, false, 22));
    for options in all_options() {
        for stop_at in [0, 1, 2, 5, 20] {
            let reports = AtomicUsize::new(0);
            let progress = |_| {
                let stop = reports.fetch_add(1, Ordering::Relaxed) == stop_at;
                if stop { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            };
            let result = KdTree::build_with_progress(&mesh, &options, &progress);
            assert_eq!(result, Err(BuildError::Cancelled), "{options:?}, report {stop_at}");
            assert_eq!(reports.into_inner(), stop_at + 1, "{options:?}: went on");
        }
    }
}

/// Boxes as they are, good or bad.
struct Boxes(Vec<Aabb<2>>);

impl Primitives<2> for Boxes {
    fn count(&self) -> usize {
        self.0.len()
    }

    fn bounds(&self, id: u32) -> Aabb<2> {
        self.0[id as usize]
    }
}

#[test]
fn bounds_that_are_not_finite_are_named() {
    let unit = Aabb { min: [0.0; 2], max: [1.0; 2] };
    let nan = Aabb { min: [0.0, f32::NAN], max: [1.0; 2] };
    let infinite = Aabb { min: [0.0; 2], max: [1.0, f32::INFINITY] };
    for options in all_options() {
        for bad in [nan, infinite, Aabb::EMPTY] {
            let boxes = Boxes(vec![unit, unit, bad, nan]);
            let result = KdTree::build(&boxes, &options);
            assert_eq!(result, Err(BuildError::NonFiniteBounds(2)));
        }
    }
}

#[test]
fn primitives_that_are_nowhere_are_not_listed() {
    let unit = Aabb { min: [0.0; 2], max: [1.0; 2] };
    let nowhere = Aabb { min: [5.0; 2], max: [4.0; 2] };
    for options in all_options() {
        let boxes = Boxes(vec![nowhere, unit, nowhere]);
        let tree = KdTree::build(&boxes, &options).unwrap();
        assert_eq!((tree.bounds(), tree.leaf_primitives(0)), (&unit, &[1][..]));
        tree.validate(&boxes).unwrap();
    }
}

#[test]
fn nothing_is_one_empty_leaf() {
    for options in all_options() {
        let tree = KdTree::build(&Boxes(vec![]), &options).unwrap();
        assert_eq!((tree.bounds(), tree.nodes().len()), (&Aabb::EMPTY, 1));
        assert_eq!(tree.leaf_primitives(0), []);
        tree.validate(&Boxes(vec![])).unwrap();
    }
}

/// More primitives than a tree can name; none of them is ever asked for.
struct TooMany;

impl Primitives<3> for TooMany {
    fn count(&self) -> usize {
        1 << 30
    }

    fn bounds(&self, id: u32) -> Aabb<3> {
        panic!("primitive {id} was asked for")
    }
}

#[test]
fn too_many_primitives_are_refused() {
    let result = KdTree::build(&TooMany, &BuildOptions::default());
    assert_eq!(result, Err(BuildError::TooManyPrimitives(1 << 30)));
}
