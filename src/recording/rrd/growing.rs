//! A recording that is told of a run piece by piece.

use std::cell::OnceCell;
use std::collections::BTreeSet;
use std::sync::mpsc::Receiver;

use rerun::RecordingStream;
use rerun::blueprint::components::PlayState;

use super::axis_range::Ranges;
use super::chapters::Chapters;
use super::live::News;
use super::recorder::Fault;
use super::workplace::Workplace;
use super::write::name;
use crate::robot::RobotModel;
use crate::simulation::{Experiment, LessonRecord, RunOutcome, StepRecord};

/// What has been recorded so far.
pub(super) struct Growing<'a> {
    chapters: Chapters<'a>,
    /// So many steps are recorded together.
    together: usize,
    /// Whether there is a layout.
    opened: bool,
    /// The lessons that were told.
    seen: BTreeSet<usize>,
    /// The run with its steps so far, and how many of them were recorded.
    planned: Option<Box<RunOutcome>>,
    told: usize,
}

impl<'a> Growing<'a> {
    /// Records until the run is over, so many steps together.
    pub fn record(stream: RecordingStream, experiment: &'a Experiment, together: usize, news: &Receiver<News>) -> Result<(), Fault> {
        stream.send_recording_name(format!("{} (live)", name(experiment)))?;
        let chapters = Chapters {
            stream,
            ranges: Ranges::default(),
            experiment,
            work: Workplace::default(),
            camera: OnceCell::new(),
            duration_s: 1.0,
            beside: &[],
        };
        chapters.result(None)?;
        let mut growing = Self { chapters, together, opened: false, seen: BTreeSet::new(), planned: None, told: 0 };
        for news in news {
            match news {
                News::Lesson(robot, number, lesson) => growing.lesson(&robot, number, &lesson)?,
                News::Taught(robot, lessons) => growing.taught(&robot, &lessons)?,
                News::Planned(outcome) => growing.planned(outcome)?,
                News::Stepped(record) => growing.stepped(*record)?,
                News::Ended(result) => growing.chapters.result(Some(&result))?,
            }
        }
        growing.steps(1)?;
        Ok(growing.chapters.stream.flush_blocking()?)
    }

    fn lesson(&mut self, robot: &RobotModel, number: usize, lesson: &LessonRecord) -> Result<(), Fault> {
        // What has been seen so far is where the work is, until all have been taught.
        if self.seen.is_empty() {
            self.open(robot, std::slice::from_ref(lesson))?;
        }
        self.chapters.lesson(robot, (number, lesson), self.seen.first().copied())?;
        self.seen.insert(number);
        // A viewer is told at once, and a file has it if the run is killed.
        Ok(self.chapters.stream.flush_async()?)
    }

    /// All lessons have been taught; some may not have been told.
    fn taught(&mut self, robot: &RobotModel, lessons: &[LessonRecord]) -> Result<(), Fault> {
        self.open(robot, lessons)?;
        for (number, lesson) in lessons.iter().enumerate() {
            if !self.seen.contains(&number) {
                self.chapters.lesson(robot, (number, lesson), self.seen.first().copied())?;
                self.seen.insert(number);
            }
        }
        Ok(())
    }

    /// Shows what `lessons` have to show.
    fn open(&mut self, robot: &RobotModel, lessons: &[LessonRecord]) -> Result<(), Fault> {
        self.chapters.look_at(Workplace::of_lessons(lessons));
        self.opened = true;
        self.chapters.layout(robot, None, true, PlayState::Following)
    }

    fn planned(&mut self, outcome: Box<RunOutcome>) -> Result<(), Fault> {
        self.chapters.duration_s = outcome.plan.duration_s();
        if !self.opened {
            self.chapters.look_at(Workplace::of_plan(&outcome).with_paths(&outcome));
            self.chapters.layout(&outcome.robot, Some(&outcome), false, PlayState::Following)?;
        } else {
            self.chapters.looks_for(&outcome);
        }
        self.chapters.skill(&outcome)?;
        self.chapters.key(&outcome, false)?;
        self.planned = Some(outcome);
        Ok(())
    }

    fn stepped(&mut self, record: StepRecord) -> Result<(), Fault> {
        if let Some(outcome) = &mut self.planned {
            outcome.steps.push(record);
        }
        self.steps(self.together)
    }

    /// Records the steps that are there, if they are so many.
    fn steps(&mut self, at_least: usize) -> Result<(), Fault> {
        let Some(outcome) = self.planned.as_ref().filter(|outcome| outcome.steps.len() >= self.told + at_least) else { return Ok(()) };
        self.chapters.execution(outcome, self.told)?;
        self.told = outcome.steps.len();
        Ok(())
    }
}
