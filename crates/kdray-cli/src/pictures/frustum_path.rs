//! The way of a packet's frustum through the tree (S12), in a section that holds one of its rays.

mod fates;
mod outline;

use super::canvas::{Anchor, Canvas, Stroke, lines};
use super::legend::{self, Entry};
use super::panel::{Panel, Rect};
use super::ray_path::{overview_rect, split_ends, surroundings};
use super::slice::{across_name, cut_triangles, frame};
use super::{Section, palette};
use kdray::traverse::{Frustum, PacketStep};
use kdray::{Ray, ShapeScene, tree::Cell};
use svg::node::element::{Group, Polygon};

pub(super) use fates::Fates;
pub(super) use outline::frustum_edges;

/// What the picture shows.
pub(crate) struct FrustumPath<'a> {
    /// Triangles and tree.
    pub(crate) scene: &'a ShapeScene,
    /// The ray of the packet that the section holds.
    pub(crate) ray: &'a Ray,
    /// All that happened.
    pub(crate) steps: &'a [PacketStep],
    /// Where rays hit.
    pub(crate) hit_points: &'a [[f64; 3]],
    /// The headline.
    pub(crate) title: &'a str,
    /// What came of it.
    pub(crate) summary: &'a str,
}

const WIDTH: f64 = 1120.0;
const TOP: f64 = 84.0;
const LEFT: f64 = 96.0;
/// The room for a panel that has another beside it, and for one that has not.
const ROOM: [[f64; 2]; 2] = [[430.0, 430.0], [990.0, 430.0]];

/// Draws the way of the frustum; `None` if the packet, or the section, misses the root's box.
pub(crate) fn draw_frustum_path(it: &FrustumPath<'_>) -> Option<Canvas> {
    let fates = Fates::new(it.scene, it.steps, it.hit_points);
    let section = Section::through(it.ray);
    let root = section.rect(it.scene.tree().bounds())?;
    let panels = panels(it, &section, &fates, root)?;
    let highest = panels.iter().map(|(_, panel)| panel.size[1]).fold(0.0, f64::max);
    let legend = legend(&section, &fates);
    let legend_top = TOP + highest + 52.0;
    let height = legend_top + legend::height(&legend, WIDTH - 48.0) + 12.0;
    let mut canvas = Canvas::new(WIDTH, height, it.title);
    canvas.text([24.0, 30.0], Anchor::Start, 16.0, it.title);
    canvas.text([24.0, 52.0], Anchor::Start, 13.0, it.summary);
    for (heading, panel) in panels {
        canvas.text([panel.at[0], panel.at[1] - 8.0], Anchor::Start, 13.0, heading);
        panel.show(&mut canvas, content(it, &section, &fates, &panel, &root));
        panel.scales(&mut canvas, &across_name(&section), palette::AXIS_NAMES[section.up()]);
    }
    legend::draw(&mut canvas, [24.0, legend_top], WIDTH - 48.0, &legend);
    Some(canvas)
}

/// The frustum in the tree, and what is around the hits if these are close together.
fn panels(
    it: &FrustumPath<'_>,
    section: &Section,
    fates: &Fates,
    root: Rect,
) -> Option<Vec<(&'static str, Panel)>> {
    let axis = fates.frusta.first()?.axis();
    let t = [0.0, fates.end / it.ray.direction[axis].abs()];
    let panel =
        |column: f64, room, shown| Panel::fit([LEFT + column * WIDTH / 2.0, TOP], room, shown);
    let whole = overview_rect(section, it.ray, t, root);
    let heading = "the frustum in the tree";
    let points = it.hit_points.iter().map(|&p| section.place(p));
    let hits = points.map(|p| Rect::around(&[p, p])).reduce(|a, b| a.union(&b));
    let near = hits.map(|hits| surroundings(&hits));
    let is_small = |near: &Rect| near.size()[0] < 0.7 * whole.size()[0].max(whole.size()[1]);
    let Some(near) = near.filter(is_small) else {
        return Some(vec![(heading, panel(0.0, ROOM[1], whole))]);
    };
    let panels =
        vec![(heading, panel(0.0, ROOM[0], whole)), ("where rays hit", panel(1.0, ROOM[0], near))];
    Some(panels)
}

