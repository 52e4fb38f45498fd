//! What a scene is made of: the library of objects that scenario files compose.
//!
//! An object says what it is and where it stands; [`super::scene`] builds it in the engine. A quantity of an object may be a number or the
//! name of a task parameter, so that one file describes every setting in which a skill is taught and executed.

use nalgebra::{Isometry3, Point3, Translation3, UnitComplex, UnitQuaternion, Vector2, Vector3};

use super::{Cabinet, Parameters, Quantity};

/// One object of the scene. Lengths in metres, in the world frame (the robot's base frame: x forward, y left, z up).
#[derive(Clone, Debug, PartialEq)]
pub struct Object {
    /// Its name: unique in the scene, used in reports and by way-points.
    pub name: String,
    /// Centre in the horizontal plane; of a cabinet, its hinge (m).
    pub center_m: Vector2<f64>,
    /// Added to the centre along x (m): the lateral place that may vary from setting to setting.
    pub lateral_offset_m: Quantity,
    /// Added to the centre along y (m).
    pub offset_y_m: Quantity,
    /// Added to the height at which it stands (m).
    pub raised_m: Quantity,
    /// Turn about the vertical through its centre (rad).
    pub yaw_rad: Quantity,
    /// What it is.
    pub kind: ObjectKind,
}

/// The kinds of objects.
#[derive(Clone, Debug, PartialEq)]
pub enum ObjectKind {
    /// A fixed box whose top is the support surface of everything that stands on it.
    Table {
        /// Extent along x and y (m).
        size_m: Vector2<f64>,
        /// Height of the top in the world frame (m).
        top_height_m: f64,
        /// Coefficient of friction of the top; what two things have in common is the mean of theirs.
        friction: Quantity,
    },
    /// A fixed U: a base with a post at either end in x; the arm passes along y, over the base and between the posts.
    UBlock {
        /// Height of the base above the table (m).
        base_height_m: Quantity,
        /// Free width between the posts, along x (m).
        aperture_m: f64,
        /// Height of the posts above the base (m).
        post_height_m: f64,
        /// Width of each post, along x (m).
        post_width_m: f64,
        /// Extent of the block along y (m).
        thickness_m: f64,
        /// Coefficient of friction.
        friction: Quantity,
    },
    /// A soft round toy that can be grasped.
    Ball {
        /// Radius (m).
        radius_m: f64,
        /// Mass (kg).
        mass_kg: Quantity,
        /// Coefficient of friction.
        friction: Quantity,
        /// Rolling resistance as angular damping (1/s): a soft toy does not roll on.
        rolling_damping_per_s: f64,
    },
    /// A box.
    Box {
        /// Extent along x, y, z (m).
        size_m: Vector3<f64>,
        /// What it weighs and how it slides.
        body: Solid,
    },
    /// An upright cylinder: a peg, a cup, a tin.
    Cylinder {
        /// Radius (m).
        radius_m: f64,
        /// Height (m).
        height_m: f64,
        /// What it weighs and how it slides.
        body: Solid,
    },
    /// A level plate on a spring, which yields downward when it is pressed: a mat, a scale, a soft board.
    SpringPlate {
        /// Extent along x, y and z (m).
        size_m: Vector3<f64>,
        /// How far its underside is from what it stands on while nothing presses (m): as far as it can yield.
        travel_m: f64,
        /// Stiffness of the spring (N/m).
        stiffness_n_per_m: Quantity,
        /// Damping of the spring (N s/m).
        damping_ns_per_m: f64,
        /// Mass of the plate, which the spring carries at its place of rest (kg).
        mass_kg: Quantity,
        /// Coefficient of friction.
        friction: Quantity,
    },
    /// A fixed open box.
    Basket {
        /// Inner extent along x and y (m).
        inner_size_m: Vector2<f64>,
        /// Height of its walls (m).
        wall_height_m: f64,
        /// Thickness of walls and floor (m).
        wall_thickness_m: f64,
        /// Coefficient of friction.
        friction: Quantity,
    },
    /// A fixed cabinet with a door on a vertical hinge and a row of handles. It stands square: its door looks at the robot.
    Cabinet(Cabinet),
}

/// What a solid thing weighs and how it slides.
#[derive(Clone, Debug, PartialEq)]
pub struct Solid {
    /// Mass, evenly spread (kg).
    pub mass_kg: Quantity,
    /// Coefficient of friction; what two things have in common is the mean of theirs.
    pub friction: Quantity,
    /// Whether it is fixed to the world instead of free to move.
    pub fixed: bool,
}

impl Object {
    /// An object whose centre is `center_m` (m), level and not turned.
    pub fn new(name: &str, center_m: Vector2<f64>, kind: ObjectKind) -> Self {
        let none = || Quantity::Value(0.0);
        Self { name: name.to_owned(), center_m, lateral_offset_m: none(), offset_y_m: none(), raised_m: none(), yaw_rad: none(), kind }
    }

