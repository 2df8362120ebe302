"""Builds the study's closed loops in CasADi's symbols and generates C: `generate.py FOLDER` writes `FOLDER/generated.c`.

Per scheme one function `SCHEME(x, desired) -> dx/dt`. Z is its upper triangle and the regressors' zeros are structural, so
what is generated is straight-line code over live entries only. Equations: docs/physics.md, sections 1 and 2. Also writes each
scheme's initial state, `FOLDER/initial.h`, which the driver starts from. (A whole RK4 step as one function was tried
and took half as long again: 2.7 instead of 1.8 microseconds for the proposed scheme.)
"""

import sys
from pathlib import Path

import casadi as ca
import numpy as np

THETA = np.array([0.0055, 0.008, 0.0024, 0.0118, 0.0041, 9e-4, 7e-4, 2.0007, 11.80, 2.80,
                  25.0, 35.0, 36.0, 0.20, 2.50, 2.50, 22.0, 11.0])

# Section 4.2 of the paper; Lambda_x and Kd are chosen there where the paper omits them.
GAINS = {
    "slotine_li": dict(
        feedback=[95, 115, 110], lambda_e=[10, 6.5, 8],
        adaptation=[21e-6, 17e-6, 85e-7, 0.0011, 0.001, 0.0012, 0.0017, 4.3, 0.7, 3.0, 47.0, 5.5, 42.0, 0.21, 0.69, 0.845,
                    40.0, 22.5]),
    "tang_arteaga": dict(
        feedback=[60, 15, 40], lambda_e=[190, 230, 220],
        memory_weight=0.1, memory_gain=0.05, forgetting=20, bandwidth=15,
        adaptation=[0.017, 0.017, 0.01, 0.017, 0.07, 0.002, 0.01, 0.08, 0.3, 0.17, 2.8, 0.12, 30.83, 0.0001, 0.09, 0.35,
                    12.75, 1.02]),
    "proposed": dict(
        feedback=[40, 80, 75], lambda_e=[60, 80, 70], lambda_z=[100, 50, 110], k_d=[150, 270, 300],
        memory_weight=5.5, memory_gain=0.1, forgetting=125, bandwidth=70,
        adaptation=[21e-6, 17e-6, 85e-7, 0.0011, 0.001, 0.0012, 0.0017, 2.5, 0.7, 0.9, 47.0, 4.9, 25.0, 0.21, 0.089, 1.45,
                    50.0, 5.5]),
}


def start():
    """Position and velocity of the desired motion at t = 0; paper eq. (24)."""
    return ca.DM(np.radians([0, 90, -90])), ca.DM(np.radians([5 + 2 * 5 + 3 * 2.5, 15 + 2 * 3 + 3 * 2.5, 10 + 2 * 2 + 3 * 3]))


