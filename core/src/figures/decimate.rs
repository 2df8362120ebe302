//! Fewer points, same picture. First per pixel column the first, smallest, largest and last value, so that no spike is
//! lost; then whatever a straight line shows as well to a tenth of a pixel goes. Streams: nothing is allocated per point.

/// A point of a picture, pixels.
pub(super) type Point = (f64, f64);

/// Keeps at most four points of each column of a picture.
pub(super) struct Columns {
    /// First column's time, and columns per second.
    from: f64,
    per_second: f64,
    /// Samples of the column so far.
    bucket: Option<Bucket>,
}

#[derive(Clone, Copy)]
struct Bucket {
    column: i64,
    first: Point,
    low: Point,
    high: Point,
    last: Point,
}

impl Columns {
    /// `count` columns from a time on for `span` seconds.
    pub fn new(from: f64, span: f64, count: f64) -> Self {
        Self { from, per_second: count / span, bucket: None }
    }

    /// Takes a sample of rising time; gives `keep` the points of a column that is complete.
    #[inline]
    pub fn push(&mut self, t: f64, y: f64, keep: &mut impl FnMut(Point)) {
        let column = ((t - self.from) * self.per_second).floor() as i64;
        match &mut self.bucket {
            Some(bucket) if bucket.column == column => {
                if y < bucket.low.1 {
                    bucket.low = (t, y);
                }
                if y > bucket.high.1 {
                    bucket.high = (t, y);
                }
                bucket.last = (t, y);
            }
            _ => {
                self.finish(keep);
                let point = (t, y);
                self.bucket = Some(Bucket { column, first: point, low: point, high: point, last: point });
            }
        }
    }

    /// Gives `keep` what is left.
    pub fn finish(&mut self, keep: &mut impl FnMut(Point)) {
        if let Some(Bucket { first, low, high, last, .. }) = self.bucket.take() {
            let (second, third) = if low.0 < high.0 { (low, high) } else { (high, low) };
            keep(first);
            let mut latest = first.0;
            for point in [second, third, last] {
                if point.0 > latest {
                    keep(point);
                    latest = point.0;
                }
            }
        }
    }
}

/// Drops points that lie within a tolerance of the straight line between those it keeps.
pub(super) struct Thinner<'a> {
    kept: &'a mut Vec<Point>,
    tolerance: f64,
    /// Whether the curve may turn back; if not, x rises and the tolerance is one of y.
    turns: bool,
    /// Which way the line from the last kept point goes: its direction, a unit vector.
    forward: Point,
    /// Not kept yet: the point and how far forward it is. A line from the last kept point to here passes all between.
    pending: Option<(Point, f64)>,
    /// Slopes, against `forward`, of the lines from the last kept point that pass all points since.
    slopes: (f64, f64),
}

const ANY_SLOPE: (f64, f64) = (f64::NEG_INFINITY, f64::INFINITY);

impl<'a> Thinner<'a> {
    /// For a curve with rising x; appends to `kept`, which must be empty.
    pub fn rising(kept: &'a mut Vec<Point>, tolerance: f64) -> Self {
        Self { kept, tolerance, turns: false, forward: (1.0, 0.0), pending: None, slopes: ANY_SLOPE }
    }

    /// For any curve.
    pub fn turning(kept: &'a mut Vec<Point>, tolerance: f64) -> Self {
        Self { turns: true, ..Self::rising(kept, tolerance) }
    }

    /// Takes the next point.
    #[inline]
    pub fn push(&mut self, point: Point) {
        let Some(anchor) = self.kept.last().copied() else {
            return self.kept.push(point);
        };
        let mut step = (point.0 - anchor.0, point.1 - anchor.1);
        if let Some((pending, reach)) = self.pending {
            let (along, across) = self.turned(step);
            let slope = across / along;
            if along < reach || !(slope >= self.slopes.0 && slope <= self.slopes.1) {
                self.kept.push(pending);
                step = (point.0 - pending.0, point.1 - pending.1);
                self.pending = None;
                self.slopes = ANY_SLOPE;
            }
        }
        if self.turns && self.pending.is_none() {
            let length = (step.0 * step.0 + step.1 * step.1).sqrt();
            if length <= 0.5 * self.tolerance {
                return;
            }
            self.forward = (step.0 / length, step.1 / length);
        }
        let (along, across) = self.turned(step);
        if along > 0.0 {
            self.slopes.0 = self.slopes.0.max((across - self.tolerance) / along);
            self.slopes.1 = self.slopes.1.min((across + self.tolerance) / along);
            self.pending = Some((point, along));
        } else {
            self.kept.push(point);
        }
    }

    /// A step as how far forward and how far aside.
    #[inline]
    fn turned(&self, (dx, dy): Point) -> Point {
        let (x, y) = self.forward;
        if self.turns { (dx * x + dy * y, dy * x - dx * y) } else { (dx, dy) }
    }