    /// The centre in the horizontal plane in this setting (m).
    pub fn center(&self, parameters: &Parameters) -> Vector2<f64> {
        self.center_m + Vector2::new(self.lateral_offset_m.resolve(parameters), self.offset_y_m.resolve(parameters))
    }

    /// Whether it moves when it is pushed.
    pub fn is_movable(&self) -> bool {
        self.is_free() || matches!(self.kind, ObjectKind::SpringPlate { .. })
    }

    /// Whether [`Self::pose`] is only where it starts: it is movable, or a cabinet, whose pose is its door's.
    pub fn moves(&self) -> bool {
        self.is_movable() || matches!(self.kind, ObjectKind::Cabinet(_))
    }

    /// Whether nothing holds it but what it lies on.
    pub fn is_free(&self) -> bool {
        match &self.kind {
            ObjectKind::Ball { .. } => true,
            ObjectKind::Box { body, .. } | ObjectKind::Cylinder { body, .. } => !body.fixed,
            _ => false,
        }
    }

    /// Whether it is a table under the centre of `other`.
    pub fn carries(&self, other: &Object, parameters: &Parameters) -> bool {
        let ObjectKind::Table { size_m, .. } = &self.kind else { return false };
        let turned = UnitComplex::new(-self.yaw_rad.resolve(parameters));
        let away = turned * (other.center(parameters) - self.center(parameters));
        away.x.abs() <= size_m.x / 2.0 && away.y.abs() <= size_m.y / 2.0
    }

    /// Where the object's frame starts (`world_from_object`), its underside on a surface at `support_height_m`: the frame's origin is on that
    /// surface, or in the middle of a ball, box, cylinder or plate, of a table's top, or of a cabinet's hinge.
    pub fn pose(&self, parameters: &Parameters, support_height_m: f64) -> Isometry3<f64> {
        let middle = match &self.kind {
            // A table stands on nothing but its own height.
            ObjectKind::Table { top_height_m, .. } => top_height_m - support_height_m,
            ObjectKind::Ball { radius_m, .. } => *radius_m,
            ObjectKind::Box { size_m, .. } => size_m.z / 2.0,
            ObjectKind::Cylinder { height_m, .. } => height_m / 2.0,
            ObjectKind::SpringPlate { size_m, travel_m, .. } => travel_m + size_m.z / 2.0,
            ObjectKind::UBlock { .. } | ObjectKind::Basket { .. } => 0.0,
            ObjectKind::Cabinet(cabinet) => cabinet.bottom_height_m + cabinet.door_size_m.y / 2.0,
        };
        let center = self.center(parameters);
        let place = Translation3::new(center.x, center.y, support_height_m + self.raised_m.resolve(parameters) + middle);
        Isometry3::from_parts(place, UnitQuaternion::from_axis_angle(&Vector3::z_axis(), self.yaw_rad.resolve(parameters)))
    }

    /// The point that way-points refer to (m, world): the middle of a table's top, of a block's base top, of a basket's floor top, of a
    /// plate's top; the centre of a ball, box or cylinder that stands on the surface at `support_height_m`; the middle of a cabinet's handle in
    /// use while the door is closed.
    pub fn anchor(&self, parameters: &Parameters, support_height_m: f64) -> Point3<f64> {
        let pose = self.pose(parameters, support_height_m);
        if let ObjectKind::Cabinet(cabinet) = &self.kind {
            return pose * cabinet.handle(pose.translation.y, parameters);
        }
        let above = match &self.kind {
            ObjectKind::UBlock { base_height_m, .. } => base_height_m.resolve(parameters),
            ObjectKind::Basket { wall_thickness_m, .. } => *wall_thickness_m,
            ObjectKind::SpringPlate { size_m, .. } => size_m.z / 2.0,
            _ => 0.0,
        };
        Point3::from(pose.translation.vector + Vector3::new(0.0, 0.0, above))
    }
}

/// The height on which `object` stands (m, world): the top of the table under its centre, of several the highest. What is beside all tables
/// stands as high as the first of them, and on the floor at 0 where there is none.
pub fn support_height_m(objects: &[Object], object: &Object, parameters: &Parameters) -> f64 {
    let top = |table: &Object| match table.kind {
        ObjectKind::Table { top_height_m, .. } => Some(top_height_m + table.raised_m.resolve(parameters)),
        _ => None,
    };
    let under = objects.iter().filter(|table| table.carries(object, parameters));
    under.filter_map(top).reduce(f64::max).or_else(|| objects.iter().find_map(top)).unwrap_or(0.0)
}
