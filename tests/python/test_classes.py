"""Classes of Python: their laws, and that they are as good as those of C++."""

import gc
import weakref

import numpy as np
import pytest

import courant


class Sphere(courant.Manifold):
    """S² with the projective retraction, as courant.Sphere(2, "projective")."""

    def __init__(self):
        super().__init__(2, 3)

    def retract(self, x, v):
        y = x + v
        return y / np.sqrt(y @ y)

    def inverse_retract(self, x, y):
        return y / (x @ y) - x

    def frame(self, x):
        return np.eye(3) - np.outer(x, x)

    coframe = frame

    def constraint(self, x):
        return [x @ x - 1]

    def injectivity_radius(self, x):
        return 1.0


class Poincare(courant.Manifold):
    """The upper half plane, as an open subset of R²."""

    def __init__(self):
        super().__init__(2)

    def retract(self, x, v):
        return np.array([x[0] + v[0], x[1] * np.exp(v[1] / x[1])])

    def inverse_retract(self, x, y):
        return np.array([y[0] - x[0], x[1] * np.log(y[1] / x[1])])

    def frame(self, x):
        return np.eye(2)

    coframe = frame


class Pendulum(courant.ImplicitSystem):
    def __init__(self):
        super().__init__(4, 5, unknowns=["T"], coordinates=["x", "y", "v", "w"])

    def residual(self, x, v, z, t):
        a, b, c, d = x
        return [v[0] - c, v[1] - d, v[2] + z[0]*a, v[3] + z[0]*b + 1, a*a + b*b - 1]


def test_a_manifold_keeps_its_laws():
    found = courant.laws(Sphere())
    assert len(found) >= 8
    assert [law.law for law in found if not law.passed] == []
    assert "Sphere" in found[0].subject


def test_a_planted_fault_breaks_a_law():
    class Wrong(Sphere):
        def inverse_retract(self, x, y):
            return y - x

    assert any(law.law.startswith("M4") for law in courant.laws(Wrong()) if not law.passed)


def test_what_is_missing_is_said():
    class Missing(courant.Manifold):
        def __init__(self):
            super().__init__(1)

    with pytest.raises(NotImplementedError, match="Missing.retract is missing"):
        Missing().retract([0.0], [1.0])


def spherical(manifold):
    return {"system": {"type": "hamiltonian", "coordinates": ["x[3]"],
                       "manifold": {"type": "cotangent-bundle", "base": manifold},
                       "hamiltonian": "dot(p_x, p_x)/2 + x[2] + 0.3*x[0]*x[1]"},
            "initial": {"x": [0.6, 0.0, -0.8], "p_x": [0.4, 1.0, 0.3]},
            "method": "discretize-first", "time": {"step": 0.01, "end": 1}}


@pytest.mark.parametrize("backend", ["interpreter", "native"])
def test_a_manifold_of_python_has_the_bits_of_that_of_cpp(backend):
    ours = courant.run(spherical(Sphere()), backend=backend)
    theirs = courant.run(spherical({"type": "sphere", "retraction": "projective"}), backend=backend)
    assert ours.success and theirs.success
    assert ours.names == theirs.names and (ours.rows == theirs.rows).all()
    object_of_cpp = courant.run(spherical(courant.Sphere(2, "projective")), backend=backend)
    assert (object_of_cpp.rows == theirs.rows).all()
    assert abs((ours["x"]**2).sum(0) - 1).max() < 1e-13


def test_a_system_of_python_has_the_bits_of_that_in_words():
    words = {"type": "implicit", "coordinates": ["x", "y", "v", "w"], "unknowns": ["T"],
             "equations": ["x' - v", "y' - w", "v' + T*x", "w' + T*y + 1", "x*x + y*y - 1"]}
    rest = {"initial": {"x": 0.6, "y": -0.8, "v": 0.8, "w": 0.6}, "method": "constrain-first",
            "time": {"step": 0.02, "end": 2}}
    ours = courant.run({"system": Pendulum(), **rest}, backend="interpreter")
    theirs = courant.run({"system": words, **rest}, backend="interpreter")
    assert ours.names == theirs.names
    assert (ours.rows == theirs.rows).all()


def test_the_certificate_of_a_system():
    found = courant.certificate(Pendulum(), [0.6, -0.8, 0.8, 0.6])
    assert (found.verdict, found.index, found.degrees_of_freedom) == ("regular", 2, 2)
    assert [(level.dim_S, level.dim_M) for level in found.levels][-1] == (2, 2)
    assert found.point["x"] == 0.6


