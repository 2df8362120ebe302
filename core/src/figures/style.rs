//! Colours, dashes and sizes. Lines differ in colour and in dash, so that no figure depends on colour alone, and every one
//! has a contrast of at least 3:1 to its background.

use crate::decomposition::{PARTS, TorquePart};
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

/// How a curve is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Line {
    pub color: Rgb,
    pub dash: Dash,
    /// Layout pixels.
    pub width: f64,
}

impl Theme {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Light, Self::Dark];

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

    /// What curves are compared with: true parameters, desired angles.
    pub const fn truth(self) -> Rgb {
        match self {
            Self::Light => (90, 96, 105),
            Self::Dark => (150, 158, 170),
        }
    }

    /// Limits that should not be passed.
    pub const fn limit(self) -> Rgb {
        match self {
            Self::Light => (176, 28, 46),
            Self::Dark => (255, 122, 128),
        }
    }
}

/// Colour and dash of a scheme; colours differ in lightness too and keep 3:1 contrast to the background.
pub const fn scheme_style(scheme: Scheme, theme: Theme) -> (Rgb, Dash) {
    let dash = match scheme {
        Scheme::Proposed => Dash(None),
        Scheme::TangArteaga => Dash(Some((8, 4))),
        Scheme::SlotineLi => Dash(Some((2, 3))),
        Scheme::Pd => Dash(Some((12, 3))),
        Scheme::PdGravity => Dash(Some((6, 2))),
        Scheme::ComputedTorque => Dash(Some((4, 4))),
    };
    let color = match (scheme, theme) {
        (Scheme::Proposed, Theme::Light) => (0, 84, 166),
        (Scheme::Proposed, Theme::Dark) => (102, 178, 255),
        (Scheme::TangArteaga, Theme::Light) => (196, 74, 0),
        (Scheme::TangArteaga, Theme::Dark) => (255, 159, 82),
        (Scheme::SlotineLi, Theme::Light) => (0, 122, 94),
        (Scheme::SlotineLi, Theme::Dark) => (88, 214, 170),
        (Scheme::Pd, Theme::Light) => (107, 63, 160),
        (Scheme::Pd, Theme::Dark) => (190, 160, 255),
        (Scheme::PdGravity, Theme::Light) => (160, 30, 80),
        (Scheme::PdGravity, Theme::Dark) => (255, 140, 180),
        (Scheme::ComputedTorque, Theme::Light) => (85, 85, 85),
        (Scheme::ComputedTorque, Theme::Dark) => (190, 190, 190),
    };
    (color, dash)
}

/// Widths of curves, layout pixels: of live runs, of those to compare with, of what is true or wanted. Where the browser
/// draws without a graphics card, a line wider than one pixel of the device takes five times as long.
const LIVE: f64 = 1.6;
const FADED: f64 = 1.0;
const REFERENCE: f64 = 1.0;

impl Line {
    /// Of a run.
    pub fn of_run(color: Rgb, dash: Dash, faded: bool, theme: Theme) -> Self {
        if faded { Self { color: fade(color, theme), dash, width: FADED } } else { Self { color, dash, width: LIVE } }
    }

    /// Of a true parameter or a desired angle.
    pub const fn of_reference(theme: Theme) -> Self {
        Self { color: theme.truth(), dash: Dash(Some((1, 2))), width: REFERENCE }
    }

    /// Of a limit.
    pub const fn of_limit(theme: Theme) -> Self {
        Self { color: theme.limit(), dash: Dash(Some((12, 6))), width: REFERENCE }
    }
}

