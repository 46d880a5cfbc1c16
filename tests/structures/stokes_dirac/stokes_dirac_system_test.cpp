#include "courant/structures/stokes_dirac/stokes_dirac_system.hpp"

#include <boost/test/unit_test.hpp>

#include "courant/manifolds/euclidean.hpp"
#include "courant/structures/interconnection.hpp"
#include "courant/structures/stokes_dirac/cell_forms.hpp"
#include "meshes.hpp"

// Mistakes that these cases have to notice:
//  * absorptions give power (structures/stokes_dirac/stokes_dirac_system.cpp)
//  * the output of a port is that of its first column (structures/stokes_dirac/stokes_dirac_system.cpp)
//  * heat that leaves at a given temperature is no power (structures/stokes_dirac/stokes_dirac_system.cpp)
//  * heat that is given is entropy (structures/stokes_dirac/stokes_dirac_system.cpp)
//  * heat flows from cold to warm (structures/stokes_dirac/stokes_dirac_system.cpp)
//  * forms of a part begin where the whole begins (structures/stokes_dirac/cell_forms.cpp)
BOOST_AUTO_TEST_SUITE(stokes_dirac_system_test)

using namespace courant;
using namespace courant::test;

namespace {

using Setting = StokesDiracSystem::Setting;

std::shared_ptr<const GeneratingFamily> some_energy(Index n) {
  return std::make_shared<Hamiltonian>(std::make_shared<Euclidean>(n),
                                       [](const ExprVector& x, const Expr&) {
                                         Expr sum = 0.0;
                                         for (Index i = 0; i < x.size(); ++i)
                                           sum += square(x[i]) / 2.0 + pow(x[i], 4) / 4.0;
                                         return sum;
                                       });
}

std::shared_ptr<const StokesDirac> rectangle(bool with_efforts) {
  const auto K = std::make_shared<const CellComplex>(CellComplex::rectangle(1.0, 2.0, 3, 2));
  return std::make_shared<const StokesDirac>(
      K, 0, with_efforts ? K->cells_of(0, K->region("left")->facets) : std::vector<Index>());
}

double number(const Expr& x) { return x.value(); }

double total(const std::vector<PortPower>& powers) {
  double sum = 0.0;
  for (const PortPower& power : powers) sum += number(power.power);
  return sum;
}

// v of the equations at x, efforts, inputs and t: they are v - rates.
VectorXd rates(const StokesDiracSystem& system, const VectorXd& x, const VectorXd& alpha,
               const VectorXd& z, double t) {
  return -values(system.inner_equations(constants(x), ExprVector::Zero(alpha.size()),
                                        constants(alpha), constants(z), Expr(t)));
}

// ⟨α, v⟩ less what is supplied and with what is dissipated, at any efforts.
double imbalance(const StokesDiracSystem& system, const VectorXd& alpha, const VectorXd& z) {
  const VectorXd x = VectorXd::Constant(alpha.size(), 0.3), v = rates(system, x, alpha, z, 0.7);
  const auto powers =
      system.powers(constants(x), constants(v), constants(alpha), constants(z), Expr(0.7));
  for (const PortPower& power : powers.dissipated) BOOST_TEST(number(power.power) >= 0.0);
  return alpha.dot(v) - total(powers.supplied) + total(powers.dissipated);
}

VectorXd some_numbers(Index n, double least = -1.0) {
  std::mt19937 generator(static_cast<unsigned>(n));
  std::uniform_real_distribution<double> uniform(least, 1.0);
  return VectorXd::NullaryExpr(n, [&] { return uniform(generator); });
}

// A supply on the left, an absorption on the right, a port at the top.
Setting on_three_sides(const StokesDirac& D) {
  Setting setting;
  const CellComplex& K = *D.complex();
  const auto columns = [&](const char* name) {
    std::vector<Index> result;
    for (const Index cell : K.cells_of(0, K.region(name)->facets)) {
      const auto at = std::find(D.flow_cells().begin(), D.flow_cells().end(), cell);
      if (at != D.flow_cells().end()) result.push_back(at - D.flow_cells().begin());
    }
    return result;
  };
  std::vector<Index> left = columns("left");
  for (std::size_t i = 0; i < D.effort_cells().size(); ++i)
    left.push_back(std::ssize(D.flow_cells()) + static_cast<Index>(i));
  const auto size = std::ssize(left);
  setting.supplies.push_back({"left", left, [size](const Expr& t) {
                                ExprVector u(size);
                                for (Index i = 0; i < size; ++i)
                                  u[i] = 1.0 + static_cast<double>(i) * t;
                                return u;
                              }});
  const std::vector<Index> right = columns("right"), top = columns("top");
  setting.absorptions.push_back({"right", right, VectorXd::Constant(std::ssize(right), 0.4)});
  setting.ports.push_back({"top", top, some_numbers(std::ssize(top))});
  return setting;
}

}  // namespace

