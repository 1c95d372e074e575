//! Evenly spaced keys, whatever the motion does.

/// Returns `count` places between both ends of a list of `frames`, as evenly as whole places allow; all places if
/// `count` is larger.
pub fn uniform(frames: usize, count: usize) -> Vec<usize> {
    let inner = frames.saturating_sub(2);
    if count >= inner {
        return (1..=inner).collect();
    }
    let step = (frames - 1) as f64 / (count + 1) as f64;
    (1..=count).map(|key| (key as f64 * step).round() as usize).collect()
}

/// Returns every `step`-th place from the first on, without the ends: 2 for twos (2コマ打ち), 3 for threes.
///
/// # Panics
/// When `step` is 0.
pub fn every(frames: usize, step: usize) -> Vec<usize> {
    (step..frames.saturating_sub(1)).step_by(step).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_stand_at_even_distances_and_never_on_the_ends() {
        assert_eq!(uniform(11, 4), [2, 4, 6, 8]);
        assert_eq!(uniform(11, 1), [5]);
        assert_eq!(uniform(5, 7), [1, 2, 3], "no more than there are");
        for frames in 0..40 {
            for count in 0..40 {
                let keys = uniform(frames, count);
                assert_eq!(keys.len(), count.min(frames.saturating_sub(2)));
                assert!(keys.windows(2).all(|pair| pair[0] < pair[1]), "{frames} {count}");
                assert!(keys.iter().all(|key| (1..frames - 1).contains(key)), "{frames} {count}");
            }
        }
    }

    #[test]
    fn twos_are_every_second_koma() {
        assert_eq!(every(8, 2), [2, 4, 6]);
        assert_eq!(every(7, 3), [3], "6 is the end");
        assert!(every(0, 2).is_empty() && every(2, 2).is_empty());
    }
}
