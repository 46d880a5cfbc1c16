"""Experiments: run, check, study, sweep, ensemble; pickles, threads, interrupts, memory."""

import concurrent.futures
import gc
import json
import multiprocessing
import os
import pickle
import signal
import subprocess
import sys
import time
import tracemalloc

import numpy as np
import pytest

import courant

OSCILLATOR = {"system": {"type": "hamiltonian", "coordinates": ["q"], "parameters": {"k": 1},
                         "hamiltonian": "(p_q^2 + k*q^2)/2"},
              "initial": {"q": 1, "p_q": 0}, "method": "discretize-first", "time": {"step": 0.1, "end": 1}}


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
    assert run.ladder._repr_latex_().startswith("$")


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
    print(f"1,000 settings: {seconds:.2f} s of the processor")


def test_an_ensemble_has_the_bits_of_its_members():
    starts = np.array([[1.0, 0.0], [0.5, 0.5], [0.0, 2.0]])
    ensemble = courant.ensemble(OSCILLATOR, starts)
    assert ensemble.values.shape == (3, 11, 4)
    for start, rows in zip(starts, ensemble.values):
        assert (rows == courant.run(OSCILLATOR, q=start[0], p_q=start[1]).rows).all()
    assert (courant.ensemble(OSCILLATOR, {"q": [1.0, 0.5], "k": [1.0, 4.0]})["q"][1]
            == courant.run(OSCILLATOR, q=0.5, k=4.0)["q"]).all()
    assert ensemble.summary["members"] == 3


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


def test_threads():
    expected = courant.run(OSCILLATOR, end=100).rows
    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        for rows in pool.map(lambda _: courant.run(OSCILLATOR, end=100).rows, range(8)):
            assert (rows == expected).all()


def test_progress_is_told():
    told = []
    courant.run(OSCILLATOR, end=10000, progress=lambda step, steps, seconds, drift: told.append((step, steps)))
    assert told[-1] == (100000, 100000)


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


def test_an_interrupt_ends_a_run():
    result = subprocess.run([sys.executable, "-c", INTERRUPTED.format(e=OSCILLATOR)], capture_output=True, text=True,
                            timeout=120, check=True)
    assert result.stdout.splitlines()[0].startswith("interrupted ")
    assert result.stdout.splitlines()[1] == "as before"


def resident():
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def test_nothing_leaks():
    def construct():
        bundle = courant.CotangentBundle(courant.Product([courant.Sphere(2), courant.SO3()]))
        courant.Experiment(OSCILLATOR).core
        return bundle.retract(np.r_[1.0, 0, 0, np.eye(3).ravel(), np.zeros(6)], np.zeros(12))

    for _ in range(1000):
        construct()
    gc.collect()
    tracemalloc.start()
    begin, before = resident(), tracemalloc.get_traced_memory()[0]
    for _ in range(10000):
        construct()
    gc.collect()
    traced = tracemalloc.get_traced_memory()[0] - before
    tracemalloc.stop()
    assert traced < 200_000
    assert resident() - begin < 30e6


def test_the_import_is_quick():
    code = "import numpy, time; t = time.process_time(); import courant; print(time.process_time() - t)"
    seconds = float(subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout)
    print(f"import: {seconds:.3f} s")


def test_objects_die_in_any_order():
    code = """
import courant, numpy as np
class Kept(courant.Manifold):
    def __init__(self): super().__init__(1)
courant.register("manifold", "kept-to-the-end", Kept)
from courant import _courant as core
q = core.Graph().variables(["a"], [1])
kept = np.sin(q)
del q
e = courant.Experiment({e!r}); c = e.core; del e
r = courant.run({e!r}, dense_output=True); curve = r.curve; rows = r["q"]; del r
print(curve(np.array([0.5])).shape, rows.shape, kept)
"""
    result = subprocess.run([sys.executable, "-c", code.format(e=OSCILLATOR)], capture_output=True, text=True)
    assert result.returncode == 0, result.stderr


def test_signals_are_pythons_afterwards():
    before = signal.getsignal(signal.SIGINT)
    courant.run(OSCILLATOR)
    assert signal.getsignal(signal.SIGINT) is before
