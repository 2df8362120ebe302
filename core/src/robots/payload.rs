//! What a mass held at the flange does to a robot's parameters.

use super::RobotData;

/// How each parameter changes per kilogram at the flange; `None` for a robot that nobody worked it out for.
///
/// CRS A465: a point at `r = l2 c2 + l3 c23` from the axis and `l2 s2 + l3 s23` above the shoulder, with l2 the upper arm and l3
/// from elbow to flange, adds `½ ((r q̇1)² + ...)` per kilogram to the kinetic energy. That is the model's own terms
/// (docs/physics.md section 1): θ1, θ2, θ10 grow by l3², θ4 by l2², θ5 by l2 l3, θ9 by l2² + l3², θ17 by g l2, θ18 by g l3.
/// Units: those of the parameters, per kg.
pub fn payload_parameters(robot: &RobotData) -> Option<Vec<f64>> {
    const GRAVITY: f64 = 9.81;
    match (robot.id, robot.link_lengths_m) {
        ("crs_a465", [_, upper, forearm, wrist]) => {
            let l3 = forearm + wrist;
            let mut change = vec![0.0; robot.parameter_count()];
            for (parameter, value) in [
                (1, l3 * l3),
                (2, l3 * l3),
                (4, upper * upper),
                (5, upper * l3),
                (9, upper * upper + l3 * l3),
                (10, l3 * l3),
                (17, GRAVITY * upper),
                (18, GRAVITY * l3),
            ] {
                change[parameter - 1] = value;
            }
            Some(change)
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robots::{CrsA465, Robot};
    use nalgebra::{Matrix3, SVector, Vector3};

    /// `H = Jᵀ J` per kilogram and `g = ∂(9.81 z)/∂q`, by differences of where the flange is.
    #[test]
    fn a_mass_at_the_flange_is_a_mass_at_the_flange() {
        let change = SVector::<f64, 18>::from_vec(payload_parameters(CrsA465::DATA).unwrap());
        let [_, l2, forearm, wrist] = CrsA465::DATA.link_lengths_m;
        let point = |q: Vector3<f64>| {
            let (r, z) = (
                l2 * q[1].cos() + (forearm + wrist) * (q[1] + q[2]).cos(),
                l2 * q[1].sin() + (forearm + wrist) * (q[1] + q[2]).sin(),
            );
            Vector3::new(r * q[0].cos(), r * q[0].sin(), z)
        };
        for q in [Vector3::new(0.3, 1.2, -0.8), Vector3::new(-2.0, 0.4, 1.9)] {
            let mut jacobian = Matrix3::zeros();
            for i in 0..3 {
                let mut step = Vector3::zeros();
                step[i] = 1e-6;
                jacobian.set_column(i, &((point(q + step) - point(q - step)) / 2e-6));
            }
            let zero = Vector3::zeros();
            let (inertia, gravity) = CrsA465::inertia_and_bias(&CrsA465::geometry(&q), &change, &zero, &zero);
            assert!((inertia - jacobian.transpose() * jacobian).amax() < 1e-8);
            assert!((gravity - jacobian.row(2).transpose() * 9.81).amax() < 1e-8);
        }
    }
}
