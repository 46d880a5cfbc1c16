"""Classes to derive from. Methods are called with traced arrays, as often as formulas are needed, never in a step."""

from __future__ import annotations

import numpy as np

from courant import _courant as core


def _name(self, name):
    return name or type(self).__name__


# What C++ holds of an object is made anew from the arguments that its base was made with.

def _again(cls, base, arguments, state):
    made = cls.__new__(cls)
    base.__init__(made, **arguments)
    made.__dict__.update(state)
    return made


def _reduce(base):
    def reduce(self):
        state = dict(self.__dict__)
        return (_again, (type(self), base, state.pop("_made_with"), state))

    return reduce


class Manifold(core.Manifold):
    """A manifold of one's own: points x in R^N, tangent vectors v in R^Ñ.

    Parameters
    ----------
    dimension : int
    ambient_dimension : int, optional
        N; the dimension by default.
    tangent_dimension : int, optional
        Ñ; N by default.
    name : str, optional

    To define: ``retract(self, x, v)``, ``frame(self, x)`` (N × Ñ: v ↦ ẋ), ``coframe(self, x)`` (Ñ × N, its left inverse),
    and where N > n ``constraint(self, x)``, which vanishes on the manifold. On an open subset of Rⁿ frame and coframe are
    the identity unless they are defined. May define: ``inverse_retract(self, x, y)``, ``is_geodesic(self)``,
    ``injectivity_radius(self, x)`` and ``separation(self, x, y)``, the last two of numbers. ``super()`` has the defaults.
    :func:`courant.laws` measures whether they fit together.

    Examples
    --------
    >>> class Sphere(courant.Manifold):
    ...     def __init__(self): super().__init__(2, 3)
    ...     def retract(self, x, v): y = x + v; return y / np.sqrt(y @ y)
    ...     def inverse_retract(self, x, y): return y / (x @ y) - x
    ...     def frame(self, x): return np.eye(3) - np.outer(x, x)
    ...     coframe = frame
    ...     def constraint(self, x): return [x @ x - 1]
    """

    def __init__(self, dimension, ambient_dimension=None, tangent_dimension=None, *, name=None):
        self._made_with = dict(dimension=dimension, ambient_dimension=ambient_dimension, tangent_dimension=tangent_dimension, name=name)
        N = dimension if ambient_dimension is None else ambient_dimension
        super().__init__(_name(self, name), dimension, N, N if tangent_dimension is None else tangent_dimension)


def _space(manifold):
    return core.Euclidean(manifold) if isinstance(manifold, (int, np.integer)) else manifold


class DiracStructure(core.DiracStructure):
    """A Dirac structure of one's own: equations in (v, α) that are linear in them.

    Parameters
    ----------
    manifold : Manifold or int
        An int n stands for Rⁿ.
    equations : int, optional
        How many; Ñ by default.
    ports : int
        How many port variables u.

    To define: ``membership(self, x, v, alpha)``, with ``u`` behind it where there are ports: what vanishes on the structure.
    May define: ``is_dirac(self)``, False for one that is only coisotropic.
    """

    def __init__(self, manifold, equations=None, ports=0, *, name=None):
        self._made_with = dict(manifold=manifold, equations=equations, ports=ports, name=name)
        manifold = _space(manifold)
        count = manifold.tangent_dimension if equations is None else equations
        super().__init__(_name(self, name), manifold, ports, count)


class ImplicitSystem(core.ImplicitSystem):
    """An implicit system of one's own: F(x, v, z, t) = 0.

    Parameters
    ----------
    manifold : Manifold or int
        An int n stands for Rⁿ.
    equations : int
    unknowns : int or sequence of str
        z: unknowns without derivative.
    coordinates : sequence of str, optional
        Names; x[0], x[1], … by default.

    To define: ``residual(self, x, v, z, t)``. May define: ``energy(self, x, z, t)``.
    """

    def __init__(self, manifold, equations, unknowns=(), coordinates=(), *, names=()):
        self._made_with = dict(manifold=manifold, equations=equations, unknowns=unknowns, coordinates=coordinates, names=names)
        if isinstance(unknowns, (int, np.integer)):
            unknowns = [f"z[{i}]" for i in range(unknowns)]
        super().__init__(_space(manifold), equations, list(unknowns), list(coordinates), list(names))


