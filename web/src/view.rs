//! How the page wants a figure drawn: one JSON document, read and checked.

use crate::failure::Failure;
use crate::runs::Runs;
use adaptarm_core::decomposition::{PARTS, TorquePart};
use adaptarm_core::figures::{AxisKind, Figure, PlottedRun, Rgb, Style, Texts, Theme, View};
use adaptarm_core::robots::{ROBOTS, RobotData};
use serde::Deserialize;
use std::collections::BTreeMap;

/// A view as the page writes it; everything but `shown`, `dark` and `scale` may be left out.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ViewDocument {
    /// Runs to show, in the order of the legend; those that do not exist are left out.
    pub shown: Vec<ShownDocument>,
    /// On a dark page.
    dark: bool,
    /// Device pixels per layout pixel.
    scale: f64,
    /// Window of time, s; the whole run without.
    #[serde(default)]
    from_s: Option<f64>,
    #[serde(default)]
    to_s: Option<f64>,
    /// Axis of the values; figures that have no other stay linear.
    #[serde(default)]
    axis: AxisDocument,
    /// Which run is meant where a figure shows one only; the first that is shown without.
    #[serde(default)]
    focus: Option<String>,
    /// Legend of true parameters and desired angles.
    #[serde(default)]
    true_value: Option<String>,
    /// Legend of limits.
    #[serde(default)]
    limit: Option<String>,
    /// Legend of a torque's parts, by their identifiers, and of their sum, `total`.
    #[serde(default)]
    parts: BTreeMap<String, String>,
    /// Title of the time axis.
    #[serde(default = "time_axis")]
    time_axis: String,
}

/// A run of a view.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ShownDocument {
    /// The page's name for it.
    pub id: String,
    /// Name in the legend; the scheme's without.
    #[serde(default)]
    label: Option<String>,
    /// Lighter, thinner, below the others.
    #[serde(default)]
    faded: bool,
    /// `#rrggbb` instead of the scheme's colour.
    #[serde(default)]
    color: Option<String>,
}

#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
enum AxisDocument {
    #[default]
    Linear,
    Symlog,
}

fn time_axis() -> String {
    Texts::default().time_axis.to_owned()
}

impl ViewDocument {
    /// Reads and checks a view.
    pub fn read(json: &str) -> Result<Self, Failure> {
        let view: Self = serde_json::from_str(json).map_err(|error| Failure::new(error.to_string()))?;
        if !(view.scale > 0.0 && view.scale.is_finite()) {
            return Err(Failure::at("/scale", format!("{} is not a positive number", view.scale)));
        }
        match (view.from_s, view.to_s) {
            (Some(from_s), Some(to_s)) if from_s >= to_s => {
                Err(Failure::at("/to_s", format!("a window from {from_s} s to {to_s} s is empty")))
            }
            (Some(_), None) => Err(Failure::at("/to_s", "a window that starts must end")),
            (None, Some(to_s)) if to_s <= 0.0 => {
                Err(Failure::at("/to_s", format!("a window from 0 s to {to_s} s is empty")))
            }
            _ => {
                for (n, shown) in view.shown.iter().enumerate() {
                    if let Some(color) = shown.color.as_deref().filter(|color| rgb(color).is_none()) {
                        return Err(Failure::at(
                            format!("/shown/{n}/color"),
                            format!("{color:?} is not a colour like #0054a6"),
                        ));
                    }
                }
                Ok(view)
            }
        }
    }
}

/// `#rrggbb`.
fn rgb(text: &str) -> Option<Rgb> {
    let digits = text.strip_prefix('#').filter(|digits| digits.len() == 6 && digits.is_ascii())?;
    let channel = |n: usize| u8::from_str_radix(&digits[2 * n..2 * n + 2], 16).ok();
    Some((channel(0)?, channel(1)?, channel(2)?))
}

/// The figure called `id`.
pub(crate) fn figure(id: &str) -> Result<Figure, Failure> {
    Figure::from_id(id).ok_or_else(|| Failure::new(format!("{id:?} is not a figure")))
}

