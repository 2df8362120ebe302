//! Actuator: the torque that reaches a joint is the commanded one, cut at a limit.

use crate::scalar::Scalar;
use nalgebra::SVector;

/// Saturation: `τ_i = clamp(u_i, −limit_i, limit_i)`, N·m. The controller is not told: its filters see the command u.
#[derive(Debug, Clone, Copy)]
pub struct Actuator<T, const N: usize> {
    /// Limit per joint, N·m; a motor supply of V volt gives `V r Ka / Ra` (paper section 2.1).
    pub limit: SVector<T, N>,
}

impl<T: Scalar, const N: usize> Actuator<T, N> {
    /// Torque at the joints for a command, both N·m.
    #[inline(always)]
    pub fn torque(&self, command: &SVector<T, N>) -> SVector<T, N> {
        let mut torque = *command;
        for i in 0..N {
            let cut = T::select(self.limit[i].less_than(torque[i]), self.limit[i], torque[i]);
            torque[i] = T::select(cut.less_than(-self.limit[i]), -self.limit[i], cut);
        }
        torque
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cuts_at_the_limit_and_nowhere_else() {
        let actuator = Actuator { limit: SVector::from([2.0, 3.0, 0.5, 1.0]) };
        assert_eq!(actuator.torque(&SVector::from([5.0, -4.0, 0.5, -0.25])), SVector::from([2.0, -3.0, 0.5, -0.25]));
        assert!(actuator.torque(&SVector::from([f64::NAN; 4]))[0].is_nan(), "a broken command must not look sane");
    }
}
