//! Wrong answers, counted by what is wrong with them.

use kdray::query::InstancedSceneError;
use std::fmt::Debug;

/// How many answers are wrong, by what is wrong with them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    /// How many rays were looked at.
    pub rays: u64,
    /// Of these, how many cross the mesh at all.
    pub crossing: u64,
    /// How many meet an edge or a vertex, or nearly: so that rational arithmetic decided.
    pub close: u64,
    /// The most triangles that one of them touches.
    pub deepest: u64,
    /// How many were compared with rational arithmetic in all numbers.
    pub oracle: u64,
    /// How many answers about them were those of packets, which leave others to the kernels of single rays.
    pub packets: u64,
    /// How many were rays at copies.
    pub copied: u64,
    /// Hits that are not in a list, or rays that hit something and are said not to.
    pub lost: u64,
    /// Hits that are none, or rays that hit nothing and are said to.
    pub phantom: u64,
    /// Rays whose number of crossings, or its parity, is wrong.
    pub miscounted: u64,
    /// Hits that stand before a nearer one.
    pub disordered: u64,
    /// Hits that stand in a list twice.
    pub duplicate: u64,
    /// Hits whose t, u, v or side are wrong.
    pub numbers: u64,
    /// Answers of other kernels that are not the same to the last bit.
    pub differing: u64,
    /// How many points were asked about.
    pub points: u64,
    /// Wrong answers about points.
    pub misjudged: u64,
    /// How many tree files were read, nearly all of them damaged.
    pub files: u64,
    /// Damaged files that were not refused, and whole ones that were or answered otherwise.
    pub misread: u64,
    /// The first thing that was wrong, in words.
    pub example: Option<String>,
}

impl Tally {
    /// Of copies that cannot be had, though there is nothing wrong with them.
    pub(super) fn refused(error: &InstancedSceneError) -> Self {
        Self { differing: 1, example: Some(format!("copies: {error}")), ..Self::default() }
    }

    /// How much is wrong.
    pub fn errors(&self) -> u64 {
        self.by_kind().iter().sum()
    }

    /// The errors, each kind on its own.
    pub fn by_kind(&self) -> [u64; 9] {
        [
            self.lost,
            self.phantom,
            self.miscounted,
            self.disordered,
            self.duplicate,
            self.numbers,
            self.differing,
            self.misjudged,
            self.misread,
        ]
    }

    /// Both together.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        Self {
            rays: self.rays + other.rays,
            crossing: self.crossing + other.crossing,
            close: self.close + other.close,
            deepest: self.deepest.max(other.deepest),
            oracle: self.oracle + other.oracle,
            packets: self.packets + other.packets,
            copied: self.copied + other.copied,
            lost: self.lost + other.lost,
            phantom: self.phantom + other.phantom,
            miscounted: self.miscounted + other.miscounted,
            disordered: self.disordered + other.disordered,
            duplicate: self.duplicate + other.duplicate,
            numbers: self.numbers + other.numbers,
            differing: self.differing + other.differing,
            points: self.points + other.points,
            misjudged: self.misjudged + other.misjudged,
            files: self.files + other.files,
            misread: self.misread + other.misread,
            example: self.example.or(other.example),
        }
    }

    /// Notes what is wrong, if it is the first.
    pub(super) fn tell(&mut self, about: &impl Debug, what: impl FnOnce() -> String) {
        self.example.get_or_insert_with(|| format!("{about:?}: {}", what()));
    }
}
