//! Colours, dashes and sizes. Schemes differ in colour and in dash, so that no figure depends on colour alone.

use crate::scenario::Scheme;

/// An sRGB colour.
pub type Rgb = (u8, u8, u8);

/// Light or dark surroundings.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Theme {
    /// Dark ink on white.
    Light,
    /// Light ink on near-black.
    Dark,
}

/// How to draw: theme and device pixels per layout pixel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Style {
    /// Theme.
    pub theme: Theme,
    /// Device pixels per layout pixel: fonts and strokes grow with it.
    pub scale: f64,
}

/// Pattern of a line: lengths of dash and gap in layout pixels; solid without.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Dash(pub Option<(u32, u32)>);

impl Theme {
    /// Paper.
    pub const fn background(self) -> Rgb {
        match self {
            Self::Light => (255, 255, 255),
            Self::Dark => (22, 26, 33),
        }
    }

    /// Text and axes.
    pub const fn ink(self) -> Rgb {
        match self {
            Self::Light => (32, 36, 42),
            Self::Dark => (222, 227, 234),
        }
    }

    /// Grid lines.
    pub const fn grid(self) -> Rgb {
        match self {
            Self::Light => (224, 228, 233),
            Self::Dark => (50, 57, 68),
        }
    }

    /// What the true value of a parameter is drawn in.
    pub const fn truth(self) -> Rgb {
        match self {
            Self::Light => (90, 96, 105),
            Self::Dark => (150, 158, 170),
        }
    }
}

/// Colour and dash of a scheme; colours differ in lightness too and keep 3:1 contrast to the background.
pub const fn scheme_style(scheme: Scheme, theme: Theme) -> (Rgb, Dash) {
    let dash = match scheme {
        Scheme::Proposed => Dash(None),
        Scheme::TangArteaga => Dash(Some((8, 4))),
        Scheme::SlotineLi => Dash(Some((2, 3))),
    };
    let color = match (scheme, theme) {
        (Scheme::Proposed, Theme::Light) => (0, 84, 166),
        (Scheme::Proposed, Theme::Dark) => (102, 178, 255),
        (Scheme::TangArteaga, Theme::Light) => (196, 74, 0),
        (Scheme::TangArteaga, Theme::Dark) => (255, 159, 82),
        (Scheme::SlotineLi, Theme::Light) => (0, 122, 94),
        (Scheme::SlotineLi, Theme::Dark) => (88, 214, 170),
    };
    (color, dash)
}
