"""Runs one scheme of the study as a student would, with NumPy and SciPy's DOP853, and prints how long it took:

    peer.py proposed|tang_arteaga|slotine_li REPETITIONS

Half a second of simulated time, or 500 steps of 1 ms of the others; the solver takes its own steps. Equations:
docs/physics.md, sections 1 and 2, written down as they stand, with full matrices.
"""

import json
import sys
import time

import numpy as np
import scipy
from scipy.integrate import solve_ivp

DURATION_S = 0.5
THETA = np.array([0.0055, 0.008, 0.0024, 0.0118, 0.0041, 9e-4, 7e-4, 2.0007, 11.80, 2.80,
                  25.0, 35.0, 36.0, 0.20, 2.50, 2.50, 22.0, 11.0])

# Section 4.2 of the paper; Lambda_x and Kd are chosen there where the paper omits them.
GAINS = {
    "slotine_li": dict(
        K=[95, 115, 110], L=[10, 6.5, 8],
        G=[21e-6, 17e-6, 85e-7, 0.0011, 0.001, 0.0012, 0.0017, 4.3, 0.7, 3.0, 47.0, 5.5, 42.0, 0.21, 0.69, 0.845, 40.0, 22.5]),
    "tang_arteaga": dict(
        K=[60, 15, 40], L=[190, 230, 220], beta=0.1, gamma=0.05, forgetting=20, bandwidth=15,
        G=[0.017, 0.017, 0.01, 0.017, 0.07, 0.002, 0.01, 0.08, 0.3, 0.17, 2.8, 0.12, 30.83, 0.0001, 0.09, 0.35, 12.75, 1.02]),
    "proposed": dict(
        K=[40, 80, 75], L=[60, 80, 70], Lz=[100, 50, 110], Kd=[150, 270, 300],
        beta=5.5, gamma=0.1, forgetting=125, bandwidth=70,
        G=[21e-6, 17e-6, 85e-7, 0.0011, 0.001, 0.0012, 0.0017, 2.5, 0.7, 0.9, 47.0, 4.9, 25.0, 0.21, 0.089, 1.45, 50.0, 5.5]),
}

OFFSET = np.radians([0, 90, -90])
AMPLITUDE = np.radians([[5, 5, 2.5], [15, 3, 2.5], [10, 2, 3]])
HARMONIC = np.array([1, 2, 3])


def desired(t):
    sine, cosine = np.sin(HARMONIC * t), np.cos(HARMONIC * t)
    return OFFSET + AMPLITUDE @ sine, AMPLITUDE @ (HARMONIC * cosine), -AMPLITUDE @ (HARMONIC**2 * sine)


def coefficients(q):
    """h, alpha, beta, h22, h23, h33, gamma: the columns of section 1's table, one row of ten each."""
    s2, c2, s3, c3 = np.sin(q[1]), np.cos(q[1]), np.sin(q[2]), np.cos(q[2])
    s23, c23 = np.sin(q[1] + q[2]), np.cos(q[1] + q[2])
    s223, c223, c2x = np.sin(2 * q[1] + q[2]), np.cos(2 * q[1] + q[2]), np.cos(2 * (q[1] + q[2]))
    return np.array([
        [c23**2, 0, np.sin(2 * q[1]), c2**2, 2 * c2 * c23, np.sin(2 * (q[1] + q[2])), 2 * c2 * s23, 1, 0, 0],
        [-s23 * c23, 0, np.cos(2 * q[1]), -s2 * c2, -s223, c2x, c223, 0, 0, 0],
        [-s23 * c23, 0, 0, 0, -c2 * s23, c2x, c2 * c23, 0, 0, 0],
        [0, 0, 0, 0, 2 * c3, 0, 2 * s3, 0, 1, 0],
        [0, 1, 0, 0, c3, 0, s3, 0, 0, 0],
        [0, 0, 0, 0, 0, 0, 0, 0, 0, 1],
        [0, 0, 0, 0, -s3, 0, c3, 0, 0, 0],
    ])


def with_friction_and_gravity(inertia_columns, q, v):
    c2, c23 = np.cos(q[1]), np.cos(q[1] + q[2])
    gravity = [[0, 0], [c2, c23], [0, c23]]
    return np.hstack([inertia_columns, np.diag(v), np.diag(np.tanh(v / 0.01)), gravity])


def regressor(table, q, u, v, a):
    """Y theta = H(q) a + C(q, u) v + D v + Fc sign(v) + g(q)."""
    h, alpha, beta, h22, h23, h33, gamma = table
    inertia_columns = np.array([
        h * a[0] + (alpha * u[1] + beta * u[2]) * v[0] + alpha * u[0] * v[1] + beta * u[0] * v[2],
        h22 * a[1] + h23 * a[2] - alpha * u[0] * v[0] + gamma * (u[2] * v[1] + (u[1] + u[2]) * v[2]),
        h23 * a[1] + h33 * a[2] - beta * u[0] * v[0] - gamma * u[1] * v[1],
    ])
    return with_friction_and_gravity(inertia_columns, q, v)


def momentum(table, v):
    """P theta = H(q) v."""
    h, _, _, h22, h23, h33, _ = table
    return np.hstack([[h * v[0], h22 * v[1] + h23 * v[2], h23 * v[1] + h33 * v[2]], np.zeros((3, 8))])