/// What the core needs to draw or read a figure: the runs that exist, and how.
pub(crate) struct Scene<'a> {
    /// Names of the runs, in the order of `runs`.
    pub ids: Vec<&'a str>,
    pub runs: Vec<PlottedRun<'a>>,
    pub robot: &'static RobotData,
    pub view: View<'a>,
}

impl<'a> Scene<'a> {
    /// The scene of a figure.
    pub fn new(runs: &'a Runs, figure: Figure, document: &'a ViewDocument) -> Self {
        let shown: Vec<_> =
            document.shown.iter().filter_map(|shown| runs.get(&shown.id).map(|run| (shown, run))).collect();
        let ids: Vec<_> = shown.iter().map(|(shown, _)| shown.id.as_str()).collect();
        let focus = ids.iter().position(|id| Some(*id) == document.focus.as_deref()).unwrap_or(0);
        let plotted = shown.iter().enumerate().map(|(n, (shown, run))| PlottedRun {
            parts: (figure == Figure::TorqueParts && n == focus).then(|| run.torque_parts()),
            label: shown.label.as_deref(),
            faded: shown.faded,
            color: shown.color.as_deref().and_then(rgb),
            ..PlottedRun::new(run.scenario.scheme(), &run.recording, run.completed, &run.theta)
        });
        let from_s = document.from_s.unwrap_or(0.0);
        let texts = Texts::default();
        let part = |id: &str, default| document.parts.get(id).map_or(default, String::as_str);
        let view = View {
            style: Style { theme: if document.dark { Theme::Dark } else { Theme::Light }, scale: document.scale },
            window_s: document.to_s.map(|to_s| (from_s, to_s)),
            axis: match document.axis {
                AxisDocument::Linear => AxisKind::Linear,
                AxisDocument::Symlog => AxisKind::Symlog,
            },
            focus,
            texts: Texts {
                reference: document.true_value.as_deref(),
                limit: document.limit.as_deref(),
                time_axis: &document.time_axis,
                parts: std::array::from_fn::<_, PARTS, _>(|n| part(TorquePart::ALL[n].id(), texts.parts[n])),
                total: part("total", texts.total),
            },
        };
        let robot = shown.first().map_or(ROBOTS[0], |(_, run)| run.scenario.robot());
        Self { runs: plotted.collect(), ids, robot, view }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn failure(json: &str) -> Failure {
        ViewDocument::read(json).unwrap_err()
    }

    #[test]
    fn a_view_names_what_it_does_not_know() {
        let error = failure(r#"{"shown":[],"dark":false,"scale":1,"zoom":2}"#);
        assert!(error.message.contains("zoom"), "{}", error.message);
        let error = failure(r#"{"shown":[{"id":"a","colour":"red"}],"dark":false,"scale":1}"#);
        assert!(error.message.contains("colour"), "{}", error.message);
    }

    #[test]
    fn empty_windows_and_colours_that_are_none_are_refused() {
        let with = |rest: &str| failure(&format!(r#"{{"shown":[],"dark":false,"scale":1,{rest}}}"#)).pointer;
        assert_eq!(with(r#""from_s":3,"to_s":3"#), "/to_s");
        assert_eq!(with(r#""from_s":3"#), "/to_s");
        assert_eq!(with(r#""to_s":0"#), "/to_s");
        assert_eq!(failure(r#"{"shown":[],"dark":false,"scale":0}"#).pointer, "/scale");
        let color = r##"{"shown":[{"id":"a"},{"id":"b","color":"#12345g"}],"dark":false,"scale":1}"##;
        assert_eq!(failure(color).pointer, "/shown/1/color");
        assert_eq!(rgb("#0054a6"), Some((0, 84, 166)));
        assert!(["0054a6", "#54a6", "#0054aé", ""].iter().all(|text| rgb(text).is_none()));
    }
}
