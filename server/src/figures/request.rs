//! One figure of one run, over HTTP: which figure a name means, and the answer to a request for it.
//!
//! A handler calls [`FigureRequest::new`] on the name, asks [`FigureRequest::not_modified`] before it loads anything, and
//! hands the recording to [`FigureRequest::respond`].

use super::{FigureError, figure_svg, png};
use crate::document::brief;
use crate::download::{Disposition, Download};
use crate::error::Problem;
use adaptarm_core::decomposition::TorqueParts;
use adaptarm_core::diagnostics::Trace;
use adaptarm_core::figures::{Figure, PlottedRun};
use adaptarm_core::recording::Recording;
use adaptarm_core::robots::{RobotData, robot};
use adaptarm_core::scenario::{OutcomeKind, Report, Scenario, Scheme};
use axum::body::Bytes;
use axum::http::{HeaderMap, StatusCode};
use axum::response::Response;
use std::sync::Arc;
use thiserror::Error;
use tokio::task::spawn_blocking;

/// How a picture is stored.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PictureFormat {
    /// Lines and letters.
    Svg,
    /// Pixels.
    Png,
}

impl PictureFormat {
    /// Every format.
    pub const ALL: [Self; 2] = [Self::Svg, Self::Png];

    /// Ending of file names.
    pub const fn id(self) -> &'static str {
        match self {
            Self::Svg => "svg",
            Self::Png => "png",
        }
    }

    /// Media type.
    pub const fn media_type(self) -> &'static str {
        match self {
            Self::Svg => "image/svg+xml",
            Self::Png => "image/png",
        }
    }
}

/// Why there is no such figure of a run.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum NoFigure {
    /// No figure is called that.
    #[error("there is no figure {name:?}; of this run there are: {allowed}")]
    Unknown {
        /// What was asked for.
        name: String,
        /// Files that there are.
        allowed: String,
    },
    /// The report is of a robot or scheme that this version does not know.
    #[error("the report names {what} {name:?}, which this version cannot draw")]
    UnknownRun {
        /// Robot or scheme.
        what: &'static str,
        /// Its name.
        name: String,
    },
}

impl From<NoFigure> for Problem {
    fn from(error: NoFigure) -> Self {
        let problem = Self::status(StatusCode::NOT_FOUND, error.to_string());
        match error {
            NoFigure::Unknown { allowed, .. } => problem.with("allowed", allowed),
            NoFigure::UnknownRun { .. } => problem,
        }
    }
}

/// File names of the figures that show something of this scheme, the paper's first.
pub fn file_names(scheme: Scheme) -> impl Iterator<Item = String> {
    let shown = Figure::ALL.into_iter().filter(move |figure| figure.shows(scheme));
    shown.flat_map(|figure| PictureFormat::ALL.map(|format| file_name(figure, format)))
}

fn file_name(figure: Figure, format: PictureFormat) -> String {
    format!("{}.{}", figure.id(), format.id())
}

/// What some figures show beside the samples.
#[derive(Default)]
struct Derived {
    parts: Option<TorqueParts>,
    trace: Option<Trace>,
}

/// A request for a figure of one run.
#[derive(Debug, Clone)]
pub struct FigureRequest {
    figure: Figure,
    format: PictureFormat,
    scheme: Scheme,
    robot: &'static RobotData,
    download: Download,
}

