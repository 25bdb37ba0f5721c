//! The cells of the tree as lines over a picture of the scene.

use super::canvas::{Anchor, Canvas, Stroke, lines, window};
use super::legend::{self, Entry};
use super::palette;
use super::projector::Projector;
use base64::{Engine, prelude::BASE64_STANDARD};
use glam::DVec3;
use kdray::{Aabb, Ray, ShapeScene, tree::NodeKind};
use kdray_scene::Camera;
use rayon::prelude::*;
use std::{borrow::Cow, collections::BTreeMap};
use svg::node::element::{Group, Image};

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

/// A straight line of a cell.
struct Edge {
    ends: [DVec3; 2],
    /// The plane's axis and depth; `None` for the root's box.
    plane: Option<(usize, u32)>,
}

/// A piece of an edge in the picture, and whether it is seen.
type Piece = ([[f64; 2]; 2], bool);

/// The length of the pieces in which edges are hidden or not, in pixels.
const PIECE: f64 = 4.0;
const HEADER: f64 = 40.0;

/// Draws the planes of the tree's upper levels over the render. What the scene hides is dotted
/// and faint: rays from the camera tell.
pub(crate) fn draw_wireframe(it: &Wireframe<'_>) -> Canvas {
    let [width, height] = it.size;
    let edges = edges(it.scene, it.depth);
    let legend = legend(it, &edges);
    let legend_height = legend::height(&legend, width - 24.0);
    let mut canvas = Canvas::new(width, HEADER + height + 8.0 + legend_height + 8.0, it.title);
    canvas.text([12.0, 26.0], Anchor::Start, 15.0, it.title);
    let href = format!("data:image/png;base64,{}", BASE64_STANDARD.encode(it.render));
    let image = Image::new().set("x", 0).set("y", HEADER).set("width", width);
    let image = image.set("height", height).set("href", href);
    let mut content = Group::new().add(image);
    for (kind, pieces) in visible_pieces(it, &edges) {
        content = content.add(lines(pieces, kind.stroke(&color(it, kind.plane))));
    }
    canvas.add(window([0.0, HEADER], it.size, content));
    legend::draw(&mut canvas, [12.0, HEADER + height + 8.0], width - 24.0, &legend);
    canvas
}

/// Lines that look the same; in the order in which they are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Kind {
    seen: bool,
    /// The root last, then the upper levels over the lower ones.
    height: u32,
    plane: Option<(usize, u32)>,
}

impl Kind {
    fn new(seen: bool, plane: Option<(usize, u32)>) -> Self {
        Self { seen, height: plane.map_or(u32::MAX, |(_, depth)| 1000 - depth), plane }
    }