def balance(table, q, v):
    """B theta = -dT/dq + D v + Fc sign(v) + g(q)."""
    _, alpha, beta, _, _, _, gamma = table
    rows = [np.zeros(10), -alpha * v[0] ** 2, -beta * v[0] ** 2 - gamma * v[1] ** 2 - gamma * v[1] * v[2]]
    return with_friction_and_gravity(np.array(rows), q, v)


def inertia(table):
    h11, _, _, h22, h23, h33, _ = table @ THETA[:10]
    return np.array([[h11, 0, 0], [0, h22, h23], [0, h23, h33]])


class ClosedLoop:
    """State: q, dq, q_hat, xi, theta_hat, filter X (3x18), tau_f, w, Z (18x18); without what the scheme has not."""

    def __init__(self, scheme):
        gains = {name: np.asarray(value, dtype=float) for name, value in GAINS[scheme].items()}
        self.gains, self.observes, self.remembers = gains, scheme == "proposed", scheme != "slotine_li"
        shapes = [(3,), (3,)] + [(3,), (3,)] * self.observes + [(18,)]
        self.shapes = shapes + [(3, 18), (3,), (18,), (18, 18)] * self.remembers
        self.theta_hat_at = 12 if self.observes else 6

    def unpack(self, x):
        parts, at = [], 0
        for shape in self.shapes:
            size = int(np.prod(shape))
            parts.append(x[at:at + size].reshape(shape))
            at += size
        return parts

    def initial_state(self):
        q, dq, _ = desired(0.0)
        parts = [np.zeros(shape) for shape in self.shapes]
        parts[0], parts[1] = q, dq
        if self.observes:
            parts[2] = q
        if self.remembers:
            parts[-4] = -self.gains["bandwidth"] * momentum(coefficients(q), dq)
        return np.concatenate([part.ravel() for part in parts])

    def __call__(self, t, x):
        gains, parts = self.gains, self.unpack(x)
        qd, dqd, ddqd = desired(t)
        q, dq = parts[:2]
        table, e = coefficients(q), q - qd
        v, rates = dq, []
        if self.observes:
            z, xi = q - parts[2], parts[3]
            v = dqd - gains["L"] * e + gains["Kd"] * gains["Lz"] * xi + gains["Kd"] * z
            rates = [v + gains["Lz"] * z, z]
        theta_hat = parts[4 if self.observes else 2]

        vr, ar = dqd - gains["L"] * e, ddqd - gains["L"] * (v - dqd)
        s = v - vr
        y = regressor(table, q, vr if self.observes else v, vr, ar)
        tau = y @ theta_hat - gains["K"] * s
        ddq = np.linalg.solve(inertia(table), tau - regressor(table, q, dq, dq, np.zeros(3)) @ THETA)
        rates = [dq, ddq, *rates]
        if not self.remembers:
            return np.concatenate([*rates, -gains["G"] * (y.T @ s)])

        x_filter, tau_f, w, z_memory = parts[-4:]
        yf = gains["bandwidth"] * momentum(table, v) + x_filter
        x_rate = gains["bandwidth"] * (balance(table, q, v) - yf)
        if self.observes:
            drive = gains["beta"] * w + y.T @ s
            above, below = np.clip((theta_hat - 10 * THETA) / (0.1 * THETA), 0, 1), np.clip(-theta_hat / 1e-4, 0, 1)
            theta_hat_rate = -gains["G"] * (drive + 2.5 * (above - below) * np.abs(drive))
        else:
            theta_hat_rate = -gains["beta"] * w - gains["G"] * (y.T @ s)
        z_rate = gains["gamma"] * yf.T @ yf - gains["forgetting"] * z_memory
        w_rate = gains["gamma"] * yf.T @ (yf @ theta_hat - tau_f) - gains["forgetting"] * w + z_memory @ theta_hat_rate
        rates += [theta_hat_rate, x_rate.ravel(), gains["bandwidth"] * (tau - tau_f), w_rate, z_rate.ravel()]
        return np.concatenate(rates)


def main():
    scheme, repetitions = sys.argv[1], int(sys.argv[2])
    loop, times_s, seconds = ClosedLoop(scheme), np.arange(1, 26) * (DURATION_S / 25), []
    for _ in range(repetitions):
        start = time.perf_counter()
        solution = solve_ivp(loop, (0, DURATION_S), loop.initial_state(), method="DOP853", t_eval=times_s,
                             rtol=1e-8, atol=1e-10)
        seconds.append(time.perf_counter() - start)
    if not solution.success:
        sys.exit(solution.message)
    at = loop.theta_hat_at
    rows = [dict(t_s=t, q=x[:3].tolist(), dq=x[3:6].tolist(), e=(x[:3] - desired(t)[0]).tolist(),
                 theta_hat=x[at:at + 18].tolist()) for t, x in zip(times_s.tolist(), solution.y.T)]
    print(json.dumps(dict(scheme=scheme, steps=round(DURATION_S / 1e-3), seconds=seconds, rows=rows,
                          **{"with": f"SciPy {scipy.__version__}, NumPy {np.__version__}"})))


main()
