"""Measures what bench/README.md holds, and writes its tables. Called by scripts/bench.

measure.py BIN ROOT [ratios|instructions|check|work]

Times are medians of several repetitions in one process, and only their ratios are written. Instructions a step are the
difference of two runs of the command, of which one makes twice as many steps, counted by callgrind; they are the same
on each machine with the same compiler and libraries.
"""
import datetime
import json
import math
import os
import pathlib
import platform
import re
import subprocess
import sys
import tempfile

BIN, ROOT = map(pathlib.Path, sys.argv[1:3])
WHAT = sys.argv[3] if len(sys.argv) > 3 else "all"
README = ROOT / "bench" / "README.md"
REPETITIONS = 9
ALLOWED = 1.05  # instructions a step, of those that were recorded

# What is compared: executable, by hand, and the others with their names in the table.
RATIOS = [
    ("point_vortices", "four vortices, regular form on R⁸, h = 1, next to Newton", "newton_by_hand",
     {"simplified_newton_by_hand": "simplified Newton by hand", "fixed_point_by_hand": "fixed point by hand",
      "generic/bivector_native": "native", "generic/bivector_interpreter": "interpreter"}),
    ("point_vortices", "the same, next to a fixed point, the best by hand", "fixed_point_by_hand",
     {"generic/bivector_native": "native"}),
    ("point_vortices", "the singular Lagrangian on T\\*R⁸, next to the regular form of this program",
     "generic/bivector_native", {"generic/method_1_native": "Method 1", "generic/method_2_native": "Method 2"}),
    ("manifold_step", "reduced rigid body on S², chordal map, h = 0.05", "sphere_by_hand",
     {"sphere/native": "native", "sphere/interpreter": "interpreter"}),
    ("manifold_step", "free rigid body on T\\*SO(3), Cayley midpoint", "rotations_by_hand",
     {"rotations/native": "native", "rotations/interpreter": "interpreter"}),
    ("constrained", "pendulum in Cartesian coordinates, Method 2, h = 0.01", "pendulum_by_hand",
     {"pendulum/native": "native", "pendulum/interpreter": "interpreter"}),
    ("constrained", "heavy top in R¹⁸, Method 2, h = 0.0025", "heavy_top_by_hand",
     {"heavy_top/native": "native", "heavy_top/interpreter": "interpreter"}),
    *((
        "verlet", f"{what}, order {order}", f"{name}/by_hand/{order}",
        {f"{name}/native/{order}": "native", f"{name}/interpreter/{order}": "interpreter"})
      for name, what in (("kepler", "Kepler's problem, e = 0.6, by Verlet, 200 steps a period"),
                         ("circuit", "LC circuit by Verlet, 16 steps a period"),
                         ("pendulum", "pendulum in Cartesian coordinates by RATTLE, 64 steps a period"))
      for order in (2, 8)),
    *((
        "whole_run", f"`courant run` of 10⁶ steps with `every: 1000`, {what}, next to the bare loop of these steps",
        f"bare_loop/{name}", {f"run/{name}": "run"})
      for name, what in (("method_1", "four vortices by Method 1"), ("method_2", "four vortices by Method 2"),
                         ("body", "reduced rigid body on S²"))),
    ("chain", "10 masses between springs, 50 steps from a fresh start", "by_hand/10",
     {"generic/10": "interpreter"}),
    ("chain", "100 masses", "by_hand/100", {"generic/100": "interpreter"}),
    ("chain", "1,000 masses", "by_hand/1000", {"generic/1000": "interpreter"}),
    *((
        "large_systems", f"{what} with {states:,} states by Method 1, next to KLU's factors and solution of the matrix of "
        "a step, ordering and pivots kept", f"{name}/factors_and_solution/{states}",
        {f"{name}/interpreter/{states}": "interpreter",
         **({f"{name}/native/{states}": "native"} if states == 1000 else {}),
         f"{name}/solution/{states}": "solution alone", f"{name}/by_hand/{states}": "by hand (Thomas)"})
      for name, what in (("chain", "chain of masses"), ("line", "LC line"))
      for states in (1000, 10000, 100000)),
]

