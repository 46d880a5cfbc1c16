"""Tracing: numpy's functions on numbers that are not known yet.

A function of a user is called once, with arrays of :class:`courant.Expr`. What it returns are the formulas of an
experiment. Whatever numpy does by elements, and linear algebra of small arrays, goes through; what asks for a value
(``if``, ``float``, sorting) raises :class:`TraceError` with the line.
"""

from __future__ import annotations

import functools
import itertools
import linecache
import operator
import os
import re
import sys

import numpy as np

from courant import _courant as core
from courant._errors import TraceError

__all__ = ["TracedArray", "where", "zeros"]

_HERE = os.path.dirname(os.path.abspath(__file__))
_NUMPY = os.path.dirname(os.path.abspath(np.__file__))


# --- what cannot be traced, and where

def _place():
    """The line of the user's that is being carried out, as ``file.py, line 12: code``."""
    frame = sys._getframe(1)
    while frame is not None:
        name = frame.f_code.co_filename
        if not name.startswith((_HERE, _NUMPY)) and not name.startswith("<__array"):
            code = linecache.getline(name, frame.f_lineno).strip()
            where = f"{os.path.basename(name)}, line {frame.f_lineno}"
            return f"{where}: `{code}`" if code else where, code
        frame = frame.f_back
    return "a function", ""


def _refuse(what, instead):
    place, _ = _place()
    raise TraceError(f"{place}: {what}. {instead}")


def refuse_truth():
    """Called where an expression is asked whether it is true."""
    _, code = _place()
    instead = "Write np.where(condition, a, b), which takes both."
    if code.startswith("while "):
        instead = "Loops need a number of turns that is known: write for i in range(n)."
    elif re.search(r"(?<![.\w])max\(", code):
        instead = "Write np.maximum(a, b)."
    elif re.search(r"(?<![.\w])min\(", code):
        instead = "Write np.minimum(a, b)."
    elif " and " in code or " or " in code or " not " in code:
        instead = "Write & for and, | for or, ~ for not, each side in parentheses."
    _refuse("whether this holds is not known while the function is traced", instead)


def refuse_number():
    """Called where an expression is asked for its value."""
    _, code = _place()
    if "math." in code:
        instead = "Write np." + code.split("math.")[1].split("(")[0] + ", which works on traced numbers."
    elif "=" in code and "[" in code.split("=")[0]:
        instead = ("An array of floats cannot hold it: make the array by np.array([...]), np.zeros_like(q) of an argument, "
                   "or courant.zeros(n).")
    else:
        instead = "Use functions of numpy, and arrays made of the arguments."
    _refuse("a number is asked for that is not known while the function is traced", instead)


def refuse_numeric():
    """Called where a numeric function is used that has no place there."""
    _refuse("a numeric function has values and no formula, and here derivatives are needed",
            "Use it in forces, or in F of solve_dae.")


# --- functions by elements

def _sum_power(x, k):
    return x**k


def _hypot(a, b):
    return core.sqrt(a * a + b * b)


def _floor_free(name):
    def refuse(*_args, **_kwargs):
        _refuse(f"np.{name} has jumps, and no derivative", "Use np.where on what it depends on, or an event.")

    return refuse


def _and(a, b):
    if core.is_expr(a):
        return a & b if core.is_expr(b) else a if b else False
    return b if a else False


def _or(a, b):
    if core.is_expr(a):
        return a | b if core.is_expr(b) else True if b else a
    return True if a else b


def _not(a):
    return ~a if core.is_expr(a) else not a


