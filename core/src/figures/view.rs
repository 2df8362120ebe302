//! How a figure is to be drawn: theme and size, window of time, kind of axis, and the texts that depend on a language.

use super::style::Style;
use crate::decomposition::{PARTS, TorquePart};

/// How values are mapped to heights.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum AxisKind {
    /// Evenly.
    #[default]
    Linear,
    /// Evenly about zero, by decades far from it; figures without such an axis stay linear.
    Symlog,
}

/// How to draw a figure.
#[derive(Debug, Clone, Copy)]
pub struct View<'a> {
    /// Theme and device pixels per layout pixel.
    pub style: Style,
    /// What is shown, s; everything without.
    pub window_s: Option<(f64, f64)>,
    /// Axis of the values.
    pub axis: AxisKind,
    /// Which of the runs is meant where a figure shows one only.
    pub focus: usize,
    /// Texts.
    pub texts: Texts<'a>,
}

/// Texts within figures; symbols and units need no language.
#[derive(Debug, Clone, Copy)]
pub struct Texts<'a> {
    /// Legend of what curves are compared with: true parameters, desired angles.
    pub reference: Option<&'a str>,
    /// Legend of limits.
    pub limit: Option<&'a str>,
    /// Title of the time axis.
    pub time_axis: &'a str,
    /// Legend of the parts of a torque.
    pub parts: [&'a str; PARTS],
    /// Legend of their sum.
    pub total: &'a str,
}

impl Default for Texts<'_> {
    fn default() -> Self {
        Self {
            reference: None,
            limit: None,
            time_axis: "t [s]",
            parts: TorquePart::ALL.map(TorquePart::name),
            total: "torque",
        }
    }
}

impl View<'_> {
    /// The whole run on linear axes, in English.
    pub fn whole(style: Style) -> Self {
        Self { style, window_s: None, axis: AxisKind::Linear, focus: 0, texts: Texts::default() }
    }
}
