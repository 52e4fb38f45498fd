//! How large the pages of a Parquet file say that they are, read before one is unpacked: the library makes room for whatever a page claims, and a
//! few kilobytes can claim gigabytes.
//!
//! A page's head is a Thrift structure in the compact protocol; of its fields only the two sizes are taken, the others are passed over.

use ::parquet::basic::Compression;
use ::parquet::errors::ParquetError;
use ::parquet::file::metadata::ParquetMetaData;

/// The largest page that is unpacked (bytes): sixty times what writers make.
const MOST_BYTES: i64 = 64 << 20;

/// Structures within structures that are passed over.
const DEEPEST: usize = 16;

/// Looks at the heads of all pages of the file `bytes`.
///
/// # Errors
/// When one cannot be read, claims too much, or is packed in a way whose size nobody claims.
pub(super) fn check(bytes: &[u8], metadata: &ParquetMetaData) -> Result<(), ParquetError> {
    for column in metadata.row_groups().iter().flat_map(|group| group.columns()) {
        let packing = column.compression();
        if !matches!(packing, Compression::UNCOMPRESSED | Compression::SNAPPY | Compression::ZSTD(_) | Compression::LZ4_RAW) {
            return Err(ParquetError::General(format!("Disabled feature: {packing}")));
        }
        let (start, length) = column.byte_range();
        let range = usize::try_from(start).ok().zip(usize::try_from(start.saturating_add(length)).ok());
        let pages = range.and_then(|(start, end)| bytes.get(start..end));
        let pages = pages.ok_or_else(|| ParquetError::General("a column lies beyond its end".to_owned()))?;
        in_column(pages)?;
    }
    Ok(())
}

fn in_column(pages: &[u8]) -> Result<(), ParquetError> {
    let mut at = Reader { bytes: pages, place: 0 };
    while at.place < pages.len() {
        let (unpacked, packed) = at.head().ok_or_else(|| ParquetError::General("the head of a page cannot be read".to_owned()))?;
        if !(0..=MOST_BYTES).contains(&unpacked) {
            return Err(ParquetError::General(format!("a page claims {unpacked} bytes; at most {MOST_BYTES} are read")));
        }
        at.skip_bytes(packed).ok_or_else(|| ParquetError::General("a page ends beyond its column".to_owned()))?;
    }
    Ok(())
}

struct Reader<'a> {
    bytes: &'a [u8],
    place: usize,
}

