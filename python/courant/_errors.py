"""What goes wrong."""

from __future__ import annotations


class ExperimentError(ValueError):
    """An experiment cannot be carried out as it is written.

    Attributes
    ----------
    problems : list of (str, str)
        Where it is, a JSON pointer such as ``/system/hamiltonian``, and what is wrong there. All problems at once.
    """

    def __init__(self, problems):
        if isinstance(problems, str):
            problems = [("", problems)]
        self.problems = [(str(where), str(what)) for where, what in problems]
        super().__init__("\n".join(f"{where}: {what}" if where else what for where, what in self.problems))

    def __reduce__(self):
        return (type(self), (self.problems,))


class SolveError(RuntimeError):
    """The equations of a step have no solution that was found."""


class Interrupted(KeyboardInterrupt):
    """A run was interrupted; ``run`` is what there was of it."""

    def __init__(self, run):
        super().__init__(run.message)
        self.run = run


class TraceError(TypeError):
    """A function does something with a number that is not known while it is traced.

    The message has the line and says what to write in its place.
    """
