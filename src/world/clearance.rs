//! Smallest distances between the working arm (with what it holds) and the fixed objects, by exact geometry.

use nalgebra::Point3;
use parry3d_f64::bounding_volume::BoundingVolume;
use parry3d_f64::query;
use rapier3d_f64::prelude::{Aabb, Collider, PhysicsWorld};

use super::convert;
use super::parts::{Limb, Owner, Parts};

/// The smallest distance so far between the arm and one object.
#[derive(Clone, Debug, PartialEq)]
pub struct Clearance {
    /// The nearest part of the arm, or what it holds.
    pub a: String,
    /// The object.
    pub b: String,
    /// The distance; 0 when touching (m). Infinite before the first measurement.
    pub min_distance_m: f64,
    /// When (s).
    pub time_s: f64,
    /// Nearest point on `a` (m, world).
    pub point_a: Point3<f64>,
    /// Nearest point on `b` (m, world).
    pub point_b: Point3<f64>,
}

/// Watches the distances of the fixed objects.
pub(super) struct ClearanceBook {
    /// One entry per watched object.
    pub smallest: Vec<Clearance>,
    objects: Vec<usize>,
    /// Colliders of the arm and of movable objects, and of each watched object.
    arm: Vec<rapier3d_f64::prelude::ColliderHandle>,
    movable: Vec<(usize, rapier3d_f64::prelude::ColliderHandle)>,
    fixed: Vec<Vec<rapier3d_f64::prelude::ColliderHandle>>,
}

impl ClearanceBook {
    /// Watches the objects for which `watched` is true; movable ones are watched as soon as they are held.
    pub(super) fn new(engine: &PhysicsWorld, parts: &Parts, names: &[String], watched: &[bool], movable: &[bool]) -> Self {
        let objects: Vec<usize> = (0..names.len()).filter(|&i| watched[i]).collect();
        let mut book = Self { smallest: Vec::new(), arm: Vec::new(), movable: Vec::new(), fixed: vec![Vec::new(); objects.len()], objects };
        for (handle, collider) in engine.colliders.iter() {
            match parts.of(collider.user_data).map(|(_, part)| part.owner) {
                Some(Owner::Robot { limb: Limb::Working, .. }) => book.arm.push(handle),
                Some(Owner::Object(object)) if movable[object] => book.movable.push((object, handle)),
                Some(Owner::Object(object)) => {
                    if let Some(place) = book.objects.iter().position(|&o| o == object) {
                        book.fixed[place].push(handle);
                    }
                }
                _ => {}
            }
        }
        book.smallest = book
            .objects
            .iter()
            .map(|&o| Clearance {
                a: String::new(),
                b: names[o].clone(),
                min_distance_m: f64::INFINITY,
                time_s: 0.0,
                point_a: Point3::origin(),
                point_b: Point3::origin(),
            })
            .collect();
        book
    }

    /// Measures now. `held` are the objects in the gripper.
    pub(super) fn record(&mut self, engine: &PhysicsWorld, parts: &Parts, held: &[usize], time_s: f64) {
        let moving: Vec<_> =
            self.arm.iter().copied().chain(self.movable.iter().filter(|(o, _)| held.contains(o)).map(|(_, c)| *c)).collect();
        for (place, fixed) in self.fixed.iter().enumerate() {
            for (a, b) in moving.iter().flat_map(|&a| fixed.iter().map(move |&b| (a, b))) {
                let (Some(a), Some(b)) = (engine.colliders.get(a), engine.colliders.get(b)) else { continue };
                let smallest = &mut self.smallest[place];
                if lower_bound(&a.compute_aabb(), &b.compute_aabb()) >= smallest.min_distance_m {
                    continue;
                }
                let Some((distance, point_a, point_b)) = nearest(a, b) else { continue };
                if distance < smallest.min_distance_m {
                    let name = parts.of(a.user_data).map_or_else(String::new, |(_, part)| part.name.clone());
                    *smallest = Clearance { a: name, b: smallest.b.clone(), min_distance_m: distance, time_s, point_a, point_b };
                }
            }
        }
    }
}

/// No two points of the boxes are nearer than this (m).
fn lower_bound(a: &Aabb, b: &Aabb) -> f64 {
    if a.intersects(b) {
        return 0.0;
    }
    let gap = (a.mins - b.maxs).max(b.mins - a.maxs).max(rapier3d_f64::prelude::Vector::ZERO);
    gap.length()
}

/// Distance and nearest points of two colliders (m, world); distance 0 when they touch.
fn nearest(a: &Collider, b: &Collider) -> Option<(f64, Point3<f64>, Point3<f64>)> {
    let contact = query::contact(a.position(), a.shape(), b.position(), b.shape(), f64::MAX).ok()??;
    Some((contact.dist.max(0.0), convert::point_back(contact.point1), convert::point_back(contact.point2)))
}
