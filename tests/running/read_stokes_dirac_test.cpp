#include <boost/test/unit_test.hpp>
#include <cmath>

#include "../reading/experiment_problems.hpp"
#include "courant/structures/stokes_dirac/stokes_dirac_system.hpp"
#include "run_in.hpp"

// Mistakes that these cases have to notice:
//  * losses are multiplied with the wrong sizes (reading/read_stokes_dirac.cpp)
//  * a mean of neighbours is a sum (reading/cell_formulas.cpp)
//  * the tangential component of a vector is its first one (reading/cell_formulas.cpp)
//  * what enters is counted by cells and not by their size on the boundary (reading/field_boundary.cpp)
//  * impedances are admittances (reading/field_boundary.cpp)
//  * places of cells are read from a complex that a region has replaced (reading/complex_keys.cpp)
BOOST_AUTO_TEST_SUITE(read_stokes_dirac_test)

using namespace courant;

namespace {

Json with_patch(Json document, const Json& patch) {
  document.merge_patch(patch);
  return document;
}

Json line_of(Index cells) {
  Json document = Json::parse(R"json({
    "system": { "type": "stokes-dirac", "parameters": { "C": 2, "L": 0.5 },
      "complex": { "interval": { "length": 1, "cells": 4 } },
      "states": ["q", "phi"], "efforts": ["V", "I"],
      "energy": { "q": "q^2/(2*C)", "phi": "phi^2/(2*L)" } },
    "initial": { "q": { "form": "C*cos(pi*x)" } },
    "method": { "type": "discretize-first", "discretization": "midpoint" },
    "time": { "step": 0.0125, "end": 0.3 } })json");
  document["system"]["complex"]["interval"]["cells"] = cells;
  return document;
}

std::string problem_of(const Json& patch) { return problems(with_patch(line_of(4), patch)); }

bool has(const std::string& text, const std::string& part) {
  const bool found = text.find(part) != std::string::npos;
  if (!found) BOOST_TEST_MESSAGE(text);
  return found;
}

struct Read {
  Experiment experiment;
  std::shared_ptr<const StokesDiracSystem> system;
};

Read read(const Json& document) {
  Read result{read_experiment(document.dump()), nullptr};
  result.system =
      std::dynamic_pointer_cast<const StokesDiracSystem>(result.experiment.model.system);
  return result;
}

// v at x, without unknowns.
VectorXd velocity(const StokesDiracSystem& system, const VectorXd& x, double t) {
  return -system.residual(x, VectorXd(VectorXd::Zero(x.size())), VectorXd(0), t);
}

// The order of the error of the modes on a line of 8 to 64 cells, steps that shrink with the cells.
double order_of_line(const Json& patch, double exact_at_0) {
  double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (const Index cells : {8, 16, 32, 64}) {
    Json document = with_patch(line_of(cells), patch);
    document["time"]["step"] = 0.3 / static_cast<double>(cells);
    const TemporaryFolder folder;
    const RunOutcome outcome = run_in(folder, document);
    BOOST_REQUIRE(outcome.status == RunStatus::completed);
    const double value = final_value(outcome, "q[0]") * 2.0 * static_cast<double>(cells) / 2.0;
    const double a = -std::log(static_cast<double>(cells)),
                 b = std::log(std::abs(value - exact_at_0));
    x += a, y += b, xx += a * a, xy += a * b;
  }
  return (4.0 * xy - x * y) / (4.0 * xx - x * x);
}

const double pi = std::acos(-1.0);

}  // namespace

// Standing waves of an open line, V = cos(pi x) cos(pi t), and one that loses R I² and G V².
BOOST_AUTO_TEST_CASE(order_in_space) {
  const double open = order_of_line(Json::object(), std::cos(0.3 * pi));
  BOOST_TEST(std::abs(open - 2.0) < 0.15, open);
  // With R/L = G/C = 0.6 all decays as exp(-0.6 t).
  const double lossy =
      order_of_line({{"system", {{"resistance", {{"q", "0.6*C"}, {"phi", "0.6*L"}}}}}},
                    std::exp(-0.18) * std::cos(0.3 * pi));
  BOOST_TEST(std::abs(lossy - 2.0) < 0.15, lossy);
}

