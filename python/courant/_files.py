"""Experiments from files, and mechanisms."""

from __future__ import annotations

import json
import os
import warnings
from collections.abc import Mapping

from courant import _courant as core
from courant import experiment
from courant._experiment import Experiment


def mechanism(description: Mapping, **keys) -> Experiment:
    """The experiment of a mechanism: rigid bodies, joints and springs, in SI units.

    Parameters
    ----------
    description : dict
        The keys of a system of the kind ``mechanism``: ``bodies``, ``joints``, ``springs``, ``forces``, ``gravity``,
        ``coordinates`` ("joint" or "absolute"), ``plane``; ``type`` may be left out. See "Mechanisms" in
        docs/experiment-format.md.
    **keys
        Of the experiment: ``initial``, ``method``, ``time``, …

    Examples
    --------
    >>> pendulum = courant.mechanism(
    ...     {"gravity": [0, 0, -9.81], "bodies": {"arm": {"mass": 1, "center": [0.5, 0, 0]}},
    ...      "joints": {"A": {"type": "revolute", "parent": "ground", "child": "arm", "axis": [0, 1, 0]}}},
    ...     initial={"A": 0.3, "A'": 0}, method="discretize-first", time={"step": 0.01, "end": 2})
    >>> run = courant.run(pendulum)
    """
    return experiment.mechanism(**{key: value for key, value in description.items() if key != "type"}, **keys)


def load(path, **keys) -> Experiment:
    """The experiment in a file.

    Parameters
    ----------
    path : path
        ``.json``, an experiment; ``.cir``, a netlist of SPICE; ``.urdf``, ``.sdf``, MuJoCo's ``.xml``, a robot.
    **keys
        Other values than those of the file, see :func:`courant.run`.

    Raises
    ------
    ExperimentError
        Where the file is wrong or not supported, with the line. What is left out of a robot is a warning each.
    """
    path = os.fspath(path)
    suffix = os.path.splitext(path)[1].lower()
    if suffix in (".cir", ".net", ".sp", ".spice"):
        with open(path, encoding="utf-8", errors="replace") as file:
            return Experiment(json.loads(core.imported_netlist(file.read())), **keys)
    if suffix in (".urdf", ".sdf", ".world", ".xml", ".mjcf", ".xacro"):
        with open(path, encoding="utf-8", errors="replace") as file:
            document, notes = core.imported_robot(file.read(), os.path.dirname(path))
        for note in notes:
            warnings.warn(f"{path}: {note}", stacklevel=2)
        return Experiment(json.loads(document), **keys)
    if suffix == ".json":
        return Experiment(path, **keys)
    raise ValueError(f"{path}: there is no import of {suffix or 'such'} files; expected .json, .cir, .urdf, .sdf or .xml")
