//! A plane through the tree, in which every cell is a rectangle.

use super::panel::Rect;
use kdray::{Aabb, KdTree, Ray, tree::NodeKind};

/// A plane that holds the direction of one axis, `up`, and a direction `across` perpendicular to
/// it. The planes of a kd-tree cut it in straight lines along one of the two, or not at all, so
/// every cell cuts it in a rectangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Section {
    /// The point where the coordinate across is zero; its coordinate on `up` is zero.
    origin: [f64; 3],
    /// A unit vector; zero on `up`.
    across: [f64; 3],
    /// An axis.
    up: usize,
}

/// What a splitting plane does to a cell in a section.
enum Cut {
    /// The section's part of the cell is in one child alone.
    One { above: bool },
    /// It is cut in two along a line.
    Two { below: Rect, above: Rect, line: [[f64; 2]; 2] },
}

/// What there is in a section of a tree.
#[derive(Clone, Debug, Default)]
pub(crate) struct SectionedTree {
    /// The leaves, and inner nodes at the depth limit.
    pub(crate) cells: Vec<SectionCell>,
    /// Where the splitting planes are cut.
    pub(crate) splits: Vec<SplitLine>,
}

/// A cell in a section.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct SectionCell {
    /// Its rectangle.
    pub(crate) rect: Rect,
    /// How many primitives the leaf lists; for an inner node at the depth limit, the most that a
    /// leaf below it lists.
    pub(crate) primitives: usize,
}

/// A splitting plane in a section, as far as it cuts its cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct SplitLine {
    /// The axis that the plane is perpendicular to.
    pub(crate) axis: usize,
    /// How many splits lie above.
    pub(crate) depth: u32,
    /// Its ends.
    pub(crate) ends: [[f64; 2]; 2],
}

impl Section {
    /// The plane perpendicular to `axis` at `value`: y up if possible, and world coordinates.
    pub(crate) fn perpendicular(axis: usize, value: f64) -> Self {
        let (across_axis, up) = [(2, 1), (0, 2), (0, 1)][axis];
        let (mut origin, mut across) = ([0.0; 3], [0.0; 3]);
        origin[axis] = value;
        across[across_axis] = 1.0;
        Self { origin, across, up }
    }

    /// The plane that holds `ray` and shows it best: of the two axes along which the ray moves
    /// most, the second is up. Across is counted from the ray's origin.
    pub(crate) fn through(ray: &Ray) -> Self {
        let mut axes = [0, 1, 2];
        axes.sort_by(|&a, &b| ray.direction[b].abs().total_cmp(&ray.direction[a].abs()));
        let up = axes[1];
        let (mut origin, mut across) = (ray.origin, ray.direction);
        (origin[up], across[up]) = (0.0, 0.0);
        let largest = across.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        let scaled = across.map(|x| x / largest);
        let length = scaled.iter().map(|x| x * x).sum::<f64>().sqrt();
        Self { origin, across: scaled.map(|x| x / length), up }
    }

    /// The axis that is shown upwards.
    pub(crate) fn up(&self) -> usize {
        self.up
    }

    /// The axis shown across, if it is one, in world coordinates.
    pub(crate) fn across_axis(&self) -> Option<usize> {
        (0..3).find(|&axis| self.across[axis] == 1.0 && self.origin[axis] == 0.0)
    }

    /// The point of the section next to `p`: across and up.
    pub(crate) fn place(&self, p: [f64; 3]) -> [f64; 2] {
        let across = (0..3).map(|i| (p[i] - self.origin[i]) * self.across[i]).sum();
        [across, p[self.up]]
    }

    /// What a direction adds across and up.
    pub(crate) fn direction(&self, d: [f64; 3]) -> [f64; 2] {
        [(0..3).map(|i| d[i] * self.across[i]).sum(), d[self.up]]
    }

    /// The rectangle in which the plane cuts `aabb`.
    pub(crate) fn rect(&self, aabb: &Aabb<3>) -> Option<Rect> {
        let mut across = [f64::NEG_INFINITY, f64::INFINITY];
        for axis in (0..3).filter(|&axis| axis != self.up) {
            let (min, max) = (f64::from(aabb.min[axis]), f64::from(aabb.max[axis]));
            let (o, d) = (self.origin[axis], self.across[axis]);
            if d == 0.0 {
                if o < min || o > max {
                    return None;
                }
            } else {
                let (l, h) = ((min - o) / d, (max - o) / d);
                across = [across[0].max(l.min(h)), across[1].min(l.max(h))];
            }
        }
        let up = [f64::from(aabb.min[self.up]), f64::from(aabb.max[self.up])];
        (across[0] <= across[1] && up[0] <= up[1]).then_some(Rect { across, up })
    }