// Written as a table of vertices and simplices, in another order, a line is the same line.
BOOST_AUTO_TEST_CASE(tables_of_simplices) {
  const auto grid = read(line_of(2));
  Json document = line_of(2);
  document["system"]["complex"] = {{"vertices", {{1.0}, {0.0}, {0.5}}},
                                   {"simplices", {{0, 2}, {2, 1}}},
                                   {"facets", {{"end", {{0}}}}}};
  document["system"]["boundary"] = {{"end", {{"I", "1 + t"}}}};
  const auto table = read(document);
  Json on_grid = line_of(2);
  on_grid["system"]["boundary"] = {{"right", {{"I", "1 + t"}}}};
  const auto same = read(on_grid);
  const VectorXd x{{0.3, -0.2, 0.9, 0.5, -0.7}};  // q at 0, 1/2, 1; phi on both edges
  const VectorXd y{{0.9, 0.3, -0.2, -0.7, 0.5}};
  const VectorXd v = velocity(*same.system, x, 2.0), w = velocity(*table.system, y, 2.0);
  BOOST_TEST((VectorXd{{w[1], w[2], w[0], w[4], w[3]}} - v).norm() < 1e-14);
  BOOST_TEST((velocity(*grid.system, x, 2.0) - v).cwiseAbs().isApprox(VectorXd{{0, 0, 3, 0, 0}}));
}

// On a rectangle of 2 × 1 cells of the sizes 0.5 × 0.75: by hand.
BOOST_AUTO_TEST_CASE(boundary_of_a_rectangle) {
  const Json document = Json::parse(R"json({
    "system": { "type": "stokes-dirac",
      "complex": { "rectangle": { "size": [1, 0.75], "cells": [2, 1] } },
      "regions": { "corner": "y < 0.1 && x < 0.5" },
      "states": ["p", "q"], "efforts": ["g", "f"], "energy": { "p": "p^2/2", "q": "q^2/2" },
      "boundary": { "left": { "g": "x + 2*y + t" }, "right": { "impedance": "4" },
                    "corner": { "f": "x" } } },
    "initial": { "p": { "form": "1" }, "q": { "form": ["2*x", "3"] } },
    "method": "discretize-first", "time": { "step": 0.1, "end": 1 } })json");
  const auto read_it = read(document);
  const StokesDirac& D = *read_it.system->stokes_dirac();
  // Vertices 0 to 5; 0 and 3 on the left have no state.
  BOOST_TEST((D.p_cells() == std::vector<Index>{1, 2, 4, 5}));
  VectorXd x(11);
  const VectorXd p{{1.0, 2.0, 3.0, 4.0}};
  x << p, VectorXd::Zero(7);
  const VectorXd e{
      {p[0] / (0.5 * 0.375), p[1] / (0.25 * 0.375), p[2] / (0.5 * 0.375), p[3] / (0.25 * 0.375)}};
  const VectorXd v = velocity(*read_it.system, x, 0.2);
  // What leaves through the right is e/4 over half its height; x = 1/2 enters through half an edge at vertex 1.
  BOOST_TEST(std::abs(v[0] - 0.5 * 0.25) < 1e-14);
  BOOST_TEST(std::abs(v[1] + e[1] / 4.0 * 0.375) < 1e-13);
  BOOST_TEST(std::abs(v[2]) < 1e-14);
  BOOST_TEST(std::abs(v[3] + e[3] / 4.0 * 0.375) < 1e-13);
  // Edges 0 and 2 lead away from the left, edge 4 from the vertex 0 up to 3.
  BOOST_TEST(std::abs(v[4] - (0.2 - e[0])) < 1e-13);
  BOOST_TEST(std::abs(v[6] - (1.5 + 0.2 - e[2])) < 1e-13);
  BOOST_TEST(std::abs(v[8] - (0.2 - 1.7)) < 1e-13);
  // Initial values: densities times dual areas, tangential components times lengths.
  const VectorXd start = read_it.experiment.initial.x.values;
  BOOST_TEST(
      (start.head(4) - VectorXd{{0.5 * 0.375, 0.25 * 0.375, 0.5 * 0.375, 0.25 * 0.375}}).norm() <
      1e-14);
  BOOST_TEST((start.tail(7) - VectorXd{{0.25, 0.75, 0.25, 0.75, 2.25, 2.25, 2.25}}).norm() < 1e-14);
}

