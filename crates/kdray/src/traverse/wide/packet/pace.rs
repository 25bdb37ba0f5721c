//! How large packets are, and when rays are better traced alone.

/// What was done for packets.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PacketWork {
    /// Packets that were bounded by a frustum, those that were given up as well.
    pub packets: usize,
    /// Nodes whose children were tested against the bounding frustum.
    pub nodes: usize,
    /// Blocks of eight triangles that were set up.
    pub blocks: usize,
    /// Triangles that the bounding frustum may meet: each was tested against the sub-frusta.
    pub triangles: usize,
    /// Tests of a triangle against eight rays.
    pub tests: usize,
    /// Tests of a triangle against a ray by the scalar test.
    pub exact: usize,
    /// Rays that were left to the kernels of single rays.
    pub left: usize,
}

impl PacketWork {
    /// What the work costs, in cycles as they were measured (docs/decisions/0012).
    pub(super) fn cost(&self) -> usize {
        120 * self.nodes
            + 400 * self.blocks
            + 180 * self.triangles
            + 25 * self.tests
            + 400 * self.exact
    }
}

impl std::ops::AddAssign for PacketWork {
    fn add_assign(&mut self, other: Self) {
        self.packets += other.packets;
        self.nodes += other.nodes;
        self.blocks += other.blocks;
        self.triangles += other.triangles;
        self.tests += other.tests;
        self.exact += other.exact;
        self.left += other.left;
    }
}

/// Sizes of packets, in rays.
const SIZES: [usize; 2] = [64, 512];

/// What a ray costs in a batch, in cycles: for the closest hit, and for any.
const ALONE: [usize; 2] = [700, 400];

/// After so many rays what was not the best way is tried again.
const TRIAL: usize = 8192;

/// Chooses the size of the next packet from what the last ones cost.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pace {
    /// What a ray costs in a batch.
    alone: usize,
    /// A running average of the cost of a ray, by the index of the size; `None` if it was not tried.
    costs: [Option<usize>; SIZES.len()],
    /// How many rays since the last trial.
    since: usize,
}

/// What to do with the next rays.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Plan {
    /// A packet, of the size of that index.
    Packet(usize),
    /// Single rays.
    Alone,
}

impl Plan {
    /// For how many rays it is.
    pub(super) fn size(self) -> usize {
        match self {
            Self::Packet(index) => SIZES[index],
            Self::Alone => SIZES[1],
        }
    }
}

impl Pace {
    /// Before the first packet of a query for any hits, or for the closest.
    pub(super) fn new(any: bool) -> Self {
        Self { alone: ALONE[usize::from(any)], costs: [None; 2], since: 0 }
    }

    /// Small packets first, because a large one in vain costs more; then large ones if small ones pay;
    /// then whatever is best, and now and then what is not.
    pub(super) fn plan(&self) -> Plan {
        let [Some(small), large] = self.costs else { return Plan::Packet(0) };
        let pays = |cost: usize| cost <= self.alone;
        let large_is_best = large.is_none_or(|large| large <= small);
        let is_trial = self.since >= TRIAL;
        if pays(small) && large_is_best != is_trial {
            return Plan::Packet(1);
        }
        let best = large.map_or(small, |large| small.min(large));
        if !pays(best) && !is_trial { Plan::Alone } else { Plan::Packet(0) }
    }

    /// Learns what a plan cost for so many rays.
    pub(super) fn learn(&mut self, plan: Plan, cost: usize, rays: usize) {
        if self.since >= TRIAL {
            self.since = 0;
        }
        self.since += rays;
        if let Plan::Packet(index) = plan {
            let cost = cost / rays.max(1);
            let old = self.costs[index].unwrap_or(cost);
            self.costs[index] = Some((3 * old + cost) / 4);
        }
    }

    /// The cost at which a packet of so many rays is given up. That of a small packet has room: what its
    /// first leaves cost says little.
    pub(super) fn budget(&self, rays: usize) -> usize {
        self.alone * rays.max(SIZES[0]) * 5 / 4
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is planned for so many rays if those packets cost so much a ray.
    fn plans(costs: [usize; 2], rays: usize) -> Vec<Plan> {
        let mut pace = Pace::new(false);
        let (mut plans, mut done) = (Vec::new(), 0);
        while done < rays {
            let plan = pace.plan();
            let cost = if let Plan::Packet(index) = plan { costs[index] } else { 0 };
            pace.learn(plan, cost * plan.size(), plan.size());
            done += plan.size();
            plans.push(plan);
        }
        plans
    }

    #[test]
    fn the_cheaper_size_is_taken_and_the_other_tried_again() {
        let large = plans([100, 50], 100_000);
        assert_eq!(large[..3], [Plan::Packet(0), Plan::Packet(1), Plan::Packet(1)]);
        let small = large.iter().filter(|&&plan| plan == Plan::Packet(0)).count();
        assert!((5..20).contains(&small), "{small}");
        let small = plans([50, 100], 100_000);
        let large = small.iter().filter(|&&plan| plan == Plan::Packet(1)).count();
        assert!((5..20).contains(&large), "{large}");
    }

    #[test]
    fn packets_that_do_not_pay_are_rare() {
        let plans = plans([5000, 5000], 100_000);
        let packets: usize =
            plans.iter().filter(|&&plan| plan != Plan::Alone).map(|plan| plan.size()).sum();
        assert!((64..2000).contains(&packets), "{packets} rays");
        assert!(!plans.contains(&Plan::Packet(1)));
    }
}
