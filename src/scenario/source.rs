//! The texts that a scenario is made of: its file, the files it extends, and the overrides of the command line.

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::fault::{Code, Fault};

/// Largest scenario file that is read (bytes): a thousand times the size of a long one.
pub(super) const MAX_BYTES: u64 = 1 << 20;

/// Rank of what is typed on the command line.
pub(super) const COMMAND_LINE: i32 = 2;

/// Rank of the values that a `[[sweep]]` of a file puts over the file's own.
const SWEPT: i32 = 1;

/// The number of a text in [`Sources`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct SourceId(usize);

/// A stretch of a text, in bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Origin {
    /// Which text.
    pub source: SourceId,
    /// First byte.
    pub start: usize,
    /// One past the last byte.
    pub end: usize,
}

/// One text.
#[derive(Clone, Debug)]
pub(super) struct Source {
    /// What messages call it: the path as typed, or `--set`.
    pub name: String,
    /// Relative paths in it start here.
    pub directory: PathBuf,
    /// The text, without a byte order mark.
    pub text: Arc<str>,
    /// Later layers win: 0 for the scenario, -1, -2, … for what it extends, 1 for what its `[[sweep]]` varies, 2 for the command line.
    pub rank: i32,
}

/// All texts of one scenario.
#[derive(Clone, Debug, Default)]
pub(super) struct Sources(Vec<Source>);

impl Sources {
    /// Adds a text and returns its number.
    pub fn add(&mut self, source: Source) -> SourceId {
        self.0.push(source);
        SourceId(self.0.len() - 1)
    }

    /// The text with that number.
    pub fn get(&self, id: SourceId) -> &Source {
        &self.0[id.0]
    }

    /// The same place, in the layer of what a sweep varies: above all files, below the command line.
    pub fn swept(&mut self, origin: Origin) -> Origin {
        let typed = self.get(origin.source);
        if typed.rank >= SWEPT {
            return origin;
        }
        let same = |source: &Source| source.rank == SWEPT && source.name == typed.name && source.directory == typed.directory;
        let source = match self.0.iter().position(same) {
            Some(index) => SourceId(index),
            None => self.add(Source { rank: SWEPT, ..typed.clone() }),
        };
        Origin { source, ..origin }
    }

    /// The layer in which something was typed.
    pub fn rank(&self, origin: Origin) -> i32 {
        self.get(origin.source).rank
    }

    /// The files among them.
    pub fn files(&self) -> Vec<PathBuf> {
        self.0.iter().filter(|source| source.rank <= 0).map(|source| PathBuf::from(&source.name)).collect()
    }

    /// Whether something was typed in a file, and is not a value over which a sweep goes.
    pub fn is_of_a_file(&self, origin: Origin) -> bool {
        self.rank(origin) <= 0
    }

    /// Whether something was typed on the command line.
    pub fn is_override(&self, origin: Origin) -> bool {
        self.rank(origin) >= COMMAND_LINE
    }
}

/// Reads a scenario file; what is wrong with the file as a whole is a fault without a place in the text.
pub(super) fn read(path: &Path) -> Result<String, Fault> {
    let name = path.display();
    let unreadable = |error: std::io::Error| {
        let help = match error.kind() {
            std::io::ErrorKind::NotFound => "check the path; `cpdmp list` shows the scenarios that are there",
            std::io::ErrorKind::IsADirectory => "name a scenario file in that folder",
            _ => "check the permissions of the file",
        };
        Fault::whole_file(Code::Unreadable, path, format!("cannot read `{name}`: {error}")).help(help)
    };
    // Opening a pipe could wait for ever; of a folder, reading says best what is wrong.
    let about = std::fs::metadata(path).map_err(unreadable)?;
    if !about.is_file() && !about.is_dir() {
        let message = format!("cannot read `{name}`: it is no regular file");
        return Err(Fault::whole_file(Code::Unreadable, path, message).help("name a file; pipes and devices are not read"));
    }
    let file = File::open(path).map_err(unreadable)?;
    let mut bytes = Vec::new();
    file.take(MAX_BYTES + 1).read_to_end(&mut bytes).map_err(unreadable)?;
    decode(&bytes).map_err(|message| Fault::whole_file(Code::Encoding, path, format!("`{name}` {message}")))
}

/// Bytes as text: UTF-8, no NUL, a byte order mark skipped, the size capped.
fn decode(bytes: &[u8]) -> Result<String, String> {
    if bytes.len() as u64 > MAX_BYTES {
        return Err(format!("is larger than {MAX_BYTES} bytes, the most that is read of a scenario"));
    }
    let text = std::str::from_utf8(bytes).map_err(|error| format!("is not UTF-8: byte {} cannot be read", error.valid_up_to()))?;
    if let Some(offset) = text.find('\0') {
        return Err(format!("holds a NUL character at byte {offset}"));
    }
    Ok(text.strip_prefix('\u{feff}').unwrap_or(text).to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_byte_order_mark_is_skipped() {
        assert_eq!(decode(b"\xef\xbb\xbfa = 1\r\n"), Ok("a = 1\r\n".to_owned()));
    }

    #[test]
    fn bytes_that_are_no_text_are_named_by_their_offset() {
        assert!(decode(b"a = \xff").is_err_and(|message| message.contains("byte 4")));
        assert!(decode(b"a = 1\0").is_err_and(|message| message.contains("byte 5")));
    }

    #[test]
    fn size_is_capped() {
        assert!(decode(&vec![b'#'; MAX_BYTES as usize]).is_ok());
        assert!(decode(&vec![b'#'; MAX_BYTES as usize + 1]).is_err_and(|message| message.contains("larger than")));
    }
}
