"""Classes of Python for tests: one of each kind, as small as they come; and an experiment."""

import courant

OSCILLATOR = {"system": {"type": "hamiltonian", "coordinates": ["q"], "parameters": {"k": 1},
                         "hamiltonian": "(p_q^2 + k*q^2)/2"},
              "initial": {"q": 1, "p_q": 0}, "method": "discretize-first", "time": {"step": 0.1, "end": 1}}


class Line(courant.Manifold):
    def __init__(self):
        super().__init__(1)

    def retract(self, x, v):
        return x + v


class Rotation(courant.DiracStructure):
    def __init__(self):
        super().__init__(2, 2)

    def membership(self, x, v, alpha):
        return [v[0] - alpha[1], v[1] + alpha[0]]


class Decay(courant.ImplicitSystem):
    def __init__(self):
        super().__init__(1, 1)

    def residual(self, x, v, z, t):
        return [v[0] + x[0]]


class Middle(courant.DiscretizationMap):
    def __init__(self, manifold):
        super().__init__(manifold, order=2, symmetric=True)

    def forward(self, x, v):
        return x - v/2, x + v/2


class Euler(courant.Integrator):
    def __init__(self, system):
        super().__init__(system)

    def step(self, t, x, h):
        return x*(1 - h)
