//! A cabinet with a door on a vertical hinge and a row of handles: its shape, and where its handle goes when the door opens.
//!
//! The door's frame sits on the hinge at half the door's height, axes as the world's while the door is closed: the door hangs along -y, its
//! face is the plane x = 0 and looks along -x, towards the robot. It opens by turning about -z, so its handle comes towards the robot.

use nalgebra::{Isometry3, Point3, UnitQuaternion, Vector2, Vector3};

use super::scene::{ObjectPart, PartShape};
use super::{Parameters, Quantity};

/// A cabinet, as a scenario describes it.
#[derive(Clone, Debug, PartialEq)]
pub struct Cabinet {
    /// Width (from the hinge) and height of the door (m).
    pub door_size_m: Vector2<f64>,
    /// Height of the door's lower edge above what the cabinet stands on (m).
    pub bottom_height_m: f64,
    /// Depth of the cabinet behind the door (m).
    pub depth_m: f64,
    /// Mass of the door, evenly spread (kg).
    pub mass_kg: Quantity,
    /// Dry friction of the hinge (N m).
    pub friction_nm: Quantity,
    /// Damping of the hinge (N m s/rad).
    pub damping_nms_per_rad: f64,
    /// Stiffness of the seal that the closing door presses against the walls (N m/rad).
    pub seal_nm_per_rad: f64,
    /// How far the seal yields before the door stands still (rad).
    pub seal_travel_rad: f64,
    /// How far the door opens (rad).
    pub opening_max_rad: f64,
    /// Number of handles in the row, 1 … 9; the first is the nearest to the hinge.
    pub handles: usize,
    /// Distance of the first handle from the hinge, along the door (m).
    pub first_handle_m: f64,
    /// Distance between handles (m).
    pub handle_spacing_m: f64,
    /// The place of the handle in use along y, world, door closed (m). Handles of the row that stand less than a spacing beside it are not
    /// mounted, so that it may stand at any place on the door.
    pub handle_lateral_m: Quantity,
    /// Length of a handle's bar (m).
    pub handle_length_m: f64,
    /// Radius of a handle's bar (m).
    pub handle_radius_m: f64,
    /// Distance of a bar's axis from the door's face (m).
    pub handle_standoff_m: f64,
    /// How the hook holds the handle.
    pub grip: Grip,
}

/// How a hook holds a handle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Grip {
    /// When the gripper is told to close, a clamp closes around the bar: the bar cannot leave the hook, which turns freely about it.
    Clamp,
    /// Nothing but contact.
    Contact,
}

/// Thickness of door and walls (m).
const WALL_M: f64 = 0.018;
/// Gap between door and walls (m).
const GAP_M: f64 = 0.004;
/// Names of handles from the hinge; the handle in use bears the last name when it is none of the row.
const HANDLE_NAMES: [&str; 9] =
    ["handle_1", "handle_2", "handle_3", "handle_4", "handle_5", "handle_6", "handle_7", "handle_8", "handle_9"];
const OTHER_HANDLE: &str = "handle_between";
/// Two places nearer than this are one (m).
const SAME_PLACE_M: f64 = 1e-6;

impl Cabinet {
    /// The handle in use: distance of its axis from the hinge along the door (m), for a hinge at `hinge_y_m` (world).
    pub fn handle_distance_m(&self, hinge_y_m: f64, parameters: &Parameters) -> f64 {
        hinge_y_m - self.handle_lateral_m.resolve(parameters)
    }

    /// Whether the handle in use is on the door.
    pub fn has_handle_on_door(&self, hinge_y_m: f64, parameters: &Parameters) -> bool {
        let distance = self.handle_distance_m(hinge_y_m, parameters);
        (self.handle_radius_m..=self.door_size_m.x - self.handle_radius_m).contains(&distance)
    }

    /// The middle of the bar of the handle in use, in the door's frame (m).
    pub fn handle(&self, hinge_y_m: f64, parameters: &Parameters) -> Point3<f64> {
        self.bar(self.handle_distance_m(hinge_y_m, parameters))
    }

    /// Radius of the arc on which the handle in use moves about the hinge (m).
    pub fn arc_radius_m(&self, hinge_y_m: f64, parameters: &Parameters) -> f64 {
        self.handle(hinge_y_m, parameters).xy().coords.norm()
    }

