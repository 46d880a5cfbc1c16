"""solve_dae, solve_hamiltonian, solve_lagrangian: functions of Python to experiments, experiments to solutions."""

from __future__ import annotations

import inspect
import math
from collections.abc import Callable, Mapping, Sequence

import numpy as np

from courant import _courant as core
from courant._errors import ExperimentError
from courant._experiment import Experiment
from courant._numeric import Input, StepInputs, used_by
from courant._results import Solution
from courant._running import carried_out, certificate

_DEFAULT_TOLERANCE = 1e-4
_MOST_STEPS = 1 << 20


# --- words

def _declared(name, shape):
    return name + "".join(f"[{extent}]" for extent in shape)


def _elements(name, shape):
    return [name + "".join(f"[{k}]" for k in index) for index in np.ndindex(*shape)]


def _key(values):
    """Numbers as JSON has them."""
    return np.asarray(values, dtype=float).tolist()


class _Words:
    """The variables of traced functions, and the definitions that their formulas share."""

    def __init__(self):
        self.graph = core.Graph()
        self.t = self.graph.variable("t")
        self.definitions: dict = {}
        self.count = 0
        self.all = [self.t]
        self.names = ["t"]
        self.inputs: list = []

    def variables(self, names, shape):
        made = self.graph.variables(list(names), list(shape))
        self.all += np.ravel(made).tolist()
        self.names += names
        return made

    def input_of(self, function, arguments, shape):
        """What stands for the value of a numeric function."""
        first = sum(len(one.names) for one in self.inputs)
        names = [f"numeric{first + k}" for k in range(math.prod(shape))]
        self.inputs.append(Input(names, function, arguments))
        made = self.variables(names, shape)
        return made if shape else made[()]

    @property
    def input_names(self):
        return [name for one in self.inputs for name in one.names]

    def formulas(self, outputs) -> list:
        self.count += 1
        definitions, formulas = core.formulas(outputs, f"shared{'' if self.count == 1 else f'_{self.count}'}_")
        self.definitions.update(definitions)
        return formulas


def _required(function):
    """Names of the parameters of a function that a call has to give by their places; None where nobody knows."""
    try:
        parameters = inspect.signature(function).parameters.values()
    except (TypeError, ValueError):
        return None
    return [p.name for p in parameters
            if p.kind in (p.POSITIONAL_ONLY, p.POSITIONAL_OR_KEYWORD) and p.default is p.empty]


def _called(function, what, arguments: Mapping, forms: Sequence[str], parameters: Mapping, words=None, also=()):
    """Calls a function with traced arguments: by its parameters' names, if all are known, else by how many there are.

    `forms`: the signatures that it may have, such as "q, p" and "t, q, p"; `also`: names that it may have besides.
    `words`: where numeric functions in it become inputs; None: they may not stand in it.
    """
    with used_by(words):
        return _called_plainly(function, what, arguments, forms, parameters, also)


def _called_plainly(function, what, arguments, forms, parameters, also):
    given = {}
    try:
        accepted = inspect.signature(function).parameters
        any_name = any(p.kind is p.VAR_KEYWORD for p in accepted.values())
        given = {name: value for name, value in parameters.items() if any_name or name in accepted}
    except (TypeError, ValueError):
        pass
    names = [name for name in _required(function) or [] if name not in given]
    if not names and _required(function) is None:
        names = forms[0].split(", ")
    known = {*also, *(role for form in forms for role in form.split(", "))}
    by_name = bool(names) and all(name in known for name in names)
    if by_name:
        return function(*(arguments[name] for name in names), **given)
    for form in forms:
        roles = form.split(", ")
        if len(roles) == len(names):
            return function(*(arguments[role] for role in roles), **given)
    expected = " or ".join(f"({form})" for form in forms)
    raise TypeError(f"{what} takes ({', '.join(names)}), expected {expected}")


