"""Functions to solutions: the pendulum, the four-bar, the rolling disk, and SciPy's shapes."""

import json
import os
import subprocess

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.special import ellipk

import courant


def pendulum(t, y, yp):
    x, z, v, w, T = y
    return [yp[0] - v, yp[1] - w, yp[2] + T*x, yp[3] + T*z + 1, x*x + z*z - 1]


def test_the_cartesian_pendulum_in_five_lines():
    sol = courant.solve_dae(pendulum, (0, 20), [0.6, -0.8, 0.8, 0.6, 0], step=0.02)
    assert sol.success and sol.status == 0
    assert (sol.ladder.verdict, sol.ladder.index, sol.ladder.degrees_of_freedom) == ("regular", 2, 2)
    x, z, v, w, T = sol.y
    assert sol.t.shape == (1001,) and sol.y.shape == (5, 1001)
    assert abs(x**2 + z**2 - 1).max() < 1e-13 and abs(x*v + z*w).max() < 1e-13
    energy = (v**2 + w**2) / 2 + z
    assert abs(energy - energy[0]).max() < 1e-3
    # The multiplier is the tension: |v|² - z.
    assert T == pytest.approx(v**2 + w**2 - z, abs=1e-10)
    # The period of an angle of 2 arcsin(k), from SciPy: E = 0.5 - 0.8 = 2k² - 1.
    k2 = (energy[0] + 1) / 2
    period = 4 * ellipk(k2)
    turns = [t for t, a, b in zip(sol.t, v[:-1], v[1:]) if a > 0 >= b]
    assert np.diff(turns).mean() == pytest.approx(period, rel=0.02)


def test_a_start_that_is_not_consistent_is_made_so():
    sol = courant.solve_dae(pendulum, (0, 1), [0.6, -0.8, 1.0, 0.0, 0], step=0.02, hold=["y0", 1])
    x, z, v, w, _ = sol.y[:, 0]
    assert (x, z) == (0.6, -0.8)
    assert x*v + z*w == pytest.approx(0, abs=1e-14)
    assert {move["name"] for move in sol.ladder.moves} >= {"y2", "y3"}


def test_shapes_are_those_of_scipy():
    def F(t, y, yp):
        return [yp[0] - y[1], yp[1] + y[0]]

    def zero(t, y):
        return y[0]

    zero.direction = -1
    times = np.linspace(0, 5, 11)
    ours = courant.solve_dae(F, (0, 5), [1, 0], step=0.01, t_eval=times, events=zero, dense_output=True)
    theirs = solve_ivp(lambda t, y: [y[1], -y[0]], (0, 5), [1, 0], rtol=1e-10, atol=1e-12, t_eval=times, events=zero,
                       dense_output=True)
    assert ours.t.shape == theirs.t.shape and ours.y.shape == theirs.y.shape
    assert ours.y == pytest.approx(theirs.y, abs=1e-4)
    assert [a.shape for a in ours.t_events] == [a.shape for a in theirs.t_events]
    assert [a.shape for a in ours.y_events] == [a.shape for a in theirs.y_events]
    assert ours.t_events[0] == pytest.approx(theirs.t_events[0], abs=1e-4)
    assert ours.sol(1.234).shape == theirs.sol(1.234).shape
    assert ours.sol([0.5, 1.5]).shape == theirs.sol([0.5, 1.5]).shape
    assert ours.sol([0.5, 1.5]) == pytest.approx(theirs.sol([0.5, 1.5]), abs=1e-4)
    assert (ours.status, ours.success) == (theirs.status, theirs.success)


def test_a_terminal_event_ends_the_solution():
    def zero(t, y):
        return y[0]

    zero.terminal = True
    try:
        sol = courant.solve_dae(lambda t, y, yp: [yp[0] - y[1], yp[1] + y[0]], (0, 5), [1, 0], step=0.01, events=zero)
    except courant.ExperimentError as error:
        if "/events/event0/stop: unknown key" in str(error):
            pytest.skip("experiments have no events that end a run yet")
        raise
    assert sol.status == 1 and sol.success
    assert sol.t[-1] == pytest.approx(np.pi / 2, abs=1e-4)
    assert sol.y[0, -1] == pytest.approx(0, abs=1e-14)
    assert sol.y_events[0].shape == (1, 2)


