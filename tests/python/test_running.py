"""Experiments: run, check, study, sweep, ensemble; pickles, threads, interrupts, memory."""

import concurrent.futures
import inspect
import json
import multiprocessing
import os
import pickle
import signal
import subprocess
import sys
import time

import numpy as np
import pytest

import courant
from objects import OSCILLATOR, Decay, Euler, Line, Middle, Rotation


def angle(h, omega=1.0):
    """By which the midpoint rule turns in a step."""
    return 2*np.arctan(omega*h/2)


def test_a_run_has_rows_under_names():
    run = courant.run(OSCILLATOR)
    assert run.names == ["t", "q", "p_q", "H"]
    assert run["q"] == pytest.approx(np.cos(np.arange(11)*angle(0.1)), abs=1e-14)
    assert run.success and run.ladder.verdict == "regular"
    assert run.to_dataframe().loc[1.0, "q"] == run["q"][-1]
    assert "completed" in run._repr_html_() and "svg" in run.ladder._repr_html_()
    assert run._repr_latex_() == run.ladder._repr_latex_() and run._repr_latex_().startswith("$")


def test_rows_reach_numpy_without_a_copy():
    run = courant.run(OSCILLATOR)
    assert not run.rows.flags.owndata
    base = run.rows
    while isinstance(base, np.ndarray):
        base = base.base
    assert type(base).__name__ == "PyCapsule"
    assert np.shares_memory(run["q"], run.rows)
    sol = courant.solve_dae(lambda t, y, yp: [yp[0] - y[1], yp[1] + y[0]], (0, 1), [1, 0], step=0.1)
    assert np.shares_memory(sol.y, sol.rows)


def test_settings():
    assert courant.run(OSCILLATOR, step=0.05)["q"][-1] == pytest.approx(np.cos(20*angle(0.05)), abs=1e-13)
    assert courant.run(OSCILLATOR, k=4)["q"][-1] == pytest.approx(np.cos(10*angle(0.1, 2)), abs=1e-13)
    assert courant.run(OSCILLATOR, q=2)["q"][0] == 2
    assert len(courant.run(OSCILLATOR, **{"/time/end": 0.5}).t) == 6
    assert courant.run(OSCILLATOR, method="rk4").summary["method"].startswith("rk4")
    with pytest.raises(courant.ExperimentError, match="/nonsense: is neither"):
        courant.run(OSCILLATOR, nonsense=1)
    assert OSCILLATOR["time"] == {"step": 0.1, "end": 1}


def test_all_that_is_wrong_is_said_at_once():
    with pytest.raises(courant.ExperimentError) as caught:
        courant.run({**OSCILLATOR, "methd": 1, "initial": {"q": 1, "pq": 0}})
    where = [pointer for pointer, _ in caught.value.problems]
    assert "/methd" in where and "/initial/pq" in where
    assert isinstance(caught.value, ValueError)
    again = pickle.loads(pickle.dumps(caught.value))
    assert again.problems == caught.value.problems


def test_a_folder_is_that_of_the_command(tmp_path):
    run = courant.run(OSCILLATOR, folder=tmp_path / "run")
    assert json.loads((tmp_path / "run" / "summary.json").read_text())["status"] == "completed"
    assert (run.rows == courant.run(OSCILLATOR).rows).all()
    with pytest.raises(OSError, match="run"):
        courant.run(OSCILLATOR, folder=tmp_path / "run")
    courant.run(OSCILLATOR, folder=tmp_path / "run", existing="replace")


def test_check_and_study():
    check = courant.check(OSCILLATOR)
    assert check and check.structure["dirac"] and "✓" in check._repr_html_()
    study = courant.study(OSCILLATOR, steps=4)
    assert list(study.orders.values())[0] == pytest.approx(2, abs=0.1)
    assert "order 2" in study._repr_latex_() and "h = 0.1 & " in study._repr_latex_()


def test_a_certificate_is_proved_where_one_asks():
    assert courant.certificate(OSCILLATOR).proof is None
    proof = courant.certificate(OSCILLATOR, prove=True).proof
    assert proof["proved"] or proof["missing"].startswith("This build")


