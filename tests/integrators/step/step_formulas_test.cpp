#include "courant/integrators/step/step_formulas.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <sstream>

#include "courant/core/solve/equation_system.hpp"
#include "courant/tests/core/says.hpp"
#include "courant/tests/integrators/certificate/ladder_catalogue.hpp"
#include "courant/tests/integrators/vortices.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * equations are taken for affine in what they are not solved for
//  * all variables are taken for contained
BOOST_AUTO_TEST_SUITE(step_formulas_test)

namespace {

using vortices::Degenerate;

std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> result;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) result.push_back(line);
  return result;
}

std::unique_ptr<Integrator> method_2(const Degenerate& vortices) {
  return vortices.method_2(vortices::positions(),
                           std::make_shared<MomentumProjector>(vortices.phase_space));
}

// Of Method 2's unknowns those of the scheme (15) are left, one for each position coordinate, and the
// projection p = α(q) is explicit.
BOOST_AUTO_TEST_CASE(vortices_are_left_with_the_unknowns_of_their_scheme) {
  const Degenerate vortices = vortices::lagrangian_form();
  const auto formulas = method_2(vortices)->formulas();
  BOOST_TEST_REQUIRE(formulas.size() == 2);
  const EquationSystem step = formulas[0].compile(Backend::interpreter),
                       projection = formulas[1].compile(Backend::interpreter);
  BOOST_TEST(step.size() == 48);
  BOOST_TEST(step.kept().size() == 8);
  BOOST_TEST(step.left().output_size() == 8);
  BOOST_TEST(projection.kept().size() == 0);

  const auto method_1 = vortices.method_1()->formulas();
  BOOST_TEST_REQUIRE(method_1.size() == 1);
  BOOST_TEST(method_1[0].compile(Backend::interpreter).kept().size() == 8);
}

BOOST_AUTO_TEST_CASE(names_fit_the_unknowns_and_equations) {
  const Degenerate vortices = vortices::lagrangian_form();
  for (const StepFormulas& formulas : method_2(vortices)->formulas()) {
    BOOST_TEST_REQUIRE(formulas.input_names.size() == formulas.inputs.size());
    for (std::size_t g = 0; g < formulas.inputs.size(); ++g)
      BOOST_TEST(std::ssize(formulas.input_names[g]) == formulas.inputs[g].variables.size());
    BOOST_TEST(std::ssize(formulas.equation_names) == formulas.equations.size());
  }
}

// Damping and coefficients of time leave a step affine; a cube and a kink do not.
BOOST_AUTO_TEST_CASE(linear_systems_have_affine_steps) {
  const auto force = [](Expr (*law)(const Expr& q, const Expr& t)) {
    const auto system = examples::flat(
        2, 0, 2, [law](const ExprVector& x, const ExprVector& v, const ExprVector&, const Expr& t) {
          return examples::equations({v[0] - x[1], v[1] + 0.1 * x[1] - law(x[0], t)});
        });
    return DiscretizeFirst(system, std::make_shared<Theta>(system->manifold())).formulas()[0];
  };
  BOOST_TEST(
      force([](const Expr& q, const Expr& t) { return sin(t) - (2.0 + cos(t)) * q; }).is_affine());
  BOOST_TEST(!force([](const Expr& q, const Expr&) { return -q - pow(q, 3); }).is_affine());
  BOOST_TEST(!force([](const Expr& q, const Expr&) { return -abs(q); }).is_affine());
  BOOST_TEST(!force([](const Expr& q, const Expr&) { return -q - 0.1 * sign(q); }).is_affine());
}

BOOST_AUTO_TEST_CASE(an_explanation_names_what_goes_and_what_stays) {
  const Degenerate vortices = vortices::lagrangian_form();
  const auto formulas = method_2(vortices)->formulas();
  const std::string text = explanation(formulas[0]);
  BOOST_TEST(says(text, "constrain-first: 48 equations for 48 unknowns"));
  BOOST_TEST(says(text, "8 equations are left, for "));
  const auto all = lines(text);
  BOOST_TEST(all.size() == 1 + 40 + 1);
  for (const std::string& line : all) {
    const auto is_start = [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; };
    BOOST_TEST(std::count_if(line.begin(), line.end(), is_start) <= 100, line);
  }
  const auto& names = vortices.system->names().coordinates;
  BOOST_TEST(says(text, "  " + names[7] + "' = "), text);
  BOOST_TEST(says(text, "  mu[7] = "), text);
  BOOST_TEST(says(text, "from: start of " + names[15] + "\n"), text);
  BOOST_TEST(says(text, "left, for Δ" + names[0] + ", "), text);
}

}  // namespace

BOOST_AUTO_TEST_CASE(variables_that_equations_contain) {
  StepFormulas formulas;
  const ExprVector y = formulas.graph.variables("y", 2), x = formulas.graph.variables("x", 4);
  formulas.inputs = {{"y", y}, {"x", x}};
  formulas.equations = ExprVector{{y[0] - sin(x[3]), y[0] * (x[1] - x[1]) + x[1]}};
  BOOST_TEST((formulas.contained(0) == std::vector<Index>{0}));
  BOOST_TEST((formulas.contained(1) == std::vector<Index>{1, 3}));
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
