//! Bases by their mean rank, the best on top, with the bootstrap interval and the share of resamples in which each is the best.

use super::super::path::{Frame, Path};
use super::super::style::{Dash, Line};
use super::super::surface::{Anchor, DrawError, Pen, Surface};
use super::chart::{LABELS, NOTES, TICKS, across, cut, say};
use super::{Sheet, names};
use crate::experiments::{Experiment, Summary};

const ROW: f64 = 34.0;
const AROUND: f64 = 106.0;
const NAMES: f64 = 250.0;
/// Room for the shares, layout pixels.
const SHARES: f64 = 110.0;

/// Height of the figure, layout pixels.
pub(super) fn height(experiment: &Experiment) -> u32 {
    (AROUND + ROW * experiment.base_names().len() as f64) as u32
}

pub(super) fn draw<S: Surface>(pen: &mut Pen<'_, S>, sheet: &Sheet<'_>, summary: &Summary) -> Result<(), DrawError> {
    let ranking = summary.rankings.iter().find(|ranking| ranking.metric == sheet.metric);
    let Some(ranking) = ranking else {
        return say(pen, &sheet.whole, "the bases cannot be ranked by this metric");
    };
    let ink = pen.style.theme.ink();
    let frame = Frame {
        left: pen.px(NAMES),
        top: pen.px(30.0),
        right: sheet.whole.right - pen.px(SHARES),
        bottom: sheet.whole.bottom - pen.px(AROUND - 30.0),
    };
    let most = ranking.bases.len() as f64;
    let label = format!("mean rank by {}; 1 is the best", names::metric(sheet.metric));
    let axis = across(pen, &frame, (0.8, most + 0.2), &label)?;
    pen.text("best in", (frame.right + pen.px(14.0), pen.px(16.0)), NOTES, ink, Anchor::Left)?;
    let row = (frame.bottom - frame.top) / most;
    let blue = Line { color: (0, 84, 166), dash: Dash(None), width: 2.2 };
    for (n, base) in ranking.bases.iter().enumerate() {
        let middle = (frame.top + row * (n as f64 + 0.5)).round();
        let name = cut(pen, &base.base, LABELS, pen.px(NAMES - 20.0));
        pen.text(&name, (frame.left - pen.px(10.0), middle), LABELS, ink, Anchor::Right)?;
        if let Some([low, high]) = base.interval {
            let (low, high) = (axis.pixel(low), axis.pixel(high));
            pen.curve(&Path::straight((low, middle), (high, middle)), blue)?;
            for end in [low, high] {
                pen.curve(&Path::straight((end, middle - pen.px(5.0)), (end, middle + pen.px(5.0))), blue)?;
            }
        }
        let (at, half) = (axis.pixel(base.mean_rank).round(), pen.px(4.0));
        pen.fill(Frame { left: at - half, top: middle - half, right: at + half, bottom: middle + half }, blue.color)?;
        let share = base.best_share.map_or("—".to_owned(), |share| format!("{:.1} %", 100.0 * share));
        pen.text(&share, (frame.right + pen.px(14.0), middle), TICKS, ink, Anchor::Left)?;
    }
    let about = match &ranking.resampled {
        Some(what) => format!(
            "{} blocks; lines: {} % bootstrap intervals over {what}s; right: share of resamples in which it is the best",
            ranking.blocks,
            100.0 * summary.confidence
        ),
        None => format!("{} block: nothing can be resampled, so there are no intervals", ranking.blocks),
    };
    pen.text(&about, (pen.px(24.0), sheet.whole.bottom - pen.px(14.0)), NOTES, ink, Anchor::Left)
}