def test_unknowns_and_parameters():
    def F(t, y, yp, z, g=9.81):
        x, h, v, w = y
        return [yp[0] - v, yp[1] - w, yp[2] + z[0]*x, yp[3] + z[0]*h + g, x*x + h*h - 1]

    sol = courant.solve_dae(F, (0, 1), [1, 0, 0, 0], unknowns=["tension"], step=0.01, parameters={"g": 1.0}, names="xhvw")
    assert sol.states == ["x", "h", "v", "w"]
    assert sol["tension"] == pytest.approx(sol["v"]**2 + sol["w"]**2 - sol["h"], abs=1e-10)


def test_a_tolerance_chooses_the_step():
    sol = courant.solve_dae(lambda t, y, yp: [yp[0] - y[1], yp[1] + y[0]], (0, 10), [1, 0], tolerance=1e-5)
    assert 0 < sol.error <= 1e-5
    assert abs(sol.y[0] - np.cos(sol.t)).max() < 5e-5


def test_a_hamiltonian_with_its_energy():
    sol = courant.solve_hamiltonian(lambda q, p: p @ p/2 - np.cos(q[0]), (0, 50), [2.0], [0.0], step=0.05)
    assert sol.y.shape == (2, 1001)
    assert abs(sol.energy - np.cos(2.0) * -1).max() < 2e-3
    assert sol["q"].shape == (1, 1001) and sol["p"].shape == (1, 1001)


def test_a_pendulum_on_the_sphere():
    q0, p0 = np.array([0.6, 0.0, -0.8]), np.array([0.0, 0.7, 0.0])
    sol = courant.solve_hamiltonian(lambda q, p: p @ p/2 + q[2], (0, 5), q0, p0, manifold="sphere", step=0.01)
    assert abs((sol["q"]**2).sum(0) - 1).max() < 1e-12
    # Its momentum about the vertical is kept.
    L = sol["q"][0]*sol["p"][1] - sol["q"][1]*sol["p"][0]
    assert abs(L - L[0]).max() < 1e-11


def test_a_free_rigid_body():
    I = np.array([1.0, 2.0, 3.0])
    sol = courant.solve_hamiltonian(lambda q, p: np.sum(p**2 / I)/2, (0, 5), np.eye(3), [0.3, 1.0, 0.2], manifold="so3",
                                    step=0.01)
    assert sol["q"].shape == (3, 3, 501) and sol["p"].shape == (3, 501)
    spatial = np.einsum("ijt,jt->it", sol["q"], sol["p"])
    assert abs(spatial - spatial[:, :1]).max() < 1e-10


# Bars of 1, 2, 1.5 between ground points at 0 and 2: absolute angles a, b, c.
def four_bar(q):
    a, b, c = q
    return [np.cos(a) + 2*np.cos(b) - 1.5*np.cos(c) - 2, np.sin(a) + 2*np.sin(b) - 1.5*np.sin(c)]


def test_the_four_bar_in_ten_lines():
    L = lambda q, v: v @ v/2 - (np.sin(q[0]) + 2*np.sin(q[1]) + 1.5*np.sin(q[2]))
    start = [1.0, 0.5, 1.5]
    sol = courant.solve_lagrangian(L, (0, 5), start, [0.0, 0.0, 0.0], holonomic=four_bar, step=0.01)
    assert sol.ladder.verdict == "regular" and sol.ladder.degrees_of_freedom == 2
    assert np.abs(four_bar(sol["q"])).max() < 1e-12
    E = (sol["v"]**2).sum(0)/2 + np.sin(sol["q"][0]) + 2*np.sin(sol["q"][1]) + 1.5*np.sin(sol["q"][2])
    assert abs(E - E[0]).max() < 2e-3


