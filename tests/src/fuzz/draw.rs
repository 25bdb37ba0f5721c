//! Numbers, points, meshes, rays and options from bytes.
//!
//! Bytes are used up in order, and are zero where they end, so that a small change of an input is a small change of
//! what is made of it. Most numbers are of few digits, or those drawn before, or next to them: what lies exactly on
//! an edge or in a plane is never found among numbers that are merely random.

use arbitrary::Unstructured;
use kdray::build::{SahBuilder, Termination};
use kdray::{BuildOptions, Coordinate, CostModel, Preset, Ray, Strategy, TriangleMesh};

/// The source of everything.
#[derive(Debug)]
pub struct Draw<'a> {
    bytes: Unstructured<'a>,
    /// What numbers of few digits are multiplied with, and what is added to them.
    scale: f64,
    offset: [f64; 3],
    /// Numbers for the next to be equal to, or next to.
    drawn: [f64; 8],
    count: usize,
}

impl<'a> Draw<'a> {
    /// From the bytes of an input, of which the first few say of which size most numbers are.
    pub fn new(data: &'a [u8]) -> Self {
        let bytes = Unstructured::new(data);
        let mut draw = Self { bytes, scale: 1.0, offset: [0.0; 3], drawn: [0.0; 8], count: 0 };
        draw.scale = match draw.byte() % 8 {
            0..4 => 1.0 / 16.0,
            4 => 2.0_f64.powi(4 * i32::from(draw.byte() as i8)),
            5 => 2.0_f64.powi(i32::from(draw.byte() as i8)),
            6 => 0.1,
            _ => 1e-3,
        };
        if draw.byte() % 8 == 7 {
            draw.offset = [(); 3].map(|()| draw.plain(1.0) * 1e5);
        }
        draw
    }

    /// Whether there are bytes left.
    pub fn has_more(&self) -> bool {
        !self.bytes.is_empty()
    }

    /// The next byte; zero if there is none.
    pub fn byte(&mut self) -> u8 {
        self.bytes.arbitrary().unwrap_or(0)
    }

    /// The next bit.
    pub fn bit(&mut self) -> bool {
        self.byte() % 2 == 1
    }

    /// A number below `end`, which is not zero and below 65536.
    pub fn below(&mut self, end: usize) -> usize {
        let number = if end <= 256 { usize::from(self.byte()) } else { self.word() };
        number % end
    }

    fn word(&mut self) -> usize {
        usize::from(self.byte()) << 8 | usize::from(self.byte())
    }

    /// One of a list.
    pub fn choose<T: Copy>(&mut self, list: &[T]) -> T {
        list[self.below(list.len())]
    }

    fn plain(&mut self, scale: f64) -> f64 {
        f64::from(self.byte() as i8) * scale
    }

    /// A finite number, most often of few digits.
    pub fn number(&mut self, axis: usize) -> f64 {
        let kind = self.byte();
        let earlier = self.drawn[usize::from(kind >> 4) % 8];
        let number = match kind % 16 {
            0..8 => self.plain(self.scale) + self.offset[axis],
            8 | 9 => earlier,
            10 => earlier.next_up(),
            11 => f64::from((earlier as f32).next_down()),
            12 => -earlier,
            13 => f64::from(f32::from_bits(self.bytes.arbitrary().unwrap_or(0))),
            14 => f64::from_bits(self.bytes.arbitrary().unwrap_or(0)),
            _ => {
                let special =
                    [0.0, -0.0, 1.0, 1e-45, 1e-38, 3.4e38, -3.4e38, 5e-324, 1e300, 1e-300];
                let extremes = [f64::MAX, f64::MIN, 4_294_967_296.0, 1.0 / 4_294_967_296.0];
                self.choose(&[&special[..], &extremes].concat())
            }
        };
        let number = if number.is_finite() { number } else { 1.0 };
        self.drawn[self.count % 8] = number;
        self.count += 1;
        number
    }

    /// Any f64 at all, NaN included.
    pub fn wild(&mut self) -> f64 {
        match self.byte() % 8 {
            0 => f64::from_bits(self.bytes.arbitrary().unwrap_or(0)),
            1 => f64::NAN,
            2 => f64::INFINITY,
            _ => self.number(0),
        }
    }

    /// A point of finite coordinates.
    pub fn point(&mut self) -> [f64; 3] {
        [0, 1, 2].map(|axis| self.number(axis))
    }

