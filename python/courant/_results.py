"""What comes out: certificates, runs, solutions, studies."""

from __future__ import annotations

import html
from collections.abc import Mapping
from typing import Any

import numpy as np

from courant import _courant as core
from courant._figures import house_axes


def _gathered(names, rows, name):
    """The column of a name, or the array of the columns name[0], name[1][2], …: times last."""
    if name in names:
        return rows[:, names.index(name)]
    places = [(i, column) for i, column in enumerate(names) if column.startswith(name + "[") and column.endswith("]")]
    if not places:
        raise KeyError(f"{name!r} is no column; there are {', '.join(names)}")
    indices = [tuple(int(k) for k in column[len(name) + 1:-1].split("][")) for _, column in places]
    shape = tuple(np.max(indices, axis=0) + 1)
    first = places[0][0]
    if len(shape) == 1 and [i for i, _ in places] == list(range(first, first + len(places))):
        return rows[:, first:first + len(places)].T  # a view
    result = np.full((*shape, len(rows)), np.nan)
    for (i, _), index in zip(places, indices):
        result[index] = rows[:, i]
    return result


class Table:
    """Named columns.

    Attributes
    ----------
    names : list of str
    rows : ndarray, (m, len(names))
    """

    def __init__(self, names, rows):
        self.names = list(names)
        self.rows = rows

    @property
    def t(self) -> np.ndarray:
        return self["t"]

    def __getitem__(self, name: str) -> np.ndarray:
        return _gathered(self.names, self.rows, name)

    def __contains__(self, name) -> bool:
        return name in self.names or any(column.startswith(f"{name}[") for column in self.names)

    def __len__(self) -> int:
        return len(self.rows)

    def to_dataframe(self):
        """As a ``pandas.DataFrame`` with the time as its index."""
        import pandas

        return pandas.DataFrame(self.rows, columns=self.names).set_index("t")

    def __repr__(self):
        return f"Table({len(self)} rows of {', '.join(self.names)})"


class Level:
    """S_k over M_k: ``k``, ``dim_S``, ``dim_M``, ``fibre``, ``gap``, ``residual``."""

    def __init__(self, level: Mapping[str, Any]):
        self.__dict__.update(level)

    def __repr__(self):
        return f"Level(k={self.k}, dim_S={self.dim_S}, dim_M={self.dim_M})"

    def __eq__(self, other):
        return isinstance(other, Level) and self.__dict__ == other.__dict__

    __hash__ = None  # type: ignore[assignment]


