"""Experiments from files, and mechanisms."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping

from courant import _courant as core
from courant import experiment
from courant._experiment import Experiment


def mechanism(description: Mapping, **keys) -> Experiment:
    """The experiment of a mechanism: bodies, joints, springs.

    Parameters
    ----------
    description : dict
        The keys of a system of the kind ``mechanism``; ``type`` may be left out.
    **keys
        Of the experiment: ``initial``, ``method``, ``time``, …

    Raises
    ------
    AttributeError
        Where the library has no such kind.
    """
    return experiment.mechanism(**{key: value for key, value in description.items() if key != "type"}, **keys)


def load(path, **keys) -> Experiment:
    """The experiment in a file.

    Parameters
    ----------
    path : path
        ``.json``, an experiment; ``.cir``, a netlist of SPICE.
    **keys
        Other values than those of the file, see :func:`courant.run`.
    """
    path = os.fspath(path)
    suffix = os.path.splitext(path)[1].lower()
    if suffix in (".cir", ".net", ".sp", ".spice"):
        with open(path, encoding="utf-8", errors="replace") as file:
            return Experiment(json.loads(core.imported_netlist(file.read())), **keys)
    if suffix == ".json":
        return Experiment(path, **keys)
    raise ValueError(f"{path}: there is no import of {suffix or 'such'} files; expected .json or .cir")
