//! Elastic joints: each motor drives its link through a spring with damping.
//!
//! Link `(H(q) − J) q̈ + C q̇ + D q̇ + F_c sgn(q̇) + g = k (θ_m − q) + b (θ̇_m − q̇)`, motor `J θ̈_m + k (θ_m − q) + b (θ̇_m − q̇) = τ`, both behind
//! the gear. Source: Spong (1987), with damping. J is the motor's share of the arm's inertia, so that stiff springs give the rigid arm of
//! the scenario: the distance to it is of order 1/k. Friction stays at the link (chosen).

use nalgebra::{SMatrix, SVector};

/// Which side of the spring encoders and velocity sensors sit on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EncoderSide {
    /// The motor's, as on most arms.
    Motor,
    /// The link's.
    Link,
}

/// Springs, dampers and motors of the joints.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Elasticity<const N: usize> {
    /// k, N·m/rad.
    pub stiffness: SVector<f64, N>,
    /// b, N·m·s/rad.
    pub damping: SVector<f64, N>,
    /// J behind the gear, kg·m².
    pub motor_inertia: SVector<f64, N>,
    /// What the controller sees.
    pub encoders: EncoderSide,
}

impl<const N: usize> Elasticity<N> {
    /// Torque through the springs onto the links, N·m, for angles (rad) and velocities (rad/s) of motors and links.
    #[inline(always)]
    pub fn torque(
        &self,
        [motor, motor_velocity]: [&SVector<f64, N>; 2],
        [link, link_velocity]: [&SVector<f64, N>; 2],
    ) -> SVector<f64, N> {
        self.stiffness.component_mul(&(motor - link)) + self.damping.component_mul(&(motor_velocity - link_velocity))
    }

    /// Acceleration of the motors, rad/s², between the actuators' torque and the springs', N·m.
    #[inline(always)]
    pub fn motor_acceleration(&self, actuators: &SVector<f64, N>, springs: &SVector<f64, N>) -> SVector<f64, N> {
        (actuators - springs).component_div(&self.motor_inertia)
    }

    /// `H − J`, kg·m².
    #[inline(always)]
    pub fn link_inertia(&self, inertia: SMatrix<f64, N, N>) -> SMatrix<f64, N, N> {
        inertia - SMatrix::from_diagonal(&self.motor_inertia)
    }
}
