//! The steps of a packet as JSON.

use super::{table::AXES, tile::TileTrace, tile_table::frusta};
use kdray::traverse::{Frustum, PacketDecision, PacketStep};
use serde_json::{Value, json};

/// The steps for programs.
pub(super) fn json(it: &TileTrace<'_>) -> Value {
    let bounds = it.scene.tree().bounds();
    let (packet, single) = (&it.counters, &it.single);
    json!({
        "tile": { "at": it.tile.at, "size": it.tile.size },
        "bounds": (!bounds.is_empty()).then(|| json!({ "min": bounds.min, "max": bounds.max })),
        "frusta": frusta(it).map(frustum_json).collect::<Vec<_>>(),
        "steps": it.steps.iter().filter_map(step_json).collect::<Vec<_>>(),
        "together": {
            "node_decisions": packet.decisions,
            "leaves": packet.leaves,
            "culled": packet.culled,
            "triangle_set_ups": packet.set_ups,
            "ray_tests": packet.tests,
            "rays_left": packet.left,
        },
        "one_by_one": {
            "node_decisions": single.splits,
            "leaves": single.leaves,
            "ray_tests": single.primitives,
        },
        "rays": it.rays.len(),
        "hits": it.hits.iter().flatten().count(),
    })
}

fn frustum_json(frustum: &Frustum) -> Value {
    let corners = frustum.corner_rays();
    let corner = |ray: &kdray::Ray| json!({ "origin": ray.origin, "direction": ray.direction });
    json!({
        "axis": AXES[frustum.axis()],
        "t_near": frustum.depths().t_min,
        "t_far": frustum.depths().t_max,
        "corner_rays": corners.iter().map(corner).collect::<Vec<_>>(),
    })
}

fn step_json(step: &PacketStep) -> Option<Value> {
    Some(match step {
        PacketStep::Packet(_) | PacketStep::Frustum(_) => return None,
        PacketStep::Split(it) => json!({
            "step": "split",
            "node": it.node,
            "axis": AXES[it.axis],
            "split": it.split,
            "t_near": it.t_near,
            "t_far": it.t_far,
            "decision": match it.decision() {
                PacketDecision::Neither => "neither",
                PacketDecision::Near => "near",
                PacketDecision::Far => "far",
                PacketDecision::Both => "both",
            },
            "frusta": it.lanes.lanes().collect::<Vec<_>>(),
            "near_frusta": it.near_lanes.lanes().collect::<Vec<_>>(),
            "far_frusta": it.far_lanes.lanes().collect::<Vec<_>>(),
            "near_child": it.near_child,
            "far_child": it.far_child,
            "stack_depth": it.stack_depth,
        }),
        PacketStep::Leaf(it) => json!({
            "step": "leaf",
            "node": it.node,
            "t_near": it.t_near,
            "t_far": it.t_far,
            "frusta": it.lanes.lanes().collect::<Vec<_>>(),
            "triangles": it.primitives,
            "stack_depth": it.stack_depth,
        }),
        PacketStep::Culled(id) => json!({ "step": "cull", "triangle": id }),
        PacketStep::SetUp(id) => json!({ "step": "set_up", "triangle": id }),
        PacketStep::Test { id, ray, t } => {
            json!({ "step": "test", "triangle": id, "ray": ray, "t": t })
        }
        PacketStep::Pop { node, t_near } => {
            json!({ "step": "pop", "node": node, "t_near": t_near })
        }
        PacketStep::Dropped(node) => json!({ "step": "drop", "node": node }),
        PacketStep::Left(ray) => json!({ "step": "left", "ray": ray }),
    })
}
