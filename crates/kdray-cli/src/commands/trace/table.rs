//! The steps of a ray as a table and as JSON.

use crate::{
    table::columns,
    wording::{counted, exact, readable},
};
use kdray::{
    Hit, Ray, ShapeScene, Side,
    traverse::{SplitStep, Step, TraversalCase},
};
use serde_json::{Value, json};

pub(super) const AXES: [&str; 3] = ["x", "y", "z"];

/// The case in the lecture's words, and what is done.
fn case_words(step: &SplitStep) -> &'static str {
    match step.case {
        TraversalCase::NearOnly => "t_split > t_far: near only",
        TraversalCase::FarOnly => "t_split < t_near: far only",
        TraversalCase::NearThenFar if step.t_split.is_nan() => "in the plane: near, far waits",
        TraversalCase::NearThenFar => "t_near ≤ t_split ≤ t_far: near, far waits",
    }
}

/// The steps for people; `[origin, direction]` of the ray in words.
pub(super) fn text(
    scene: &ShapeScene,
    ray: &Ray,
    [origin, direction]: &[String; 2],
    steps: &[Step],
    hit: Option<Hit>,
) -> String {
    let mut text = format!("ray    E = ({origin}), D = ({direction})\n");
    let bounds = scene.tree().bounds();
    if bounds.is_empty() {
        return text + "box    empty: the scene has no triangles\nno hit\n";
    }
    let corner = |p: [f32; 3]| p.map(exact).join(", ");
    text += &format!("box    ({}) to ({})\n", corner(bounds.min), corner(bounds.max));
    match steps.first() {
        Some(Step::Root(Some(interval))) => {
            let [t_near, t_far] = [interval.t_min, interval.t_max].map(readable);
            text +=
                &format!("       t_near = {t_near} ≤ t_far = {t_far}: the ray meets the box\n\n");
        }
        _ => return text + "       the ray misses the box\nno hit\n",
    }
    text += &columns(&rows(steps));
    text += "\nt_near, t_far: where the ray enters and leaves the node's box. t_split: where it \
             meets the\nnode's plane. waiting: how many nodes are on the stack after the step.\n\n";
    text + &match hit {
        None => "no hit\n".to_owned(),
        Some(hit) => format!(
            "hit    triangle {} at t = {}, u = {}, v = {}, from the {}\n       point ({})\n",
            hit.primitive_id,
            readable(hit.t),
            readable(hit.u),
            readable(hit.v),
            side(hit.side),
            ray.at(hit.t).map(readable).join(", "),
        ),
    }
}

fn rows(steps: &[Step]) -> Vec<Vec<String>> {
    let headings =
        ["step", "node", "plane", "t_near", "t_split", "t_far", "near", "far", "waiting"];
    let mut rows: Vec<Vec<String>> =
        vec![headings.iter().map(|&heading| heading.to_owned()).collect()];
    let mut missed: Vec<u32> = Vec::new();
    for step in steps {
        if !missed.is_empty() && !matches!(step, Step::Primitive { t: None, .. }) {
            rows.push(vec![misses(&std::mem::take(&mut missed))]);
        }
        match step {
            Step::Root(_) => {}
            Step::Split(it) => rows.push(split_row(it)),
            Step::Leaf(it) => rows.push(row(
                &format!("leaf, {}", counted(it.primitives, "triangle", "triangles")),
                [it.node.to_string(), String::new(), readable(it.t_near), String::new()],
                [readable(it.t_far), String::new(), String::new(), it.stack_depth.to_string()],
            )),
            Step::Primitive { id, t: None } => missed.push(*id),
            Step::Primitive { id, t: Some(t) } => {
                rows.push(vec![format!("  test triangle {id}: t = {}", readable(*t))]);
            }
            Step::Pop { node: 0, .. } => {}
            Step::Pop { node, t_near } => rows.push(row(
                "take from the stack",
                [node.to_string(), String::new(), readable(*t_near), String::new()],
                [const { String::new() }; 4],
            )),
            Step::FinishEarly { t, t_near } => rows.push(vec![format!(
                "end: the hit at t = {} is nearer than what waits, from t = {}",
                readable(*t),
                readable(*t_near)
            )]),
        }
    }
    if !missed.is_empty() {
        rows.push(vec![misses(&missed)]);
    }
    rows
}

/// Triangles that were tested in a row and not hit.
fn misses(ids: &[u32]) -> String {
    let named: Vec<String> = ids.iter().take(5).map(u32::to_string).collect();
    let more = if ids.len() > named.len() { ", …" } else { "" };
    match ids {
        [id] => format!("  test triangle {id}: no"),
        _ => format!("  test {} triangles ({}{more}): no", ids.len(), named.join(", ")),
    }
}

fn split_row(it: &SplitStep) -> Vec<String> {
    let plane = format!("{} = {}", AXES[it.axis], exact(it.split));
    row(
        case_words(it),
        [it.node.to_string(), plane, readable(it.t_near), readable(it.t_split)],
        [
            readable(it.t_far),
            it.near_child.to_string(),
            it.far_child.to_string(),
            it.stack_depth.to_string(),
        ],
    )
}

fn row(what: &str, first: [String; 4], second: [String; 4]) -> Vec<String> {
    std::iter::once(what.to_owned()).chain(first).chain(second).collect()
}

fn side(side: Side) -> &'static str {
    match side {
        Side::Front => "front",
        Side::Back => "back",
    }
}

/// The steps for programs. Numbers that JSON has no words for, such as the t_split of a parallel
/// ray, are null.
pub(super) fn json(scene: &ShapeScene, ray: &Ray, steps: &[Step], hit: Option<Hit>) -> Value {
    let bounds = scene.tree().bounds();
    json!({
        "ray": { "origin": ray.origin, "direction": ray.direction },
        "bounds": (!bounds.is_empty()).then(|| json!({ "min": bounds.min, "max": bounds.max })),
        "steps": steps.iter().map(step_json).collect::<Vec<_>>(),
        "hit": hit.map(|hit| json!({
            "triangle": hit.primitive_id,
            "t": hit.t,
            "u": hit.u,
            "v": hit.v,
            "side": side(hit.side),
            "point": ray.at(hit.t),
        })),
    })
}

fn step_json(step: &Step) -> Value {
    match step {
        Step::Root(None) => json!({ "step": "root", "hit": false }),
        Step::Root(Some(interval)) => {
            let (t_near, t_far) = (interval.t_min, interval.t_max);
            json!({ "step": "root", "hit": true, "t_near": t_near, "t_far": t_far })
        }
        Step::Split(it) => json!({
            "step": "split",
            "node": it.node,
            "axis": AXES[it.axis],
            "split": it.split,
            "t_near": it.t_near,
            "t_split": it.t_split,
            "t_far": it.t_far,
            "case": match it.case {
                TraversalCase::NearOnly => "near_only",
                TraversalCase::NearThenFar => "near_then_far",
                TraversalCase::FarOnly => "far_only",
            },
            "near_child": it.near_child,
            "far_child": it.far_child,
            "stack_depth": it.stack_depth,
        }),
        Step::Leaf(it) => json!({
            "step": "leaf",
            "node": it.node,
            "t_near": it.t_near,
            "t_far": it.t_far,
            "triangles": it.primitives,
            "stack_depth": it.stack_depth,
        }),
        Step::Primitive { id, t } => json!({ "step": "triangle", "triangle": id, "t": t }),
        Step::Pop { node, t_near } => {
            json!({ "step": "pop", "node": node, "t_near": t_near })
        }
        Step::FinishEarly { t, t_near } => json!({ "step": "finish", "t": t, "t_near": t_near }),
    }
}