class Certificate:
    """What the constraint algorithm found: S_f over M_f near a consistent point.

    Attributes
    ----------
    verdict : str
        ``"regular"``, ``"gauge"``, ``"inconsistent"``, ``"rank-change"`` or ``"not-reached"``.
    index : int or None
        The smallest k with S_{k+1} = S_k and M_{k+1} = M_k.
    degrees_of_freedom, gauge_dimension : int or None
        dim M_f, and how many directions of the velocity are free there.
    levels : list of Level
    point : dict of str to float
        The consistent point, by the names of the system.
    moved : float
        How far it is from what was given.
    moves : list of dict
        What was given and had to move: ``name``, ``from``, ``to``.
    constraints : list of str
        Formulas of the constraints, hidden ones included, that vanish on M_f.
    doubts : list of str
        Why the verdict is not certain; ``ambiguous`` is true exactly if there is one.
    proof : dict or None
        Where one was asked for: whether all is ``proved``, whether there is a ``point`` and in which ``radius``, how many
        numbers are proved to be ``not_zero``, how many count as ``zero_by_digits``, and what is ``missing``.
    reason : str
    """

    def __init__(self, found: Mapping[str, Any]):
        self.json = dict(found)
        self.verdict: str = found["verdict"]
        self.index = found.get("index")
        self.gauge_dimension = found.get("gauge_dimension")
        self.degrees_of_freedom = found.get("degrees_of_freedom")
        self.levels = [Level(level) for level in found.get("levels", [])]
        self.point = dict(found.get("consistent_point") or {})
        self.moved = found.get("moved")
        self.moves = list(found.get("moves") or [])
        self.ambiguous = bool(found.get("ambiguous"))
        self.doubts = [doubt["text"] if isinstance(doubt, Mapping) else doubt for doubt in found.get("doubts") or []]
        self.reason = found.get("reason", "")
        self.proof = found.get("proof")
        self.constraints = [entry["formula"] for entry in found.get("formulas") or []]

    @property
    def words(self) -> str:
        """The verdict as a sentence."""
        return core.ladder_words(self.json)["verdict"]

    @property
    def explanation(self) -> str:
        """The findings level by level, as ``courant constraints`` prints them."""
        return "\n".join(core.ladder_words(self.json)["explanation"])

    def __repr__(self):
        dims = " ".join(f"({level.dim_S}, {level.dim_M})" for level in self.levels)
        return (f"Certificate({self.verdict}, index {self.index}, {self.degrees_of_freedom} degrees of freedom"
                + (f", gauge {self.gauge_dimension}" if self.gauge_dimension else "") + f"; (dim S, dim M): {dims})")

    def _repr_html_(self):
        words = core.ladder_words(self.json)  # formulas in MathML
        return f"<div>{words['diagram']}<p>{html.escape(words['verdict'])}</p>{words['html']}</div>"

    def _repr_latex_(self):
        def sets(letter, key):
            parts = []
            for i, level in enumerate(self.levels):
                before = self.levels[i - 1] if i else None
                same = before is not None and getattr(before, key) == getattr(level, key)
                dim = getattr(level, key)
                parts.append((" = " if same else " \\supseteq " if i else "")
                             + f"{letter}_{{{level.k}}}^{{{'' if dim is None else dim}}}")
            return "".join(parts)

        set_as = core.latex_formula
        lines = [sets("S", "dim_S"), sets("M", "dim_M")]
        lines += [f"M_{{{entry['level']}}}:\\quad {set_as(entry['formula'])} = 0" for entry in self.json.get("formulas") or []]
        lines += [f"S_{{{step['level']}}}:\\quad {set_as(step['derivative'])} = 0 \\;\\Rightarrow\\; {set_as(step['result'])} = 0"
                  for step in self.json.get("steps") or []]
        classes = self.json.get("classes")
        if classes and classes.get("first_class") is not None:
            lines.append(f"\\text{{first class: {classes['first_class']}, second class: {classes['second_class']}}}")
        return "$\\displaystyle\\begin{array}{l} " + " \\\\ ".join(lines) + " \\end{array}$"

    def __eq__(self, other):
        return isinstance(other, Certificate) and self.json == other.json

    __hash__ = None  # type: ignore[assignment]

    def __reduce__(self):
        return (Certificate, (self.json,))


Ladder = Certificate


class Sensitivity:
    """Derivatives along a run, of the quantities ``of`` by the numbers ``by``: of the steps that it made, exact to round-off.

    Attributes
    ----------
    by, of : list of str
    t : ndarray, (m,)
    array : ndarray, (len(of), len(by), m)

    ``sensitivity["x", "L"]`` is ∂x/∂L at the rows, (m,).

    Examples
    --------
    >>> run = courant.run({"system": {"type": "hamiltonian", "parameters": {"k": 4}, "coordinates": ["q"],
    ...                               "hamiltonian": "p_q^2/2 + k*q^2/2"},
    ...                    "initial": {"q": 1, "p_q": 0}, "method": "rk4", "time": {"step": 0.01, "end": 1},
    ...                    "sensitivities": {"by": ["k", "q"]}})
    >>> round(float(run.sensitivity["q", "q"][-1]), 6)  # cos(2)
    -0.416147
    """

    def __init__(self, names, rows, by, of):
        self.by, self.of = list(by), list(of)
        self.t = rows[:, 0]
        places = [[names.index(f"d({quantity})/d({number})") for number in self.by] for quantity in self.of]
        self.array = np.moveaxis(rows[:, places], 0, -1) if self.by and self.of else np.empty(
            (len(self.of), len(self.by), len(rows)))

    def __getitem__(self, key) -> np.ndarray:
        quantity, number = key
        for name, known in ((quantity, self.of), (number, self.by)):
            if name not in known:
                raise KeyError(f"{name!r} is none of {', '.join(known)}")
        return self.array[self.of.index(quantity), self.by.index(number)]

    def jvp(self, tangent) -> dict:
        """The changes of the quantities along the run where numbers change by `tangent`.

        Parameters
        ----------
        tangent : mapping of str to float, or array-like (len(by),)
            Those that are not named do not change.

        Returns
        -------
        dict of str to ndarray, (m,)
        """
        if isinstance(tangent, Mapping):
            self._known(tangent, self.by)
            tangent = [tangent.get(name, 0.0) for name in self.by]
        changes = np.einsum("ijm,j->im", self.array, np.asarray(tangent, dtype=float))
        return dict(zip(self.of, changes))

    def vjp(self, slopes) -> dict:
        """The gradient, by the numbers, of a function of the rows.

        Parameters
        ----------
        slopes : mapping of str to array-like (m,), or array-like (len(of), m)
            The derivatives of the function by each quantity at each row.

        Returns
        -------
        dict of str to float
        """
        if isinstance(slopes, Mapping):
            self._known(slopes, self.of)
            zero = np.zeros(len(self.t))
            slopes = [np.broadcast_to(slopes.get(name, zero), len(self.t)) for name in self.of]
        gradient = np.einsum("ijm,im->j", self.array, np.asarray(slopes, dtype=float))
        return dict(zip(self.by, gradient.tolist()))

    @staticmethod
    def _known(given, known):
        for name in given:
            if name not in known:
                raise KeyError(f"{name!r} is none of {', '.join(known)}")

    def __repr__(self):
        return f"Sensitivity({len(self.t)} rows of {', '.join(self.of)} by {', '.join(self.by)})"


