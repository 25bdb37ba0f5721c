//! What marks mean, in rows below a picture.

use super::canvas::{Anchor, Canvas, Point, Stroke, line, rectangle, text_width};
use super::palette;

const SIZE: f64 = 13.0;
const ROW: f64 = 22.0;
const SWATCH: f64 = 24.0;

/// One mark and its meaning.
pub(crate) struct Entry {
    mark: Mark,
    text: String,
}

enum Mark {
    Line { color: String, width: f64, dash: Option<&'static str> },
    Box { fill: String },
    Dot { color: &'static str },
    Nothing,
}

impl Entry {
    /// A line in `color`.
    pub(crate) fn line(color: impl Into<String>, width: f64, text: impl Into<String>) -> Self {
        Self { mark: Mark::Line { color: color.into(), width, dash: None }, text: text.into() }
    }

    /// A dashed line in `color`.
    pub(crate) fn dashed(
        color: impl Into<String>,
        dash: &'static str,
        text: impl Into<String>,
    ) -> Self {
        let mark = Mark::Line { color: color.into(), width: 1.5, dash: Some(dash) };
        Self { mark, text: text.into() }
    }

    /// An area.
    pub(crate) fn area(fill: impl Into<String>, text: impl Into<String>) -> Self {
        Self { mark: Mark::Box { fill: fill.into() }, text: text.into() }
    }

    /// A dot.
    pub(crate) fn dot(color: &'static str, text: impl Into<String>) -> Self {
        Self { mark: Mark::Dot { color }, text: text.into() }
    }

    /// Words alone, such as a heading of the entries behind it.
    pub(crate) fn words(text: impl Into<String>) -> Self {
        Self { mark: Mark::Nothing, text: text.into() }
    }

    fn width(&self) -> f64 {
        let mark = if matches!(self.mark, Mark::Nothing) { 0.0 } else { SWATCH + 6.0 };
        mark + text_width(SIZE, &self.text) + 16.0
    }

    fn draw(&self, canvas: &mut Canvas, [x, y]: Point) {
        let middle = y + ROW / 2.0;
        let text_x = match &self.mark {
            Mark::Nothing => x,
            _ => x + SWATCH + 6.0,
        };
        match &self.mark {
            Mark::Line { color, width, dash } => {
                let mut stroke = Stroke::new(color, *width);
                stroke.dash = *dash;
                canvas.add(line([x, middle], [x + SWATCH, middle], stroke));
            }
            Mark::Box { fill } => canvas.add(
                rectangle([x, middle - 7.0], [SWATCH, 14.0])
                    .set("fill", fill.as_str())
                    .set("stroke", palette::GREY)
                    .set("stroke-width", 0.6),
            ),
            Mark::Dot { color } => canvas.add(dot([x + SWATCH / 2.0, middle], 4.5, color)),
            Mark::Nothing => {}
        }
        canvas.text([text_x, middle + 4.5], Anchor::Start, SIZE, &self.text);
    }
}

/// A filled circle.
pub(crate) fn dot(at: Point, radius: f64, color: &str) -> svg::node::element::Circle {
    svg::node::element::Circle::new()
        .set("cx", at[0])
        .set("cy", at[1])
        .set("r", radius)
        .set("fill", color)
        .set("stroke", palette::WHITE)
        .set("stroke-width", 1.0)
}

/// How high a legend is that is `width` wide.
pub(crate) fn height(groups: &[Vec<Entry>], width: f64) -> f64 {
    places(groups, width).last().map_or(0.0, |([_, y], _)| y + ROW)
}

/// Draws a legend from its upper left corner; every group begins a row.
pub(crate) fn draw(canvas: &mut Canvas, at: Point, width: f64, groups: &[Vec<Entry>]) {
    for ([x, y], entry) in places(groups, width) {
        entry.draw(canvas, [at[0] + x, at[1] + y]);
    }
}

/// Where each entry stands: row after row, a new one where the next entry would not fit.
fn places(groups: &[Vec<Entry>], width: f64) -> Vec<(Point, &Entry)> {
    let mut placed = Vec::new();
    let mut y = 0.0;
    for group in groups.iter().filter(|group| !group.is_empty()) {
        let mut x = 0.0;
        for entry in group {
            if x > 0.0 && x + entry.width() > width {
                (x, y) = (0.0, y + ROW);
            }
            placed.push(([x, y], entry));
            x += entry.width();
        }
        y += ROW;
    }
    placed
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entries_wrap_and_groups_begin_rows() {
        let entry = || Entry::area("#fff", "0123456789");
        let groups = [vec![entry(), entry(), entry()], vec![], vec![entry()]];
        let rows: Vec<f64> = places(&groups, 270.0).iter().map(|(at, _)| at[1]).collect();
        assert_eq!(rows, [0.0, 0.0, ROW, 2.0 * ROW]);
        assert_eq!(height(&groups, 270.0), 3.0 * ROW);
        assert_eq!(height(&groups, 1.0), 4.0 * ROW, "too narrow for any is no reason to loop");
    }
}
