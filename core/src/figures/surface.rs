//! What figures are drawn on: a plotters backend, with curves that are finer than its whole pixels and dashed in one go
//! where the backend can do that; and the pen, which knows how large things are on the device.

use super::decimate::Point;
use super::path::{Frame, Path};
use super::style::{Line, Rgb, Style};
use crate::experiments::RowStoreError;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters_backend::{BackendCoord, DrawingErrorKind};

/// The backend failed, or what is to be drawn could not be read.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("the figure could not be drawn: {0}")]
pub struct DrawError(String);

impl<E: std::error::Error + Send + Sync> From<DrawingErrorKind<E>> for DrawError {
    fn from(error: DrawingErrorKind<E>) -> Self {
        Self(error.to_string())
    }
}

impl From<RowStoreError> for DrawError {
    fn from(error: RowStoreError) -> Self {
        Self(error.to_string())
    }
}

/// A stroke on the device.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stroke {
    /// Colour.
    pub color: Rgb,
    /// Width, device pixels.
    pub width: f64,
    /// Lengths of dash and gap, device pixels; solid without.
    pub dash: Option<(f64, f64)>,
}

/// Below this many device pixels a layout pixel, curves are one pixel wide: on a coarse screen as legible as a blurred one and
/// a half, and without a graphics card five times as fast.
const FINE_SCALE: f64 = 1.5;

/// A plotters backend that figures can be drawn on.
pub trait Surface: DrawingBackend {
    /// Draws a path. Without help from the backend, dash by dash on whole pixels.
    fn draw_curve(&mut self, path: &Path, stroke: Stroke) -> Result<(), DrawingErrorKind<Self::ErrorType>> {
        let style = rgb(stroke.color).stroke_width(stroke.width.round().max(1.0) as u32);
        for piece in path.pieces() {
            for dash in dash_pieces(piece, stroke.dash) {
                self.draw_path(dash, &style)?;
            }
        }
        Ok(())
    }

    /// Width of a text of this height, device pixels; a guess where the backend cannot measure.
    fn text_width(&self, text: &str, height: f64) -> f64 {
        0.5 * height * text.chars().count() as f64
    }
}

impl Surface for SVGBackend<'_> {}

/// Font of every text; each backend maps it to what it has.
const FONT: &str = "sans-serif";

/// Which point of a text is put at its place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Anchor {
    /// Middle of its left end.
    Left,
    /// Middle of its right end.
    Right,
    /// Middle of its upper edge.
    Top,
    /// Middle of its upper edge, the text turned to read upwards.
    TurnedTop,
}

/// Draws with lengths in layout pixels, scaled to the device.
pub(super) struct Pen<'s, S> {
    pub surface: &'s mut S,
    pub style: Style,
}

impl<S: Surface> Pen<'_, S> {
    /// A length in whole device pixels.
    pub fn px(&self, layout: f64) -> f64 {
        (layout * self.style.scale).round()
    }

    /// Fills a rectangle on the boundaries of pixels.
    pub fn fill(&mut self, frame: Frame, color: Rgb) -> Result<(), DrawError> {
        let (from, to) = (pixel((frame.left, frame.top)), pixel((frame.right, frame.bottom)));
        Ok(self.surface.draw_rect(from, to, &rgb(color).filled(), true)?)
    }

    /// A thin line across or down, as a rectangle: sharp at any scale.
    pub fn hairline(&mut self, from: Point, to: Point, color: Rgb) -> Result<(), DrawError> {
        let width = self.px(1.0).max(1.0);
        let (x, y) = (from.0.round(), from.1.round());
        let (right, bottom) = if from.1 == to.1 { (to.0.round(), y + width) } else { (x + width, to.1.round()) };
        self.fill(Frame { left: x, top: y, right, bottom }, color)
    }

    /// A text whose height is `size` layout pixels.
    pub fn text(&mut self, text: &str, at: Point, size: f64, color: Rgb, anchor: Anchor) -> Result<(), DrawError> {
        let (h, v) = match anchor {
            Anchor::Left => (HPos::Left, VPos::Center),
            Anchor::Right => (HPos::Right, VPos::Center),
            Anchor::Top | Anchor::TurnedTop => (HPos::Center, VPos::Top),
        };
        let font = (FONT, size * self.style.scale).into_font();
        let font = if anchor == Anchor::TurnedTop { font.transform(FontTransform::Rotate270) } else { font };
        let style = font.color(&rgb(color)).pos(Pos::new(h, v));
        Ok(self.surface.draw_text(text, &style, pixel(at))?)
    }

    /// Width of a text, device pixels.
    pub fn text_width(&self, text: &str, size: f64) -> f64 {
        self.surface.text_width(text, size * self.style.scale)
    }

    /// A curve.
    pub fn curve(&mut self, path: &Path, line: Line) -> Result<(), DrawError> {
        let scale = self.style.scale;
        let dash = line.dash.0.map(|(on, off)| (f64::from(on) * scale, f64::from(off) * scale));
        let width = if scale < FINE_SCALE { 1.0 } else { line.width * scale };
        Ok(self.surface.draw_curve(path, Stroke { color: line.color, width, dash })?)
    }
}

/// The nearest whole pixel.
fn pixel((x, y): Point) -> BackendCoord {
    (x.round() as i32, y.round() as i32)
}

/// A colour as plotters has it.
fn rgb((r, g, b): Rgb) -> RGBColor {
    RGBColor(r, g, b)
}

/// Cuts a polyline into its dashes.
fn dash_pieces(points: &[Point], dash: Option<(f64, f64)>) -> Vec<Vec<BackendCoord>> {
    let Some((on, off)) = dash else {
        return vec![points.iter().copied().map(pixel).collect()];
    };
    let lengths = [on, off];
    let mut pieces = Vec::new();
    let mut piece: Vec<_> = points.first().copied().map(pixel).into_iter().collect();
    let (mut phase, mut left) = (0, lengths[0]);
    for pair in points.windows(2) {
        let (mut from, to) = (pair[0], pair[1]);
        loop {
            let (dx, dy) = (to.0 - from.0, to.1 - from.1);
            let distance = (dx * dx + dy * dy).sqrt();
            if distance <= left {
                left -= distance;
                if phase == 0 {
                    piece.push(pixel(to));
                }
                break;
            }
            from = (from.0 + dx * left / distance, from.1 + dy * left / distance);
            if phase == 0 {
                piece.push(pixel(from));
                pieces.push(std::mem::take(&mut piece));
            } else {
                piece.push(pixel(from));
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
        let pieces = dash_pieces(&[(0.0, 0.0), (30.0, 0.0)], Some((8.0, 4.0)));
        assert_eq!(pieces, [vec![(0, 0), (8, 0)], vec![(12, 0), (20, 0)], vec![(24, 0), (30, 0)]]);
    }
}
