//! The Pareto front of a tuning with several objectives: every pair of them, the candidates that no other beats in all, and the
//! start as a cross.

use super::super::path::{Frame, Path};
use super::super::style::{Dash, Line};
use super::super::surface::{Anchor, DrawError, Pen, Surface};
use super::Sheet;
use super::chart::{NOTES, across, padded, say, upwards};
use crate::experiments::{Front, TuningSummary};

pub(super) fn draw<S: Surface>(
    pen: &mut Pen<'_, S>,
    sheet: &Sheet<'_>,
    summary: &TuningSummary,
) -> Result<(), DrawError> {
    let Some(front) = summary.front.as_ref().filter(|front| !front.candidates.is_empty()) else {
        return say(pen, &sheet.whole, "no candidate keeps all limits yet");
    };
    let count = front.objectives.len();
    let pairs: Vec<_> = (0..count).flat_map(|a| (a + 1..count).map(move |b| [a, b])).collect();
    let width = sheet.whole.right / pairs.len().max(1) as f64;
    for (n, pair) in pairs.into_iter().enumerate() {
        let left = width * n as f64;
        let frame = Frame {
            left: (left + pen.px(84.0)).round(),
            top: pen.px(16.0),
            right: (left + width - pen.px(16.0)).round(),
            bottom: sheet.whole.bottom - pen.px(76.0),
        };
        panel(pen, &frame, front, pair)?;
    }
    let note =
        format!("{} candidates that no other beats in every objective; cross: the start", front.candidates.len());
    let at = (pen.px(84.0), sheet.whole.bottom - pen.px(14.0));
    pen.text(&note, at, NOTES, pen.style.theme.ink(), Anchor::Left)
}

fn panel<S: Surface>(pen: &mut Pen<'_, S>, frame: &Frame, front: &Front, [a, b]: [usize; 2]) -> Result<(), DrawError> {
    // The reference is twice the start.
    let start = [a, b].map(|n| front.reference.get(n).map_or(f64::NAN, |twice| 0.5 * twice));
    let values = |n: usize, start: f64| {
        front.candidates.iter().map(move |candidate| candidate.objectives[n]).chain(std::iter::once(start))
    };
    let (Some(x_range), Some(y_range)) = (padded(values(a, start[0])), padded(values(b, start[1]))) else {
        return say(pen, frame, "no objective is a number");
    };
    let x = across(pen, frame, x_range, &front.objectives[a])?;
    let y = upwards(pen, frame, y_range, &front.objectives[b])?;
    let half = pen.px(3.5);
    for candidate in &front.candidates {
        let (at, up) = (x.pixel(candidate.objectives[a]).round(), y.pixel(candidate.objectives[b]).round());
        pen.fill(Frame { left: at - half, right: at + half, top: up - half, bottom: up + half }, (0, 84, 166))?;
    }
    if start.iter().all(|value| value.is_finite()) {
        let (at, up, arm) = (x.pixel(start[0]), y.pixel(start[1]), pen.px(6.0));
        let line = Line { color: pen.style.theme.limit(), dash: Dash(None), width: 2.2 };
        pen.curve(&Path::straight((at - arm, up - arm), (at + arm, up + arm)), line)?;
        pen.curve(&Path::straight((at - arm, up + arm), (at + arm, up - arm)), line)?;
    }
    Ok(())
}
