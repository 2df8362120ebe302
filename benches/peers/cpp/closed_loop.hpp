// The paper's three closed loops (docs/physics.md, section 2) as systems for Boost.odeint, one type per scheme.
//
// State: q, dq, [observer: q_hat, xi], theta_hat, [composite laws: filter X (3x18), tau_f, w, Z (18x18, in full)].
#pragma once

#include "a465.hpp"

enum class Scheme { SlotineLi, TangArteaga, Proposed };

struct Desired {
    Vec3 q, dq, ddq;
};

/// Paper eq. (24): sums of three sines per joint, about [0, 90, -90] degrees.
inline Desired desired_motion(double t) {
    constexpr double deg = M_PI / 180;
    static const Vec3 offset = Vec3(0, 90, -90) * deg;
    static const Eigen::Matrix3d amplitude =
        (Eigen::Matrix3d() << 5, 5, 2.5, 15, 3, 2.5, 10, 2, 3).finished() * deg;
    const double s1 = std::sin(t), c1 = std::cos(t);
    const double s2 = 2 * s1 * c1, c2 = c1 * c1 - s1 * s1;
    const double s3 = s2 * c1 + c2 * s1, c3 = c2 * c1 - s2 * s1;
    return {offset + amplitude * Vec3(s1, s2, s3), amplitude * Vec3(c1, 2 * c2, 3 * c3),
            amplitude * Vec3(-s1, -4 * s2, -9 * s3)};
}

/// Section 4.2 of the paper; Lambda_x and Kd are chosen there where the paper omits them.
struct Gains {
    Vec3 feedback, lambda;
    Parameters adaptation;
    double memory_weight = 0, memory_gain = 0, forgetting = 0, bandwidth = 0;
    Vec3 lambda_z = Vec3::Zero(), k_d = Vec3::Zero();

    explicit Gains(Scheme scheme) {
        switch (scheme) {
        case Scheme::SlotineLi:
            feedback << 95, 115, 110;
            lambda << 10, 6.5, 8;
            adaptation << 21e-6, 17e-6, 85e-7, 0.0011, 0.001, 0.0012, 0.0017, 4.3, 0.7, 3.0, 47.0, 5.5, 42.0, 0.21, 0.69,
                0.845, 40.0, 22.5;
            break;
        case Scheme::TangArteaga:
            feedback << 60, 15, 40;
            lambda << 190, 230, 220;
            memory_weight = 0.1, memory_gain = 0.05, forgetting = 20, bandwidth = 15;
            adaptation << 0.017, 0.017, 0.01, 0.017, 0.07, 0.002, 0.01, 0.08, 0.3, 0.17, 2.8, 0.12, 30.83, 0.0001, 0.09,
                0.35, 12.75, 1.02;
            break;
        case Scheme::Proposed:
            feedback << 40, 80, 75;
            lambda << 60, 80, 70;
            lambda_z << 100, 50, 110;
            k_d << 150, 270, 300;
            memory_weight = 5.5, memory_gain = 0.1, forgetting = 125, bandwidth = 70;
            adaptation << 21e-6, 17e-6, 85e-7, 0.0011, 0.001, 0.0012, 0.0017, 2.5, 0.7, 0.9, 47.0, 4.9, 25.0, 0.21, 0.089,
                1.45, 50.0, 5.5;
            break;
        }
    }
};

/// fb = rho delta |drive|: zero inside [0, 10 theta_o], full strength beyond a margin of 1e-4 below and 0.1 theta_o above.
inline Parameters projection(const Parameters& theta, const Parameters& theta_hat, const Parameters& drive) {
    static const Parameters upper = 10 * theta, inverse_margin = (0.1 * theta).cwiseInverse();
    const auto above = ((theta_hat - upper).cwiseProduct(inverse_margin)).array().max(0.0).min(1.0);
    const auto below = (theta_hat * -1e4).array().max(0.0).min(1.0);
    return (2.5 * (above - below) * drive.array().abs()).matrix();
}

template <Scheme scheme>
class ClosedLoop {
    static constexpr bool observes = scheme == Scheme::Proposed, remembers = scheme != Scheme::SlotineLi;
    // Where the parts of the state begin.
    static constexpr int DQ = 3, Q_HAT = 6, XI = 9, THETA_HAT = observes ? 12 : 6, FILTER = THETA_HAT + 18,
                         TAU_F = FILTER + 54, W = TAU_F + 3, Z = W + 18, END = remembers ? Z + 18 * 18 : FILTER;
    // Padded to a multiple of eight numbers, so that the stepper's sums need no remainders.
    static constexpr int SIZE = (END + 7) / 8 * 8;
    using Matrix18 = Eigen::Matrix<double, 18, 18>;

    Gains gains{scheme};
    Parameters theta = true_parameters();
    double remembered_time = 0;
    Desired remembered = desired_motion(0);