// The energy of shallow water: g h²/2 at the vertices, h u²/2 on the edges with the mean of h.
BOOST_AUTO_TEST_CASE(regions_by_conditions_do_not_depend_on_each_other) {
  const Read line = read(with_patch(
      line_of(4),
      {{"system",
        {{"regions", {{"a", "x < 0.5"}, {"b", "x > 0.5"}, {"c", "x < 2"}, {"d", "x >= 1"}}}}}}));
  const CellComplex& complex = *line.system->stokes_dirac()->complex();
  BOOST_TEST(complex.region("a")->facets == std::vector<Index>{0});
  BOOST_TEST(complex.region("b")->facets == std::vector<Index>{4});
  BOOST_TEST(complex.region("c")->facets == (std::vector<Index>{0, 4}));
  BOOST_TEST(complex.region("d")->facets == std::vector<Index>{4});
}

BOOST_AUTO_TEST_CASE(coupled_densities) {
  Json document = line_of(2);
  document["system"]["energy"] = {{"q", "5*q^2 + x"}, {"phi", "q*phi^2/2"}};
  const auto read_it = read(document);
  const VectorXd x{{0.5, 1.5, 0.25, 0.3, 0.7}};
  const VectorXd h{{0.5 / 0.25, 1.5 / 0.5, 0.25 / 0.25}}, u{{0.3 / 0.5, 0.7 / 0.5}};
  const double expected =
      0.25 * 5 * h[0] * h[0] + 0.5 * (5 * h[1] * h[1] + 0.5) + 0.25 * (5 * h[2] * h[2] + 1.0) +
      0.5 * (h[0] + h[1]) / 2 * u[0] * u[0] / 2 + 0.5 * (h[1] + h[2]) / 2 * u[1] * u[1] / 2;
  const Expr H = read_it.system->generator(constants(x), ExprVector(0), Expr(0.0));
  BOOST_TEST(std::abs(H.value() - expected) < 1e-14);
}

// A conductor between two ends: κ |⋆σ|/|σ| (T_j - T_i) over each edge.
BOOST_AUTO_TEST_CASE(conductors) {
  Json document = line_of(2);
  document["initial"] = {{"q", {{"form", "1"}}}};
  document["system"]["states"] = {"q"};
  document["system"]["energy"] = {{"q", "q^2/2"}};
  document["system"]["conductivity"] = "3";
  const auto read_it = read(document);
  const VectorXd x{{0.5, 1.5, 0.25}}, T{{0.5 / 0.25, 1.5 / 0.5, 0.25 / 0.25}};
  const double first = 3.0 / 0.5 * (T[0] - T[1]), second = 3.0 / 0.5 * (T[1] - T[2]);
  BOOST_TEST(
      (velocity(*read_it.system, x, 0.0) - VectorXd{{-first, first - second, second}}).norm() <
      1e-13);
}

