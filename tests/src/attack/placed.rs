//! Copies of a mesh, against one mesh of all their triangles: placed by matrices that round nothing.
//!
//! Axes change places and signs, sizes are powers of two, and offsets such that every corner of the copy is a number.
//! Of the rays only those count that are carried into each copy without rounding.

use super::aim::Gunner;
use super::answers::Walked;
use super::points_truth::is_difference_exact;
use super::verdict::judge_hits;
use super::{FEW, Tally, Target, Truth};
use crate::flat::Flat;
use crate::meshes::{Soup, mesh};
use kdray::query::InstancedSceneError;
use kdray::{
    BuildOptions, Coordinate, Hit, Instance, InstanceHit, InstancedScene, Precision, Ray, Scene,
    Side,
};
use rand::RngExt;
use rand::seq::SliceRandom;
use rand_pcg::Pcg64Mcg;

/// How many copies there are.
const COPIES: usize = 4;

/// Where a copy is: its axis k is the axis `from[k]` of the mesh times `by[k]`, and `offset[k]` is added.
#[derive(Clone, Copy, Debug)]
struct Placing {
    from: [usize; 3],
    by: [f64; 3],
    offset: [f64; 3],
}

impl Placing {
    fn random(largest: f64, random: &mut Pcg64Mcg) -> Self {
        let mut from = [0, 1, 2];
        from.shuffle(random);
        let size = 2.0_f64.powi(random.random_range(-2..=2));
        let by = [0; 3].map(|_| if random.random() { size } else { -size });
        let step = 2.0_f64.powf(largest.log2().ceil());
        let offset = [0; 3].map(|_| step * f64::from(random.random_range(-3..=3)));
        Self { from, by, offset }
    }

    /// A corner of the copy, if it rounds nothing.
    fn corner<T: Coordinate>(&self, p: [T; 3]) -> Option<[T; 3]> {
        let coordinate = |k: usize| {
            let (x, by, offset) = (p[self.from[k]].to_f64(), self.by[k], self.offset[k]);
            let there = T::from_f64(x * by + offset);
            let is_exact = x * by / by == x
                && is_difference_exact(x * by, -offset)
                && there.to_f64() == x * by + offset;
            is_exact.then_some(there)
        };
        Some([coordinate(0)?, coordinate(1)?, coordinate(2)?])
    }

    /// The copy of a mesh, if it rounds nothing.
    fn copy<T: Coordinate>(&self, soup: &Soup<T>) -> Option<Soup<T>> {
        let triangle =
            |&[a, b, c]: &[[T; 3]; 3]| Some([self.corner(a)?, self.corner(b)?, self.corner(c)?]);
        soup.iter().map(triangle).collect()
    }

    /// The ray as the mesh sees it, if that rounds nothing.
    fn carried(&self, ray: &Ray) -> Option<Ray> {
        let mut carried = *ray;
        let mut is_exact = true;
        for k in 0..3 {
            let (way, d, by) = (ray.origin[k] - self.offset[k], ray.direction[k], self.by[k]);
            is_exact &= is_difference_exact(ray.origin[k], self.offset[k]);
            is_exact &= way / by * by == way && d / by * by == d;
            carried.origin[self.from[k]] = way / by;
            carried.direction[self.from[k]] = d / by;
        }
        is_exact.then_some(carried)
    }

    /// Whether left and right change places.
    fn is_mirrored(&self) -> bool {
        let [i, j, k] = self.from;
        let turns_over = (i > j) ^ (j > k) ^ (i > k);
        self.by.iter().fold(turns_over, |is_mirrored, by| is_mirrored ^ (*by < 0.0))
    }

    fn instance(&self, mask: u32) -> Instance {
        let row = |k: usize| {
            let mut row = [0.0, 0.0, 0.0, self.offset[k]];
            row[self.from[k]] = self.by[k];
            row
        };
        Instance::of(0).placed([row(0), row(1), row(2)]).masked(mask)
    }
}