_UFUNCS: dict = {
    np.add: operator.add, np.subtract: operator.sub, np.multiply: operator.mul, np.divide: operator.truediv,
    np.true_divide: operator.truediv, np.negative: operator.neg, np.positive: operator.pos, np.power: _sum_power,
    np.float_power: _sum_power, np.absolute: core.absolute, np.fabs: core.absolute, np.sign: core.sign,
    np.square: core.square, np.sqrt: core.sqrt, np.cbrt: lambda x: core.sign(x) * core.absolute(x) ** (1.0 / 3.0),
    np.reciprocal: lambda x: 1.0 / x,
    np.exp: core.exp, np.exp2: lambda x: core.exp(x * float(np.log(2.0))), np.expm1: lambda x: core.exp(x) - 1.0,
    np.log: core.log, np.log2: lambda x: core.log(x) / float(np.log(2.0)),
    np.log10: lambda x: core.log(x) / float(np.log(10.0)), np.log1p: lambda x: core.log(1.0 + x),
    np.sin: core.sin, np.cos: core.cos, np.tan: core.tan, np.arcsin: core.arcsin, np.arccos: core.arccos,
    np.arctan: core.arctan, np.arctan2: core.arctan2, np.sinh: core.sinh, np.cosh: core.cosh, np.tanh: core.tanh,
    np.arcsinh: lambda x: core.log(x + core.sqrt(x * x + 1.0)),
    np.arccosh: lambda x: core.log(x + core.sqrt(x * x - 1.0)),
    np.arctanh: lambda x: 0.5 * core.log((1.0 + x) / (1.0 - x)),
    np.hypot: _hypot, np.deg2rad: lambda x: x * (np.pi / 180.0), np.radians: lambda x: x * (np.pi / 180.0),
    np.rad2deg: lambda x: x * (180.0 / np.pi), np.degrees: lambda x: x * (180.0 / np.pi),
    np.maximum: core.maximum, np.minimum: core.minimum, np.fmax: core.maximum, np.fmin: core.minimum,
    np.less: operator.lt, np.less_equal: operator.le, np.greater: operator.gt, np.greater_equal: operator.ge,
    np.equal: operator.eq, np.not_equal: operator.ne, np.logical_and: _and, np.logical_or: _or, np.logical_not: _not,
    np.bitwise_and: _and, np.bitwise_or: _or, np.invert: _not,
    np.heaviside: lambda x, h: core.select(x < 0.0, 0.0, core.select(x > 0.0, 1.0, h)),
    np.conjugate: lambda x: x,
    np.floor: _floor_free("floor"), np.ceil: _floor_free("ceil"), np.rint: _floor_free("rint"),
    np.trunc: _floor_free("trunc"), np.remainder: _floor_free("remainder"), np.fmod: _floor_free("fmod"),
}
_ELEMENTWISE: dict = {ufunc: np.frompyfunc(of, ufunc.nin, 1) for ufunc, of in _UFUNCS.items()}
# Sums and products have an identity, which those made of Python's have not.
_ELEMENTWISE[np.add] = np.add
_ELEMENTWISE[np.multiply] = np.multiply
_ELEMENTWISE[np.subtract] = np.subtract


def _plain(x):
    """As an array of objects that no rule of this file applies to."""
    if isinstance(x, TracedArray):
        return x.view(np.ndarray)
    if core.is_expr(x):
        box = np.empty((), dtype=object)
        box[()] = x
        return box
    if isinstance(x, np.ndarray):
        return x.astype(object) if x.dtype != object else x
    if isinstance(x, (list, tuple)):
        return _array(x)
    if isinstance(x, np.generic):
        return x.item()
    return x


def _array(entries):
    plain = [_plain(entry) for entry in entries]
    shapes = {np.shape(entry) for entry in plain}
    if len(shapes) > 1:
        raise ValueError(f"arrays of shapes {sorted(shapes)} side by side")
    result = np.empty((len(plain), *(shapes.pop() if shapes else ())), dtype=object)
    for i, entry in enumerate(plain):
        result[i] = entry[()] if isinstance(entry, np.ndarray) and entry.ndim == 0 else entry
    return result


def _wrap(result):
    if isinstance(result, np.ndarray) and result.dtype == object:
        return result.view(TracedArray) if result.ndim else result[()]
    if isinstance(result, (list, tuple)):
        return type(result)(_wrap(entry) for entry in result)
    return result


def _on_ufunc(_self, ufunc, method, *inputs, out=None, **kwargs):
    plain = [_plain(x) for x in inputs]
    if ufunc is np.matmul:
        if method != "__call__":
            return NotImplemented
        result = _matmul(*plain)
    else:
        of = _ELEMENTWISE.get(ufunc)
        if of is None:
            _refuse(f"np.{ufunc.__name__} is no function that formulas have",
                    "Write it by sums, products and the functions of numpy that formulas have.")
        kwargs.pop("dtype", None)
        if "where" in kwargs and kwargs["where"] is True:
            kwargs.pop("where")
        if method == "reduce" and kwargs.get("initial", 0) is np._NoValue:
            kwargs.pop("initial")
        result = getattr(of, method)(*plain, **kwargs)
    if out is not None:
        target = out[0] if isinstance(out, tuple) else out
        if target.dtype != object:
            refuse_number()
        target[...] = result
        return target
    return _wrap(result)


def _matmul(a, b):
    return np.matmul(np.asarray(a, dtype=object), np.asarray(b, dtype=object))


# --- functions of numpy that ask for values on their way

_FUNCTIONS = {}


def _function(*of):
    def keep(ours):
        for one in of:
            _FUNCTIONS[one] = ours
        return ours

    return keep


