"""The second table of docs/two-methods.md: a particle on an ellipsoid by multipliers and by the projected map.

holonomic_routes.py COURANT [STEPS]

Runs both routes with orders 2 and 4, STEPS steps of 0.1 (default 10,000), measures orders by runs with halved steps and
prints the table in Markdown.
"""
import csv
import json
import math
import pathlib
import subprocess
import sys
import tempfile

COURANT = str(pathlib.Path(sys.argv[1]).resolve())
STEPS = int(sys.argv[2]) if len(sys.argv) > 2 else 10_000
STEP = 0.1
AXES = [3, 2, 1]
POTENTIAL = "0.7*x[2] + 0.2*x[0]*x[1]"
SURFACE = "(x[0]/a[0])^2 + (x[1]/a[1])^2 + (x[2]/a[2])^2 - 1"
SYSTEMS = {
    "multipliers": {
        "type": "mechanical", "parameters": {"a": AXES}, "coordinates": ["x[3]"],
        "potential": POTENTIAL, "holonomic": SURFACE},
    "projected map": {
        "type": "hamiltonian", "parameters": {"a": AXES}, "coordinates": ["x[3]"],
        "manifold": {"type": "cotangent-bundle",
                     "base": {"type": "implicit-submanifold", "equations": [SURFACE]}},
        "hamiltonian": "dot(p_x, p_x)/2 + " + POTENTIAL}}
METHODS = {
    "multipliers": {"type": "constrain-first", "discretization": "midpoint", "projector": "orthogonal"},
    "projected map": {"type": "discretize-first", "discretization": "projected"}}


def run(folder, route, order, step, end, every, defects=False):
    """The columns of a run's trajectory by name, and the experiment's end state."""
    experiment = {
        "title": f"{route}, order {order}", "system": SYSTEMS[route],
        "initial": {"x": [3, 0, 0], "p_x": [0, 0.8, 0.6]},
        "method": METHODS[route] | {"order": order}, "time": {"step": step, "end": end},
        "observe": {"on_surface": SURFACE, "along_it": "sum(i, 0, 2, x[i]*p_x[i]/a[i]^2)"},
        "output": {"every": every}}
    if defects:
        experiment["defects"] = ["symplecticity"]
    file = folder / "experiment.json"
    file.write_text(json.dumps(experiment))
    subprocess.run([COURANT, "run", str(file), "-o", str(folder / "run"), "--force", "--quiet"], check=True)
    with open(folder / "run" / "trajectory.csv", newline="") as rows:
        table = list(csv.DictReader(rows))
    return {name: [float(row[name]) for row in table] for name in table[0]}


def end_state(columns):
    return [values[-1] for name, values in columns.items() if name.startswith(("x[", "p_x["))]


def distance(one, other):
    return math.dist(end_state(one), end_state(other))


def slope(times, values):
    t0, v0 = sum(times) / len(times), sum(values) / len(values)
    return (sum((t - t0) * (v - v0) for t, v in zip(times, values))
            / sum((t - t0) ** 2 for t in times))


def text(value):
    if value == 0:
        return "0"
    power = math.floor(math.log10(abs(value)))
    digits = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
    return f"{value / 10 ** power:.1f}·10{str(power).translate(digits)}".replace("-", "−")


def greatest(values):
    return max(map(abs, values))


def measure(folder, route, order):
    columns = run(folder, route, order, STEP, STEPS * STEP, 10)
    errors = [H - columns["H"][0] for H in columns["H"]]
    tenth = len(errors) // 10
    # Errors at t = 1 against steps a quarter as long as the shortest.
    ends = [run(folder, route, order, STEP / n, 1, 1) for n in (1, 2, 8)]
    ratio = distance(ends[0], ends[2]) / distance(ends[1], ends[2])
    defect = run(folder, route, order, STEP, STEP, 1, defects=True)["symplecticity_defect"]
    return {
        "φ at the nodes, greatest": text(greatest(columns["on_surface"])),
        "⟨dφ, p⟩ at the nodes, greatest": text(greatest(columns["along_it"])),
        "energy error, first tenth of the run": text(greatest(errors[:tenth])),
        "energy error, last tenth": text(greatest(errors[-tenth:])),
        "slope of H per unit of time": text(slope(columns["t"], errors)),
        "measured order": f"{math.log2(ratio):.2f}",
        "defect of the two-form in a step": text(greatest(defect))}


def main():
    with tempfile.TemporaryDirectory() as name:
        routes = [(route, order) for order in (2, 4) for route in SYSTEMS]
        results = [measure(pathlib.Path(name), route, order) for route, order in routes]
    print("| | " + " | ".join(f"{route}, order {order}" for route, order in routes) + " |")
    print("|---" * (len(routes) + 1) + "|")
    for line in results[0]:
        print(f"| {line} | " + " | ".join(result[line] for result in results) + " |")


if __name__ == "__main__":
    main()
