//! The legend: a sample of each line with its name, on as many rows as the width asks for.

use super::pen::{DrawError, Pen, draw_line};
use super::style::{Dash, Rgb};
use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

/// One entry: name and line.
pub(super) type Entry = (&'static str, (Rgb, Dash));

/// Layout pixels: height of a row, length of a line's sample, where its name starts, space between entries.
const ROW: f64 = 20.0;
const SAMPLE: f64 = 26.0;
const NAME: f64 = 32.0;
const GAP: f64 = 16.0;

/// Draws the legend on top of `area` and gives the rest of it.
pub(super) fn draw_legend<DB: DrawingBackend>(
    area: &DrawingArea<DB, Shift>,
    entries: &[Entry],
    pen: &Pen,
) -> Result<DrawingArea<DB, Shift>, DrawError> {
    let text = pen.text(12.0, pen.style.theme.ink(), Pos::new(HPos::Left, VPos::Center));
    let (left, right) = (pen.px(10.0), area.dim_in_pixel().0 as i32);
    let (mut x, mut y) = (left, pen.px(ROW * 0.6));
    for (name, (color, dash)) in entries {
        let width = pen.px(NAME) + area.estimate_text_size(name, &text)?.0 as i32;
        if x > left && x + width > right {
            (x, y) = (left, y + pen.px(ROW));
        }
        let sample = [(x, y), (x + pen.px(SAMPLE), y)].map(|(x, y)| (f64::from(x), f64::from(y)));
        draw_line(area, &sample, *color, *dash, pen)?;
        area.draw(&Text::new(*name, (x + pen.px(NAME), y), text.clone()))?;
        x += width + pen.px(GAP);
    }
    Ok(area.split_vertically(y + pen.px(ROW * 0.6)).1)
}
