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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiments::{
        AxisDocument, BaseDocument, CompareDocument, ConditionDocument, EXPERIMENT_FORMAT, ExperimentDocument,
        ExperimentKind, GoalDocument, SettingDocument, SweepDocument, TuningDocument, VariableDocument,
    };
    use crate::scenario::Scheme;
    use std::ops::ControlFlow;

    /// An experiment of short runs; what the document lacks is the caller's.
    fn experiment(kind: ExperimentKind, bases: &[Scheme], change: impl FnOnce(&mut ExperimentDocument)) -> Experiment {
        let base = |scheme: &Scheme| {
            let mut scenario = scheme.paper();
            (scenario.integration.duration_s, scenario.recording.samples) = (0.05, 10);
            BaseDocument {
                name: format!("{} with a name that is rather long to stand beside a figure", scheme.name()),
                scenario,
            }
        };
        let mut document = ExperimentDocument {
            format: EXPERIMENT_FORMAT.to_owned(),
            kind,
            title: String::new(),
            seed: 1,
            confidence: 0.95,
            bases: bases.iter().map(base).collect(),
            sweep: None,
            monte_carlo: None,
            compare: None,
            tuning: None,
        };
        change(&mut document);
        Experiment::new(document).unwrap()
    }

    fn grid() -> Experiment {
        let axis = |field: &str, values: &[f64]| AxisDocument {
            field: field.to_owned(),
            values: Some(values.to_vec()),
            min: None,
            max: None,
            points: None,
            log: false,
            relative: false,
        };
        // The last value is not allowed: its runs have no numbers.
        let axes = vec![axis("/scheme/gains/k_v/0", &[10.0, 40.0]), axis("/scheme/gains/beta", &[4.0, 8.0, 1e9])];
        experiment(ExperimentKind::Sweep, &[Scheme::Proposed], |document| {
            document.sweep = Some(SweepDocument { design: SweepDesign::Grid, points: None, axes });
        })
    }

    fn comparison() -> Experiment {
        let set = vec![SettingDocument { field: "/plant/friction/width_rad_s".to_owned(), value: 2.0, relative: true }];
        let condition = |name: &str, set| ConditionDocument { name: name.to_owned(), set };
        let conditions = vec![condition("as it is", Vec::new()), condition("softer", set)];
        experiment(ExperimentKind::Compare, &Scheme::ALL, |document| {
            document.compare = Some(CompareDocument { conditions, draws: 2, fields: Vec::new(), vary_seed: true });
        })
    }

    fn rows(experiment: &Experiment) -> Results {
        let mut results = Results::new();
        let _ = experiment.run(experiment.plan(0..experiment.runs().unwrap()), |row| {
            results.insert(experiment, row).unwrap();
            ControlFlow::Continue(())
        });
        results
    }

    fn drawn(figure: ExperimentFigure, experiment: &Experiment, results: &Results, metric: &str) -> String {
        let summary = Summary::of(experiment, results);
        experiment_svg(figure, experiment, Shown::Rows(results, &summary), Some(metric)).unwrap()
    }

    #[test]
    fn figures_are_there_with_any_metric_and_without_rows() {
        for (experiment, count) in [(grid(), 3), (comparison(), 2)] {
            let results = rows(&experiment);
            let figures = ExperimentFigure::ALL.into_iter().filter(|figure| figure.shows(&experiment));
            let figures: Vec<_> = figures.collect();
            assert_eq!(figures.len(), count);
            for figure in figures {
                for metric in experiment_metrics(&experiment) {
                    assert!(
                        drawn(figure, &experiment, &results, metric).starts_with("<svg width=\"900\""),
                        "{figure:?} {metric}"
                    );
                }
                let empty = drawn(figure, &experiment, &Results::new(), METRIC);
                assert!(empty.contains("no run has this metric") || empty.contains("cannot be ranked"), "{figure:?}");
            }
        }
    }

    #[test]
    fn a_heat_map_frames_the_best_and_crosses_out_what_has_no_number() {
        let experiment = grid();
        let results = rows(&experiment);
        let svg = drawn(ExperimentFigure::HeatMap, &experiment, &results, METRIC);
        let limit = Theme::Light.limit();
        let red = format!("#{:02X}{:02X}{:02X}", limit.0, limit.1, limit.2);
        // Two strokes for each of the two refused cells.
        assert_eq!(svg.matches(&red).count(), 4, "{svg}");
        let column = experiment.columns().place(METRIC).unwrap();
        let least = results.rows().filter_map(|row| row.metrics[column]).fold(f64::INFINITY, f64::min);
        assert!(svg.contains(&chart::short(least)));
    }

    #[test]
    fn a_search_is_drawn_at_each_of_its_moments() {
        let variable = VariableDocument {
            field: "/scheme/gains/beta".to_owned(),
            min: 1.0,
            max: 20.0,
            log: false,
            relative: false,
        };
        let goal = GoalDocument { metric: METRIC.to_owned(), weight: 1.0, scale: None };
        let experiment = experiment(ExperimentKind::Tuning, &[Scheme::Proposed], |document| {
            document.tuning = Some(TuningDocument {
                variables: vec![variable],
                objective: vec![goal],
                constraints: Vec::new(),
                plants: None,
                population: Some(4),
                evaluations: 12,
                restarts: 0,
                initial_step: 0.2,
            });
        });
        let mut search = experiment.tuning().unwrap();
        let mut lengths = Vec::new();
        loop {
            let summary = search.summary(&experiment);
            let svg =
                experiment_svg(ExperimentFigure::Convergence, &experiment, Shown::Search(&summary), None).unwrap();
            lengths.push(svg.len());
            if search.is_done() {
                break;
            }
            let mut rows = Vec::new();
            let _ = experiment.run(search.plan(&experiment), |row| {
                rows.push(row);
                ControlFlow::Continue(())
            });
            search.tell(&experiment, rows).unwrap();
        }
        assert!(lengths.len() > 4 && lengths[0] == lengths[1] && lengths[1] < *lengths.last().unwrap(), "{lengths:?}");
        let (kind, other) = (ExperimentFigure::Convergence, comparison());
        assert!(kind.shows(&experiment) && !kind.shows(&other));
    }
}
