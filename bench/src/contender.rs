//! What a contender is: it builds a structure over triangles, and traces sets of rays through it.
//!
//! Dynamic dispatch happens once per set: the loop over the rays is the contender's own code.

use crate::error::BenchError;
use crate::rays::{Question, Ray, RaySet};
use crate::workers::Workers;
use kdray::TriangleMesh;

/// A closest hit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Found {
    /// The ray's parameter.
    pub(crate) t: f32,
    /// The triangle; `u32::MAX` for no hit.
    pub(crate) id: u32,
}

impl Found {
    /// No hit.
    pub(crate) const MISS: Self = Self { t: f32::INFINITY, id: u32::MAX };

    /// Whether it is a hit.
    pub(crate) fn is_hit(&self) -> bool {
        self.id != u32::MAX
    }
}

/// The answers to a set of rays, in its order. Written within the measured time.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Answers {
    /// The closest hits.
    Closest(Vec<Found>),
    /// Whether there is any hit.
    Any(Vec<bool>),
}

impl Answers {
    /// Room for the answers to `count` rays.
    pub(crate) fn room(question: Question, count: usize) -> Self {
        match question {
            Question::Closest => Self::Closest(vec![Found::MISS; count]),
            Question::Any => Self::Any(vec![false; count]),
        }
    }
}

/// Someone who takes part.
pub(crate) trait Contender {
    /// What its structure is called.
    fn name(&self) -> &'static str;

    /// The ways it has to trace rays through one structure, each of which is measured; their names
    /// come behind that of the structure.
    fn kernels(&self) -> &'static [&'static str] {
        &[""]
    }

    /// On how many threads it can build.
    fn builds_on(&self) -> Threads {
        Threads::Chosen
    }

    /// Whether it has a query for any hit of its own, and none that the bench made of its test of triangles: by that
    /// it is timed, but not judged.
    fn has_any_hit(&self) -> bool {
        true
    }

    /// Builds the structure on `workers`.
    fn build<'a>(
        &self,
        mesh: &'a TriangleMesh,
        workers: &Workers,
    ) -> Result<Box<dyn Built + 'a>, BenchError>;
}

/// Who chooses the number of threads of a build.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Threads {
    /// The caller.
    Chosen,
    /// It is always one.
    One,
    /// The contender takes all processors.
    All,
}

/// How many bytes kd-trees take, without what else is kept for queries.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct TreeBytes {
    /// The canonical tree: nodes and references, without the triangles.
    pub(crate) canonical: Option<usize>,
    /// The wide tree, which has the triangles in its blocks.
    pub(crate) wide: Option<usize>,
}

/// A structure, ready for rays.
pub(crate) trait Built: Send {
    /// How many bytes it takes, if the allocator of Rust code does not see them.
    fn own_bytes(&self) -> Option<usize> {
        None
    }

    /// How many bytes the trees of kdray take.
    fn trees(&self) -> TreeBytes {
        TreeBytes::default()
    }

    /// Puts rays into the kernel's own format, which is not measured. `None` if this kernel does
    /// not trace this set.
    fn prepare<'a>(&'a self, kernel: &str, job: &Job<'_>) -> Option<Box<dyn Trace + 'a>>;
}

/// A set of rays to prepare for.
pub(crate) struct Job<'a> {
    /// The rays, all of a set or a sample.
    pub(crate) set: &'a RaySet,
    /// All primary rays, which the set's parents are indices into: a kernel may find their hits
    /// while it prepares, and start each ray with what it kept of its parent's.
    pub(crate) primary: &'a RaySet,
}

/// Rays ready to be traced.
pub(crate) trait Trace {
    /// Traces all rays once and writes the answers. This is what is measured.
    fn trace(&mut self, answers: &mut Answers);
}

/// Rays in the format `R`, traced one by one.
struct OneByOne<R, C, A> {
    rays: Vec<R>,
    closest: C,
    any: A,
}

impl<R, C: Fn(&R) -> Found, A: Fn(&R) -> bool> Trace for OneByOne<R, C, A> {
    fn trace(&mut self, answers: &mut Answers) {
        match answers {
            Answers::Closest(found) => {
                for (found, ray) in found.iter_mut().zip(&self.rays) {
                    *found = (self.closest)(ray);
                }
            }
            Answers::Any(found) => {
                for (found, ray) in found.iter_mut().zip(&self.rays) {
                    *found = (self.any)(ray);
                }
            }
        }
    }
}

/// Traces rays one by one: `convert` puts each into the contender's format, `closest` and `any`
/// answer it.
pub(crate) fn one_by_one<'a, R: 'a>(
    job: &Job<'_>,
    convert: impl Fn(&Ray) -> R,
    closest: impl Fn(&R) -> Found + 'a,
    any: impl Fn(&R) -> bool + 'a,
) -> Option<Box<dyn Trace + 'a>> {
    let rays = job.set.rays.iter().map(convert).collect();
    Some(Box::new(OneByOne { rays, closest, any }))
}

/// The full name of a kernel.
pub(crate) fn full_name(contender: &dyn Contender, kernel: &str) -> String {
    format!("{} {kernel}", contender.name()).trim_end().to_owned()
}
