//! The legend: a sample of each line with its name, on as many rows as the width asks for.

use super::path::Path;
use super::style::Line;
use super::surface::{Anchor, DrawError, Pen, Surface};

/// One entry: name and line.
pub(super) type Entry<'a> = (&'a str, Line);

/// Layout pixels: height of a row, length of a line's sample, where its name starts, space between entries, size of letters.
const ROW: f64 = 20.0;
const SAMPLE: f64 = 26.0;
const NAME: f64 = 32.0;
const GAP: f64 = 16.0;
const LETTERS: f64 = 12.0;

/// Draws the legend on top of a picture of this width; gives where the rest of it begins.
pub(super) fn draw_legend<S: Surface>(
    pen: &mut Pen<'_, S>,
    width: f64,
    entries: &[Entry<'_>],
) -> Result<f64, DrawError> {
    let left = pen.px(10.0);
    let (mut x, mut y) = (left, pen.px(ROW * 0.6));
    for (name, line) in entries {
        let needed = pen.px(NAME) + pen.text_width(name, LETTERS);
        if x > left && x + needed > width {
            (x, y) = (left, y + pen.px(ROW));
        }
        pen.curve(&Path::straight((x, y), (x + pen.px(SAMPLE), y)), *line)?;
        let ink = pen.style.theme.ink();
        pen.text(name, (x + pen.px(NAME), y), LETTERS, ink, Anchor::Left)?;
        x += needed + pen.px(GAP);
    }
    Ok(y + pen.px(ROW * 0.6))
}
