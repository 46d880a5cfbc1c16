"""The notebooks run from top to bottom."""

import glob
import json
import os

import pytest

FOLDER = os.path.join(os.path.dirname(__file__), "..", "..", "docs", "notebooks")


@pytest.mark.parametrize("name", sorted(map(os.path.basename, glob.glob(os.path.join(FOLDER, "*.ipynb")))))
def test_a_notebook_runs(name):
    with open(os.path.join(FOLDER, name), encoding="utf-8") as file:
        cells = json.load(file)["cells"]
    names = {}
    for cell in cells:
        if cell["cell_type"] == "code":
            exec(compile("".join(cell["source"]), name, "exec"), names)
