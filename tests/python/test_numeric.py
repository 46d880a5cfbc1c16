"""Functions that are called with numbers in every step, against the same functions as formulas."""

import pickle

import numpy as np
import pytest

import courant


def kinetic(q, v):
    return v @ v/2


# Called with traced arrays it is formulas, as a numeric function numbers.
FORCES = {
    "of q": lambda q, v: -q,
    "of v": lambda q, v: -0.2*v,
    "of both, not linear": lambda q, v: -np.sin(q) - 0.1*v*np.abs(v),
}


def pair(solve, energy, start, forces, size, **options):
    hook = courant.numeric(forces, size)
    return (solve(energy, (0, 5), *start, forces=lambda q, v: hook(q, v), **options),
            solve(energy, (0, 5), *start, forces=forces, **options))


@pytest.mark.parametrize("name", FORCES)
@pytest.mark.parametrize("size", [1, 2])
def test_a_force_by_numbers_makes_the_steps_of_its_formulas(name, size):
    start = [1.0, 0.3][:size], [0.4, 1.0][:size]
    ours, theirs = pair(courant.solve_lagrangian, kinetic, start, FORCES[name], size, step=0.05)
    assert ours.success and theirs.success
    assert np.abs(ours.y - theirs.y).max() < 1e-12
    assert ours.ladder.degrees_of_freedom == theirs.ladder.degrees_of_freedom == 2*size
    ours, theirs = pair(courant.solve_hamiltonian, lambda q, p: p @ p/2, start, FORCES[name], size, step=0.05)
    assert np.abs(ours.y - theirs.y).max() < 1e-12


@pytest.mark.parametrize("options", [
    {"manifold": "sphere", "start": ([0.6, 0, -0.8], [0, 0.7, 0]), "size": 3},
    {"manifold": "so3", "start": (np.eye(3), [0.3, 0.7, 0.1]), "size": 3},
    {"holonomic": lambda q: [q @ q - 1], "start": ([0.6, -0.8], [0.8, 0.6]), "size": 2},
    {"nonholonomic": lambda q, v: [v[2] - q[1]*v[0]], "start": ([0.0, 0.5, 0.0], [1.0, 0.2, 0.5]), "size": 3},
])
def test_on_manifolds_and_with_constraints(options):
    options = dict(options)
    start, size = options.pop("start"), options.pop("size")
    ours, theirs = pair(courant.solve_lagrangian, kinetic, start, lambda q, v: -0.3*v, size, step=0.02, **options)
    assert ours.success and theirs.success, ours.message
    assert np.abs(ours.y - theirs.y).max() < 1e-11
    assert str(ours.ladder) == str(theirs.ladder)


def pendulum(drag):
    def F(t, y, yp):
        x, z, v, w, T = y
        a, b = drag(y[2:4])
        return [yp[0] - v, yp[1] - w, yp[2] + T*x - a, yp[3] + T*z + 1 - b, x*x + z*z - 1]

    return F


def test_in_equations_of_index_two():
    def drag(v):
        return -0.1*v*np.sqrt(v @ v)

    start = [0.6, -0.8, 0.8, 0.6, 0]
    ours = courant.solve_dae(pendulum(courant.numeric(drag, 2)), (0, 5), start, step=0.02)
    theirs = courant.solve_dae(pendulum(drag), (0, 5), start, step=0.02)
    assert ours.ladder.index == theirs.ladder.index == 2 and ours.ladder.degrees_of_freedom == 2
    assert np.abs(ours.y[:4] - theirs.y[:4]).max() < 1e-10
    assert courant.certificate(pendulum(courant.numeric(drag, 2)), start).index == 2


def test_a_table_gives_steps_of_order_two():
    # x'' = -x by a table so fine that its kinks are below the errors.
    points = np.linspace(-2, 2, 40001)
    table = courant.numeric(lambda q: np.interp(q, points, -points))
    errors = []
    for steps in (50, 100, 200, 400):
        sol = courant.solve_lagrangian(kinetic, (0, 5), [1.0], [0.0], forces=lambda q, v: [table(q[0])], step=5/steps)
        errors.append(abs(sol["q"][0, -1] - np.cos(5.0)))
    slope = np.polyfit(np.log([50, 100, 200, 400]), np.log(errors), 1)[0]
    assert slope == pytest.approx(-2, abs=0.1)


ONE_STAGE = ["discretize-first", "constrain-first", "rk2", {"type": "discretize-first", "discretization": {"type": "theta", "theta": 1.0}}]
SEVERAL_STAGES = [{"type": "discretize-first", "discretization": "verlet"}, {"type": "discretize-first", "order": 4},
                  {"type": "constrain-first", "order": 4}, "rk4", "dopri5", {"type": "discretize-first", "damping": "l-stable"}]


@pytest.mark.parametrize("method", ONE_STAGE, ids=str)
def test_methods_of_one_stage_keep_their_order(method):
    hook = courant.numeric(lambda q, v: -np.sin(q) - 0.1*v)
    options = {"forces": lambda q, v: [hook(q[0], v[0])], "method": method}
    exact = courant.solve_lagrangian(kinetic, (0, 4), [1.0], [0.3], forces=lambda q, v: -np.sin(q) - 0.1*v, step=1e-3, method="rk4")
    errors = [abs(courant.solve_lagrangian(kinetic, (0, 4), [1.0], [0.3], step=4/n, **options)["q"][0, -1] - exact["q"][0, -1])
              for n in (40, 80, 160, 320)]
    slope = -np.polyfit(np.log([40, 80, 160, 320]), np.log(errors), 1)[0]
    assert slope == pytest.approx(1 if isinstance(method, dict) else 2, abs=0.1)


