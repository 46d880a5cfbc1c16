#include "courant/integrators/methods/integrator_adaptor.hpp"

#include <boost/test/unit_test.hpp>
#include <stdexcept>

#include "courant/manifolds/euclidean.hpp"
#include "courant/structures/system_in_units.hpp"
#include "courant/tests/integrators/example_systems.hpp"

// Mistakes that these cases have to notice:
//  * a method in other units is compared with numbers as they are
//  * a method of another system is taken
BOOST_AUTO_TEST_SUITE(integrator_adaptor)

using namespace courant;

namespace {

std::shared_ptr<const ImplicitSystem> decay() {
  return std::make_shared<examples::FormulaSystem>(
      std::make_shared<Euclidean>(1), 0, 1,
      [](const ExprVector& x, const ExprVector& v, const ExprVector&, const Expr&) {
        return ExprVector(v + x);
      });
}

// Promises what no default does.
class Promising final : public Integrator {
 public:
  explicit Promising(std::shared_ptr<const ImplicitSystem> system)
      : Integrator(std::move(system)) {}
  std::string name() const override { return "promising"; }
  int order() const override { return 7; }
  bool is_symmetric() const override { return true; }
  std::optional<bool> is_symplectic() const override { return false; }
  bool has_exact_energy() const override { return true; }
  bool is_native() const override { return true; }
  const Units* units() const override { return &units_; }

 private:
  std::unique_ptr<Stepper> do_stepper() const override { return nullptr; }
  std::vector<StepFormulas> do_formulas() const override { return std::vector<StepFormulas>(3); }

  Units units_{VectorXd::Constant(1, 8.0), VectorXd::Constant(1, 8.0), VectorXd(0),
               VectorXd::Ones(1), 1.0};
};

class Wrapped final : public IntegratorAdaptor {
 public:
  Wrapped(std::shared_ptr<const ImplicitSystem> system,
          const std::shared_ptr<const ImplicitSystem>& other,
          std::shared_ptr<const Integrator> method)
      : IntegratorAdaptor("Wrapped", std::move(system), other, std::move(method)) {}

 private:
  std::unique_ptr<Stepper> do_stepper() const override { return nullptr; }
};

}  // namespace

BOOST_AUTO_TEST_CASE(promises_are_those_of_the_other_method) {
  const auto system = decay(), inner = decay();
  const auto method = std::make_shared<Promising>(inner);
  const Wrapped wrapped(system, inner, method);
  BOOST_TEST(wrapped.system() == system);
  BOOST_TEST(wrapped.wrapped() == method);
  BOOST_TEST(wrapped.name() == "promising");
  BOOST_TEST(wrapped.order() == 7);
  BOOST_TEST(wrapped.is_symmetric());
  BOOST_TEST((wrapped.is_symplectic() == false));
  BOOST_TEST(wrapped.has_exact_energy());
  BOOST_TEST(wrapped.is_native());
  BOOST_TEST(wrapped.units()->coordinates[0] == 8.0);
  BOOST_TEST(wrapped.formulas().size() == 3u);
}

BOOST_AUTO_TEST_CASE(methods_of_other_systems_are_refused) {
  const auto system = decay(), inner = decay();
  BOOST_CHECK_THROW(Wrapped(system, system, std::make_shared<Promising>(inner)),
                    std::invalid_argument);
  BOOST_CHECK_THROW(Wrapped(system, inner, nullptr), std::invalid_argument);
  BOOST_CHECK_THROW(Wrapped(nullptr, inner, std::make_shared<Promising>(inner)),
                    std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
