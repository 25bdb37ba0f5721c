//! The cells of the tree as lines over a picture of the scene.

use super::canvas::{Anchor, Canvas, Stroke, lines};
use super::legend::{self, Entry};
use super::over_render::{Edge, OverRender, box_edges};
use super::palette;
use kdray::{Aabb, ShapeScene, tree::NodeKind};
use kdray_scene::Camera;
use std::borrow::Cow;

/// What the picture shows.
pub(crate) struct Wireframe<'a> {
    /// Triangles and tree.
    pub(crate) scene: &'a ShapeScene,
    /// From where.
    pub(crate) camera: &'a Camera,
    /// The scene as the camera sees it, as a PNG of `size` pixels.
    pub(crate) render: &'a [u8],
    /// Pixels across and down.
    pub(crate) size: [f64; 2],
    /// Planes with fewer than this many splits above are drawn.
    pub(crate) depth: u32,
    /// What the colours of lines say.
    pub(crate) color: LineColor,
    /// The headline.
    pub(crate) title: &'a str,
}

/// What the colours of lines say.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum LineColor {
    /// The axis that the plane is perpendicular to
    Axis,
    /// How many splits lie above it
    Depth,
}

const HEADER: f64 = 40.0;
const GAP: f64 = 8.0;

/// How many pixels the picture is higher than the render, besides the legend.
pub(crate) const AROUND: f64 = HEADER + 2.0 * GAP;

/// Draws the planes of the tree's upper levels over the render. What the scene hides is dotted
/// and faint: rays from the camera tell.
pub(crate) fn draw_wireframe(it: &Wireframe<'_>) -> Canvas {
    let [width, height] = it.size;
    let edges = edges(it.scene, it.depth);
    let legend = legend(it, &edges);
    let legend_height = legend::height(&legend, width - 24.0);
    let mut canvas = Canvas::new(width, AROUND + height + legend_height, it.title);
    canvas.text([12.0, 26.0], Anchor::Start, 15.0, it.title);
    let over = OverRender { scene: it.scene, camera: it.camera, render: it.render, size: it.size };
    over.draw(&mut canvas, HEADER, &edges, |kind, seen, ends| {
        lines(ends, kind.stroke(seen, &color(it, kind.plane)))
    });
    legend::draw(&mut canvas, [12.0, HEADER + height + GAP], width - 24.0, &legend);
    canvas
}

/// Lines that look the same; in the order in which they are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Kind {
    /// The root last, then the upper levels over the lower ones.
    height: u32,
    /// The plane's axis and depth; `None` for the root's box.
    plane: Option<(usize, u32)>,
}

impl Kind {
    fn new(plane: Option<(usize, u32)>) -> Self {
        Self { height: plane.map_or(u32::MAX, |(_, depth)| 1000 - depth), plane }
    }

    fn stroke(self, seen: bool, color: &str) -> Stroke<'_> {
        let width = self.plane.map_or(2.4, |(_, depth)| (2.4 - 0.2 * f64::from(depth)).max(0.9));
        let stroke = Stroke::new(color, width);
        if seen { stroke } else { stroke.dashed("2 4").faint(0.55) }
    }
}

fn color(it: &Wireframe<'_>, plane: Option<(usize, u32)>) -> Cow<'static, str> {
    match (plane, it.color) {
        (None, _) => palette::BLACK.into(),
        (Some((axis, _)), LineColor::Axis) => palette::AXES[axis].into(),
        (Some((_, depth)), LineColor::Depth) => {
            palette::depth_color(depth, it.depth.max(2) - 1).into()
        }
    }
}

/// The twelve edges of the root's box, and the outlines of the planes above `max_depth`.
fn edges(scene: &ShapeScene, max_depth: u32) -> Vec<Edge<Kind>> {
    let tree = scene.tree();
    let mut edges = outline(tree.bounds(), None);
    for cell in tree.cells().filter(|cell| cell.depth < max_depth) {
        if let NodeKind::Inner { axis, split, .. } = tree.nodes()[cell.node as usize].kind() {
            let mut plane = cell.bounds;
            (plane.min[axis], plane.max[axis]) = (split, split);
            edges.extend(outline(&plane, Some((axis, cell.depth))));
        }
    }
    edges
}

fn outline(aabb: &Aabb<3>, plane: Option<(usize, u32)>) -> Vec<Edge<Kind>> {
    let ends = box_edges(aabb, plane.map(|(axis, _)| axis)).into_iter();
    ends.map(|ends| Edge { ends, kind: Kind::new(plane) }).collect()
}

fn legend(it: &Wireframe<'_>, edges: &[Edge<Kind>]) -> Vec<Vec<Entry>> {
    let mut planes: Vec<(usize, u32)> = edges.iter().filter_map(|edge| edge.kind.plane).collect();
    match it.color {
        LineColor::Axis => {
            planes.sort_unstable_by_key(|(axis, _)| *axis);
            planes.dedup_by_key(|(axis, _)| *axis);
        }
        LineColor::Depth => {
            planes.sort_unstable_by_key(|(_, depth)| *depth);
            planes.dedup_by_key(|(_, depth)| *depth);
        }
    }
    let mut entries = vec![Entry::line(palette::BLACK, 2.4, "box of the root")];
    for (axis, depth) in planes {
        let text = match it.color {
            LineColor::Axis => format!("split perpendicular to {}", palette::AXIS_NAMES[axis]),
            LineColor::Depth => format!("depth {depth}"),
        };
        entries.push(Entry::line(color(it, Some((axis, depth))), 2.4, text));
    }
    entries.push(Entry::dashed(palette::GREY, "2 4", "behind a surface"));
    vec![entries]
}
