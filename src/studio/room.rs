//! Room (余白) for marks and words along a line: the next one is drawn only where it does not touch the last.

/// How far along a line marks stand by now; an empty line at first.
#[derive(Debug, Clone, Copy)]
pub(super) struct Room {
    free: f32,
}

impl Default for Room {
    fn default() -> Self {
        Self { free: f32::NEG_INFINITY }
    }
}

impl Room {
    /// Whether a mark of this length has room from here on; it then has taken it.
    pub(super) fn take(&mut self, from: f32, length: f32) -> bool {
        let has_room = from >= self.free;
        if has_room {
            self.free = from + length;
        }
        has_room
    }
}

/// Steps in which things are counted where not each has a number.
const STEPS: [usize; 14] = [1, 2, 5, 10, 20, 30, 60, 120, 300, 600, 1200, 1800, 3600, 7200];

/// How many of what lies `across` points apart are passed over from one number to the next, so that `room` points lie
/// between them: a round count.
pub(super) fn step(across: f32, room: f32) -> usize {
    let last = STEPS[STEPS.len() - 1];
    STEPS.into_iter().find(|step| *step as f32 * across >= room).unwrap_or(last)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_would_touch_the_last_that_was_drawn_is_left_out() {
        let mut room = Room::default();
        let drawn: Vec<f32> =
            [0.0, 5.0, 9.9, 10.0, 13.0, 30.0].into_iter().filter(|x| room.take(*x, 10.0)).collect();
        assert_eq!(drawn, [0.0, 10.0, 30.0]);
    }

    #[test]
    fn numbers_come_back_on_coming_nearer() {
        assert_eq!(step(1.8, 40.0), 30);
        assert_eq!(step(9.0, 40.0), 5);
        assert_eq!(step(40.0, 40.0), 1);
        assert_eq!(step(0.0, 40.0), 7200, "a line without any length ends too");
    }
}
