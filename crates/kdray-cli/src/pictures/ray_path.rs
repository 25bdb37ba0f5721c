//! The way of one ray through the tree (S11): the section that holds the ray, and the nodes over t.

use super::canvas::{Anchor, Canvas, Point, Stroke, label_on_lines, line, lines, text_width};
use super::legend::{self, Entry};
use super::panel::{Panel, Rect};
use super::slice::{across_name, cut_triangles, frame};
use super::t_diagram::{self, Bar, Fate};
use super::{Section, counted, palette, readable};
use kdray::tree::{Cell, NodeKind};
use kdray::{Hit, Ray, Scene, traverse::Step};
use std::collections::{HashMap, HashSet};
use svg::node::element::Group;

/// What the picture shows.
pub(crate) struct RayPath<'a> {
    /// Triangles and tree.
    pub(crate) scene: &'a Scene,
    /// The ray.
    pub(crate) ray: &'a Ray,
    /// All that happened.
    pub(crate) steps: &'a [Step],
    /// What came of it.
    pub(crate) hit: Option<Hit>,
    /// The headline.
    pub(crate) title: &'a str,
}

/// The steps sorted by what they say about cells.
struct Path {
    splits: Vec<PathSplit>,
    visited: Vec<(Cell<3>, [f64; 2])>,
    dropped: Vec<(Cell<3>, [f64; 2])>,
    tested: HashSet<u32>,
}

struct PathSplit {
    cell: Cell<3>,
    axis: usize,
    split: f32,
    t: [f64; 2],
    t_split: f64,
}

const WIDTH: f64 = 1120.0;
const TOP: f64 = 84.0;
/// The room for scale and numbers to the left of a panel.
const LEFT: f64 = 96.0;
/// The room for a panel that has another beside it, and for one that has not.
const ROOM: [[f64; 2]; 2] = [[430.0, 430.0], [990.0, 520.0]];

/// A part of the section, and the nodes over the t that is seen there.
struct View {
    heading: &'static str,
    panel: Panel,
    t: [f64; 2],
}

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

/// The whole tree, and if the search ends in a small leaf, what is around that.
fn views(it: &RayPath<'_>, section: &Section, path: &Path, root: Rect) -> Option<Vec<View>> {
    let whole_t =
        path.bars().iter().map(|bar| bar.t).reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])])?;
    let shown = overview_rect(section, it.ray, whole_t, root);
    let heading = if shown.holds(&root) { "the whole tree" } else { "the ray in the tree" };
    let view = |heading, column: f64, room, shown, t| {
        let panel = Panel::fit([LEFT + column * WIDTH / 2.0, TOP], room, shown);
        View { heading, panel, t }
    };
    let detail = detail_rect(section, path).filter(|rect| {
        let share = |side: usize| rect.size()[side] / root.size()[side].max(f64::MIN_POSITIVE);
        share(0).max(share(1)) < 0.5
    });
    let seen = detail.and_then(|rect| Some((rect, visible_t(section, it.ray, &rect)?)));
    let Some((rect, [from, to])) = seen else {
        let mut only = view(heading, 0.0, ROOM[1], shown, whole_t);
        only.panel.at[0] += (ROOM[1][0] - only.panel.size[0]) / 2.0;
        return Some(vec![only]);
    };
    let t = [from.max(whole_t[0]), to.min(whole_t[1])];
    Some(vec![
        view(heading, 0.0, ROOM[0], shown, whole_t),
        view("where the search ends", 1.0, ROOM[0], rect, t),
    ])
}

