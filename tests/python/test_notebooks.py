"""The notebooks run from top to bottom, and show what they printed and drew."""

import glob
import json
import os

import matplotlib.pyplot as plt
import pytest

FOLDER = os.path.join(os.path.dirname(__file__), "..", "..", "docs", "notebooks")
NAMES = sorted(map(os.path.basename, glob.glob(os.path.join(FOLDER, "*.ipynb"))))


def cells_of(name):
    with open(os.path.join(FOLDER, name), encoding="utf-8") as file:
        return json.load(file)["cells"]


def test_there_are_five():
    assert NAMES == ["constraint_algorithm.ipynb", "fitting.ipynb", "manifold.ipynb", "motor.ipynb", "vortices.ipynb"]


@pytest.mark.parametrize("name", NAMES)
def test_a_notebook_runs(name):
    names = {}
    for cell in cells_of(name):
        if cell["cell_type"] == "code":
            exec(compile("".join(cell["source"]), name, "exec"), names)
    plt.close("all")


@pytest.mark.parametrize("name", NAMES)
def test_a_notebook_keeps_what_it_showed(name):
    """.ci/run_notebooks was run: nothing was an error, and something is there."""
    outputs = [output for cell in cells_of(name) for output in cell.get("outputs", [])]
    assert outputs and all(output["output_type"] != "error" for output in outputs)
