"""A function for each kind of system: ``courant.experiment.mechanical(coordinates=["q"], potential="q^2/2", …)``.

The arguments are the keys of the kind, then those of experiments (``initial``, ``method``, ``time``, …); a hyphen of a
kind is an underscore here, and the key ``lambda`` is ``lambda_``. ``help(courant.experiment.mechanical)`` lists them with
what they take.
"""

from __future__ import annotations

import inspect as _inspect
import keyword as _keyword
import textwrap as _textwrap

from courant import _courant as _core
from courant._experiment import Experiment
from courant._experiment import KEYS as _KEYS

_REST = {
    "initial": "values by name, in full or in part",
    "hold": "names of initial values that must not move",
    "nominal": "sizes of coordinates and unknowns, for norms alone",
    "method": "how it is integrated: a word or a dictionary",
    "time": "``{\"step\": h, \"end\": T}``",
    "observe": "formulas by name",
    "events": "quantities whose zeros are located",
    "expect": "what has to come out",
    "output": "which rows there are",
    "title": "one line",
}


def _systems():
    return {kind["type"].replace("-", "_"): kind for kind in _core.catalogue()["systems"] if kind["type"] != "python"}


def _argument(key):
    return key + "_" if _keyword.iskeyword(key) else key


def _docstring(kind):
    lines = [f"An experiment with a system of the kind ``{kind['type']}``: {kind['summary']}.", "", "Parameters", "----------"]
    for key in kind["keys"]:
        takes = key["takes"]
        if not key["required"]:
            takes += ", optional" if key["default"] is None else f", default {key['default']!r}"
        lines += [f"{_argument(key['key'])} : {takes}", *_textwrap.wrap(key["summary"], 100, initial_indent="    ",
                                                           subsequent_indent="    ")]
    for name, text in _REST.items():
        lines += [f"{name} : optional", "    " + text]
    return "\n".join([*lines, "", "Returns", "-------", "courant.Experiment"])


def _maker(name, kind):
    own = [key["key"] for key in kind["keys"]]
    required = [key["key"] for key in kind["keys"] if key["required"]]

    def make(**keys):
        keys = {key[:-1] if key.endswith("_") and _keyword.iskeyword(key[:-1]) else key: value for key, value in keys.items()}
        unknown = [key for key in keys if key not in own and key not in _KEYS]
        if unknown:
            raise TypeError(f"{name}() got an unknown key {unknown[0]!r}; it takes {', '.join([*own, *_REST])}")
        missing = [key for key in required if key not in keys]
        if missing:
            raise TypeError(f"{name}() needs the key {missing[0]!r}")
        system = {"type": kind["type"], **{key: keys[key] for key in own if key in keys}}
        return Experiment({"system": system, "initial": {},
                           **{key: value for key, value in keys.items() if key not in own and value is not None}})

    make.__name__ = make.__qualname__ = name
    make.__module__ = __name__
    make.__doc__ = _docstring(kind)
    keyword = _inspect.Parameter.KEYWORD_ONLY
    make.__signature__ = _inspect.Signature(
        [_inspect.Parameter(_argument(key), keyword, default=_inspect.Parameter.empty if key in required else None)
         for key in own if key.isidentifier()]
        + [_inspect.Parameter(key, keyword, default=None) for key in _REST if key not in own],
        return_annotation=Experiment)
    return make


def __getattr__(name):
    kind = _systems().get(name)
    if kind is None:
        raise AttributeError(f"there is no kind of system {name!r}; expected one of {', '.join(_systems())}")
    made = _maker(name, kind)
    globals()[name] = made
    return made


def __dir__():
    return sorted([*_systems(), "Experiment"])