@_function(np.where)
def where(condition, x=None, y=None):
    """``np.where(condition, x, y)``, by elements: x where the condition holds, else y."""
    if x is None or y is None:
        _refuse("np.where(condition) asks which entries hold", "Write np.where(condition, a, b).")
    choose = np.frompyfunc(lambda c, a, b: core.select(c, a, b) if core.is_expr(c) else (a if c else b), 3, 1)
    return _wrap(choose(_plain(condition), _plain(x), _plain(y)))


def zeros(shape):
    """An array of zeros that can hold numbers which are not known yet."""
    return np.full(shape, 0.0, dtype=object).view(TracedArray)


@_function(np.zeros_like)
def _zeros_like(a, *_args, **kwargs):
    return zeros(kwargs.get("shape") or np.shape(_plain(a)))


@_function(np.ones_like)
def _ones_like(a, *_args, **kwargs):
    return zeros(kwargs.get("shape") or np.shape(_plain(a))) + 1.0


@_function(np.empty_like)
def _empty_like(a, *_args, **kwargs):
    return _zeros_like(a, **kwargs)


@_function(np.full_like)
def _full_like(a, value, *_args, **kwargs):
    return _zeros_like(a, **kwargs) + value


@_function(np.linalg.norm)
def _norm(x, ord=None, axis=None, keepdims=False):
    if ord not in (None, 2, "fro"):
        _refuse(f"np.linalg.norm(…, {ord!r}) is not smooth", "Write np.linalg.norm(x).")
    return np.sqrt(np.sum(_wrap(_plain(x)) ** 2, axis=axis, keepdims=keepdims))


@_function(np.dot, np.inner)
def _dot(a, b, out=None):
    a, b = _plain(a), _plain(b)
    return _wrap(np.multiply(a, b) if np.ndim(a) == 0 or np.ndim(b) == 0 else np.dot(a, b))


@_function(np.vdot)
def _vdot(a, b):
    return _dot(np.ravel(_plain(a)), np.ravel(_plain(b)))


@_function(np.max, np.amax)
def _max(a, axis=None, **kwargs):
    return np.maximum.reduce(_wrap(np.ravel(_plain(a)) if axis is None else _plain(a)), axis=axis or 0)


@_function(np.min, np.amin)
def _min(a, axis=None, **kwargs):
    return np.minimum.reduce(_wrap(np.ravel(_plain(a)) if axis is None else _plain(a)), axis=axis or 0)


@_function(np.clip)
def _clip(a, a_min=None, a_max=None, **kwargs):
    if a_min is not None:
        a = np.maximum(_wrap(_plain(a)), a_min)
    return a if a_max is None else np.minimum(_wrap(_plain(a)), a_max)


@_function(np.mean)
def _mean(a, axis=None, **kwargs):
    a = _wrap(_plain(a))
    return np.sum(a, axis=axis) / (a.size if axis is None else a.shape[axis])


def _pivoted(A, b):
    """Solves A x = b by elimination; a pivot is the first entry that is not 0 for certain."""
    A, b = _plain(A).copy(), _plain(b).copy()
    n = A.shape[0]
    for k in range(n):
        row = next((i for i in range(k, n) if core.is_expr(A[i, k]) or A[i, k] != 0), None)
        if row is None:
            raise np.linalg.LinAlgError("Singular matrix")
        if row != k:
            A[[k, row]], b[[k, row]] = A[[row, k]], b[[row, k]]
        for i in range(k + 1, n):
            if core.is_expr(A[i, k]) or A[i, k] != 0:
                factor = A[i, k] / A[k, k]
                A[i, k + 1:] = A[i, k + 1:] - factor * A[k, k + 1:]
                b[i] = b[i] - factor * b[k]
    for k in reversed(range(n)):
        for j in range(k + 1, n):
            b[k] = b[k] - A[k, j] * b[j]
        b[k] = b[k] / A[k, k]
    return b


def _minor(A, i, j):
    return np.delete(np.delete(A, i, 0), j, 1)


def _determinant(A):
    n = A.shape[0]
    if n == 0:
        return 1.0
    if n == 1:
        return A[0, 0]
    return functools.reduce(operator.add, ((-1.0) ** j * A[0, j] * _determinant(_minor(A, 0, j)) for j in range(n)))


@_function(np.linalg.det)
def _det(a):
    A = _plain(a)
    if A.shape[0] > 6:
        _refuse("np.linalg.det of more than 6 rows is traced as too long a formula", "Use np.linalg.solve.")
    return _determinant(A)


