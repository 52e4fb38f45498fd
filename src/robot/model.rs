//! What an arm is: a tree of rigid bodies joined by moving joints, with the links on fixed joints lumped into the body that carries them.
//!
//! Conventions. `a_from_b` maps coordinates of frame b into frame a. A body's frame is the frame of the joint that moves it (URDF: of its
//! first link); the root's frame is that of the root link. Everything is in metres, kilograms, radians, newtons and seconds.

use nalgebra::{Isometry3, Matrix3, Unit, Vector3};

/// A robot: `joints[i]` moves `bodies[i + 1]`, body 0 is the fixed root, and parents come before their children.
#[derive(Debug, Clone, PartialEq)]
pub struct RobotModel {
    /// Name of the robot, as in the file.
    pub name: String,
    /// Rigid bodies; body 0 is fixed in the world.
    pub bodies: Vec<Body>,
    /// Moving joints; joint `i` moves body `i + 1`.
    pub joints: Vec<Joint>,
    /// Every link of the file as a frame on the body that carries it, in file order.
    pub frames: Vec<Frame>,
}

/// A rigid body: one link that a moving joint carries, and every link fixed to it.
#[derive(Debug, Clone, PartialEq)]
pub struct Body {
    /// Name of the first link, the one that the moving joint carries.
    pub name: String,
    /// Mass of all lumped links (kg).
    pub mass_kg: f64,
    /// Centre of mass in the body frame (m); zero when the body has no mass.
    pub center_of_mass: Vector3<f64>,
    /// Inertia about the centre of mass along the axes of the body frame (kg m²).
    pub inertia: Matrix3<f64>,
    /// Shapes that collide.
    pub collisions: Vec<Geometry>,
    /// Shapes to look at.
    pub visuals: Vec<Geometry>,
}

/// How a joint moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum JointKind {
    /// Turns about its axis between limits.
    Revolute,
    /// Turns about its axis without limits.
    Continuous,
    /// Slides along its axis between limits.
    Prismatic,
}

/// A joint with one degree of freedom. Angles in rad, displacements in m; efforts in N m or N.
#[derive(Debug, Clone, PartialEq)]
pub struct Joint {
    /// Name, as in the file.
    pub name: String,
    /// How it moves.
    pub kind: JointKind,
    /// Index of the body it hangs on.
    pub parent_body: usize,
    /// Index of the body it moves.
    pub child_body: usize,
    /// Pose of the joint frame in the parent body frame at q = 0; the child body's frame is the joint frame, moved by q.
    pub parent_from_joint: Isometry3<f64>,
    /// Axis in the joint frame.
    pub axis: Unit<Vector3<f64>>,
    /// Smallest position (rad or m); minus infinity for continuous joints.
    pub lower: f64,
    /// Largest position (rad or m); infinity for continuous joints.
    pub upper: f64,
    /// Largest speed (rad/s or m/s).
    pub velocity_limit: f64,
    /// Largest effort (N m or N).
    pub effort_limit: f64,
    /// Viscous damping (N m s/rad or N s/m).
    pub damping: f64,
    /// Coulomb friction (N m or N).
    pub friction: f64,
    /// The joint that this one follows, if any.
    pub mimic: Option<Mimic>,
}

/// A joint that follows another: `q = multiplier * q_master + offset`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mimic {
    /// Index of the joint that leads.
    pub joint: usize,
    /// Factor on the leader's position.
    pub multiplier: f64,
    /// Position at the leader's zero (rad or m).
    pub offset: f64,
}

/// A named frame: a link of the file.
#[derive(Debug, Clone, PartialEq)]
pub struct Frame {
    /// Name of the link.
    pub name: String,
    /// Index of the body that carries it.
    pub body: usize,
    /// Pose of the frame in the body frame.
    pub body_from_frame: Isometry3<f64>,
}

/// A shape on a body.
#[derive(Debug, Clone, PartialEq)]
pub struct Geometry {
    /// Name of the link that it belongs to in the file.
    pub link: String,
    /// Pose of the shape's frame in the body frame.
    pub body_from_geometry: Isometry3<f64>,
    /// The shape.
    pub shape: Shape,
    /// Colour as red, green, blue, opacity, each from 0 to 1; mid grey when the file gives none.
    pub color_rgba: [f32; 4],
}

/// A shape about the origin of its frame (m).
#[derive(Debug, Clone, PartialEq)]
pub enum Shape {
    /// Cuboid.
    Box {
        /// Half the edge lengths along x, y, z.
        half_extents: Vector3<f64>,
    },
    /// Sphere.
    Sphere {
        /// Radius.
        radius: f64,
    },
    /// Cylinder along z.
    Cylinder {
        /// Radius.
        radius: f64,
        /// Half its length.
        half_length: f64,
    },
    /// Triangle mesh.
    Mesh {
        /// Corner points.
        vertices: Vec<[f64; 3]>,
        /// Indices of three corner points each.
        triangles: Vec<[u32; 3]>,
    },
}

impl RobotModel {
    /// The frame of the link called `name`.
    pub fn frame(&self, name: &str) -> Option<&Frame> {
        self.frames.iter().find(|frame| frame.name == name)
    }

    /// Index of the joint called `name`.
    pub fn joint_index(&self, name: &str) -> Option<usize> {
        self.joints.iter().position(|joint| joint.name == name)
    }

    /// Position of joint `joint` among given positions `q` of all joints (length: joints): its own, or what its leader makes it.
    ///
    /// # Panics
    /// If `q` is not as long as `joints`.
    pub fn position_of(&self, joint: usize, q: &[f64]) -> f64 {
        assert_eq!(q.len(), self.joints.len(), "one position per joint");
        match self.joints[joint].mimic {
            Some(mimic) => mimic.multiplier * q[mimic.joint] + mimic.offset,
            None => q[joint],
        }
    }
}

impl Joint {
    /// Pose of the child body in the parent body at position `q` (rad or m).
    pub fn parent_from_child(&self, q: f64) -> Isometry3<f64> {
        self.parent_from_joint * self.motion(q)
    }

    /// Middle of the range (rad or m); zero for continuous joints.
    pub fn middle(&self) -> f64 {
        match self.kind {
            JointKind::Continuous => 0.0,
            JointKind::Revolute | JointKind::Prismatic => 0.5 * (self.lower + self.upper),
        }
    }

    fn motion(&self, q: f64) -> Isometry3<f64> {
        match self.kind {
            JointKind::Prismatic => Isometry3::from_parts((self.axis.into_inner() * q).into(), Default::default()),
            JointKind::Revolute | JointKind::Continuous => Isometry3::rotation(self.axis.into_inner() * q),
        }
    }
}
