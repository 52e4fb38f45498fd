//! What a scene is made of: the library of objects that scenario files compose.
//!
//! An object says what it is and where it stands; [`super::scene`] builds it in the engine. A quantity of an object may be a number or the
//! name of a task parameter, so that one file describes every setting in which a skill is taught and executed.

use nalgebra::{Point3, Vector2, Vector3};

use super::Cabinet;

/// The task parameters of one setting by name (for example `block_height_m`), in the order of the scenario file. Values in SI.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Parameters(pub Vec<(String, f64)>);

impl Parameters {
    /// The value of the parameter `name`, if this setting has it.
    pub fn get(&self, name: &str) -> Option<f64> {
        self.0.iter().find(|(key, _)| key == name).map(|(_, value)| *value)
    }

    /// A copy in which the given parameters have the given values; a name that is new is appended.
    pub fn with(&self, changes: &[(String, f64)]) -> Self {
        let mut changed = self.clone();
        for (name, value) in changes {
            match changed.0.iter_mut().find(|(key, _)| key == name) {
                Some(entry) => entry.1 = *value,
                None => changed.0.push((name.clone(), *value)),
            }
        }
        changed
    }
}

/// A number, or the name of the task parameter that gives it.
#[derive(Clone, Debug, PartialEq)]
pub enum Quantity {
    /// The number itself, in the unit of its key.
    Value(f64),
    /// The name of a task parameter.
    Parameter(String),
}

impl Quantity {
    /// The number in this setting. An unknown parameter name is NaN; scenario validation refuses it beforehand.
    pub fn resolve(&self, parameters: &Parameters) -> f64 {
        match self {
            Self::Value(value) => *value,
            Self::Parameter(name) => parameters.get(name).unwrap_or(f64::NAN),
        }
    }
}

/// One object of the scene. Lengths in metres, in the world frame (the robot's base frame: x forward, y left, z up).
#[derive(Clone, Debug, PartialEq)]
pub struct Object {
    /// Its name: unique in the scene, used in reports and by way-points.
    pub name: String,
    /// Centre in the horizontal plane; of a cabinet, its door's hinge (m).
    pub center_m: Vector2<f64>,
    /// Added to the centre along x (m): the lateral place that may vary from setting to setting.
    pub lateral_offset_m: Quantity,
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
        /// Coefficient of friction of the top.
        friction: f64,
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
    },
    /// A soft round toy that can be grasped.
    Ball {
        /// Radius (m).
        radius_m: f64,
        /// Mass (kg).
        mass_kg: f64,
        /// Coefficient of friction.
        friction: f64,
        /// Rolling resistance as angular damping (1/s): a soft toy does not roll on.
        rolling_damping_per_s: f64,
    },
    /// A box that can be pushed.
    Box {
        /// Extent along x, y, z (m).
        size_m: Vector3<f64>,
        /// Mass, evenly spread (kg).
        mass_kg: f64,
        /// Coefficient of friction; what two things have in common is the mean of theirs.
        friction: f64,
    },
    /// A fixed open box.
    Basket {
        /// Inner extent along x and y (m).
        inner_size_m: Vector2<f64>,
        /// Height of its walls (m).
        wall_height_m: f64,
        /// Thickness of walls and floor (m).
        wall_thickness_m: f64,
    },
    /// A fixed cabinet with a door on a vertical hinge and a row of handles.
    Cabinet(Cabinet),
}

impl Object {
    /// The centre in the horizontal plane in this setting (m).
    pub fn center(&self, parameters: &Parameters) -> Vector2<f64> {
        self.center_m + Vector2::new(self.lateral_offset_m.resolve(parameters), 0.0)
    }

    /// Whether it moves when it is pushed.
    pub fn is_movable(&self) -> bool {
        matches!(self.kind, ObjectKind::Ball { .. } | ObjectKind::Box { .. })
    }

    /// The point that way-points refer to (m, world): the middle of a table's top, of a block's base top, of a basket's floor top; the centre
    /// of a ball or box that rests on the surface at `support_height_m`; the middle of a cabinet's handle in use while the door is closed.
    pub fn anchor(&self, parameters: &Parameters, support_height_m: f64) -> Point3<f64> {
        let height = match &self.kind {
            ObjectKind::Table { top_height_m, .. } => *top_height_m,
            ObjectKind::UBlock { base_height_m, .. } => support_height_m + base_height_m.resolve(parameters),
            ObjectKind::Ball { radius_m, .. } => support_height_m + radius_m,
            ObjectKind::Box { size_m, .. } => support_height_m + size_m.z / 2.0,
            ObjectKind::Basket { wall_thickness_m, .. } => support_height_m + wall_thickness_m,
            ObjectKind::Cabinet(cabinet) => cabinet.hinge_height_m(support_height_m),
        };
        let center = self.center(parameters);
        if let ObjectKind::Cabinet(cabinet) = &self.kind {
            let hinge = Vector3::new(center.x, center.y, height);
            return cabinet.handle(center.y, parameters) + hinge;
        }
        Point3::from(Vector3::new(center.x, center.y, height))
    }
}

/// The height on which everything but tables stands (m, world): the top of the first table, or the floor at 0 without one.
pub fn support_height_m(objects: &[Object]) -> f64 {
    objects
        .iter()
        .find_map(|object| if let ObjectKind::Table { top_height_m, .. } = object.kind { Some(top_height_m) } else { None })
        .unwrap_or(0.0)
}
