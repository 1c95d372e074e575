//! Reads the bytes of a model file in order, with bounds checks.

use glam::DVec3;

use genga::error::{Error, Place};

/// Builds an error at a byte.
pub(super) fn damaged(byte: usize, message: impl Into<String>) -> Error {
    Error::Motion { place: Place::Byte(byte as u64), message: message.into() }
}

pub(super) struct Bytes<'a> {
    all: &'a [u8],
    at: usize,
}

impl<'a> Bytes<'a> {
    /// Creates a reader that starts behind the first `at` bytes.
    pub(super) fn after(at: usize, all: &'a [u8]) -> Self {
        Self { all, at }
    }

    /// The offset of the next byte, from 0.
    pub(super) fn at(&self) -> usize {
        self.at
    }

    /// Takes the next bytes; `what` names them in the error if the file ends too early.
    pub(super) fn take(&mut self, count: usize, what: &str) -> Result<&'a [u8], Error> {
        let taken = self.all[self.at..].get(..count);
        let taken =
            taken.ok_or_else(|| damaged(self.at, format!("the file ends in its {what}")))?;
        self.at += count;
        Ok(taken)
    }

    /// Skips `count` items of this many bytes.
    pub(super) fn skip(&mut self, count: usize, bytes: usize, what: &str) -> Result<(), Error> {
        self.take(count.saturating_mul(bytes), what).map(drop)
    }

    fn array<const N: usize>(&mut self, what: &str) -> Result<[u8; N], Error> {
        let mut array = [0; N];
        array.copy_from_slice(self.take(N, what)?);
        Ok(array)
    }

    pub(super) fn byte(&mut self, what: &str) -> Result<u8, Error> {
        self.array(what).map(|[byte]| byte)
    }

    pub(super) fn word(&mut self, what: &str) -> Result<u16, Error> {
        self.array(what).map(u16::from_le_bytes)
    }

    pub(super) fn long(&mut self, what: &str) -> Result<u32, Error> {
        self.array(what).map(u32::from_le_bytes)
    }

    pub(super) fn single(&mut self, what: &str) -> Result<f32, Error> {
        self.array(what).map(f32::from_le_bytes)
    }

    /// Reads the number of items that follow, each of at least `least` bytes, and checks it against the
    /// bytes left.
    pub(super) fn count(&mut self, least: usize, what: &str) -> Result<usize, Error> {
        let at = self.at;
        let count = self.long(what)? as usize;
        self.bounded(count, least, at, what)
    }

    /// Returns the count if the bytes left can hold that many items.
    pub(super) fn bounded(
        &self,
        count: usize,
        least: usize,
        at: usize,
        what: &str,
    ) -> Result<usize, Error> {
        let left = self.all.len() - self.at;
        if count > left / least.max(1) {
            let message = format!("{count} {what} do not go into the {left} bytes that are left");
            return Err(damaged(at, message));
        }
        Ok(count)
    }

    /// Reads a position, and converts it from MMD's left-handed axes to axes with +Z in front.
    pub(super) fn place(&mut self, what: &str) -> Result<DVec3, Error> {
        let at = self.at;
        let [x, y, z] = [self.single(what)?, self.single(what)?, self.single(what)?];
        let place = DVec3::new(x.into(), y.into(), -f64::from(z));
        if place.is_finite() {
            Ok(place)
        } else {
            Err(damaged(at, format!("{what} stand nowhere")))
        }
    }
}