    fn stroke(self, color: &str) -> Stroke<'_> {
        let width = self.plane.map_or(2.4, |(_, depth)| (2.4 - 0.2 * f64::from(depth)).max(0.9));
        let stroke = Stroke::new(color, width);
        if self.seen { stroke } else { stroke.dashed("2 4").faint(0.55) }
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
fn edges(scene: &ShapeScene, max_depth: u32) -> Vec<Edge> {
    let tree = scene.tree();
    let mut edges = box_edges(tree.bounds(), None);
    for cell in tree.cells().filter(|cell| cell.depth < max_depth) {
        if let NodeKind::Inner { axis, split, .. } = tree.nodes()[cell.node as usize].kind() {
            let mut plane = cell.bounds;
            (plane.min[axis], plane.max[axis]) = (split, split);
            edges.extend(box_edges(&plane, Some((axis, cell.depth))));
        }
    }
    edges
}

/// The edges of a box; of a flat one each once.
fn box_edges(aabb: &Aabb<3>, plane: Option<(usize, u32)>) -> Vec<Edge> {
    let corner = |upper: [bool; 3]| {
        DVec3::from([0, 1, 2].map(|k| f64::from(if upper[k] { aabb.max[k] } else { aabb.min[k] })))
    };
    let mut edges = Vec::new();
    for along in 0..3 {
        let (j, k) = ((along + 1) % 3, (along + 2) % 3);
        for bits in 0..4 {
            let (at_j, at_k) = (bits & 1 != 0, bits & 2 != 0);
            let doubled = plane.is_some_and(|(axis, _)| axis == j && at_j || axis == k && at_k);
            if doubled || plane.is_some_and(|(axis, _)| axis == along) {
                continue;
            }
            let mut upper = [false; 3];
            (upper[j], upper[k]) = (at_j, at_k);
            let from = corner(upper);
            upper[along] = true;
            edges.push(Edge { ends: [from, corner(upper)], plane });
        }
    }
    edges
}

/// The pieces of all edges in the picture, sorted by how they are drawn.
fn visible_pieces(it: &Wireframe<'_>, edges: &[Edge]) -> BTreeMap<Kind, Vec<[[f64; 2]; 2]>> {
    let projector = Projector::new(it.camera, it.size);
    let found: Vec<Vec<Piece>> =
        edges.par_iter().map(|edge| pieces(it, &projector, edge.ends)).collect();
    let mut kinds: BTreeMap<Kind, Vec<_>> = BTreeMap::new();
    for (edge, pieces) in edges.iter().zip(found) {
        for ([[x0, y0], [x1, y1]], seen) in pieces {
            let ends = [[x0, y0 + HEADER], [x1, y1 + HEADER]];
            kinds.entry(Kind::new(seen, edge.plane)).or_default().push(ends);
        }
    }
    kinds
}

/// Cuts an edge where it passes behind the scene.
fn pieces(it: &Wireframe<'_>, projector: &Projector, ends: [DVec3; 2]) -> Vec<Piece> {
    let diagonal = it.scene.tree().bounds().diagonal();
    let Some(clipped) = projector.clip(ends, 1e-3 * diagonal) else { return Vec::new() };
    let sheet = clipped.map(|p| projector.place(p));
    let Some(range) = within(sheet, it.size) else { return Vec::new() };
    // Equal steps in the picture; perspective turns them into steps on the edge.
    let length = (sheet[1][0] - sheet[0][0]).hypot(sheet[1][1] - sheet[0][1]);
    let count = ((range[1] - range[0]) * length / PIECE).ceil().max(1.0);
    let on_sheet = |share: f64| [0, 1].map(|k| sheet[0][k] + share * (sheet[1][k] - sheet[0][k]));
    let share_at = |i: f64| range[0] + (range[1] - range[0]) * i / count;
    let mut pieces: Vec<Piece> = Vec::new();
    for i in 0..count as usize {
        let [from, to] = [share_at(i as f64), share_at(i as f64 + 1.0)];
        let middle = projector.unproject(clipped, 0.5 * (from + to));
        let seen = is_seen(it, projector, middle, diagonal);
        match pieces.last_mut() {
            Some(([_, end], same)) if *same == seen => *end = on_sheet(to),
            _ => pieces.push(([on_sheet(from), on_sheet(to)], seen)),
        }
    }
    pieces
}

/// The part of a line, from 0 to 1, that lies in the picture.
fn within([a, b]: [[f64; 2]; 2], size: [f64; 2]) -> Option<[f64; 2]> {
    let mut range = [0.0_f64, 1.0_f64];
    for k in 0..2 {
        let step = b[k] - a[k];
        if step == 0.0 {
            if a[k] < 0.0 || a[k] > size[k] {
                return None;
            }
            continue;
        }
        let (l, h) = (-a[k] / step, (size[k] - a[k]) / step);
        range = [range[0].max(l.min(h)), range[1].min(l.max(h))];
    }
    (range[0] < range[1]).then_some(range)
}

/// Whether nothing stands before `p`. A line on a surface counts as seen.
fn is_seen(it: &Wireframe<'_>, projector: &Projector, p: DVec3, diagonal: f64) -> bool {
    let from = projector.viewpoint(p, 4.0 * diagonal);
    let almost = 1.0 - 2e-3 * (diagonal / (p - from).length()).min(100.0);
    !it.scene.any_hit(&Ray::through(from, p).with_interval(0.0, almost))
}

fn legend(it: &Wireframe<'_>, edges: &[Edge]) -> Vec<Vec<Entry>> {
    let mut planes: Vec<(usize, u32)> = edges.iter().filter_map(|edge| edge.plane).collect();
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
