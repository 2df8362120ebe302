//! What each figure shows: its panels, their labels, curves, references and limits. Nothing here draws.

use super::figure::Figure;
use super::run::{PlottedRun, Quantity};
use super::style::{Line, part_line, scheme_style, total_line};
use super::view::View;
use crate::decomposition::PARTS;
use crate::diagnostics::Traced;
use crate::recording::{Columns, Signal};
use crate::robots::RobotData;

/// One plot within a figure.
pub(super) struct Panel {
    /// What it shows, as symbol and unit: `e1 [°]`.
    pub label: String,
    /// What it shows it over, if not over time.
    pub x_label: Option<String>,
    /// From the first to be drawn to the last.
    pub curves: Vec<Curve>,
    /// What the curves are compared with.
    pub reference: Option<Reference>,
    /// Limits on either side of zero, in the label's unit.
    pub limit: Option<Limit>,
}

/// One curve of a panel.
pub(super) struct Curve {
    /// What it stands for.
    pub key: Key,
    /// Index of its run.
    pub run: usize,
    /// Over time, or over this.
    pub x: Option<Quantity>,
    pub y: Quantity,
    pub line: Line,
}

/// What a curve of a figure stands for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Key {
    /// A run, by its index.
    Run(usize),
    /// A part of a torque, by its index in `TorquePart::ALL`.
    Part(usize),
    /// The torque that the parts sum to.
    Total,
}

/// A truth beside the curves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Reference {
    /// The same at all times.
    Constant(f64),
    /// A quantity of a run.
    Curve { run: usize, quantity: Quantity },
}

/// `± value`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Limit {
    pub value: f64,
    /// Shown even where all curves stay far from it.
    pub always: bool,
}

const DEGREES: f64 = 180.0 / std::f64::consts::PI;
/// Parameters per figure of estimates.
const ESTIMATES_PER_FIGURE: usize = 6;

/// Panels of a figure of `runs` on `robot`, with their curves in the order of drawing.
pub(super) fn panels(figure: Figure, robot: &RobotData, runs: &[PlottedRun<'_>], view: &View<'_>) -> Vec<Panel> {
    let builder = Builder { figure, robot, runs, view };
    let joints = 0..robot.joint_count();
    match figure {
        Figure::Estimates1 => builder.estimates(0, ESTIMATES_PER_FIGURE),
        Figure::Estimates2 => builder.estimates(ESTIMATES_PER_FIGURE, ESTIMATES_PER_FIGURE),
        Figure::Estimates3 => builder.estimates(2 * ESTIMATES_PER_FIGURE, ESTIMATES_PER_FIGURE),
        Figure::Estimates => builder.estimates(0, robot.parameter_count()),
        Figure::ParameterErrorNorm => builder.parameter_error(),
        Figure::Excitation => builder.traced(&[
            ("λ along q [N²·m²]", Traced::ActualExcitation),
            ("λ along q_d [N²·m²]", Traced::DesiredExcitation),
        ]),
        Figure::Lyapunov => builder.traced(&[("V", Traced::Lyapunov), ("dV/dt [1/s]", Traced::LyapunovRate)]),
        Figure::ParameterErrorParts => builder.traced(&[
            ("‖x excited‖", Traced::ExcitedError),
            ("‖x unexcited‖", Traced::UnexcitedError),
        ]),
        Figure::Energy => builder.traced(&[
            ("T [J]", Traced::Kinetic),
            ("U − U(0) [J]", Traced::Potential),
            ("∫ q̇ᵀτ [J]", Traced::Supplied),
            ("∫ q̇ᵀf [J]", Traced::Dissipated),
        ]),
        _ => joints.map(|joint| builder.joint(joint)).collect(),
    }
}

struct Builder<'a> {
    figure: Figure,
    robot: &'a RobotData,
    runs: &'a [PlottedRun<'a>],
    view: &'a View<'a>,
}