/// Copies of a target, and the mesh of all their triangles.
pub struct Copies<'a, T: 'static = f32> {
    flat: &'a Flat<T>,
    triangles: u32,
    placings: Vec<Placing>,
    scene: InstancedScene<T>,
    all: Target<T>,
    /// Of all triangles, to aim by.
    scene_of_all: Scene<T>,
}

impl<'a, T: Precision> Copies<'a, T> {
    /// Copies of the mesh of `scene`; `None` if there are none that round nothing, or too many triangles.
    ///
    /// # Errors
    /// If kdray refuses what there is no reason to refuse.
    pub fn new(
        scene: &Scene<T>,
        flat: &'a Flat<T>,
        random: &mut Pcg64Mcg,
    ) -> Result<Option<Self>, InstancedSceneError> {
        let mesh_of_one = scene.mesh();
        let triangles = mesh_of_one.triangles().len() as u32;
        if triangles as usize > FEW {
            return Ok(None);
        }
        let soup: Soup<T> = (0..triangles).map(|id| mesh_of_one.corners(id)).collect();
        let (placings, all) = placed(&soup, random);
        let instances = placings.iter().enumerate().map(|(index, it)| it.instance(1 << index));
        let copies = InstancedScene::build(vec![scene.clone()], instances.collect())?;
        let all = Target::new("copies", mesh(all));
        let scene_of_all = Scene::build(all.mesh.clone(), &BuildOptions::default())?;
        let has_some = !placings.is_empty();
        let copies = Self { flat, triangles, placings, scene: copies, all, scene_of_all };
        Ok(has_some.then_some(copies))
    }

    /// Shoots as many volleys at the copies that a mask shows.
    pub fn attack(&self, volleys: u64, random: &mut Pcg64Mcg) -> Tally {
        let mut tally = Tally::default();
        let flat = Flat::new(&self.all.mesh);
        let gunner = Gunner::new(&self.all, &flat, random.random());
        for _ in 0..volleys {
            let mask = if random.random() { u32::MAX } else { random.random_range(0..1 << COPIES) };
            let copies = self.scene.clone().with_mask(mask);
            let volley = gunner.volley(random.random_range(0..1 << 20), &self.scene_of_all);
            for ray in &volley.rays {
                if let Some(truth) = self.truth(&flat, ray, mask) {
                    let walked = self.walked(&copies, ray);
                    tally.copied += 1;
                    judge_hits(&mut tally, ray, &truth, &walked);
                    self.judge_the_rest(&mut tally, &copies, ray, &walked);
                }
            }
        }
        tally
    }

    /// What is touched is so wherever axes point; what is crossed depends on how the ray is moved, which is done
    /// in the space of each copy.
    fn truth(&self, flat: &Flat<T>, ray: &Ray, mask: u32) -> Option<Truth> {
        let is_seen = |copy: u32| mask >> copy & 1 == 1;
        let mut truth = Truth::of_those(flat, ray, |id| is_seen(id / self.triangles));
        // The side of a hit is that of the mesh.
        for hit in &mut truth.touched {
            if self.placings[(hit.id / self.triangles) as usize].is_mirrored() {
                hit.side = match hit.side {
                    Side::Front => Side::Back,
                    Side::Back => Side::Front,
                };
            }
        }
        truth.crossed.clear();
        for (copy, placing) in (0..).zip(&self.placings) {
            let carried = placing.carried(ray)?;
            if is_seen(copy) {
                let crossed = Truth::of(self.flat, &carried).crossed.into_iter();
                truth.crossed.extend(crossed.map(|mut hit| {
                    hit.id += copy * self.triangles;
                    hit
                }));
            }
        }
        Some(truth)
    }