@_function(np.linalg.inv)
def _inv(a):
    A = _plain(a)
    n = A.shape[0]
    if n > 3:
        return _wrap(_pivoted(A, np.eye(n).astype(object)))
    det = _determinant(A)
    return _wrap(np.array([[(-1.0) ** (i + j) * _determinant(_minor(A, j, i)) / det for j in range(n)] for i in range(n)],
                          dtype=object).reshape(n, n))


@_function(np.linalg.solve)
def _solve(a, b):
    A, b = _plain(a), _plain(b)
    if A.shape[0] <= 3:
        return _wrap(np.dot(_plain(_inv(A)), b))
    return _wrap(_pivoted(A, b))


@_function(np.einsum)
def _einsum(subscripts, *operands, **_kwargs):
    arrays = [_plain(x) for x in operands]
    terms, _, result = subscripts.replace(" ", "").partition("->")
    terms = terms.split(",")
    letters = sorted(set("".join(terms)))
    if "->" not in subscripts:
        result = "".join(c for c in letters if "".join(terms).count(c) == 1)
    sizes = {c: n for term, x in zip(terms, arrays) for c, n in zip(term, x.shape)}
    summed = [c for c in letters if c not in result]
    out = np.empty([sizes[c] for c in result], dtype=object)
    for place in itertools.product(*(range(sizes[c]) for c in result)):
        at = dict(zip(result, place))
        total = 0.0
        for inner in itertools.product(*(range(sizes[c]) for c in summed)):
            at.update(zip(summed, inner))
            total = total + functools.reduce(operator.mul,
                                             (x[tuple(at[c] for c in term)] for term, x in zip(terms, arrays)))
        out[place] = total
    return _wrap(out)


_VALUES = {np.sort, np.argsort, np.argmax, np.argmin, np.searchsorted, np.interp, np.unique, np.nonzero, np.round, np.any,
           np.all, np.allclose, np.isclose, np.array_equal, np.linalg.eig, np.linalg.eigh, np.linalg.eigvals,
           np.linalg.eigvalsh, np.linalg.svd, np.linalg.qr, np.linalg.cholesky, np.linalg.lstsq, np.linalg.pinv,
           np.linalg.matrix_rank}
_INSTEAD = {np.interp: "Give the table as \"tables\" of the experiment, or write the interpolation by np.where.",
            np.linalg.lstsq: "Solve the normal equations by np.linalg.solve.",
            np.linalg.pinv: "Write np.linalg.inv(A.T @ A) @ A.T."}


def _deep(x):
    if isinstance(x, TracedArray) or core.is_expr(x):
        return _plain(x)
    if isinstance(x, (list, tuple)):
        return type(x)(_deep(entry) for entry in x)
    return x


def _on_function(_self, function, _types, args, kwargs):
    ours = _FUNCTIONS.get(function)
    if ours is not None:
        return ours(*args, **kwargs)
    if function in _VALUES:
        _refuse(f"np.{function.__name__} asks for numbers that are not known while the function is traced",
                _INSTEAD.get(function, "Write it by functions that need no comparison, or np.where."))
    return _wrap(function(*_deep(args), **{key: _deep(value) for key, value in kwargs.items()}))


class TracedArray(np.ndarray):
    """An array of numbers that are not known yet; numpy's functions work on it."""

    __array_priority__ = 1000.0
    __array_ufunc__ = _on_ufunc
    __array_function__ = _on_function

    def dot(self, other, out=None):
        return _dot(self, other)

    def max(self, axis=None, **kwargs):
        return _max(self, axis, **kwargs)

    def min(self, axis=None, **kwargs):
        return _min(self, axis, **kwargs)

    def mean(self, axis=None, **kwargs):
        return _mean(self, axis, **kwargs)

    def __matmul__(self, other):
        return _wrap(_matmul(_plain(self), _plain(other)))

    def __rmatmul__(self, other):
        return _wrap(_matmul(_plain(other), _plain(self)))


def _method(of):
    return lambda self, *others: of(self, *others)


setattr(core.Expr, "__array_ufunc__", _on_ufunc)
setattr(core.Expr, "__array_function__", _on_function)
# Arrays of objects, which np.array([q[0], 1.0]) makes, call methods of these names.
for _name in ("sqrt", "exp", "log", "sin", "cos", "tan", "arcsin", "arccos", "arctan", "sinh", "cosh", "tanh", "square",
              "sign", "arctan2", "absolute", "maximum", "minimum"):
    setattr(core.Expr, _name, _method(getattr(core, _name)))
setattr(core.Expr, "fabs", _method(core.absolute))
setattr(core.Expr, "hypot", _method(_hypot))
setattr(core.Expr, "conjugate", lambda self: self)
