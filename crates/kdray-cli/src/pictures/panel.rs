//! A part of a picture with its own coordinates, and the scale beside it.

use super::canvas::{Anchor, Canvas, Point, Stroke, label, line, rectangle};
use super::palette;
use crate::wording;
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

    /// The part of a line, from 0 to 1, that is in this one.
    pub(crate) fn part_of(&self, [a, b]: &[[f64; 2]; 2]) -> Option<[f64; 2]> {
        let mut part = [0.0_f64, 1.0_f64];
        for (k, [low, high]) in [self.across, self.up].into_iter().enumerate() {
            let step = b[k] - a[k];
            if step != 0.0 {
                let (l, h) = ((low - a[k]) / step, (high - a[k]) / step);
                part = [part[0].max(l.min(h)), part[1].min(l.max(h))];
            } else if a[k] < low || a[k] > high {
                return None;
            }
        }
        (part[0] < part[1]).then_some(part)
    }

    /// Whether the two share a point.
    pub(crate) fn meets(&self, other: &Self) -> bool {
        let overlap = |a: [f64; 2], b: [f64; 2]| a[0] <= b[1] && b[0] <= a[1];
        overlap(self.across, other.across) && overlap(self.up, other.up)
    }
}

/// How far beyond a panel, in pixels, what it shows is drawn: renderers of SVG count in f32, or in
/// 16 bits before the point.
const REACH: f64 = 16384.0;

/// A number at the edge of a panel, and how it is written.
pub(crate) struct Tick {
    pub(crate) value: f64,
    pub(crate) label: String,
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
    /// The largest panel at `at` within `room` that shows `shown`. What has no extent is given
    /// some.
    pub(crate) fn fit(at: Point, room: Point, shown: Rect) -> Self {
        let [width, height] = shown.size();
        let corners = [shown.across, shown.up].concat();
        let far = corners.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        let least = (1e-3 * width.max(height)).max(1e-30);
        let widen = |[low, high]: [f64; 2]| {
            if high - low < least.max(1e-12 * far) {
                let more = least.max(1e-6 * far);
                [low - more, high + more]
            } else {
                [low, high]
            }
        };
        let shown = Rect { across: widen(shown.across), up: widen(shown.up) };
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

    /// A shown line on the sheet, as far as it comes near the panel.
    pub(crate) fn line(&self, ends: &[[f64; 2]; 2]) -> Option<[Point; 2]> {
        let ends = ends.map(|p| self.place(p));
        let near = self.near();
        if near.holds(&Rect::around(&ends)) {
            return Some(ends);
        }
        let at = |share: f64| [0, 1].map(|k| ends[0][k] + share * (ends[1][k] - ends[0][k]));
        near.part_of(&ends).map(|part| part.map(at))
    }

    /// The panel and what is near it, on the sheet.
    fn near(&self) -> Rect {
        let range = |k: usize| [self.at[k] - REACH, self.at[k] + self.size[k] + REACH];
        Rect { across: range(0), up: range(1) }
    }

    /// A shown convex polygon on the sheet, as far as it comes near the panel.
    pub(crate) fn polygon(&self, corners: &[[f64; 2]]) -> Vec<Point> {
        let near = self.near();
        let mut points: Vec<Point> = corners.iter().map(|&p| self.place(p)).collect();
        for (k, [low, high]) in [near.across, near.up].into_iter().enumerate() {
            points = cut_off(&points, |p| p[k] - low);
            points = cut_off(&points, |p| high - p[k]);
        }
        points
    }

    /// A shown rectangle on the sheet, as far as it comes near the panel, at least `least` pixels
    /// wide and high.
    pub(crate) fn rectangle(&self, rect: &Rect, least: f64) -> svg::node::element::Rectangle {
        let near = self.near();
        let place = |p| {
            let [x, y] = self.place(p);
            [x.clamp(near.across[0], near.across[1]), y.clamp(near.up[0], near.up[1])]
        };
        let [left, top] = place([rect.across[0], rect.up[1]]);
        let [right, bottom] = place([rect.across[1], rect.up[0]]);
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
            let [x, _] = self.place([tick.value, 0.0]);
            canvas.add(line([x, bottom], [x, bottom + 5.0], stroke));
            canvas.text([x, bottom + 18.0], Anchor::Middle, 12.0, &tick.label);
        }
        let middle = self.at[0] + self.size[0] / 2.0;
        canvas.text([middle, bottom + 36.0], Anchor::Middle, 13.0, across);
        let left = self.at[0];
        for tick in ticks(self.shown.up, self.size[1] / 60.0) {
            let [_, y] = self.place([0.0, tick.value]);
            canvas.add(line([left - 5.0, y], [left, y], stroke));
            canvas.text([left - 8.0, y + 4.5], Anchor::End, 12.0, &tick.label);
        }
        let at = [left - 66.0, self.at[1] + self.size[1] / 2.0];
        let turn = format!("rotate(-90 {} {})", at[0], at[1]);
        canvas.add(label(at, Anchor::Middle, 13.0, up).set("transform", turn));
    }
}