    /// The other forms of the same answers, which go by the kernels: how many hits, all at once, and batches.
    fn judge_the_rest(
        &self,
        tally: &mut Tally,
        copies: &InstancedScene<T>,
        ray: &Ray,
        walked: &Walked,
    ) {
        if walked.count != walked.crossed.len() {
            tally.miscounted += 1;
            tally.tell(ray, || format!("count is {} of {:?}", walked.count, walked.crossed));
        }
        let mut at_once = Vec::new();
        copies.all_hits_into(ray, &mut at_once);
        let (mut closest, mut any) = ([None], [false]);
        copies.closest_hits(&[*ray], &mut closest);
        copies.any_hits(&[*ray], &mut any);
        let is_same =
            at_once.into_iter().map(|it| self.as_of_all(it)).eq(walked.crossed.iter().copied())
                && closest[0].map(|it| self.as_of_all(it)) == walked.closest
                && any[0] == walked.any
                && walked.closest == walked.touched.first().copied();
        if !is_same {
            tally.differing += 1;
            tally.tell(ray, || format!("at once, or in a batch, other than {walked:?}"));
        }
    }

    fn as_of_all(&self, found: InstanceHit) -> Hit {
        let primitive_id = found.instance_id * self.triangles + found.hit.primitive_id;
        Hit { primitive_id, ..found.hit }
    }

    fn walked(&self, copies: &InstancedScene<T>, ray: &Ray) -> Walked {
        let as_of_all = |found| self.as_of_all(found);
        Walked {
            closest: copies.closest_hit(ray).map(as_of_all),
            any: copies.any_hit(ray),
            crossed: copies.all_hits(ray).map(as_of_all).collect(),
            touched: copies.all_touched(ray).map(as_of_all).collect(),
            count: copies.count(ray),
        }
    }
}

/// Where copies are that round nothing, and the triangles of all of them.
fn placed<T: Coordinate>(soup: &Soup<T>, random: &mut Pcg64Mcg) -> (Vec<Placing>, Soup<T>) {
    let coordinates = soup.as_flattened().as_flattened().iter();
    let largest = coordinates.fold(0.0_f64, |most, x| most.max(x.to_f64().abs()));
    let (mut placings, mut all) = (Vec::new(), Soup::new());
    for _ in 0..20 * COPIES {
        let mut placing = Placing::random(largest, random);
        // Few meshes can be moved; all can be turned.
        if random.random() {
            placing.offset = [0.0; 3];
        }
        if placings.len() < COPIES
            && let Some(copy) = placing.copy(soup)
        {
            placings.push(placing);
            all.extend(copy);
        }
    }
    (placings, all)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::meshes::{self, boxes, moved, torus};
    use crate::rays::random;
    use kdray::TriangleMesh;

    /// Shoots at copies of which one is placed elsewhere than it should be, by `wrong`.
    fn errors<T: Precision>(mesh: TriangleMesh<T>, wrong: f64) -> Tally {
        let scene = Scene::build(mesh, &BuildOptions::default()).unwrap();
        let flat = Flat::new(scene.mesh());
        let mut random = random(4);
        let copies = Copies::new(&scene, &flat, &mut random).unwrap();
        let mut copies = copies.expect("they are small");
        assert_eq!(copies.placings.len(), COPIES);
        let mut instances = copies.scene.instances().to_vec();
        instances[1].to_world[0][3] += wrong;
        copies.scene = InstancedScene::build(vec![scene.clone()], instances).unwrap();
        copies.attack(8, &mut random)
    }

    fn are_hit_where_they_are<T: Precision>(mesh: TriangleMesh<T>, size: f64) {
        let right = errors(mesh.clone(), 0.0);
        assert_eq!(right.errors(), 0, "{right:?}");
        assert!(right.crossing > 100, "{right:?}");
        let wrong = errors(mesh, 1e-6 * size);
        assert!(wrong.errors() > 10, "{wrong:?}");
    }

    #[test]
    fn copies_are_hit_where_they_are() {
        for mesh in [mesh(boxes(2)), torus(8, 6)] {
            are_hit_where_they_are(mesh, 1.0);
        }
        for size in [1e-300, 1.0, 1e300] {
            are_hit_where_they_are(moved::<f64>(&torus(8, 6), |p| p.map(|x| x * size)), size);
        }
        let utm = meshes::placed(&boxes(2), 1e-3, [691_607.123, 5_334_760.456, 520.789]);
        are_hit_where_they_are(mesh(utm), 1.0);
    }
}
