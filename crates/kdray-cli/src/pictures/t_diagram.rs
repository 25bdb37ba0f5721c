//! Which nodes a ray visits over its parameter t: a row for each depth of the tree.

use super::canvas::{Anchor, Canvas, Point, Stroke, line, rectangle};
use super::palette;
use super::panel::ticks;

const ROW: f64 = 15.0;
const LEFT: f64 = 34.0;

/// A node over the ray's parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Bar {
    /// How many splits lie above the node.
    pub(super) depth: u32,
    /// From t_near to t_far.
    pub(super) t: [f64; 2],
    /// What became of it.
    pub(super) fate: Fate,
}

/// What became of a node that the ray passes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Fate {
    /// An inner node that was visited: the axis of its plane, and t_split if the ray meets it.
    Split { axis: usize, t_split: f64 },
    /// A leaf that was visited.
    Visited,
    /// On the stack when the hit ended the search.
    Dropped,
}

/// How high the diagram is with the deepest node at `depth`.
pub(super) fn height(depth: u32) -> f64 {
    f64::from(depth + 1) * ROW + 62.0
}

/// Draws the diagram for `from` to `to` in t from its upper left corner.
pub(super) fn draw(
    canvas: &mut Canvas,
    at: Point,
    width: f64,
    bars: &[Bar],
    [from, to]: [f64; 2],
    hit: Option<f64>,
) {
    let depth = bars.iter().map(|bar| bar.depth).max().unwrap_or(0);
    let (left, right, top) = (at[0] + LEFT, at[0] + width, at[1] + 24.0);
    let extent = if to > from { to - from } else { 1.0 };
    let place = |t: f64| left + (t - from) / extent * (right - left);
    let bottom = top + f64::from(depth + 1) * ROW;

    canvas.text([at[0], at[1] + 10.0], Anchor::Start, 13.0, "nodes by depth, from t_near to t_far");
    for level in 0..=depth {
        let y = top + f64::from(level) * ROW;
        canvas.text([left - 8.0, y + 11.5], Anchor::End, 10.0, &level.to_string());
    }
    for bar in bars.iter().filter(|bar| bar.t[0] <= to && bar.t[1] >= from) {
        let bar = Bar { t: bar.t.map(|t| t.clamp(from, to)), ..*bar };
        let y = top + f64::from(bar.depth) * ROW;
        draw_bar(canvas, &bar, y, place);
    }
    let grey = Stroke::new(palette::GREY, 1.0);
    canvas.add(line([left, bottom], [right, bottom], grey));
    for tick in ticks([from, to], (right - left) / 90.0) {
        let x = place(tick.value);
        canvas.add(line([x, bottom], [x, bottom + 5.0], grey));
        canvas.text([x, bottom + 18.0], Anchor::Middle, 12.0, &tick.label);
    }
    canvas.text([(left + right) / 2.0, bottom + 34.0], Anchor::Middle, 13.0, "t");
    if let Some(t) = hit.filter(|t| (from..=to).contains(t)) {
        let stroke = Stroke::new(palette::BLACK, 1.6).dashed("4 3");
        canvas.add(line([place(t), top - 4.0], [place(t), bottom], stroke));
    }
}

fn draw_bar(canvas: &mut Canvas, bar: &Bar, y: f64, place: impl Fn(f64) -> f64) {
    let [x0, x1] = bar.t.map(&place);
    let (fill, edge) = match bar.fate {
        Fate::Split { axis, .. } => (palette::AXES[axis], palette::AXES[axis]),
        Fate::Visited => (palette::VISITED, palette::BLACK),
        Fate::Dropped => (palette::PALE, palette::GREY),
    };
    let opacity = if matches!(bar.fate, Fate::Split { .. }) { 0.28 } else { 1.0 };
    canvas.add(
        rectangle([x0, y + 1.5], [(x1 - x0).max(1.5), ROW - 3.0])
            .set("fill", fill)
            .set("fill-opacity", opacity)
            .set("stroke", edge)
            .set("stroke-width", 0.8),
    );
    if let Fate::Split { axis, t_split } = bar.fate
        && bar.t[0] <= t_split
        && t_split <= bar.t[1]
    {
        let x = place(t_split);
        let stroke = Stroke::new(palette::AXES[axis], 3.0);
        canvas.add(line([x, y + 1.0], [x, y + ROW - 1.0], stroke));
    }
}
