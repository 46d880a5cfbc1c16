"""The table of docs/higher-order.md: Method 2 of orders 2, 4, 6, 8 on curved spaces with constraints.

constrained_orders.py COURANT [--steps N] [--systems 0 1] [--orders 2 4 6 8]

Makes N steps (default 10,000) of each order on each system, measures the order against rkf78, and prints a table in
Markdown, a line as soon as it is there.
"""
import argparse
import csv
import json
import math
import pathlib
import subprocess
import tempfile

ROWS = 10_000  # of a long run, at most

SYSTEMS = {
    "a body on SO(3) that may not turn about an axis": {
        "system": {
            "type": "mechanical", "manifold": "so3", "coordinates": ["R[3][3]"],
            "metric": [[1.4, 0, 0.3], [0, 2.1, 0.4], [0.3, 0.4, 1.7]],
            "potential": "0.7*R[2][2] + 0.5*R[0][1] + 0.3*R[1][0]",
            "nonholonomic": "v_R[2] - 0.25*v_R[0]"},
        "initial": {"R": [[1, 0, 0], [0, 0, -1], [0, 1, 0]], "v_R": [0.6, -0.5, 0.15]},
        "map": "cayley", "step": 0.1,
        "off the manifold": "abs(R[0][0]^2 + R[0][1]^2 + R[0][2]^2 - 1)"},
    "a particle on a surface in S³": {
        "system": {
            "type": "hamiltonian", "manifold": {"type": "cotangent-bundle", "base": "sphere"}, "coordinates": ["q[4]"],
            "hamiltonian": "dot(p_q, p_q)/(2*1.3) + q[3] + 0.6*q[0]*q[2]",
            "holonomic": "q[0] + 0.3*q[1]^2 + 0.2*q[2]*q[3] - 0.197"},
        "initial": {"q": [0.1, 0.7, 0.5, -0.5], "p_q": [0.3, -0.2, 0.1, -0.12]},
        "map": "chordal", "step": 0.05,
        "off the manifold": "abs(dot(q, q) - 1)"}}

# Steps to t = 1 from which an order is measured: few enough for errors above round-off.
COUNTS = {2: [32, 64, 128, 256], 4: [8, 16, 32, 64], 6: [6, 9, 12, 18], 8: [4, 5, 6, 8]}


class Runs:
    """Runs of the command, one after the other in one folder."""

    def __init__(self, courant, folder):
        self.courant, self.folder = str(pathlib.Path(courant).resolve()), pathlib.Path(folder)

    def __call__(self, problem, method, step, end, every=1):
        """The columns of a trajectory by name, and the summary."""
        experiment = {
            "system": problem["system"], "initial": problem["initial"], "method": method,
            "time": {"step": step, "end": end}, "observe": {"off_manifold": problem["off the manifold"]},
            "output": {"every": every}}
        file, run = self.folder / "experiment.json", self.folder / "run"
        file.write_text(json.dumps(experiment))
        subprocess.run([self.courant, "run", str(file), "-o", str(run), "--force", "--quiet"], check=True)
        with open(run / "trajectory.csv", newline="") as rows:
            table = list(csv.DictReader(rows))
        columns = {name: [float(row[name]) for row in table] for name in table[0]}
        return columns, json.loads((run / "summary.json").read_text())


def method_2(problem, order):
    return {"type": "constrain-first", "discretization": problem["map"], "order": order}


def slope(x, y):
    x0, y0 = sum(x) / len(x), sum(y) / len(y)
    return sum((a - x0) * (b - y0) for a, b in zip(x, y)) / sum((a - x0) ** 2 for a in x)


def measured_order(run, problem, order):
    def end(method, count):
        columns = run(problem, method, 1 / count, 1)[0]
        return [values[-1] for name, values in columns.items() if name.split("[")[0] in ("q", "p_q", "R", "p_R")]

    exact = end({"type": "rkf78"}, 100)
    errors = [math.dist(end(method_2(problem, order), count), exact) for count in COUNTS[order]]
    return -slope([math.log(count) for count in COUNTS[order]], [math.log(error) for error in errors])


def measure(run, name, order, steps):
    problem = SYSTEMS[name]
    h = problem["step"]
    columns, summary = run(problem, method_2(problem, order), h, steps * h, max(1, steps // ROWS))
    errors = [H - columns["H"][0] for H in columns["H"]]
    tenth = len(errors) // 10
    return [name, str(order), f"{measured_order(run, problem, order):.2f}",
            f"{summary['constraints']['max_violation']:.0e}",
            f"{summary['observables']['off_manifold']['max']:.0e}",
            f"{max(map(abs, errors[:tenth])):.1e}", f"{max(map(abs, errors[-tenth:])):.1e}",
            f"{slope(columns['t'], errors):+.0e}"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("courant")
    parser.add_argument("--steps", type=int, default=10_000)
    parser.add_argument("--systems", type=int, nargs="+", default=range(len(SYSTEMS)))
    parser.add_argument("--orders", type=int, nargs="+", default=sorted(COUNTS))
    chosen = parser.parse_args()
    head = ["system", "order", "measured", "constraints", "off the manifold", "energy, first tenth", "last tenth",
            "slope of H"]
    print("| " + " | ".join(head) + " |")
    print("|---" * len(head) + "|")
    with tempfile.TemporaryDirectory() as folder:
        run = Runs(chosen.courant, folder)
        for system in chosen.systems:
            for order in chosen.orders:
                print("| " + " | ".join(measure(run, list(SYSTEMS)[system], order, chosen.steps)) + " |", flush=True)


if __name__ == "__main__":
    main()
