//! Room (余白) for marks and words along a line: a mark is drawn only if it does not touch the previous one.

/// The next free position along a line. Default: the line is empty.
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
    /// Takes the room of a mark, if it is still free. Returns whether it was.
    pub(super) fn take(&mut self, from: f32, length: f32) -> bool {
        let has_room = from >= self.free;
        if has_room {
            self.free = from + length;
        }
        has_room
    }
}

/// Steps between labels if not everything has its own.
const STEPS: [usize; 14] = [1, 2, 5, 10, 20, 30, 60, 120, 300, 600, 1200, 1800, 3600, 7200];

/// The round step between labelled items that are `across` points apart, such that labels stand at least `room` points
/// apart.
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