class DiscretizationMap(core.DiscretizationMap):
    """A discretization map of one's own: (x, v) ↦ (x⁻, x⁺).

    Parameters
    ----------
    manifold : Manifold
    order : int
    symmetric : bool
    stage_time : float
        Where between t and t + h the system is evaluated.

    To define: ``forward(self, x, v)``; may define: ``inverse(self, x0, x1)``. The class itself, or an object on Q, may
    stand as ``"discretization"`` of a method; on T*Q its cotangent lift is taken.
    """

    def __init__(self, manifold, order=1, symmetric=False, stage_time=0.5, *, name=None):
        self._made_with = dict(manifold=manifold, order=order, symmetric=symmetric, stage_time=stage_time, name=name)
        super().__init__(_name(self, name), _space(manifold), order, symmetric, stage_time)


class Projector(core.Projector):
    """A projector of one's own: the directions along which points are brought to M_f.

    Parameters
    ----------
    name : str, optional

    To define: ``directions(self, x, tangents, conormals)``, a matrix of d columns; ``tangents`` is Ñ × Ñ, ``conormals``
    is Ñ × d.
    """

    def __init__(self, *, name=None):
        self._made_with = dict(name=name)
        super().__init__(_name(self, name))


class Integrator(core.Integrator):
    """A method of one's own.

    Parameters
    ----------
    system : ImplicitSystem
    order : int
    symmetric : bool

    To define: ``step(self, t, x, h)``, which returns the next x. It is called in every step with numbers, and the GIL is
    held then: some microseconds a step. The class itself may stand as ``"method"`` of an experiment.
    """

    def __init__(self, system, order=1, symmetric=False, *, name=None):
        self._made_with = dict(system=system, order=order, symmetric=symmetric, name=name)
        super().__init__(system, _name(self, name), order, symmetric)


for _class in (Manifold, DiracStructure, ImplicitSystem, DiscretizationMap, Projector, Integrator):
    setattr(_class, "__reduce__", _reduce(_class))


def laws(obj, **at):
    """Measures the laws of an object.

    Parameters
    ----------
    obj : Manifold, DiracStructure, DiscretizationMap, Projector, Integrator
    **at
        Of a projector: ``manifold``, ``x``, ``conormals`` (d × Ñ). Of an integrator: ``x``, ``step``, ``t``.

    Returns
    -------
    list of Law
        Each with ``law``, ``passed``, ``defect``, ``bound``, ``where``, ``subject``.
    """
    if isinstance(obj, core.Manifold):
        return core.laws_of_manifold(obj)
    if isinstance(obj, core.DiracStructure):
        return core.laws_of_structure(obj)
    if isinstance(obj, core.DiscretizationMap):
        return core.laws_of_map(obj)
    if isinstance(obj, core.Projector):
        return core.laws_of_projector(obj, at["manifold"], np.asarray(at["x"], float), np.atleast_2d(at["conormals"]))
    if isinstance(obj, core.Integrator):
        return core.laws_of_integrator(obj, np.asarray(at["x"], float), float(at.get("t", 0.0)), float(at["step"]))
    raise TypeError(f"{obj!r} has no laws; expected a manifold, a structure, a map, a projector or an integrator")


def register(noun, word, factory, keys=None, summary="a class of Python"):
    """Makes a class a word of experiments.

    Parameters
    ----------
    noun : {"manifold", "structure", "system", "discretization", "projector", "method"}
    word : str
        What ``"type"`` says.
    factory : class or callable
        Called with the keys beside ``"type"``.
    keys : dict, optional
        Names of the keys, with their defaults; None for one that is required.
    summary : str
        One line, for catalogues.

    Examples
    --------
    >>> courant.register("manifold", "python-sphere", Sphere)
    """
    core.register(noun, word, factory, dict(keys or {}), summary)