def test_a_certificate_is_set_with_its_equations():
    found = courant.certificate({"system": {"type": "implicit", "coordinates": ["x", "y", "v", "w"], "unknowns": ["T"],
                                            "equations": ["x'-v", "y'-w", "v'+T*x", "w'+T*y+1", "x*x+y*y-1"]},
                                 "initial": {"x": 0.6, "y": -0.8, "v": 0.8, "w": 0.6}})
    latex, html = found._repr_latex_(), found._repr_html_()
    assert "S_{0}^{4} \\supseteq S_{1}^{3} \\supseteq S_{2}^{2} = S_{3}^{2}" in latex
    assert "M_{0}:\\quad {x}^{2} + {y}^{2} - 1 = 0" in latex and "S_{1}:\\quad x\\,\\dot{x} + y\\,\\dot{y} = 0" in latex
    assert html.count("<math") > 8 and "S₁ adds" in html.replace("<sub>1</sub>", "₁").replace("<i>", "").replace("</i>", "")
    vortices = courant.certificate({"system": {"type": "point-vortices", "strengths": [1, 1, -1, -1]},
                                    "initial": {"x": [-1, 1, -1, 1], "y": [2, 2, -2, -2]}})
    assert "second class: 8" in vortices._repr_latex_() and "second class" in vortices._repr_html_()


def test_kinds_are_functions():
    experiment = courant.experiment.hamiltonian(coordinates=["q"], hamiltonian="(p_q^2 + q^2)/2",
                                                initial={"q": 1, "p_q": 0}, method="discretize-first",
                                                time={"step": 0.1, "end": 1})
    assert experiment.run()["q"] == pytest.approx(courant.run(OSCILLATOR)["q"], abs=1e-15)
    assert "hamiltonian : " in courant.experiment.hamiltonian.__doc__
    assert "point_vortices" in dir(courant.experiment)
    with pytest.raises(TypeError, match="needs the key 'hamiltonian'"):
        courant.experiment.hamiltonian(coordinates=["q"])
    with pytest.raises(AttributeError, match="there is no kind"):
        courant.experiment.hamiltonain


def test_a_mechanism_is_an_experiment():
    """A point on a rod is the pendulum of the catalogue."""
    keys = {"method": "discretize-first", "time": {"step": 0.01, "end": 1}}
    rod = courant.mechanism({"gravity": [0, 0, -9.81], "bodies": {"rod": {"mass": 1, "center": [0, 0, -1]}},
                             "joints": {"A": {"type": "revolute", "parent": "ground", "child": "rod", "axis": [0, 1, 0]}}},
                            initial={"A": 1, "p_A": 0}, **keys)
    pendulum = courant.experiment.pendulum(initial={"q": 1, "p_q": 0}, **keys)
    assert rod.run()["A"] == pytest.approx(pendulum.run()["q"], abs=1e-12)


def systems():
    from courant import _courant as core
    return {kind["type"]: kind for kind in core.catalogue()["systems"] if kind["example"]}


@pytest.mark.parametrize("kind", systems())
def test_every_kind_is_a_function_of_its_keys(kind):
    """The example of the catalogue, by arguments."""
    example = systems()[kind]["example"]
    system = dict(example["system"])
    make = getattr(courant.experiment, system.pop("type").replace("-", "_"))
    if "lambda" in system:
        system["lambda_"] = system.pop("lambda")
    made = make(**system, **{key: value for key, value in example.items() if key != "system"})
    assert made.complete == courant.Experiment(example).complete
    for key in systems()[kind]["keys"]:
        argument = "lambda_" if key["key"] == "lambda" else key["key"]
        assert f"{argument} : " in make.__doc__ and argument in inspect.signature(make).parameters
    with pytest.raises(TypeError, match="unknown key 'nonsense'"):
        make(**system, nonsense=1)


def test_functions_of_kinds_know_the_keys_of_experiments():
    from courant._experiment import KEYS
    schema = os.path.join(os.path.dirname(__file__), "..", "..", "experiments", "schema.json")
    with open(schema, encoding="utf-8") as file:
        assert sorted(KEYS) == sorted(key for key in json.load(file)["properties"] if not key.startswith("$"))


def test_a_sweep():
    settings = [{"k": float(k)} for k in (1, 4, 9)]
    sweep = courant.sweep(OSCILLATOR, settings)
    assert sweep.column("q") == pytest.approx([np.cos(10*angle(0.1, w)) for w in (1, 2, 3)], abs=1e-13)
    assert list(sweep.to_dataframe()["k"]) == [1, 4, 9]


def test_a_thousand_settings_take_little():
    begin = time.process_time()
    sweep = courant.sweep(OSCILLATOR, [{"k": 1 + i/1000} for i in range(1000)])
    seconds = time.process_time() - begin
    assert all(run.success for run in sweep)
    assert sweep.column("q") == pytest.approx([np.cos(10*angle(0.1, np.sqrt(1 + i/1000))) for i in range(1000)], abs=1e-12)
    print(f"1,000 settings: {seconds:.2f} s of the processor")