    /// A mesh of a few triangles: any, tetrahedra, or a folded strip.
    pub fn mesh<T: Coordinate>(&mut self) -> TriangleMesh<T> {
        let count = 3 + self.below(14);
        let vertices: Vec<_> = (0..count).map(|_| self.point().map(coordinate::<T>)).collect();
        let index = |draw: &mut Self| draw.below(count) as u32;
        let kind = self.byte() % 4;
        let parts = self.below(if kind < 2 { 24 } else { 6 });
        let triangles: Vec<[u32; 3]> = match kind {
            0 => (0..parts).map(|_| [(); 3].map(|()| index(self))).collect(),
            1 => (0..parts as u32)
                .map(|i| [i, i + 1, i + 2].map(|vertex| vertex % count as u32))
                .collect(),
            _ => (0..=parts)
                .flat_map(|_| {
                    let [a, b, c, d] = [(); 4].map(|()| index(self));
                    [[a, c, b], [a, b, d], [a, d, c], [b, c, d]]
                })
                .collect(),
        };
        TriangleMesh::new(vertices, triangles).expect("finite vertices, and indices of them")
    }

    /// A point of the mesh, or near it, or elsewhere.
    pub fn aim<T: Coordinate>(&mut self, mesh: &TriangleMesh<T>) -> [f64; 3] {
        let count = mesh.triangles().len();
        if count == 0 {
            return self.point();
        }
        let corners = mesh.corners(self.below(count) as u32).map(|p| p.map(T::to_f64));
        let kind = self.byte();
        let [a, b, c] = [0, 1, 2].map(|i| corners[(i + usize::from(kind >> 5)) % 3]);
        match kind % 8 {
            0 => a,
            1 => std::array::from_fn(|k| 0.5 * a[k] + 0.5 * b[k]),
            2 => std::array::from_fn(|k| 0.25 * a[k] + 0.25 * b[k] + 0.5 * c[k]),
            3 => {
                let mut beside = a;
                let axis = usize::from(kind >> 3) % 3;
                beside[axis] = beside[axis].next_up().min(f64::MAX);
                beside
            }
            4 => {
                let mut there = self.point();
                let axis = usize::from(kind >> 3) % 3;
                there[axis] = a[axis];
                there
            }
            _ => self.point(),
        }
    }

    /// A ray, most often to or from the mesh.
    pub fn ray<T: Coordinate>(&mut self, mesh: &TriangleMesh<T>) -> Ray {
        let origin = self.aim(mesh);
        let kind = self.byte();
        let mut ray = match kind % 8 {
            0 => Ray::new(origin, self.point()),
            1 | 2 => {
                let mut direction = [0.0; 3];
                direction[usize::from(kind >> 3) % 3] = if kind >> 7 == 0 { 1.0 } else { -1.0 };
                Ray::new(origin, direction)
            }
            3 => Ray::new(origin, [(); 3].map(|()| self.wild())),
            _ => Ray::through(origin, self.aim(mesh)),
        };
        match self.byte() % 8 {
            0 => ray = ray.with_interval(self.number(0), self.number(0)),
            1 => ray = ray.with_interval(self.wild(), self.wild()),
            2 => ray = ray.with_interval(f64::NEG_INFINITY, f64::INFINITY),
            3 => ray = ray.with_interval(0.0, 1.0),
            _ => {}
        }
        ray
    }

    /// Options for a build: those of a preset, or any, also such as are refused.
    pub fn options(&mut self) -> BuildOptions {
        let preset = self.below(6);
        if let Some(&preset) = Preset::ALL.get(preset) {
            return BuildOptions::preset(preset);
        }
        let strategy = self.choose(&Strategy::ALL);
        let mut options = BuildOptions::for_strategy(strategy);
        options.sah_builder = match self.byte() % 3 {
            0 => SahBuilder::Sweep,
            1 => SahBuilder::Naive,
            _ => SahBuilder::Binned { sweep_below: self.below(64) },
        };
        options.leaf_size = self.below(16);
        options.prune = self.bit();
        options.max_depth = self.bit().then(|| self.below(256));
        options.memory_limit = (self.byte() == 255).then(|| self.word() as u64);
        options.cost = self.cost();
        options
    }

    fn cost(&mut self) -> CostModel {
        let mut cost =
            self.choose(&[CostModel::default(), CostModel::LECTURE, CostModel::BLOCKS_OF_8]);
        if self.byte() % 4 == 3 {
            let [traversal, intersection, leaf] = [(); 3].map(|()| self.wild());
            (cost.traversal, cost.intersection, cost.leaf) = (traversal, intersection, leaf);
            cost.empty_bonus = f64::from(self.byte()) / 255.0;
            cost.block = self.choose(&[1, 2, 8, 8, 8, 8, 16, 1 << 40, 3]);
        }
        if self.byte() % 4 == 3 {
            cost.termination = Termination::LimitsOnly;
        }
        cost
    }
}

/// The finite number next to x.
fn coordinate<T: Coordinate>(x: f64) -> T {
    let x = if T::FITS_TREE { x.clamp(f32::MIN.into(), f32::MAX.into()) } else { x };
    T::from_f64(x)
}