class Run:
    """A run: rows of numbers under names, and what it says of itself.

    Attributes
    ----------
    t : ndarray, (m,)
    names : list of str
        Of the columns; the first is ``t``.
    rows : ndarray, (m, len(names))
        What C++ wrote, without a copy.
    events : dict of str to Table
    sensitivity : Sensitivity or None
        Derivatives, where the experiment asks for them.
    status : str
        ``"completed"``, ``"failed"``, ``"interrupted"`` or ``"not-finite"``; ``message`` says why.
    summary : dict
        As in summary.json.
    ladder : Certificate
    experiment : Experiment or None

    ``run["q"]`` is the column q, or the array of the columns q[0], q[1], …, times last.
    """

    def __init__(self, parts, experiment=None):
        self.status, self.message, self.summary, (names, rows), events = parts[:5]
        self.names = list(names)
        self.rows = rows
        self.events = {name: Table(*table) for name, table in events.items()}
        self.curve = parts[5]
        self.experiment = experiment

    @property
    def t(self) -> np.ndarray:
        return self.rows[:, 0]

    @property
    def success(self) -> bool:
        return self.status == "completed"

    @property
    def as_expected(self) -> bool:
        """Whether it completed and all that its experiment expects came out."""
        return self.success and all(entry["passed"] for entry in self.summary.get("expectations", []))

    @property
    def ladder(self) -> Certificate:
        return Certificate(self.summary["ladder"])

    @property
    def energy(self):
        """H at the rows, or None where the system has no energy."""
        return self["H"] if "H" in self.names else None

    @property
    def sensitivity(self):
        """Derivatives along the run, where the experiment has ``sensitivities``; else None."""
        told = self.summary.get("sensitivities")
        if told is None:
            return None
        of = list(told["final"])
        return Sensitivity(self.names, self.rows, told["final"][of[0]] if of else (), of)

    @property
    def constraints(self) -> np.ndarray:
        """What is left of the constraints at the rows: (constraints, m)."""
        return _gathered(self.names, self.rows, "constraint") if self._has("constraint") else np.empty((0, len(self.rows)))

    def _has(self, name):
        return name in self.names or any(column.startswith(f"{name}[") for column in self.names)

    def __getitem__(self, name: str) -> np.ndarray:
        return _gathered(self.names, self.rows, name)

    def __contains__(self, name) -> bool:
        return self._has(name)

    def to_dataframe(self):
        """As a ``pandas.DataFrame`` with the time as its index."""
        return Table(self.names, self.rows).to_dataframe()

    def plot(self, *names, axes=None):
        """Columns over time by matplotlib.

        Parameters
        ----------
        *names : str
            By default the coordinates, at most six of them.
        axes : matplotlib.axes.Axes, optional

        Returns
        -------
        matplotlib.axes.Axes
        """
        if not names:
            names = tuple(name for name in self.summary.get("final", {}))[:6] or tuple(self.names[1:7])
        axes = house_axes(axes)
        for name in names:
            column = self[name]
            for i, line in enumerate(np.atleast_2d(column).reshape(-1, len(self.t))):
                axes.plot(self.t, line, lw=1.2, label=name if column.ndim == 1 else f"{name}[{i}]")
        axes.set_xlabel("t")
        axes.legend(frameon=False)
        return axes

    def __repr__(self):
        return f"{type(self).__name__}({self.status}, {len(self.rows)} rows of {', '.join(self.names[:8])}" + (
            ", …)" if len(self.names) > 8 else ")")

    def _repr_html_(self):
        title = html.escape(self.summary.get("title") or self.summary.get("system", ""))
        drift = self.summary.get("observables", {}).get("H", {}).get("max_drift")
        lines = [f"{self.summary.get('steps')} steps, {html.escape(str(self.status))}", html.escape(self.message or "")]
        if drift is not None:
            lines.append(f"max |H − H(0)| = {drift:.3g}")
        lines += [html.escape(warning) for warning in self.summary.get("warnings", [])]
        return (f"<div><b>{title}</b><br>{html.escape(self.summary.get('method', ''))}<br>"
                + "<br>".join(line for line in lines if line) + self.ladder._repr_html_() + "</div>")

    def _repr_latex_(self):
        return self.ladder._repr_latex_()

    def __getstate__(self):
        state = dict(self.__dict__)
        state["curve"] = None  # belongs to a process
        return state