def test_an_ensemble_has_the_bits_of_its_members():
    starts = np.array([[1.0, 0.0], [0.5, 0.5], [0.0, 2.0]])
    ensemble = courant.ensemble(OSCILLATOR, starts)
    assert ensemble.values.shape == (3, 11, 4)
    for start, rows in zip(starts, ensemble.values):
        assert (rows == courant.run(OSCILLATOR, q=start[0], p_q=start[1]).rows).all()
    assert (courant.ensemble(OSCILLATOR, {"q": [1.0, 0.5], "k": [1.0, 4.0]})["q"][1]
            == courant.run(OSCILLATOR, q=0.5, k=4.0)["q"]).all()
    assert ensemble.summary["members"] == 3 and ensemble.summary["completed"] == 3
    assert ensemble.summary["statistics"]["q"]["mean"] == pytest.approx(ensemble["q"][:, -1].mean(), abs=1e-14)
    assert ensemble.summary["statistics"]["q"]["standard_deviation"] == pytest.approx(ensemble["q"][:, -1].std(ddof=1), abs=1e-14)
    quantiles = ensemble.summary["statistics"]["q"]["quantiles"]
    assert list(quantiles.values()) == pytest.approx(np.quantile(ensemble["q"][:, -1], [0.05, 0.25, 0.5, 0.75, 0.95]), abs=1e-14)


def test_an_ensemble_of_the_experiment():
    random = {"members": 5, "seed": 1, "random": {"g": "normal"}, "values": {"q": "1 + 0.1*g"}}
    ensemble = courant.ensemble({**OSCILLATOR, "ensemble": random})
    assert ensemble.values.shape == (5, 11, 4) and len(set(ensemble["q"][:, 0])) == 5
    with pytest.raises(courant.ExperimentError, match="makes many runs"):
        courant.run({**OSCILLATOR, "ensemble": random})
    with pytest.raises(courant.ExperimentError, match="/ensemble/values/qq: is neither an initial value nor a parameter"):
        courant.ensemble(OSCILLATOR, {"qq": [1.0, 2.0]})


def test_an_ensemble_of_objects_of_python():
    decay = {"system": Decay(), "initial": {"x[0]": 1.0}, "method": Euler, "time": {"step": 0.1, "end": 1}}
    ensemble = courant.ensemble(decay, {"x[0]": [1.0, 2.0, 3.0]})
    assert ensemble["x"][:, 0, -1] == pytest.approx(0.9**10*np.arange(1, 4), abs=1e-14)


def in_another_process(experiment):
    return experiment.run().rows


def test_pickles():
    run = courant.run(OSCILLATOR)
    again = pickle.loads(pickle.dumps(run))
    assert (again.rows == run.rows).all() and again.ladder == run.ladder and again.experiment == run.experiment
    certificate = courant.certificate(OSCILLATOR)
    assert pickle.loads(pickle.dumps(certificate)) == certificate
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        assert (pool.map(in_another_process, [courant.Experiment(OSCILLATOR)])[0] == run.rows).all()


def test_experiments_with_objects_of_python_are_pickled():
    """Classes that can be imported, with what their instances hold; rows come out the same in another process."""
    experiment = courant.Experiment({"system": Decay(), "initial": {"x[0]": 1.0}, "method": Euler,
                                     "time": {"step": 0.1, "end": 1}})
    expected = experiment.run()
    assert expected["x[0]"] == pytest.approx(0.9**np.arange(11), abs=1e-15)
    assert (pickle.loads(pickle.dumps(experiment)).run().rows == expected.rows).all()
    assert (pickle.loads(pickle.dumps(expected)).rows == expected.rows).all()
    line = Line()
    line.note = "kept"
    again = pickle.loads(pickle.dumps(line))
    assert again.note == "kept" and again.dimension == 1 and again.retract(np.ones(1), np.ones(1)) == 2


def test_threads():
    expected = courant.run(OSCILLATOR, end=100).rows
    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        for rows in pool.map(lambda _: courant.run(OSCILLATOR, end=100).rows, range(8)):
            assert (rows == expected).all()


def test_progress_is_told():
    told = []
    courant.run(OSCILLATOR, end=10000, progress=lambda step, steps, seconds, drift: told.append((step, steps)))
    assert told[-1] == (100000, 100000)


@pytest.mark.parametrize("in_thread", [False, True])
def test_progress_stops_a_run(in_thread):
    def run():
        return courant.run(OSCILLATOR, end=1e6, output={"every": 10000}, progress=lambda step, *_: step < 200000)

    if in_thread:
        with concurrent.futures.ThreadPoolExecutor(1) as pool:
            stopped = pool.submit(run).result()
    else:
        stopped = run()
    assert stopped.status == "interrupted" and 20 <= len(stopped.t) < 1000


