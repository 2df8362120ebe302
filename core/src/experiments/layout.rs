//! Where the runs of a sweep, a Monte Carlo study or a comparison are: points times conditions times bases.
//!
//! Every point follows from its number alone. Bases and conditions share the points, hence all random numbers: what differs
//! between them is not chance.

use super::distribution::Distribution;
use super::fields::Change;
use super::latin::LatinHypercube;
use super::sobol::Sobol;
use super::stream::{Purpose, Stream};

/// How points fill the cube of the fields.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Filling {
    /// Independent random numbers from the streams of a purpose.
    Random(Purpose),
    /// A Latin hypercube.
    Latin(LatinHypercube),
    /// Sobol's sequence.
    Sobol(Sobol),
}

/// Values of the fields, point by point.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Design {
    /// Every combination; the last axis changes fastest.
    Grid(Vec<Vec<f64>>),
    /// Quantiles of distributions.
    Cube(Filling, Vec<Distribution>),
}

/// A condition: changes with their values.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Condition {
    pub name: String,
    pub changes: Vec<(Change, f64)>,
}

/// All runs of an experiment that is laid out before it starts.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Layout {
    pub seed: u64,
    /// What varies from point to point.
    pub fields: Vec<Change>,
    pub design: Design,
    pub points: u64,
    /// At least one; the only one of a sweep changes nothing.
    pub conditions: Vec<Condition>,
    pub bases: usize,
    pub vary_seed: bool,
}

/// Which point, condition and base a run has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Place {
    /// Point or draw.
    pub point: u64,
    /// Condition.
    pub condition: usize,
    /// Base scenario.
    pub base: usize,
}

impl Design {
    /// Values of the fields at a point.
    pub fn values(&self, seed: u64, point: u64) -> Vec<f64> {
        let place = self.place(seed, point);
        place.into_iter().enumerate().map(|(field, share)| self.value(field, share)).collect()
    }

    /// Where a point is on each axis: the number of a grid's value, or a share in (0, 1) of a distribution.
    pub fn place(&self, seed: u64, point: u64) -> Vec<f64> {
        match self {
            Self::Grid(axes) => {
                let mut rest = point as usize;
                let mut place = vec![0.0; axes.len()];
                for (number, axis) in place.iter_mut().zip(axes).rev() {
                    *number = (rest % axis.len()) as f64;
                    rest /= axis.len();
                }
                place
            }
            Self::Cube(Filling::Random(purpose), distributions) => {
                let mut stream = Stream::new(seed, *purpose, point);
                distributions.iter().map(|_| stream.unit()).collect()
            }
            Self::Cube(Filling::Latin(latin), _) => latin.point(point as u32),
            Self::Cube(Filling::Sobol(sobol), _) => sobol.point(point),
        }
    }

    /// The value of a field at its place on that axis.
    pub fn value(&self, field: usize, place: f64) -> f64 {
        match self {
            Self::Grid(axes) => axes[field][place as usize],
            Self::Cube(_, distributions) => distributions[field].quantile(place),
        }
    }
}

impl Layout {
    /// Number of runs.
    pub fn runs(&self) -> u64 {
        self.points * (self.conditions.len() * self.bases) as u64
    }

    /// Where run `index` is. All runs of a point are neighbours.
    pub fn place(&self, index: u64) -> Place {
        let (bases, conditions) = (self.bases as u64, self.conditions.len() as u64);
        Place {
            point: index / (bases * conditions),
            condition: (index / bases % conditions) as usize,
            base: (index % bases) as usize,
        }
    }

    /// The run at a place.
    pub fn index(&self, place: Place) -> u64 {
        (place.point * self.conditions.len() as u64 + place.condition as u64) * self.bases as u64 + place.base as u64
    }

    /// Seed of the noise in the runs of a point, if each has its own.
    pub fn noise_seed(&self, point: u64) -> Option<u64> {
        self.vary_seed.then(|| Stream::new(self.seed, Purpose::Noise, point).seed())
    }
}