# Experiments and the number of steps of the shorter run: so many that they are made in a thread of their own.
STEPS = {
    "point_vortices": 1000,
    "point_vortices_lagrangian": 1000,
    "point_vortices_method1": 1000,
    "rigid_body": 1000,
    "heavy_top_so3": 1000,
    "spherical_pendulum": 1000,
    "pendulum_cartesian": 1000,
    "heavy_top_constrained": 1000,
    "nonholonomic_particle": 1000,
    "four_bar": 1000,
    "network_rlc": 1000,
}

# Errors at which times are compared, and what a run may take, in seconds (over the longest horizons six times as long).
LEVELS = [1e-2, 1e-4, 1e-5, 1e-6, 1e-8]
LONGEST = 25


def medians(executable, names):
    """The median time of each benchmark, in one process."""
    command = [BIN / f"bench_{executable}", f"--benchmark_repetitions={REPETITIONS}",
               "--benchmark_report_aggregates_only=true", "--benchmark_format=json",
               "--benchmark_enable_random_interleaving=true",
               "--benchmark_filter=^(" + "|".join(map(re.escape, names)) + ")$"]
    answer = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
    # A run makes its steps in another thread than what it does with them.
    time = "real_time" if executable == "whole_run" else "cpu_time"
    return {b["run_name"]: b[time] for b in answer["benchmarks"] if b["aggregate_name"] == "median"}


def ratio_rows():
    for executable, what, by_hand, others in RATIOS:
        print(f"{executable}: {what}", file=sys.stderr)
        time = medians(executable, [by_hand, *others])
        ratios = ", ".join(f"{title} {time[name] / time[by_hand]:.2g}" for name, title in others.items())
        yield f"| `{executable}` | {what} | {ratios} |"


