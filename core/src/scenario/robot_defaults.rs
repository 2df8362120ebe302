//! What each robot does where a scenario leaves gains and trajectory out.
//!
//! The A465's are the paper's. Gains that are one number are the same for every robot; lists have as many numbers as the robot
//! has joints or parameters. For the other two robots: the two-link arm's trajectory, its K and its Λ are those of Slotine and
//! Li's book (section 9.2); everything else is chosen, such that with each scheme the error from 10 s on is within half a
//! degree and below a quarter of what it was, and steps of 1 ms and 2 ms give the same run, which tests check.

use super::document::{TrajectoryDocument, TrajectoryKind};
use super::gains::{
    ComputedTorqueGains, GainSet, PdGains, PdGravityGains, ProposedGains, SlotineLiGains, TangArteagaGains,
};
use crate::robots::{RobotData, RobotKind};
use std::f64::consts::TAU;

/// Gains with a default for every robot.
pub(super) trait RobotGains: GainSet + Default {
    /// The robot's own.
    fn of(robot: &RobotData) -> Self;

    /// What a document gives, with the robot's own in the place of what it leaves out.
    fn given<'a>(gains: &'a mut Option<Self>, robot: &RobotData) -> &'a mut Self {
        let gains = gains.get_or_insert_with(Self::left_out);
        gains.fill(Self::of(robot));
        gains
    }
}

/// Adaptation gains of the two-link arm.
const TWO_LINK_ADAPTATION: [f64; 11] = [1.0, 0.5, 0.5, 0.5, 4.0, 4.0, 1.0, 1.0, 40.0, 20.0, 20.0];
/// Adaptation gains of the pendulum.
const PENDULUM_ADAPTATION: [f64; 4] = [0.2, 0.2, 0.2, 10.0];

impl RobotGains for SlotineLiGains {
    fn of(robot: &RobotData) -> Self {
        match robot.kind {
            RobotKind::CrsA465 => Self::default(),
            RobotKind::TwoLink => {
                Self { k_s: vec![100.0; 2], lambda: vec![20.0; 2], gamma_adapt: TWO_LINK_ADAPTATION.to_vec() }
            }
            RobotKind::Pendulum => {
                Self { k_s: vec![5.0], lambda: vec![10.0], gamma_adapt: PENDULUM_ADAPTATION.to_vec() }
            }
        }
    }
}

impl RobotGains for TangArteagaGains {
    fn of(robot: &RobotData) -> Self {
        let paper = Self::default();
        match robot.kind {
            RobotKind::CrsA465 => paper,
            RobotKind::TwoLink => {
                Self { k_s: vec![100.0; 2], lambda: vec![20.0; 2], gamma_adapt: TWO_LINK_ADAPTATION.to_vec(), ..paper }
            }
            RobotKind::Pendulum => {
                Self { k_s: vec![5.0], lambda: vec![10.0], gamma_adapt: PENDULUM_ADAPTATION.to_vec(), ..paper }
            }
        }
    }
}

/// `K_p` and `K_d` of a PD: K Λ and K of the robot's Slotine and Li, the linear part of it.
fn linear_part(robot: &RobotData) -> (Vec<f64>, Vec<f64>) {
    let SlotineLiGains { k_s, lambda, .. } = SlotineLiGains::of(robot);
    (k_s.iter().zip(&lambda).map(|(k, lambda)| k * lambda).collect(), k_s)
}

impl RobotGains for PdGains {
    fn of(robot: &RobotData) -> Self {
        let (k_p, k_d) = linear_part(robot);
        Self { k_p, k_d }
    }
}

impl RobotGains for PdGravityGains {
    fn of(robot: &RobotData) -> Self {
        let (k_p, k_d) = linear_part(robot);
        Self { k_p, k_d, ..Self::default() }
    }
}

impl RobotGains for ComputedTorqueGains {
    fn of(robot: &RobotData) -> Self {
        let paper = Self::default();
        let joints = robot.joint_count();
        Self { k_p: vec![paper.k_p[0]; joints], k_d: vec![paper.k_d[0]; joints], ..paper }
    }
}

impl RobotGains for ProposedGains {
    fn of(robot: &RobotData) -> Self {
        let paper = Self::default();
        match robot.kind {
            RobotKind::CrsA465 => paper,
            RobotKind::TwoLink => Self {
                k_v: vec![100.0; 2],
                lambda: vec![20.0; 2],
                lambda_z: vec![100.0; 2],
                lambda_x: vec![20.0; 2],
                k_d: vec![200.0; 2],
                gamma_adapt: TWO_LINK_ADAPTATION.to_vec(),
                ..paper
            },
            RobotKind::Pendulum => Self {
                k_v: vec![5.0],
                lambda: vec![10.0],
                lambda_z: vec![100.0],
                lambda_x: vec![10.0],
                k_d: vec![200.0],
                gamma_adapt: PENDULUM_ADAPTATION.to_vec(),
                ..paper
            },
        }
    }
}

/// The robot's own trajectory: for the A465 the paper's, for the two-link arm the book's `q_d1 = 30° (1 − cos 2πt)`,
/// `q_d2 = 45° (1 − cos 2πt)`, for the pendulum `60° sin t + 30° sin 3t`.
pub(super) fn trajectory(robot: &RobotData) -> TrajectoryDocument {
    let series = |frequency_rad_s, offset_deg, sine_deg, cosine_deg| TrajectoryDocument {
        kind: TrajectoryKind::Fourier,
        frequency_rad_s: Some(frequency_rad_s),
        offset_deg: Some(offset_deg),
        sine_deg: Some(sine_deg),
        cosine_deg: Some(cosine_deg),
        ..TrajectoryDocument::default()
    };
    match robot.kind {
        RobotKind::CrsA465 => TrajectoryDocument::default(),
        RobotKind::TwoLink => series(TAU, vec![30.0, 45.0], vec![], vec![vec![-30.0], vec![-45.0]]),
        RobotKind::Pendulum => series(1.0, vec![0.0], vec![vec![60.0, 0.0, 30.0]], vec![]),
    }
}
