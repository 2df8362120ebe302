//! Paths: lines in pixels, clipped to a panel. A clipped curve may consist of several pieces.

use super::decimate::Point;

/// A rectangle in pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Frame {
    pub left: f64,
    pub top: f64,
    pub right: f64,
    pub bottom: f64,
}

/// One or more polylines, to be drawn in one go; pixels of the whole picture.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Path {
    points: Vec<Point>,
    /// Where each polyline but the first starts.
    breaks: Vec<usize>,
}

impl Path {
    /// Forgets everything but its memory.
    pub(super) fn clear(&mut self) {
        self.points.clear();
        self.breaks.clear();
    }

    /// A line from one point to another.
    pub(super) fn straight(from: Point, to: Point) -> Self {
        Self { points: vec![from, to], breaks: Vec::new() }
    }

    /// Its polylines; each has at least two points.
    pub fn pieces(&self) -> impl Iterator<Item = &[(f64, f64)]> {
        let starts = std::iter::once(0).chain(self.breaks.iter().copied());
        let ends = self.breaks.iter().copied().chain(std::iter::once(self.points.len()));
        starts.zip(ends).map(|(start, end)| &self.points[start..end]).filter(|piece| piece.len() > 1)
    }

    /// Adds the part of a polyline that is within `frame`.
    pub(super) fn add_clipped(&mut self, line: &[Point], frame: &Frame) {
        let mut at: Option<Point> = None;
        for pair in line.windows(2) {
            let Some((from, to)) = clip(pair[0], pair[1], frame) else { continue };
            if at != Some(from) {
                if !self.points.is_empty() {
                    self.breaks.push(self.points.len());
                }
                self.points.push(from);
            }
            self.points.push(to);
            at = Some(to);
        }
    }
}

/// The part of a line that is within the frame. Source: Liang and Barsky (1984).
fn clip(from: Point, to: Point, frame: &Frame) -> Option<(Point, Point)> {
    let inside = |(x, y): Point| x >= frame.left && x <= frame.right && y >= frame.top && y <= frame.bottom;
    if inside(from) && inside(to) {
        return Some((from, to));
    }
    let (dx, dy) = (to.0 - from.0, to.1 - from.1);
    let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
    let edges = [
        (-dx, from.0 - frame.left),
        (dx, frame.right - from.0),
        (-dy, from.1 - frame.top),
        (dy, frame.bottom - from.1),
    ];
    for (outwards, room) in edges {
        if outwards == 0.0 {
            if room < 0.0 {
                return None;
            }
        } else if outwards < 0.0 {
            enter = enter.max(room / outwards);
        } else {
            leave = leave.min(room / outwards);
        }
    }
    let at = |share: f64| {
        // Rounding must not leave the frame again.
        let (x, y) = (from.0 + share * dx, from.1 + share * dy);
        (x.clamp(frame.left, frame.right), y.clamp(frame.top, frame.bottom))
    };
    let exact = |share: f64, end: f64, point: Point| if share == end { point } else { at(share) };
    (enter < leave).then(|| (exact(enter, 0.0, from), exact(leave, 1.0, to)))
}

#[cfg(test)]
mod tests {
    use super::*;

    const FRAME: Frame = Frame { left: 0.0, top: 0.0, right: 10.0, bottom: 10.0 };

    fn clipped(line: &[Point]) -> Vec<Vec<Point>> {
        let mut path = Path::default();
        path.add_clipped(line, &FRAME);
        path.pieces().map(<[Point]>::to_vec).collect()
    }

    #[test]
    fn a_line_within_stays_as_it_is() {
        let line = [(0.0, 0.0), (5.0, 3.0), (10.0, 10.0)];
        assert_eq!(clipped(&line), [line.to_vec()]);
    }

    #[test]
    fn a_line_from_neighbour_to_neighbour_reaches_both_edges() {
        assert_eq!(clipped(&[(-5.0, 2.0), (15.0, 6.0)]), [vec![(0.0, 3.0), (10.0, 5.0)]]);
    }

    #[test]
    fn a_curve_that_leaves_comes_back_as_another_piece() {
        let line = [(0.0, 5.0), (2.0, 5.0), (4.0, -5.0), (6.0, 5.0), (10.0, 5.0)];
        let expected = [vec![(0.0, 5.0), (2.0, 5.0), (3.0, 0.0)], vec![(5.0, 0.0), (6.0, 5.0), (10.0, 5.0)]];
        assert_eq!(clipped(&line), expected);
    }

    #[test]
    fn what_is_outside_or_only_touches_is_no_line() {
        assert!(clipped(&[(-1.0, -1.0), (11.0, -1.0), (11.0, 5.0)]).is_empty());
        assert!(clipped(&[(3.0, 3.0)]).is_empty());
        assert!(clipped(&[(-1.0, 1.0), (1.0, -1.0)]).iter().all(|piece| piece.len() == 2));
        assert_eq!(clipped(&[(0.0, 5.0), (1e300, 5.0)]), [vec![(0.0, 5.0), (10.0, 5.0)]]);
    }
}
