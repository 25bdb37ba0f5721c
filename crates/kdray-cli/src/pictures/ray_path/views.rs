//! What of the section is shown.

use super::super::Section;
use super::super::panel::{Panel, Rect};
use super::path::Path;
use super::{RayPath, TOP, WIDTH};
use kdray::Ray;

/// The room for scale and numbers to the left of a panel.
const LEFT: f64 = 96.0;
/// The room for a panel that has another beside it, and for one that has not.
const ROOM: [[f64; 2]; 2] = [[430.0, 430.0], [990.0, 520.0]];

/// A part of the section, and the nodes over the t that is seen there.
pub(super) struct View {
    pub(super) heading: &'static str,
    pub(super) panel: Panel,
    pub(super) t: [f64; 2],
}

/// The whole tree, and if the search ends in a small leaf, what is around that.
pub(super) fn views(
    it: &RayPath<'_>,
    section: &Section,
    path: &Path,
    root: Rect,
) -> Option<Vec<View>> {
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

/// The root's box, and a little of the ray before and behind it; of a box that is much larger than
/// the ray's way through it, the part around that.
pub(in crate::pictures) fn overview_rect(
    section: &Section,
    ray: &Ray,
    t: [f64; 2],
    root: Rect,
) -> Rect {
    let way = Rect::around(&t.map(|t| section.place(ray.at(t))));
    let around_way = way.grown(0.35 * way.size()[0].max(way.size()[1]));
    let crop = |whole: [f64; 2], part: [f64; 2]| {
        let small = part[1] - part[0] < 0.15 * (whole[1] - whole[0]);
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
    section.rect(&cell.bounds).map(|rect| surroundings(&rect))
}

/// What is around a cell, so that it can be seen well.
pub(in crate::pictures) fn surroundings(rect: &Rect) -> Rect {
    let [width, height] = rect.size();
    // A leaf may be long and thin: no more than ten times its thickness is around it.
    let reach = 1.2 * width.max(height).min(10.0 * width.min(height)).max(0.1 * width.max(height));
    square(&rect.grown(reach))
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

/// The interval of t, within the ray's own, in which the ray is seen.
pub(super) fn visible_t(section: &Section, ray: &Ray, shown: &Rect) -> Option<[f64; 2]> {
    let start = section.place(ray.origin);
    let steps = section.direction(ray.direction);
    let mut t = [ray.interval.t_min, ray.interval.t_max];
    for (k, range) in [shown.across, shown.up].into_iter().enumerate() {
        let step = steps[k];
        if step != 0.0 {
            let (l, h) = ((range[0] - start[k]) / step, (range[1] - start[k]) / step);
            t = [t[0].max(l.min(h)), t[1].min(l.max(h))];
        } else if start[k] < range[0] || start[k] > range[1] {
            return None;
        }
    }
    // A ray of next to no direction reaches the panel beyond all numbers.
    (t[0] < t[1] && t[1].is_finite()).then_some(t)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn short_directions_are_seen_as_long_ones() {
        let shown = Rect { across: [-1.0, 1.0], up: [-1.0, 1.0] };
        for length in [1.0, 1e-16, 1e-200] {
            let ray = Ray::new([3.0, 0.5, 0.0], [-length, 0.0, 0.0]);
            let [from, to] = visible_t(&Section::through(&ray), &ray, &shown).unwrap();
            assert!((from * length - 0.0).abs() < 1e-12 && (to * length - 1.0).abs() < 1e-12);
        }
    }
}
