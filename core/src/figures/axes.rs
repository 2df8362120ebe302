//! Axes: which range a panel shows and how a value becomes a pixel, evenly or by decades about zero.

use super::panels::{Curve, Panel, Reference};
use super::run::{PlottedRun, Quantity};
use super::view::AxisKind;
use crate::scalar::{decimal_logarithm, inverse_sinh, power};

/// How values map to pixels along one direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Axis {
    /// Values at the two ends, the smaller first.
    pub low: f64,
    pub high: f64,
    /// Half a threshold's reciprocal on a symmetric-logarithmic axis: it maps y to `asinh(y / 2c)`, which is linear for
    /// `|y| < c` and counts decades beyond.
    inverse: Option<f64>,
    /// Pixel of `low` and pixels per mapped unit.
    origin: f64,
    per_unit: f64,
    /// Of `low`, mapped.
    mapped_low: f64,
}

/// Decades that a symmetric-logarithmic axis shows on the larger side of zero, the last of them begun.
const DECADES: i32 = 3;

/// Exponent of the power of ten at or above a positive number.
pub(super) fn decade_above(x: f64) -> i32 {
    decimal_logarithm(x).ceil() as i32
}

/// Exponent of the power of ten at or below a positive number.
pub(super) fn decade_below(x: f64) -> i32 {
    decimal_logarithm(x).floor() as i32
}

/// `10^exponent`.
pub(super) fn power_of_ten(exponent: i32) -> f64 {
    power(10.0, f64::from(exponent))
}

/// Threshold c of a symmetric-logarithmic axis from `low` to `high`: three decades below the power of ten that is at or
/// above the larger end.
pub(super) fn threshold(low: f64, high: f64) -> f64 {
    power_of_ten(decade_above(low.abs().max(high.abs())) - DECADES)
}

impl Axis {
    /// From `range` to the pixels `from` (of the smaller value) and `to`.
    pub fn new(kind: AxisKind, range: (f64, f64), from: f64, to: f64) -> Self {
        let (low, high) = range;
        let inverse = (kind == AxisKind::Symlog).then(|| 0.5 / threshold(low, high));
        let mut axis = Self { low, high, inverse, origin: from, per_unit: 1.0, mapped_low: 0.0 };
        axis.mapped_low = axis.map(low);
        axis.per_unit = (to - from) / (axis.map(high) - axis.mapped_low);
        axis
    }

    fn map(&self, value: f64) -> f64 {
        self.inverse.map_or(value, |inverse| inverse_sinh(value * inverse))
    }

    /// Where a value is.
    #[inline]
    pub fn pixel(&self, value: f64) -> f64 {
        self.origin + (self.map(value) - self.mapped_low) * self.per_unit
    }

    /// Its kind.
    pub fn kind(&self) -> AxisKind {
        if self.inverse.is_some() { AxisKind::Symlog } else { AxisKind::Linear }
    }
}

/// Smallest and largest of the values seen.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Extent {
    low: f64,
    high: f64,
}

impl Extent {
    const NOTHING: Self = Self { low: f64::INFINITY, high: f64::NEG_INFINITY };

    fn add(&mut self, value: f64) {
        if value.is_finite() {
            self.low = self.low.min(value);
            self.high = self.high.max(value);
        }
    }

    fn is_nothing(self) -> bool {
        self.low > self.high
    }
}