def _scalar(value, what):
    shape = np.shape(value)
    if shape not in ((), (1,)):
        raise TypeError(f"{what} returned an array of shape {shape}, expected a number")
    return value if shape == () else value[0]


def _vector(value, what):
    if value is None:
        raise TypeError(f"{what} returned None, expected an array")
    return value


# --- time, rows, events

def _span(t_span):
    start, end = (float(t) for t in t_span)
    if not end > start:
        raise ValueError(f"t_span is ({start}, {end}), expected an end after the start")
    return start, end


def _time(start, end, steps):
    return {"start": start, "end": end, "step": (end - start) / steps}


def _events(words, events, arguments, parameters):
    if events is None:
        return {}, []
    if callable(events):
        events = [events]
    document, known = {}, []
    for i, event in enumerate(events):
        name = f"event{i}"
        value = _scalar(_called(event, f"events[{i}]", arguments, ("t, y",), parameters), f"events[{i}]")
        direction = getattr(event, "direction", 0)
        terminal = bool(getattr(event, "terminal", False))
        document[name] = {"zero": words.formulas([value])[0],
                          "direction": "rising" if direction > 0 else "falling" if direction < 0 else "either"}
        if terminal:
            document[name]["stop"] = True
        known.append((name, terminal))
    return document, known


def _kept(t_eval, times):
    """Places of the rows that were asked for: the first and the last row are always there."""
    wanted = np.asarray(t_eval, dtype=float)
    nearest = np.searchsorted(times, wanted)
    places = []
    for t, k in zip(wanted, nearest):
        around = [j for j in (k - 1, k) if 0 <= j < len(times)]
        best = min(around, key=lambda j: abs(times[j] - t), default=None)
        if best is not None and abs(times[best] - t) <= 1e-9 * max(1.0, abs(t)):
            places.append(best)
    return places


class _Chosen:
    """A number of steps, and the error that was found for it."""

    def __init__(self, steps, error):
        self.steps, self.error = steps, error


