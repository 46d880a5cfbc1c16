"""The rattleback of PyDy's examples (Kane and Levinson 1982): an ellipsoid that rolls on a plane and turns back."""

import time

import numpy as np

import courant

a, b, c, h, m, g = 0.2, 0.03, 0.02, 0.01, 1.0, 9.81
I = np.array([[2e-4, 2e-5, 0.0], [2e-5, 1.6e-3, 0.0], [0.0, 0.0, 1.7e-3]])


def rotation(q):
    """Heading, roll about the long axis, pitch: R = Rz Rx Ry, and its last two factors."""
    (sz, sx, sy), (cz, cx, cy) = np.sin(q[3:]), np.cos(q[3:])
    Rz = np.array([[cz, -sz, 0], [sz, cz, 0], [0, 0, 1]])
    Rx = np.array([[1, 0, 0], [0, cx, -sx], [0, sx, cx]])
    Ry = np.array([[cy, 0, sy], [0, 1, 0], [-sy, 0, cy]])
    return Rz, Rx, Ry


def angular_velocity(q, v):
    """In the body."""
    _, Rx, Ry = rotation(q)
    return Ry.T @ (Rx.T @ np.array([0, 0, v[3]]) + np.array([v[4], 0, 0])) + np.array([0, v[5], 0])


def contact(q):
    """From the centre of mass to the point of contact, in the body; the centre of mass is h below that of the ellipsoid."""
    Rz, Rx, Ry = rotation(q)
    n = Ry.T @ (Rx.T @ np.array([0, 0, 1]))
    squares = np.array([a * a, b * b, c * c])
    return -squares * n / np.sqrt(n @ (squares * n)) + np.array([0, 0, h])


def lagrangian(q, v):
    w = angular_velocity(q, v)
    return m * (v[:3] @ v[:3]) / 2 + w @ I @ w / 2 - m * g * q[2]


def no_slip(q, v):
    Rz, Rx, Ry = rotation(q)
    return v[:3] + Rz @ (Rx @ (Ry @ np.cross(angular_velocity(q, v), contact(q))))


def test_the_rattleback_turns_back():
    q = np.array([0, 0, 0, 0, np.deg2rad(0.5), np.deg2rad(0.5)])
    q[2] = -(rotation(q)[1] @ (rotation(q)[2] @ contact(q)))[2]
    rates = np.array([0, 0, 0, -5.0, 0, 0])
    rates[:3] = -no_slip(q, rates)
    begin = time.process_time()
    sol = courant.solve_lagrangian(lagrangian, (0, 20), q, rates, nonholonomic=no_slip, step=1e-3)
    print(f"rattleback: {time.process_time() - begin:.1f} s of the processor")
    assert sol.success, sol.message
    assert sol.ladder.verdict == "regular"
    # The height of the contact is kept to the order of the method, though only its velocity is a constraint.
    height = [x[2] + (rotation(x)[1] @ (rotation(x)[2] @ contact(x)))[2] for x in sol["q"].T[::100]]
    assert np.abs(height).max() < 1e-6
    assert abs(sol.energy - sol.energy[0]).max() < 1e-6
    spin = sol["v"][3]
    assert spin[0] == -5.0 and spin[-1] > 4.0
