//! Writes a GIF: only the pixels that change, and a longer time for a picture that stays.

use std::borrow::Cow;
use std::io::Write;

use gif::{DisposalMethod, Encoder, Frame, Repeat};

use super::palette::Palette;
use crate::style::{cannot, failed};
use genga::error::Error;

/// The picture on show. It is not written yet, since the next picture ends its time.
struct Waiting {
    frame: Frame<'static>,
    /// Time at which it began, in hundredths of a second.
    since: u64,
}

/// A GIF in progress.
pub(super) struct Movie<W: Write> {
    encoder: Encoder<W>,
    size: (u16, u16),
    unchanged: u8,
    /// Last picture, one index per pixel.
    last: Vec<u8>,
    waiting: Option<Waiting>,
}

impl<W: Write> Movie<W> {
    pub(super) fn begin(
        file: W,
        (width, height): (u32, u32),
        palette: &Palette,
    ) -> Result<Self, Error> {
        let side = |px: u32| u16::try_from(px).map_err(|_| cannot("the preview is too large"));
        let size = (side(width)?, side(height)?);
        let mut encoder = Encoder::new(file, size.0, size.1, &palette.bytes()).map_err(failed)?;
        encoder.set_repeat(Repeat::Infinite).map_err(failed)?;
        let unchanged = palette.unchanged();
        Ok(Self { encoder, size, unchanged, last: Vec::new(), waiting: None })
    }

    /// Shows a picture from a koma on.
    pub(super) fn show(
        &mut self,
        picture: Vec<u8>,
        koma: usize,
        koma_rate: f64,
    ) -> Result<(), Error> {
        let Some(frame) = self.change(&picture) else {
            return Ok(());
        };
        let since = hundredths(koma, koma_rate);
        self.write_waiting(since)?;
        self.waiting = Some(Waiting { frame, since });
        self.last = picture;
        Ok(())
    }

    /// Ends the GIF; the last picture is shown until `koma` koma have passed.
    pub(super) fn finish(mut self, koma: usize, koma_rate: f64) -> Result<(), Error> {
        self.write_waiting(hundredths(koma, koma_rate))?;
        let mut file = self.encoder.into_inner().map_err(failed)?;
        file.flush().map_err(failed)
    }

    fn write_waiting(&mut self, until: u64) -> Result<(), Error> {
        let Some(Waiting { mut frame, since }) = self.waiting.take() else {
            return Ok(());
        };
        frame.delay = u16::try_from(until - since).unwrap_or(u16::MAX);
        self.encoder.write_frame(&frame).map_err(failed)
    }

    /// Returns the rectangle round the changed pixels; `None` if nothing changes.
    fn change(&self, picture: &[u8]) -> Option<Frame<'static>> {
        let width = usize::from(self.size.0);
        if self.last.is_empty() {
            let buffer = Cow::Owned(picture.to_vec());
            let (width, height) = self.size;
            return Some(Frame {
                width,
                height,
                buffer,
                dispose: DisposalMethod::Keep,
                ..Frame::default()
            });
        }
        let changes: Vec<usize> =
            (0..picture.len()).filter(|at| picture[*at] != self.last[*at]).collect();
        let (first, last) = (changes.first()? / width, changes.last()? / width);
        let columns = changes.iter().map(|at| at % width);
        let (left, right) = (columns.clone().min()?, columns.max()?);
        let pixel = |at: usize| {
            if picture[at] == self.last[at] { self.unchanged } else { picture[at] }
        };
        let row = |row: usize| (row * width + left..=row * width + right).map(pixel);
        let buffer: Vec<u8> = (first..=last).flat_map(row).collect();
        let px = |px: usize| u16::try_from(px).expect("it lies inside the picture");
        Some(Frame {
            left: px(left),
            top: px(first),
            width: px(right - left + 1),
            height: px(last - first + 1),
            transparent: Some(self.unchanged),
            dispose: DisposalMethod::Keep,
            buffer: Cow::Owned(buffer),
            ..Frame::default()
        })
    }
}

/// Returns the time at which a koma begins, in hundredths of a second.
fn hundredths(koma: usize, koma_rate: f64) -> u64 {
    (100.0 * koma as f64 / koma_rate).round() as u64
}

#[cfg(test)]
mod tests {
    use gif::DecodeOptions;

    use super::*;

    #[test]
    fn what_stays_is_shown_longer_and_not_written_again() {
        let mut bytes = Vec::new();
        let mut movie = Movie::begin(&mut bytes, (3, 2), &Palette::new()).unwrap();
        for (koma, ink) in [1, 1, 1, 2, 2, 1].into_iter().enumerate() {
            movie.show(vec![0, 0, 0, 0, ink, 0], koma, 24.0).unwrap();
        }
        movie.finish(6, 24.0).unwrap();
        let mut decoder = DecodeOptions::new().read_info(bytes.as_slice()).unwrap();
        let mut frames = Vec::new();
        while let Some(frame) = decoder.read_next_frame().unwrap() {
            frames.push((frame.delay, frame.left, frame.top, frame.width, frame.height));
        }
        let whole = (13, 0, 0, 3, 2);
        assert_eq!(frames, [whole, (8, 1, 1, 1, 1), (4, 1, 1, 1, 1)], "3, 2 and 1 koma; one pixel");
    }
}
