//! The way of a packet's frustum through the tree (S12), in space: the leaves it met over a render.

use super::canvas::{Anchor, Canvas, Stroke, lines};
use super::frustum_path::{Fates, frustum_edges};
use super::legend::{self, Entry};
use super::over_render::{Edge, OverRender, box_edges};
use super::palette;
use kdray::{Aabb, ShapeScene, traverse::PacketStep, tree::Cell};
use kdray_scene::Camera;

/// What the picture shows.
pub(crate) struct FrustumView<'a> {
    /// Triangles and tree.
    pub(crate) scene: &'a ShapeScene,
    /// From where it is seen.
    pub(crate) camera: &'a Camera,
    /// The scene as the camera sees it, as a PNG of `size` pixels.
    pub(crate) render: &'a [u8],
    /// Pixels across and down.
    pub(crate) size: [f64; 2],
    /// All that happened.
    pub(crate) steps: &'a [PacketStep],
    /// Where rays hit.
    pub(crate) hit_points: &'a [[f64; 3]],
    /// The headline.
    pub(crate) title: &'a str,
}

const HEADER: f64 = 40.0;

/// How far around the frusta cells are drawn, in parts of the frusta's extent.
const ROOM: f64 = 0.08;

/// What a line belongs to; later ones are drawn over earlier ones.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Part {
    Root,
    /// A leaf in which no ray was tested.
    Passed,
    /// A leaf in which rays were tested.
    Tested,
    Frustum,
}

/// Draws the sub-frusta and the boxes of the leaves that they met. What the scene hides is dotted.
pub(crate) fn draw_frustum_view(it: &FrustumView<'_>) -> Canvas {
    let [width, height] = it.size;
    let fates = Fates::new(it.scene, it.steps, it.hit_points);
    let legend = vec![legend()];
    let below = legend::height(&legend, width - 24.0);
    let mut canvas = Canvas::new(width, HEADER + height + 8.0 + below + 8.0, it.title);
    canvas.text([12.0, 26.0], Anchor::Start, 15.0, it.title);
    let over = OverRender { scene: it.scene, camera: it.camera, render: it.render, size: it.size };
    over.draw(&mut canvas, HEADER, &edges(it.scene, &fates), |part, seen, ends| {
        let stroke = part.stroke();
        lines(ends, if seen { stroke } else { stroke.dashed("2 4").faint(0.55) })
    });
    legend::draw(&mut canvas, [12.0, HEADER + height + 8.0], width - 24.0, &legend);
    canvas
}

impl Part {
    fn stroke(self) -> Stroke<'static> {
        match self {
            Self::Root => Stroke::new(palette::GREY, 1.4),
            Self::Passed => Stroke::new(palette::BLUE, 1.2),
            Self::Tested => Stroke::new(palette::ORANGE, 2.0),
            Self::Frustum => Stroke::new(palette::BLACK, 1.0),
        }
    }
}

fn edges(scene: &ShapeScene, fates: &Fates) -> Vec<Edge<Part>> {
    let edge = |kind| move |ends| Edge { ends, kind };
    let around = surroundings(fates);
    let boxes = |cells: &[Cell<3>]| {
        let shown = cells.iter().map(|cell| cell.bounds.intersection(&around));
        shown.filter(|part| !part.is_empty()).flat_map(|part| box_edges(&part, None)).collect()
    };
    let [passed, tested]: [Vec<_>; 2] = [&fates.passed, &fates.tested].map(|cells| boxes(cells));
    let root = box_edges(scene.tree().bounds(), None).into_iter();
    let frusta = fates.frusta.iter().flat_map(|frustum| frustum_edges(frustum, fates.end));
    root.map(edge(Part::Root))
        .chain(passed.into_iter().map(edge(Part::Passed)))
        .chain(tested.into_iter().map(edge(Part::Tested)))
        .chain(frusta.map(edge(Part::Frustum)))
        .collect()
}

/// A box around the frusta, with some room: cells that are much larger are cut off there.
fn surroundings(fates: &Fates) -> Aabb<3> {
    let edges = fates.frusta.iter().flat_map(|frustum| frustum_edges(frustum, fates.end));
    let around = Aabb::of_points(edges.flatten().map(|p| p.as_vec3().into()));
    let room = (ROOM * around.diagonal()) as f32;
    Aabb { min: around.min.map(|x| x - room), max: around.max.map(|x| x + room) }
}

fn legend() -> Vec<Entry> {
    vec![
        Entry::line(palette::ORANGE, 2.0, "leaf: rays tested"),
        Entry::line(palette::BLUE, 1.2, "leaf: the bound decided alone"),
        Entry::line(palette::BLACK, 1.0, "sub-frustum"),
        Entry::line(palette::GREY, 1.4, "box of the root"),
        Entry::dashed(palette::GREY, "2 4", "behind a surface"),
    ]
}