impl FigureRequest {
    /// The figure in the file called `name`, such as `tracking_errors.svg`, of the run with this report.
    pub fn new(name: &str, report: &Report) -> Result<Self, NoFigure> {
        let unknown = |what, name: &str| NoFigure::UnknownRun { what, name: brief(name) };
        let robot = robot(&report.robot).ok_or_else(|| unknown("robot", &report.robot))?;
        let scheme = Scheme::ALL.into_iter().chain(Scheme::YARDSTICKS).find(|scheme| scheme.id() == report.scheme);
        let scheme = scheme.ok_or_else(|| unknown("scheme", &report.scheme))?;
        let files = Figure::ALL.into_iter().flat_map(|figure| PictureFormat::ALL.map(|format| (figure, format)));
        let mut files = files.filter(|(figure, format)| figure.shows(scheme) && file_name(*figure, *format) == name);
        let (figure, format) = files.next().ok_or_else(|| NoFigure::Unknown {
            name: brief(name),
            allowed: file_names(scheme).collect::<Vec<_>>().join(", "),
        })?;
        // Equal trajectories of different arms differ in the true parameters that are drawn.
        let content = [name, report.scenario_hash.as_str(), report.trajectory_hash.as_str()];
        let saved_as = format!("{}-{name}", scheme.id());
        let download = Download::new(format.media_type(), Disposition::Inline, &saved_as, &content);
        Ok(Self { figure, format, scheme, robot, download })
    }

    /// 304 if the client has this figure already; known from the report alone.
    pub fn not_modified(&self, request: &HeaderMap) -> Option<Response> {
        self.download.not_modified(request)
    }

    /// The picture's bytes; `document` is the run's scenario as JSON. Takes a processor a millisecond as SVG and a tenth of a
    /// second as PNG; the curves of the diagnostics take another tenth.
    pub fn draw(&self, report: &Report, document: &str, recording: &Recording) -> Result<Vec<u8>, FigureError> {
        let Derived { parts, trace } = self.derived(document, recording)?;
        let completed = report.outcome == OutcomeKind::Completed;
        let run = PlottedRun {
            parts: parts.as_ref(),
            trace: trace.as_ref(),
            ..PlottedRun::new(self.scheme, recording, completed, &report.theta_true)
        };
        let svg = figure_svg(self.figure, self.robot, &[run])?;
        match self.format {
            PictureFormat::Svg => Ok(svg.into_bytes()),
            PictureFormat::Png => png(&svg),
        }
    }

    /// The torques, split, and the curves of the diagnostics, for the figures that show them.
    fn derived(&self, document: &str, recording: &Recording) -> Result<Derived, FigureError> {
        let (wants_parts, wants_trace) = (self.figure == Figure::TorqueParts, self.figure.shows_diagnostics());
        if !(wants_parts || wants_trace) {
            return Ok(Derived::default());
        }
        let scenario = Scenario::read(&mut serde_json::Deserializer::from_str(document))
            .map_err(|error| FigureError::Scenario(error.to_string()))?;
        Ok(Derived {
            parts: wants_parts.then(|| scenario.torque_parts(recording)),
            trace: wants_trace.then(|| scenario.diagnose(recording).1),
        })
    }

    /// The picture, drawn beside the async threads.
    pub async fn respond(
        self,
        report: Report,
        document: String,
        recording: Arc<Recording>,
        request: &HeaderMap,
    ) -> Result<Response, Problem> {
        let drawn = spawn_blocking(move || {
            let picture = self.draw(&report, &document, &recording);
            picture.map(|picture| (self.download, Bytes::from(picture)))
        });
        let (download, picture) = drawn.await.map_err(|error| failed(&error))?.map_err(|error| failed(&error))?;
        Ok(download.bytes(request, picture))
    }
}

fn failed(error: &dyn std::error::Error) -> Problem {
    tracing::error!("a figure could not be drawn: {error}");
    Problem::status(StatusCode::INTERNAL_SERVER_ERROR, "the figure could not be drawn; the log says why")
}

#[cfg(test)]
mod tests {
    use super::*;
    use adaptarm_core::scenario::Run;
    use axum::http::header;
    use http_body_util::BodyExt;

    /// A short run and its scenario's document.
    fn run(scheme: Scheme) -> (Run, String) {
        let mut document = scheme.paper();
        (document.integration.duration_s, document.recording.samples) = (0.05, 25);
        let scenario = Scenario::new(document).unwrap();
        (scenario.run(), serde_json::to_string(scenario.document()).unwrap())
    }