class Solution(Run):
    """A run with the fields and shapes of ``scipy.integrate.solve_ivp``.

    Attributes
    ----------
    t : ndarray, (m,)
    y : ndarray, (n, m)
    sol : callable or None
        ``sol(t)`` is y at t, (n,) or (n, len(t)), by the method's own steps; with ``dense_output=True``.
    t_events, y_events : list of ndarray or None
        Times (k,) and states (k, n) of each event.
    status : int
        0: the end was reached, 1: an event ended it, -1: it failed.
    message : str
    success : bool
    names : list of str
        Of the columns of ``rows``; ``states`` are those of y.
    step, error : float
        The step that was made, and what its error was found to be where a tolerance chose it, else None.

    ``sol["q"]``, ``energy``, ``constraints``, ``ladder`` and ``to_dataframe()`` are those of :class:`Run`.
    """

    def __init__(self, parts, experiment, states, aliases, kept=None, events=(), step=None, error=None, ladder=None):
        super().__init__(parts, experiment)
        self._ladder = ladder
        self.states = list(states)
        self._aliases = dict(aliases)
        if kept is not None:
            self.rows = self.rows[kept]
        self.step = step
        self.error = error
        self.run_status = self.status
        ended = [event for event, terminal in events if terminal and len(self.events.get(event, ()))]
        self.status = -1 if self.run_status != "completed" else 1 if ended else 0
        if not self.message:
            self.message = ("An event ended the run." if self.status == 1
                            else "The end of the time was reached.")
        self.t_events = [self.events[event]["t"] if event in self.events else np.empty(0) for event, _ in events] or None
        self.y_events = [_columns(self.events[event].names, self.events[event].rows, self.states)
                         if event in self.events else np.empty((0, len(self.states))) for event, _ in events] or None

    @property
    def ladder(self) -> Certificate:
        return self._ladder or super().ladder

    @property
    def success(self) -> bool:
        return self.status >= 0

    @property
    def y(self) -> np.ndarray:
        return _columns(self.names, self.rows, self.states).T

    @property
    def sol(self):
        return None if self.curve is None else _Dense(self.curve, self.states)

    def __getitem__(self, name):
        if name == "y":
            return self.y
        if name in self._aliases:
            target = self._aliases[name]
            return super().__getitem__(target) if isinstance(target, str) else _columns(self.names, self.rows, target).T
        return super().__getitem__(name)

    def __contains__(self, name):
        return name in self._aliases or super().__contains__(name)


def _columns(names, rows, wanted):
    """(m, n); a view where the columns are side by side."""
    places = [names.index(name) for name in wanted]
    if places == list(range(places[0], places[0] + len(places))):
        return rows[:, places[0]:places[0] + len(places)]
    return rows[:, places]


class _Dense:
    """t ↦ y."""

    def __init__(self, curve, states):
        self._curve = curve
        self._places = [curve.names.index(name) for name in states]
        self.t_min, self.t_max = curve.first, curve.last

    def __call__(self, t):
        t = np.asarray(t, dtype=float)
        rows = self._curve(np.atleast_1d(t))[:, self._places]
        return rows[0] if t.ndim == 0 else rows.T


