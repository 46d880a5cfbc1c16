"""Courant: geometric integrators from Dirac structures and the constraint algorithm.

>>> import courant
>>> def pendulum(t, y, yp):
...     x, z, v, w, T = y
...     return [yp[0] - v, yp[1] - w, yp[2] + T*x, yp[3] + T*z + 1, x*x + z*z - 1]
>>> sol = courant.solve_dae(pendulum, (0, 20), [0.6, -0.8, 0.8, 0.6, 0], step=0.02)
>>> sol.ladder
Certificate(regular, index 2, 2 degrees of freedom; …)
"""

from courant._errors import ExperimentError, Interrupted, SolveError, TraceError
from courant._courant import (
    CotangentBundle, Euclidean, Expr, Hyperbolic, Law, Product, SE3, SO3, SpecialOrthogonal, Sphere, Stiefel,
    SymmetricPositiveDefinite, TangentBundle, Torus, __version__,
)
from courant._trace import TracedArray, where, zeros
from courant._numeric import numeric
from courant._classes import (
    DiracStructure, DiscretizationMap, ImplicitSystem, Integrator, Manifold, Projector, laws, register,
)
from courant._experiment import Experiment
from courant._results import Certificate, Check, Ensemble, Ladder, Level, Run, Sensitivity, Solution, Study, Sweep, Table
from courant._running import certificate, check, ensemble, read_run, run, study, sweep
from courant._solve import solve_dae, solve_hamiltonian, solve_lagrangian
from courant._files import load, mechanism
from courant import experiment

__all__ = [
    "Certificate", "Check", "CotangentBundle", "DiracStructure", "DiscretizationMap", "Ensemble", "Euclidean", "Experiment",
    "ExperimentError", "Expr", "Hyperbolic", "ImplicitSystem", "Integrator", "Interrupted",
    "Ladder", "Law", "Level", "Manifold", "Product",
    "Projector", "Run", "SE3", "SO3", "Sensitivity", "Solution", "SolveError", "SpecialOrthogonal", "Sphere", "Stiefel", "Study", "Sweep",
    "SymmetricPositiveDefinite", "Table", "TangentBundle", "Torus", "TraceError", "TracedArray", "certificate", "check",
    "ensemble", "experiment", "laws", "load", "mechanism", "numeric", "read_run", "register", "run", "solve_dae", "solve_hamiltonian",
    "solve_lagrangian", "study", "sweep", "where", "zeros", "__version__",
]