impl Reader<'_> {
    /// Reads a page's head: its size unpacked and packed (bytes).
    fn head(&mut self) -> Option<(i64, i64)> {
        let (mut unpacked, mut packed) = (None, None);
        let mut id = 0;
        while let Some((kind, next)) = self.field(id)? {
            id = next;
            match (id, kind) {
                (2, 5) if unpacked.is_none() => unpacked = Some(self.whole()?),
                (3, 5) if packed.is_none() => packed = Some(self.whole()?),
                // Whoever reads the page might believe the other one.
                (2 | 3, _) => return None,
                _ => self.skip(kind, DEEPEST)?,
            }
        }
        Some((unpacked?, packed?))
    }

    /// The kind and number of the next field, after that with the number `before`; `Some(None)` at the end of the structure.
    fn field(&mut self, before: i64) -> Option<Option<(u8, i64)>> {
        let byte = self.byte()?;
        let (step, kind) = (byte >> 4, byte & 15);
        match (byte, step) {
            (0, _) => Some(None),
            (_, 0) => Some(Some((kind, self.whole()?))),
            _ => Some(Some((kind, before + i64::from(step)))),
        }
    }

    fn skip(&mut self, kind: u8, deep: usize) -> Option<()> {
        let deep = deep.checked_sub(1)?;
        match kind {
            // A truth value is its kind.
            1 | 2 => Some(()),
            3 => self.byte().map(|_| ()),
            4..=6 => self.number().map(|_| ()),
            7 => self.skip_bytes(8),
            8 => {
                let length = i64::try_from(self.number()?).ok()?;
                self.skip_bytes(length)
            }
            9 | 10 => {
                let head = self.byte()?;
                let count = if head >> 4 == 15 { self.number()? } else { u64::from(head >> 4) };
                (0..count).try_for_each(|_| self.skip_item(head & 15, deep))
            }
            11 => {
                let count = self.number()?;
                let kinds = if count == 0 { 0 } else { self.byte()? };
                (0..count).try_for_each(|_| self.skip_item(kinds >> 4, deep).and_then(|()| self.skip_item(kinds & 15, deep)))
            }
            12 => {
                let mut id = 0;
                while let Some((kind, next)) = self.field(id)? {
                    id = next;
                    self.skip(kind, deep)?;
                }
                Some(())
            }
            _ => None,
        }
    }

    /// An item of a list: there a truth value has a byte of its own, so that every item takes one at least.
    fn skip_item(&mut self, kind: u8, deep: usize) -> Option<()> {
        if matches!(kind, 1 | 2) { self.byte().map(|_| ()) } else { self.skip(kind, deep) }
    }

    fn byte(&mut self) -> Option<u8> {
        let byte = *self.bytes.get(self.place)?;
        self.place += 1;
        Some(byte)
    }

    fn skip_bytes(&mut self, count: i64) -> Option<()> {
        let end = self.place.checked_add(usize::try_from(count).ok()?)?;
        self.place = Some(end).filter(|end| *end <= self.bytes.len())?;
        Some(())
    }

    /// Seven bits per byte, the lowest first.
    fn number(&mut self) -> Option<u64> {
        let mut number = 0;
        for shift in (0..64).step_by(7) {
            let byte = self.byte()?;
            number |= u64::from(byte & 127) << shift;
            if byte < 128 {
                return Some(number);
            }
        }
        None
    }

    /// A number with a sign, which stands in its lowest bit.
    fn whole(&mut self) -> Option<i64> {
        let number = self.number()?;
        Some((number >> 1) as i64 ^ -((number & 1) as i64))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(pages: &[u8]) -> String {
        in_column(pages).map_or_else(|error| error.to_string(), |()| "good".to_owned())
    }

    /// A page with a head of these sizes, a truth value, a text and a structure with a list, and three bytes.
    fn page(unpacked: [u8; 5]) -> Vec<u8> {
        // Field 1: kind of page; 2 and 3: the sizes; 4: true; 5: text; 6: a structure with a list of two whole numbers.
        let mut bytes = vec![0x15, 0x00, 0x15];
        bytes.extend(unpacked);
        bytes.extend([0x15, 0x06, 0x11, 0x18, 2, b'a', b'b', 0x1c, 0x19, 0x25, 0x02, 0x04, 0x00, 0x00, 7, 7, 7]);
        bytes
    }

    #[test]
    fn a_page_says_how_large_it_is() {
        // 1000 and 2^31 - 1, doubled for the sign, in five groups of seven bits each.
        let (small, large) = ([0xd0, 0x8f, 0x80, 0x80, 0x00], [0xfe, 0xff, 0xff, 0xff, 0x0f]);
        assert_eq!(told(&[page(small), page(small)].concat()), "good");
        assert!(told(&[page(small), page(large)].concat()).contains("claims 2147483647 bytes"));
        // A size that is told again, or in another way, might be the one that is believed.
        for again in [&[0x05, 0x04, 0xd0, 0x8f, 0x80, 0x80, 0x00][..], &[0x06, 0x04, 0xd0, 0x8f, 0x80, 0x80, 0x00]] {
            let mut twice = page(small);
            twice.splice(10..10, again.iter().copied());
            assert!(told(&twice).contains("head of a page cannot be read"), "{}", told(&twice));
        }
        let cut = page(small);
        for end in 1..cut.len() {
            assert_ne!(told(&cut[..end]), "good", "{end}");
        }
    }

    #[test]
    fn heads_without_end_are_refused() {
        assert_ne!(told(&[0x1c; 10_000]), "good");
        assert_ne!(told(&[0x19, 0xf1, 0xff, 0xff, 0xff, 0xff, 0xff, 0x7f]), "good");
    }
}