    /// Keeps the last point.
    pub fn finish(self) {
        self.kept.extend(self.pending.map(|(point, _)| point));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn decimate(samples: impl Iterator<Item = Point>, span: f64, count: f64) -> Vec<Point> {
        let mut kept = Vec::new();
        let mut columns = Columns::new(0.0, span, count);
        let mut keep = |point| kept.push(point);
        samples.for_each(|(t, y)| columns.push(t, y, &mut keep));
        columns.finish(&mut keep);
        kept
    }

    fn thin(points: &[Point], tolerance: f64) -> Vec<Point> {
        let mut kept = Vec::new();
        let mut thinner = Thinner::rising(&mut kept, tolerance);
        for point in points {
            thinner.push(*point);
        }
        thinner.finish();
        kept
    }

    #[test]
    fn keeps_a_single_spike() {
        let samples = (0..100_000).map(|n| (f64::from(n), if n == 54_321 { 9.0 } else { 0.0 }));
        let kept = decimate(samples, 1e5, 300.0);
        assert!(kept.len() <= 4 * 301);
        assert!(kept.contains(&(54_321.0, 9.0)));
        assert!(kept.windows(2).all(|pair| pair[0].0 < pair[1].0));
        let thinned = thin(&kept, 0.1);
        assert!(thinned.len() < 10 && thinned.contains(&(54_321.0, 9.0)), "{thinned:?}");
    }

    #[test]
    fn keeps_every_point_of_a_short_list() {
        let points: Vec<_> = (0..10).map(|n| (f64::from(n), f64::from(n * n))).collect();
        assert_eq!(decimate(points.iter().copied(), 10.0, 500.0), points);
    }

    #[test]
    fn every_column_keeps_its_extremes() {
        let sample = |n: u32| (f64::from(n), f64::from(n.wrapping_mul(2_654_435_761) >> 16));
        let kept = decimate((0..5000).map(sample), 5000.0, 50.0);
        for column in 0..50 {
            let all = (100 * column..100 * column + 100).map(|n| sample(n).1);
            let (low, high) = all.fold((f64::MAX, f64::MIN), |(low, high), y| (low.min(y), high.max(y)));
            let left = f64::from(100 * column);
            let there: Vec<_> = kept.iter().filter(|(t, _)| *t >= left && *t < left + 100.0).map(|p| p.1).collect();
            assert!(there.contains(&low) && there.contains(&high));
        }
    }

    #[test]
    fn what_is_dropped_is_within_the_tolerance_of_the_line() {
        let points: Vec<_> =
            (0..2000).map(|n| (f64::from(n) * 0.3, 150.0 + 90.0 * (f64::from(n) * 0.01).sin())).collect();
        let kept = thin(&points, 0.1);
        assert!(kept.len() < points.len() / 10, "{} points", kept.len());
        assert_eq!((kept.first(), kept.last()), (points.first(), points.last()));
        for (x, y) in points {
            let after = kept.iter().position(|point| point.0 >= x).unwrap().max(1);
            let (a, b) = (kept[after - 1], kept[after]);
            let line = a.1 + (b.1 - a.1) * (x - a.0) / (b.0 - a.0);
            assert!((line - y).abs() <= 0.1 + 1e-9, "{x}: {line} for {y}");
        }
    }

    #[test]
    fn a_step_in_one_column_stays_upright() {
        let step = [(0.0, 0.0), (5.0, 0.0), (5.0, 8.0), (9.0, 8.0)];
        assert_eq!(thin(&step, 0.1), step);
    }

    fn thin_turning(points: &[Point]) -> Vec<Point> {
        let mut kept = Vec::new();
        let mut thinner = Thinner::turning(&mut kept, 0.1);
        for point in points {
            thinner.push(*point);
        }
        thinner.finish();
        kept
    }

    #[test]
    fn a_spiral_keeps_its_shape() {
        let spiral: Vec<_> = (0..20_000)
            .map(|n| f64::from(n) * 0.002)
            .map(|t| (100.0 + 4.0 * t * t.cos(), 100.0 + 2.0 * t * t.sin()))
            .collect();
        let kept = thin_turning(&spiral);
        assert!(kept.len() < spiral.len() / 20, "{} points", kept.len());
        // Both are followed from the start: every point is near the stretch that stands for it.
        let distance = |p: Point, a: Point, b: Point| {
            let (dx, dy) = (b.0 - a.0, b.1 - a.1);
            let share = (((p.0 - a.0) * dx + (p.1 - a.1) * dy) / (dx * dx + dy * dy)).clamp(0.0, 1.0);
            f64::hypot(p.0 - a.0 - share * dx, p.1 - a.1 - share * dy)
        };
        let mut stretch = 0;
        for point in spiral {
            while distance(point, kept[stretch], kept[stretch + 1]) > 0.2 {
                stretch += 1;
                assert!(stretch + 1 < kept.len(), "{point:?} is far from the curve");
            }
        }
        assert_eq!(stretch + 2, kept.len());
    }

    #[test]
    fn a_line_there_and_back_keeps_its_turn() {
        let there: Vec<_> = (0..=50).map(f64::from).chain((0..50).rev().map(f64::from)).map(|x| (x, x)).collect();
        assert_eq!(thin_turning(&there), [(0.0, 0.0), (50.0, 50.0), (0.0, 0.0)]);
        assert_eq!(thin_turning(&[(1.0, 1.0); 50]), [(1.0, 1.0)]);
    }
}
