//! Settings that are allowed and probably not meant.

use crate::motion::Clip;
use crate::recipe::Recipe;
use crate::signal::{Measure, Steady};
use crate::time::Span;

impl Recipe {
    /// Says which settings are probably not meant for a clip: a span without its unit, or a dead band in a unit that
    /// differs from file to file.
    ///
    /// ```
    /// # use genga::{motion::Clip, recipe::Recipe};
    /// # let clip = genga::motion::bvh::open("data/kick.bvh".as_ref())?.clip;
    /// let mut recipe = Recipe::default();
    /// assert!(recipe.doubts(&clip).is_empty());
    /// recipe.set("filter.width", "0.2")?;
    /// assert!(recipe.doubts(&clip)[0].starts_with("filter.width: 0.2 is less than a frame"));
    /// # Ok::<(), genga::Error>(())
    /// ```
    pub fn doubts(&self, clip: &Clip) -> Vec<String> {
        let spans =
            [("filter.width", self.filter.width), ("turns.persistence", self.turns.persistence)];
        let spans = spans.into_iter().filter_map(|(name, span)| {
            let frames = span.frames(clip.rate());
            let what = match span {
                Span::Frames(frames) if frames > 0.0 && frames < 1.0 => {
                    format!("less than a frame; seconds are written {frames}s")
                }
                _ if clip.len() > 1 && frames > clip.len() as f64 => "longer than the clip".into(),
                _ => return None,
            };
            Some(format!("{name}: {span} is {what}"))
        });
        spans.chain(self.dead_band_in_doubt()).collect()
    }

    /// Says that the dead band is in a unit of the file, or of its own, and may hide all turns of joints or none.
    pub fn dead_band_in_doubt(&self) -> Option<String> {
        let measure = self.speed.measure;
        match self.turns.steady {
            Steady::Acceleration(steady)
                if steady > 0.0 && matches!(measure, Measure::Displacement | Measure::Combined) =>
            {
                Some(format!(
                    "turns.steady: {steady} is in the unit of speed.measure={measure} a second, and may hide all turns or \
                     none; a share, as 5%, fits any file"
                ))
            }
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_probably_not_meant_is_told() {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/data/kick.bvh");
        let clip = crate::motion::bvh::open(path.as_ref()).unwrap().clip;
        let doubts = |settings: &[(&str, &str)]| {
            let mut recipe = Recipe::default();
            settings.iter().for_each(|(name, value)| recipe.set(name, value).unwrap());
            recipe.doubts(&clip).join("\n")
        };
        assert_eq!(doubts(&[]), "");
        assert_eq!(doubts(&[("filter.width", "0")]), "", "it is no filter");
        assert!(doubts(&[("filter.width", "0.2")]).contains("seconds are written 0.2s"));
        assert!(doubts(&[("turns.persistence", "900s")]).contains("longer than the clip"));
        let measure = ("speed.measure", "combined");
        assert!(doubts(&[measure]).starts_with("turns.steady: 100 is in the unit of"));
        assert_eq!(doubts(&[measure, ("turns.steady", "5%")]), "");
        assert_eq!(doubts(&[measure, ("turns.steady", "0")]), "");
    }
}