BOOST_AUTO_TEST_CASE(powers_add_up) {
  for (const bool with_efforts : {false, true}) {
    const auto D = rectangle(with_efforts);
    const Index N = D->state_count();
    Setting setting = on_three_sides(*D);
    setting.resistance = [N](const ExprVector&) { return constants(VectorXd::Constant(N, 0.2)); };
    const StokesDiracSystem system(D, some_energy(N), setting);
    const VectorXd alpha = some_numbers(N), z{{0.6}};
    BOOST_TEST(std::abs(imbalance(system, alpha, z)) < 1e-13);
    // A port gives its input in all its columns, each with its weight.
    const VectorXd y = values(system.output(constants(alpha), constants(alpha), constants(z)));
    double expected = 0.0;
    const auto& port = setting.ports[0];
    for (std::size_t i = 0; i < port.columns.size(); ++i)
      expected +=
          port.profile[static_cast<Index>(i)] * (D->B().transpose() * alpha)[port.columns[i]];
    BOOST_TEST(std::abs(y[0] - expected) < 1e-14);
    const auto state = VectorXd(VectorXd::Constant(N, 0.3));
    const VectorXd change =
        rates(system, state, alpha, z, 0.7) - rates(system, state, alpha, 0.0 * z, 0.7);
    BOOST_TEST(std::abs(change.dot(alpha) - 0.6 * y[0]) < 1e-14);
  }
}

BOOST_AUTO_TEST_CASE(conduction) {
  const auto D = rectangle(true);
  const Index p = D->p_count(), q = D->q_count();
  Setting setting = on_three_sides(*D);
  setting.conduction = StokesDiracSystem::Conduction{
      [q](const ExprVector&) { return constants(some_numbers(q, 0.1)); }};
  const StokesDiracSystem system(D, some_energy(p), setting);
  const VectorXd alpha = some_numbers(p), z{{0.6}};
  BOOST_TEST(std::abs(imbalance(system, alpha, z)) < 1e-13);
  // What flows is -K times the difference of the efforts, edge by edge, with those that are given.
  const VectorXd K = some_numbers(q, 0.1);
  VectorXd e = VectorXd::Zero(D->complex()->count(0));
  for (Index i = 0; i < p; ++i) e[D->p_cells()[static_cast<std::size_t>(i)]] = alpha[i];
  for (std::size_t i = 0; i < D->effort_cells().size(); ++i) {
    const double value = 1.0 + 0.7 * static_cast<double>(setting.supplies[0].columns.size() -
                                                         D->effort_cells().size() + i);
    e[D->effort_cells()[i]] = value;
  }
  const VectorXd expected = -K.cwiseProduct(D->complex()->coboundary(0) * e);
  const VectorXd flux =
      values(system.flux(constants(alpha), constants(alpha), constants(z), Expr(0.7)));
  BOOST_TEST((flux - expected).norm() < 1e-14);
}

