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

/// Drops points of a curve with rising x that lie within a tolerance of the straight line between those it keeps.
pub(super) struct Thinner<'a> {
    kept: &'a mut Vec<Point>,
    tolerance: f64,
    /// Not kept yet; a line from the last kept point to here passes all between.
    pending: Option<Point>,
    /// Slopes of the lines from the last kept point that pass all points since.
    slopes: (f64, f64),
}

const ANY_SLOPE: (f64, f64) = (f64::NEG_INFINITY, f64::INFINITY);

impl<'a> Thinner<'a> {
    /// Appends to `kept`, which must be empty.
    pub fn new(kept: &'a mut Vec<Point>, tolerance: f64) -> Self {
        Self { kept, tolerance, pending: None, slopes: ANY_SLOPE }
    }

    /// Takes the next point.
    #[inline]
    pub fn push(&mut self, point: Point) {
        let Some(mut anchor) = self.kept.last().copied() else {
            return self.kept.push(point);
        };
        if let Some(pending) = self.pending {
            let slope = (point.1 - anchor.1) / (point.0 - anchor.0);
            if !(slope >= self.slopes.0 && slope <= self.slopes.1) {
                self.kept.push(pending);
                anchor = pending;
                self.slopes = ANY_SLOPE;
            }
        }
        let run = point.0 - anchor.0;
        if run > 0.0 {
            let rise = point.1 - anchor.1;
            self.slopes.0 = self.slopes.0.max((rise - self.tolerance) / run);
            self.slopes.1 = self.slopes.1.min((rise + self.tolerance) / run);
            self.pending = Some(point);
        } else {
            self.kept.push(point);
            self.pending = None;
            self.slopes = ANY_SLOPE;
        }
    }

    /// Keeps the last point.
    pub fn finish(self) {
        self.kept.extend(self.pending);
    }
}

/// Drops points of any curve that are nearer than `tolerance` to the one kept before; the last stays.
pub(super) fn thin_out(points: &mut Vec<Point>, tolerance: f64) {
    let Some(end) = points.last().copied() else { return };
    let mut last: Option<Point> = None;
    points.retain(|point| {
        let far = last.is_none_or(|last| (point.0 - last.0).abs().max((point.1 - last.1).abs()) >= tolerance);
        if far {
            last = Some(*point);
        }
        far
    });
    if points.last() != Some(&end) {
        points.push(end);
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
        let mut thinner = Thinner::new(&mut kept, tolerance);
        points.iter().for_each(|point| thinner.push(*point));
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

    #[test]
    fn a_loop_keeps_its_shape_and_its_end() {
        let mut points: Vec<_> = (0..1000).map(|n| (20.0 * f64::from(n).cos(), 20.0 * f64::from(n).sin())).collect();
        points.extend([(3.0, 3.0), (3.01, 3.0)]);
        thin_out(&mut points, 0.3);
        assert_eq!(points.last(), Some(&(3.01, 3.0)));
        assert!(points.len() > 900);
        let mut still = vec![(1.0, 1.0); 50];
        thin_out(&mut still, 0.3);
        assert_eq!(still, [(1.0, 1.0)]);
    }
}
