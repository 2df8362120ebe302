//! Figures as files: SVG from the core, and PNG drawn from that very SVG with an embedded font.
//!
//! The font comes with the program, so that a picture looks the same on a machine without any.

mod request;

pub use request::{FigureRequest, NoFigure, PictureFormat, file_names};

use adaptarm_core::figures::{DrawError, Figure, PlottedRun, Style, Theme, View, svg};
use adaptarm_core::robots::RobotData;
use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{self, fontdb};
use std::sync::{Arc, LazyLock};
use thiserror::Error;

/// Pixels of a PNG per layout pixel: sharp in print.
const PNG_SCALE: f32 = 2.0;

/// A figure that could not be made.
#[derive(Debug, Error)]
pub enum FigureError {
    /// The drawing failed.
    #[error(transparent)]
    Draw(#[from] DrawError),
    /// The SVG could not be read back.
    #[error("the figure's SVG cannot be rendered: {0}")]
    Svg(#[from] usvg::Error),
    /// The picture could not be allocated or encoded.
    #[error("the figure's PNG cannot be written: {0}")]
    Png(String),
    /// The run's scenario, which some figures need, cannot be read.
    #[error("the run's scenario cannot be read: {0}")]
    Scenario(String),
}

/// The program's own font, under the names that drawings use.
static FONTS: LazyLock<Arc<fontdb::Database>> = LazyLock::new(|| {
    let mut fonts = fontdb::Database::new();
    fonts.load_font_data(dejavu::sans::regular().to_vec());
    fonts.set_sans_serif_family("DejaVu Sans");
    Arc::new(fonts)
});

/// A figure of whole runs as SVG, on paper.
pub fn figure_svg(figure: Figure, robot: &RobotData, runs: &[PlottedRun<'_>]) -> Result<String, FigureError> {
    Ok(svg(figure, robot, runs, &View::whole(Style { theme: Theme::Light, scale: 1.0 }))?)
}

/// A figure's SVG as PNG, twice its natural size.
pub fn png(svg: &str) -> Result<Vec<u8>, FigureError> {
    let options = usvg::Options { fontdb: Arc::clone(&FONTS), ..usvg::Options::default() };
    let tree = usvg::Tree::from_str(svg, &options)?;
    let size = tree.size();
    let (width, height) = ((size.width() * PNG_SCALE) as u32, (size.height() * PNG_SCALE) as u32);
    let mut pixmap =
        Pixmap::new(width, height).ok_or_else(|| FigureError::Png(format!("{width} x {height} pixels")))?;
    resvg::render(&tree, Transform::from_scale(PNG_SCALE, PNG_SCALE), &mut pixmap.as_mut());
    pixmap.encode_png().map_err(|error| FigureError::Png(error.to_string()))
}