// Of heat: the energy of a closed body is conserved and its entropy grows, whatever the temperatures are; what is
// supplied at given temperatures is power.
BOOST_AUTO_TEST_CASE(heat) {
  const auto conduct = [](Index q) {
    return StokesDiracSystem::Conduction{
        [q](const ExprVector&) { return constants(some_numbers(q, 0.1)); }, true};
  };
  const auto closed = rectangle(false);
  const Index p = closed->p_count();
  const StokesDiracSystem body(closed, some_energy(p), {.conduction = conduct(closed->q_count())});
  const VectorXd T = some_numbers(p, 0.2);
  const VectorXd rate = rates(body, T, T, VectorXd(0), 0.0);
  BOOST_TEST(std::abs(T.dot(rate)) < 1e-14);
  double made = 0.0;  // Σ K (T_i - T_j)²/(T_i T_j)
  const VectorXd K = some_numbers(closed->q_count(), 0.1);
  const SparseMatrixXd rows = closed->complex()->coboundary(0).transpose();
  for (Index edge = 0; edge < rows.cols(); ++edge) {
    double product = 1.0, difference = 0.0;
    for (SparseMatrixXd::InnerIterator it(rows, edge); it; ++it) {
      product *= T[it.row()];
      difference += it.value() * T[it.row()];
    }
    made += K[edge] * difference * difference / product;
  }
  BOOST_TEST(made > 0.1);
  BOOST_TEST(std::abs(rate.sum() - made) < 1e-13);

  // A flow that is given is one of energy, and brings as much entropy as the temperature where it enters says.
  Setting heated{.conduction = conduct(closed->q_count())};
  heated.supplies.push_back({"left", {0, 2}, [](const Expr& t) {
                               ExprVector J(2);
                               J << Expr(3.0), 2.0 * t;
                               return J;
                             }});
  const StokesDiracSystem warmed(closed, some_energy(p), heated);
  VectorXd entropy = VectorXd::Zero(p);
  entropy[closed->flow_cells()[0]] += 3.0 / T[closed->flow_cells()[0]];
  entropy[closed->flow_cells()[2]] += 1.4 / T[closed->flow_cells()[2]];
  BOOST_TEST((rates(warmed, T, T, VectorXd(0), 0.7) - rate - entropy).norm() < 1e-13);
  BOOST_TEST(std::abs(imbalance(warmed, T, VectorXd(0))) < 1e-13);

  const auto open = rectangle(true);
  Setting setting = on_three_sides(*open);
  setting.conduction = conduct(open->q_count());
  const StokesDiracSystem system(open, some_energy(open->p_count()), setting);
  BOOST_TEST(std::abs(imbalance(system, some_numbers(open->p_count(), 0.2), VectorXd{{0.6}})) <
             1e-13);
}

BOOST_AUTO_TEST_CASE(forms_of_a_whole) {
  const auto D = rectangle(false);
  const Index N = D->state_count();
  const auto part =
      std::make_shared<const StokesDiracSystem>(D, some_energy(N), on_three_sides(*D));
  const Interconnection whole({{"a", part}, {"b", part}}, {});
  const auto forms = cell_forms(whole);
  BOOST_REQUIRE(forms.size() == 4U);
  BOOST_TEST(forms[1].first == D->p_count());
  BOOST_TEST(forms[2].first == N);
  BOOST_TEST(forms[3].first == N + D->p_count());
  BOOST_TEST(forms[3].is_vector);
  BOOST_TEST(!forms[2].is_vector);
}

BOOST_AUTO_TEST_CASE(refused) {
  const auto D = rectangle(true);
  const Index N = D->state_count();
  BOOST_CHECK_THROW(StokesDiracSystem(D, some_energy(N - 1), {}), std::invalid_argument);
  BOOST_CHECK_THROW(StokesDiracSystem(nullptr, some_energy(N), {}), std::invalid_argument);
  BOOST_CHECK_THROW(
      StokesDiracSystem(D, some_energy(N), {.ports = {{"a", {0, 1}, VectorXd::Ones(1)}}}),
      std::invalid_argument);
  const Index effort = std::ssize(D->flow_cells());
  const StokesDiracSystem::Conduction conduction{
      [q = D->q_count()](const ExprVector&) { return ExprVector(ExprVector::Ones(q)); }};
  BOOST_CHECK_THROW(
      StokesDiracSystem(D, some_energy(D->p_count()),
                        {.ports = {{"a", {effort}, VectorXd::Ones(1)}}, .conduction = conduction}),
      std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
