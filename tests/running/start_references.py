#!/usr/bin/env python3
"""Writes starts.json beside this file: starts as people type them, rounded, far away and in part held, and the nearest
consistent ones, found by SciPy (SLSQP from many guesses, then Newton's method on the conditions of optimality).

    tests/running/start_references.py

Positions first: |q - q0| is least where phi(q) = 0. There velocities and momenta: (v - v0) g (v - v0) is least where
(dphi/dq) v = 0, and (p - p0) inverse(g) (p - p0) where (dphi/dq) inverse(g) p = 0. Nothing here knows of Courant.
"""
import json
import pathlib

import numpy as np
from scipy import optimize

RNG = np.random.default_rng(20261127)


class Body:
    """q in R^n, phi(q) = 0, one-forms mu(q) v = 0 beside it, and the metric g(q)."""

    def __init__(self, name, system, names, phi, metric, samples, forms=None, far=0.3, dots="velocity"):
        self.name, self.system, self.names, self.phi, self.samples = name, system, names, phi, samples
        self.n = len(samples(RNG))
        self.metric = metric if callable(metric) else (lambda q: np.asarray(metric, float))
        self.forms = forms or (lambda q: np.zeros((0, self.n)))
        self.far, self.motion = far, dots

    def jacobian(self, f, q):
        h = 1e-20
        return np.array([np.imag(f(q + 1j * h * e)) / h for e in np.eye(self.n)]).T.reshape(-1, self.n)

    def conditions(self, q):
        return np.vstack([self.jacobian(self.phi, q), self.forms(q)])


def on_set(body, q, held):
    """Newton's method onto phi = 0 with the held entries fixed; None where it does not converge."""
    free = [i for i in range(body.n) if i not in held]
    for _ in range(60):
        f = np.real(body.phi(q))
        if f.size == 0 or np.abs(f).max() < 1e-14:
            return q
        step, *_ = np.linalg.lstsq(body.jacobian(body.phi, q)[:, free], f, rcond=None)
        q = q.copy()
        q[free] -= step
        if np.abs(q).max() > 1e6:
            return None
    return q if np.abs(np.real(body.phi(q))).max() < 1e-10 else None


def polish(body, q, q0, held):
    """Newton's method on q - q0 + (dphi)^T l = 0, phi = 0, by differences of the first."""
    free = [i for i in range(body.n) if i not in held]
    J = body.jacobian(body.phi, q)[:, free]
    if J.shape[0] == 0:
        return q0, True
    multipliers, *_ = np.linalg.lstsq(J.T, -(q - q0)[free], rcond=None)

    def kkt(u):
        there = q.copy()
        there[free] = u[: len(free)]
        return np.concatenate(
            [(there - q0)[free] + body.jacobian(body.phi, there)[:, free].T @ u[len(free):], np.real(body.phi(there))])

    found = optimize.root(kkt, np.concatenate([q[free], multipliers]), method="lm", options={"xtol": 1e-15, "ftol": 1e-15})
    there = q.copy()
    there[free] = found.x[: len(free)]
    return there, np.abs(kkt(found.x)).max() < 1e-11


def nearest(body, q0, held):
    """The nearest point, and whether it is clearly nearer than any other minimum that was found."""
    if np.real(body.phi(q0)).size == 0:
        return q0, True
    free = [i for i in range(body.n) if i not in held]
    minima = []
    for guess in range(24):
        start = q0.copy()
        if guess:
            start[free] += RNG.normal(size=len(free)) * 0.3 * (1 + np.abs(q0[free]))
        if on_set(body, start, held) is None:
            continue
        found = optimize.minimize(
            lambda u: 0.5 * np.sum((u - q0[free]) ** 2), start[free], jac=lambda u: u - q0[free], method="SLSQP",
            constraints={"type": "eq", "fun": lambda u: np.real(body.phi(put(q0, free, u))),
                         "jac": lambda u: body.jacobian(body.phi, put(q0, free, u))[:, free]},
            options={"ftol": 1e-15, "maxiter": 300})
        q, proven = polish(body, put(q0, free, found.x), q0, held)
        if proven and np.abs(np.real(body.phi(q))).max() < 1e-11:
            minima.append((np.linalg.norm(q - q0), q))
    if not minima:
        return None, False
    minima.sort(key=lambda m: m[0])
    best = minima[0]
    other = [d for d, q in minima if np.linalg.norm(q - best[1]) > 1e-5]
    return best[1], not other or other[0] > 1.02 * best[0] + 1e-9


def put(q0, free, u):
    q = q0.copy()
    q[free] = u
    return q