impl Path {
    fn new(scene: &Scene, steps: &[Step]) -> Self {
        let cells = cells_of(scene, steps);
        let mut path = Self {
            splits: Vec::new(),
            visited: Vec::new(),
            dropped: Vec::new(),
            tested: HashSet::new(),
        };
        // The stack is followed to know which nodes the search left on it.
        let mut waiting: Vec<(u32, [f64; 2])> = Vec::new();
        for step in steps {
            match *step {
                Step::Split(step) => {
                    let Some(&cell) = cells.get(&step.node) else { continue };
                    let (t, t_split) = ([step.t_near, step.t_far], step.t_split);
                    let (axis, split) = (step.axis, step.split);
                    path.splits.push(PathSplit { cell, axis, split, t, t_split });
                    if step.case == kdray::traverse::TraversalCase::NearThenFar {
                        let t_near = t_split.clamp(step.t_near, step.t_far);
                        waiting.push((step.far_child, [t_near, step.t_far]));
                    }
                }
                Step::Leaf(step) => {
                    if let Some(&cell) = cells.get(&step.node) {
                        path.visited.push((cell, [step.t_near, step.t_far]));
                    }
                }
                Step::Pop { node, .. } => waiting.retain(|&(other, _)| other != node),
                Step::Primitive { id, .. } => {
                    path.tested.insert(id);
                }
                Step::Root(_) | Step::FinishEarly { .. } => {}
            }
        }
        let dropped = waiting.iter().filter_map(|(node, t)| Some((*cells.get(node)?, *t)));
        path.dropped = dropped.collect();
        path
    }

    fn bars(&self) -> Vec<Bar> {
        let split = |it: &PathSplit| Bar {
            depth: it.cell.depth,
            t: it.t,
            fate: Fate::Split { axis: it.axis, t_split: it.t_split },
        };
        let leaf = |fate| move |&(cell, t): &(Cell<3>, _)| Bar { depth: cell.depth, t, fate };
        let visited = self.visited.iter().map(leaf(Fate::Visited));
        let dropped = self.dropped.iter().map(leaf(Fate::Dropped));
        self.splits.iter().map(split).chain(dropped).chain(visited).collect()
    }

    fn summary(&self, hit: Option<Hit>) -> String {
        let end = match hit {
            Some(hit) => format!("hit triangle {} at t = {}", hit.primitive_id, readable(hit.t)),
            None => "no hit".to_owned(),
        };
        format!(
            "{} and {} visited, {} dropped from the stack, {} tested: {end}",
            counted(self.splits.len(), "inner node", "inner nodes"),
            counted(self.visited.len(), "leaf", "leaves"),
            counted(self.dropped.len(), "node", "nodes"),
            counted(self.tested.len(), "triangle", "triangles"),
        )
    }
}

/// The cells of the nodes that the steps name, and of their children.
fn cells_of(scene: &Scene, steps: &[Step]) -> HashMap<u32, Cell<3>> {
    let tree = scene.tree();
    let mut cells = HashMap::new();
    cells.insert(0, Cell { node: 0, depth: 0, bounds: *tree.bounds() });
    for step in steps {
        let Step::Split(step) = step else { continue };
        let Some(cell) = cells.get(&step.node).copied() else { continue };
        if let NodeKind::Inner { axis, split, above } = tree.nodes()[step.node as usize].kind() {
            let (below_bounds, above_bounds) = cell.bounds.split(axis, split);
            let depth = cell.depth + 1;
            let below = step.node + 1;
            cells.insert(below, Cell { node: below, depth, bounds: below_bounds });
            cells.insert(above, Cell { node: above, depth, bounds: above_bounds });
        }
    }
    cells
}

/// The root's box, and a little of the ray before and behind it; of a box that is much larger than
/// the ray's way through it, the part around that.
fn overview_rect(section: &Section, ray: &Ray, t: [f64; 2], root: Rect) -> Rect {
    let way = Rect::around(&t.map(|t| section.place(ray.at(t))));
    let around_way = way.grown(0.35 * way.size()[0].max(way.size()[1]));
    let crop = |whole: [f64; 2], part: [f64; 2]| {
        let small = part[1] - part[0] < 0.4 * (whole[1] - whole[0]);
        if small { [part[0].max(whole[0]), part[1].min(whole[1])] } else { whole }
    };
    let root =
        Rect { across: crop(root.across, around_way.across), up: crop(root.up, around_way.up) };
    let [width, height] = root.size();
    let shown = root.grown(0.1 * width.max(height));
    // The observer is shown too if that does not make the box small.
    let eye = section.place(ray.origin);
    let with_eye = Rect {
        across: [shown.across[0].min(eye[0]), shown.across[1].max(eye[0])],
        up: [shown.up[0].min(eye[1]), shown.up[1].max(eye[1])],
    };
    let growth = |side: usize| with_eye.size()[side] / shown.size()[side].max(f64::MIN_POSITIVE);
    if with_eye != shown && growth(0) <= 2.2 && growth(1) <= 2.2 {
        return with_eye.grown(0.08 * width.max(height));
    }
    shown
}

