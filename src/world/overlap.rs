//! Refuses a scene in which something starts inside something else: the engine would throw it out.

use parry3d_f64::bounding_volume::BoundingVolume;
use rapier3d_f64::prelude::{Collider, PhysicsWorld};

use super::error::{Overlap, WorldError};
use super::gap::Gap;
use super::parts::{Owner, Part, Parts};

/// Penetration from which a scene is refused (m): more than rounding in a file's numbers.
const START_OVERLAP_M: f64 = 1e-4;

/// Looks for overlaps among all parts, also of things that do not move.
///
/// # Errors
/// When there are any: all of them, with their depths.
pub(super) fn refuse(engine: &PhysicsWorld, parts: &Parts) -> Result<(), WorldError> {
    refuse_among(engine, parts, |_| true)
}

/// The same among the parts whose owners count.
///
/// # Errors
/// As [`refuse`].
pub(super) fn refuse_among(engine: &PhysicsWorld, parts: &Parts, counts: impl Fn(Owner) -> bool) -> Result<(), WorldError> {
    let named = engine.colliders.iter().filter_map(|(_, collider)| Some((collider, parts.of(collider.user_data)?.1)));
    let all: Vec<(&Collider, &Part)> = named.filter(|(_, part)| counts(part.owner)).collect();
    let mut pairs: Vec<(&str, &str, f64)> = Vec::new();
    for (i, (a, part_a)) in all.iter().enumerate() {
        for (b, part_b) in &all[i + 1..] {
            // Links that overlap the torso by construction never touch it; everything else must not start inside anything.
            let robots = matches!((part_a.owner, part_b.owner), (Owner::Robot { .. }, Owner::Robot { .. }));
            if together(part_a.owner, part_b.owner) || (robots && !a.collision_groups().test(b.collision_groups())) {
                continue;
            }
            let depth = depth(a, b);
            if depth <= START_OVERLAP_M {
                continue;
            }
            // A part may have several shapes: the deepest one is told.
            match pairs.iter_mut().find(|(a, b, _)| (*a, *b) == (&part_a.name, &part_b.name)) {
                Some((_, _, deepest)) => *deepest = deepest.max(depth),
                None => pairs.push((&part_a.name, &part_b.name, depth)),
            }
        }
    }
    if pairs.is_empty() {
        return Ok(());
    }
    Err(WorldError::Overlap(pairs.into_iter().map(|(a, b, depth_m)| Overlap { a: a.into(), b: b.into(), depth_m }).collect()))
}

/// Whether the parts belong to one limb or one object.
fn together(a: Owner, b: Owner) -> bool {
    match (a, b) {
        (Owner::Robot { limb: a, .. }, Owner::Robot { limb: b, .. }) => a == b,
        (Owner::Object(a), Owner::Object(b)) => a == b,
        _ => false,
    }
}

/// How deep one is in the other (m); 0 when they are apart.
fn depth(a: &Collider, b: &Collider) -> f64 {
    if !a.compute_aabb().intersects(&b.compute_aabb()) {
        return 0.0;
    }
    Gap::between(a.position(), a.shape(), b.position(), b.shape()).map_or(0.0, |gap| gap.depth_m())
}