/// Line of a part of a torque, by its index in `TorquePart::ALL`.
pub(super) const fn part_line(part: usize, theme: Theme) -> Line {
    const LIGHT: [Rgb; PARTS] = [(0, 84, 166), (168, 30, 120), (0, 122, 94), (196, 74, 0), (110, 84, 24)];
    const DARK: [Rgb; PARTS] = [(102, 178, 255), (255, 130, 200), (88, 214, 170), (255, 159, 82), (226, 205, 110)];
    const DASHES: [Dash; PARTS] =
        [Dash(None), Dash(Some((2, 3))), Dash(Some((14, 3))), Dash(Some((8, 4))), Dash(Some((4, 2)))];
    let color = match theme {
        Theme::Light => LIGHT[part],
        Theme::Dark => DARK[part],
    };
    Line { color, dash: DASHES[part], width: LIVE }
}

/// Line of the whole torque behind its parts.
pub(super) const fn total_line(theme: Theme) -> Line {
    Line { color: theme.truth(), dash: Dash(None), width: 2.6 }
}

/// Colour and dash of a part of a torque, or of the whole torque behind its parts.
pub const fn torque_style(part: Option<TorquePart>, theme: Theme) -> (Rgb, Dash) {
    let line = match part {
        Some(part) => part_line(part as usize, theme),
        None => total_line(theme),
    };
    (line.color, line.dash)
}

/// A lighter shade of a colour (a darker one on a dark page) that still has a contrast of at least 3:1.
fn fade(color: Rgb, theme: Theme) -> Rgb {
    const STEPS: u16 = 16;
    let background = theme.background();
    let mixed = |step: u16| {
        let mix = |color: u8, paper: u8| {
            ((u16::from(color) * (STEPS - step) + u16::from(paper) * step + STEPS / 2) / STEPS) as u8
        };
        (mix(color.0, background.0), mix(color.1, background.1), mix(color.2, background.2))
    };
    (1..STEPS).rev().map(mixed).find(|shade| contrast(*shade, background) >= 3.0).unwrap_or(color)
}

/// Contrast of two colours, 1 to 21. Source: WCAG 2.2.
fn contrast(a: Rgb, b: Rgb) -> f64 {
    let (a, b) = (luminance(a), luminance(b));
    (a.max(b) + 0.05) / (a.min(b) + 0.05)
}

/// Relative luminance of a colour. Source: WCAG 2.2.
fn luminance((red, green, blue): Rgb) -> f64 {
    let linear = |channel: u8| {
        let share = f64::from(channel) / 255.0;
        if share <= 0.04045 { share / 12.92 } else { crate::scalar::power((share + 0.055) / 1.055, 2.4) }
    };
    0.2126 * linear(red) + 0.7152 * linear(green) + 0.0722 * linear(blue)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_line_can_be_seen() {
        assert_eq!(contrast((255, 255, 255), (0, 0, 0)), 21.0);
        for theme in Theme::ALL {
            let paper = theme.background();
            let mut colors = vec![theme.truth(), theme.limit()];
            for scheme in Scheme::ALL.into_iter().chain(Scheme::YARDSTICKS) {
                let (color, dash) = scheme_style(scheme, theme);
                let faded = Line::of_run(color, dash, true, theme);
                assert!(
                    contrast(faded.color, paper) < 0.8 * contrast(color, paper),
                    "{scheme:?} {theme:?} does not fade"
                );
                assert!(faded.width < LIVE);
                colors.extend([color, faded.color]);
            }
            colors.extend((0..PARTS).map(|part| part_line(part, theme).color));
            for color in colors {
                assert!(contrast(color, paper) >= 3.0, "{color:?} on {theme:?}");
            }
            assert!(contrast(theme.ink(), paper) >= 7.0);
        }
    }

    #[test]
    fn parts_of_a_torque_differ_in_colour_and_in_dash() {
        for theme in Theme::ALL {
            for a in 0..PARTS {
                for b in 0..a {
                    let (a, b) = (part_line(a, theme), part_line(b, theme));
                    assert_ne!(a.dash, b.dash);
                    let far = |a: u8, b: u8| i32::from(a.abs_diff(b));
                    let distance = far(a.color.0, b.color.0) + far(a.color.1, b.color.1) + far(a.color.2, b.color.2);
                    assert!(distance >= 100, "{a:?} and {b:?}");
                }
            }
        }
    }
}