/// Range of values that a panel shows within a window of time: every curve of a completed run, to the last spike, and what
/// they are compared with. A diverged run's last values would flatten all others: it counts only where no run completed, and
/// then without its last tenth.
pub(super) fn value_range(panel: &Panel, runs: &[PlottedRun<'_>], window: (f64, f64), kind: AxisKind) -> (f64, f64) {
    let mut extent = extent_of_curves(panel, runs, window, |curve| curve.y);
    match panel.reference {
        Some(Reference::Constant(value)) => extent.add(value),
        Some(Reference::Curve { run, quantity }) => add_within(&mut extent, &runs[run], quantity, window, true),
        None => {}
    }
    if let Some(limit) = panel.limit.filter(|limit| limit.always) {
        extent.add(limit.value);
        extent.add(-limit.value);
    }
    padded(extent, kind)
}

/// Range of what a panel's curves are drawn over, where that is not time.
pub(super) fn x_range(panel: &Panel, runs: &[PlottedRun<'_>], window: (f64, f64)) -> (f64, f64) {
    padded(extent_of_curves(panel, runs, window, |curve| curve.x.unwrap_or(curve.y)), AxisKind::Linear)
}

fn extent_of_curves(
    panel: &Panel,
    runs: &[PlottedRun<'_>],
    window: (f64, f64),
    quantity: impl Fn(&Curve) -> Quantity,
) -> Extent {
    let any_completed =
        panel.curves.iter().any(|curve| runs[curve.run].completed && !runs[curve.run].recording.is_empty());
    let mut extent = Extent::NOTHING;
    for curve in &panel.curves {
        let run = &runs[curve.run];
        if run.completed || !any_completed {
            add_within(&mut extent, run, quantity(curve), window, run.completed);
        }
    }
    extent
}

/// Adds what a run shows within the window: its samples, and its line where it enters and leaves.
fn add_within(extent: &mut Extent, run: &PlottedRun<'_>, quantity: Quantity, window: (f64, f64), completed: bool) {
    let mut rows = run.rows_about(window);
    if !completed {
        let kept = run.recording.len() * 9 / 10;
        // Who looks at the end alone wants to see it.
        if kept > rows.start {
            rows.end = rows.end.min(kept);
        }
    }
    let (from_s, to_s) = window;
    let mut last: Option<(f64, f64)> = None;
    run.visit(quantity, rows, |t, y| {
        if t >= from_s && t <= to_s {
            extent.add(y);
        }
        if let Some((last_t, last_y)) = last {
            for edge in [from_s, to_s] {
                if last_t < edge && edge < t {
                    extent.add(last_y + (y - last_y) * (edge - last_t) / (t - last_t));
                }
            }
        }
        last = Some((t, y));
    });
}

/// Range with room around it; something sensible for constants and for nothing.
fn padded(extent: Extent, kind: AxisKind) -> (f64, f64) {
    if extent.is_nothing() {
        return (-1.0, 1.0);
    }
    let Extent { low, high } = extent;
    if kind == AxisKind::Symlog && (low, high) != (0.0, 0.0) {
        /// Room beyond the ends as a factor, and on the side of zero where nothing is as a share of the other side.
        const ROOM: f64 = 1.4;
        const BARE: f64 = 2e-5;
        let bare = low.abs().max(high.abs()) * BARE;
        return ((low * ROOM).min(-bare), (high * ROOM).max(bare));
    }
    let span = high - low;
    let pad = if span > 0.0 { 0.06 * span } else { low.abs().max(1.0) * 0.1 };
    (low - pad, high + pad)
}

#[cfg(test)]
mod tests {
    use super::super::panels::Key;
    use super::super::run::tests::{ERROR, recording};
    use super::super::style::{Dash, Line};
    use super::*;
    use crate::scenario::Scheme;

    fn extent(low: f64, high: f64) -> Extent {
        Extent { low, high }
    }

    fn panel(runs: usize) -> Panel {
        let line = Line { color: (0, 0, 0), dash: Dash(None), width: 1.0 };
        let curves = (0..runs).map(|run| Curve { key: Key::Run(run), run, x: None, y: ERROR, line });
        Panel { label: String::new(), x_label: None, curves: curves.collect(), reference: None, limit: None }
    }

    #[test]
    fn ranges_survive_constants_and_nothing() {
        assert_eq!(padded(Extent::NOTHING, AxisKind::Linear), (-1.0, 1.0));
        assert_eq!(padded(Extent::NOTHING, AxisKind::Symlog), (-1.0, 1.0));
        assert_eq!(padded(extent(0.0, 0.0), AxisKind::Linear), (-0.1, 0.1));
        assert_eq!(padded(extent(0.0, 0.0), AxisKind::Symlog), (-0.1, 0.1));
        assert_eq!(value_range(&panel(0), &[], (0.0, 1.0), AxisKind::Linear), (-1.0, 1.0));
    }

    #[test]
    fn a_diverged_curve_does_not_flatten_the_others() {
        let calm = recording(11, 1.0, |t| if t > 5.0 { 1.0 } else { -1.0 });
        let wild = recording(11, 1.0, |t| if t > 9.0 { 1e9 } else { t });
        let calm = PlottedRun::new(Scheme::Proposed, &calm, true, &[]);
        let wild = PlottedRun::new(Scheme::SlotineLi, &wild, false, &[]);
        let (low, high) = value_range(&panel(2), &[calm, wild], (0.0, 10.0), AxisKind::Linear);
        assert!(low > -1.5 && high < 1.5);
        let (_, alone) = value_range(&panel(1), &[wild], (0.0, 10.0), AxisKind::Linear);
        assert!(alone > 8.0 && alone < 10.0);
        let (_, end) = value_range(&panel(1), &[wild], (9.5, 10.0), AxisKind::Linear);
        assert!(end > 1e8, "whoever zooms into the end sees it");
    }

    #[test]
    fn a_spike_counts_in_its_window_and_nowhere_else() {
        let spiky = recording(3001, 0.01, |t| if (t - 12.34).abs() < 1e-6 { 7.0 } else { 0.0 });
        let runs = [PlottedRun::new(Scheme::Proposed, &spiky, true, &[])];
        let top = |window| value_range(&panel(1), &runs, window, AxisKind::Linear).1;
        assert!(top((0.0, 30.0)) > 7.0 && top((12.0, 13.0)) > 7.0);
        assert!(top((0.0, 12.0)) < 1.0 && top((13.0, 30.0)) < 1.0);
        let edge = top((0.0, 12.335));
        assert!(edge > 3.4 && edge < 4.0, "half way up the spike, where the line leaves: {edge}");
    }

    #[test]
    fn the_symmetric_axis_is_odd_rising_linear_inside_and_even_per_decade_outside() {
        let axis = Axis::new(AxisKind::Symlog, (-0.05, 0.05), 200.0, 0.0);
        // Above 0.05 is 0.1; three decades below it is the threshold.
        assert!((threshold(-0.05, 0.05) - 1e-4).abs() < 1e-17);
        assert_eq!((axis.pixel(0.05).round(), axis.pixel(-0.05).round(), axis.pixel(0.0).round()), (0.0, 200.0, 100.0));
        let up = |y: f64| 100.0 - axis.pixel(y);
        let decades = [up(3e-3) - up(3e-4), up(3e-2) - up(3e-3)];
        assert!((decades[0] - decades[1]).abs() < 0.05 * decades[1], "{decades:?}");
        assert!((up(2e-5) / up(1e-5) - 2.0).abs() < 0.01, "linear about zero");
        assert!((up(3e-4) + up(-3e-4)).abs() < 1e-9, "odd");
        let values = [-0.05, -1e-3, -1e-6, 0.0, 1e-7, 1e-4, 0.02];
        assert!(values.windows(2).all(|pair| up(pair[0]) < up(pair[1])));
    }
}
