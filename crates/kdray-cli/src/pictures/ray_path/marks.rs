//! What stands along the ray: t where it enters and leaves leaves, the observer, the hit.

use super::super::canvas::{Anchor, Point, Stroke, label_on_lines, line, text_width};
use super::super::panel::Panel;
use super::super::{Section, legend, palette};
use super::RayPath;
use super::path::Path;
use super::views::visible_t;
use crate::wording::readable;
use kdray::{Hit, Ray};
use svg::node::element::Element;

/// The ray, t where it enters and leaves leaves, the observer, the hit.
pub(super) fn marks_along_ray(
    it: &RayPath<'_>,
    section: &Section,
    path: &Path,
    panel: &Panel,
) -> Vec<Element> {
    let Some(shown) = visible_t(section, it.ray, &panel.shown()) else { return Vec::new() };
    let ts = leaf_ends(path, shown);
    let mut marks = Marks::new(it, section, panel, shown);
    marks.draw_ray(it.hit);
    marks.draw_ticks(&ts);
    if let Some(hit) = it.hit.filter(|hit| marks.shows(hit.t)) {
        marks.draw_dot(hit.t, 5.5, palette::VERMILION);
        marks.add_label(hit.t, [-1.2, 1.2], &format!("hit, t = {}", readable(hit.t)));
    }
    if it.ray.interval.t_min <= 0.0 && shown[0] <= 0.0 {
        marks.draw_dot(0.0, 5.0, palette::BLACK);
        marks.add_label(0.0, [-1.0, 1.0], "E");
    }
    for &t in &ts {
        marks.add_label(t, [1.0, -1.0], &format!("t = {}", readable(t)));
    }
    marks.drawn.extend(marks.labels);
    marks.drawn
}

/// Where the ray enters and leaves the leaves it visits, as far as that is shown, each t once.
fn leaf_ends(path: &Path, [from, to]: [f64; 2]) -> Vec<f64> {
    let mut ts: Vec<f64> = path.visited.iter().flat_map(|(_, t)| *t).collect();
    ts.retain(|t| (from..=to).contains(t));
    ts.sort_by(f64::total_cmp);
    ts.dedup_by(|a, b| (*a - *b).abs() <= 1e-6 * b.abs().max(to - from));
    ts
}

/// Marks in the making.
struct Marks<'a> {
    ray: &'a Ray,
    section: &'a Section,
    panel: &'a Panel,
    /// The part of the ray in the panel.
    shown: [f64; 2],
    /// The unit vector across the drawn ray: labels stand on its lower right, and the hit's own on
    /// the upper left.
    normal: Point,
    drawn: Vec<Element>,
    /// Drawn last, over everything.
    labels: Vec<Element>,
    /// Where labels are.
    taken: Vec<[Point; 2]>,
}

impl<'a> Marks<'a> {
    fn new(it: &'a RayPath<'_>, section: &'a Section, panel: &'a Panel, shown: [f64; 2]) -> Self {
        let mut marks = Self {
            ray: it.ray,
            section,
            panel,
            shown,
            normal: [0.0; 2],
            drawn: Vec::new(),
            labels: Vec::new(),
            taken: Vec::new(),
        };
        let [[x0, y0], [x1, y1]] = shown.map(|t| marks.place(t));
        let length = (x1 - x0).hypot(y1 - y0).max(1.0);
        let normal = [(y0 - y1) / length, (x1 - x0) / length];
        marks.normal = if normal[1] < 0.0 { normal.map(|n| -n) } else { normal };
        marks
    }

    fn shows(&self, t: f64) -> bool {
        self.shown[0] <= t && t <= self.shown[1]
    }

    /// Where the ray is at t, on the sheet.
    fn place(&self, t: f64) -> Point {
        self.panel.place(self.section.place(self.ray.at(t)))
    }

    /// A place so far across from the ray at t.
    fn beside(&self, t: f64, by: f64) -> Point {
        let [x, y] = self.place(t);
        [x + self.normal[0] * by, y + self.normal[1] * by]
    }

    /// The ray: drawn through to the hit, dashed behind it.
    fn draw_ray(&mut self, hit: Option<Hit>) {
        let [from, to] = self.shown;
        let end = hit.map_or(to, |hit| hit.t.min(to));
        let stroke = Stroke::new(palette::BLACK, 1.8);
        self.drawn.push(line(self.place(from), self.place(end), stroke));
        if end < to {
            let beyond = Stroke::new(palette::BLACK, 1.2).dashed("4 4").faint(0.7);
            self.drawn.push(line(self.place(end), self.place(to), beyond));
        }
    }

    fn draw_ticks(&mut self, ts: &[f64]) {
        let tick = |&t: &f64| {
            line(self.beside(t, -4.0), self.beside(t, 4.0), Stroke::new(palette::BLACK, 1.4))
        };
        let ticks: Vec<Element> = ts.iter().map(tick).collect();
        self.drawn.extend(ticks);
    }

    fn draw_dot(&mut self, t: f64, radius: f64, color: &'static str) {
        self.drawn.push(legend::dot(self.place(t), radius, color).into());
    }

    /// A label at t, on the first of the sides where there is room.
    fn add_label(&mut self, t: f64, sides: [f64; 2], text: &str) {
        let label = sides.into_iter().find_map(|side| {
            let at = self.beside(t, 16.0 * side);
            placed_label(self.panel, at, self.normal[0] * side, text, &mut self.taken)
        });
        self.labels.extend(label);
    }
}

/// A label beside the ray, if it overlaps no other and stays in the panel.
fn placed_label(
    panel: &Panel,
    [x, y]: Point,
    lean: f64,
    text: &str,
    taken: &mut Vec<[Point; 2]>,
) -> Option<Element> {
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
