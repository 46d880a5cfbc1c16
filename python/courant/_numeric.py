"""Functions of numbers in traced functions: tables, neural networks, controllers."""

from __future__ import annotations

import contextlib
import threading
from collections.abc import Callable, Mapping, Sequence

import numpy as np

from courant import _courant as core
from courant._errors import ExperimentError

_now = threading.local()


class Input:
    """One use of a numeric function: the coordinates that stand for its values, and what it is called with."""

    def __init__(self, names, function, arguments):
        self.names, self.function, self.arguments = list(names), function, arguments


@contextlib.contextmanager
def used_by(words):
    """While this lasts, numeric functions become inputs of `words`; None: they have no place."""
    before = getattr(_now, "words", None)
    _now.words = words
    try:
        yield
    finally:
        _now.words = before


def _is_traced(argument):
    return core.is_expr(argument) or np.asarray(argument).dtype == object


def numeric(function: Callable, shape=()) -> Callable:
    """A function that is called with numbers in every step: a table, a neural network, a controller.

    Parameters
    ----------
    function : callable
        ``function(*arrays)``: floats and arrays of floats in, a number or an array out.
    shape : int or tuple of int
        Of what it returns; a number by default.

    Returns
    -------
    callable
        For use in ``F`` of :func:`courant.solve_dae` and in ``forces``, with arguments of theirs. Given numbers it is
        `function` itself.

    Raises
    ------
    TraceError
        Where it is used in an energy or a constraint, of which derivatives are needed.
    ExperimentError
        When it runs with a method whose steps have several stages: compositions, Verlet, Runge and Kutta's of order 4.

    Notes
    -----
    Its value stands still in a step: that at the stage of the step, for which the step is repeated until the value
    settles, three to six times for short steps. With the midpoint rule, which is the default, that is the midpoint rule of
    the whole, of order 2. Each turn is a step of compiled code, some microseconds, and a call of Python with the GIL held, some ten
    microseconds and what `function` takes. Other threads of Python wait meanwhile. The certificate is that of the system
    with the value at the start.

    Examples
    --------
    >>> drag = courant.numeric(lambda v: np.interp(v, [-10, 0, 10], [4.0, 0.0, -4.0]))
    >>> sol = courant.solve_lagrangian(lambda q, v: v @ v/2 - q[0], (0, 2), [0.0], [0.0], step=0.01,
    ...                                forces=lambda q, v: [drag(v[0])])
    """
    shape = (shape,) if isinstance(shape, (int, np.integer)) else tuple(shape)

    def call(*arguments):
        if not any(map(_is_traced, arguments)):
            return function(*arguments)
        words = getattr(_now, "words", None)
        if words is None:
            from courant._trace import refuse_numeric

            refuse_numeric()
        return words.input_of(function, arguments, shape)

    call.__name__ = getattr(function, "__name__", "numeric")
    call.__doc__ = function.__doc__
    return call


class StepInputs:
    """A method of a system with inputs: what stands as ``"method"`` of its experiment.

    Parameters
    ----------
    method : str or dict
        The method that makes the steps.
    inputs : sequence of Input
    variables : traced array
        All variables that arguments of inputs may depend on.
    places : callable
        (coordinates, unknowns) to a dict from names of variables to (which of t, x, v, z, number in it).
    """

    def __init__(self, method, inputs: Sequence[Input], variables, names, places):
        self.method = method
        self.inputs = list(inputs)
        self.names = [name for one in inputs for name in one.names]
        self._places = places
        used = core.variables_of([entry for one in inputs for argument in one.arguments for entry in np.ravel(argument)])
        kept = [k for k, name in enumerate(names) if name in used]
        self._used = [names[k] for k in kept]
        variables = [variables[k] for k in kept]
        self._calls = []
        for one in inputs:
            shapes = [np.shape(argument) for argument in one.arguments]
            outputs = [entry for argument in one.arguments for entry in np.ravel(argument)]
            self._calls.append((one.function, len(one.names), shapes, core.Function(outputs, variables)))

    def values(self, numbers) -> np.ndarray:
        """Values of the inputs where the variables that are used have these numbers."""
        result = []
        for function, size, shapes, arguments in self._calls:
            flat, given, at = arguments(numbers), [], 0
            for shape in shapes:
                count = 1
                for extent in shape:
                    count *= extent
                given.append(flat[at:at + count].reshape(shape) if shape else float(flat[at]))
                at += count
            value = np.ravel(np.asarray(function(*given), dtype=float))
            if len(value) != size:
                raise ValueError(f"the numeric function {getattr(function, '__name__', function)!r} returned {len(value)} "
                                 f"numbers, expected {size}")
            result.append(value)
        return np.concatenate(result)

    def at_start(self, values: Mapping) -> list:
        """Values of the inputs at a start, where the first step begins to look; what is not known there is 0."""
        found = self.values(np.array([values.get(name, 0.0) for name in self._used], dtype=float))
        return np.where(np.isfinite(found), found, 0.0).tolist()

    def core(self):
        """As C++ takes it."""
        return core.StepInputs(self.names, self.at_stages)

    def at_stages(self, coordinates, unknowns):
        """(t, x, v, z) to the values, for a system with these coordinates and unknowns."""
        places = self._places(list(coordinates), list(unknowns))
        for name in self._used:
            if name not in places:
                raise ExperimentError(f"a numeric function takes {name}, which stands nowhere else in the equations: it is "
                                      "not known in a step")
        where = [places[name] for name in self._used]

        def ask(t, x, v, z):
            groups = {"t": (t,), "x": x, "v": v, "z": z}
            return self.values(np.array([groups[group][k] for group, k in where], dtype=float))

        return ask

    def __repr__(self):
        return f"StepInputs({self.method!r}, {self.names})"

    def __reduce__(self):
        return (_Lost, (self.method, self.names))


class _Lost(StepInputs):
    """What is left of numeric functions in a pickle."""

    def __init__(self, method, names):
        self.method, self.names = method, names

    def core(self):
        raise ExperimentError([("/method", "was pickled without its numeric functions, which cannot be: make it anew")])

    def __repr__(self):
        return f"{self.method!r} with numeric functions that were not pickled"