/// The part of a convex polygon on which `side` is not negative.
fn cut_off(corners: &[Point], side: impl Fn(Point) -> f64) -> Vec<Point> {
    let mut kept = Vec::new();
    for (i, &p) in corners.iter().enumerate() {
        let q = corners[(i + 1) % corners.len()];
        let (at_p, at_q) = (side(p), side(q));
        if at_p >= 0.0 {
            kept.push(p);
        }
        if (at_p < 0.0) != (at_q < 0.0) {
            let share = at_p / (at_p - at_q);
            kept.push([0, 1].map(|k| p[k] + share * (q[k] - p[k])));
        }
    }
    kept
}

/// About `count` round numbers within a range.
pub(crate) fn ticks([low, high]: [f64; 2], count: f64) -> Vec<Tick> {
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
    let tick = |i: usize| {
        let value = (first + i as f64) * step;
        Tick { value, label: wording::tick(value, step) }
    };
    (0..=(last - first) as usize).map(tick).collect()
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
        let labels = |range, count| -> Vec<String> {
            ticks(range, count).into_iter().map(|tick| tick.label).collect()
        };
        assert_eq!(labels([0.0, 1.0], 5.0), ["0", "0.2", "0.4", "0.6", "0.8", "1"]);
        assert_eq!(labels([-7.0, 7.0], 3.0), ["-5", "0", "5"]);
        assert!(labels([1.0, 1.0], 5.0).is_empty());
        let far = labels([499_999.7, 500_000.3], 3.0);
        assert_eq!(far, ["499999.8", "500000", "500000.2"]);
    }

    #[test]
    fn what_has_an_extent_is_shown_as_it_is() {
        let shown = Rect { across: [690_194.0, 690_194.1], up: [5_335_000.0, 5_335_000.1] };
        assert_eq!(Panel::fit([0.0, 0.0], [100.0, 100.0], shown).shown(), shown);
    }

    #[test]
    fn what_is_far_beyond_the_panel_is_cut_off() {
        let shown = Rect { across: [0.0, 1e-9], up: [0.0, 1e-9] };
        let panel = Panel::fit([0.0, 0.0], [100.0, 100.0], shown);
        let [[x0, y0], [x1, y1]] = panel.line(&[[-1.0, -1.0], [1.0, 1.0]]).unwrap();
        assert!((x0 + y0 - 100.0).abs() < 1e-3 && (x1 + y1 - 100.0).abs() < 1e-3, "moved");
        assert!([x0, y0, x1, y1].iter().all(|x| x.abs() <= REACH + 101.0));
        assert_eq!(panel.line(&[[-1.0, 1.0], [1.0, 1.0]]), None, "passes far above");
        let near = [[-1e-9, 0.0], [2e-9, 1e-9]];
        assert_eq!(panel.line(&near), Some(near.map(|p| panel.place(p))));
        assert_eq!(panel.polygon(&near), near.map(|p| panel.place(p)));
        let around = panel.polygon(&[[-1.0, -1.0], [2.0, -1.0], [-1.0, 2.0]]);
        let [low, high] = [-REACH, 100.0 + REACH];
        for [x, y] in [[low, low], [low, high], [high, low], [high, high]] {
            let is_near = |p: &Point| (p[0] - x).abs() + (p[1] - y).abs() < 1e-3;
            assert!(around.iter().any(is_near), "{around:?}");
        }
        assert!(around.iter().flatten().all(|x| (low - 1e-3..high + 1e-3).contains(x)));
        let all = Rect { across: [-1.0, 1.0], up: [-1.0, 1.0] };
        let rectangle = panel.rectangle(&all, 0.0).to_string();
        assert!(rectangle.contains("x=\"-16384\"") && rectangle.contains("width=\"32868\""));
    }
}