class Rotated(courant.DiracStructure):
    """The graph of the canonical two-form of R², which is Dirac; with a wrong sign it is not."""

    def __init__(self, sign=1.0):
        self.sign = sign
        super().__init__(2, 2)

    def membership(self, x, v, alpha):
        return [v[0] - alpha[1], v[1] + self.sign * alpha[0]]


def test_a_structure_keeps_its_laws_and_drives_a_system():
    assert all(law.passed for law in courant.laws(Rotated()))
    words = {"system": {"type": "hamiltonian", "coordinates": ["x[2]"], "hamiltonian": "x[0]^2/2 + x[1]^2"},
             "initial": {"x": [1.0, 0.0]}, "method": "discretize-first", "time": {"step": 0.01, "end": 1}}
    ours, theirs = ({**words, "system": {**words["system"], "structure": structure}}
                    for structure in (Rotated(), {"type": "two-form", "matrix": [[0, 1], [-1, 0]]}))
    ours, theirs = courant.run(ours), courant.run(theirs)
    assert ours.success and np.abs(ours.rows - theirs.rows).max() < 1e-13
    assert any(law.law.startswith("S2") for law in courant.laws(Rotated(-1.0)) if not law.passed)
    sol = courant.solve_hamiltonian(lambda x: x @ x/2, (0, 1), [1.0, 0.0], structure=Rotated(), step=0.01)
    assert sol.y[0, -1] == pytest.approx(np.cos(1.0), abs=1e-4)


class Midpoint(courant.DiscretizationMap):
    def __init__(self, manifold):
        super().__init__(manifold, order=2, symmetric=True)

    def forward(self, x, v):
        return x - v/2, x + v/2

    def inverse(self, x0, x1):
        return (x0 + x1)/2, x1 - x0


def oscillator(discretization):
    return {"system": {"type": "hamiltonian", "coordinates": ["q"], "hamiltonian": "(p_q^2 + q^2)/2"},
            "initial": {"q": 1, "p_q": 0},
            "method": {"type": "discretize-first", "discretization": discretization}, "time": {"step": 0.1, "end": 1}}


def test_a_map_is_lifted_as_those_of_cpp_are():
    assert all(law.passed for law in courant.laws(Midpoint(courant.Euclidean(2))))
    ours, theirs = courant.run(oscillator(Midpoint)), courant.run(oscillator("midpoint"))
    assert (ours.rows == theirs.rows).all()


class Explicit(courant.Integrator):
    """Euler's method, by numbers in every step."""

    def __init__(self, system):
        super().__init__(system, order=1)

    def step(self, t, x, h):
        return [x[0] + h*x[1], x[1] - h*x[0]]


def test_an_integrator_of_python_makes_the_steps():
    experiment = {**oscillator("midpoint"), "method": Explicit}
    run = courant.run(experiment)
    z = (1 - 0.1j)**np.arange(11)
    assert run["q"] == pytest.approx(z.real, abs=1e-14)
    assert run["p_q"] == pytest.approx(z.imag, abs=1e-14)


def test_an_integrator_that_raises_raises():
    class Raising(Explicit):
        def step(self, t, x, h):
            if t > 0.45:
                raise KeyError("mine")
            return super().step(t, x, h)

    with pytest.raises(KeyError, match="mine"):
        courant.run({**oscillator("midpoint"), "method": Raising})


class Along(courant.Projector):
    def directions(self, x, tangents, conormals):
        return conormals


def test_a_projector_keeps_its_laws():
    found = courant.laws(Along(), manifold=courant.Euclidean(3), x=[1.0, 0.0, 0.0], conormals=[[1.0, 0.0, 0.0]])
    assert all(law.passed for law in found)


def test_a_registered_class_is_a_word():
    courant.register("manifold", "sphere-of-a-test", Sphere)
    run = courant.run(spherical({"type": "sphere-of-a-test"}), backend="interpreter")
    assert run.success
    with pytest.raises(courant.ExperimentError, match="sphere-of-a-test"):
        courant.run(spherical("sphere-of-a-tset"))
    with pytest.raises(ValueError, match="sphere-of-a-test"):
        courant.register("manifold", "sphere-of-a-test", Sphere)


def test_cpp_keeps_objects_of_python_alive_and_lets_them_go():
    class Kept(Sphere):
        pass

    manifold = Kept()
    known = weakref.ref(manifold)
    bundle = courant.CotangentBundle(manifold)
    del manifold
    gc.collect()
    assert known() is not None and bundle.dimension == 4
    del bundle
    gc.collect()
    assert known() is None


def test_an_error_in_a_method_is_the_users():
    class Boom(Pendulum):
        def residual(self, x, v, z, t):
            raise RuntimeError("mine")

    with pytest.raises(RuntimeError, match="mine"):
        courant.certificate(Boom(), [0.6, -0.8, 0.8, 0.6])
