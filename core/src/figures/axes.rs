//! Axes: which range a panel shows, and how its ticks are written.

/// One curve: its points, and whether its run completed.
pub(super) type Curve<'a> = (&'a [(f64, f64)], bool);

/// Range that shows `truth` and every curve of a completed run. A diverged run's last values would flatten all others: it
/// counts only where no run completed, and then without its last tenth.
pub(super) fn value_range(curves: &[Curve<'_>], truth: Option<f64>) -> (f64, f64) {
    let any_completed = curves.iter().any(|(points, completed)| *completed && !points.is_empty());
    let shown = curves.iter().flat_map(|(points, completed)| {
        let count = match (any_completed, completed) {
            (true, true) => points.len(),
            (true, false) => 0,
            (false, _) => points.len() * 9 / 10,
        };
        points[..count].iter().map(|point| point.1)
    });
    padded_range(shown.chain(truth))
}

/// Range of the values with room around them; something sensible for constants and for nothing.
fn padded_range(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), y| (low.min(y), high.max(y)));
    if low > high {
        return (-1.0, 1.0);
    }
    let span = high - low;
    let pad = if span > 0.0 { 0.06 * span } else { low.abs().max(1.0) * 0.1 };
    (low - pad, high + pad)
}

/// Rough distance of ticks on an axis of this length.
pub(super) fn tick_step(span: f64) -> f64 {
    span / 6.0
}

/// A tick's label with as many decimals as its axis needs; powers of ten for very small and very large spans.
pub(super) fn format_tick(value: f64, step: f64) -> String {
    let value = if value.abs() < step * 1e-6 { 0.0 } else { value };
    if step > 0.0 && !(5e-4..2e4).contains(&step) {
        return if value == 0.0 { "0".to_owned() } else { format!("{value:.1e}") };
    }
    let decimals = (1.0 - step.log10()).ceil().clamp(0.0, 6.0) as usize;
    let text = format!("{value:.decimals$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_read_well() {
        assert_eq!(format_tick(0.1, 0.05), "0.1");
        assert_eq!(format_tick(-20.0, 10.0), "-20");
        assert_eq!(format_tick(1e-20, 0.05), "0");
        assert_eq!(format_tick(2e-5, 1e-5), "2.0e-5");
        assert_eq!(format_tick(-300_000.0, 1e5), "-3.0e5");
    }

    #[test]
    fn ranges_survive_constants_and_nothing() {
        assert_eq!(padded_range([].into_iter()), (-1.0, 1.0));
        assert_eq!(padded_range([0.0, 0.0].into_iter()), (-0.1, 0.1));
        assert_eq!(value_range(&[], None), (-1.0, 1.0));
    }

    #[test]
    fn a_diverged_curve_does_not_flatten_the_others() {
        let calm = [(0.0, -1.0), (1.0, 1.0)];
        let diverged = [(0.0, 0.0), (0.5, 1e9)];
        let (low, high) = value_range(&[(&calm, true), (&diverged, false)], None);
        assert!(low > -1.5 && high < 1.5);
        let (_, alone) = value_range(&[(&diverged, false)], None);
        assert!(alone < 2.0);
    }
}