def least(metric, conditions, given, held):
    """min (w - given) metric (w - given), conditions w = 0, held entries as they are."""
    n = len(given)
    rows = np.vstack([conditions, np.eye(n)[list(held)]]) if held else conditions
    right = np.concatenate([np.zeros(len(conditions)), given[list(held)]]) if held else np.zeros(len(conditions))
    root = np.linalg.cholesky(metric)  # w - given = root^-T s
    back = np.linalg.inv(root).T
    s, *_ = np.linalg.lstsq(rows @ back, right - rows @ given, rcond=None)
    w = given + back @ s
    return w if np.abs(rows @ w - right).max(initial=0.0) < 1e-9 * (1 + np.abs(given).max()) else None


def motion_at(body, q, given, held):
    g = body.metric(q)
    C = body.conditions(q)
    if body.motion == "velocity":
        return least(g, C, given, held)
    if body.motion == "momentum":
        return least(np.linalg.inv(g), C @ np.linalg.inv(g), given, held)
    return given


def starts(body, rounded, far, held):
    found = []
    kinds = ["rounded"] * rounded + ["far"] * far + ["held"] * held
    for kind in kinds:
        for _ in range(50):
            q = on_set(body, body.samples(RNG), [])
            if q is None:
                continue
            w = motion_at(body, q, RNG.normal(size=body.n), [])
            hold_q, hold_w = [], []
            if kind == "rounded":
                digits = int(RNG.integers(3, 6))
                q0, w0 = np.round(q, digits), np.round(w, digits)
            else:
                q0 = np.round(q + body.far * RNG.normal(size=body.n), 6)
                w0 = np.round(w + 0.5 * RNG.normal(size=body.n), 6)
            if kind == "held":
                hold_q = [int(RNG.integers(body.n))]
                hold_w = [int(RNG.integers(body.n))] if RNG.random() < 0.5 else []
                q0[hold_q] = np.round(q[hold_q], 6)
            there, clear = nearest(body, q0, hold_q)
            if there is None or not clear:
                continue
            C = body.conditions(there)
            if C.shape[0] and np.linalg.svd(C, compute_uv=False).min() < 0.05:
                continue  # nearly singular: another subject
            motion = motion_at(body, there, w0, hold_w)
            if motion is None:
                continue
            found.append({"kind": kind, "q": q0.tolist(), "w": w0.tolist(), "hold_q": hold_q, "hold_w": hold_w,
                          "nearest_q": there.tolist(), "nearest_w": motion.tolist()})
            break
    return found


def mechanical(names, **keys):
    return {"type": "mechanical", "coordinates": names, **keys}


def stack(*rows):
    return lambda q: np.array([row(q) for row in rows])


def nothing(q):
    return np.zeros(0)


sin, cos = np.sin, np.cos


def four_bar_metric(q):
    a, b, c, m1, m2 = 0.25, 0.6, 0.5, 0.7, 1.86
    k = m2 * a * b * cos(q[0] - q[1]) / 2
    return np.array([[(m1 / 3 + m2) * a**2, k, 0], [k, m2 * b**2 / 3, 0], [0, 0, 1.4 * c**2 / 3]])


