//! The end of a recording that has grown: the table of its pieces, which a file that is written to its end has.

use std::fs::File;
use std::io::BufReader;
use std::path::Path;

use rerun::external::re_log_encoding::{DecoderApp, Encoder};
use rerun::external::re_log_types::LogMsg;

use super::recorder::Fault;
use super::write::save;
use crate::recording::RecordingError;

/// Writes what the growing recording `from` holds to `to`, with its footer. What a cut has left of a last piece is left out.
///
/// # Errors
/// When the one cannot be read or the other not be written.
pub fn close_recording(from: &Path, to: &Path) -> Result<(), RecordingError> {
    let file = File::open(from).map_err(|source| RecordingError::Io { path: from.to_owned(), source })?;
    let closed = closed(file).map_err(|source| RecordingError::Rerun { path: from.to_owned(), source })?;
    save(to, &closed)
}

fn closed(file: File) -> Result<Vec<u8>, Fault> {
    let whole = DecoderApp::decode_lazy(BufReader::new(file)).map_while(Result::ok);
    Ok(Encoder::encode(whole.map(|message: LogMsg| Ok(message)))?)
}