    /// Names and middles of all bars, in the door's frame (m).
    pub fn bars(&self, hinge_y_m: f64, parameters: &Parameters) -> Vec<(&'static str, Point3<f64>)> {
        let used = self.handle_distance_m(hinge_y_m, parameters);
        let row =
            (0..self.handles.min(HANDLE_NAMES.len())).map(|k| (HANDLE_NAMES[k], self.first_handle_m + k as f64 * self.handle_spacing_m));
        let mut bars: Vec<(&str, f64)> = row.filter(|(_, place)| clear_of(*place, used, self.handle_spacing_m)).collect();
        if bars.iter().all(|(_, place)| (place - used).abs() > SAME_PLACE_M) {
            bars.push((OTHER_HANDLE, used));
        }
        bars.into_iter().map(|(name, distance)| (name, self.bar(distance))).collect()
    }

    fn bar(&self, distance_m: f64) -> Point3<f64> {
        Point3::new(-self.handle_standoff_m, -distance_m, 0.0)
    }

    /// The parts of the door without its handles, in the door's frame.
    pub(super) fn panel(&self) -> ObjectPart {
        let size = Vector3::new(WALL_M, self.door_size_m.x, self.door_size_m.y);
        part("door", [WALL_M / 2.0, -self.door_size_m.x / 2.0, 0.0], PartShape::Box(size / 2.0))
    }

    /// The bars, and the posts that hold them, in the door's frame: what may be held.
    pub(super) fn handle_parts(&self, hinge_y_m: f64, parameters: &Parameters) -> Vec<ObjectPart> {
        let half = self.handle_length_m / 2.0;
        let post = Vector3::new(self.handle_standoff_m, 2.0 * self.handle_radius_m, 2.0 * self.handle_radius_m) / 2.0;
        let of_bar = |(name, middle): (&'static str, Point3<f64>)| {
            let at = |x: f64, z: f64| [x, middle.y, z];
            [
                part(name, middle.into(), PartShape::Capsule(self.handle_radius_m, self.handle_length_m)),
                part(name, at(-self.handle_standoff_m / 2.0, half), PartShape::Box(post)),
                part(name, at(-self.handle_standoff_m / 2.0, -half), PartShape::Box(post)),
            ]
        };
        self.bars(hinge_y_m, parameters).into_iter().flat_map(of_bar).collect()
    }

    /// What stands still, in the frame of the closed door.
    pub(super) fn walls(&self) -> Vec<ObjectPart> {
        let (w, h, d) = (self.door_size_m.x, self.door_size_m.y, self.depth_m);
        let front = WALL_M + GAP_M;
        let x = front + d / 2.0;
        let slab = |name, center: [f64; 3], size: [f64; 3]| part(name, center, PartShape::Box(Vector3::from(size) / 2.0));
        vec![
            slab("left_wall", [x, -WALL_M / 2.0, 0.0], [d, WALL_M, h]),
            slab("right_wall", [x, -w + WALL_M / 2.0, 0.0], [d, WALL_M, h]),
            slab("top", [x, -w / 2.0, (h - WALL_M) / 2.0], [d, w - 2.0 * WALL_M, WALL_M]),
            slab("floor", [x, -w / 2.0, -(h - WALL_M) / 2.0], [d, w - 2.0 * WALL_M, WALL_M]),
            slab("back", [front + d - WALL_M / 2.0, -w / 2.0, 0.0], [WALL_M, w - 2.0 * WALL_M, h - 2.0 * WALL_M]),
        ]
    }
}

/// How far the door is open (rad), seen from the pose of its frame.
pub fn opening_rad(world_from_door: &Isometry3<f64>) -> f64 {
    let along = world_from_door.rotation * Vector3::y();
    along.x.atan2(along.y)
}

/// The turn of a door that is open by `opening_rad`.
pub fn door_turn(opening_rad: f64) -> UnitQuaternion<f64> {
    UnitQuaternion::from_axis_angle(&Vector3::z_axis(), -opening_rad)
}

/// Whether a handle of the row stays beside the one in use: it is that one, or a spacing away.
fn clear_of(place: f64, used: f64, spacing: f64) -> bool {
    let away = (place - used).abs();
    away <= SAME_PLACE_M || away >= spacing - SAME_PLACE_M
}

fn part(name: &'static str, center: [f64; 3], shape: PartShape) -> ObjectPart {
    ObjectPart { name, object_from_part: Isometry3::translation(center[0], center[1], center[2]), shape }
}
