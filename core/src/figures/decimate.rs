//! Fewer points, same picture: per pixel column the first, smallest, largest and last value, so that no spike is lost.

/// Reduces points with rising x to what `columns` pixel columns can show. Short lists stay as they are.
pub(super) fn decimate(points: impl Iterator<Item = (f64, f64)>, span: (f64, f64), columns: usize) -> Vec<(f64, f64)> {
    let mut kept: Vec<(f64, f64)> = Vec::new();
    let mut bucket: Vec<(f64, f64)> = Vec::new();
    let mut current = usize::MAX;
    let width = (span.1 - span.0).max(f64::MIN_POSITIVE);
    for point in points {
        let column = ((point.0 - span.0) / width * columns as f64) as usize;
        if column != current {
            flush(&mut bucket, &mut kept);
            current = column;
        }
        bucket.push(point);
    }
    flush(&mut bucket, &mut kept);
    kept
}

/// Keeps a bucket's first, extreme and last points, in their order.
fn flush(bucket: &mut Vec<(f64, f64)>, kept: &mut Vec<(f64, f64)>) {
    let by_value = |a: &&(usize, (f64, f64)), b: &&(usize, (f64, f64))| a.1.1.total_cmp(&b.1.1);
    let indexed: Vec<_> = bucket.iter().copied().enumerate().collect();
    if let (Some(low), Some(high)) = (indexed.iter().min_by(by_value), indexed.iter().max_by(by_value)) {
        let mut indices = [0, low.0, high.0, bucket.len() - 1];
        indices.sort_unstable();
        for (n, index) in indices.iter().enumerate() {
            if n == 0 || *index != indices[n - 1] {
                kept.push(bucket[*index]);
            }
        }
    }
    bucket.clear();
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keeps_a_single_spike() {
        let points = (0..100_000).map(|n| (f64::from(n), if n == 54_321 { 9.0 } else { 0.0 }));
        let kept = decimate(points, (0.0, 1e5), 300);
        assert!(kept.len() <= 4 * 301);
        assert!(kept.contains(&(54_321.0, 9.0)));
        assert!(kept.windows(2).all(|pair| pair[0].0 < pair[1].0));
    }

    #[test]
    fn keeps_every_point_of_a_short_list() {
        let points: Vec<_> = (0..10).map(|n| (f64::from(n), f64::from(n * n))).collect();
        assert_eq!(decimate(points.iter().copied(), (0.0, 10.0), 500), points);
    }
}
