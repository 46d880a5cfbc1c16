"""What docs/python.md shows, as it stands there."""

import os
import re
import shutil
import subprocess

import courant
import pytest

PAGE = os.path.join(os.path.dirname(__file__), "..", "..", "docs", "python.md")


def blocks():
    with open(PAGE, encoding="utf-8") as file:
        return re.findall(r"```python\n(.*?)```", file.read(), re.S)


def test_the_session_runs(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    names = {"__name__": "session"}
    for block in blocks():
        exec(compile(block, PAGE, "exec"), names)
    assert names["sol"].ladder.index == 2 and names["sol"].ladder.degrees_of_freedom == 2
    assert abs(names["sol"].y[0]**2 + names["sol"].y[1]**2 - 1).max() < 1e-12
    assert names["run"]["x"].shape == (4, 301)
    assert (tmp_path / "pendulum.svg").stat().st_size > 1000


@pytest.mark.skipif(shutil.which("mypy") is None, reason="mypy is not there")
def test_types(tmp_path):
    """The package and what the page shows, by mypy."""
    (tmp_path / "session.py").write_text("\n".join(blocks()))
    folder = os.path.dirname(os.path.dirname(courant.__file__))
    result = subprocess.run(["mypy", "--ignore-missing-imports", "--cache-dir", tmp_path / "cache", "-p", "courant", "-m", "session"],
                            cwd=tmp_path, env={**os.environ, "MYPYPATH": folder}, capture_output=True, text=True)
    assert result.returncode == 0, result.stdout