/// The leaf in which the search ends, and what is around it.
fn detail_rect(section: &Section, path: &Path) -> Option<Rect> {
    let (cell, _) = path.visited.last()?;
    let rect = section.rect(&cell.bounds)?;
    let [width, height] = rect.size();
    // A leaf may be long and thin: no more than ten times its thickness is around it.
    let reach = 1.2 * width.max(height).min(10.0 * width.min(height)).max(0.1 * width.max(height));
    Some(square(&rect.grown(reach)))
}

/// The smallest square around a rectangle.
fn square(rect: &Rect) -> Rect {
    let side = rect.size()[0].max(rect.size()[1]);
    let around = |[low, high]: [f64; 2]| {
        let middle = 0.5 * (low + high);
        [middle - 0.5 * side, middle + 0.5 * side]
    };
    Rect { across: around(rect.across), up: around(rect.up) }
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
    let place = |ends: &[[f64; 2]; 2]| ends.map(|p| panel.place(p));
    let context = triangles.iter().filter(near).map(place);
    group = group.add(lines(context, Stroke::new(palette::GREY, 0.9)));
    for split in &path.splits {
        if let Some(ends) = split_ends(section, split) {
            let width = (2.8 - 0.2 * f64::from(split.cell.depth)).max(1.0);
            let stroke = Stroke::new(palette::AXES[split.axis], width);
            group = group.add(lines([place(&ends)], stroke));
        }
    }
    let mesh = it.scene.primitives();
    let mut tested: Vec<u32> = path.tested.iter().copied().collect();
    tested.sort_unstable();
    let cut = tested.iter().filter_map(|&id| section.triangle(&mesh.corners(id)));
    let cut: Vec<_> = cut.map(|ends| place(&ends)).collect();
    group = group.add(lines(cut, Stroke::new(palette::BLACK, 2.0)));
    group = group.add(frame(panel, root));
    marks_along_ray(it, section, path, panel).into_iter().fold(group, Group::add)
}

/// The line in which the section cuts a splitting plane within its cell.
fn split_ends(section: &Section, split: &PathSplit) -> Option<[[f64; 2]; 2]> {
    let mut plane = split.cell.bounds;
    (plane.min[split.axis], plane.max[split.axis]) = (split.split, split.split);
    let Rect { across, up } = section.rect(&plane)?;
    if split.axis == section.up() {
        Some([[across[0], up[0]], [across[1], up[0]]])
    } else if across[0] == across[1] {
        Some([[across[0], up[0]], [across[0], up[1]]])
    } else {
        None
    }
}

