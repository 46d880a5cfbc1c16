"""Robots from files."""

import os

import pytest

import courant

CORPUS = os.path.join(os.path.dirname(__file__), "..", "corpus", "robots")


def test_a_robot_is_loaded_and_runs():
    with pytest.warns(UserWarning, match="no file of a robot says how long"):
        robot = courant.load(os.path.join(CORPUS, "two_rods.xml"), time={"step": 1e-3, "end": 1})
    run = courant.run(robot)
    assert run["shoulder"][-1] == pytest.approx(2.74045160307, abs=1e-5)     # by MuJoCo 2.2.2


def test_included_files_are_those_beside_the_file():
    with pytest.warns(UserWarning, match=r"line 21: \(leg.xml, line 3\) limits"):
        robot = courant.load(os.path.join(CORPUS, "leg_with_defaults.xml"))
    assert set(robot.document["system"]["joints"]) == {"hip_x", "hip_y", "knee"}


def test_what_is_wrong_has_its_line(tmp_path):
    path = tmp_path / "robot.urdf"
    path.write_text("<robot name='r'>\n</robot>")
    with pytest.raises(courant.ExperimentError, match="line 1: .*expected at least one"):
        courant.load(path)


def test_a_mechanism_is_a_dictionary():
    system = {"gravity": [0, 0, -10], "bodies": {"rod": {"mass": 3, "center": [1, 0, 0]}},
              "joints": {"A": {"type": "revolute", "parent": "ground", "child": "rod", "axis": [0, 1, 0]}}}
    run = courant.run(courant.mechanism(system, initial={"A": 0, "A'": 0}, time={"step": 1e-3, "end": 0.1},
                                        method={"type": "constrain-first", "discretization": "midpoint"}))
    assert run["A"][-1] == pytest.approx(10*0.1**2/2, rel=1e-4)       # falls as a point