    /// Two stages of a step share their instant, and so do a step's end and the next one's start.
    const Desired& desired(double t) {
        if (t != remembered_time) {
            remembered = desired_motion(t);
            remembered_time = t;
        }
        return remembered;
    }

public:
    using State = Eigen::Matrix<double, SIZE, 1>;

    /// On the trajectory at its velocity; estimates, Yf, tau_f, w and Z zero.
    State initial_state() {
        const Desired& d = desired(0);
        State x = State::Zero();
        x.template head<3>() = d.q;
        x.template segment<3>(DQ) = d.dq;
        if constexpr (observes) x.template segment<3>(Q_HAT) = d.q;
        if constexpr (remembers)
            Eigen::Map<Regressor>(x.data() + FILTER) = -gains.bandwidth * momentum_regressor(Geometry(d.q), d.dq);
        return x;
    }

    void operator()(const State& x, State& rate, double t) {
        rate.template tail<SIZE - END>().setZero();
        const Desired& d = desired(t);
        const Vec3 q = x.template head<3>(), dq = x.template segment<3>(DQ);
        const Parameters theta_hat = x.template segment<18>(THETA_HAT);
        const Geometry geometry(q);
        const Vec3 error = q - d.q;

        // Velocity: measured, or the observer's v = zeta + Kd z with zeta = dqd - Lambda_x e + Kd Lambda_z xi.
        Vec3 velocity = dq;
        if constexpr (observes) {
            const Vec3 z = q - x.template segment<3>(Q_HAT);
            const Vec3 zeta = d.dq - gains.lambda.cwiseProduct(error)
                              + gains.k_d.cwiseProduct(gains.lambda_z).cwiseProduct(x.template segment<3>(XI));
            velocity = zeta + gains.k_d.cwiseProduct(z);
            rate.template segment<3>(Q_HAT) = velocity + gains.lambda_z.cwiseProduct(z);
            rate.template segment<3>(XI) = z;
        }

        // Feedback: tau = -K s + Y theta_hat.
        const Vec3 vr = d.dq - gains.lambda.cwiseProduct(error);
        const Vec3 ar = d.ddq - gains.lambda.cwiseProduct(velocity - d.dq);
        const Vec3 s = velocity - vr;
        const Regressor y = regressor(geometry, observes ? vr : velocity, vr, ar, friction_sign(vr));
        const Vec3 tau = y * theta_hat - gains.feedback.cwiseProduct(s);

        // Plant.
        const Vec3 sign_dq = friction_sign(dq);
        rate.template head<3>() = dq;
        rate.template segment<3>(DQ) = acceleration(geometry, theta, dq, sign_dq, tau);

        // Adaptation.
        const Parameters gradient = y.transpose() * s;
        auto theta_hat_rate = rate.template segment<18>(THETA_HAT);
        if constexpr (!remembers) {
            theta_hat_rate = -gains.adaptation.cwiseProduct(gradient);
        } else {
            // Yf = lf P + X, X' = lf (B - Yf): momentum and balance share one filter state per entry.
            const Regressor momentum = momentum_regressor(geometry, velocity);
            const Regressor balance =
                balance_regressor(geometry, velocity, observes ? friction_sign(velocity) : sign_dq);
            const Eigen::Map<const Regressor> filter(x.data() + FILTER);
            const Regressor yf = gains.bandwidth * momentum + filter;
            Eigen::Map<Regressor>(rate.data() + FILTER) = gains.bandwidth * (balance - yf);
            const Vec3 tau_f = x.template segment<3>(TAU_F);
            rate.template segment<3>(TAU_F) = gains.bandwidth * (tau - tau_f);

            const Parameters w = x.template segment<18>(W);
            if constexpr (observes) {
                const Parameters drive = gains.memory_weight * w + gradient;
                theta_hat_rate = -gains.adaptation.cwiseProduct(drive + projection(theta, theta_hat, drive));
            } else {
                theta_hat_rate = -gains.memory_weight * w - gains.adaptation.cwiseProduct(gradient);
            }

            // Memory: Z' = -l Z + g Yf^T Yf, w' = -l w + g Yf^T eps + Z theta_hat', eps = Yf theta_hat - tau_f.
            const Eigen::Map<const Matrix18> z(x.data() + Z);
            Eigen::Map<Matrix18> z_rate(rate.data() + Z);
            const Regressor weighed = gains.memory_gain * yf;
            z_rate = weighed.transpose().lazyProduct(yf) - gains.forgetting * z;
            const Vec3 epsilon = yf * theta_hat - tau_f;
            auto w_rate = rate.template segment<18>(W);
            w_rate = gains.memory_gain * (yf.transpose() * epsilon) - gains.forgetting * w;
            w_rate.noalias() += z * theta_hat_rate;
        }
    }

    static auto theta_hat(const State& x) { return x.template segment<18>(THETA_HAT); }
};