def _difference(fine, coarse, states):
    a, b = (np.array([run[1][:, run[0].index(name)] for name in states]) for run in (fine, coarse))
    m = min(a.shape[1] // 2 + 1, b.shape[1])
    scale = 1.0 + np.abs(a).max(initial=0.0, where=np.isfinite(a))
    return float(np.max(np.abs(a[:, ::2][:, :m] - b[:, :m]), initial=0.0) / scale)


def _choose_steps(document, states, start, end, tolerance, backend, order=2):
    """As many steps that those of twice the size differ by no more than the tolerance allows.

    The step is chosen once, before the run: a step that changes along the run would be another method.
    """
    def rows(steps):
        plain = {key: value for key, value in document.items() if key not in ("events", "output")}
        parts = carried_out(Experiment({**plain, "time": _time(start, end, steps)}), backend=backend, progress=False)
        return parts[3] if parts[0] == "completed" else None

    steps, coarse, error = 64, None, math.inf
    while steps <= _MOST_STEPS:
        fine = rows(steps)
        if fine is not None and coarse is not None:
            error = _difference(fine, coarse, states) / (2**order - 1)
            if error <= tolerance:
                return _Chosen(steps, error)
            # Half of the way at least; where the order shows, the whole way.
            ahead = (1.2 * error / tolerance) ** (1.0 / order) if math.isfinite(error) else 4.0
            jump = 2 ** max(0, math.ceil(math.log2(max(ahead, 1.0))) - 1) if ahead < 64 else 16
            if jump > 1:
                steps *= jump
                coarse = None
                continue
        coarse = fine
        steps *= 2
    if error == math.inf:
        return _Chosen(64, math.inf)
    return _Chosen(_MOST_STEPS, error)


def _solved(document, words, *, t_span, step, tolerance, events, t_eval, dense_output, backend, progress, states, aliases,
            arguments, parameters, places, order=2):
    start, end = _span(t_span)
    watched, known = _events(words, events, arguments, parameters)
    if words.definitions:
        document["system"]["definitions"] = words.definitions
    if watched:
        document["events"] = watched
    frozen = None
    if words.inputs:
        frozen, document = document, _with_inputs(document, words, places)
    error = None
    if step is not None:
        count = max(1, round((end - start) / float(step)))
    else:
        chosen = _choose_steps(document, states, start, end, tolerance or _DEFAULT_TOLERANCE, backend, order)
        count, error = chosen.steps, chosen.error
    document["time"] = _time(start, end, count)
    if t_eval is not None:
        t_eval = np.asarray(t_eval, dtype=float)
        if t_eval.ndim != 1 or np.any(t_eval < start) or np.any(t_eval > end) or np.any(np.diff(t_eval) <= 0):
            raise ValueError("t_eval has to rise, from t_span[0] to t_span[1] at most")
        document["output"] = {"at": t_eval.tolist()}
    experiment = Experiment(document)
    parts = carried_out(experiment, backend=backend, dense_output=dense_output, progress=progress)
    kept = None if t_eval is None else _kept(t_eval, parts[3][1][:, 0])
    # Inputs are no degrees of freedom: the certificate is that of the system with their values at the start.
    ladder = certificate({key: frozen[key] for key in ("system", "initial", "hold") if key in frozen}) if frozen else None
    return Solution(parts, experiment, states, aliases, kept, known, document["time"]["step"], error, ladder)


# --- inputs: values of numeric functions, which stand still in a step

def _with_inputs(document, words, places):
    """The experiment whose inputs are coordinates u with u' = 0, and whose method asks for their values.

    In the one that is given they are parameters.
    """
    names = words.input_names
    system = dict(document["system"])
    start = {name: value for name, value in system.pop("parameters").items()}
    initial = {**document["initial"], **start}
    system["coordinates"] = [*system["coordinates"], *names]
    if system["type"] == "implicit":
        system["equations"] = [*system["equations"], *(name + "'" for name in names)]
    else:
        momenta = system["type"] == "hamiltonian"
        if system.get("structure") is not None:
            raise TypeError("numeric functions have no place beside a structure of one's own: the forces are on T*Q")
        system["forces"] = [*system["forces"], *("0" for _ in names)]
        if not momenta:  # at rest
            system["lagrangian"] = " + ".join([system["lagrangian"], *(f"{name}'^2/2" for name in names)])
        initial.update({f"p_{name}" if momenta else name + "'": 0.0 for name in names})
        if "manifold" in system:
            lines = ["euclidean"]*len(names)
            bundle = system["manifold"]
            base = bundle["base"] if momenta else bundle
            base = {"type": "product", "factors": [base, *lines]}
            system["manifold"] = {"type": "cotangent-bundle", "base": base} if momenta else base
    method = StepInputs(document["method"], words.inputs, words.all, words.names, places)
    return {**document, "system": system, "initial": initial, "method": method,
            "hold": [*document.get("hold", []), *names]}


def _freeze(document, words, places, known):
    """Gives the inputs their values at the start, as parameters."""
    if words.inputs:
        names = words.input_names
        inputs = StepInputs(None, words.inputs, words.all, words.names, places)
        values = dict(known)
        for one in words.inputs:  # one may be an argument of the next
            found = dict(zip(names, inputs.at_start(values)))
            values.update({name: found[name] for name in one.names})
        document["system"]["parameters"] = {name: values[name] for name in names}


# --- F(t, y, y') = 0

class _Dae:
    """A traced residual: which entries of y have derivatives is seen in it."""

    def __init__(self, F, y0, yp0, unknowns, names, parameters):
        y0 = np.atleast_1d(np.asarray(y0, dtype=float))
        if y0.ndim != 1:
            raise ValueError(f"y0 has the shape {y0.shape}, expected (n,)")
        n = len(y0)
        self.names = list(names) if names is not None else [f"y{i}" for i in range(n)]
        if len(self.names) != n:
            raise ValueError(f"names are {len(self.names)}, expected {n}, one for each entry of y0")
        unknowns = [f"z{i}" for i in range(unknowns)] if isinstance(unknowns, int) else list(unknowns)
        self.words = words = _Words()
        self.arguments = {"t": words.t, "y": words.variables(self.names, [n]),
                          "yp": words.variables([name + "'" for name in self.names], [n]),
                          "z": words.variables(unknowns, [len(unknowns)])}
        forms = ("t, y, yp, z",) if unknowns else ("t, y, yp",)
        residual = _vector(_called(F, "F", self.arguments, forms, parameters, words), "F")
        used = core.variables_of(residual)
        self.differential = [name for name in self.names if name + "'" in used]
        self.algebraic = [name for name in self.names if name + "'" not in used]
        if not self.differential:
            raise ExperimentError("F has no derivative in it: no entry of yp makes a difference")
        system = {"type": "implicit", "coordinates": self.differential, "equations": words.formulas(residual)}
        if self.algebraic or unknowns:
            system["unknowns"] = self.algebraic + unknowns
        values = dict(zip(self.names, y0.tolist()))
        initial = dict(values)
        if yp0 is not None:
            yp0 = np.atleast_1d(np.asarray(yp0, dtype=float))
            initial.update({name + "'": value for name, value in zip(self.names, yp0.tolist())
                            if name in self.differential})
        self.document = {"system": system, "initial": initial}
        self.unknowns = unknowns
        known = dict(values)
        if yp0 is not None:
            known.update({name + "'": value for name, value in zip(self.names, yp0.tolist())})
        _freeze(self.document, words, self.places, known)

    def places(self, coordinates, unknowns):
        """Where a step has the numbers of the traced variables."""
        return {"t": ("t", 0), **{name: ("x", k) for k, name in enumerate(coordinates)},
                **{name + "'": ("v", k) for k, name in enumerate(coordinates)},
                **{name: ("z", k) for k, name in enumerate(unknowns)}}

    def hold(self, hold):
        names = [self.names[entry] if isinstance(entry, (int, np.integer)) else entry for entry in hold]
        if names:
            self.document["hold"] = names
        if self.words.definitions:
            self.document["system"]["definitions"] = self.words.definitions


def experiment_of_dae(F, y0, *, yp0=None, hold=(), unknowns=(), names=None, t=None, parameters=None) -> Experiment:
    """The experiment that asks for the certificate of F at y0."""
    if y0 is None:
        raise TypeError("a certificate of a function needs a guess: y0")
    dae = _Dae(F, y0, yp0, unknowns, names, parameters or {})
    dae.hold(hold)
    return Experiment(dae.document)


def solve_dae(F: Callable, t_span, y0, yp0=None, *, hold=(), unknowns=(), step=None, tolerance=None, method="auto",
              events=None, t_eval=None, dense_output=False, parameters={}, names=None, backend="auto",
              progress=None) -> Solution:
    """Solves F(t, y, y') = 0, of any index, from a start that need not be consistent.

    Parameters
    ----------
    F : callable
        ``F(t, y, yp)``, or ``F(t, y, yp, z)`` with `unknowns`; arrays in, the residual out, (r,). It is called once, with
        traced arrays: numpy's functions, loops over ranges and ``np.where`` work. Entries of y whose derivative F does not
        contain are found to be algebraic.
    t_span : (float, float)
        In the unit of time that F has; nothing is converted anywhere.
    y0 : array_like, (n,)
        Where the start is looked for. What had to move is in ``sol.ladder.moves``.
    yp0 : array_like, (n,), optional
    hold : sequence of str or int
        Entries of y0, by name or number, that must not move; it is an error if they contradict F.
    unknowns : sequence of str or int
        Names of z, or how many there are.
    step : float, optional
        In the unit of time; one size for all steps, so that the end is a whole number of them.
    tolerance : float, optional
        Without `step`: the error that a step is chosen for, next to the size of y; 1e-4 by default.
    method : str or dict
        As in an experiment; ``"auto"`` is the constraint algorithm first, then the midpoint rule on M_f.
    events : callable or sequence of callables
        ``event(t, y)``, with ``direction`` and ``terminal`` as in SciPy.
    t_eval : array_like, optional
        Times of the rows; all steps by default.
    dense_output : bool
        Whether ``sol.sol`` is made.
    parameters : dict
        Arguments of F and of events by name.
    names : sequence of str, optional
        Of the entries of y; y0, y1, … by default.

    Returns
    -------
    Solution
        SciPy's fields and shapes, and ``ladder``, ``names``, ``constraints``.

    Examples
    --------
    >>> def pendulum(t, y, yp):
    ...     x, z, v, w, T = y
    ...     return [yp[0] - v, yp[1] - w, yp[2] + T*x, yp[3] + T*z + 1, x*x + z*z - 1]
    >>> sol = courant.solve_dae(pendulum, (0, 20), [0.6, -0.8, 0.8, 0.6, 0], step=0.02)
    >>> sol.ladder.index, sol.ladder.degrees_of_freedom
    (2, 2)
    """
    dae = _Dae(F, y0, yp0, unknowns, names, parameters)
    dae.hold(hold)
    document = dae.document
    document["method"] = "constrain-first" if method == "auto" else method
    observed = dae.algebraic + dae.unknowns
    if observed:
        document["observe"] = {name: name for name in observed}
    return _solved(document, dae.words, t_span=t_span, step=step, tolerance=tolerance, events=events, t_eval=t_eval,
                   dense_output=dense_output, backend=backend, progress=progress, states=dae.names,
                   aliases={"z": dae.unknowns} if dae.unknowns else {}, arguments=dae.arguments, parameters=parameters,
                   places=dae.places)


# --- Hamiltonians and Lagrangians

class _Mechanics:
    """Words on T*Q, and the keys of constraints and forces."""

    def __init__(self, q0, manifold, components, parameters):
        self.q0 = np.asarray(q0, dtype=float)
        if self.q0.ndim == 0:
            self.q0 = self.q0[None]
        self.shape = self.q0.shape
        self.manifold = manifold
        self.parameters = parameters
        self.words = words = _Words()
        self.q_names = _elements("q", self.shape)
        # Vectors of a group have components of their own, in the algebra.
        self.is_group = components is not None and tuple(components) != self.shape
        self.fibre = tuple(components) if self.is_group else self.shape
        self.p_names = _elements("p_q", self.fibre)
        self.v_names = _elements("v_q", self.fibre) if self.is_group else [name + "'" for name in self.q_names]
        self.arguments = {"t": words.t, "q": words.variables(self.q_names, self.shape),
                          "p": words.variables(self.p_names, self.fibre),
                          "v": words.variables(self.v_names, self.fibre)}

    def traced(self, function, what, forms, words=None, also=()):
        return _called(function, what, self.arguments, forms, self.parameters, words, also)

    def constraints(self, system, holonomic, nonholonomic, forces, momenta):
        words = self.words
        if holonomic is not None:
            system["holonomic"] = words.formulas(
                _vector(self.traced(holonomic, "holonomic", ("q", "t, q")), "holonomic"))
        if nonholonomic is not None:
            system["nonholonomic"] = words.formulas(
                _vector(self.traced(nonholonomic, "nonholonomic", ("q, v", "t, q, v")), "nonholonomic"))
        if forces is not None:
            forms = ("q, p", "t, q, p") if momenta else ("q, v", "t, q, v")
            system["forces"] = words.formulas(_vector(self.traced(forces, "forces", forms, words, ("q", "p", "v")), "forces"))

    def start(self, momenta, values):
        names = "p_q" if momenta else ("v_q" if self.is_group else "q'")
        return {"q": _key(self.q0), names: _key(np.reshape(values, self.fibre))}

    def freeze(self, document, momenta, values):
        known = dict(zip(self.q_names, np.ravel(self.q0).tolist()))
        known.update(zip(self.p_names if momenta else self.v_names, np.ravel(values).tolist()))
        _freeze(document, self.words, self.places, known)

    def places(self, coordinates, unknowns):
        """Where a step has the numbers of the traced variables; velocities of q come first in its tangent vector."""
        del unknowns
        return {"t": ("t", 0), **{name: ("v", k) for k, name in enumerate(self.v_names)},
                **{name: ("x", k) for k, name in enumerate(coordinates)}}


def _method_of(method, is_singular, holonomic, nonholonomic):
    if method != "auto":
        return method
    if nonholonomic is not None and holonomic is None:
        # Conditions on velocities are met by moving momenta (Section 8.2 of the paper).
        return {"type": "constrain-first", "projector": "momentum"}
    return "constrain-first" if is_singular or holonomic is not None else "discretize-first"


def solve_hamiltonian(H: Callable, t_span, q0, p0=None, *, manifold=None, structure=None, holonomic=None, nonholonomic=None,
                      forces=None, step=None, tolerance=None, method="auto", events=None, t_eval=None, dense_output=False,
                      hold=(), parameters={}, backend="auto", progress=None) -> Solution:
    """Solves Hamilton's equations, with constraints and forces, on any manifold.

    Parameters
    ----------
    H : callable
        ``H(q, p)`` or ``H(t, q, p)``, a number; without p0 ``H(x)`` or ``H(t, x)`` on the manifold itself. Called once
        with traced arrays of the shapes of q0 and p0.
    q0, p0 : array_like
        On SO(3) q0 is a matrix (3, 3) and p0 the momentum of the body, (3,).
    manifold : str, dict or Manifold
        Q; Rⁿ by default. ``"sphere"``, ``"so3"``, ``{"type": …}`` as in an experiment, or an object.
    structure : str, dict or DiracStructure
        On T*Q, or without p0 on the manifold; the canonical one by default.
    holonomic : callable
        ``φ(q)`` or ``φ(t, q)``: functions that vanish.
    nonholonomic : callable
        ``g(q, v)``, affine in the velocity v: functions that vanish.
    forces : callable
        ``F(q, p)`` or ``F(t, q, p)``, a covector; parameters called ``v`` get the velocity.

    The others are those of :func:`solve_dae`. ``y`` is (q, p), row-major; ``sol["q"]``, ``sol["p"]`` have their shapes.

    Examples
    --------
    >>> sol = courant.solve_hamiltonian(lambda q, p: p @ p/2 - np.cos(q[0]), (0, 100), [2.0], [0.0], step=0.1)
    >>> abs(sol.energy - sol.energy[0]).max() < 1e-2
    True
    """
    if p0 is None:
        return _solve_on_structure(H, t_span, q0, manifold=manifold, structure=structure, holonomic=holonomic, step=step,
                                   tolerance=tolerance, method=method, events=events, t_eval=t_eval,
                                   dense_output=dense_output, hold=hold, parameters=parameters, backend=backend,
                                   progress=progress)
    p0 = np.atleast_1d(np.asarray(p0, dtype=float))
    m = _Mechanics(q0, manifold, p0.shape, parameters)
    system: dict = {"type": "hamiltonian", "coordinates": [_declared("q", m.shape)]}
    if manifold is not None:
        system["manifold"] = {"type": "cotangent-bundle", "base": manifold}
    if structure is not None:
        system["structure"] = structure
    value = _scalar(m.traced(H, "H", ("q, p", "t, q, p")), "H")
    system["hamiltonian"] = m.words.formulas([value])[0]
    m.constraints(system, holonomic, nonholonomic, forces, True)
    document = {"system": system, "initial": m.start(True, p0),
                "method": _method_of(method, False, holonomic, nonholonomic)}
    m.freeze(document, True, p0)
    if hold:
        document["hold"] = list(hold)
    arguments = dict(m.arguments)
    arguments["y"] = np.concatenate([np.ravel(arguments["q"]), np.ravel(arguments["p"])])
    return _solved(document, m.words, t_span=t_span, step=step, tolerance=tolerance, events=events, t_eval=t_eval,
                   dense_output=dense_output, backend=backend, progress=progress, states=m.q_names + m.p_names,
                   aliases={"p": "p_q"}, arguments=arguments, parameters=parameters, places=m.places)


def _solve_on_structure(H, t_span, x0, *, manifold, structure, holonomic, hold, parameters, method, **options):
    x0 = np.atleast_1d(np.asarray(x0, dtype=float))
    words = _Words()
    names = _elements("x", x0.shape)
    arguments = {"t": words.t, "x": words.variables(names, x0.shape)}
    value = _scalar(_called(H, "H", arguments, ("x", "t, x"), parameters), "H")
    system: dict = {"type": "hamiltonian", "coordinates": [_declared("x", x0.shape)], "hamiltonian": words.formulas([value])[0]}
    if manifold is not None:
        system["manifold"] = manifold
    if structure is not None:
        system["structure"] = structure
    if holonomic is not None:
        system["holonomic"] = words.formulas(_vector(_called(holonomic, "holonomic", arguments, ("x", "t, x"), parameters),
                                                     "holonomic"))
    document = {"system": system, "initial": {"x": _key(x0)}, "method": _method_of(method, True, None, None)}
    if hold:
        document["hold"] = list(hold)
    arguments["y"] = np.ravel(arguments["x"])
    return _solved(document, words, states=names, aliases={"q": "x"}, arguments=arguments, parameters=parameters,
                   places=None, t_span=t_span, **options)


def solve_lagrangian(L: Callable, t_span, q0, v0, *, manifold=None, holonomic=None, nonholonomic=None, forces=None, step=None,
                     tolerance=None, method="auto", events=None, t_eval=None, dense_output=False, hold=(), parameters={},
                     backend="auto", progress=None) -> Solution:
    """Solves the Euler–Lagrange equations of a Lagrangian that may be singular, with constraints and forces.

    Parameters
    ----------
    L : callable
        ``L(q, v)`` or ``L(t, q, v)``, a number.
    q0, v0 : array_like
        On SO(3) q0 is a matrix (3, 3) and v0 the angular velocity of the body, (3,).
    forces : callable
        ``F(q, v)`` or ``F(t, q, v)``, a covector.

    The others are those of :func:`solve_hamiltonian`. ``y`` is (q, v); ``sol["p"]`` are the momenta.
    """
    v0 = np.atleast_1d(np.asarray(v0, dtype=float))
    m = _Mechanics(q0, manifold, v0.shape, parameters)
    system: dict = {"type": "lagrangian", "coordinates": [_declared("q", m.shape)]}
    if manifold is not None:
        system["manifold"] = manifold
    value = _scalar(m.traced(L, "L", ("q, v", "t, q, v")), "L")
    system["lagrangian"] = m.words.formulas([value])[0]
    m.constraints(system, holonomic, nonholonomic, forces, False)
    velocities = [f"v{i}" for i in range(len(m.v_names))]
    document = {"system": system, "initial": m.start(False, v0), "method": _method_of(method, True, holonomic, nonholonomic),
                "observe": dict(zip(velocities, m.v_names))}
    m.freeze(document, False, v0)
    if hold:
        document["hold"] = list(hold)
    arguments = dict(m.arguments)
    arguments["y"] = np.concatenate([np.ravel(arguments["q"]), np.ravel(arguments["v"])])
    return _solved(document, m.words, t_span=t_span, step=step, tolerance=tolerance, events=events, t_eval=t_eval,
                   dense_output=dense_output, backend=backend, progress=progress, states=m.q_names + velocities,
                   aliases={"p": "p_q", "v": velocities}, arguments=arguments, parameters=parameters, places=m.places)
