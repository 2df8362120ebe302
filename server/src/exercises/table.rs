//! Calibrations as tables: for a terminal, and for the documentation.

use super::calibrate::{Calibration, CriterionSpread, Scores};
use std::fmt::Write as _;

fn percent(score: f64) -> String {
    format!("{:.0} %", 100.0 * score)
}

fn range(range: Option<[f64; 2]>) -> String {
    range.map_or_else(|| "none".to_owned(), |[low, high]| format!("{} to {}", short(low), short(high)))
}

/// Three digits, without zeros at the end.
fn short(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let digits = (2 - value.abs().log10().floor() as i64).clamp(0, 9) as usize;
    let text = format!("{value:.digits$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

/// For a terminal.
pub fn text_table(calibration: &Calibration) -> String {
    let mut text = String::new();
    let Calibration { exercise, fingerprint, seeds, variants, .. } = calibration;
    // Writing to a string cannot fail.
    let _ = writeln!(text, "{exercise}  ({seeds} seeds of {variants} hidden variants, {})", &fingerprint[..12]);
    let scores = calibration.solutions.iter().chain([&calibration.naive, &calibration.random]);
    for Scores { name, min, median, max, full_share } in scores {
        let [min, median, max, full] = [min, median, max, full_share].map(|share| percent(*share));
        let _ = writeln!(text, "  {name:<16} {min:>6} {median:>6} {max:>6}   full marks {full:>5}");
    }
    for CriterionSpread { id, full, zero, good, naive } in &calibration.criteria {
        let (good, naive) = (range(*good), range(*naive));
        let _ = writeln!(text, "  {id:<16} full {full:<8} zero {zero:<8} good {good:<20} naive {naive}");
    }
    for finding in &calibration.findings {
        let _ = writeln!(text, "  not fair: {finding}");
    }
    text
}

/// For the documentation: a table of scores, and one of bounds.
pub fn markdown_table(calibrations: &[Calibration]) -> String {
    let mut text =
        "| exercise | reference | naive | random, median | random with full marks |\n|---|---|---|---|---|\n"
            .to_owned();
    for calibration in calibrations {
        let least = calibration.solutions.iter().map(|solution| solution.min).fold(1.0, f64::min);
        let [reference, naive, random, lucky] =
            [least, calibration.naive.max, calibration.random.median, calibration.random.full_share].map(percent);
        let _ = writeln!(text, "| `{}` | {reference} | {naive} | {random} | {lucky} |", calibration.exercise);
    }
    text.push_str(
        "\n| exercise | criterion | full | zero | reference solutions | naive |\n|---|---|---|---|---|---|\n",
    );
    for calibration in calibrations {
        for CriterionSpread { id, full, zero, good, naive } in &calibration.criteria {
            let (good, naive) = (range(*good), range(*naive));
            let _ = writeln!(text, "| `{}` | {id} | {full} | {zero} | {good} | {naive} |", calibration.exercise);
        }
    }
    text
}
