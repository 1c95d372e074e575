//! Reads input of unknown length, such as a pipe, up to a limit.

use std::io::{self, ErrorKind, Read};

use serde::{Deserialize, Serialize};

/// Bytes in a GiB.
pub(crate) const GIB: f64 = (1u64 << 30) as f64;

/// The most bytes read from a pipe or a device (読み込みの上限), whose total length is unknown in advance.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct StreamLimit {
    /// Limit in bytes; default 1 GiB. A higher limit lets an endless stream take more memory before it is
    /// refused.
    pub bytes: u64,
}

impl Default for StreamLimit {
    fn default() -> Self {
        Self::gib(1.0)
    }
}

impl StreamLimit {
    /// Creates a limit of `gib` GiB.
    pub fn gib(gib: f64) -> Self {
        Self { bytes: (gib * GIB) as u64 }
    }

    /// Reads the whole input, a regular file or a stream.
    ///
    /// # Errors
    /// The I/O error of the system, or [`ErrorKind::FileTooLarge`] with advice if the input exceeds the
    /// limit.
    pub fn read(self, from: impl Read) -> io::Result<Vec<u8>> {
        let mut bytes = Vec::new();
        from.take(self.bytes.saturating_add(1)).read_to_end(&mut bytes)?;
        if bytes.len() as u64 <= self.bytes {
            return Ok(bytes);
        }
        let most = bytes_in_words(self.bytes as f64);
        let message = format!(
            "more than {most} came, which is the most of a pipe or a device; save it as a file first, or allow more with \
             --memory GIB"
        );
        Err(io::Error::new(ErrorKind::FileTooLarge, message))
    }
}

/// Formats a byte count for people.
pub fn bytes_in_words(bytes: f64) -> String {
    if bytes < GIB {
        format!("{:.0} MiB", bytes / GIB * 1024.0)
    } else {
        format!("{:.1} GiB", bytes / GIB)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stream_is_read_up_to_the_limit_and_no_further() {
        let limit = StreamLimit { bytes: 1000 };
        assert_eq!(limit.read(&[7; 1000][..]).unwrap(), [7; 1000]);
        let mut endless = io::repeat(7);
        let error = limit.read(&mut endless).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::FileTooLarge);
        let most = StreamLimit { bytes: 5 << 20 }.read(io::repeat(0)).unwrap_err().to_string();
        assert!(most.starts_with("more than 5 MiB came"), "{most}");
        assert_eq!(StreamLimit::gib(0.5).bytes, 1 << 29);
        assert_eq!(StreamLimit::gib(1e30).read(&[1u8][..]).unwrap(), [1], "any number will do");
    }
}
