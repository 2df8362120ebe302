//! Where a run's torque goes: into inertia, Coriolis and centripetal forces, gravity, viscous and dry friction.
//!
//! Along a recorded run the arm's own equations, paper eq. (1), split τ into five parts that sum to it. The velocity is
//! `q̇ = q̇_d + ė`, the acceleration follows from the forward dynamics. Sees the true arm, never the estimates.

use crate::dynamics::{Plant, solve_symmetric};
use crate::metrics::performance_index;
use crate::recording::{Recording, Signal};
use crate::robots::Robot;
use crate::trajectories::Trajectory;
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
        trajectory: &Trajectory<f64, N>,
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::FrictionSign;
    use crate::regressor::model_torque;
    use crate::robots::CrsA465;
    use crate::scenario::{Scenario, Scheme};
    use nalgebra::Vector3;
    use proptest::prelude::*;

    type Arm = CrsA465;

    fn vectors(limit: f64) -> impl Strategy<Value = Vector3<f64>> {
        prop::array::uniform3(-limit..limit).prop_map(Vector3::from)
    }

    proptest! {
        /// Each part is the equation's own term, told by the regressor instead; together they are the torque.
        #[test]
        fn parts_are_the_terms_of_the_equation_and_sum_to_the_torque(
            q in vectors(3.1), v in vectors(4.0), torque in vectors(300.0),
            scale in prop::collection::vec(0.8..1.2, 18), width in prop_oneof![Just(0.0), 0.001..0.1],
        ) {
            let theta = SVector::<f64, 18>::from_fn(|k, _| Arm::DATA.parameters[k].value * scale[k]);
            let plant = Plant::<Arm, f64, 3, 18>::new(theta, FrictionSign::from_width(width));
            let geometry = Arm::geometry(&q);
            let (zero, sign) = (Vector3::zeros(), plant.friction_sign.of(&v));
            let model = |u, v, a, sign| {
                model_torque::<Arm, f64, 3, 18>(&Arm::regressor(&geometry, u, v, a, sign), theta.as_slice())
            };
            let acceleration = plant.acceleration(&geometry, &v, &sign, &torque);
            let gravity = model(&zero, &zero, &zero, &zero);
            let viscous = model(&zero, &v, &zero, &zero) - gravity;
            let expected = [
                model(&zero, &zero, &acceleration, &zero) - gravity,
                model(&v, &v, &zero, &zero) - gravity - viscous,
                gravity,
                viscous,
                model(&zero, &zero, &zero, &sign) - gravity,
            ];
            let parts = split(&plant, &q, &v, &torque);
            let size = 1.0 + torque.amax() + v.amax() * 50.0;
            for (part, expected) in parts.iter().zip(expected) {
                prop_assert!((part - expected).amax() < 1e-11 * size, "{part} for {expected}");
            }
            let sum: Vector3<f64> = parts.iter().sum();
            prop_assert!((sum - torque).amax() < 1e-12 * size, "{sum} for {torque}");
        }
    }

    #[test]
    fn along_a_run_the_parts_sum_to_what_was_recorded() {
        for scheme in Scheme::ALL {
            let mut document = scheme.paper();
            (document.integration.duration_s, document.recording.samples) = (1.0, 100);
            let scenario = Scenario::new(document).unwrap();
            let recording = scenario.run().recording;
            let parts = scenario.torque_parts(&recording);
            assert_eq!(parts.len(), recording.len());
            for joint in 0..3 {
                for (sample, torque) in recording.signal(Signal::Torque, joint).enumerate() {
                    let sum: f64 = parts.at(sample, joint).iter().sum();
                    assert!((sum - torque).abs() < 1e-9 * torque.abs().max(1.0), "{sum} for {torque}");
                }
            }
            // The velocity that friction sees is the one by which the angle moves.
            let viscous = |sample| parts.at(sample, 0)[3] / CrsA465::DATA.parameters[10].value;
            let angles: Vec<_> = recording.signal(Signal::Position, 0).collect();
            let moved = (angles[51] - angles[49]) / 0.02;
            assert!((viscous(50) - moved).abs() < 1e-3 * moved.abs().max(0.1), "{} for {moved}", viscous(50));
            // At the waist nothing weighs.
            assert_eq!(parts.rms_nm(100)[0][2], 0.0);
            assert!(parts.rms_nm(100)[1][2] > 5.0);
        }
    }
}
