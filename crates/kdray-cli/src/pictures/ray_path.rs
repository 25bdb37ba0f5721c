//! The way of one ray through the tree (S11): the section that holds the ray, and the nodes over t.

mod marks;
mod path;
mod views;

use super::canvas::{Anchor, Canvas, Stroke, lines};
use super::legend::{self, Entry};
use super::panel::{Panel, Rect};
use super::slice::{across_name, cut_triangles, frame};
use super::{Section, palette, t_diagram};
use kdray::{Hit, Ray, ShapeScene, traverse::Step, tree::Cell};
use marks::marks_along_ray;
use path::Path;
use svg::node::element::Group;
use views::{View, views};

pub(super) use views::{overview_rect, surroundings};

/// What the picture shows.
pub(crate) struct RayPath<'a> {
    /// Triangles and tree.
    pub(crate) scene: &'a ShapeScene,
    /// The ray.
    pub(crate) ray: &'a Ray,
    /// All that happened.
    pub(crate) steps: &'a [Step],
    /// What came of it.
    pub(crate) hit: Option<Hit>,
    /// The headline.
    pub(crate) title: &'a str,
}

const WIDTH: f64 = 1120.0;
const TOP: f64 = 84.0;
/// Draws the way of the ray; `None` if it misses the root's box.
pub(crate) fn draw_ray_path(it: &RayPath<'_>) -> Option<Canvas> {
    let section = Section::through(it.ray);
    let path = Path::new(it.scene, it.steps);
    let root = section.rect(it.scene.tree().bounds())?;
    let views = views(it, &section, &path, root)?;
    let bars = path.bars();
    let deepest = bars.iter().map(|bar| bar.depth).max().unwrap_or(0);
    let highest = views.iter().map(|view| view.panel.size[1]).fold(0.0, f64::max);
    let diagram_top = TOP + highest + 64.0;
    let legend = legend(&section, &path, it.hit);
    let legend_top = diagram_top + t_diagram::height(deepest);
    let height = legend_top + legend::height(&legend, WIDTH - 48.0) + 12.0;

    let mut canvas = Canvas::new(WIDTH, height, it.title);
    canvas.text([24.0, 30.0], Anchor::Start, 16.0, it.title);
    canvas.text([24.0, 52.0], Anchor::Start, 13.0, &path.summary(it.hit));
    let triangles = cut_triangles(it.scene, &section);
    let hit = it.hit.map(|hit| hit.t);
    let room = WIDTH / views.len() as f64;
    for (column, View { heading, panel, t }) in views.iter().enumerate() {
        canvas.text([panel.at[0], panel.at[1] - 8.0], Anchor::Start, 13.0, heading);
        panel.show(&mut canvas, content(it, &section, &path, panel, &root, &triangles));
        panel.scales(&mut canvas, &across_name(&section), palette::AXIS_NAMES[section.up()]);
        let at = [24.0 + column as f64 * room, diagram_top];
        t_diagram::draw(&mut canvas, at, room - 48.0, &bars, *t, hit);
    }
    legend::draw(&mut canvas, [24.0, legend_top], WIDTH - 48.0, &legend);
    Some(canvas)
}

fn content(
    it: &RayPath<'_>,
    section: &Section,
    path: &Path,
    panel: &Panel,
    root: &Rect,
    triangles: &[[[f64; 2]; 2]],
) -> Group {
    let mut group = Group::new();
    for (cells, class, fill) in
        [(&path.dropped, "dropped", palette::PALE), (&path.visited, "visited", palette::VISITED)]
    {
        for (cell, _) in cells {
            if let Some(rect) = section.rect(&cell.bounds) {
                let rectangle = panel.rectangle(&rect, 1.5).set("class", class);
                group = group.add(rectangle.set("fill", fill));
            }
        }
    }
    let near = |ends: &&[[f64; 2]; 2]| Rect::around(ends).meets(&panel.shown());
    let context = triangles.iter().filter(near).filter_map(|ends| panel.line(ends));
    group = group.add(lines(context, Stroke::new(palette::GREY, 0.9)));
    for split in &path.splits {
        if let Some(ends) = split_ends(section, &split.cell, split.axis, split.split) {
            let width = (2.8 - 0.2 * f64::from(split.cell.depth)).max(1.0);
            let stroke = Stroke::new(palette::AXES[split.axis], width);
            group = group.add(lines(panel.line(&ends), stroke));
        }
    }
    let mesh = it.scene.primitives();
    let mut tested: Vec<u32> = path.tested.iter().copied().collect();
    tested.sort_unstable();
    let cut = tested.iter().filter_map(|&id| section.triangle(&mesh.corners(id)));
    let cut = cut.filter_map(|ends| panel.line(&ends));
    group = group.add(lines(cut, Stroke::new(palette::BLACK, 2.0)));
    group = group.add(frame(panel, root));
    marks_along_ray(it, section, path, panel).into_iter().fold(group, Group::add)
}

/// The line in which the section cuts a splitting plane within its cell.
pub(super) fn split_ends(
    section: &Section,
    cell: &Cell<3>,
    axis: usize,
    split: f32,
) -> Option<[[f64; 2]; 2]> {
    let mut plane = cell.bounds;
    (plane.min[axis], plane.max[axis]) = (split, split);
    let Rect { across, up } = section.rect(&plane)?;
    if axis == section.up() {
        Some([[across[0], up[0]], [across[1], up[0]]])
    } else if across[0] == across[1] {
        Some([[across[0], up[0]], [across[0], up[1]]])
    } else {
        None
    }
}

fn legend(section: &Section, path: &Path, hit: Option<Hit>) -> Vec<Vec<Entry>> {
    let mut axes: Vec<usize> = path.splits.iter().map(|split| split.axis).collect();
    axes.sort_unstable();
    axes.dedup();
    let splits = axes.into_iter().map(|axis| {
        let text = format!("split perpendicular to {}", palette::AXIS_NAMES[axis]);
        Entry::line(palette::AXES[axis], 2.4, text)
    });
    let mut cells = vec![Entry::area(palette::VISITED, "leaf visited")];
    if !path.dropped.is_empty() {
        cells.push(Entry::area(palette::PALE, "on the stack, dropped after the hit"));
    }
    let mut marks = vec![
        Entry::line(palette::BLACK, 2.0, "triangle tested"),
        Entry::line(palette::GREY, 0.9, "other triangle"),
    ];
    if hit.is_some() {
        marks.push(Entry::dot(palette::VERMILION, "closest hit"));
        marks.push(Entry::dashed(palette::BLACK, "4 4", "behind the hit"));
    }
    let note = format!(
        "The plane holds the ray and the {} axis: every cell is a rectangle in it.",
        palette::AXIS_NAMES[section.up()]
    );
    cells.extend(splits);
    vec![cells, marks, vec![Entry::words(note)]]
}
