//! Ticks: round values that a panel has room for, and how they are written.

use super::axes::{Axis, decade_below, power_of_ten, threshold};
use super::view::AxisKind;

/// A tick: its value and its text.
pub(super) type Tick = (f64, String);

/// Least distance of ticks on a symmetric-logarithmic axis, layout pixels.
const APART: f64 = 14.0;
/// An end that is a tick stays one in spite of rounding.
const EPSILON: f64 = 1e-9;

/// Ticks of an axis, at most about `count`; `scale` is device pixels per layout pixel.
pub(super) fn ticks(axis: &Axis, count: usize, scale: f64) -> Vec<Tick> {
    match axis.kind() {
        AxisKind::Linear => linear(axis.low, axis.high, count),
        AxisKind::Symlog => symlog(axis, APART * scale),
    }
}

/// Multiples of 1, 2 or 5 times a power of ten; two at least where numbers are fine enough.
fn linear(low: f64, high: f64, count: usize) -> Vec<Tick> {
    let rough = (high - low) / count.max(1) as f64;
    let decade = power_of_ten(decade_below(rough));
    // The first is the smallest that gives few enough; where it gives but one, the next smaller does better.
    let steps = [10.0, 5.0, 2.0, 1.0, 0.5, 0.2].map(|m| m * decade);
    let fitting = steps.iter().rposition(|step| *step >= rough * (1.0 - EPSILON)).unwrap_or(0);
    let range = |step: f64| ((low / step - EPSILON).ceil(), (high / step + EPSILON).floor());
    let step = steps[fitting..].iter().find(|step| range(**step).1 > range(**step).0).unwrap_or(&decade);
    let (first, last) = range(*step);
    // Numbers so large that a step is lost in their rounding have no ticks.
    if !(*step > 0.0 && last - first <= 20.0) {
        return Vec::new();
    }
    (0..=(last - first) as u32).map(|n| (first + f64::from(n)) * step).map(|x| (x, format(x, *step))).collect()
}

/// A tick's text with as many decimals as its step needs; powers of ten for very small and very large steps.
fn format(value: f64, step: f64) -> String {
    if value.abs() < step * 1e-6 {
        return "0".to_owned();
    }
    if !(1e-4..1e5).contains(&step) {
        // As many digits as tell neighbours apart.
        let digits = decade_below(value.abs() / step).max(0) as usize;
        let text = format!("{value:.digits$e}");
        return match text.split_once('e') {
            Some((mantissa, exponent)) if mantissa.contains('.') => {
                format!("{}e{exponent}", mantissa.trim_end_matches('0').trim_end_matches('.'))
            }
            _ => text,
        };
    }
    let decimals = (-decade_below(step * (1.0 + 1e-9))).max(0) as usize;
    format!("{value:.decimals$}")
}

/// Zero and plus and minus powers of ten, every second or third of them where there is no room for all.
fn symlog(axis: &Axis, apart: f64) -> Vec<Tick> {
    let lowest = decade_below(threshold(axis.low, axis.high) * 1.001);
    let zero = axis.pixel(0.0);
    let mut ticks = vec![(0.0, "0".to_owned())];
    for (end, sign) in [(axis.high, 1.0), (-axis.low, -1.0)] {
        if end <= 0.0 {
            continue;
        }
        let top = decade_below(end);
        let at = |k: i32| axis.pixel(sign * power_of_ten(k));
        let decade = (at(top) - at(top - 1)).abs();
        let stride = (apart / decade).ceil().clamp(1.0, 9.0) as i32;
        let mut k = top;
        while k >= lowest && (at(k) - zero).abs() >= apart {
            ticks.push((sign * power_of_ten(k), format!("{}10{}", if sign < 0.0 { "-" } else { "" }, superscript(k))));
            k -= stride;
        }
    }
    ticks
}

fn superscript(number: i32) -> String {
    let digit = |character| match character {
        '-' => '⁻',
        '0' => '⁰',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        '4' => '⁴',
        '5' => '⁵',
        '6' => '⁶',
        '7' => '⁷',
        '8' => '⁸',
        _ => '⁹',
    };
    number.to_string().chars().map(digit).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(ticks: &[Tick]) -> Vec<&str> {
        ticks.iter().map(|(_, text)| text.as_str()).collect()
    }

    #[test]
    fn ticks_read_well() {
        assert_eq!(texts(&linear(0.0, 12.0, 7)), ["0", "2", "4", "6", "8", "10", "12"]);
        assert_eq!(
            texts(&linear(-0.11, 0.07, 5)),
            ["-0.10", "-0.05", "0.00", "0.05"].map(|t| if t == "0.00" { "0" } else { t })
        );
        assert_eq!(texts(&linear(11.2, 11.35, 4)), ["11.20", "11.25", "11.30", "11.35"]);
        assert_eq!(texts(&linear(0.0, 4e-5, 4)), ["0", "1e-5", "2e-5", "3e-5", "4e-5"]);
        assert_eq!(texts(&linear(-1.1e6, 1.1e6, 5)), ["-1e6", "-5e5", "0", "5e5", "1e6"]);
        assert_eq!(texts(&linear(100.0, 100.000_03, 4)), ["1e2", "1.0000001e2", "1.0000002e2", "1.0000003e2"]);
        assert!(linear(1e300, 1e300, 5).is_empty());
        assert!(linear(f64::NAN, 1.0, 5).is_empty());
    }

    #[test]
    fn there_are_never_more_than_asked_for() {
        for n in 1..2000 {
            let span = f64::from(n) * 0.013;
            for count in 2..9 {
                let ticks = linear(-0.3 * span, 0.7 * span, count);
                assert!((2..=count.max(3) + 1).contains(&ticks.len()), "{span} {count}: {ticks:?}");
            }
        }
    }

    #[test]
    fn a_symmetric_axis_has_powers_of_ten_on_both_sides() {
        let axis = Axis::new(AxisKind::Symlog, (-0.05, 0.05), 400.0, 0.0);
        let roomy = symlog(&axis, 15.0);
        assert_eq!(texts(&roomy), ["0", "10⁻²", "10⁻³", "10⁻⁴", "-10⁻²", "-10⁻³", "-10⁻⁴"]);
        let small = Axis::new(AxisKind::Symlog, (-0.05, 0.05), 90.0, 0.0);
        let mut pixels: Vec<_> = symlog(&small, 15.0).iter().map(|(value, _)| small.pixel(*value)).collect();
        pixels.sort_by(f64::total_cmp);
        assert!(pixels.len() >= 3 && pixels.windows(2).all(|pair| pair[1] - pair[0] >= 15.0), "{pixels:?}");
        let positive = Axis::new(AxisKind::Symlog, (-2e-5, 1.4), 300.0, 0.0);
        assert_eq!(texts(&symlog(&positive, 15.0))[..2], ["0", "10⁰"]);
    }
}
