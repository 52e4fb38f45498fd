//! What a scenario runs: an arm in a simulated world, or a planar experiment.

use std::path::PathBuf;

use crate::demonstration::Dataset;
use crate::learning::{LearningError, MayGoOn};
use crate::planar::{
    Guidance, Method, ObstacleAvoidanceSettings, PlanarOutcome, TwoSidedObstacleSettings, obstacle_avoidance, two_sided_obstacle,
};
use crate::robot;
use crate::simulation::{DemonstrationSource, Experiment};

/// What a scenario runs.
#[derive(Clone, Debug)]
pub enum Work {
    /// An arm is taught, and executes what it learned, in a simulated world.
    Arm(Box<Experiment>),
    /// Movements in a plane are taught, learned by several methods, and compared.
    Planar(Box<PlanarRun>),
}

/// A planar experiment with its name and seed.
#[derive(Clone, Debug, PartialEq)]
pub struct PlanarRun {
    /// Name of the scenario.
    pub name: String,
    /// Decides every random number.
    pub seed: u64,
    /// What is done.
    pub plan: PlanarPlan,
}

/// Which planar experiment.
#[derive(Clone, Debug, PartialEq)]
pub enum PlanarPlan {
    /// Section 4.1 of the paper.
    ObstacleAvoidance(Box<ObstacleAvoidanceSettings>),
    /// Section 4.2 of the paper.
    TwoSidedObstacle(Box<TwoSidedObstacleSettings>),
}

impl Work {
    /// Name of the scenario.
    #[must_use]
    pub fn name(&self) -> &str {
        match self {
            Self::Arm(experiment) => &experiment.name,
            Self::Planar(run) => &run.name,
        }
    }

    /// Its seed.
    #[must_use]
    pub fn seed(&self) -> u64 {
        match self {
            Self::Arm(experiment) => experiment.seed,
            Self::Planar(run) => run.seed,
        }
    }

    /// The files besides the scenario's own that decide a run: the robot, the meshes of what it can touch, the dataset.
    #[must_use]
    pub fn inputs(&self) -> Vec<PathBuf> {
        let Self::Arm(experiment) = self else { return Vec::new() };
        let mut files: Vec<PathBuf> = experiment.robot.urdf.iter().cloned().collect();
        files
            .extend(experiment.robot.urdf.iter().flat_map(|urdf| robot::collision_mesh_files(urdf, &experiment.robot.package_directories)));
        if let DemonstrationSource::Dataset(folder) = &experiment.demonstrations {
            let mut of_dataset: Vec<PathBuf> = match std::fs::read_dir(folder) {
                Ok(entries) => entries.flatten().map(|entry| entry.path()).filter(|path| path.is_file()).collect(),
                Err(_) => vec![folder.clone()],
            };
            of_dataset.sort();
            files.extend(of_dataset);
        }
        files
    }
}

impl PlanarRun {
    /// Checks what the keys cannot tell on their own.
    ///
    /// # Errors
    /// All settings that make no sense.
    pub fn check(&self) -> Result<(), LearningError> {
        match &self.plan {
            PlanarPlan::ObstacleAvoidance(settings) => settings.check().and_then(|()| settings.learning.check()),
            PlanarPlan::TwoSidedObstacle(settings) => {
                settings.check().and_then(|()| settings.learning.check()).and_then(|()| settings.learning_without_side.check())
            }
        }
    }

    /// What is shown.
    ///
    /// # Errors
    /// When the settings make no usable trajectory.
    pub fn dataset(&self) -> Result<Dataset, LearningError> {
        match &self.plan {
            PlanarPlan::ObstacleAvoidance(settings) => settings.dataset(self.seed),
            PlanarPlan::TwoSidedObstacle(settings) => settings.dataset(Method::Cpdmp, Guidance::WithSide, self.seed),
        }
    }

    /// Runs it.
    ///
    /// # Errors
    /// When nothing can be learned, or it may not go on.
    pub fn run(&self, may_go_on: MayGoOn) -> Result<PlanarOutcome, LearningError> {
        match &self.plan {
            PlanarPlan::ObstacleAvoidance(settings) => obstacle_avoidance(settings, self.seed, may_go_on),
            PlanarPlan::TwoSidedObstacle(settings) => two_sided_obstacle(settings, self.seed, may_go_on),
        }
    }
}
