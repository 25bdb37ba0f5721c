//! A part of a picture with its own coordinates, and the scale beside it.

use super::canvas::{Anchor, Canvas, Point, Stroke, label, line, rectangle};
use super::palette;
use crate::wording::readable;
use svg::node::element::Group;

/// An axis-aligned rectangle in the coordinates of what is shown: `[low, high]` across and up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Rect {
    /// The range across.
    pub(crate) across: [f64; 2],
    /// The range upwards.
    pub(crate) up: [f64; 2],
}

impl Rect {
    /// The smallest one that holds a line.
    pub(crate) fn around(ends: &[[f64; 2]; 2]) -> Self {
        let range = |k: usize| [ends[0][k].min(ends[1][k]), ends[0][k].max(ends[1][k])];
        Self { across: range(0), up: range(1) }
    }

    /// The smallest one that holds both.
    pub(crate) fn union(&self, other: &Self) -> Self {
        let hull = |a: [f64; 2], b: [f64; 2]| [a[0].min(b[0]), a[1].max(b[1])];
        Self { across: hull(self.across, other.across), up: hull(self.up, other.up) }
    }

    /// Width and height.
    pub(crate) fn size(&self) -> [f64; 2] {
        [self.across[1] - self.across[0], self.up[1] - self.up[0]]
    }

    /// The same, wider by `margin` on each side.
    pub(crate) fn grown(&self, margin: f64) -> Self {
        Self {
            across: [self.across[0] - margin, self.across[1] + margin],
            up: [self.up[0] - margin, self.up[1] + margin],
        }
    }

    /// Whether all of the other is in this one.
    pub(crate) fn holds(&self, other: &Self) -> bool {
        let within = |a: [f64; 2], b: [f64; 2]| a[0] <= b[0] && b[1] <= a[1];
        within(self.across, other.across) && within(self.up, other.up)
    }

    /// Whether the two share a point.
    pub(crate) fn meets(&self, other: &Self) -> bool {
        let overlap = |a: [f64; 2], b: [f64; 2]| a[0] <= b[1] && b[0] <= a[1];
        overlap(self.across, other.across) && overlap(self.up, other.up)
    }
}

/// A rectangle of the sheet that shows `shown`, both directions at one scale.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Panel {
    /// Upper left corner on the sheet.
    pub(crate) at: Point,
    /// Width and height on the sheet.
    pub(crate) size: Point,
    shown: Rect,
    pixels_per_unit: f64,
}

impl Panel {
    /// The largest panel at `at` within `room` that shows `shown`.
    pub(crate) fn fit(at: Point, room: Point, shown: Rect) -> Self {
        let [width, height] = shown.size();
        // What has no extent is given some.
        let corners = [shown.across, shown.up].concat();
        let far = corners.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        let least = (1e-3 * width.max(height)).max(1e-6 * far).max(1e-30);
        let shown = if width.min(height) < least {
            let widen = |[low, high]: [f64; 2]| {
                if high - low < least { [low - least, high + least] } else { [low, high] }
            };
            Rect { across: widen(shown.across), up: widen(shown.up) }
        } else {
            shown
        };
        let [width, height] = shown.size();
        let pixels_per_unit = (room[0] / width).min(room[1] / height);
        let size = [width * pixels_per_unit, height * pixels_per_unit];
        Self { at, size, shown, pixels_per_unit }
    }

    /// The part of the shown coordinates that is visible.
    pub(crate) fn shown(&self) -> Rect {
        self.shown
    }

    /// Where a shown point is on the sheet.
    pub(crate) fn place(&self, [across, up]: [f64; 2]) -> Point {
        [
            self.at[0] + (across - self.shown.across[0]) * self.pixels_per_unit,
            self.at[1] + (self.shown.up[1] - up) * self.pixels_per_unit,
        ]
    }