BODIES = [
    Body("pendulum", mechanical(["x", "y"], potential="9.81*y", holonomic="x^2 + y^2 - 1"), ["x", "y"],
         stack(lambda q: q[0]**2 + q[1]**2 - 1), np.eye(2), lambda r: r.normal(size=2)),
    Body("pendulum of two masses, by momenta",
         mechanical(["x", "y"], metric=[2, 3], potential="9.81*y", holonomic="x^2 + y^2 - 1"), ["x", "y"],
         stack(lambda q: q[0]**2 + q[1]**2 - 1), np.diag([2.0, 3.0]), lambda r: r.normal(size=2), dots="momentum"),
    Body("ellipse", mechanical(["x", "y"], potential="9.81*y", holonomic="x^2 + 9*y^2 - 9"), ["x", "y"],
         stack(lambda q: q[0]**2 + 9 * q[1]**2 - 9), np.eye(2), lambda r: r.normal(size=2) * [3, 1], dots="momentum"),
    Body("spherical pendulum, a Lagrangian",
         {"type": "lagrangian", "coordinates": ["x", "y", "z"], "holonomic": "x^2 + y^2 + z^2 - 4",
          "lagrangian": "1.5*(x'^2 + y'^2 + z'^2) - 9.81*z"}, ["x", "y", "z"],
         stack(lambda q: q[0]**2 + q[1]**2 + q[2]**2 - 4), 3 * np.eye(3), lambda r: 2 * r.normal(size=3)),
    Body("sphere", mechanical(["x[3]"], manifold="sphere", potential="x[2]"), ["x[0]", "x[1]", "x[2]"],
         stack(lambda q: q[0]**2 + q[1]**2 + q[2]**2 - 1), np.eye(3), lambda r: r.normal(size=3), far=0.1),
    Body("double pendulum",
         mechanical(["x", "y", "u", "v"], metric=[1, 1, 2, 2], potential="9.81*(y + 2*v)",
                    holonomic=["x^2 + y^2 - 1", "(u - x)^2 + (v - y)^2 - 0.49"]), ["x", "y", "u", "v"],
         stack(lambda q: q[0]**2 + q[1]**2 - 1, lambda q: (q[2] - q[0])**2 + (q[3] - q[1])**2 - 0.49),
         np.diag([1.0, 1, 2, 2]), lambda r: r.normal(size=4), far=0.15),
    Body("slider crank, by momenta",
         mechanical(["a", "b", "s"], metric=[1, 1, 1], holonomic=["cos(a) + 3*cos(b) - s", "sin(a) - 3*sin(b)"]),
         ["a", "b", "s"],
         stack(lambda q: cos(q[0]) + 3 * cos(q[1]) - q[2], lambda q: sin(q[0]) - 3 * sin(q[1])), np.eye(3),
         lambda r: np.array([r.uniform(-3, 3), 0.1, 3.5]), dots="momentum", far=0.15),
    Body("four bars",
         mechanical(["u", "v", "w"], parameters={"a": 0.25, "b": 0.6, "c": 0.5, "d": 0.65, "m1": 0.7, "m2": 1.86},
                    metric=[["(m1/3+m2)*a^2", "m2*a*b*cos(u-v)/2", 0], ["m2*a*b*cos(u-v)/2", "m2*b^2/3", 0],
                            [0, 0, "1.4*c^2/3"]],
                    holonomic=["a*cos(u)+b*cos(v)-c*cos(w)-d", "a*sin(u)+b*sin(v)-c*sin(w)"]), ["u", "v", "w"],
         stack(lambda q: 0.25 * cos(q[0]) + 0.6 * cos(q[1]) - 0.5 * cos(q[2]) - 0.65,
               lambda q: 0.25 * sin(q[0]) + 0.6 * sin(q[1]) - 0.5 * sin(q[2])), four_bar_metric,
         lambda r: np.array([r.uniform(0.3, 2.5), 0.5, 1.5]), far=0.1),
    Body("surface of a bowl", mechanical(["x", "y", "z"], potential="z", holonomic="z - x^2 - 2*y^2 - x*y"),
         ["x", "y", "z"], stack(lambda q: q[2] - q[0]**2 - 2 * q[1]**2 - q[0] * q[1]), np.eye(3),
         lambda r: 0.5 * r.normal(size=3), far=0.2),
    Body("skate", {"type": "lagrangian", "coordinates": ["x", "y", "th"], "lagrangian": "x'^2 + y'^2 + 0.2*th'^2",
                   "nonholonomic": "x'*sin(th) - y'*cos(th)"}, ["x", "y", "th"], nothing, np.diag([2, 2, 0.4]),
         lambda r: r.normal(size=3), forms=lambda q: np.array([[sin(q[2]), -cos(q[2]), 0]])),
    Body("pendulum as equations",
         {"type": "implicit", "coordinates": ["x", "y", "v", "w"], "unknowns": ["tension"],
          "equations": ["x' - v", "y' - w", "v' + tension*x", "w' + tension*y + 1", "x^2 + y^2 - 1"]},
         ["x", "y", "v", "w"], stack(lambda q: q[0]**2 + q[1]**2 - 1, lambda q: q[0] * q[2] + q[1] * q[3]),
         np.eye(4), lambda r: np.concatenate([r.normal(size=2), 0.5 * r.normal(size=2)]), far=0.15, dots="none"),
    Body("free particle", mechanical(["x", "y"], potential="x*y"), ["x", "y"], nothing, np.eye(2),
         lambda r: r.normal(size=2)),
]


def main():
    tables = []
    for body in BODIES:
        table = starts(body, rounded=40, far=28, held=20 if body.name != "sphere" else 0)
        print(f"{body.name}: {len(table)}", flush=True)
        tables.append({"name": body.name, "system": body.system, "names": body.names, "motion": body.motion,
                       "starts": table})
    lines = ",\n".join(
        json.dumps({k: v for k, v in table.items() if k != "starts"})[:-1] + ', "starts": [\n  ' +
        ",\n  ".join(json.dumps(start) for start in table["starts"]) + "]}" for table in tables)
    pathlib.Path(__file__).with_name("starts.json").write_text("[" + lines + "]\n")


if __name__ == "__main__":
    main()