def test_the_rolling_disk_in_ten_lines():
    # Upright: contact (x, y), heading s, turn r, radius 1; no slip.
    L = lambda q, v: (1.0*(v[0]**2 + v[1]**2) + 0.25*v[2]**2 + 0.5*v[3]**2)/2
    no_slip = lambda q, v: [v[0] - v[3]*np.cos(q[2]), v[1] - v[3]*np.sin(q[2])]
    sol = courant.solve_lagrangian(L, (0, 2*np.pi), [0, 0, 0, 0], [1, 0, 1, 1], nonholonomic=no_slip, step=2*np.pi/2000)
    x, y, s, r = sol["q"]
    assert sol.ladder.degrees_of_freedom == 6
    # Once around a circle of radius 1.
    assert s[-1] == pytest.approx(2*np.pi) and r[-1] == pytest.approx(2*np.pi)
    assert (x[-1], y[-1]) == pytest.approx((0, 0), abs=1e-5)
    assert x**2 + (y - 1)**2 == pytest.approx(np.ones_like(x), abs=1e-5)


def test_a_singular_lagrangian_is_gauge():
    sol = courant.solve_lagrangian(lambda q, v: (v[0] - q[1])**2/2, (0, 1), [0, 1], [1, 0], step=0.1)
    assert sol.ladder.verdict == "gauge"
    with pytest.raises(courant.ExperimentError, match="velocities had to move by 1"):
        courant.solve_lagrangian(lambda q, v: (v[0] - q[1])**2/2, (0, 1), [0, 0], [1, 0], step=0.1)


def test_forces_and_time():
    sol = courant.solve_lagrangian(lambda q, v: v @ v/2, (0, 1), [0.0], [0.0], forces=lambda t, q, v: [2*t], step=0.01)
    assert sol["q"][0, -1] == pytest.approx(1/3, abs=1e-4)


def test_a_structure_without_momenta():
    x0 = [0.3, 1.0, 0.2]
    sol = courant.solve_hamiltonian(lambda x: np.sum(x**2 / np.array([1.0, 2.0, 3.0]))/2, (0, 5), x0,
                                    structure={"type": "lie-poisson", "algebra": "so3"}, step=0.01)
    assert np.sum(sol.y**2, 0) == pytest.approx(np.full(501, np.dot(x0, x0)), abs=1e-6)


def test_a_solution_is_an_experiment_of_the_command(tmp_path):
    """The rows of `courant run` on the file that Python writes are those of Python, to the bit."""
    sol = courant.solve_dae(pendulum, (0, 2), [0.6, -0.8, 0.8, 0.6, 0], step=0.02, backend="interpreter")
    sol.experiment.save(tmp_path / "pendulum.json")
    subprocess.run([os.environ["COURANT_COMMAND"], "run", tmp_path / "pendulum.json", "-o", tmp_path / "run", "--quiet",
                    "--backend", "interpreter"], check=True)
    table = np.loadtxt(tmp_path / "run" / "trajectory.csv", delimiter=",", skiprows=1)
    assert (table == sol.rows).all()
    assert json.loads((tmp_path / "run" / "summary.json").read_text())["steps"] == 100


def test_sensible_errors():
    with pytest.raises(courant.ExperimentError, match="no derivative"):
        courant.solve_dae(lambda t, y, yp: [y[0] - 1], (0, 1), [1.0])
    with pytest.raises(TypeError, match=r"expected \(t, y, yp\)"):
        courant.solve_dae(lambda a, b: [b[0]], (0, 1), [1.0])
    with pytest.raises(ValueError, match="an end after the start"):
        courant.solve_dae(lambda t, y, yp: [yp[0]], (1, 0), [1.0])
    with pytest.raises(TypeError, match="expected a number"):
        courant.solve_hamiltonian(lambda q, p: p, (0, 1), [0.0, 1.0], [1.0, 1.0])
    with pytest.raises(courant.TraceError, match="test_solve.py, line"):
        courant.solve_dae(lambda t, y, yp: [yp[0] - (1 if y[0] > 0 else 2)], (0, 1), [1.0])
    with pytest.raises(ZeroDivisionError):
        courant.solve_dae(lambda t, y, yp: [yp[0] - 1 // 0], (0, 1), [1.0])


def test_what_the_numerics_cannot_do_is_a_status():
    # Falls onto q = 0, where the energy ends: it gets there at t = 4√2/3 = 1.886.
    sol = courant.solve_hamiltonian(lambda q, p: p[0]**2/2 + np.sqrt(q[0]), (0, 10), [1.0], [0.0], step=0.01)
    assert sol.status == -1 and not sol.success and sol.message
    assert 1.5 < sol.t[-1] < 1.9
