"""Functions of numpy on traced arrays, against numpy itself on numbers."""

import math

import numpy as np
import pytest

import courant
from courant import _courant as core

A = np.array([[2.0, 1.0, 0.3], [1.0, 3.0, 0.1], [0.2, 0.0, 1.0]])
X = np.array([0.3, 0.7, 0.5])

FUNCTIONS = {
    "sum of squares": lambda x: np.sum(x**2),
    "matmul": lambda x: x @ A @ x,
    "matrix times vector": lambda x: A @ x,
    "vector times matrix": lambda x: x @ A,
    "dot": lambda x: np.dot(x, A @ x),
    "method dot": lambda x: x.dot(A).dot(x),
    "cross": lambda x: np.cross(x, [1.0, 2.0, 3.0]),
    "norm": lambda x: np.linalg.norm(x),
    "norm by rows": lambda x: np.linalg.norm(np.outer(x, x), axis=1),
    "outer": lambda x: np.outer(x, x) @ x,
    "elementwise": lambda x: np.sin(x) * np.exp(-x) + np.sqrt(x) / np.cosh(x) - np.tanh(x) ** 3,
    "inverse functions": lambda x: np.arcsin(x) + np.arccos(x) * np.arctan(x) + np.arcsinh(x) + np.arctanh(x),
    "arctan2": lambda x: np.arctan2(x[0], x[1]),
    "hypot": lambda x: np.hypot(x[0], x[1]),
    "logarithms": lambda x: np.log(x) + np.log1p(x) + np.log10(x) + np.log2(x),
    "exponentials": lambda x: np.expm1(x) + np.exp2(x),
    "powers": lambda x: x**0.5 + x**-2 + 2.0**x + np.power(x, 3) + x**1.5 + x ** x[0],
    "scalar of numpy": lambda x: np.float64(2.0) * x[0] + np.float64(1.0) / x[1],
    "array of numbers and expressions": lambda x: np.sin(np.array([x[0], x[1]])) * 2,
    "where": lambda x: np.where(x > 0.4, x, -x),
    "where of a number": lambda x: np.where(x[0] > 0.4, x[0], x[1] ** 2),
    "conditions": lambda x: np.where((x > 0.4) & (x < 0.6), 1.0, 0.0) + np.where((x < 0.4) | (x > 0.6), 2.0, 0.0),
    "not": lambda x: np.where(~(x > 0.4), x, 0.0),
    "maximum": lambda x: np.maximum(x, 0.4) - np.minimum(x, 0.6) + np.max(x) - x.min(),
    "clip": lambda x: np.clip(x, 0.4, 0.6),
    "abs and sign": lambda x: np.abs(x - 0.4) + abs(x[0] - 1) + np.sign(x - 0.4),
    "mean": lambda x: np.mean(x) + x.mean() + x.sum() + np.prod(x),
    "cumsum": lambda x: np.cumsum(x),
    "diff": lambda x: np.diff(x),
    "concatenate": lambda x: np.concatenate([[0.0], x, x**2]),
    "stack": lambda x: np.stack([x, 2 * x]) @ x,
    "reshape": lambda x: np.reshape(np.outer(x, x), (9,))[2:5],
    "transpose": lambda x: (np.outer(x, A @ x).T @ x),
    "trace": lambda x: np.trace(np.outer(x, x)),
    "einsum": lambda x: np.einsum("i,ij,j->", x, A, x),
    "einsum of a matrix": lambda x: np.einsum("ij,j->i", A, x),
    "inverse": lambda x: np.linalg.inv(np.outer(x, x) + A) @ x,
    "determinant": lambda x: np.linalg.det(np.outer(x, x) + A),
    "solve": lambda x: np.linalg.solve(np.outer(x, x) + A, x),
    "solve of four": lambda x: np.linalg.solve(np.diag(np.append(x, 2.0)) + np.ones((4, 4)), np.ones(4)),
    "zeros_like": lambda x: _assigned(x),
    "loop": lambda x: sum(x[i] * x[j] for i in range(3) for j in range(i)),
    "unpacking": lambda x: _unpacked(*x),
    "kron": lambda x: np.kron(x, [1.0, 2.0]),
    "roll": lambda x: np.roll(x, 1) * x,
    "degrees": lambda x: np.cos(np.deg2rad(x)),
    "square and reciprocal": lambda x: np.square(x) + np.reciprocal(x) + np.cbrt(x),
}


