"""What is constructed is let go of, in whatever order; nothing leaks."""

import gc
import os
import subprocess
import sys
import tracemalloc

import numpy as np
import pytest

import courant
from objects import OSCILLATOR, Decay, Euler, Line, Middle, Rotation


def resident():
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def construct_objects():
    bundle = courant.CotangentBundle(courant.Product([courant.Sphere(2), courant.SO3()]))
    bundle.retract(np.r_[1.0, 0, 0, np.eye(3).ravel(), np.zeros(6)], np.zeros(12))
    line = Line()
    zero, one = np.zeros(1), np.ones(1)
    line.retract(zero, one)
    Middle(line).forward(zero, one)
    courant.CotangentBundle(line).retract(np.zeros(2), np.ones(2))
    Rotation().membership([0.0, 0.0], [1.0, 0.0], [0.0, 1.0])
    Euler(Decay())


def construct_experiments():
    courant.Experiment(OSCILLATOR).core
    courant.Experiment({"system": Decay(), "initial": {"x[0]": 1}, "method": Euler, "time": {"step": 0.1, "end": 1}}).core


def construct_traces():
    from courant import _courant as core
    x = core.Graph().variables(["a", "b"], [2])
    core.Function(np.sin(x) @ x, x)(np.ones(2))


@pytest.mark.parametrize("construct, times", [(construct_objects, 10000), (construct_experiments, 10000), (construct_traces, 10000),
                                              (lambda: courant.run(OSCILLATOR, progress=False), 1000)],
                         ids=["objects", "experiments", "traces", "runs"])
def test_nothing_leaks(construct, times):
    for _ in range(times // 10):
        construct()
    gc.collect()
    begin = resident()
    for _ in range(times):
        construct()
    gc.collect()
    # Pages that the allocator keeps are a few; a leak of 300 bytes a time would be 3 MB.
    assert resident() - begin < 3e6
    tracemalloc.start()
    for _ in range(100):
        construct()
    gc.collect()
    before = tracemalloc.get_traced_memory()[0]
    for _ in range(1000):
        construct()
    gc.collect()
    traced = tracemalloc.get_traced_memory()[0] - before
    tracemalloc.stop()
    assert traced < 20_000


DYING = """
import gc, itertools, random, sys
import courant, numpy as np
from courant import _courant as core

class Kept(courant.Manifold):
    def __init__(self): super().__init__(2)
    def retract(self, x, v): return x + v

class System(courant.ImplicitSystem):
    def __init__(self, manifold):
        super().__init__(manifold, 2, coordinates=["a", "b"])
        self.mine = manifold
    def residual(self, x, v, z, t): return [v[0] - x[1], v[1] + x[0]]

class Method(courant.Integrator):
    def __init__(self, system): super().__init__(system)
    def step(self, t, x, h): return [x[0] + h*x[1], x[1] - h*x[0]]

def family():
    manifold = Kept()
    system = System(manifold)
    bundle = courant.CotangentBundle(manifold)
    method = Method(system)
    experiment = courant.Experiment({{"system": system, "initial": {{"a": 1, "b": 0}}, "method": Method,
                                     "time": {{"step": 0.1, "end": 1}}}})
    read = experiment.core
    run = experiment.run(dense_output=True)
    graph = core.Graph()
    x = graph.variables(["a"], [1])
    y = np.sin(x)
    force = courant.numeric(lambda q: -q)
    sol = courant.solve_lagrangian(lambda q, v: v @ v/2, (0, 1), [1.0], [0.0], forces=lambda q, v: [force(q[0])], step=0.1)
    return [manifold, system, bundle, method, experiment, read, run, run.curve, run["a"], run.ladder, graph, x, y, sol, sol["q"]]

uses = [lambda o: o[2].dimension, lambda o: courant.laws(o[0]), lambda o: o[7](np.array([0.5])), lambda o: o[8].sum(), lambda o: str(o[12]),
        lambda o: core.certificate(o[5])]
order = random.Random({seed})
for _ in range(8):
    objects = family()
    places = list(range(len(objects)))
    order.shuffle(places)
    for place in places:
        objects[place] = None
        gc.collect()
        for use, needed in zip(uses, (2, 0, 7, 8, 12, 5)):
            if objects[needed] is not None:
                use(objects)
courant.register("manifold", "kept-to-the-end", Kept)
left = family()  # what is left at the end dies in Python's order
print("alive")
"""


@pytest.mark.parametrize("seed", range(3))
def test_objects_die_in_any_order(seed):
    result = subprocess.run([sys.executable, "-c", DYING.format(seed=seed)], capture_output=True, text=True)
    assert result.returncode == 0 and result.stdout == "alive\n", result.stderr
