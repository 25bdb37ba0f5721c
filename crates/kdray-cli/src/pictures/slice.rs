//! A slice through the tree: leaves, splitting planes and triangles cut by one plane (S5 to S10).

use super::canvas::{Anchor, Canvas, Point, Stroke, lines};
use super::legend::{self, Entry};
use super::panel::{Panel, Rect};
use super::section::SplitLine;
use super::{Section, palette};
use kdray::{ShapeScene, primitives::Primitives};
use std::collections::BTreeMap;
use svg::node::element::Group;

/// What a slice shows.
pub(crate) struct Slice<'a> {
    /// The plane.
    pub(crate) section: Section,
    /// How many splits deep cells are shown.
    pub(crate) depth: u32,
    /// The only part that is shown, if not all: `[low, high]` across and up.
    pub(crate) window: Option<[[f64; 2]; 2]>,
    /// The headline.
    pub(crate) title: &'a str,
}

/// How many cells and triangles a slice shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct SliceFigures {
    /// Cells cut by the plane, as far as they are shown.
    pub(crate) cells: usize,
    /// Triangles cut by the plane, likewise.
    pub(crate) triangles: usize,
}

const MARGIN: [f64; 2] = [96.0, 24.0];
const TOP: f64 = 48.0;

/// Draws the slice with everything in `room` pixels, but for scale and legend; `None` if the
/// plane, or the window in it, does not meet the tree's box.
pub(crate) fn draw_slice(
    scene: &ShapeScene,
    slice: &Slice<'_>,
    room: [f64; 2],
) -> Option<(Canvas, SliceFigures)> {
    let section = &slice.section;
    let root = section.rect(scene.tree().bounds())?;
    if let Some([across, up]) = slice.window
        && !root.meets(&Rect { across, up })
    {
        return None;
    }
    let margin = 0.02 * root.size()[0].max(root.size()[1]);
    let window = slice.window.map(|[across, up]| Rect { across, up });
    let panel = Panel::fit([MARGIN[0], TOP], room, window.unwrap_or(root.grown(margin)));
    let mut tree = section.of_tree(scene.tree(), slice.depth);
    tree.cells.retain(|cell| cell.rect.meets(&panel.shown()));
    tree.splits.retain(|split| Rect::around(&split.ends).meets(&panel.shown()));
    let mut triangles = cut_triangles(scene, section);
    triangles.retain(|ends| Rect::around(ends).meets(&panel.shown()));

    let width = (MARGIN[0] + panel.size[0] + MARGIN[1]).max(640.0);
    let legend = legend(section);
    let legend_top = TOP + panel.size[1] + 52.0;
    let legend_height = legend::height(&legend, width - 48.0);
    let mut canvas = Canvas::new(width, legend_top + legend_height + 12.0, slice.title);
    canvas.text([24.0, 30.0], Anchor::Start, 16.0, slice.title);

    let mut cells = Group::new().set("shape-rendering", "crispEdges");
    for cell in &tree.cells {
        let rectangle = panel.rectangle(&cell.rect, 0.0);
        let shade = palette::leaf_shade(cell.primitives);
        cells = cells.add(rectangle.set("class", "cell").set("fill", shade));
    }
    let mut content = Group::new().add(cells);
    for path in split_lines(&panel, &tree.splits) {
        content = content.add(path);
    }
    let cuts = triangles.iter().filter_map(|ends| panel.line(ends));
    let outline = Stroke::new(palette::BLACK, 1.2);
    panel.show(&mut canvas, content.add(lines(cuts, outline)).add(frame(&panel, &root)));
    panel.scales(&mut canvas, &across_name(section), palette::AXIS_NAMES[section.up()]);
    legend::draw(&mut canvas, [24.0, legend_top], width - 48.0, &legend);
    Some((canvas, SliceFigures { cells: tree.cells.len(), triangles: triangles.len() }))
}

/// The lines in which the section cuts the triangles.
pub(super) fn cut_triangles(scene: &ShapeScene, section: &Section) -> Vec<[[f64; 2]; 2]> {
    let mesh = scene.primitives();
    (0..mesh.count() as u32).filter_map(|id| section.triangle(&mesh.corners(id))).collect()
}

/// The splitting planes, coloured by axis; the upper levels of the tree stand out.
fn split_lines(panel: &Panel, splits: &[SplitLine]) -> Vec<svg::node::element::Element> {
    let mut kinds: BTreeMap<(u32, usize), Vec<[Point; 2]>> = BTreeMap::new();
    for split in splits {
        kinds.entry((split.depth.min(8), split.axis)).or_default().extend(panel.line(&split.ends));
    }
    let stroke = |(depth, axis): (u32, usize)| {
        Stroke::new(palette::AXES[axis], 2.6 - 0.24 * f64::from(depth))
    };
    kinds.into_iter().rev().map(|(kind, ends)| lines(ends, stroke(kind))).collect()
}

/// The root's box.
pub(super) fn frame(panel: &Panel, root: &Rect) -> svg::node::element::Rectangle {
    let frame = panel.rectangle(root, 1.0).set("fill", "none");
    frame.set("stroke", palette::BLACK).set("stroke-width", 2.0)
}

/// What the direction across measures.
pub(super) fn across_name(section: &Section) -> String {
    match section.across_axis() {
        Some(axis) => palette::AXIS_NAMES[axis].to_owned(),
        None => "way across, from the ray's origin".to_owned(),
    }
}

fn legend(section: &Section) -> Vec<Vec<Entry>> {
    let axes = [section.across_axis(), Some(section.up())].into_iter().flatten();
    let mut marks: Vec<Entry> = axes
        .map(|axis| {
            let text = format!("split perpendicular to {}", palette::AXIS_NAMES[axis]);
            Entry::line(palette::AXES[axis], 2.4, text)
        })
        .collect();
    marks.push(Entry::line(palette::BLACK, 2.4, "box of the root"));
    marks.push(Entry::line(palette::BLACK, 1.2, "triangle, cut by the slice"));
    let shades = palette::leaf_shades().map(|(color, label)| Entry::area(color, label));
    let heading = Entry::words("triangles in the leaf:");
    vec![marks, std::iter::once(heading).chain(shades).collect()]
}
