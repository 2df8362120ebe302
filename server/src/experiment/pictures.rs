//! Figures of experiments as files: which there are and their bytes, for a folder and over HTTP.

use super::Found;
use crate::figures::{FigureError, PictureFormat, png};
use adaptarm_core::experiments::Experiment;
use adaptarm_core::figures::{ExperimentFigure, Shown, experiment_svg};

/// A figure of an experiment in a format.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Picture {
    /// The figure.
    pub figure: ExperimentFigure,
    /// Its format.
    pub format: PictureFormat,
}

impl Picture {
    /// Those that an experiment has.
    pub fn of(experiment: &Experiment) -> impl Iterator<Item = Self> {
        let figures = ExperimentFigure::ALL.into_iter().filter(|figure| figure.shows(experiment));
        figures.flat_map(|figure| PictureFormat::ALL.map(|format| Self { figure, format }))
    }

    /// Its file's name.
    pub fn name(self) -> String {
        format!("{}.{}", self.figure.id(), self.format.id())
    }

    /// Its bytes, of this metric where it shows one. Takes a processor milliseconds as SVG and a tenth of a second as PNG.
    pub fn bytes(self, experiment: &Experiment, found: &Found, metric: Option<&str>) -> Result<Vec<u8>, FigureError> {
        let svg = match found {
            Found::Rows(results, summary) => {
                experiment_svg(self.figure, experiment, Shown::Rows(results, summary), metric)?
            }
            Found::Search(tuning) => {
                experiment_svg(self.figure, experiment, Shown::Search(&tuning.summary(experiment)), metric)?
            }
        };
        match self.format {
            PictureFormat::Svg => Ok(svg.into_bytes()),
            PictureFormat::Png => png(&svg),
        }
    }
}
