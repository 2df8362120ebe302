//! What experiments show: heat maps of grids, boxes per base and condition, rankings, parallel coordinates, convergence of a
//! search. Drawn through any plotters backend like the runs' figures, with the same ink.

mod boxes;
mod chart;
mod convergence;
mod heat_map;
mod names;
mod parallel;
mod ranking;
mod shades;

use super::path::Frame;
use super::style::{Style, Theme};
use super::surface::{DrawError, Pen, Surface};
use crate::experiments::{Experiment, Results, Summary, SweepDesign, TuningSummary};
use plotters::prelude::*;

/// Drawing units per layout pixel of an SVG, as the runs' figures have them.
const UNITS: u32 = 4;

/// Width of every figure, layout pixels.
const WIDTH: u32 = 900;

/// The metric that is drawn unless another one is asked for.
const METRIC: &str = "index_e_deg";

/// What is known of an experiment.
#[derive(Debug, Clone, Copy)]
pub enum Shown<'a> {
    /// Of a sweep, a Monte Carlo study or a comparison: the rows that there are, and what they say.
    Rows(&'a Results, &'a Summary),
    /// Of a tuning: what it has found.
    Search(&'a TuningSummary),
}

/// A figure of an experiment.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum ExperimentFigure {
    /// A metric over the two axes of a grid, base by base.
    HeatMap,
    /// Quantiles of a metric, per base and condition.
    Boxes,
    /// Bases by their mean rank, with its interval.
    Ranking,
    /// Every point of a sweep as a line across its fields, to the metric.
    ParallelCoordinates,
    /// The objective of a tuning, generation by generation, and how wide it searches.
    Convergence,
}

impl ExperimentFigure {
    /// Every figure.
    pub const ALL: [Self; 5] =
        [Self::HeatMap, Self::Boxes, Self::Ranking, Self::ParallelCoordinates, Self::Convergence];

    /// Identifier, in file names and addresses.
    pub const fn id(self) -> &'static str {
        match self {
            Self::HeatMap => "heat_map",
            Self::Boxes => "boxes",
            Self::Ranking => "ranking",
            Self::ParallelCoordinates => "parallel_coordinates",
            Self::Convergence => "convergence",
        }
    }

    /// Whether this experiment has it.
    pub fn shows(self, experiment: &Experiment) -> bool {
        let sweep = experiment.document().sweep.as_ref();
        match self {
            Self::HeatMap => sweep.is_some_and(|sweep| sweep.design == SweepDesign::Grid && sweep.axes.len() == 2),
            Self::Boxes => experiment.runs().is_some(),
            Self::Ranking => experiment.runs().is_some() && experiment.base_names().len() > 1,
            Self::ParallelCoordinates => sweep.is_some_and(|sweep| sweep.axes.len() > 1),
            Self::Convergence => experiment.runs().is_none(),
        }
    }

    /// Height in layout pixels at the natural width.
    fn height(self, experiment: &Experiment) -> u32 {
        match self {
            Self::HeatMap => heat_map::height(experiment),
            Self::Boxes => boxes::height(experiment),
            Self::Ranking => ranking::height(experiment),
            Self::ParallelCoordinates => 420,
            Self::Convergence => 460,
        }
    }
}

/// Metrics that can be drawn: those over all joints.
pub fn experiment_metrics(experiment: &Experiment) -> impl Iterator<Item = &str> {
    experiment.columns().overall().map(|column| experiment.columns().names()[column].as_str())
}

/// The column of a metric; of the default one without a name, of nothing where there is none.
fn column(experiment: &Experiment, metric: Option<&str>) -> Option<usize> {
    experiment.columns().place(metric.unwrap_or(METRIC))
}

/// What all figures are drawn from.
struct Sheet<'a> {
    experiment: &'a Experiment,
    column: usize,
    metric: &'a str,
    whole: Frame,
}

/// Draws a figure over the whole surface. The `metric` is one of [`experiment_metrics`]; where the figure or the experiment has
/// none of it, that is said in the picture.
pub fn draw_experiment<S: Surface>(
    surface: &mut S,
    figure: ExperimentFigure,
    experiment: &Experiment,
    shown: Shown<'_>,
    metric: Option<&str>,
    style: Style,
) -> Result<(), DrawError> {
    let (width, height) = surface.get_size();
    let whole = Frame { left: 0.0, top: 0.0, right: f64::from(width), bottom: f64::from(height) };
    let mut pen = Pen { surface, style };
    pen.fill(whole, style.theme.background())?;
    let column = column(experiment, metric).unwrap_or(0);
    let sheet = Sheet { experiment, column, metric: &experiment.columns().names()[column], whole };
    match (figure, shown) {
        (ExperimentFigure::HeatMap, Shown::Rows(results, _)) => heat_map::draw(&mut pen, &sheet, results),
        (ExperimentFigure::Boxes, Shown::Rows(_, summary)) => boxes::draw(&mut pen, &sheet, summary),
        (ExperimentFigure::Ranking, Shown::Rows(_, summary)) => ranking::draw(&mut pen, &sheet, summary),
        (ExperimentFigure::ParallelCoordinates, Shown::Rows(results, _)) => parallel::draw(&mut pen, &sheet, results),
        (ExperimentFigure::Convergence, Shown::Search(summary)) => convergence::draw(&mut pen, &sheet, summary),
        _ => chart::say(&mut pen, &sheet.whole, "this experiment has no such figure"),
    }
}

/// A figure as an SVG document of its natural size, on paper.
pub fn experiment_svg(
    figure: ExperimentFigure,
    experiment: &Experiment,
    shown: Shown<'_>,
    metric: Option<&str>,
) -> Result<String, DrawError> {
    let (width, height) = (WIDTH, figure.height(experiment));
    let mut document = String::new();
    {
        let mut backend = SVGBackend::with_string(&mut document, (width * UNITS, height * UNITS));
        let style = Style { theme: Theme::Light, scale: f64::from(UNITS) };
        draw_experiment(&mut backend, figure, experiment, shown, metric, style)?;
        backend.present()?;
    }
    let drawn = format!("<svg width=\"{}\" height=\"{}\"", width * UNITS, height * UNITS);
    Ok(document.replacen(&drawn, &format!("<svg width=\"{width}\" height=\"{height}\""), 1))
}
