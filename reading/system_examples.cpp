#include "courant/reading/system_examples.hpp"

namespace courant {
namespace {

constexpr const char* kExamples = R"json({
"hamiltonian": {
  "title": "A pendulum by its angle",
  "system": { "type": "hamiltonian", "parameters": { "m": 0.5, "l": 1.2, "g": 9.81 }, "coordinates": ["q"],
    "hamiltonian": "p_q^2/(2*m*l^2) - m*g*l*cos(q)" },
  "initial": { "q": 1, "p_q": 0 },
  "method": { "type": "discretize-first", "discretization": "midpoint" },
  "time": { "step": 0.01, "end": 5 },
  "observe": { "height": "-l*cos(q)" },
  "expect": [ { "verdict": "regular" }, { "observable": "H", "max_drift": 1e-3 } ],
  "output": { "every": 1, "units": { "t": "s", "q": "rad", "H": "J", "height": "m" } } },
"lagrangian": {
  "title": "A particle in a plane field, by a Lagrangian",
  "system": { "type": "lagrangian", "parameters": { "m": 2, "k": 3, "b": 0.5 }, "coordinates": ["x", "y"],
    "lagrangian": "m*(x'^2 + y'^2)/2 + b*(x*y' - y*x')/2 - k*(x^2 + y^2)/2" },
  "initial": { "x": 1, "y": 0, "x'": 0, "y'": 0.5 },
  "method": { "type": "discretize-first", "discretization": "midpoint" },
  "time": { "step": 0.02, "end": 10 },
  "observe": { "speed": "sqrt(x'^2 + y'^2)" },
  "expect": [ { "verdict": "regular" }, { "observable": "H", "max_drift": 1e-10 } ] },
"mechanical": {
  "title": "A pendulum on a rod, by its constraint",
  "system": { "type": "mechanical", "parameters": { "m": 2, "l": 1.5, "g": 9.81 }, "coordinates": ["x", "y"],
    "metric": "m", "potential": "m*g*y", "holonomic": "(x^2 + y^2 - l^2)/2" },
  "initial": { "x": 0.9, "y": -1.2, "x'": 0, "y'": 0 },
  "method": { "type": "constrain-first", "discretization": "midpoint", "projector": "orthogonal" },
  "time": { "step": 0.01, "end": 3 },
  "observe": { "tension": "l*lambda" },
  "expect": [ { "verdict": "regular", "index": 2 }, { "max_violation": 1e-11 },
    { "observable": "H", "max_drift": 0.1 } ] },
"vakonomic": {
  "title": "The least path with a constraint on velocities",
  "system": { "type": "vakonomic", "parameters": { "m": 0.5, "k": 2 }, "coordinates": ["x", "y", "z"],
    "metric": "m", "potential": "k*(x^2 + y^2)/2", "nonholonomic": "z' - y*x'" },
  "initial": { "x": 1, "y": 0.5, "z": 0, "p_x": -0.1, "p_y": 0.15, "p_z": 0.2 },
  "method": { "type": "discretize-first", "discretization": "midpoint" },
  "time": { "step": 0.01, "end": 5 },
  "observe": { "rate": "z' - y*x'" },
  "expect": [ { "verdict": "regular" }, { "observable": "H", "max_drift": 1e-3 } ] },
"morse-family": {
  "title": "A pendulum as a Morse family: the tension T is its multiplier",
  "system": { "type": "morse-family", "parameters": { "m": 2, "l": 1.5, "g": 9.81 }, "coordinates": ["x", "y"],
    "multipliers": ["T"], "family": "(p_x^2 + p_y^2)/(2*m) + m*g*y + T*(x^2 + y^2 - l^2)/2" },
  "initial": { "x": 0.9, "y": -1.2, "p_x": 0, "p_y": 0 },
  "method": { "type": "constrain-first", "discretization": "midpoint", "projector": "orthogonal" },
  "time": { "step": 0.01, "end": 3 },
  "observe": { "tension": "T*l" },
  "expect": [ { "verdict": "regular", "index": 2 }, { "max_violation": 1e-11 } ] },
"optimal-control": {
  "title": "A cart moved with least effort",
  "system": { "type": "optimal-control", "parameters": { "m": 2, "a": 3, "b": -1.5 }, "states": ["x", "v"],
    "controls": ["u"], "dynamics": ["v", "u/m"], "cost": "u^2/2" },
  "initial": { "x": 0, "v": 0, "p_x": "a", "p_v": "b" },
  "method": { "type": "discretize-first", "discretization": "midpoint" },
  "time": { "step": 0.01, "end": 2 },
  "observe": { "effort": "u" },
  "expect": [ { "verdict": "regular" }, { "state": { "v": "(b*t - a*t^2/2)/m^2" }, "tolerance": 1e-4 },
    { "observable": "H", "max_drift": 1e-12 } ] },
"euler-poincare": {
  "title": "A heavy top: a rigid body whose weight turns with it",
  "system": { "type": "euler-poincare", "parameters": { "I": [1, 1.2, 0.6], "w": [0.1, 0.2, 1] }, "algebra": "so3",
    "lagrangian": "(I[0]*xi[0]^2 + I[1]*xi[1]^2 + I[2]*xi[2]^2)/2 - dot(w, Gamma)", "advected": ["Gamma[3]"] },
  "initial": { "mu": [0.3, -0.2, 2], "Gamma": [0, 0.6, 0.8] },
  "method": { "type": "discretize-first", "discretization": "midpoint" },
  "time": { "step": 0.01, "end": 5 },
  "observe": { "vertical": "dot(mu, Gamma)", "length": "dot(Gamma, Gamma)" },
  "expect": [ { "verdict": "regular" }, { "observable": "vertical", "max_drift": 1e-11 },
    { "observable": "H", "max_drift": 1e-9 } ] },
"port-hamiltonian": {
  "title": "A driven and damped oscillator",
  "system": { "type": "port-hamiltonian", "parameters": { "k": 2, "c": 0.5 }, "coordinates": ["q", "p"],
    "hamiltonian": "p^2/2 + k*q^2/2", "J": [[0, 1], [-1, 0]], "R": [[0, 0], [0, "c"]], "B": [[0], [1]],
    "ports": "open", "inputs": ["sin(t)"] },
  "initial": { "q": -0.4, "p": 0.8 },
  "method": { "type": "discretize-first", "discretization": "midpoint" },
  "time": { "step": 0.02, "end": 20 },
  "observe": { "power": "u*p - c*p^2" },
  "expect": [ { "verdict": "regular" },
    { "state": { "q": "0.8*sin(t) - 0.4*cos(t)", "p": "0.8*cos(t) + 0.4*sin(t)" }, "tolerance": 1e-3 } ] },
"stokes-dirac": {
  "title": "A wave on a string that is held at its left end and free at the right one",
  "system": { "type": "stokes-dirac", "parameters": { "N": 20, "rho": 2, "E": 8, "w": "pi*sqrt(E/rho)/2" },
    "complex": { "interval": { "length": 1, "cells": "N" } },
    "states": ["p", "q"], "efforts": ["v", "F"], "energy": { "p": "p^2/(2*rho)", "q": "E*q^2/2" },
    "boundary": { "left": { "v": 0 }, "right": { "F": 0 } } },
  "initial": { "p": { "form": "rho*sin(pi*x/2)" }, "q": { "form": "0" } },
  "method": { "type": "discretize-first", "discretization": "midpoint" },
  "time": { "step": 0.005, "end": 2 },
  "observe": { "end": "v[N-1]" },
  "expect": [ { "verdict": "regular" }, { "max_imbalance": 1e-12 },
    { "state": { "end": "cos(w*t)" }, "tolerance": 0.01 } ] },
"interconnection": {
  "title": "A mass on a spring, and a coil that brakes it",
  "system": { "type": "interconnection", "parameters": { "k": 1 },
    "systems": {
      "mass": { "type": "port-hamiltonian", "coordinates": ["q", "p"], "hamiltonian": "p^2/2 + q^2/2",
        "J": [[0, 1], [-1, 0]], "B": [0, 1], "port_names": ["hand"] },
      "coil": { "type": "port-hamiltonian", "coordinates": ["flux"], "hamiltonian": "flux^2/2",
        "J": [[0]], "R": [[0.5]], "B": [1], "port_names": ["clamp"] } },
    "joints": [ { "ports": ["mass_hand", "coil_clamp"], "matrix": [[0, "-k"], ["k", 0]] } ] },
  "initial": { "mass_q": 1, "mass_p": 0, "coil_flux": 0 },
  "method": { "type": "discrete-gradient" },
  "time": { "step": 0.02, "end": 10 },
  "observe": { "force": "u_mass_hand", "current": "y_coil_clamp" },
  "expect": [ { "verdict": "regular" }, { "max_imbalance": 1e-12 } ] },
"implicit": {
  "title": "A pendulum as equations in positions, velocities and the tension",
  "system": { "type": "implicit", "parameters": { "g": 9.81 }, "coordinates": ["x", "y", "v", "w"],
    "unknowns": ["tension"],
    "equations": ["x' - v", "y' - w", "v' + tension*x", "w' + tension*y + g", "x^2 + y^2 - 1"],
    "energy": "(v^2 + w^2)/2 + g*y" },
  "initial": { "x": 0.6, "y": -0.8, "v": 0.8, "w": 0.6 },
  "method": { "type": "constrain-first", "discretization": "midpoint", "projector": "orthogonal" },
  "time": { "step": 0.005, "end": 3 },
  "observe": { "length": "sqrt(x^2 + y^2)" },
  "expect": [ { "verdict": "regular", "index": 2 }, { "observable": "length", "max_drift": 1e-12 } ] },
"mechanism": {
  "title": "A crank that drives a pendulum",
  "system": { "type": "mechanism", "parameters": { "r": 0.2 }, "gravity": [0, 0, -9.81],
    "bodies": {
      "crank": { "mass": 1, "center": ["r/2", 0, 0], "inertia": [0.001, 0.01, 0.01, 0, 0, 0], "points": { "tip": ["r", 0, 0] } },
      "rod": { "mass": 0.5, "center": [0.3, 0, 0], "inertia": [0.001, 0.02, 0.02, 0, 0, 0] } },
    "joints": {
      "A": { "type": "revolute", "parent": "ground", "child": "crank", "axis": [0, 1, 0], "damping": 0.02, "torque": "0.8*sin(t)" },
      "B": { "type": "revolute", "parent": "crank", "child": "rod", "origin": { "xyz": ["r", 0, 0], "rpy": [0, 0, 0] }, "axis": [0, 1, 0] } },
    "springs": { "s": { "from": "crank.tip", "to": [0, 0, 0.4], "stiffness": 20, "rest": 0.3, "damping": 0.1 } } },
  "initial": { "A": 0.3, "B": 1, "A'": 0, "B'": 0 },
  "method": { "type": "discretize-first", "discretization": "midpoint" },
  "time": { "step": 0.005, "end": 2 },
  "observe": { "height": "crank.tip.z", "load": "norm(f_A)" },
  "expect": [ { "verdict": "regular" }, { "max_imbalance": 1e-4 } ] },
"network": {
  "title": "A series circuit that rings",
  "system": { "type": "network", "parameters": { "R": 10, "L": 1e-6, "C": 1e-9 }, "nodes": ["0", "a", "b"],
    "elements": [
      { "type": "resistor", "name": "R1", "from": "a", "to": "b", "value": "R" },
      { "type": "inductor", "name": "L1", "from": "b", "to": "0", "value": "L" },
      { "type": "capacitor", "name": "C1", "from": "a", "to": "0", "value": "C" } ] },
  "initial": { "q_C1": "C", "phi_L1": 0 },
  "method": { "type": "discretize-first", "discretization": "midpoint" },
  "time": { "step": 1e-9, "end": 1e-6 },
  "observe": { "v_C1": "v_C1", "i_R1": "i_R1" },
  "expect": [ { "verdict": "regular" }, { "observable": "v_C1", "max": 1.001, "min": -1 } ],
  "output": { "every": 1, "units": { "t": "s", "q_C1": "C", "phi_L1": "V s", "v_C1": "V", "i_R1": "A" } } },
"point-vortices": {
  "title": "Two pairs of vortices that leapfrog",
  "system": { "type": "point-vortices", "strengths": [1, 1, -1, -1] },
  "initial": { "x": [-1, 1, -1, 1], "y": [2, 2, -2, -2] },
  "method": { "type": "constrain-first", "discretization": "midpoint", "projector": "momentum" },
  "time": { "step": 1, "end": 300 },
  "observe": { "spread": "(x[1]-x[0])^2 + (y[1]-y[0])^2" },
  "expect": [ { "verdict": "regular", "index": 1 }, { "observable": "H", "max_drift": 2e-4 } ] },
"spherical-vortices": {
  "title": "Three vortices on a sphere",
  "system": { "type": "spherical-vortices", "strengths": [1, 0.5, -0.7] },
  "initial": { "x": [ ["cos(0.3)", "sin(0.3)", 0], [0, 0.6, 0.8], [-0.6, 0, 0.8] ] },
  "method": { "type": "discretize-first", "discretization": "spherical-midpoint" },
  "time": { "step": 0.05, "end": 50 },
  "observe": { "height": "sum(i, 0, 2, strengths[i]*x[i][2])" },
  "expect": [ { "verdict": "regular" }, { "observable": "height", "max_drift": 1e-12 } ] }
})json";

}  // namespace

Json system_example(const std::string& type) {
  static const Json examples = Json::parse(kExamples);
  return examples.value(type, Json());
}

}  // namespace courant