def _assigned(x):
    r = np.zeros_like(x)
    r[0] = x[1]
    r[1:] = x[:2] ** 2
    return r


def _unpacked(a, b, c):
    return [a * b, c - a]


def traced(f, x=X):
    names = [f"x{i}" for i in range(len(x))]
    variables = core.Graph().variables(names, [len(x)])
    return core.Function(f(variables), variables)(x)


@pytest.mark.parametrize("name", FUNCTIONS)
def test_numpy_on_traced_arrays_is_numpy(name):
    f = FUNCTIONS[name]
    assert traced(f) == pytest.approx(np.ravel(f(X)), rel=1e-13, abs=1e-14)


@pytest.mark.parametrize("name", FUNCTIONS)
def test_formulas_read_back_to_the_same_numbers(name):
    """Through the text of an experiment, whose observables are the formulas: the same bits as by the graph."""
    f = FUNCTIONS[name]
    variables = core.Graph().variables([f"x{i}" for i in range(3)], [3])
    definitions, formulas = core.formulas(f(variables), "d")
    run = courant.run({
        "system": {"type": "implicit", "coordinates": ["x0", "x1", "x2"], "equations": ["x0'", "x1'", "x2'"],
                   "definitions": dict(definitions)},
        "initial": {f"x{i}": float(X[i]) for i in range(3)},
        "observe": {f"o{i}": formula for i, formula in enumerate(formulas)}})
    expected = traced(f)
    assert [run[f"o{i}"][0] for i in range(len(formulas))] == expected.tolist()


def shared(x):
    for _ in range(60):
        x = np.sin(x) * x + x
    return x


def test_what_is_shared_is_written_once():
    variables = core.Graph().variables(["x0", "x1", "x2"], [3])
    definitions, formulas = core.formulas(shared(variables), "d")
    assert sum(len(text) for _, text in definitions) + sum(map(len, formulas)) < 20000


def refused(f):
    variables = core.Graph().variables(["x0", "x1", "x2"], [3])
    with pytest.raises(courant.TraceError) as caught:
        f(variables)
    return str(caught.value)


def branching(x):
    if x[0] > 0:
        return x
    return -x


def test_a_branch_says_the_line_and_what_to_write():
    message = refused(branching)
    assert "test_trace.py, line " in message and "`if x[0] > 0:`" in message and "np.where" in message


@pytest.mark.parametrize("f, words", [
    (lambda x: math.sin(x[0]), "np.sin"),
    (lambda x: max(x[0], x[1]), "np.maximum"),
    (lambda x: float(x[0]), "functions of numpy"),
    (lambda x: np.sort(x), "np.sort"),
    (lambda x: np.interp(x, [0, 1], [0, 1]), "tables"),
    (lambda x: np.floor(x), "jumps"),
    (lambda x: x[0] > 0 and x[1] > 0, "Write &"),
    (lambda x: np.linalg.eigvalsh(np.outer(x, x)), "np.eigvalsh"),
])
def test_what_cannot_be_traced_says_what_to_write(f, words):
    assert words in refused(f)


def test_an_array_of_floats_cannot_hold_expressions():
    def f(x):
        r = np.zeros(3)
        r[0] = x[0]

    assert "np.zeros_like" in refused(f)


def test_zeros_of_courant_can_hold_expressions():
    def f(x):
        r = courant.zeros(2)
        r[1] = x[0]
        return r

    assert traced(f).tolist() == [0.0, X[0]]