class Arm:
    """What depends on q alone, and the regressors over it: section 1's table, parameter by parameter."""

    def __init__(self, q):
        s2, c2, s3, c3 = ca.sin(q[1]), ca.cos(q[1]), ca.sin(q[2]), ca.cos(q[2])
        c23, s23 = c2 * c3 - s2 * s3, s2 * c3 + c2 * s3
        c_double = c23 * c23 - s23 * s23
        self.c2, self.c23 = c2, c23
        # h, alpha, beta, h22, h23, h33, gamma
        self.table = [
            (c23 * c23, -s23 * c23, -s23 * c23, 0, 0, 0, 0),
            (0, 0, 0, 0, 1, 0, 0),
            (2 * s2 * c2, c2 * c2 - s2 * s2, 0, 0, 0, 0, 0),
            (c2 * c2, -s2 * c2, 0, 0, 0, 0, 0),
            (2 * c2 * c23, -(s2 * c23 + c2 * s23), -c2 * s23, 2 * c3, c3, 0, -s3),
            (2 * s23 * c23, c_double, c_double, 0, 0, 0, 0),
            (2 * c2 * s23, c2 * c23 - s2 * s23, c2 * c23, 2 * s3, s3, 0, c3),
            (1, 0, 0, 0, 0, 0, 0),
            (0, 0, 0, 1, 0, 0, 0),
            (0, 0, 0, 0, 0, 1, 0),
        ]

    def friction_and_gravity(self, v, sign_v):
        gravity = ca.vertcat(ca.horzcat(0, 0), ca.horzcat(self.c2, self.c23), ca.horzcat(0, self.c23))
        return ca.horzcat(ca.diag(v), ca.diag(sign_v), gravity)

    def regressor(self, u, v, a, sign_v):
        """Y theta = H a + C(q, u) v + D v + Fc sign(v) + g."""
        columns = [ca.vertcat(
            h * a[0] + (alpha * u[1] + beta * u[2]) * v[0] + u[0] * (alpha * v[1] + beta * v[2]),
            h22 * a[1] + h23 * a[2] - alpha * (u[0] * v[0]) + gamma * (u[2] * v[1] + (u[1] + u[2]) * v[2]),
            h23 * a[1] + h33 * a[2] - beta * (u[0] * v[0]) - gamma * (u[1] * v[1]),
        ) for h, alpha, beta, h22, h23, h33, gamma in self.table]
        return ca.horzcat(*columns, self.friction_and_gravity(v, sign_v))

    def momentum(self, v):
        """P theta = H v."""
        columns = [ca.vertcat(h * v[0], h22 * v[1] + h23 * v[2], h23 * v[1] + h33 * v[2])
                   for h, _, _, h22, h23, h33, _ in self.table]
        return ca.horzcat(*columns, ca.SX(3, 8))

    def balance(self, v, sign_v):
        """B theta = -dT/dq + D v + Fc sign(v) + g."""
        columns = [ca.vertcat(0, -alpha * (v[0] * v[0]), -beta * (v[0] * v[0]) - gamma * (v[1] * v[1] + v[1] * v[2]))
                   for _, alpha, beta, _, _, _, gamma in self.table]
        return ca.horzcat(*columns, self.friction_and_gravity(v, sign_v))

    def acceleration(self, v, sign_v, tau):
        """Forward dynamics; joint 1 is decoupled."""
        h11, alpha, beta, h22, h23, h33, gamma = (
            sum(row[k] * theta for row, theta in zip(self.table, THETA)) for k in range(7))
        coriolis = ca.vertcat(2 * v[0] * (alpha * v[1] + beta * v[2]),
                              -alpha * v[0] * v[0] + gamma * v[2] * (2 * v[1] + v[2]),
                              -beta * v[0] * v[0] - gamma * v[1] * v[1])
        rest = tau - coriolis - self.friction_and_gravity(v, sign_v) @ THETA[10:]
        inverse = 1 / (h22 * h33 - h23 * h23)
        return ca.vertcat(rest[0] / h11, (h33 * rest[1] - h23 * rest[2]) * inverse,
                          (h22 * rest[2] - h23 * rest[1]) * inverse)


def friction_sign(v):
    return ca.tanh(v * 100)


def projection(theta_hat, drive):
    """fb: zero inside [0, 10 theta_o], full strength beyond a margin of 1e-4 below and of 0.1 theta_o above."""
    share = lambda depth: ca.fmin(ca.fmax(depth, 0), 1)
    above, below = share((theta_hat - 10 * THETA) * (1 / (0.1 * THETA))), share(theta_hat * -1e4)
    return 2.5 * (above - below) * ca.fabs(drive)


class Parts:
    """A state vector taken apart from the front."""

    def __init__(self, x):
        self.x, self.at = x, 0

    def take(self, count):
        part = self.x[self.at:self.at + count]
        self.at += count
        return part


def live_entries():
    """Entries of the regressor that are not zero everywhere: what is worth a filter state."""
    any_q, *any_motion = (ca.SX.sym(name, 3) for name in ("q", "u", "v", "a", "sign_v"))
    y = Arm(any_q).regressor(*any_motion)
    return [(i, j) for j in range(18) for i in range(3) if not y[i, j].is_zero()]


LIVE = live_entries()
# Pairs of columns that share a live row: where Yf^T Yf, and with it Z, is not zero everywhere.
PAIRS = [(i, j) for i in range(18) for j in range(i, 18) if any({(row, i), (row, j)} <= set(LIVE) for row in range(3))]


