//! What acts on the arm beside its actuators: a payload at the flange, a disturbance torque, friction with Stribeck's effect.
//!
//! A payload of mass m changes the arm's parameters by m times a vector that its geometry gives, exactly, because the
//! dynamics are linear in them (`robots/payload.rs`).

use crate::scalar::Scalar;
use nalgebra::SVector;

/// Instants are met up to this, s: they are written in decimal, steps are counted in binary.
const INSTANT_S: f64 = 1e-9;

/// A mass at the flange for a while.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Payload {
    /// Mass, kg.
    pub mass_kg: f64,
    /// Picked up at, s.
    pub from_s: f64,
    /// Dropped at, s.
    pub to_s: f64,
}

/// `d = c + a sin ω t`, N·m per joint, for a while.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Disturbance<const N: usize> {
    /// c, N·m.
    pub constant: SVector<f64, N>,
    /// a, N·m.
    pub sine: SVector<f64, N>,
    /// ω, rad/s.
    pub frequency_rad_s: f64,
    /// Begins at, s.
    pub from_s: f64,
    /// Ends at, s.
    pub to_s: f64,
}

/// Friction that exceeds Coulomb's near rest: `F_x sgn(v) / (1 + (v/v_s)²)`, N·m, beside the model's `F_c sgn(v)`.
/// Source: Hess and Soom (1990); the usual exponential has the same shape.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stribeck<const N: usize> {
    /// F_x: static friction's excess over Coulomb's, N·m.
    pub excess: SVector<f64, N>,
    /// v_s, rad/s.
    pub velocity_rad_s: f64,
}

impl<const N: usize> Stribeck<N> {
    /// Friction torque, N·m, that resists `velocity`; `sign` is its sign as regularised.
    #[inline(always)]
    pub fn torque(&self, velocity: &SVector<f64, N>, sign: &SVector<f64, N>) -> SVector<f64, N> {
        let mut torque = SVector::zeros();
        for i in 0..N {
            let relative = velocity[i] / self.velocity_rad_s;
            torque[i] = self.excess[i] * sign[i] / (1.0 + relative * relative);
        }
        torque
    }
}

/// Everything that acts on the arm beside its actuators.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Load<const N: usize, const P: usize> {
    /// Payloads, in any order; those that overlap add up.
    pub payloads: Vec<Payload>,
    /// How the parameters change per kilogram at the flange.
    pub parameters_per_kg: Option<SVector<f64, P>>,
    /// A disturbance.
    pub disturbance: Option<Disturbance<N>>,
    /// More friction.
    pub stribeck: Option<Stribeck<N>>,
}

impl<const N: usize, const P: usize> Load<N, P> {
    /// Mass at the flange during a step that starts at `time_s`, kg.
    pub fn mass_kg(&self, time_s: f64) -> f64 {
        let mut mass = 0.0;
        for payload in &self.payloads {
            if is_within(time_s, payload.from_s, payload.to_s) {
                mass += payload.mass_kg;
            }
        }
        mass
    }

    /// Whether the disturbance acts during a step that starts at `time_s`.
    pub fn is_disturbed(&self, time_s: f64) -> bool {
        self.disturbance.is_some_and(|disturbance| is_within(time_s, disturbance.from_s, disturbance.to_s))
    }

    /// The arm's parameters with `mass_kg` at the flange.
    #[inline(always)]
    pub fn theta(&self, arm: &SVector<f64, P>, mass_kg: f64) -> SVector<f64, P> {
        match &self.parameters_per_kg {
            Some(per_kg) if mass_kg != 0.0 => arm + per_kg * mass_kg,
            _ => *arm,
        }
    }

    /// Torque at the joints at `time_s` for what the actuators give, N·m; `disturbed` as [`Self::is_disturbed`] said when the
    /// step began.
    #[inline(always)]
    pub fn torque(
        &self,
        time_s: f64,
        disturbed: bool,
        actuators: &SVector<f64, N>,
        velocity: &SVector<f64, N>,
        sign: &SVector<f64, N>,
    ) -> SVector<f64, N> {
        let mut torque = *actuators;
        if let Some(disturbance) = self.disturbance.as_ref().filter(|_| disturbed) {
            let (sin, _) = Scalar::sin_cos(disturbance.frequency_rad_s * time_s);
            torque += disturbance.constant + disturbance.sine * sin;
        }
        if let Some(stribeck) = &self.stribeck {
            torque -= stribeck.torque(velocity, sign);
        }
        torque
    }
}

fn is_within(time_s: f64, from_s: f64, to_s: f64) -> bool {
    from_s - INSTANT_S <= time_s && time_s < to_s - INSTANT_S
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn payloads_come_and_go_on_the_steps_they_name() {
        let payload = |mass_kg, from_s, to_s| Payload { mass_kg, from_s, to_s };
        let load = Load::<1, 1> { payloads: vec![payload(2.0, 0.3, 0.6), payload(1.0, 0.5, 9.0)], ..Load::default() };
        let mass: Vec<_> = (0..8).map(|n| load.mass_kg(f64::from(n) * 0.1)).collect();
        assert_eq!(mass, [0.0, 0.0, 0.0, 2.0, 2.0, 3.0, 1.0, 1.0]);
    }

    #[test]
    fn stribecks_excess_is_whole_at_rest_half_at_its_velocity_and_gone_beyond() {
        let friction = Stribeck { excess: SVector::from([4.0, 4.0, 4.0]), velocity_rad_s: 0.1 };
        let torque = friction.torque(&SVector::from([1e-12, -0.1, 10.0]), &SVector::from([1.0, -1.0, 1.0]));
        assert!((torque - SVector::from([4.0, -2.0, 4.0 / 10_001.0])).amax() < 1e-9);
    }
}
