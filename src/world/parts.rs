//! The names of everything that can be touched, and who may touch whom.

/// Whose part it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Owner {
    /// A body of the robot model; `finger` when it may touch what is there to be held.
    Robot {
        /// Index in [`crate::robot::RobotModel::bodies`].
        body: usize,
        /// A finger of the gripper, or the tool itself.
        finger: bool,
        /// Which part of the robot it belongs to.
        limb: Limb,
    },
    /// An object of the scene.
    Object(usize),
}

/// The parts of the robot that move as one tree, or not at all. Links of one limb are never checked against each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Limb {
    /// Torso, pedestal, head.
    Fixed,
    /// The arm that works.
    Working,
    /// The arm that holds still.
    Idle,
}

/// A part that can be touched.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Part {
    /// Its name in reports: `left_hand`, `block_1.near_post`.
    pub name: String,
    /// Whose part it is.
    pub owner: Owner,
    /// Whether it is there to be held: what can be moved, or a handle.
    pub handle: bool,
}

/// All parts; a collider's user data is the index of its part.
#[derive(Clone, Debug, Default)]
pub(crate) struct Parts(Vec<Part>);

impl Parts {
    /// Adds a part and returns its index; several shapes of one name are one part.
    pub(crate) fn add(&mut self, part: Part) -> usize {
        if let Some(known) = self.0.iter().position(|known| *known == part) {
            return known;
        }
        self.0.push(part);
        self.0.len() - 1
    }

    /// The part with this index.
    ///
    /// # Panics
    /// If there is none.
    pub(crate) fn get(&self, index: usize) -> &Part {
        &self.0[index]
    }

    /// The part of a collider's user data.
    pub(crate) fn of(&self, user_data: u128) -> Option<(usize, &Part)> {
        let index = usize::try_from(user_data).ok()?;
        self.0.get(index).map(|part| (index, part))
    }
}