def instructions_of(experiment, steps, folder, cache):
    step = json.loads((ROOT / "experiments" / f"{experiment}.json").read_text())["time"]["step"]
    counted = folder / "callgrind"
    command = [BIN / "courant", "run", ROOT / "experiments" / f"{experiment}.json", "-o", folder / "run", "--force",
               "--quiet", "--backend", "native", "--set", "/expect=[]", "--set", f"/time/end={step * steps!r}",
               "--set", f'/output={{"every": {steps}}}']
    environment = dict(os.environ, COURANT_CACHE=str(cache))
    subprocess.run(command, check=True, env=environment, stdout=subprocess.DEVNULL)  # compiles
    subprocess.run(["valgrind", "--tool=callgrind", f"--callgrind-out-file={counted}", *command], check=True,
                   env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return int(re.search(r"^(?:summary|totals): (\d+)", counted.read_text(), re.M)[1])


def instructions():
    """Instructions a step of each experiment."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for experiment, steps in STEPS.items():
            few, many = (instructions_of(experiment, n, folder, folder / "cache") for n in (steps, 2 * steps))
            yield experiment, round((many - few) / steps)


def time_at(level, runs):
    """The seconds at which a solver reaches an error, interpolated, or None. `runs` from coarse to fine; an error counts as
    reached where all finer runs keep below it, so that a lucky one does not count."""
    before = None
    for i, run in enumerate(runs):
        error = max(finer["error"] for finer in runs[i:])
        if error <= level:
            if before is None:
                return run["seconds"]
            last, seconds = before
            part = math.log(last / level) / math.log(last / error)
            return seconds * (run["seconds"] / seconds) ** part
        before = error, run["seconds"]
    return None


def work():
    """The runs of bench_work_precision, as they are made."""
    command = [BIN / "bench_work_precision", ROOT / "experiments", str(LONGEST)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True) as process:
        for line in process.stdout:
            run = json.loads(line)
            print(f"{run['problem']}, {run['periods']:g}, {run['solver']}: {run['seconds']:.3g} s, "
                  f"error {run['error']:.2g}", file=sys.stderr)
            yield run
    if process.returncode:
        sys.exit(f"{command[0]} failed")


def work_tables(runs):
    """Times at equal errors, one table a problem and horizon."""
    measured = {}
    for run in runs:
        measured.setdefault((run["problem"], run["periods"]), {}).setdefault(run["solver"], []).append(run)
    for (problem, periods), solvers in measured.items():
        yield from work_table(f"{problem}, {periods:,.0f} {'s' if problem == 'double pendulum' else 'periods'}", solvers)


def work_table(title, solvers):
    yield ""
    yield f"| {title} | " + " | ".join(f"{level:.0e}" for level in LEVELS) + \
        " | smallest error | drift of H, first tenth | whole run | constraints |"
    yield "|---|" + "---|" * (len(LEVELS) + 4)
    times = {solver: [time_at(level, runs) for level in LEVELS] for solver, runs in solvers.items()}
    for solver, runs in solvers.items():
        best = min(runs, key=lambda run: run["error"])
        cells = ["–" if time is None else f"{time:.2g}" for time in times[solver]]
        cells += [f"{best[key]:.0e}" for key in ("error", "early_drift", "drift", "violation")]
        yield f"| {solver} | " + " | ".join(cells) + " |"
    for other in ("IDA", "CVODE", "ARKODE", "Odeint"):
        if not any(solver.startswith(other) for solver in solvers):
            continue
        cells = []
        for i in range(len(LEVELS)):
            ours, theirs = (min((time[i] for solver, time in times.items() if solver.startswith(name) and time[i]),
                                default=None) for name in ("Courant", other))
            cells.append("–" if ours is None or theirs is None else f"{ours / theirs:.2g}")
        yield f"| *Courant's best : {other}'s best* | " + " | ".join(cells) + " | | | | |"


def recorded():
    return {name: int(count.replace(",", ""))
            for name, count in re.findall(r"^\| `(\w+)` \| ([\d,]+) \|$", README.read_text(), re.M)}


def written(section, lines):
    """Puts the lines between the marks of a section of the README."""
    begin, end = f"<!-- {section} -->\n", f"<!-- end of {section} -->\n"
    before, rest = README.read_text().split(begin)
    README.write_text(before + begin + "\n" + "\n".join(lines) + "\n\n" + end + rest.split(end)[1])


def machine():
    info = pathlib.Path("/proc/cpuinfo")
    model = re.search(r"model name\s*: (.*)", info.read_text()) if info.exists() else None
    compiler = subprocess.run(["c++", "-dumpfullversion"], capture_output=True, text=True).stdout.strip()
    return (f"{datetime.date.today()}, {model[1].strip() if model else platform.machine()}, {os.cpu_count()} cores, "
            f"GCC {compiler}")


def main():
    if WHAT == "check":
        known, worse = recorded(), 0
        for name, count in instructions():
            before = known.get(name)
            verdict = "is not recorded" if before is None else f"{count / before:.3f} of the recorded {before:,}"
            print(f"{name}: {count:,} instructions a step, {verdict}")
            worse += before is None or count > ALLOWED * before
        sys.exit(worse > 0)
    if WHAT in ("all", "work") and (BIN / "bench_work_precision").exists():
        written("work", [f"{machine()}; seconds of processor time:", *work_tables(work())])
    if WHAT == "work":
        return
    if WHAT in ("all", "ratios"):
        written("ratios", [f"{machine()}:", "", "| bench | what | time, by hand = 1 |", "|---|---|---|",
                           *ratio_rows()])
    if WHAT == "ratios":
        return
    written("instructions", [f"{machine()}:", "", "| experiment | instructions a step |", "|---|---|",
                             *(f"| `{name}` | {count:,} |" for name, count in instructions())])


if __name__ == "__main__":
    main()