impl Builder<'_> {
    fn column(&self, signal: Signal, component: usize) -> usize {
        let columns = Columns { joints: self.robot.joint_count(), parameters: self.robot.parameter_count() };
        columns.start(signal) + component
    }

    fn scaled(&self, signal: Signal, component: usize, factor: f64) -> Quantity {
        Quantity::Column { column: self.column(signal, component), factor }
    }

    /// A curve per run that belongs in the figure, those to compare with below the others.
    fn panel(&self, label: String, x: Option<Quantity>, y: Quantity) -> Panel {
        let theme = self.view.style.theme;
        let shown = |faded: bool| {
            let runs = self.runs.iter().enumerate();
            runs.filter(move |(_, run)| run.faded == faded && self.figure.shows(run.scheme))
        };
        let curves = shown(true).chain(shown(false)).map(|(index, run)| {
            let (own, dash) = scheme_style(run.scheme, theme);
            Curve {
                key: Key::Run(index),
                run: index,
                x,
                y,
                line: Line::of_run(run.color.unwrap_or(own), dash, run.faded, theme),
            }
        });
        Panel { label, x_label: None, curves: curves.collect(), reference: None, limit: None }
    }

    fn joint(&self, joint: usize) -> Panel {
        let n = joint + 1;
        let simple = |symbol: &str, unit: &str, signal: Signal, factor: f64| {
            self.panel(format!("{symbol}{n} [{unit}]"), None, self.scaled(signal, joint, factor))
        };
        match self.figure {
            Figure::VelocityErrors => simple("ė", "°/s", Signal::ErrorRate, DEGREES),
            Figure::ObserverErrors => simple("z", "°", Signal::ObserverError, DEGREES),
            Figure::SlidingVariables => simple("s", "rad/s", Signal::SlidingVariable, 1.0),
            Figure::Torques => Panel {
                limit: Some(Limit { value: self.robot.effort_limit_nm[joint], always: false }),
                ..simple("τ", "N·m", Signal::Torque, 1.0)
            },
            Figure::Voltages => Panel {
                limit: Some(Limit { value: self.robot.supply_v, always: true }),
                ..simple("v", "V", Signal::Torque, self.robot.voltage_v(1.0))
            },
            Figure::Positions => {
                let (of, minus) = (self.column(Signal::Position, joint), self.column(Signal::Error, joint));
                let quantity = Quantity::Difference { of, minus, factor: DEGREES };
                let run = self.runs.iter().position(|run| !run.recording.is_empty());
                Panel {
                    reference: run.map(|run| Reference::Curve { run, quantity }),
                    ..simple("q", "°", Signal::Position, DEGREES)
                }
            }
            Figure::PhasePlane => {
                let x = self.scaled(Signal::Error, joint, DEGREES);
                let y = self.scaled(Signal::ErrorRate, joint, DEGREES);
                Panel { x_label: Some(format!("e{n} [°]")), ..self.panel(format!("ė{n} [°/s]"), Some(x), y) }
            }
            Figure::TorqueParts => self.torque_parts(joint),
            _ => simple("e", "°", Signal::Error, DEGREES),
        }
    }

    fn torque_parts(&self, joint: usize) -> Panel {
        let theme = self.view.style.theme;
        let total = self.scaled(Signal::Torque, joint, 1.0);
        let run = self.view.focus;
        let curve = |key, y, line| Curve { key, run, x: None, y, line };
        let mut curves = Vec::new();
        if run < self.runs.len() {
            curves.push(curve(Key::Total, total, total_line(theme)));
            let parts =
                (0..PARTS).map(|part| curve(Key::Part(part), Quantity::Part { joint, part }, part_line(part, theme)));
            curves.extend(parts);
        }
        Panel { label: format!("τ{} [N·m]", joint + 1), x_label: None, curves, reference: None, limit: None }
    }

    fn estimates(&self, first: usize, count: usize) -> Vec<Panel> {
        // Runs side by side are runs of one arm.
        let truth = self.runs.first().map_or(&[][..], |run| run.theta_true);
        let shown = self.robot.parameters.iter().enumerate().skip(first).take(count);
        let panel = |(component, parameter): (usize, &crate::robots::Parameter)| Panel {
            reference: truth.get(component).copied().map(Reference::Constant),
            ..self.panel(
                format!("{} [{}]", parameter.symbol, parameter.unit),
                None,
                self.scaled(Signal::ThetaHat, component, 1.0),
            )
        };
        shown.map(panel).collect()
    }

    fn traced(&self, panels: &[(&str, Traced)]) -> Vec<Panel> {
        panels.iter().map(|(label, curve)| self.panel((*label).to_owned(), None, Quantity::Traced(*curve))).collect()
    }

    fn parameter_error(&self) -> Vec<Panel> {
        let first = self.column(Signal::ThetaHat, 0);
        vec![self.panel("rms (θ̂−θ)/θ".to_owned(), None, Quantity::ParameterError { first })]
    }
}
