// CRS A465, first three joints: geometry, the regressors built from it, and the plant (docs/physics.md, section 1).
//
// Everything inertial is linear in seven coefficients per parameter theta1..theta10, the columns of that section's table;
// each is one row here, so that a regressor's row is a sum of a few rows of ten.
#pragma once

#include <Eigen/Dense>
#include <cmath>

using Vec3 = Eigen::Vector3d;
using Parameters = Eigen::Matrix<double, 18, 1>;
/// Rows contiguous: they are what is added up.
using Regressor = Eigen::Matrix<double, 3, 18, Eigen::RowMajor>;

/// Coefficients of theta1..theta10 at one configuration: alpha = dH11/dq2 / 2, beta = dH11/dq3 / 2, gamma = dH22/dq3 / 2.
struct Geometry {
    using Row = Eigen::Matrix<double, 1, 10>;
    Row h, alpha, beta, h22, h23, h33, gamma;
    double c2, c23;

    explicit Geometry(const Vec3& q) {
        const double s2 = std::sin(q[1]), s3 = std::sin(q[2]), c3 = std::cos(q[2]);
        c2 = std::cos(q[1]);
        c23 = c2 * c3 - s2 * s3;
        const double s23 = s2 * c3 + c2 * s3;
        const double sin_2q2_q3 = s2 * c23 + c2 * s23, cos_2q2_q3 = c2 * c23 - s2 * s23;
        const double cos_2q23 = c23 * c23 - s23 * s23;
        h << c23 * c23, 0, 2 * s2 * c2, c2 * c2, 2 * c2 * c23, 2 * s23 * c23, 2 * c2 * s23, 1, 0, 0;
        alpha << -s23 * c23, 0, c2 * c2 - s2 * s2, -s2 * c2, -sin_2q2_q3, cos_2q23, cos_2q2_q3, 0, 0, 0;
        beta << -s23 * c23, 0, 0, 0, -c2 * s23, cos_2q23, c2 * c23, 0, 0, 0;
        h22 << 0, 0, 0, 0, 2 * c3, 0, 2 * s3, 0, 1, 0;
        h23 << 0, 1, 0, 0, c3, 0, s3, 0, 0, 0;
        h33 << 0, 0, 0, 0, 0, 0, 0, 0, 0, 1;
        gamma << 0, 0, 0, 0, -s3, 0, c3, 0, 0, 0;
    }
};

/// Coulomb friction's sign, regularised: tanh(v / width), width 0.01 rad/s.
inline Vec3 friction_sign(const Vec3& v) {
    return {std::tanh(v[0] * 100.0), std::tanh(v[1] * 100.0), std::tanh(v[2] * 100.0)};
}

/// Viscous and Coulomb friction and gravity: the columns of theta11..theta18.
inline void set_friction_and_gravity(Regressor& y, const Geometry& g, const Vec3& v, const Vec3& sign_v) {
    auto columns = y.rightCols<8>();
    columns.setZero();
    for (int i = 0; i < 3; ++i) {
        columns(i, i) = v[i];
        columns(i, 3 + i) = sign_v[i];
    }
    columns(1, 6) = g.c2;
    columns(1, 7) = g.c23;
    columns(2, 7) = g.c23;
}

/// Y with Y theta = H(q) a + C(q, u) v + D v + Fc sign(v) + g(q).
inline Regressor regressor(const Geometry& g, const Vec3& u, const Vec3& v, const Vec3& a, const Vec3& sign_v) {
    Regressor y;
    y.row(0).head<10>() = g.h * a[0] + g.alpha * (u[1] * v[0] + u[0] * v[1]) + g.beta * (u[2] * v[0] + u[0] * v[2]);
    y.row(1).head<10>() = g.h22 * a[1] + g.h23 * a[2] - g.alpha * (u[0] * v[0])
                          + g.gamma * (u[2] * v[1] + (u[1] + u[2]) * v[2]);
    y.row(2).head<10>() = g.h23 * a[1] + g.h33 * a[2] - g.beta * (u[0] * v[0]) - g.gamma * (u[1] * v[1]);
    set_friction_and_gravity(y, g, v, sign_v);
    return y;
}

/// P with P theta = H(q) v, the momentum.
inline Regressor momentum_regressor(const Geometry& g, const Vec3& v) {
    Regressor p;
    p.row(0).head<10>() = g.h * v[0];
    p.row(1).head<10>() = g.h22 * v[1] + g.h23 * v[2];
    p.row(2).head<10>() = g.h23 * v[1] + g.h33 * v[2];
    p.rightCols<8>().setZero();
    return p;
}

/// B with B theta = -dT/dq + D v + Fc sign(v) + g(q), T the kinetic energy: what is left of the torque beside the
/// momentum's rate.
inline Regressor balance_regressor(const Geometry& g, const Vec3& v, const Vec3& sign_v) {
    Regressor b;
    b.row(0).head<10>().setZero();
    b.row(1).head<10>() = g.alpha * -(v[0] * v[0]);
    b.row(2).head<10>() = g.beta * -(v[0] * v[0]) - g.gamma * (v[1] * v[1] + v[1] * v[2]);
    set_friction_and_gravity(b, g, v, sign_v);
    return b;
}

/// The true parameters.
inline Parameters true_parameters() {
    return (Parameters() << 0.0055, 0.008, 0.0024, 0.0118, 0.0041, 9e-4, 7e-4, 2.0007, 11.80, 2.80, 25.0, 35.0, 36.0, 0.20,
            2.50, 2.50, 22.0, 11.0)
        .finished();
}

/// Forward dynamics: H(q)^-1 (tau - C(q, v) v - D v - Fc sign(v) - g(q)). Joint 1 is decoupled: H12 = H13 = 0.
inline Vec3 acceleration(const Geometry& g, const Parameters& theta, const Vec3& v, const Vec3& sign_v, const Vec3& tau) {
    const auto inertial = theta.head<10>();
    const double h11 = g.h.dot(inertial), alpha = g.alpha.dot(inertial), beta = g.beta.dot(inertial);
    const double h22 = g.h22.dot(inertial), h23 = g.h23.dot(inertial), h33 = g.h33.dot(inertial);
    const double gamma = g.gamma.dot(inertial);
    const double forearm = theta[17] * g.c23;
    const Vec3 coriolis_and_gravity{
        2 * v[0] * (alpha * v[1] + beta * v[2]),
        -alpha * v[0] * v[0] + gamma * v[2] * (2 * v[1] + v[2]) + theta[16] * g.c2 + forearm,
        -beta * v[0] * v[0] - gamma * v[1] * v[1] + forearm,
    };
    const Vec3 friction = theta.segment<3>(10).cwiseProduct(v) + theta.segment<3>(13).cwiseProduct(sign_v);
    const Vec3 rest = tau - coriolis_and_gravity - friction;
    const double inverse_determinant = 1 / (h22 * h33 - h23 * h23);
    return {
        rest[0] / h11,
        (h33 * rest[1] - h23 * rest[2]) * inverse_determinant,
        (h22 * rest[2] - h23 * rest[1]) * inverse_determinant,
    };
}
