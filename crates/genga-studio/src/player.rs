//! The player (再生): the koma at the play head, and playback.

use std::ops::Range;

/// The play head.
#[derive(Debug, Clone, Default)]
pub(super) struct Player {
    /// The koma at the play head, from 0.
    pub(super) at: usize,
    /// The koma played in a loop. `None` for all.
    pub(super) range: Option<Range<usize>>,
    /// Time in seconds and koma at which playback began.
    playing: Option<(f64, usize)>,
    /// Number of times playback has reached the end and begun again.
    lap: usize,
}

/// A stretch of playback without a jump: its start time, first koma and lap.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Run(f64, usize, usize);

impl Player {
    pub(super) fn is_playing(&self) -> bool {
        self.playing.is_some()
    }

    /// The current stretch of playback. `None` while stopped.
    pub(super) fn run(&self) -> Option<Run> {
        self.playing.map(|(since, from)| Run(since, from, self.lap))
    }

    /// Starts or stops playback.
    pub(super) fn toggle(&mut self, now: f64, length: usize) {
        self.playing = match self.playing {
            Some(_) => None,
            None => {
                let range = self.played(length);
                if !range.contains(&self.at) {
                    self.at = range.start;
                }
                Some((now, self.at))
            }
        };
    }

    /// Goes to a koma of a sheet. Playback continues from there.
    pub(super) fn go(&mut self, koma: usize, length: usize, now: f64) {
        self.at = koma.min(length.saturating_sub(1));
        self.playing = self.playing.map(|_| (now, self.at));
    }

    /// Stops playback.
    pub(super) fn stop(&mut self) {
        self.playing = None;
    }

    /// Stops and goes to a koma.
    pub(super) fn stop_at(&mut self, koma: usize, length: usize) {
        self.stop();
        self.go(koma, length, 0.0);
    }

    /// The koma played, on a sheet of `length` koma.
    pub(super) fn played(&self, length: usize) -> Range<usize> {
        let range = self.range.clone().unwrap_or(0..length);
        let end = range.end.min(length);
        if range.start < end { range.start..end } else { 0..length }
    }

    /// Advances the play head to the current time. Returns the seconds until the next koma. `None` while stopped.
    pub(super) fn advance(&mut self, now: f64, koma_rate: f64, length: usize) -> Option<f64> {
        self.at = self.at.min(length.saturating_sub(1));
        let (since, from) = self.playing?;
        let range = self.played(length);
        let gone = ((now - since) * koma_rate).max(0.0);
        let koma = from.saturating_sub(range.start) + gone.floor() as usize;
        self.at = range.start + koma % range.len().max(1);
        self.lap = koma / range.len().max(1);
        Some((gone.floor() + 1.0 - gone) / koma_rate)
    }

    /// Begins or ends the played range at the play head.
    pub(super) fn mark(&mut self, is_begin: bool, length: usize) {
        let range = self.played(length);
        let range = if is_begin { self.at..range.end } else { range.start..self.at + 1 };
        let whole = range == (0..length);
        self.range = (!whole && range.start < range.end).then_some(range);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_plays_a_koma_after_another_and_begins_again() {
        let mut player = Player { at: 2, ..Player::default() };
        player.toggle(10.0, 4);
        for (now, koma) in [(10.0, 2), (10.04, 2), (10.05, 3), (10.09, 0), (10.13, 1)] {
            let wait = player.advance(now, 24.0, 4).unwrap();
            assert_eq!(player.at, koma, "{now}");
            assert!(wait > 0.0 && wait <= 1.0 / 24.0, "{wait}");
        }
        player.toggle(10.2, 4);
        assert_eq!((player.advance(11.0, 24.0, 4), player.at), (None, 1));
    }

    #[test]
    fn a_run_ends_with_a_jump_and_with_the_last_koma() {
        let mut player = Player::default();
        assert_eq!(player.run(), None);
        player.toggle(1.0, 24);
        let at = |player: &mut Player, now: f64| {
            player.advance(now, 24.0, 24);
            player.run()
        };
        let first = at(&mut player, 1.1);
        assert!(first.is_some());
        assert_eq!(at(&mut player, 1.9), first);
        let again = at(&mut player, 2.1);
        assert_ne!(again, first, "it began again");
        player.go(20, 24, 2.2);
        assert_ne!(at(&mut player, 2.2), again, "it went elsewhere");
        player.toggle(2.3, 24);
        assert_eq!(player.run(), None);
    }

    #[test]
    fn a_range_is_played_alone_and_a_sheet_that_got_shorter_is_played_whole() {
        let mut player = Player { at: 3, ..Player::default() };
        player.mark(true, 10);
        player.at = 5;
        player.mark(false, 10);
        assert_eq!(player.range, Some(3..6));
        player.at = 0;
        player.toggle(0.0, 10);
        player.advance(3.01 / 24.0, 24.0, 10);
        assert_eq!(player.at, 3, "from its begin, and once round");
        assert_eq!(player.played(2), 0..2);
        player.at = 0;
        player.mark(true, 6);
        assert_eq!(player.range, None, "all is no range");
    }
}
