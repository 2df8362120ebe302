//! The pen: layout lengths on a device, texts, polylines with dashes, and what can go wrong with them.

use super::style::{Dash, Rgb, Style};
use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::Pos;

/// The backend failed.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("the figure could not be drawn: {0}")]
pub struct DrawError(String);

impl<E: std::error::Error + Send + Sync> From<DrawingAreaErrorKind<E>> for DrawError {
    fn from(error: DrawingAreaErrorKind<E>) -> Self {
        Self(error.to_string())
    }
}

/// Font of every text; each backend maps it to what it has.
const FONT: &str = "sans-serif";

/// Lengths in layout pixels, scaled to the device.
pub(super) struct Pen {
    pub style: Style,
}

impl Pen {
    /// A length in device pixels.
    pub fn px(&self, layout: f64) -> i32 {
        (layout * self.style.scale).round() as i32
    }

    /// A stroke's width in device pixels.
    pub fn stroke(&self, layout: f64) -> u32 {
        (layout * self.style.scale).round().max(1.0) as u32
    }

    /// A text style of this height.
    pub fn text(&self, layout: f64, color: Rgb, pos: Pos) -> TextStyle<'static> {
        (FONT, layout * self.style.scale).into_font().color(&rgb(color)).pos(pos)
    }
}

/// A colour as plotters has it.
pub(super) fn rgb((r, g, b): Rgb) -> RGBColor {
    RGBColor(r, g, b)
}

/// A polyline in pixels, dashed or solid.
pub(super) fn draw_line<DB: DrawingBackend>(
    area: &DrawingArea<DB, Shift>,
    points: &[(f64, f64)],
    color: Rgb,
    dash: Dash,
    pen: &Pen,
) -> Result<(), DrawError> {
    let style = rgb(color).stroke_width(pen.stroke(1.6));
    for piece in dash_pieces(points, dash, pen.style.scale) {
        area.draw(&PathElement::new(piece, style))?;
    }
    Ok(())
}

/// Cuts a polyline into its dashes.
fn dash_pieces(points: &[(f64, f64)], dash: Dash, scale: f64) -> Vec<Vec<(i32, i32)>> {
    let round = |(x, y): (f64, f64)| (x.round() as i32, y.round() as i32);
    let Some((on, off)) = dash.0 else {
        return vec![points.iter().copied().map(round).collect()];
    };
    let lengths = [f64::from(on) * scale, f64::from(off) * scale];
    let mut pieces = Vec::new();
    let mut piece: Vec<(i32, i32)> = points.first().copied().map(round).into_iter().collect();
    let (mut phase, mut left) = (0, lengths[0]);
    for pair in points.windows(2) {
        let (mut from, to) = (pair[0], pair[1]);
        loop {
            let (dx, dy) = (to.0 - from.0, to.1 - from.1);
            let distance = (dx * dx + dy * dy).sqrt();
            if distance <= left {
                left -= distance;
                if phase == 0 {
                    piece.push(round(to));
                }
                break;
            }
            from = (from.0 + dx * left / distance, from.1 + dy * left / distance);
            if phase == 0 {
                piece.push(round(from));
                pieces.push(std::mem::take(&mut piece));
            } else {
                piece.push(round(from));
            }
            phase = 1 - phase;
            left = lengths[phase];
        }
    }
    if piece.len() > 1 {
        pieces.push(piece);
    }
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dashes_have_their_lengths() {
        let pieces = dash_pieces(&[(0.0, 0.0), (30.0, 0.0)], Dash(Some((8, 4))), 1.0);
        assert_eq!(pieces, [vec![(0, 0), (8, 0)], vec![(12, 0), (20, 0)], vec![(24, 0), (30, 0)]]);
    }
}
