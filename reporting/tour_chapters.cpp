#include "courant/reporting/tour_chapters.hpp"

namespace courant {
namespace {

const char* const pendulum = R"json({
  "system": {
    "type": "implicit",
    "coordinates": ["x", "y", "v", "w"],
    "unknowns": ["T"],
    "equations": ["x' - v", "y' - w", "v' + T*x", "w' + T*y + 1", "x^2 + y^2 - 1"]
  },
  "initial": { "x": 0.6, "y": -0.8, "v": 0.8, "w": 0.6 }
})json";

const char* const pendulum_by_midpoint = R"json({
  "system": {
    "type": "implicit",
    "coordinates": ["x", "y", "v", "w"],
    "unknowns": ["T"],
    "equations": ["x' - v", "y' - w", "v' + T*x", "w' + T*y + 1", "x^2 + y^2 - 1"]
  },
  "initial": { "x": 0.6, "y": -0.8, "v": 0.8, "w": 0.6 },
  "method": { "type": "discretize-first", "discretization": "midpoint" },
  "time": { "step": 0.1, "end": 1 }
})json";

}  // namespace

const std::vector<TourChapter>& tour_chapters() {
  static const std::vector<TourChapter> chapters = {
      {"1-implicit",
       "Equations that are not solved for the velocity",
       "A pendulum on a rod of length 1, in Cartesian coordinates: position (x, y), velocity (v, "
       "w), "
       "and the tension T of the rod, which has no derivative. Four equations of motion, and the "
       "length.\n"
       "Together they are a subset S of the tangent bundle: the (point, velocity) that satisfy "
       "them "
       "for some T. A solution is a curve that stays in S. The points that S lies over are M₀.",
       pendulum,
       {"constraints", "-", "--level", "0"},
       "The space has 4 dimensions. What is the dimension of M₀, and in how many directions is the "
       "velocity ($x'$, $y'$, $v'$, $w'$) free at one of its points?",
       "The length takes one dimension off: 3. The four velocities are given but for T, which "
       "nothing determines yet: one direction.",
       "Leave out the last equation. What are the dimensions of S₀ and M₀?",
       "(5, 4): every point is allowed, and T is free."},

      {"2-hidden",
       "A hidden constraint",
       "A solution stays in S, so its point stays on M₀, so its velocity is tangent to M₀. That is "
       "a "
       "condition that is not among the equations: S₁ are those of S whose velocity is tangent to "
       "M₀. What S₁ lies over is M₁.\n"
       "To be tangent to M₀ means that the derivative of its equations vanishes.",
       pendulum,
       {"constraints", "-", "--level", "1"},
       "What does $x^2 + y^2 = 1$ say when it is differentiated, and $x' = v$, $y' = w$ are put "
       "in? "
       "Does "
       "it "
       "say anything of T?",
       "$x*v + y*w = 0$: the velocity is at right angles to the rod. T is not in it, so it is a "
       "second "
       "constraint on the coordinates, a hidden one, and one direction of the velocity is still "
       "free.",
       "Give the velocity (0.8, 0.7), which is not at right angles to the rod. What does the "
       "command "
       "say?",
       "It finds the nearest consistent values and says what moved. With \"hold\": [\"v\", \"w\"] "
       "the "
       "velocity stays, and the position moves further."},

      {"3-regular",
       "Where it stops",
       "The same again: M₁ is smaller than M₀, so the velocity must be tangent to M₁. S₀ ⊇ S₁ ⊇ S₂ "
       "… "
       "go on until nothing changes. The dimensions fall, so that is after finitely many steps; "
       "the "
       "number of steps is the index.",
       pendulum,
       {"constraints", "-"},
       "Differentiate $x*v + y*w = 0$, with $v' = -T*x$ and $w' = -T*y - 1$. Is there a third "
       "constraint "
       "on "
       "the coordinates?",
       "No: T is in it, and T is what it determines. With T all velocities are functions of the "
       "point. S₂ is the graph of a vector field on M₂ = M₁: the verdict is regular, the index 2, "
       "and "
       "two initial values can be chosen.",
       "Make T a coordinate rather than an unknown. What is the index now?",
       "3: one more differentiation gives $T'$. It is the differentiation index of the "
       "literature."},

      {"4-dirac",
       "A Dirac structure and an energy",
       "Where do such equations come from? From a structure D ⊂ TM ⊕ T*M, of half the dimension "
       "and "
       "equal to its own complement, and an energy: S = {v : (v, dH) ∈ D}. The canonical structure "
       "of T*Q is the graph of dq ∧ dp, and S is Hamilton's equations.",
       R"json({
  "system": { "type": "hamiltonian", "coordinates": ["q"], "hamiltonian": "p_q^2/2 + q^2/2" },
  "initial": { "q": 1, "p_q": 0 }
})json",
       {"constraints", "-"},
       "How many levels does the algorithm need for Hamilton's equations?",
       "None: a structure that is the graph of a bivector gives every covector one velocity. S₀ is "
       "a "
       "graph, M₀ is everything, the index is 0.",
       "Replace the structure by {\"type\": \"two-form\", \"matrix\": [[0, 0], [0, 0]]}, the zero "
       "form, and give \"coordinates\": [\"q\", \"p\"] and $H = p^2/2 + q^2/2$. What is S?",
       "The zero form wants dH = 0: M₀ is the origin. The velocity there has to be tangent to a "
       "point, so it is 0."},

      {"5-vortices",
       "Momenta that are functions of the position",
       "Point vortices in the plane have the Lagrangian L = Σ Γ ($x*y' - y*x'$)/2 - H(x, y), of "
       "the "
       "first order in the velocities. The momenta p = ∂L/∂$q'$ are then functions α(q) of the "
       "position, and no velocity can be found from them.",
       R"json({
  "system": { "type": "point-vortices", "strengths": [1, 1] },
  "initial": { "x": [-1, 1], "y": [0, 0] }
})json",
       {"constraints", "-"},
       "Four coordinates, four momenta. What is M₀? And what does it take to find $x'$ and $y'$?",
       "M₀ is the graph p = α(q), of dimension 4. That a solution stays on it is Γ $y'$ = ∂H/∂x "
       "and "
       "its "
       "companions: the equations of motion of the vortices, equation (10) of the paper, and what "
       "S₁ "
       "adds.",
       "Which of the constraints p = α(q) are of the first class? What would one of them mean?",
       "None: {φ_a, φ_b} = dα is regular. One of the first class would mean a velocity that "
       "nothing "
       "determines."},

      {"6-gauge",
       "Gauge",
       "When the algorithm stops with a velocity that is still free, solutions exist, and some of "
       "their components are arbitrary functions of time: gauge. In the model of Christ and Lee, z "
       "turns the plane (x, y), and $z'$ does not occur.",
       R"json({
  "system": {
    "type": "lagrangian",
    "coordinates": ["x", "y", "z"],
    "lagrangian": "((x' + z*y)^2 + (y' - z*x)^2)/2 - (x^2 + y^2)/2"
  },
  "initial": { "x": 1, "y": 0.5, "z": 0.3, "p_x": 1, "p_y": 0.5, "p_z": 0 }
})json",
       {"constraints", "-"},
       "$z'$ does not occur in L, so $p_z = 0$. What does it mean that this stays so?",
       "$p_z'$ = ∂L/∂z has to be 0: the angular momentum $x*p_y - y*p_x$ vanishes. That is kept by "
       "itself, and $z'$ stays free.",
       "Both constraints are of the first class. How many of the 4 degrees of freedom can be "
       "observed?",
       "2: each constraint of the first class makes one direction on M₁ unobservable, here those "
       "of "
       "z and of the angle of (x, y). The radius and its momentum are left."},

      {"7-inconsistent",
       "Systems without solutions",
       "Not every Lagrangian has motions. The simplest one that has none is $L = q' + q$.",
       R"json({
  "system": { "type": "lagrangian", "coordinates": ["q"], "lagrangian": "q' + q" },
  "initial": { "q": 0 }
})json",
       {"constraints", "-"},
       "p = ∂L/∂$q'$, and $p'$ = ∂L/∂q. What do they say?",
       "$p = 1$ and $p' = 1$. A momentum that is always 1 does not grow: S₁ is empty.",
       "Is $L = q' + q^2$ any better?",
       "Yes: $p = 1$ and $p' = 2*q$, so $q = 0$, and $q' = 0$: one point, at rest."},

      {"8-classes",
       "First and second class",
       "Dirac told constraints apart by their brackets {φ_a, φ_b}. Those with bracket 0 with all "
       "are "
       "of the first class; the rank of the matrix counts the second class, which comes in pairs "
       "and "
       "could be solved for. Here a particle x, a coordinate z that does not occur, and a pair y₁, "
       "y₂ "
       "of the first order.",
       R"json({
  "system": {
    "type": "lagrangian",
    "coordinates": ["x", "z", "y1", "y2"],
    "lagrangian": "x'^2/2 + y1*y2' - (y1^2 + y2^2)/2"
  },
  "initial": { "x": 0.7, "z": 0.2, "y1": 0.3, "y2": -0.4, "p_x": 0.1, "p_y2": 0.3 }
})json",
       {"constraints", "-"},
       "Three momenta are constrained. Which are of which class?",
       "$p_z$ has bracket 0 with all of them: the first class. $p_y1$ and $p_y2 - y1$ have bracket "
       "1 "
       "with "
       "each other: the second. 8 - 3 = 5 values can be chosen, 5 - 1 = 4 observed.",
       "Add $z*y1$ to the Lagrangian. What becomes of the first class?",
       "$p_z' = y1$ has to be 0, a new constraint; $y2 = 0$ and $z = 0$ follow one after the "
       "other. All six "
       "are of "
       "the second class, and z is determined."},

      {"9-discrete",
       "Discretize first, and constraints may be lost",
       "A discretization map R_d takes a velocity to a pair of points, and S to a set S_d of "
       "pairs: "
       "the steps from x₀ to x₁. The same algorithm asks from which points one can go on. Here is "
       "the "
       "pendulum by the midpoint rule: the equations are asked for at $(x_0 + x_1)/2$.",
       pendulum_by_midpoint,
       {"constraints", "-", "--discrete"},
       "Without discretization the ladder was (4,3), (3,2), (2,2). Is it the same?",
       "No: (4, 4). The midpoint is on the circle, and the ends are free; a step can be made from "
       "every point. That is Method 1, and why the paper has another.",
       "Make it \"discretization\": {\"type\": \"theta\", \"theta\": 0}, explicit Euler. What now?",
       "(4,3), (3,2), (2,2): the equations are asked for at the points themselves, and the "
       "constraint "
       "at x₀, x₁ and x₂ is found as it was by differentiation."},

      {"10-constrain",
       "Constrain first, and they are kept",
       "Method 2 takes the set S_f where the algorithm ended, and discretizes that, with a map "
       "that "
       "ends in M_f: the map of before, and a projector P. So each point satisfies all "
       "constraints, "
       "the hidden ones too.",
       R"json({
  "system": {
    "type": "implicit",
    "coordinates": ["x", "y", "v", "w"],
    "unknowns": ["T"],
    "equations": ["x' - v", "y' - w", "v' + T*x", "w' + T*y + 1", "x^2 + y^2 - 1"]
  },
  "initial": { "x": 0.6, "y": -0.8, "v": 0.8, "w": 0.6 },
  "method": { "type": "constrain-first", "discretization": "midpoint" },
  "time": { "step": 0.1, "end": 1 },
  "observe": { "length": "x^2 + y^2", "along_the_rod": "x*v + y*w" },
  "expect": [
    { "observable": "length", "max_drift": 1e-13 },
    { "observable": "along_the_rod", "max_drift": 1e-13 }
  ]
})json",
       {"run", "-"},
       "Ten steps of 0.1. How far does the length get from 1?",
       "Not at all, but for round-off: the expectations hold it to 1e-13, and the velocity along "
       "the "
       "rod too.",
       "What does Method 1 do to the length? Replace constrain-first by discretize-first.",
       "Its midpoints are on the circle and its ends are not: both expectations fail."},
  };
  return chapters;
}

}  // namespace courant
