//! What stands along the ray: t where it enters and leaves leaves, the observer, the hit.

use super::super::canvas::{Anchor, Point, Stroke, label_on_lines, line, text_width};
use super::super::panel::Panel;
use super::super::{Section, legend, palette, readable};
use super::RayPath;
use super::path::Path;
use super::views::visible_t;

/// The ray, t where it enters and leaves leaves, the observer, the hit.
pub(super) fn marks_along_ray(
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
