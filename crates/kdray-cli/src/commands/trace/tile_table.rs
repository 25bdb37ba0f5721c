//! The steps of a packet as a table.

use super::table::AXES;
use super::tile::{Tile, TileTrace};
use crate::{
    table::columns,
    wording::{counted, exact, readable},
};
use kdray::traverse::{
    Frustum, LaneMask, PacketDecision, PacketLeafStep, PacketSplitStep, PacketStep,
};

/// What is done, in words.
fn decision_words(decision: PacketDecision) -> &'static str {
    match decision {
        PacketDecision::Neither => "neither: both are left out",
        PacketDecision::Near => "near only: far is left out",
        PacketDecision::Far => "far only: near is left out",
        PacketDecision::Both => "both: near, far waits",
    }
}

/// The steps for people.
pub(super) fn text(it: &TileTrace<'_>) -> String {
    let Tile { at: [x, y], size: [width, height] } = it.tile;
    let rays = counted(it.rays.len(), "ray", "rays");
    let (last_x, last_y) = (x + width - 1, y + height - 1);
    let mut text = format!("tile   pixels {x},{y} to {last_x},{last_y}: {rays}\n");
    let bounds = it.scene.tree().bounds();
    if bounds.is_empty() {
        return text + "box    empty: the scene has no triangles\nno hit\n";
    }
    let frusta: Vec<&Frustum> = frusta(it).collect();
    let Some(first) = frusta.first() else {
        return text + &without_frusta(it);
    };
    let corner = |p: [f32; 3]| p.map(exact).join(", ");
    text += &format!("box    ({}) to ({})\n", corner(bounds.min), corner(bounds.max));
    text += &format!(
        "bound  {} along {}, t is the depth on that axis\n\n",
        counted(frusta.len(), "sub-frustum", "sub-frusta"),
        AXES[first.axis()],
    );
    text += &columns(&rows(&it.steps));
    text += "\nt_near, t_far: where the first sub-frustum enters the node's box and the last one \
             leaves it.\nfrusta: how many are in the node, and how many of them may be in its near \
             and in its far\nchild. waiting: how many nodes are on the stack after the step.\n\n";
    text + &summary(it) + "\n" + &hits(it)
}

/// What came of rays for which nothing was done together.
fn without_frusta(it: &TileTrace<'_>) -> String {
    match it.counters.left {
        0 => "       the rays miss the box\nno hit\n".to_owned(),
        left => format!("bound  none: {left} left to be answered alone\n") + &hits(it),
    }
}

/// What the packet cost, and what its rays cost one by one.
pub(super) fn summary(it: &TileTrace<'_>) -> String {
    let (packet, single) = (&it.counters, &it.single);
    let mut text = format!(
        "together: {}, {} set up, {} culled, {}; one by one: {} node decisions, {} ray tests",
        counted(packet.decisions as usize, "node decision", "node decisions"),
        counted(packet.set_ups as usize, "triangle", "triangles"),
        packet.culled,
        counted(packet.tests as usize, "ray test", "ray tests"),
        single.splits,
        single.primitives,
    );
    if packet.left > 0 {
        text += &format!("; {} left to be answered alone", packet.left);
    }
    text
}

fn hits(it: &TileTrace<'_>) -> String {
    let hit = it.hits.iter().flatten().count();
    format!("{hit} of {} hit; each hit is the one that the ray finds alone\n", it.rays.len())
}

/// The sub-frusta of the packet; none if no ray meets the tree's box.
pub(super) fn frusta<'a>(it: &'a TileTrace<'_>) -> impl Iterator<Item = &'a Frustum> {
    it.steps.iter().filter_map(|step| match step {
        PacketStep::Frustum(frustum) => Some(frustum),
        _ => None,
    })
}

fn rows(steps: &[PacketStep]) -> Vec<Vec<String>> {
    let headings = ["step", "node", "plane", "t_near", "t_far", "frusta", "near", "far", "waiting"];
    let mut rows = vec![headings.map(str::to_owned).to_vec()];
    let mut leaf = LeafTests::default();
    for step in steps {
        match *step {
            PacketStep::Culled(id) => leaf.culled.push(id),
            PacketStep::SetUp(id) => leaf.set_up.push(SetUp { id, tests: 0, hits: 0 }),
            PacketStep::Test { t, .. } => leaf.count_test(t),
            _ => rows.extend(std::mem::take(&mut leaf).rows()),
        }
        match step {
            PacketStep::Split(it) => rows.push(split_row(it)),
            PacketStep::Leaf(it) => {
                leaf.listed = it.primitives;
                rows.push(leaf_row(it));
            }
            PacketStep::Pop { node, t_near } if *node > 0 => rows.push(vec![
                "take from the stack".to_owned(),
                node.to_string(),
                String::new(),
                readable(*t_near),
            ]),
            PacketStep::Dropped(node) => {
                rows.push(vec!["drop: behind the hits of all rays".to_owned(), node.to_string()]);
            }
            _ => {}
        }
    }
    rows.extend(leaf.rows());
    rows
}

/// What was done with the triangles of a leaf.
#[derive(Default)]
struct LeafTests {
    listed: usize,
    culled: Vec<u32>,
    set_up: Vec<SetUp>,
}

struct SetUp {
    id: u32,
    tests: usize,
    hits: usize,
}

impl LeafTests {
    fn count_test(&mut self, t: Option<f64>) {
        if let Some(last) = self.set_up.last_mut() {
            last.tests += 1;
            last.hits += usize::from(t.is_some());
        }
    }

    fn rows(self) -> Vec<Vec<String>> {
        let mut rows = Vec::new();
        let triangles = |count| counted(count, "triangle", "triangles");
        if !self.culled.is_empty() {
            rows.push(vec![format!("  the frusta miss {}", triangles(self.culled.len()))]);
        }
        for SetUp { id, tests, hits } in &self.set_up {
            let rays = counted(*tests, "ray", "rays");
            rows.push(vec![format!("  test triangle {id}: {rays}, {hits} hit")]);
        }
        let met = self.listed.saturating_sub(self.culled.len() + self.set_up.len());
        if met > 0 {
            rows.push(vec![format!("  {} met before", triangles(met))]);
        }
        rows
    }
}

fn split_row(it: &PacketSplitStep) -> Vec<String> {
    let [lanes, near, far] = [it.lanes, it.near_lanes, it.far_lanes].map(LaneMask::count);
    vec![
        decision_words(it.decision()).to_owned(),
        it.node.to_string(),
        format!("{} = {}", AXES[it.axis], exact(it.split)),
        readable(it.t_near),
        readable(it.t_far),
        format!("{lanes}: {near}, {far}"),
        it.near_child.to_string(),
        it.far_child.to_string(),
        it.stack_depth.to_string(),
    ]
}

fn leaf_row(it: &PacketLeafStep) -> Vec<String> {
    vec![
        format!("leaf, {}", counted(it.primitives, "triangle", "triangles")),
        it.node.to_string(),
        String::new(),
        readable(it.t_near),
        readable(it.t_far),
        it.lanes.count().to_string(),
        String::new(),
        String::new(),
        it.stack_depth.to_string(),
    ]
}