fn content(
    it: &FrustumPath<'_>,
    section: &Section,
    fates: &Fates,
    panel: &Panel,
    root: &Rect,
) -> Group {
    let mut group = Group::new().set("shape-rendering", "geometricPrecision");
    for (cells, class, fill) in kinds(fates) {
        for rect in cells.iter().filter_map(|cell| section.rect(&cell.bounds)) {
            group = group.add(panel.rectangle(&rect, 1.0).set("class", class).set("fill", fill));
        }
    }
    for &(cell, axis, split) in &fates.splits {
        if let Some(ends) = split_ends(section, &cell, axis, split) {
            let width = (2.2 - 0.15 * f64::from(cell.depth)).max(0.7);
            let stroke = Stroke::new(palette::AXES[axis], width);
            group = group.add(lines(panel.line(&ends), stroke));
        }
    }
    let near = |ends: &&[[f64; 2]; 2]| Rect::around(ends).meets(&panel.shown());
    let triangles = cut_triangles(it.scene, section);
    let context = triangles.iter().filter(near).filter_map(|ends| panel.line(ends));
    group = group.add(lines(context, Stroke::new(palette::GREY, 0.9)));
    let mesh = it.scene.primitives();
    let tested = fates.triangles.iter().filter_map(|&id| section.triangle(&mesh.corners(id)));
    let tested = tested.filter_map(|ends| panel.line(&ends));
    group = group.add(lines(tested, Stroke::new(palette::BLACK, 2.0)));
    group = group.add(frame(panel, root));
    fates
        .frusta
        .iter()
        .filter_map(|frustum| polygon(section, panel, frustum, fates.end))
        .fold(group, Group::add)
}

/// The kinds of cells, later ones over earlier ones.
fn kinds(fates: &Fates) -> [(&[Cell<3>], &'static str, &'static str); 4] {
    [
        (&fates.left_out, "left-out", palette::LEFT_OUT),
        (&fates.dropped, "dropped", palette::PALE),
        (&fates.passed, "passed", palette::PASSED),
        (&fates.tested, "tested", palette::VISITED),
    ]
}

/// A sub-frustum as the section cuts it.
fn polygon(section: &Section, panel: &Panel, frustum: &Frustum, end: f64) -> Option<Polygon> {
    let corners = outline::cut(section, frustum, end);
    let points = panel.polygon(&corners).into_iter();
    let points: Vec<String> =
        points.map(|point| point.map(|x| format!("{x:.2}")).join(",")).collect();
    (points.len() > 2).then(|| {
        let polygon = Polygon::new().set("points", points.join(" ")).set("class", "frustum");
        let polygon = polygon.set("fill", palette::BLACK).set("fill-opacity", 0.06);
        polygon.set("stroke", palette::BLACK).set("stroke-width", 0.8)
    })
}

fn legend(section: &Section, fates: &Fates) -> Vec<Vec<Entry>> {
    let mut cells = vec![
        Entry::area(palette::VISITED, "leaf: rays tested"),
        Entry::area(palette::PASSED, "leaf: nothing to test, the bound decided alone"),
        Entry::area(palette::LEFT_OUT, "left out by the bound in one decision"),
    ];
    if !fates.dropped.is_empty() {
        cells.push(Entry::area(palette::PALE, "behind the hits of all rays"));
    }
    let splits = (0..3).map(|axis| {
        let text = format!("split perpendicular to {}", palette::AXIS_NAMES[axis]);
        Entry::line(palette::AXES[axis], 2.0, text)
    });
    let mut marks: Vec<Entry> = splits.collect();
    marks.push(Entry::line(palette::BLACK, 2.0, "triangle tested"));
    marks.push(Entry::line(palette::GREY, 0.9, "other triangle"));
    marks.push(Entry::line(palette::BLACK, 0.8, "sub-frustum"));
    let note = format!(
        "The plane holds one ray of the packet and the {} axis: every cell is a rectangle in it.",
        palette::AXIS_NAMES[section.up()]
    );
    vec![cells, marks, vec![Entry::words(note)]]
}
