//! How far one motion of a body is off another.

use rayon::prelude::*;

use super::fit::{Bodies, Ruler};
use genga::error::Error;
use genga::motion::{Clip, Poser};
use genga::time::Frame;

/// Measures how far another motion of the same body is off a clip: on each frame the largest distance of a joint, a tip
/// or the skin about a joint, as a share of body height.
///
/// # Errors
/// [`Error::Clip`] if the motions differ in the number of joints, of tips or of frames.
pub fn distances(clip: &Clip, made: &Clip) -> Result<Vec<f64>, Error> {
    let counts = |clip: &Clip| {
        let tips = clip.skeleton().joints.iter().map(|joint| joint.end_sites.len());
        (clip.skeleton().len(), tips.sum::<usize>(), clip.len())
    };
    if counts(clip) != counts(made) {
        let message = "the motions are of different bodies or lengths: compare clips with the same joints and frames";
        return Err(Error::clip(message));
    }
    let (first, last) = (clip.first().0 as f64, clip.last().0 as f64);
    let ruler = Ruler::new(clip, &vec![0; clip.skeleton().len()], first..=last);
    let mut found = vec![0.0; clip.len()];
    found.par_iter_mut().enumerate().for_each_init(
        || (Bodies::new(clip), Poser::new(made)),
        |(bodies, poser), (at, distance)| {
            let pose = poser.frame(Frame(made.first().0 + at));
            bodies.place_beside(Frame(clip.first().0 + at), pose);
            bodies.compare(&ruler, std::slice::from_mut(distance));
            *distance /= ruler.height;
        },
    );
    Ok(found)
}
