"""What docs/python.md and docs/examples/python show, as it stands there; and types."""

import glob
import json
import os
import re
import subprocess
import sys

import numpy as np
import pytest

import courant

DOCS = os.path.join(os.path.dirname(__file__), "..", "..", "docs")
PAGE = os.path.join(DOCS, "python.md")
EXAMPLES = sorted(glob.glob(os.path.join(DOCS, "examples", "python", "*.py")))
NOTEBOOKS = sorted(glob.glob(os.path.join(DOCS, "notebooks", "*.ipynb")))


def blocks():
    with open(PAGE, encoding="utf-8") as file:
        return re.findall(r"```python\n(.*?)```", file.read(), re.S)


def code_of(notebook):
    with open(notebook, encoding="utf-8") as file:
        return ["".join(cell["source"]) for cell in json.load(file)["cells"] if cell["cell_type"] == "code"]


def test_the_session_runs(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    names = {"__name__": "session"}
    for block in blocks():
        exec(compile(block, PAGE, "exec"), names)
    assert names["sol"].ladder.index == 2 and names["sol"].ladder.degrees_of_freedom == 2
    assert abs(names["sol"].y[0]**2 + names["sol"].y[1]**2 - 1).max() < 1e-12
    assert names["run"]["x"].shape == (4, 301)
    assert (tmp_path / "pendulum.svg").stat().st_size > 1000
    # A fall until the table's drag is the weight: 5 at 10, 0.8 at 3, then as at the last point; 9.81 is never reached.
    v = names["fall"]["v"][0]
    assert v[100] < -3 and np.all(np.diff(v) < 0)


@pytest.mark.parametrize("path", EXAMPLES, ids=os.path.basename)
def test_an_example_has_ten_lines_and_runs(path):
    with open(path, encoding="utf-8") as file:
        assert len(file.read().splitlines()) <= 11
    answer = subprocess.run([sys.executable, path], capture_output=True, text=True, check=True).stdout
    assert answer.startswith("Certificate(regular")
    numbers = [float(number) for number in re.findall(r"(?<=: )[\d.e+-]+", answer.split("\n", 1)[1])]
    assert numbers and max(numbers) < 1e-4


def test_types(tmp_path):
    """The package, the page, the examples and the code of the notebooks, by mypy."""
    (tmp_path / "session.py").write_text("\n".join(blocks()))
    modules = ["session"]
    for notebook in NOTEBOOKS:
        name = "notebook_" + os.path.basename(notebook).split(".")[0]
        (tmp_path / f"{name}.py").write_text("\n".join(code_of(notebook)))
        modules.append(name)
    for path in EXAMPLES:
        name = "example_" + os.path.basename(path).split(".")[0]
        with open(path, encoding="utf-8") as file:
            (tmp_path / f"{name}.py").write_text(file.read())
        modules.append(name)
    folder = os.path.dirname(os.path.dirname(courant.__file__))
    result = subprocess.run(["mypy", "--ignore-missing-imports", "--cache-dir", tmp_path / "cache", "-p", "courant",
                             *(word for name in modules for word in ("-m", name))],
                            cwd=tmp_path, env={**os.environ, "MYPYPATH": folder}, capture_output=True, text=True)
    assert result.returncode == 0, result.stdout


def test_the_stub_is_that_of_the_module(tmp_path):
    """All names and signatures of the module of C++, by mypy's stubtest."""
    folder = os.path.dirname(os.path.dirname(courant.__file__))
    # Classes of pybind11 have a metaclass of its own; those that nobody makes have no constructor; _trace.py gives Expr methods
    # that arrays of objects call.
    (tmp_path / "known").write_text("courant\\._courant\\.[A-Z]\\w*\n"
                                    "courant\\._courant\\.(Law|Curve|Experiment)\\.__init__\n"
                                    "courant\\._courant\\.Expr\\.([a-z]\\w*|__array_\\w+__)\n")
    result = subprocess.run([sys.executable, "-m", "mypy.stubtest", "--allowlist", tmp_path / "known",
                             "--ignore-unused-allowlist", "courant._courant"],
                            cwd=tmp_path, env={**os.environ, "MYPYPATH": folder}, capture_output=True, text=True)
    assert result.returncode == 0, result.stdout
