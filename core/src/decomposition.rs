//! Where a run's torque goes: into inertia, Coriolis and centripetal forces, gravity, viscous and dry friction.
//!
//! Along a recorded run the arm's own equations, paper eq. (1), split τ into five parts that sum to it. The velocity is
//! `q̇ = q̇_d + ė`, the acceleration follows from the forward dynamics. Sees the true arm, never the estimates.

use crate::dynamics::{Plant, solve_symmetric};
use crate::metrics::performance_index;
use crate::recording::{Recording, Signal};
use crate::robots::Robot;
use crate::trajectories::Fourier;
use nalgebra::SVector;

/// A part of a joint's torque.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum TorquePart {
    /// `H(q) q̈`, all joints' accelerations included.
    Inertia,
    /// `C(q, q̇) q̇`: Coriolis and centripetal.
    Coriolis,
    /// `g(q)`.
    Gravity,
    /// `D q̇`.
    ViscousFriction,
    /// `F_c sgn(q̇)`, with the sign as the plant regularises it.
    DryFriction,
}

/// Number of parts.
pub const PARTS: usize = TorquePart::ALL.len();

impl TorquePart {
    /// Every part, in the order of the equation.
    pub const ALL: [Self; 5] = [Self::Inertia, Self::Coriolis, Self::Gravity, Self::ViscousFriction, Self::DryFriction];

    /// Identifier.
    pub const fn id(self) -> &'static str {
        match self {
            Self::Inertia => "inertia",
            Self::Coriolis => "coriolis",
            Self::Gravity => "gravity",
            Self::ViscousFriction => "viscous_friction",
            Self::DryFriction => "dry_friction",
        }
    }

    /// Name for people.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Inertia => "inertia",
            Self::Coriolis => "Coriolis and centripetal",
            Self::Gravity => "gravity",
            Self::ViscousFriction => "viscous friction",
            Self::DryFriction => "dry friction",
        }
    }
}

/// A run's torques, split; N·m.
#[derive(Debug, Clone, PartialEq)]
pub struct TorqueParts {
    joints: usize,
    /// Sample by sample, joint by joint, in the order of [`TorquePart::ALL`].
    values: Vec<[f64; PARTS]>,
}

impl TorqueParts {
    /// The parts along a recording of `plant` following `trajectory`. `τ = Σ parts` per joint and sample, up to rounding.
    pub(crate) fn of<R: Robot<N, P>, const N: usize, const P: usize>(
        plant: &Plant<R, f64, N, P>,
        trajectory: &Fourier<f64, N>,
        recording: &Recording,
    ) -> Self {
        let columns = recording.columns();
        let mut values = Vec::with_capacity(recording.len() * N);
        for row in recording.rows().chunks_exact(columns.width()) {
            let signal = |signal| SVector::<f64, N>::from_column_slice(&row[columns.start(signal)..][..N]);
            let velocity = trajectory.at(row[0]).velocity + signal(Signal::ErrorRate);
            let parts = split(plant, &signal(Signal::Position), &velocity, &signal(Signal::Torque));
            values.extend((0..N).map(|joint| parts.map(|part| part[joint])));
        }
        Self { joints: N, values }
    }

    /// Samples.
    pub fn len(&self) -> usize {
        self.values.len() / self.joints
    }

    /// Whether there is no sample.
    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }

    /// Parts of one joint's torque at one sample, in the order of [`TorquePart::ALL`], N·m.
    pub fn at(&self, sample: usize, joint: usize) -> &[f64; PARTS] {
        &self.values[sample * self.joints + joint]
    }

    /// Root mean square of each part per joint over the first `samples` samples, N·m.
    pub fn rms_nm(&self, samples: usize) -> Vec<[f64; PARTS]> {
        let samples = samples.min(self.len());
        let rms = |joint, part: usize| performance_index((0..samples).map(|sample| self.at(sample, joint)[part]));
        (0..self.joints).map(|joint| std::array::from_fn(|part| rms(joint, part))).collect()
    }
}

/// Splits the torque at one state. Every part comes out of the inertia matrix and the bias `b(v, sgn) = C(q, v) v + D v +
/// F_c sgn + g`, whose Coriolis term is even in v and whose viscous term is odd. Source: paper eq. (1).
fn split<R: Robot<N, P>, const N: usize, const P: usize>(
    plant: &Plant<R, f64, N, P>,
    position: &SVector<f64, N>,
    velocity: &SVector<f64, N>,
    torque: &SVector<f64, N>,
) -> [SVector<f64, N>; PARTS] {
    let geometry = R::geometry(position);
    let still = SVector::zeros();
    let bias = |velocity: &SVector<f64, N>, sign: &SVector<f64, N>| {
        R::inertia_and_bias(&geometry, &plant.theta, velocity, sign).1
    };
    let (inertia, gravity) = R::inertia_and_bias(&geometry, &plant.theta, &still, &still);
    let (forward, backward) = (bias(velocity, &still), bias(&-velocity, &still));
    let viscous = (forward - backward) * 0.5;
    let coriolis = (forward + backward) * 0.5 - gravity;
    let dry = bias(&still, &plant.friction_sign.of(velocity)) - gravity;
    let acceleration = solve_symmetric(&inertia, torque - (gravity + coriolis + viscous + dry));
    [inertia * acceleration, coriolis, gravity, viscous, dry]
}