@pytest.mark.parametrize("method", SEVERAL_STAGES, ids=str)
def test_methods_of_several_stages_are_refused(method):
    hook = courant.numeric(lambda q: -q)
    with pytest.raises(courant.ExperimentError, match="/method: makes steps of several stages"):
        courant.solve_lagrangian(kinetic, (0, 1), [1.0], [0.3], step=0.1, forces=lambda q, v: [hook(q[0])], method=method)


def test_functions_in_single_precision_settle():
    network = courant.numeric(lambda q: np.tanh(q.astype(np.float32)) * np.float32(-1.0), 2)
    sol = courant.solve_lagrangian(kinetic, (0, 5), [1.0, 0.3], [0.0, 0.0], forces=lambda q, v: network(q), step=0.05)
    exact = courant.solve_lagrangian(kinetic, (0, 5), [1.0, 0.3], [0.0, 0.0], forces=lambda q, v: -np.tanh(q), step=0.05)
    assert sol.success and np.abs(sol.y - exact.y).max() < 1e-5


def test_a_function_that_vanishes_but_for_rounding_settles():
    # At rest on a spring: weight less its force is 0 up to the rounding of the two, at a place that no double is.
    rest = 9.81/3
    spring = courant.numeric(lambda q: 9.81 - 3*q)
    for start in rest + np.arange(-5, 6)*1e-16:
        sol = courant.solve_lagrangian(kinetic, (0, 2), [start], [0.0], forces=lambda q, v: [spring(q[0])], step=0.1)
        assert sol.success and np.abs(sol["q"] - rest).max() < 1e-14


def test_a_slow_fixed_point_is_found_and_not_taken_early():
    # (h/2)² k = 0.7: each turn is wrong by 0.7 of what the turn before was.
    force, h = courant.numeric(lambda q: -280.0*q), 0.1
    sol = courant.solve_lagrangian(kinetic, (0, 2), [1.0], [0.0], forces=lambda q, v: [force(q[0])], step=h)
    exact = courant.solve_lagrangian(kinetic, (0, 2), [1.0], [0.0], forces=lambda q, v: -280.0*q, step=h)
    assert sol.success and np.abs(sol["q"] - exact["q"]).max() < 1e-10


def test_one_function_may_be_an_argument_of_another():
    inner, outer = courant.numeric(lambda q: 2*q), courant.numeric(lambda u: -u/2)
    sol = courant.solve_lagrangian(kinetic, (0, 5), [1.0], [0.0], forces=lambda q, v: [outer(inner(q[0]))], step=0.05)
    exact = courant.solve_lagrangian(kinetic, (0, 5), [1.0], [0.0], forces=lambda q, v: -q, step=0.05)
    assert np.abs(sol.y - exact.y).max() < 1e-12


def test_numbers_go_through():
    double = courant.numeric(lambda x: 2*x)
    assert double(3.0) == 6.0 and (double(np.ones(2)) == 2).all()


@pytest.mark.parametrize("solve", [
    lambda f: courant.solve_hamiltonian(lambda q, p: p @ p/2 + f(q[0]), (0, 1), [0.0], [1.0], step=0.1),
    lambda f: courant.solve_lagrangian(lambda q, v: v @ v/2 - f(q[0]), (0, 1), [0.0], [1.0], step=0.1),
    lambda f: courant.solve_lagrangian(kinetic, (0, 1), [0.0], [1.0], holonomic=lambda q: [f(q[0])], step=0.1),
])
def test_energies_and_constraints_refuse_numeric_functions(solve):
    with pytest.raises(courant.TraceError, match="test_numeric.py, line .*forces"):
        solve(courant.numeric(lambda q: q))


def run_with(function, **options):
    hook = courant.numeric(function)
    return courant.solve_lagrangian(kinetic, (0, 5), [1.0], [0.0], forces=lambda q, v: [hook(q[0])], step=0.05, **options)


def test_an_error_of_the_function_is_raised():
    calls = []

    def raising(q):
        calls.append(q)
        if len(calls) > 20:
            raise KeyError("mine")
        return -q

    with pytest.raises(KeyError, match="mine"):
        run_with(raising)


def test_what_comes_back_is_looked_at():
    with pytest.raises(ValueError, match="returned 2 numbers, expected 1"):
        run_with(lambda q: [1.0, 2.0])
    sol = run_with(lambda q: -q if q > 0.5 else np.nan)
    assert not sol.success and "not finite" in sol.message


def test_a_function_that_is_too_stiff_for_the_step_is_said():
    sol = run_with(lambda q: -1e5*q)
    assert not sol.success and "shorter step" in sol.message


def test_pickles_keep_the_run():
    sol = run_with(lambda q: -q)
    again = pickle.loads(pickle.dumps(sol))
    assert (again.rows == sol.rows).all() and again.ladder == sol.ladder
    with pytest.raises(courant.ExperimentError, match="numeric functions"):
        again.experiment.run()
    with pytest.raises(courant.ExperimentError, match="object of Python"):
        sol.experiment.to_json()