    /// A shown rectangle on the sheet, at least `least` pixels wide and high.
    pub(crate) fn rectangle(&self, rect: &Rect, least: f64) -> svg::node::element::Rectangle {
        let [left, top] = self.place([rect.across[0], rect.up[1]]);
        let [right, bottom] = self.place([rect.across[1], rect.up[0]]);
        let (width, height) = ((right - left).max(least), (bottom - top).max(least));
        let middle = [(left + right) / 2.0, (top + bottom) / 2.0];
        rectangle([middle[0] - width / 2.0, middle[1] - height / 2.0], [width, height])
    }

    /// Puts `content` on the sheet, cut off at the panel's edge, with a frame around it.
    pub(crate) fn show(&self, canvas: &mut Canvas, content: Group) {
        canvas.add(super::canvas::window(self.at, self.size, content));
        canvas.add(
            rectangle(self.at, self.size)
                .set("fill", "none")
                .set("stroke", palette::GREY)
                .set("stroke-width", 1.0),
        );
    }

    /// Numbers below and to the left, and what they measure.
    pub(crate) fn scales(&self, canvas: &mut Canvas, across: &str, up: &str) {
        let stroke = Stroke::new(palette::GREY, 1.0);
        let bottom = self.at[1] + self.size[1];
        for tick in ticks(self.shown.across, self.size[0] / 90.0) {
            let [x, _] = self.place([tick, 0.0]);
            canvas.add(line([x, bottom], [x, bottom + 5.0], stroke));
            canvas.text([x, bottom + 18.0], Anchor::Middle, 12.0, &readable(tick));
        }
        let middle = self.at[0] + self.size[0] / 2.0;
        canvas.text([middle, bottom + 36.0], Anchor::Middle, 13.0, across);
        let left = self.at[0];
        for tick in ticks(self.shown.up, self.size[1] / 60.0) {
            let [_, y] = self.place([0.0, tick]);
            canvas.add(line([left - 5.0, y], [left, y], stroke));
            canvas.text([left - 8.0, y + 4.5], Anchor::End, 12.0, &readable(tick));
        }
        let at = [left - 66.0, self.at[1] + self.size[1] / 2.0];
        let turn = format!("rotate(-90 {} {})", at[0], at[1]);
        canvas.add(label(at, Anchor::Middle, 13.0, up).set("transform", turn));
    }
}

/// About `count` round numbers within a range.
pub(crate) fn ticks([low, high]: [f64; 2], count: f64) -> Vec<f64> {
    let rough = (high - low) / count.max(1.0);
    let power = 10f64.powf(rough.log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0].map(|m| m * power).into_iter().find(|&s| s >= rough);
    let Some(step) = step.filter(|s| s.is_normal()) else { return Vec::new() };
    let first = (low / step).ceil();
    let last = (high / step).floor();
    // Far from zero a step may be too small to tell numbers apart.
    if !(0.0..=100.0).contains(&(last - first)) {
        return Vec::new();
    }
    (0..=(last - first) as usize).map(|i| (first + i as f64) * step).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panel_keeps_proportions_and_turns_up_into_up() {
        let shown = Rect { across: [0.0, 4.0], up: [-1.0, 1.0] };
        let panel = Panel::fit([10.0, 20.0], [200.0, 200.0], shown);
        assert_eq!(panel.size, [200.0, 100.0]);
        assert_eq!(panel.place([0.0, 1.0]), [10.0, 20.0]);
        assert_eq!(panel.place([4.0, -1.0]), [210.0, 120.0]);
    }

    #[test]
    fn what_is_flat_is_still_shown() {
        for shown in [
            Rect { across: [0.0, 4.0], up: [1.0, 1.0] },
            Rect { across: [2.0, 2.0], up: [1.0, 1.0] },
        ] {
            let panel = Panel::fit([0.0, 0.0], [100.0, 100.0], shown);
            assert!(panel.size.iter().all(|&side| side > 0.0 && side <= 100.1), "{panel:?}");
        }
    }

    #[test]
    fn ticks_are_round_and_within() {
        assert_eq!(ticks([0.0, 1.0], 5.0), [0.0, 0.2, 0.4, 0.6000000000000001, 0.8, 1.0]);
        assert_eq!(ticks([-7.0, 7.0], 3.0), [-5.0, 0.0, 5.0]);
        assert!(ticks([1.0, 1.0], 5.0).is_empty());
    }
}
