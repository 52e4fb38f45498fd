//! A recording of a run while it happens, for a viewer or for the case that the run is killed. It runs beside the run on a thread of its own,
//! which may fall behind, hang or fail: the run never waits for it, and what there is no room for is left out.

use std::net::{SocketAddr, TcpStream};
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, sync_channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::Duration;

use rerun::sink::{FileSink, FileSinkOptions};
use rerun::{RecordingStream, RecordingStreamBuilder};

use super::chapters::APPLICATION;
use super::growing::Growing;
use super::recorder::Fault;
use crate::robot::RobotModel;
use crate::simulation::{Experiment, LessonRecord, RunOutcome, StepRecord};

/// News that wait to be recorded: the steps of 40 s at 100 Hz.
const WAITING: usize = 4096;

/// Steps that are recorded together for a viewer: a second at 100 Hz.
const SHOWN_TOGETHER: usize = 100;

/// Steps that are recorded together in a file, which nobody looks at yet: few large pieces cost less than many small ones.
const KEPT_TOGETHER: usize = 1000;

/// Time between two tries to reach a viewer that starts.
const RETRY: Duration = Duration::from_millis(100);

/// A recording that grows with its run.
#[derive(Debug)]
pub struct LiveRecording {
    news: SyncSender<News>,
    /// The run is over: a viewer that is not there yet need not come.
    over: Arc<AtomicBool>,
    /// Told through once. A listener is shared between threads, which a receiver alone cannot be.
    done: Mutex<Receiver<()>>,
}

/// What happens in a run.
#[derive(Debug)]
pub(super) enum News {
    Lesson(Box<RobotModel>, usize, LessonRecord),
    Taught(Box<RobotModel>, Vec<LessonRecord>),
    Planned(Box<RunOutcome>),
    Stepped(Box<StepRecord>),
    Ended(String),
}

impl LiveRecording {
    /// Records into a file, which grows while the run goes on. It has no footer: few need one, it would cost more than all that is recorded,
    /// and [`close_recording`](crate::recording::close_recording) makes it. That the file cannot be written is no fault of the run, and told
    /// by the recording that is written when it is over.
    #[must_use]
    pub fn to_file(path: &Path, experiment: &Experiment) -> Self {
        let path = path.to_owned();
        Self::start(experiment, KEPT_TOGETHER, move |builder, _| {
            let stream = builder.buffered()?;
            stream.set_sink(Box::new(FileSink::with_options(path, FileSinkOptions { write_footer: false })?));
            Ok(stream)
        })
    }

    /// Records into the viewer that listens at `address`, as soon as it does. It is left alone when the run ends before.
    #[must_use]
    pub fn to_viewer(address: SocketAddr, experiment: &Experiment) -> Self {
        Self::start(experiment, SHOWN_TOGETHER, move |builder, over| {
            while TcpStream::connect_timeout(&address, RETRY).is_err() {
                if over.load(Ordering::Relaxed) {
                    return Err("no viewer listens".into());
                }
                thread::sleep(RETRY);
            }
            Ok(builder.connect_grpc_opts(format!("rerun+http://{address}/proxy"))?)
        })
    }

    fn start(
        experiment: &Experiment,
        together: usize,
        open: impl FnOnce(RecordingStreamBuilder, &AtomicBool) -> Result<RecordingStream, Fault> + Send + 'static,
    ) -> Self {
        let (news, told) = sync_channel(WAITING);
        let (finished, done) = sync_channel(1);
        let over = Arc::new(AtomicBool::new(false));
        let (experiment, seen) = (experiment.clone(), over.clone());
        thread::spawn(move || {
            // Whatever goes wrong, the run does not depend on it, and its recording is written when it is over.
            if let Ok(stream) = open(RecordingStreamBuilder::new(APPLICATION), &seen) {
                _ = Growing::record(stream, &experiment, together, &told);
            }
            _ = finished.send(());
        });
        Self { news, over, done: Mutex::new(done) }
    }

    /// A lesson has been taught, number `number` of those of the run.
    pub fn lesson(&self, robot: &RobotModel, number: usize, lesson: &LessonRecord) {
        self.tell(News::Lesson(Box::new(robot.clone()), number, lesson.clone()));
    }

    /// All demonstrations have been taught.
    pub fn taught(&self, robot: &RobotModel, lessons: &[LessonRecord]) {
        self.tell(News::Taught(Box::new(robot.clone()), lessons.to_vec()));
    }

    /// The skill is learned and its movement planned.
    pub fn planned(&self, outcome: &RunOutcome) {
        self.tell(News::Planned(Box::new(outcome.clone())));
    }

    /// A step of the execution has been logged.
    pub fn stepped(&self, record: &StepRecord) {
        self.tell(News::Stepped(Box::new(record.clone())));
    }

    /// The run has ended so, in words.
    pub fn ended(&self, result: &str) {
        self.tell(News::Ended(result.to_owned()));
    }

    /// Gives the recording so long to catch up; whether it did. Otherwise it is left alone.
    pub fn finish(self, patience: Duration) -> bool {
        self.over.store(true, Ordering::Relaxed);
        drop(self.news);
        let done = self.done.into_inner().unwrap_or_else(PoisonError::into_inner);
        done.recv_timeout(patience) != Err(RecvTimeoutError::Timeout)
    }

    fn tell(&self, news: News) {
        // No room, or nobody there to listen: it is left out.
        _ = self.news.try_send(news);
    }
}