    /// The line in which the plane cuts a triangle; `None` if it passes the triangle, touches it
    /// in one point, or holds all of it.
    pub(crate) fn triangle(&self, corners: &[[f32; 3]; 3]) -> Option<[[f64; 2]; 2]> {
        let corners = corners.map(|p| p.map(f64::from));
        let side = corners.map(|p| self.side(p));
        let mut ends = Vec::new();
        for (i, j) in [(0, 1), (1, 2), (2, 0)] {
            if side[i] == 0.0 {
                ends.push(self.place(corners[i]));
            } else if side[i] * side[j] < 0.0 {
                let share = side[i] / (side[i] - side[j]);
                let (p, q) = (self.place(corners[i]), self.place(corners[j]));
                ends.push([0, 1].map(|k| p[k] + share * (q[k] - p[k])));
            }
        }
        <[[f64; 2]; 2]>::try_from(ends).ok()
    }

    /// How far `p` is from the plane, with a sign.
    pub(crate) fn side(&self, p: [f64; 3]) -> f64 {
        let (j, k) = ((self.up + 1) % 3, (self.up + 2) % 3);
        (p[j] - self.origin[j]) * self.across[k] - (p[k] - self.origin[k]) * self.across[j]
    }

    /// The tree as the plane cuts it, down to `max_depth` splits. A cell that is only touched, or
    /// has no thickness, is left out, so that the cells' rectangles tile the root's.
    pub(crate) fn of_tree(&self, tree: &KdTree, max_depth: u32) -> SectionedTree {
        let mut found = SectionedTree::default();
        let Some(root) = self.rect(tree.bounds()) else { return found };
        let mut stack = vec![(0, 0, root)];
        while let Some((node, depth, rect)) = stack.pop() {
            match tree.nodes()[node as usize].kind() {
                NodeKind::Inner { axis, split, above } if depth < max_depth => {
                    match self.cut(&rect, axis, f64::from(split)) {
                        Cut::One { above: true } => stack.push((above, depth + 1, rect)),
                        Cut::One { above: false } => stack.push((node + 1, depth + 1, rect)),
                        Cut::Two { below, above: upper, line } => {
                            found.splits.push(SplitLine { axis, depth, ends: line });
                            stack.push((above, depth + 1, upper));
                            stack.push((node + 1, depth + 1, below));
                        }
                    }
                }
                _ => {
                    let primitives = largest_leaf(tree, node);
                    found.cells.push(SectionCell { rect, primitives });
                }
            }
        }
        found
    }

    fn cut(&self, rect: &Rect, axis: usize, split: f64) -> Cut {
        let (range, at) = if axis == self.up {
            (rect.up, split)
        } else if self.across[axis] != 0.0 {
            (rect.across, (split - self.origin[axis]) / self.across[axis])
        } else {
            return Cut::One { above: self.origin[axis] >= split };
        };
        let rising = axis == self.up || self.across[axis] > 0.0;
        if at <= range[0] || at >= range[1] {
            return Cut::One { above: (at <= range[0]) == rising };
        }
        let (mut low, mut high) = (*rect, *rect);
        let line = if axis == self.up {
            (low.up[1], high.up[0]) = (at, at);
            [[rect.across[0], at], [rect.across[1], at]]
        } else {
            (low.across[1], high.across[0]) = (at, at);
            [[at, rect.up[0]], [at, rect.up[1]]]
        };
        let (below, above) = if rising { (low, high) } else { (high, low) };
        Cut::Two { below, above, line }
    }
}

/// The most primitives that a leaf at or below `node` lists.
fn largest_leaf(tree: &KdTree, node: u32) -> usize {
    let mut largest = 0;
    let mut stack = vec![node];
    while let Some(node) = stack.pop() {
        match tree.nodes()[node as usize].kind() {
            NodeKind::Inner { above, .. } => stack.extend([above, node + 1]),
            NodeKind::Leaf { count, .. } => largest = largest.max(count as usize),
        }
    }
    largest
}