    #[test]
    fn every_figure_of_every_scheme_can_be_drawn() {
        for scheme in Scheme::ALL {
            let (Run { report, recording }, document) = run(scheme);
            for name in file_names(scheme).filter(|name| name.ends_with("svg")) {
                let picture = FigureRequest::new(&name, &report).unwrap().draw(&report, &document, &recording).unwrap();
                assert!(picture.starts_with(b"<svg "), "{name}");
            }
            // All of them pass through the same painter, which is slow unless it is optimised.
            let picture =
                FigureRequest::new("torques.png", &report).unwrap().draw(&report, &document, &recording).unwrap();
            assert!(picture.starts_with(b"\x89PNG\r\n\x1a\n"));
        }
    }

    #[test]
    fn a_run_that_ended_at_once_has_figures_too() {
        let (Run { report, recording }, document) = run(Scheme::Proposed);
        let empty = Recording::with_capacity(recording.columns(), 0);
        let report = Report { outcome: OutcomeKind::Diverged, ..report };
        for name in file_names(Scheme::Proposed).filter(|name| name.ends_with("svg")) {
            FigureRequest::new(&name, &report).unwrap().draw(&report, &document, &empty).unwrap();
        }
    }

    #[test]
    fn an_unknown_name_is_answered_with_those_there_are() {
        let report = run(Scheme::SlotineLi).0.report;
        // Only the proposed scheme has an observer.
        for name in ["", "torques", "torques.pdf", "torques.svg.png", "../torques.svg", "observer_errors.svg"] {
            let problem = Problem::from(FigureRequest::new(name, &report).unwrap_err());
            let allowed = "tracking_errors.svg, tracking_errors.png, velocity_errors.svg, velocity_errors.png, \
                           estimates_1.svg, estimates_1.png, estimates_2.svg, estimates_2.png, estimates_3.svg, \
                           estimates_3.png, torques.svg, torques.png, positions.svg, positions.png, voltages.svg, \
                           voltages.png, sliding_variables.svg, sliding_variables.png, phase_plane.svg, \
                           phase_plane.png, parameter_error_norm.svg, parameter_error_norm.png, estimates.svg, \
                           estimates.png, torque_parts.svg, torque_parts.png, excitation.svg, excitation.png, lyapunov.svg, lyapunov.png, \
                           parameter_error_parts.svg, parameter_error_parts.png, energy.svg, energy.png";
            assert_eq!(problem.status, 404);
            assert_eq!(problem.detail, format!("there is no figure {name:?}; of this run there are: {allowed}"));
        }
        let foreign = Report { robot: "puma".to_owned(), ..report };
        let error = FigureRequest::new("torques.svg", &foreign).unwrap_err().to_string();
        assert_eq!(error, "the report names robot \"puma\", which this version cannot draw");
    }

    #[test]
    fn a_scenario_that_cannot_be_read_is_missed_only_where_it_is_needed() {
        let (Run { report, recording }, _) = run(Scheme::Proposed);
        let draw = |name| FigureRequest::new(name, &report).unwrap().draw(&report, "{}", &recording);
        assert!(draw("torques.svg").is_ok());
        assert!(matches!(draw("torque_parts.svg"), Err(FigureError::Scenario(_))));
    }

    #[tokio::test]
    async fn the_answer_is_the_picture_and_need_not_be_sent_again() {
        let (Run { report, recording }, document) = run(Scheme::Proposed);
        let request = FigureRequest::new("torques.svg", &report).unwrap();
        let picture = request.draw(&report, &document, &recording).unwrap();
        let answer = request.clone().respond(report, document, Arc::new(recording), &HeaderMap::new()).await.unwrap();
        assert_eq!(answer.headers()[header::CONTENT_TYPE], "image/svg+xml");
        assert_eq!(answer.headers()[header::CONTENT_DISPOSITION], "inline; filename=\"proposed-torques.svg\"");
        let again = HeaderMap::from_iter([(header::IF_NONE_MATCH, answer.headers()[header::ETAG].clone())]);
        assert_eq!(request.not_modified(&again).unwrap().status(), StatusCode::NOT_MODIFIED);
        assert_eq!(answer.into_body().collect().await.unwrap().to_bytes(), picture);
    }
}