/// The ray, t where it enters and leaves leaves, the observer, the hit.
fn marks_along_ray(
    it: &RayPath<'_>,
    section: &Section,
    path: &Path,
    panel: &Panel,
) -> Vec<svg::node::element::Element> {
    let shown = panel.shown();
    let on_sheet = |t: f64| panel.place(section.place(it.ray.at(t)));
    let Some([from, to]) = visible_t(section, it.ray, &shown) else { return Vec::new() };
    let end = it.hit.map_or(to, |hit| hit.t.min(to));
    let (mut marks, mut marks_text) = (Vec::new(), Vec::new());
    marks.push(line(on_sheet(from), on_sheet(end), Stroke::new(palette::BLACK, 1.8)));
    if end < to {
        let beyond = Stroke::new(palette::BLACK, 1.2).dashed("4 4").faint(0.7);
        marks.push(line(on_sheet(end), on_sheet(to), beyond));
    }
    let mut ts: Vec<f64> = path.visited.iter().flat_map(|(_, t)| *t).collect();
    ts.retain(|t| (from..=to).contains(t));
    ts.sort_by(f64::total_cmp);
    ts.dedup_by(|a, b| (*a - *b).abs() <= 1e-6 * b.abs().max(to - from));
    let [[x0, y0], [x1, y1]] = [on_sheet(from), on_sheet(to)];
    let length = (x1 - x0).hypot(y1 - y0).max(1.0);
    let normal = [(y0 - y1) / length, (x1 - x0) / length];
    // Labels stand on the lower right of the ray, and the hit's own on the upper left.
    let flip = if normal[1] < 0.0 { -1.0 } else { 1.0 };
    let normal = normal.map(|n| n * flip);
    let offset = |[x, y]: Point, by: f64| [x + normal[0] * by, y + normal[1] * by];
    for &t in &ts {
        let at = on_sheet(t);
        marks.push(line(offset(at, -4.0), offset(at, 4.0), Stroke::new(palette::BLACK, 1.4)));
    }
    let mut taken = Vec::new();
    let mut add_label = |t: f64, sides: [f64; 2], text: &str| {
        let label = sides.into_iter().find_map(|side| {
            let at = offset(on_sheet(t), 16.0 * side);
            placed_label(panel, at, normal[0] * side, text, &mut taken)
        });
        marks_text.extend(label);
    };
    if let Some(hit) = it.hit.filter(|hit| (from..=to).contains(&hit.t)) {
        marks.push(legend::dot(on_sheet(hit.t), 5.5, palette::VERMILION).into());
        add_label(hit.t, [-1.2, 1.2], &format!("hit, t = {}", readable(hit.t)));
    }
    if it.ray.interval.t_min <= 0.0 && from <= 0.0 {
        marks.push(legend::dot(on_sheet(0.0), 5.0, palette::BLACK).into());
        add_label(0.0, [-1.0, 1.0], "E");
    }
    for &t in &ts {
        add_label(t, [1.0, -1.0], &format!("t = {}", readable(t)));
    }
    marks.extend(marks_text);
    marks
}

/// A label beside the ray, if it overlaps no other and stays in the panel.
fn placed_label(
    panel: &Panel,
    [x, y]: Point,
    lean: f64,
    text: &str,
    taken: &mut Vec<[Point; 2]>,
) -> Option<svg::node::element::Element> {
    let width = text_width(12.0, text);
    let (anchor, left) = if lean > 0.35 {
        (Anchor::Start, x)
    } else if lean < -0.35 {
        (Anchor::End, x - width)
    } else {
        (Anchor::Middle, x - width / 2.0)
    };
    let (low, high) = ([left - 3.0, y - 9.0], [left + width + 3.0, y + 7.0]);
    let inside = (0..2).all(|k| panel.at[k] <= low[k] && high[k] <= panel.at[k] + panel.size[k]);
    let free = taken.iter().all(|[a, b]| (0..2).any(|k| high[k] < a[k] || b[k] < low[k]));
    if !inside || !free {
        return None;
    }
    taken.push([low, high]);
    Some(label_on_lines([x, y + 4.5], anchor, 12.0, text).into())
}

/// The interval of t, within the ray's own, in which the ray is seen.
fn visible_t(section: &Section, ray: &Ray, shown: &Rect) -> Option<[f64; 2]> {
    let start = section.place(ray.origin);
    let end = section.place(ray.at(1.0));
    let mut t = [ray.interval.t_min, ray.interval.t_max];
    for (k, range) in [shown.across, shown.up].into_iter().enumerate() {
        let step = end[k] - start[k];
        if step != 0.0 {
            let (l, h) = ((range[0] - start[k]) / step, (range[1] - start[k]) / step);
            t = [t[0].max(l.min(h)), t[1].min(l.max(h))];
        } else if start[k] < range[0] || start[k] > range[1] {
            return None;
        }
    }
    (t[0] < t[1]).then_some(t)
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