INTERRUPTED = """
import courant, signal, threading, os, time
e = {e!r}
e["time"] = {{"step": 1e-3, "end": 1e6}}
e["output"] = {{"every": 1000000}}
threading.Thread(target=lambda: (time.sleep(1.0), os.kill(os.getpid(), signal.SIGINT)), daemon=True).start()
try:
    courant.run(e, progress=False)
except KeyboardInterrupt as stop:
    print(stop.run.status, len(stop.run.rows))
try:
    signal.raise_signal(signal.SIGINT)
except KeyboardInterrupt:
    print("as before")
"""


INTERRUPTED_IN_PYTHON = """
import courant, signal, threading, os, time
force = courant.numeric(lambda q: -q)
threading.Thread(target=lambda: (time.sleep(1.0), os.kill(os.getpid(), signal.SIGINT)), daemon=True).start()
begin = time.monotonic()
try:
    courant.solve_lagrangian(lambda q, v: v @ v/2, (0, 1e4), [1.0], [0.0], forces=lambda q, v: [force(q[0])], step=1e-3, progress=False)
except KeyboardInterrupt as stop:
    print(stop.run.status, time.monotonic() - begin < 20)
"""


def test_an_interrupt_ends_a_run_that_calls_python():
    result = subprocess.run([sys.executable, "-c", INTERRUPTED_IN_PYTHON], capture_output=True, text=True, timeout=120)
    assert result.stdout == "interrupted True\n", result.stderr


@pytest.mark.parametrize("where", ["residual", "step", "progress", "retract", "membership", "forward"])
def test_what_hooks_raise_arrives(where):
    class Mine(Exception):
        pass

    def raising(*_):
        raise Mine(where)

    def run(system, method, **options):
        courant.run({"system": system, "initial": {"x": [1.0]} if isinstance(system, Decay) else {"q": 1, "p_q": 0}, "method": method,
                     "time": {"step": 0.1, "end": 1}}, **options)

    def child(base):
        return type("Child", (base,), {where: raising})

    hamiltonian = OSCILLATOR["system"]
    with pytest.raises(Mine, match=where):
        if where == "residual":
            run(child(Decay)(), "rk4")
        elif where == "step":
            run(Decay(), child(Euler))
        elif where == "progress":
            courant.run(OSCILLATOR, end=100000, progress=raising)
        elif where == "retract":
            run({**hamiltonian, "manifold": {"type": "cotangent-bundle", "base": child(Line)()}}, "discretize-first")
        elif where == "membership":
            courant.solve_hamiltonian(lambda x: x @ x/2, (0, 1), [1.0, 0.0], structure=child(Rotation)(), step=0.1)
        else:
            run(hamiltonian, {"type": "discretize-first", "discretization": child(Middle)})


def test_an_interrupt_ends_a_run():
    result = subprocess.run([sys.executable, "-c", INTERRUPTED.format(e=OSCILLATOR)], capture_output=True, text=True,
                            timeout=120, check=True)
    assert result.stdout.splitlines()[0].startswith("interrupted ")
    assert result.stdout.splitlines()[1] == "as before"


def test_the_import_is_quick():
    code = "import numpy, time; t = time.process_time(); import courant; print(time.process_time() - t)"
    seconds = float(subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout)
    print(f"import: {seconds:.3f} s")


def test_signals_are_pythons_afterwards():
    before = signal.getsignal(signal.SIGINT)
    courant.run(OSCILLATOR)
    assert signal.getsignal(signal.SIGINT) is before


def test_derivatives_along_a_run():
    experiment = {**OSCILLATOR, "sensitivities": {"by": ["q", "p_q"], "of": ["q", "H"]}}
    run = courant.run(experiment)
    angles = np.arange(11)*angle(0.1)
    assert run.sensitivity.by == ["q", "p_q"] and run.sensitivity.of == ["q", "H"]
    assert run.sensitivity["q", "q"] == pytest.approx(np.cos(angles), abs=1e-13)
    assert run.sensitivity["q", "p_q"] == pytest.approx(np.sin(angles), abs=1e-13)
    assert run.sensitivity.array.shape == (2, 2, 11)
    assert run.sensitivity.jvp({"p_q": 2})["q"] == pytest.approx(2*np.sin(angles), abs=1e-13)
    # Of Σ q: Σ cos and Σ sin.
    gradient = run.sensitivity.vjp({"q": np.ones(11)})
    assert gradient == pytest.approx({"q": np.cos(angles).sum(), "p_q": np.sin(angles).sum()}, abs=1e-12)
    assert run.summary["sensitivities"]["final"]["q"]["q"] == run.sensitivity["q", "q"][-1]
    with pytest.raises(KeyError, match="'x' is none of q, p_q"):
        run.sensitivity.jvp({"x": 1})
    assert courant.run(OSCILLATOR).sensitivity is None
