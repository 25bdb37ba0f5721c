//! Copies of a mesh, against one mesh of all their triangles: placed by matrices that round nothing.
//!
//! Axes change places and signs, sizes are powers of two, and offsets such that every corner of the copy is a number.
//! Of the rays only those count that are carried into each copy without rounding.

use super::aim::Gunner;
use super::answers::Walked;
use super::points_truth::is_difference_exact;
use super::verdict::judge_hits;
use super::{Tally, Target, Truth};
use crate::flat::Flat;
use crate::meshes::{Soup, mesh};
use kdray::{BuildOptions, Hit, Instance, InstanceHit, InstancedScene, Ray, Scene};
use rand::RngExt;
use rand::seq::SliceRandom;
use rand_pcg::Pcg64Mcg;

/// How many copies there are.
const COPIES: usize = 4;

/// Meshes of more triangles are not copied.
pub const FEW: usize = 2000;

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

    fn corner(&self, p: [f32; 3]) -> [f64; 3] {
        [0, 1, 2].map(|k| f64::from(p[self.from[k]]) * self.by[k] + self.offset[k])
    }

    /// The copy of a mesh, if it rounds nothing.
    fn copy(&self, soup: &Soup) -> Option<Soup> {
        let corner = |&p: &[f32; 3]| {
            let exact = self.corner(p);
            let is_number = |k: usize| {
                let back = exact[k] - self.offset[k];
                f64::from(exact[k] as f32) == exact[k]
                    && back == f64::from(p[self.from[k]]) * self.by[k]
            };
            (0..3).all(is_number).then(|| exact.map(|x| x as f32))
        };
        soup.iter()
            .map(|[a, b, c]| Some([corner(a)?, corner(b)?, corner(c)?]))
            .collect::<Option<Soup>>()
    }

    /// The ray as the mesh sees it, if that rounds nothing.
    fn carried(&self, ray: &Ray) -> Option<Ray> {
        let is_exact = (0..3).all(|k| is_difference_exact(ray.origin[k], self.offset[k]));
        let mut carried = *ray;
        for k in 0..3 {
            carried.origin[self.from[k]] = (ray.origin[k] - self.offset[k]) / self.by[k];
            carried.direction[self.from[k]] = ray.direction[k] / self.by[k];
        }
        is_exact.then_some(carried)
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
pub struct Copies<'a> {
    flat: &'a Flat,
    triangles: u32,
    placings: Vec<Placing>,
    scene: InstancedScene,
    all: Target,
}

impl<'a> Copies<'a> {
    /// Copies of the mesh of `scene`; `None` if there are none that round nothing, or too many triangles.
    pub fn new(scene: &Scene, flat: &'a Flat, random: &mut Pcg64Mcg) -> Option<Self> {
        let mesh_of_one = scene.mesh();
        let triangles = mesh_of_one.triangles().len() as u32;
        let soup: Soup = (0..triangles).map(|id| mesh_of_one.corners(id)).collect();
        let largest =
            soup.as_flattened().as_flattened().iter().fold(0.0_f32, |m, x| m.max(x.abs()));
        let is_ordinary = (1e-30..1e30).contains(&largest);
        if triangles as usize > FEW || !is_ordinary {
            return None;
        }
        let (mut placings, mut all) = (Vec::new(), Soup::new());
        for _ in 0..20 * COPIES {
            let mut placing = Placing::random(largest.into(), random);
            // Few meshes can be moved; all can be turned.
            if random.random() {
                placing.offset = [0.0; 3];
            }
            if placings.len() < COPIES
                && let Some(copy) = placing.copy(&soup)
            {
                placings.push(placing);
                all.extend(copy);
            }
        }
        let instances = placings.iter().enumerate().map(|(index, it)| it.instance(1 << index));
        let copies = InstancedScene::build(vec![scene.clone()], instances.collect()).ok()?;
        let all = Target::new("copies", mesh(all));
        Some(Self { flat, triangles, placings, scene: copies, all })
    }

    /// Shoots as many volleys at the copies that a mask shows.
    pub fn attack(&self, volleys: u64, random: &mut Pcg64Mcg) -> Tally {
        let mut tally = Tally::default();
        let flat = Flat::new(&self.all.mesh);
        let Ok(scene) = Scene::build(self.all.mesh.clone(), &BuildOptions::default()) else {
            return tally;
        };
        let gunner = Gunner::new(&self.all, &flat, random.random());
        for _ in 0..volleys {
            let mask = if random.random() { u32::MAX } else { random.random_range(0..1 << COPIES) };
            let copies = self.scene.clone().with_mask(mask);
            let volley = gunner.volley(random.random_range(0..1 << 20), &scene);
            for ray in &volley.rays {
                if let Some(truth) = self.truth(&flat, ray, mask) {
                    judge_hits(&mut tally, ray, &truth, &self.walked(&copies, ray));
                }
            }
        }
        tally
    }

    /// What is touched is so wherever axes point; what is crossed depends on how the ray is moved, which is done
    /// in the space of each copy.
    fn truth(&self, flat: &Flat, ray: &Ray, mask: u32) -> Option<Truth> {
        let is_seen = |copy: u32| mask >> copy & 1 == 1;
        let mut truth = Truth::of_those(flat, ray, |id| is_seen(id / self.triangles));
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

    fn walked(&self, copies: &InstancedScene, ray: &Ray) -> Walked {
        let as_of_all = |found: InstanceHit| {
            let primitive_id = found.instance_id * self.triangles + found.hit.primitive_id;
            Hit { primitive_id, ..found.hit }
        };
        Walked {
            closest: copies.closest_hit(ray).map(as_of_all),
            any: copies.any_hit(ray),
            crossed: copies.all_hits(ray).map(as_of_all).collect(),
            touched: copies.all_touched(ray).map(as_of_all).collect(),
            count: copies.count(ray),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::meshes::{boxes, torus};
    use crate::rays::random;

    /// Shoots at copies of which one is placed elsewhere than it should be, by `wrong`.
    fn errors(mesh: kdray::TriangleMesh, wrong: f64) -> Tally {
        let scene = Scene::build(mesh, &BuildOptions::default()).unwrap();
        let flat = Flat::new(scene.mesh());
        let mut random = random(4);
        let mut copies = Copies::new(&scene, &flat, &mut random).expect("they are small");
        assert_eq!(copies.placings.len(), COPIES);
        let mut instances = copies.scene.instances().to_vec();
        instances[1].to_world[0][3] += wrong;
        copies.scene = InstancedScene::build(vec![scene.clone()], instances).unwrap();
        copies.attack(8, &mut random)
    }

    #[test]
    fn copies_are_hit_where_they_are() {
        for mesh in [mesh(boxes(2)), torus(8, 6)] {
            let right = errors(mesh.clone(), 0.0);
            assert_eq!(right.errors(), 0, "{right:?}");
            assert!(right.crossing > 100, "{right:?}");
            let wrong = errors(mesh, 1e-6);
            assert!(wrong.errors() > 10, "{wrong:?}");
        }
    }
}
