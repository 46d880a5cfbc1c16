"""The wheel: what `pip install .` makes, but for the compilation, which is that of the build that is tested."""

import importlib.util
import os
import shutil
import subprocess
import sys
import zipfile

import courant

ROOT = os.path.join(os.path.dirname(__file__), "..", "..")


def backend():
    path = os.path.join(ROOT, "python", "backend", "courant_backend.py")
    spec = importlib.util.spec_from_file_location("courant_backend", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_the_wheel_is_built_without_parts_under_the_gpl(monkeypatch, tmp_path):
    commands = []
    made = backend()
    monkeypatch.setattr(made.subprocess, "run", lambda command, check: commands.append(command))
    made._installed(str(tmp_path))
    assert [command[1] for command in commands] == ["-S", "--build", "--install"]
    assert "COURANT_WITH_SUITESPARSE=OFF" in commands[0]


def test_the_wheel_is_installed_and_runs(monkeypatch, tmp_path):
    made = backend()
    monkeypatch.setattr(made, "_installed", lambda prefix: shutil.copytree(os.path.dirname(courant.__file__), os.path.join(prefix, "courant"),
                                                                           ignore=shutil.ignore_patterns("__pycache__")))
    name = made.build_wheel(str(tmp_path))
    assert name.startswith(f"courant-{courant.__version__}-cp3")
    with zipfile.ZipFile(tmp_path / name) as wheel:
        assert wheel.testzip() is None
        names = wheel.namelist()
    info = f"courant-{courant.__version__}.dist-info"
    assert {f"{info}/METADATA", f"{info}/WHEEL", f"{info}/RECORD", f"{info}/LICENSE", "courant/py.typed", "courant/_courant.pyi"} <= set(names)
    # pip holds the files to their hashes.
    subprocess.run([sys.executable, "-m", "pip", "install", "--quiet", "--no-index", "--no-deps", "--no-compile", "--target", tmp_path / "site",
                    tmp_path / name], check=True)
    answer = subprocess.run([sys.executable, "-c", "import courant; print(courant.__file__); print(courant.experiment.kepler)"], cwd=tmp_path,
                            env={**os.environ, "PYTHONPATH": str(tmp_path / "site")}, capture_output=True, text=True, check=True).stdout
    assert answer.startswith(str(tmp_path / "site"))