def rate(scheme, x, motion):
    """dx/dt at the state `x`, for the desired motion."""
    gains = GAINS[scheme]
    lam, feedback, adaptation = (ca.DM(gains[name]) for name in ("lambda_e", "feedback", "adaptation"))
    qd, dqd, ddqd = motion
    parts = Parts(x)
    q, dq = parts.take(3), parts.take(3)
    arm, e = Arm(q), q - qd
    vr = dqd - lam * e
    v, observer = dq, []
    if scheme == "proposed":
        q_hat, xi = parts.take(3), parts.take(3)
        lambda_z, k_d = ca.DM(gains["lambda_z"]), ca.DM(gains["k_d"])
        z = q - q_hat
        v = vr + k_d * lambda_z * xi + k_d * z
        observer = [v + lambda_z * z, z]
    theta_hat = parts.take(18)

    s = v - vr
    y = arm.regressor(vr if scheme == "proposed" else v, vr, ddqd - lam * (v - dqd), friction_sign(vr))
    tau = y @ theta_hat - feedback * s
    sign_dq = friction_sign(dq)
    motion_rate = [dq, arm.acceleration(dq, sign_dq, tau)]
    gradient = y.T @ s
    if scheme == "slotine_li":
        return ca.vertcat(*motion_rate, -adaptation * gradient)

    bandwidth, gain, forgetting = gains["bandwidth"], gains["memory_gain"], gains["forgetting"]
    filters, tau_f, w, packed = parts.take(len(LIVE)), parts.take(3), parts.take(18), parts.take(len(PAIRS))
    p, b = arm.momentum(v), arm.balance(v, friction_sign(v) if scheme == "proposed" else sign_dq)
    yf = ca.SX(3, 18)
    for n, entry in enumerate(LIVE):
        yf[entry] = bandwidth * p[entry] + filters[n]
    filters_rate = ca.vertcat(*(bandwidth * (b[entry] - yf[entry]) for entry in LIVE))

    if scheme == "proposed":
        drive = gains["memory_weight"] * w + gradient
        theta_hat_rate = -adaptation * (drive + projection(theta_hat, drive))
    else:
        theta_hat_rate = -gains["memory_weight"] * w - adaptation * gradient
    z_full = ca.SX(18, 18)
    for n, (i, j) in enumerate(PAIRS):
        z_full[i, j] = z_full[j, i] = packed[n]
    outer = (gain * yf).T @ yf
    packed_rate = ca.vertcat(*(outer[i, j] - forgetting * packed[n] for n, (i, j) in enumerate(PAIRS)))
    w_rate = gain * (yf.T @ (yf @ theta_hat - tau_f)) - forgetting * w + z_full @ theta_hat_rate
    return ca.vertcat(*motion_rate, *observer, theta_hat_rate, filters_rate, bandwidth * (tau - tau_f), w_rate, packed_rate)


def initial_state(scheme):
    """On the trajectory at its velocity; estimates, Yf, tau_f, w and Z zero."""
    q, dq = start()
    observer = [q, ca.DM.zeros(3)] if scheme == "proposed" else []
    parts = [q, dq, *observer, ca.DM.zeros(18)]
    if scheme != "slotine_li":
        momentum = ca.evalf(Arm(ca.SX(q)).momentum(ca.SX(dq)))
        parts += [ca.vertcat(*(-GAINS[scheme]["bandwidth"] * momentum[entry] for entry in LIVE)),
                  ca.DM.zeros(3 + 18 + len(PAIRS))]
    return ca.densify(ca.vertcat(*parts))


def right_hand_side(scheme):
    """The function to generate; the desired motion comes as position, velocity, acceleration."""
    x, motion = ca.SX.sym("x", initial_state(scheme).numel()), ca.SX.sym("desired", 9)
    return ca.Function(scheme, [x, motion], [ca.cse(ca.densify(rate(scheme, x, ca.vertsplit(motion, 3))))])


def main():
    generator = ca.CodeGenerator("generated.c", {"with_header": False})
    for scheme in GAINS:
        generator.add(right_hand_side(scheme))
    folder = Path(sys.argv[1])
    generator.generate(f"{folder}/")
    with open(folder / "initial.h", "w") as out:
        out.write(f'#define CASADI_VERSION "{ca.__version__}"\n')
        for scheme in GAINS:
            numbers = ", ".join(repr(float(x)) for x in initial_state(scheme).full().ravel())
            out.write(f"static const double initial_{scheme}[] = {{{numbers}}};\n")


main()
