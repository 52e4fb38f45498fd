//! Watches distances and touches in the engine from step to step.

use rapier3d_f64::prelude::{ColliderHandle, PhysicsWorld, Pose};

use super::even_motion::Ball;
use super::parts::{Owner, Parts};
use super::proximity::{Motion, ProximityBook, Watched};

/// Watches a world's colliders.
pub(super) struct EngineWatch {
    pub book: ProximityBook,
    handles: Vec<ColliderHandle>,
    balls: Vec<Ball>,
    before: Vec<Pose>,
    after: Vec<Pose>,
    travel_m: Vec<f64>,
}

impl EngineWatch {
    /// Watches everything in the engine that has a name; `names` are the objects', `moving` says which of them can move.
    pub(super) fn new(engine: &PhysicsWorld, parts: &Parts, names: &[String], moving: &[bool]) -> Self {
        let (mut handles, mut groups, mut solids) = (Vec::new(), Vec::new(), Vec::new());
        for (handle, collider) in engine.colliders.iter() {
            let Some((part, about)) = parts.of(collider.user_data) else { continue };
            let name = if let Owner::Object(object) = about.owner { names[object].clone() } else { about.name.clone() };
            solids.push(Watched { part, owner: about.owner, name, shape: collider.shared_shape().clone() });
            groups.push(collider.collision_groups());
            handles.push(handle);
        }
        let balls = solids.iter().map(|solid| Ball::around(&*solid.shape)).collect();
        let book = ProximityBook::new(solids, moving, |a, b| groups[a].test(groups[b]));
        let after: Vec<Pose> = handles.iter().map(|&handle| pose(engine, handle)).collect();
        Self { book, travel_m: vec![0.0; handles.len()], balls, before: after.clone(), after, handles }
    }

    /// Takes everything to have come from where it is, not from where it was when last looked at.
    pub(super) fn look_again(&mut self, engine: &PhysicsWorld) {
        for (after, &handle) in self.after.iter_mut().zip(&self.handles) {
            *after = pose(engine, handle);
        }
    }

    /// Follows the step from `start_s` to `end_s` (s), which the engine has just taken. `held` are the objects in the gripper.
    pub(super) fn follow(&mut self, engine: &PhysicsWorld, held: &[usize], (start_s, end_s): (f64, f64)) {
        let Self { book, handles, balls, before, after, travel_m } = self;
        std::mem::swap(before, after);
        for (i, &handle) in handles.iter().enumerate() {
            after[i] = pose(engine, handle);
            travel_m[i] = balls[i].travel_m(&before[i], &after[i]);
        }
        let pose_at = |i: usize, fraction: f64| match fraction {
            1.0 => after[i],
            _ => balls[i].pose(&before[i], &after[i], fraction),
        };
        book.follow(&Motion { start_s, end_s, travel_m, pose_at: &pose_at, timed_within: false, may_go_on: &|| true }, held);
    }
}

fn pose(engine: &PhysicsWorld, handle: ColliderHandle) -> Pose {
    engine.colliders.get(handle).map_or(Pose::IDENTITY, |collider| *collider.position())
}

#[cfg(test)]
mod tests {
    use rapier3d_f64::prelude::{ColliderBuilder, RigidBodyBuilder, SharedShape};

    use super::super::parts::{Limb, Part};
    use super::super::physics::{self, PhysicsSettings};
    use super::*;

    /// Contract: a ball of 2 mm that crosses a sheet of 0.5 mm at 5 m/s, and so passes through it between two steps of the engine, is found;
    /// one that turns back 0.1 mm before it is not, and its distance is known as if it had been looked at all the time. So it is whether the ball
    /// belongs to an arm, the working or the idle one, or is an object that nobody holds, whose distances are not told.
    #[test]
    fn what_passes_through_a_sheet_between_two_steps_is_found() {
        crossing(Owner::Robot { body: 1, finger: false, limb: Limb::Working }, true);
        crossing(Owner::Robot { body: 1, finger: false, limb: Limb::Idle }, true);
        crossing(Owner::Object(1), false);
    }

    fn crossing(owner: Owner, is_measured: bool) {
        let (mut engine, mut parts) = (physics::engine(&PhysicsSettings::default()), Parts::default());
        let tip = parts.add(Part { name: "tip".into(), owner, handle: false });
        let sheet = parts.add(Part { name: "sheet".into(), owner: Owner::Object(0), handle: false });
        let start = Pose::translation(-0.0137, 0.0, 0.0);
        let body = engine.insert_body(RigidBodyBuilder::kinematic_position_based().pose(start));
        engine.insert_collider(ColliderBuilder::new(SharedShape::ball(0.001)).user_data(tip as u128), Some(body));
        let wall = engine.insert_body(RigidBodyBuilder::fixed());
        engine.insert_collider(ColliderBuilder::new(SharedShape::cuboid(0.25e-3, 0.2, 0.2)).user_data(sheet as u128), Some(wall));
        let mut watch = EngineWatch::new(&engine, &parts, &["sheet".to_owned(), "tip".to_owned()], &[false, true]);

        let mut go = |x_m: f64, step: u32| {
            engine.bodies.get_mut(body).expect("there").set_next_kinematic_position(Pose::translation(x_m, 0.0, 0.0));
            physics::step(&mut engine, &parts, u64::from(step)).expect("finite");
            watch.follow(&engine, &[], (f64::from(step - 1) * 1e-3, f64::from(step) * 1e-3));
            (watch.book.touches.clone(), watch.book.smallest[0].clone())
        };
        // To 0.1 mm before the sheet and back.
        let (touches, nearest) = go(-0.25e-3 - 1e-3 - 1e-4, 1);
        let distance_m = if is_measured { 1e-4 } else { f64::INFINITY };
        assert!(touches.is_empty(), "{touches:?}");
        assert!(nearest.min_distance_m == distance_m || (nearest.min_distance_m - distance_m).abs() < 1e-9, "{nearest:?}");
        assert!(go(-0.0037, 2).0.is_empty());
        // Through it at 5 m/s: 2.45 mm before it and 0.05 mm behind it.
        let (touches, nearest) = go(0.0013, 3);
        let first = touches.first().expect("it touched");
        assert!((first.time_s - (2e-3 + (0.0037 - 1.25e-3) / 5.0)).abs() < 1e-7, "{first:?}");
        assert_eq!((first.parts, nearest.min_distance_m), ((tip, sheet), if is_measured { 0.0 } else { f64::INFINITY }));
        let deepest = touches.iter().map(|touch| touch.gap.depth_m()).fold(0.0, f64::max);
        assert!((deepest - 1.25e-3).abs() < 1e-4, "{deepest}");
        assert!(engine.narrow_phase.contact_pairs().all(|pair| !pair.has_any_active_contact()), "the engine itself saw nothing");
    }
}
