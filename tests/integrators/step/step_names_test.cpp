#include "courant/integrators/step/step_names.hpp"

#include <boost/test/unit_test.hpp>

#include "../example_systems.hpp"
#include "courant/integrators/step/step_formulas.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/sphere.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(step_names_test)

namespace {

using Names = std::vector<std::string>;

// x' = y, y = z, named.
class Named final : public ImplicitSystem {
 public:
  Named()
      : ImplicitSystem(std::make_shared<Euclidean>(2), 1, 2,
                       {{"x", "y"}, {"tension"}, {"first", "second"}}) {}

 private:
  ExprVector do_residual(const ExprVector& x, const ExprVector& v, const ExprVector& z,
                         const Expr&) const override {
    ExprVector F(2);
    F << v[0] - x[1], x[1] - z[0];
    return F;
  }
};

BOOST_AUTO_TEST_CASE(coordinates_of_flat_space_keep_their_names) {
  const Named system;
  const StepNames names(system);
  BOOST_TEST(names.tangent("Δ", 0) == (Names{"Δx", "Δy"}), boost::test_tools::per_element());
  BOOST_TEST(names.tangent("", 2) == (Names{"x''", "y''"}), boost::test_tools::per_element());
  BOOST_TEST(names.auxiliary(1) == Names{"tension'"}, boost::test_tools::per_element());
  BOOST_TEST(names.equations(2) == (Names{"first", "second"}), boost::test_tools::per_element());
  BOOST_TEST(names.basis().empty());
}

BOOST_AUTO_TEST_CASE(derivatives_of_equations_say_so) {
  const Named system;
  Graph graph;
  const ExprVector x0 = graph.variables("x0", 2);
  const LocalFormulation local(graph, system, x0, basis_variables(graph, *system.manifold()),
                               graph.variable("t"), {0, 2});
  BOOST_TEST(StepNames(system).equations(local) ==
                 (Names{"first", "second", "d/dt second", "d^2/dt^2 second"}),
             boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(curved_spaces_are_numbered) {
  const auto sphere = std::make_shared<Sphere>(2);
  const examples::FormulaSystem system(
      sphere, 0, 3,
      [](const ExprVector&, const ExprVector& v, const ExprVector&, const Expr&) { return v; });
  const StepNames names(system);
  BOOST_TEST(names.tangent("Δ", 0) == (Names{"Δxi[0]", "Δxi[1]"}),
             boost::test_tools::per_element());
  BOOST_TEST(names.basis().size() == 6);
}

}  // namespace

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
