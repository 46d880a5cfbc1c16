"""Experiments as objects: what a JSON file says, and what is asked of it."""

from __future__ import annotations

import copy
import json
import os
import threading
from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

from courant import _courant as core
from courant._errors import ExperimentError
from courant._numeric import StepInputs

_OBJECTS = (core.Manifold, core.DiracStructure, core.ImplicitSystem, core.DiscretizationMap, core.Projector,
            core.Integrator)


def _is_object(value) -> bool:
    return isinstance(value, _OBJECTS) or (isinstance(value, type) and issubclass(value, _OBJECTS))


def _words(value, objects):
    """The value with words in the place of objects of Python, which are appended to a list."""
    if _is_object(value):
        objects.append(value)
        return {"type": "python", "object": len(objects) - 1}
    if isinstance(value, StepInputs):
        objects.append(value.core())
        return {"type": "python-inputs", "object": len(objects) - 1, "method": _words(value.method, objects)}
    if isinstance(value, Mapping):
        return {str(key): _words(entry, objects) for key, entry in value.items()}
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, (list, tuple)):
        return [_words(entry, objects) for entry in value]
    return value


def _from_file(path) -> str:
    with open(path, encoding="utf-8") as file:
        return file.read()


def _document(source) -> Any:
    if isinstance(source, Experiment):
        return _copied(source.document)
    if isinstance(source, Mapping):
        return source
    if isinstance(source, str) and source.lstrip().startswith("{"):
        text = source
    elif isinstance(source, (str, os.PathLike)):
        text = _from_file(source)
    else:
        raise TypeError(f"{source!r} is no experiment; expected a dictionary, the path of a JSON file, or an Experiment")
    core.read(text)  # says all that is wrong with it, with lines
    return json.loads(text)


def _at(document, pointer):
    """The container and the key that a JSON pointer leads to."""
    parts = [part.replace("~1", "/").replace("~0", "~") for part in pointer.split("/")[1:]]
    for part in parts[:-1]:
        try:
            document = document[int(part)] if isinstance(document, list) else document[part]
        except (KeyError, IndexError, ValueError):
            raise ExperimentError([(pointer, f"leads nowhere: there is no \"{part}\"")]) from None
    return document, int(parts[-1]) if isinstance(document, list) else parts[-1]


# Those of an experiment, beside those of its system.
KEYS = ("title", "description", "system", "branch", "initial", "start", "hold", "weights", "nominal", "method", "time", "symmetries",
        "defects", "observe", "sensitivities", "events", "boundary", "ensemble", "expect", "output", "examine")


def changed(document, settings) -> dict:
    """A copy with other values.

    A setting is called by a JSON pointer (``"/time/step"``), by a key of the experiment (``method``), by ``step`` or
    ``end``, or by a parameter of the system.
    """
    result = copy.copy(document) if not settings else _copied(document)
    for name, value in settings.items():
        if name.startswith("/"):
            container, key = _at(result, name)
            container[key] = value
        elif name in ("step", "end", "tolerance"):
            result.setdefault("time", {})[name] = value
        elif name in KEYS:
            result[name] = value
        elif isinstance(result.get("system"), Mapping) and name in result["system"].get("parameters", {}):
            result["system"]["parameters"][name] = value
        elif isinstance(result.get("initial"), Mapping) and name in result["initial"]:
            result["initial"][name] = value
        else:
            raise ExperimentError([(f"/{name}", "is neither a key of experiments, nor a parameter or an initial value of this "
                                    "one; expected one of these, or a JSON pointer such as \"/time/step\"")])
    return result


def _copied(value):
    """A deep copy that shares objects of Python."""
    if isinstance(value, Mapping):
        return {key: _copied(entry) for key, entry in value.items()}
    if isinstance(value, (list, tuple)):
        return [_copied(entry) for entry in value]
    return value


def has_objects(document) -> bool:
    """Whether objects of Python stand in it, rather than words for them."""
    objects: list = []
    _words(document, objects)
    return bool(objects)


class Experiment:
    """What to compute: a system, where it starts, how it is integrated, what is observed.

    Parameters
    ----------
    source : dict, path or Experiment
        As in a JSON file (``docs/experiment-format.md``). Manifolds, structures, systems, maps, projectors and
        integrators of Python may stand wherever a word for one could.
    **settings
        Other values, see :func:`courant.run`.
    """

    def __init__(self, source, **settings):
        self.document: dict = changed(_document(source), settings)
        self._read = None

    @property
    def core(self):
        """The experiment as C++ has read it."""
        if self._read is None:
            objects: list = []
            words = _words(self.document, objects)
            self._read = core.read(words, objects)
        return self._read

    def changed(self, **settings) -> "Experiment":
        """The same with other values, as of :func:`courant.run`."""
        return Experiment(self, **settings)

    @property
    def complete(self) -> dict:
        """The document with all defaults filled in."""
        return self.core.document

    def to_json(self, **options) -> str:
        """The text of a file that ``courant run`` takes."""
        objects: list = []
        words = _words(self.document, objects)
        if objects:
            raise ExperimentError([("", f"has an object of Python in it, {objects[0]!r}, which JSON cannot hold")])
        return json.dumps(words, indent=2, ensure_ascii=False, **options)

    def save(self, path) -> None:
        """Writes the JSON file."""
        text = self.to_json()
        with open(path, "w", encoding="utf-8") as file:
            file.write(text + "\n")

    def run(self, **options):
        """See :func:`courant.run`."""
        from courant._running import run

        return run(self, **options)

    def certificate(self):
        """See :func:`courant.certificate`."""
        from courant._running import certificate

        return certificate(self)

    def check(self):
        """See :func:`courant.check`."""
        from courant._running import check

        return check(self)

    def __getstate__(self):
        return {"document": self.document}

    def __setstate__(self, state):
        self.document = state["document"]
        self._read = None

    def __eq__(self, other):
        return isinstance(other, Experiment) and self.document == other.document

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self):
        system = self.document.get("system")
        kind = system.get("type", "?") if isinstance(system, Mapping) else type(system).__name__
        return f"Experiment({self.document.get('title') or kind!r})"


def is_main_thread() -> bool:
    return threading.current_thread() is threading.main_thread()


def settings_of(settings: Mapping | Iterable) -> dict:
    return dict(settings)
