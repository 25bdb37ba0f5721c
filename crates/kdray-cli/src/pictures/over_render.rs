//! Straight lines over a render of the scene: what surfaces hide of them is told by rays.

use super::canvas::{Canvas, window};
use super::panel::Rect;
use super::projector::Projector;
use base64::{Engine, prelude::BASE64_STANDARD};
use glam::DVec3;
use kdray::{Aabb, Ray, ShapeScene};
use kdray_scene::Camera;
use rayon::prelude::*;
use std::collections::BTreeMap;
use svg::node::element::{Element, Group, Image};

/// A render, and what is needed to draw in it.
pub(super) struct OverRender<'a> {
    /// Triangles and tree.
    pub(super) scene: &'a ShapeScene,
    /// From where.
    pub(super) camera: &'a Camera,
    /// The scene as the camera sees it, as a PNG of `size` pixels.
    pub(super) render: &'a [u8],
    /// Pixels across and down.
    pub(super) size: [f64; 2],
}

/// A straight line; all of a kind look the same.
pub(super) struct Edge<K> {
    pub(super) ends: [DVec3; 2],
    pub(super) kind: K,
}

/// A piece of an edge in the picture, and whether it is seen.
type Piece = ([[f64; 2]; 2], bool);

/// The length of the pieces in which edges are hidden or not, in pixels.
const PIECE: f64 = 4.0;

impl OverRender<'_> {
    /// Draws the render so far below the upper edge, and over it the lines as `paint` makes them of a
    /// kind, of whether they are seen, and of their ends: hidden ones first, then kind by kind.
    pub(super) fn draw<K: Copy + Ord + Sync>(
        &self,
        canvas: &mut Canvas,
        top: f64,
        edges: &[Edge<K>],
        paint: impl Fn(K, bool, Vec<[[f64; 2]; 2]>) -> Element,
    ) {
        let [width, height] = self.size;
        let href = format!("data:image/png;base64,{}", BASE64_STANDARD.encode(self.render));
        let image = Image::new().set("x", 0).set("y", top).set("width", width);
        let image = image.set("height", height).set("href", href);
        let mut content = Group::new().add(image);
        for ((seen, kind), pieces) in self.visible_pieces(edges, top) {
            content = content.add(paint(kind, seen, pieces));
        }
        canvas.add(window([0.0, top], self.size, content));
    }

    /// The pieces of all edges in the picture, sorted by how they are drawn.
    fn visible_pieces<K: Copy + Ord + Sync>(
        &self,
        edges: &[Edge<K>],
        top: f64,
    ) -> BTreeMap<(bool, K), Vec<[[f64; 2]; 2]>> {
        let projector = Projector::new(self.camera, self.size);
        let found: Vec<Vec<Piece>> =
            edges.par_iter().map(|edge| self.pieces(&projector, edge.ends)).collect();
        let mut kinds: BTreeMap<(bool, K), Vec<_>> = BTreeMap::new();
        for (edge, pieces) in edges.iter().zip(found) {
            for ([[x0, y0], [x1, y1]], seen) in pieces {
                let ends = [[x0, y0 + top], [x1, y1 + top]];
                kinds.entry((seen, edge.kind)).or_default().push(ends);
            }
        }
        kinds
    }

    /// Cuts an edge where it passes behind the scene.
    fn pieces(&self, projector: &Projector, ends: [DVec3; 2]) -> Vec<Piece> {
        let diagonal = self.scene.tree().bounds().diagonal();
        let Some(clipped) = projector.clip(ends, 1e-3 * diagonal) else { return Vec::new() };
        let sheet = clipped.map(|p| projector.place(p));
        let picture = Rect { across: [0.0, self.size[0]], up: [0.0, self.size[1]] };
        let Some(range) = picture.part_of(&sheet) else { return Vec::new() };
        // Equal steps in the picture; perspective turns them into steps on the edge.
        let length = (sheet[1][0] - sheet[0][0]).hypot(sheet[1][1] - sheet[0][1]);
        let count = ((range[1] - range[0]) * length / PIECE).ceil().max(1.0);
        let on_sheet =
            |share: f64| [0, 1].map(|k| sheet[0][k] + share * (sheet[1][k] - sheet[0][k]));
        let share_at = |i: f64| range[0] + (range[1] - range[0]) * i / count;
        let mut pieces: Vec<Piece> = Vec::new();
        for i in 0..count as usize {
            let [from, to] = [share_at(i as f64), share_at(i as f64 + 1.0)];
            let middle = projector.unproject(clipped, 0.5 * (from + to));
            let seen = self.is_seen(projector, middle, diagonal);
            match pieces.last_mut() {
                Some(([_, end], same)) if *same == seen => *end = on_sheet(to),
                _ => pieces.push(([on_sheet(from), on_sheet(to)], seen)),
            }
        }
        pieces
    }

    /// Whether nothing stands before `p`. A line on a surface counts as seen.
    fn is_seen(&self, projector: &Projector, p: DVec3, diagonal: f64) -> bool {
        let from = projector.viewpoint(p, 4.0 * diagonal);
        let almost = 1.0 - 2e-3 * (diagonal / (p - from).length()).min(100.0);
        !self.scene.any_hit(&Ray::through(from, p).with_interval(0.0, almost))
    }
}

/// The edges of a box; of one that is flat on an axis each once.
pub(super) fn box_edges(aabb: &Aabb<3>, flat: Option<usize>) -> Vec<[DVec3; 2]> {
    let corner = |upper: [bool; 3]| {
        DVec3::from([0, 1, 2].map(|k| f64::from(if upper[k] { aabb.max[k] } else { aabb.min[k] })))
    };
    let mut edges = Vec::new();
    for along in (0..3).filter(|&along| flat != Some(along)) {
        let (j, k) = ((along + 1) % 3, (along + 2) % 3);
        for bits in 0..4 {
            let (at_j, at_k) = (bits & 1 != 0, bits & 2 != 0);
            if at_j && flat == Some(j) || at_k && flat == Some(k) {
                continue;
            }
            let mut upper = [false; 3];
            (upper[j], upper[k]) = (at_j, at_k);
            let from = corner(upper);
            upper[along] = true;
            edges.push([from, corner(upper)]);
        }
    }
    edges
}