BOOST_AUTO_TEST_CASE(what_is_wrong) {
  BOOST_TEST(problem_of(Json::object()).empty());
  BOOST_TEST(has(problem_of({{"system", {{"boundary", {{"lft", {{"V", 0}}}}}}}}),
                 R"(/system/boundary/lft: there is no region "lft" (did you mean "left"?))"));
  BOOST_TEST(has(problem_of({{"system", {{"boundary", {{"left", {{"V", 0}, {"I", 0}}}}}}}}),
                 "says in 2 ways what happens there"));
  BOOST_TEST(has(problem_of({{"system", {{"boundary", {{"left", {{"W", 0}}}}}}}}), "unknown key"));
  BOOST_TEST(has(problem_of({{"system", {{"boundary", {{"left", {{"V", "q"}}}}}}}}),
                 "/system/boundary/left/V: column 1: unknown name \"q\""));
  BOOST_TEST(has(problem_of({{"system", {{"boundary", {{"left", {{"impedance", "-1"}}}}}}}}),
                 "expected more than 0"));
  BOOST_TEST(
      has(problem_of({{"system", {{"boundary", {{"left", {{"port", "W"}}}}}}}}), "\"V\" or \"I\""));
  BOOST_TEST(
      has(problem_of({{"system", {{"complex", {{"interval", {{"cells", 2.5}}}}}}}}),
          "/system/complex/interval/cells: has the value 2.5; expected whole numbers above 0"));
  BOOST_TEST(has(problem_of({{"system", {{"complex", {{"interval", nullptr}}}}}}), "in 0 ways"));
  BOOST_TEST(
      has(problem_of(
              {{"system",
                {{"complex",
                  {{"interval", nullptr},
                   {"graph", {{"vertices", 1000001}, {"edges", {{0, 1}}}, {"lengths", {1}}}}}}}}}),
          "/graph/vertices: is 1000001; expected at most 1000000"));
  BOOST_TEST(has(problem_of({{"system", {{"degree", 1}}}}), "expected a lower degree"));
  BOOST_TEST(has(problem_of({{"system", {{"states", {"q"}}}}}), "has 1 names; expected 2"));
  BOOST_TEST(has(problem_of({{"system", {{"states", {"q", "x"}}}}}), "/system/states"));
  BOOST_TEST(
      has(problem_of({{"system", {{"energy", {{"psi", "1"}}}}}}), "expected one of the states"));
  BOOST_TEST(
      has(problem_of({{"system", {{"energy", {{"q", "q^2 + y*r"}}}}}}), "unknown name \"r\""));
  BOOST_TEST(
      has(problem_of({{"system", {{"resistance", {{"q", "x - 2"}}}}}}), "expected at least 0"));
  BOOST_TEST(has(problem_of({{"system", {{"regions", {{"none", "x > 5"}}}}}}), "true of no cell"));
  BOOST_TEST(has(problem_of({{"system", {{"conductivity", "1"}, {"heat_conductivity", "1"}}}}),
                 "expected one of them"));
  BOOST_TEST(has(problem_of({{"initial", {{"q", {{"form", {"1", "2"}}}}}}}),
                 "has 2 formulas; expected one"));
  BOOST_TEST(has(problem_of({{"initial", {{"V", {{"form", "1"}}}}}}), "unknown name \"V\""));
  BOOST_TEST(has(problem_of({{"initial", {{"q", {{"form", "1/x"}}}}}}),
                 "not a finite number at the cell 0"));
  Json heat = line_of(2);
  heat["system"]["states"] = {"q"};
  heat["system"]["energy"] = {{"q", "exp(q)"}};
  heat["system"]["heat_conductivity"] = "1";
  heat["system"]["boundary"] = {{"left", {{"impedance", "1"}}}};
  heat["initial"] = {{"q", {{"form", "0"}}}};
  BOOST_TEST(has(problems(heat), "/system/boundary/left: has an impedance, and this is heat"));
  Json mesh = line_of(2);
  mesh["system"]["complex"] = {{"vertices", {{0, 0}, {1, 0}, {0, 1}, {1, 1}}},
                               {"simplices", {{0, 1, 2}, {1, 3, 2}}}};
  BOOST_TEST(has(problems(mesh), "/system/complex: the dual of the cell"));
}

BOOST_AUTO_TEST_SUITE_END()
