//! `plotters-canvas`, with the parts that figures use most done directly on the canvas.
//!
//! Plotters' own measuring of text adds an element with an inline style to the page for every label, which the content
//! security policy forbids and which lays the page out anew each time. Its lines know no dashes and no parts of pixels.
//! And it sets colour and font as text for every single element, which costs more than to draw them: here they are set when
//! they change. Everything else is handed through.

use adaptarm_core::figures::{Path, Stroke, Surface};
use plotters_backend::text_anchor::{HPos, VPos};
use plotters_backend::{BackendColor, BackendCoord, BackendStyle, BackendTextStyle, DrawingBackend, DrawingErrorKind};
use plotters_backend::{FontFamily, FontTransform};
use plotters_canvas::CanvasBackend;
use std::cell::Cell;
use std::f64::consts::FRAC_PI_2;
use wasm_bindgen::JsCast;
use web_sys::{CanvasRenderingContext2d, HtmlCanvasElement};

/// A canvas to draw on.
pub(crate) struct Canvas {
    backend: CanvasBackend,
    context: CanvasRenderingContext2d,
    /// What the context was last told.
    fill: Option<(u8, u8, u8)>,
    font_size: Cell<f64>,
    anchor: Option<(&'static str, &'static str)>,
}

type Error = <CanvasBackend as DrawingBackend>::ErrorType;
type Drawn = Result<(), DrawingErrorKind<Error>>;

impl Canvas {
    /// The canvas' backend; `None` if it has another kind of context already.
    pub fn new(canvas: HtmlCanvasElement) -> Option<Self> {
        let context: CanvasRenderingContext2d = canvas.get_context("2d").ok()??.dyn_into().ok()?;
        // A noisy curve must have no spikes that are not in its data.
        context.set_line_join("round");
        let backend = CanvasBackend::with_canvas_object(canvas)?;
        Some(Self { backend, context, fill: None, font_size: Cell::new(0.0), anchor: None })
    }

    fn set_fill(&mut self, color: BackendColor) {
        if self.fill != Some(color.rgb) {
            self.fill = Some(color.rgb);
            self.context.set_fill_style_str(&css(color.rgb));
        }
    }

    fn set_font(&self, size: f64) {
        if self.font_size.get().to_bits() != size.to_bits() {
            self.font_size.set(size);
            self.context.set_font(&format!("{size}px {}", FontFamily::SansSerif.as_str()));
        }
    }
}

fn css((red, green, blue): (u8, u8, u8)) -> String {
    format!("#{red:02x}{green:02x}{blue:02x}")
}

impl Surface for Canvas {
    fn draw_curve(&mut self, path: &Path, stroke: Stroke) -> Drawn {
        let context = &self.context;
        context.begin_path();
        for piece in path.pieces() {
            context.move_to(piece[0].0, piece[0].1);
            for (x, y) in &piece[1..] {
                context.line_to(*x, *y);
            }
        }
        context.set_stroke_style_str(&css(stroke.color));
        context.set_line_width(stroke.width);
        let dash = match stroke.dash {
            Some((on, off)) => js_sys::Array::of2(&on.into(), &off.into()),
            None => js_sys::Array::new(),
        };
        // It refuses lengths that are negative or not finite; a solid line is what remains then.
        context.set_line_dash(&dash).ok();
        context.stroke();
        Ok(())
    }

    fn text_width(&self, text: &str, height: f64) -> f64 {
        self.set_font(height);
        // A browser that cannot measure still gets a drawing.
        let guess = 0.5 * height * text.chars().count() as f64;
        self.context.measure_text(text).map_or(guess, |size| size.width())
    }
}

impl DrawingBackend for Canvas {
    type ErrorType = Error;

    fn get_size(&self) -> (u32, u32) {
        self.backend.get_size()
    }

    fn ensure_prepared(&mut self) -> Drawn {
        self.backend.ensure_prepared()
    }

    fn present(&mut self) -> Drawn {
        self.backend.present()
    }

    fn draw_pixel(&mut self, at: BackendCoord, color: BackendColor) -> Drawn {
        self.fill = None;
        self.backend.draw_pixel(at, color)
    }

    fn draw_line<S: BackendStyle>(&mut self, from: BackendCoord, to: BackendCoord, style: &S) -> Drawn {
        self.backend.draw_line(from, to, style)
    }

    fn draw_rect<S: BackendStyle>(&mut self, from: BackendCoord, to: BackendCoord, style: &S, fill: bool) -> Drawn {
        if !fill || style.color().alpha < 1.0 {
            self.fill = None;
            return self.backend.draw_rect(from, to, style, fill);
        }
        self.set_fill(style.color());
        let [left, top, width, height] = [from.0, from.1, to.0 - from.0, to.1 - from.1].map(f64::from);
        self.context.fill_rect(left, top, width, height);
        Ok(())
    }

    fn draw_path<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(&mut self, path: I, style: &S) -> Drawn {
        self.backend.draw_path(path, style)
    }

    fn draw_circle<S: BackendStyle>(&mut self, center: BackendCoord, radius: u32, style: &S, fill: bool) -> Drawn {
        self.fill = None;
        self.backend.draw_circle(center, radius, style, fill)
    }

    fn fill_polygon<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(&mut self, path: I, style: &S) -> Drawn {
        self.fill = None;
        self.backend.fill_polygon(path, style)
    }

    fn draw_text<S: BackendTextStyle>(&mut self, text: &str, style: &S, at: BackendCoord) -> Drawn {
        self.set_fill(style.color());
        self.set_font(style.size());
        let anchor = style.anchor();
        let align = match anchor.h_pos {
            HPos::Left => "start",
            HPos::Right => "end",
            HPos::Center => "center",
        };
        let baseline = match anchor.v_pos {
            VPos::Top => "top",
            VPos::Center => "middle",
            VPos::Bottom => "bottom",
        };
        if self.anchor != Some((align, baseline)) {
            self.anchor = Some((align, baseline));
            self.context.set_text_align(align);
            self.context.set_text_baseline(baseline);
        }
        let turns = match style.transform() {
            FontTransform::None => 0.0,
            FontTransform::Rotate90 => 1.0,
            FontTransform::Rotate180 => 2.0,
            FontTransform::Rotate270 => 3.0,
        };
        let (x, y) = (f64::from(at.0), f64::from(at.1));
        // The context refuses none of these: they fail only in name.
        if turns == 0.0 {
            self.context.fill_text(text, x, y).ok();
        } else {
            self.context.translate(x, y).ok();
            self.context.rotate(turns * FRAC_PI_2).ok();
            self.context.fill_text(text, 0.0, 0.0).ok();
            self.context.set_transform(1.0, 0.0, 0.0, 1.0, 0.0, 0.0).ok();
        }
        Ok(())
    }
}
