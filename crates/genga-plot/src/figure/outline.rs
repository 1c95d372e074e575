//! Computes the outline (輪郭) of a part: the shape of a tight band round its circles.

use crate::paper_point::Point;
use genga::maths;

/// Number of directions in which the outline is sampled. Even, so that a mirrored part has the mirrored
/// outline.
pub(super) const DIRECTIONS: usize = 20;

/// Returns the convex outline of some circles, each a centre and a radius. Coinciding points are merged.
pub(super) fn outline(circles: &[(Point, f64)]) -> Vec<Point> {
    let mut outline: Vec<Point> = Vec::with_capacity(DIRECTIONS);
    for step in 0..DIRECTIONS {
        let angle = (step as f64 + 0.5) * std::f64::consts::TAU / DIRECTIONS as f64;
        let (sine, cosine) = maths::sin_cos(angle);
        let reach = |&((x, y), radius): &(Point, f64)| x * cosine + y * sine + radius;
        let furthest = circles.iter().max_by(|a, b| reach(a).total_cmp(&reach(b)));
        outline.extend(furthest.map(|((x, y), radius)| (x + radius * cosine, y + radius * sine)));
    }
    outline.dedup();
    outline
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_outline_holds_all_of_its_circles_and_nothing_far_from_them() {
        let circles = [((0.0, 0.0), 2.0), ((10.0, 3.0), 1.0), ((4.0, 1.0), 0.5)];
        let outline = outline(&circles);
        assert_eq!(outline.len(), DIRECTIONS);
        let area = |a: Point, b: Point| a.0 * b.1 - a.1 * b.0;
        let turns = (0..outline.len()).map(|at| {
            let [a, b, c] = [0, 1, 2].map(|next| outline[(at + next) % outline.len()]);
            area((b.0 - a.0, b.1 - a.1), (c.0 - b.0, c.1 - b.1))
        });
        assert!(turns.into_iter().all(|turn| turn >= -1e-9), "it is convex");
        let edge = |point: Point| {
            let to = |&((x, y), radius): &(Point, f64)| (point.0 - x).hypot(point.1 - y) - radius;
            circles.iter().map(to).fold(f64::INFINITY, f64::min)
        };
        assert!(outline.iter().all(|point| edge(*point).abs() < 1e-9), "its points are on circles");
    }

    #[test]
    fn a_mirrored_part_has_the_mirrored_outline() {
        let circles = [((0.0, 0.0), 2.0), ((10.0, 3.0), 1.0)];
        let mirrored = circles.map(|((x, y), radius)| ((-x, y), radius));
        let mut of_mirrored = outline(&mirrored);
        of_mirrored.iter_mut().for_each(|point| point.0 = -point.0);
        for (x, y) in outline(&circles) {
            assert!(of_mirrored.iter().any(|other| (other.0 - x).hypot(other.1 - y) < 1e-9));
        }
    }
}
