//! Part of a set, for contenders that would take too long.

use super::RaySet;

/// How many consecutive rays stay together: a tile of 16 x 16 pixels, as far as they hit.
const RUN: usize = 256;

impl RaySet {
    /// Where the runs of a sample of about `count` rays begin and end: runs of 256 consecutive
    /// rays, spread evenly over the set. The whole set if `count` is not less.
    pub(crate) fn sample_runs(&self, count: usize) -> Vec<std::ops::Range<usize>> {
        let all = self.rays.len();
        if count >= all {
            return std::iter::once(0..all).collect();
        }
        let (runs, wanted) = (all.div_ceil(RUN), count.div_ceil(RUN).max(1));
        let run = |i: usize| {
            let first = i * runs / wanted * RUN;
            first..(first + RUN).min(all)
        };
        (0..wanted).map(run).collect()
    }

    /// The rays of these runs.
    pub(crate) fn sample(&self, runs: &[std::ops::Range<usize>]) -> Self {
        let mut sample = Self { kind: self.kind, rays: Vec::new(), parents: Vec::new() };
        for run in runs {
            sample.rays.extend_from_slice(&self.rays[run.clone()]);
            if !self.parents.is_empty() {
                sample.parents.extend_from_slice(&self.parents[run.clone()]);
            }
        }
        sample
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::terrain;

    #[test]
    fn samples_are_spread_runs() {
        let sets = terrain().2;
        let primary = &sets.sets[0];
        let runs = primary.sample_runs(1000);
        assert_eq!(runs, [0..256, 1024..1280, 2048..2304, 3072..3328]);
        let sample = primary.sample(&runs);
        assert_eq!((sample.rays.len(), sample.rays[256]), (1024, primary.rays[1024]));
        assert_eq!(primary.sample(&primary.sample_runs(usize::MAX)), *primary);
    }

    #[test]
    fn samples_keep_parents() {
        let sets = terrain().2;
        let diffuse = &sets.sets[1];
        let sample = diffuse.sample(&diffuse.sample_runs(300));
        assert_eq!(sample.rays.len(), sample.parents.len());
        assert_eq!(sample.parents[0], diffuse.parents[0]);
    }
}