#[cfg(test)]
mod tests {
    use super::*;
    use kdray::{BuildOptions, Strategy, TriangleMesh};

    const BOX: Aabb<3> = Aabb { min: [0.0, 0.0, 0.0], max: [4.0, 2.0, 8.0] };

    #[test]
    fn an_axis_slice_shows_world_coordinates() {
        let rect = Section::perpendicular(2, 5.0).rect(&BOX).unwrap();
        assert_eq!(rect, Rect { across: [0.0, 4.0], up: [0.0, 2.0] });
        let rect = Section::perpendicular(0, 1.0).rect(&BOX).unwrap();
        assert_eq!(rect, Rect { across: [0.0, 8.0], up: [0.0, 2.0] });
        assert_eq!(Section::perpendicular(1, 3.0).rect(&BOX), None);
    }

    #[test]
    fn a_section_through_a_ray_holds_it() {
        let ray = Ray::new([1.0, 2.0, 3.0], [0.0, 6.0, -8.0]);
        let section = Section::through(&ray);
        assert_eq!(section.up(), 1);
        for t in [0.0, 0.5, 2.0] {
            let p = ray.at(t);
            assert_eq!(section.side(p), 0.0);
            assert_eq!(section.place(p), [8.0 * t, p[1]]);
        }
    }

    #[test]
    fn across_is_an_axis_only_where_it_shows_world_coordinates() {
        let across =
            |origin, direction| Section::through(&Ray::new(origin, direction)).across_axis();
        assert_eq!(across([1.0, 2.0, 0.0], [0.0, 6.0, 8.0]), Some(2));
        assert_eq!(across([1.0, 2.0, 3.0], [0.0, 6.0, 8.0]), None, "counted from the origin");
        assert_eq!(across([1.0, 2.0, 0.0], [0.0, 6.0, -8.0]), None, "counted downwards");
        assert_eq!(across([1.0, 2.0, 0.0], [3.0, 6.0, 8.0]), None, "no axis");
        assert_eq!(Section::perpendicular(1, 3.0).across_axis(), Some(0));
    }

    #[test]
    fn triangles_are_cut_in_lines() {
        let section = Section::perpendicular(2, 1.0);
        let upright = [[0.0, 0.0, 0.0], [0.0, 0.0, 2.0], [4.0, 0.0, 0.0]];
        assert_eq!(section.triangle(&upright), Some([[0.0, 0.0], [2.0, 0.0]]));
        assert_eq!(section.triangle(&upright.map(|[x, y, _]| [x, y, 1.0])), None, "flat in it");
        assert_eq!(section.triangle(&upright.map(|[x, y, z]| [x, y, z + 3.0])), None, "beside");
        let edge = [[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [0.0, 1.0, 3.0]];
        assert_eq!(section.triangle(&edge), Some([[0.0, 0.0], [1.0, 0.0]]));
    }

    #[test]
    fn cells_tile_the_section() {
        let soup = (0..60).map(|i| {
            let at = |k: i32| ((i * (37 + k * 11) + k * 5) % 101) as f32 / 10.0;
            let (x, y, z) = (at(1), at(2), at(3));
            [[x, y, z], [x + 1.0, y, z], [x, y + 1.0, z + 0.5]]
        });
        let mesh = TriangleMesh::from_soup(soup).unwrap();
        for strategy in Strategy::ALL {
            let options = BuildOptions::for_strategy(strategy);
            let tree = KdTree::build(&mesh, &options).unwrap();
            let skew = Section::through(&Ray::new([0.0, 0.0, 0.0], [0.7, 1.0, -0.9]));
            for section in [Section::perpendicular(1, 5.0), skew] {
                let Some(root) = section.rect(tree.bounds()) else { continue };
                let found = section.of_tree(&tree, u32::MAX);
                let area = |r: &Rect| r.size()[0] * r.size()[1];
                let sum: f64 = found.cells.iter().map(|cell| area(&cell.rect)).sum();
                assert!((sum - area(&root)).abs() < 1e-6 * area(&root), "{strategy:?}");
                assert_eq!(found.cells.len(), found.splits.len() + 1);
                assert_eq!(section.of_tree(&tree, 0).cells.len(), 1);
            }
        }
    }
}
