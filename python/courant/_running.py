"""Running experiments: run, certificate, check, study, sweep, ensemble."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterable, Mapping, Sequence

import numpy as np

from courant import _courant as core
from courant._errors import ExperimentError, Interrupted
from courant._experiment import Experiment, has_objects, is_main_thread
from courant._results import Certificate, Check, Ensemble, Run, Study, Sweep


class _Bar:
    """Progress in one line, on a terminal or in a notebook, of runs of more than a second."""

    def __init__(self, stream=sys.stderr):
        self.stream = stream
        self.shown = False

    def __call__(self, step, steps, seconds, drift):
        if seconds < 1 and not self.shown:
            return
        self.shown = True
        share = step / steps if steps else 0.0
        rate = step / seconds if seconds else 0.0
        text = f"{100 * share:3.0f} % |{'█' * int(20 * share):20s}| {step}/{steps} steps, {rate:.3g}/s"
        if drift == drift:
            text += f", H − H(0) = {drift:.2g}"
        self.stream.write("\r" + text.ljust(78))
        if step >= steps:
            self.stream.write("\r" + " " * 78 + "\r")
        self.stream.flush()


def _shows_progress() -> bool:
    return sys.stderr.isatty() or "ipykernel" in sys.modules


def progress_of(progress):
    """What to call with the progress: None (as it fits where this runs), a bool, or a callable."""
    if progress is None:
        progress = _shows_progress()
    if progress is True:
        return _Bar()
    return progress or None


def carried_out(experiment: Experiment, *, backend="auto", dense_output=False, progress=None):
    """The parts of a run. An interrupt raises :class:`Interrupted`, a KeyboardInterrupt."""
    main = is_main_thread()
    parts = core.run(experiment.core, backend, dense_output, main, progress_of(progress))
    if main and core.was_interrupted():
        raise Interrupted(Run(parts, experiment))
    return parts


def run(experiment, *, folder=None, existing="refuse", backend="auto", dense_output=False, progress=None, **settings) -> Run:
    """Runs an experiment.

    Parameters
    ----------
    experiment : dict, path or Experiment
        As in a JSON file.
    folder : path, optional
        Where the files of the run go, as with ``courant run -o``; without it nothing is written.
    existing : {"refuse", "replace", "resume"}
        What becomes of a run that is in the folder already.
    backend : {"auto", "native", "interpreter"}
    dense_output : bool
        Whether ``run.curve`` is kept.
    progress : bool or callable, optional
        A bar, by default on terminals and in notebooks; or what is called with (step, steps, seconds, drift), some times a
        second. Where it returns False the run ends there, with the status ``"interrupted"`` and the rows so far.
    **settings
        Other values than those of the experiment: keys of it, parameters, initial values, ``step``, ``end``, or JSON
        pointers.

    Returns
    -------
    Run

    Raises
    ------
    ExperimentError
        With all that is wrong with the experiment. What the numerics cannot do is no error but a status.

    Examples
    --------
    >>> run = courant.run({"system": {"type": "hamiltonian", "coordinates": ["q"], "hamiltonian": "(p_q^2 + q^2)/2"},
    ...                    "initial": {"q": 1, "p_q": 0}, "method": "discretize-first", "time": {"step": 0.1, "end": 10}})
    >>> run["q"].shape
    (101,)
    """
    experiment = Experiment(experiment, **settings)
    if folder is None:
        return Run(carried_out(experiment, backend=backend, dense_output=dense_output, progress=progress), experiment)
    main = is_main_thread()
    core.run_in_folder(experiment.core, os.fspath(folder), existing, backend, main, progress_of(progress))
    if main and core.was_interrupted():
        raise KeyboardInterrupt
    return read_run(folder)


def read_run(folder) -> Run:
    """The run in a folder that ``courant run`` or :func:`run` wrote.

    Parameters
    ----------
    folder : path

    Returns
    -------
    Run

    Raises
    ------
    OSError
        Where the files of a run are not there, or damaged.
    """
    *parts, document = core.run_of_folder(os.fspath(folder))
    document.pop("$run", None)
    return Run(parts, Experiment(document))


def _document_of_system(system, guess, hold):
    names = system.coordinates
    if isinstance(guess, Mapping):
        initial = dict(guess)
    elif guess is not None:
        initial = dict(zip(names, np.ravel(guess).tolist()))
    else:
        initial = {}
    return {"system": system, "initial": initial, "hold": list(hold)}


def certificate(system, guess=None, hold=(), *, prove=False, **options) -> Certificate:
    """What the constraint algorithm finds: the ladder, the index, a consistent point.

    Parameters
    ----------
    system : Experiment, dict, path, ImplicitSystem, or callable
        A callable is ``F(t, y, yp)`` or ``F(t, y, yp, z)`` as of :func:`courant.solve_dae`.
    guess : array or dict, optional
        Where to look: a point in the order of the coordinates, or values by name. The ``initial`` of an experiment by
        default.
    hold : sequence of str
        Names of values that must not move.
    prove : bool
        Prove by arithmetic with balls that there is a consistent point, and which numbers are not zero; see `proof`.
    **options
        Of a callable: ``unknowns``, ``names``, ``yp0``, ``t``, ``parameters``.

    Returns
    -------
    Certificate
    """
    if isinstance(system, core.ImplicitSystem):
        experiment = Experiment(_document_of_system(system, guess, hold))
    elif callable(system) and not isinstance(system, Experiment):
        from courant._solve import experiment_of_dae

        experiment = experiment_of_dae(system, guess, hold=hold, **options)
    else:
        experiment = Experiment(system)
        settings: dict = {}
        if guess is not None:
            if not isinstance(guess, Mapping):
                guess = dict(zip(experiment.core.coordinates, np.ravel(guess).tolist()))
            settings["initial"] = dict(guess)
        if hold:
            settings["hold"] = list(hold)
        experiment = experiment.changed(**settings)
    return Certificate(core.certificate(experiment.core, prove))


def check(experiment, **settings) -> Check:
    """Measures the laws of the manifold, the structure, the map and the method of an experiment.

    Parameters
    ----------
    experiment : dict, path or Experiment
    **settings
        As of :func:`run`.

    Returns
    -------
    Check
        True where all laws hold.
    """
    return Check(core.check(Experiment(experiment, **settings).core))


def study(*experiments, steps=5, quantities=(), **settings) -> Study:
    """Errors of the methods of experiments at step sizes h, h/2, …

    Parameters
    ----------
    *experiments : dict, path or Experiment
    steps : int
        How many step sizes.
    quantities : sequence of str
        Whose error it is; all coordinates by default.
    **settings
        As of :func:`run`, for all of them.

    Returns
    -------
    Study
        Errors at the end, in the units of the quantities; ``orders`` are the slopes.
    """
    return Study(core.study([Experiment(one, **settings).core for one in experiments], steps, list(quantities)))


def _all_of(experiments: Sequence[Experiment], backend, threads):
    return core.run_all([one.core for one in experiments], backend, threads or os.cpu_count() or 1)


def sweep(experiment, settings: Iterable[Mapping], *, backend="auto", threads=None) -> Sweep:
    """Runs an experiment once for each setting, on several threads.

    Parameters
    ----------
    experiment : dict, path or Experiment
    settings : iterable of dict
        As keyword arguments of :func:`run`: ``[{"step": 0.1}, {"step": 0.05}]``.

    Returns
    -------
    Sweep
        A list of runs in the order of the settings. A run that cannot be made has the status ``"failed"``; a setting
        that is wrong raises ExperimentError.
    """
    settings = [dict(one) for one in settings]
    base = Experiment(experiment)
    experiments = [base.changed(**one) for one in settings]
    return Sweep([Run(parts, one) for parts, one in zip(_all_of(experiments, backend, threads), experiments)], settings)


def _varied(experiment):
    ensemble = experiment.document.get("ensemble")
    return ensemble.get("values", ()) if isinstance(ensemble, Mapping) else ()


def ensemble(experiment, starts=None, *, backend="auto", threads=None) -> Ensemble:
    """Runs an experiment from many starts.

    Parameters
    ----------
    experiment : dict, path or Experiment
    starts : dict of str to array, pandas.DataFrame, or array (members, coordinates), optional
        Initial values and parameters by name, one a member; an array has a row a member, in the order of the
        coordinates. They stand for the ``ensemble`` of the experiment, which is run where there are none.

    Returns
    -------
    Ensemble
        ``values`` is (members, rows, columns); a member has the bits of its own run.

    Raises
    ------
    ExperimentError
        With all that is wrong. What the numerics cannot do is the status of a member.

    Examples
    --------
    >>> courant.ensemble(experiment, {"q": [1.0, 0.5], "k": [1.0, 4.0]})["q"].shape
    (2, 101)
    """
    experiment = Experiment(experiment)
    if starts is not None:
        if hasattr(starts, "to_dict") and not isinstance(starts, Mapping):
            starts = starts.to_dict("list")
        if not isinstance(starts, Mapping):
            starts = dict(zip(experiment.core.coordinates, np.asarray(starts, dtype=float).T))
        values = {name: np.asarray(column, dtype=float).tolist() for name, column in starts.items()}
        experiment = experiment.changed(ensemble={"values": values})
    if has_objects(experiment.document) and not all(name in experiment.core.coordinates for name in _varied(experiment)):
        raise ExperimentError([("/ensemble", "varies more than coordinates of an experiment with objects of Python; "
                                "expected coordinates alone, or courant.sweep")])
    main = is_main_thread()
    parts = core.run_ensemble(experiment.core, backend, threads or os.cpu_count() or 1, main)
    if main and core.was_interrupted():
        raise KeyboardInterrupt
    return Ensemble(*parts)