class Check:
    """The laws of the parts of an experiment.

    Attributes
    ----------
    passed : bool
    checks : list of dict
        ``subject``, ``law``, ``passed``, ``defect``, ``bound``, ``where``.
    structure, method : dict or None
    """

    def __init__(self, found):
        self.json = found
        self.passed = found["passed"]
        self.checks = found["checks"]
        self.structure = found.get("structure")
        self.method = found.get("method")

    @property
    def failed(self):
        return [entry for entry in self.checks if not entry["passed"]]

    def __bool__(self):
        return self.passed

    def __repr__(self):
        return f"Check({len(self.checks)} laws, " + ("all passed)" if self.passed else f"{len(self.failed)} failed)")

    def _repr_html_(self):
        rows = "".join(f"<tr><td>{'✓' if c['passed'] else '✗'}</td><td>{html.escape(c['subject'])}</td>"
                       f"<td>{html.escape(c['law'])}</td><td>{c['defect']}</td><td>{c['bound']}</td></tr>" for c in self.checks)
        return f"<table><tr><th></th><th>subject</th><th>law</th><th>defect</th><th>bound</th></tr>{rows}</table>"


class Study:
    """Errors against step sizes: ``methods``, each a dict with ``method``, ``order``, ``reference`` and ``rows``."""

    def __init__(self, found):
        self.json = found
        self.methods = found["methods"]

    @property
    def orders(self) -> dict:
        return {entry["method"]: entry.get("order") for entry in self.methods}

    def __repr__(self):
        return f"Study({self.orders})"

    def _repr_html_(self):
        parts = []
        for entry in self.methods:
            rows = "".join(f"<tr><td>{row['step']}</td><td>{row['error']}</td></tr>" for row in entry["rows"])
            parts.append(f"<p><b>{html.escape(entry['method'])}</b>, order {entry.get('order')}</p>"
                         f"<table><tr><th>step</th><th>error</th></tr>{rows}</table>")
        return "".join(parts)

    def _repr_latex_(self):
        def number(value):
            if value is None:
                return "-"
            digits, _, power = f"{value:.3g}".partition("e")
            return digits + (f" \\cdot 10^{{{int(power)}}}" if power else "")

        lines = []
        for entry in self.methods:
            name = entry["method"].replace("_", "\\_")
            lines.append(f"\\text{{{name}}} & \\text{{order {number(entry.get('order'))}}}")
            lines += [f"h = {number(row['step'])} & {number(row['error'])}" for row in entry["rows"]]
        return "$\\displaystyle\\begin{array}{ll} " + " \\\\ ".join(lines) + " \\end{array}$"

    def plot(self, axes=None):
        """log(error) over log(step) by matplotlib."""
        axes = house_axes(axes, figsize=(5.2, 3.8))
        for entry in self.methods:
            rows = [row for row in entry["rows"] if row["error"]]
            axes.loglog([row["step"] for row in rows], [row["error"] for row in rows], "o-", label=entry["method"])
        axes.set_xlabel("step")
        axes.set_ylabel("error")
        axes.legend(frameon=False)
        return axes


class Sweep(list):
    """Runs of one experiment with several settings; ``settings`` are those of each."""

    def __init__(self, runs, settings):
        super().__init__(runs)
        self.settings = settings

    def column(self, name: str) -> np.ndarray:
        """Last values of a quantity, one a run; NaN where a run has none."""
        return np.array([run[name][..., -1] if len(run.rows) and name in run else np.nan for run in self])

    def to_dataframe(self):
        """A row a run: settings, status, last values."""
        import pandas

        return pandas.DataFrame([{**settings, "status": run.status,
                                  **dict(zip(run.names, run.rows[-1] if len(run.rows) else []))}
                                 for settings, run in zip(self.settings, self)])


class Ensemble:
    """Many starts of one experiment.

    Attributes
    ----------
    values : ndarray, (members, rows, columns)
        NaN where a member has fewer rows.
    names : list of str
        Of the columns.
    status : list of str
        Of the members.
    messages : list of str
        Why a member did not complete.
    summary : dict
        As in ``summary.json`` of an ensemble: ``members``, ``completed``, ``statistics``, ``drift``,
        ``member_steps_per_cpu_second``.
    """

    def __init__(self, names, values, status, messages, summary):
        self.names, self.values, self.status, self.messages, self.summary = names, values, status, messages, summary

    @property
    def t(self):
        return np.nanmin(self.values[:, :, 0], axis=0)

    def __len__(self):
        return len(self.values)

    def __getitem__(self, name):
        """(members, rows), or (members, k, rows) of an array."""
        return np.array([_gathered(self.names, rows, name) for rows in self.values])

    def __repr__(self):
        return f"Ensemble{self.values.shape}"
