"""The table of docs/energy-drift.md: the energy of symplectic methods over many steps.

energy_drift.py COURANT EXPERIMENT... [--steps N] [--seconds S] [--all]

Of the experiments those are taken whose method is symplectic (as `courant check` says: as claimed, or measured where
nothing is claimed) and whose H is conserved: without forces, damping, inputs and t in its formulas. --all takes those
by other methods too. Each makes N steps (default
10⁶) of its own size, or as many as it gets done in S seconds (default 600). Prints a table in Markdown, a line as soon
as it is there.

The rows of a run are averaged over 50 blocks. A line through the averages has a slope. Its error depends on what is
left beside the line, which the Durbin-Watson ratio d = Σ (r_i - r_(i-1))² / Σ r_i² tells:

    oscillation    averages that are independent of each other, d > 1: the error of a line through them
    walk           their changes are independent, d <= 1: a random walk of these changes has a slope with a standard
                   deviation of sqrt(6/5 / 50) of the changes' standard deviation, per block

What is beyond four of these errors is a drift, unless round-off explains it: steps that each change H by 2⁻⁵² of its
size, at random, change it by sqrt(N) times as much; and a motion that repeats itself repeats its roundings, so that
up to a tenth of 2⁻⁵² of H in each step, in one direction, is called round-off too.
"""
import argparse
import csv
import json
import math
import pathlib
import re
import signal
import subprocess
import sys
import tempfile

ROWS = 2000
BLOCKS = 50
SIGNIFICANT = 4  # standard errors of a slope that is called a drift
ROUNDING = 0.1  # of the last place of H, in each step: constants of a steady motion are rounded the same each time

CHECKED = 120  # seconds for the laws of a method; those of large systems take longer

# What a run of N steps of an experiment does not need, or would need again.
LEFT_OUT = ("expect", "events", "defects", "examine", "symmetries", "title", "description")


def line(values):
    """Slope per index of the line through the values, its standard error, and whether they walk."""
    n = len(values)
    middle, mean = (n - 1) / 2, sum(values) / n
    spread = sum((i - middle) ** 2 for i in range(n))
    slope = sum((i - middle) * (value - mean) for i, value in enumerate(values)) / spread
    rest = [value - mean - slope * (i - middle) for i, value in enumerate(values)]
    squares = sum(r * r for r in rest)
    changes = [b - a for a, b in zip(rest, rest[1:])]
    if squares == 0 or sum(c * c for c in changes) > squares:
        return slope, math.sqrt(squares / (n - 2) / spread), False
    return slope, math.sqrt(1.2 / n * sum(c * c for c in changes) / (n - 2)), True


def averages(values):
    size = len(values) // BLOCKS
    return [sum(values[k * size:(k + 1) * size]) / size for k in range(BLOCKS)]


def texts(json_value):
    """All keys and texts in a value of JSON."""
    if isinstance(json_value, str):
        yield json_value
    elif isinstance(json_value, dict):
        for key, value in json_value.items():
            if not key.startswith("//"):
                yield key
                yield from texts(value)
    elif isinstance(json_value, list):
        for value in json_value:
            yield from texts(value)


def conserves_energy(system):
    words = {word for text in texts(system) for word in re.findall(r"[A-Za-z_]\w*", text)}
    return not words & {"t", "forces", "damping", "inputs", "resistor", "diode"}


class Experiments:
    """Experiments that are run by the command in a folder."""

    def __init__(self, courant, folder):
        self.courant, self.folder = str(pathlib.Path(courant).resolve()), pathlib.Path(folder)

    def is_symplectic(self, file):
        """None where `check` has no answer."""
        try:
            done = subprocess.run([self.courant, "check", str(file), "--json"], capture_output=True, text=True,
                                  timeout=CHECKED)
            return (json.loads(done.stdout).get("method") or {}).get("symplectic")
        except (json.JSONDecodeError, subprocess.TimeoutExpired):
            return None

    def run(self, file, steps, seconds):
        """Times and energies of the rows, the steps that were made, and the status of the run."""
        experiment = json.loads(file.read_text())
        experiment = {key: value for key, value in experiment.items() if key not in LEFT_OUT}
        # Observables may be named by definitions of the run only: none of them is needed.
        experiment.pop("observe", None)
        step = experiment["time"]["step"]
        experiment["time"]["end"] = f"{steps}*({step}) + ({experiment['time'].get('start', 0)})"
        experiment["output"] = {"every": max(1, steps // ROWS)}
        copy, run = self.folder / "experiment.json", self.folder / "run"
        copy.write_text(json.dumps(experiment))
        for table in file.parent.glob("*.csv"):
            (self.folder / table.name).write_bytes(table.read_bytes())
        process = subprocess.Popen([self.courant, "run", str(copy), "-o", str(run), "--force", "--quiet"],
                                   stderr=subprocess.PIPE, text=True)
        try:
            process.wait(seconds)
        except subprocess.TimeoutExpired:
            process.send_signal(signal.SIGINT)
            process.wait()
        summary = json.loads((run / "summary.json").read_text())
        with open(run / "trajectory.csv", newline="") as rows:
            table = list(csv.DictReader(rows))
        return [float(row["t"]) for row in table], [float(row["H"]) for row in table], summary


def measure(experiments, file, steps, seconds):
    t, energy, summary = experiments.run(file, steps, seconds)
    made = f"{summary['steps']:,}"
    if summary["status"] not in ("completed", "interrupted"):
        made += f" ({summary['status']})"
        print(f"{file}: {summary['message']}", file=sys.stderr, flush=True)
    if len(energy) < 2 * BLOCKS:
        return [file.stem, made, "", "", "", "", "too few rows"]
    means = averages([value - energy[0] for value in energy])
    slope, error, walks = line(means)
    block = (t[-1] - t[0]) / (len(energy) - 1) * (len(energy) // BLOCKS)
    greatest = max(abs(value - energy[0]) for value in energy)
    verdict = "walk" if walks else "oscillation"
    ulp = 2.0 ** -52 * max(map(abs, energy))
    if abs(slope) * BLOCKS > SIGNIFICANT * math.hypot(error * BLOCKS, ulp * math.sqrt(summary["steps"])):
        verdict = "**drift**" if abs(slope) * BLOCKS > ROUNDING * ulp * summary["steps"] else "round-off"
    return [file.stem, made, f"{abs(energy[0]):.1e}", f"{greatest:.1e}", f"{slope / block:+.1e} ± {error / block:.0e}",
            f"{slope * BLOCKS:+.1e}", verdict]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("courant")
    parser.add_argument("experiments", type=pathlib.Path, nargs="+")
    parser.add_argument("--steps", type=int, default=1_000_000)
    parser.add_argument("--seconds", type=float, default=600)
    parser.add_argument("--all", action="store_true")
    chosen = parser.parse_args()
    head = ["experiment", "steps", "abs H(0)", "greatest error", "slope of H", "slope × time", "beside the line"]
    print("| " + " | ".join(head) + " |")
    print("|---" * len(head) + "|", flush=True)
    with tempfile.TemporaryDirectory() as folder:
        experiments = Experiments(chosen.courant, folder)
        for file in chosen.experiments:
            experiment = json.loads(file.read_text())
            if "time" in experiment and conserves_energy(experiment["system"]) and (
                    chosen.all or experiments.is_symplectic(file)):
                print("| " + " | ".join(measure(experiments, file, chosen.steps, chosen.seconds)) + " |", flush=True)


if __name__ == "__main__":
    main()
