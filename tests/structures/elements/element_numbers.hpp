// What an element says in numbers, between others, for tests.
#pragma once

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <vector>

#include "courant/structures/elements/electrical.hpp"
#include "courant/structures/elements/mechanical.hpp"
#include "courant/structures/elements/network_assembly.hpp"

namespace courant::elements {

// All currents and voltages, as numbers.
class Meter final : public NetworkVariables {
 public:
  Meter(const VectorXd& currents, const VectorXd& voltages, const VectorXd& x)
      : currents_(constants(currents)), voltages_(constants(voltages)), x_(constants(x)) {}

  Expr current(Index branch) const override { return currents_[branch]; }
  Expr voltage(Index branch) const override { return voltages_[branch]; }
  const ExprVector& x() const override { return x_; }
  const Expr& t() const override { return t_; }

 private:
  ExprVector currents_, voltages_, x_;
  Expr t_ = 0.25;
};

// What the laws of an element give between two others, whose branch and state come before its own.
inline std::vector<double> laws_of(const Element& element, const VectorXd& currents,
                                   const VectorXd& voltages) {
  NetworkAssembly assembly;
  assembly.add("before", capacitor(1.0), {1, 0});
  std::vector<Index> nodes;
  for (Index k = 0; k < element.terminal_count(); ++k) nodes.push_back(k + 1);
  assembly.add("E", element, nodes);
  VectorXd all_currents(currents.size() + 1), all_voltages(currents.size() + 1);
  all_currents << 1e3, currents;
  all_voltages << -1e3, voltages;
  const Meter meter(all_currents, all_voltages,
                    VectorXd::LinSpaced(assembly.state_count(), 1.0, 9.0));
  std::vector<double> values;
  for (std::size_t k = 1; k < assembly.branches().size(); ++k)
    if (assembly.branches()[k].law) values.push_back(assembly.branches()[k].law(meter).value());
  return values;
}

inline void check_laws(const Element& element, const VectorXd& currents, const VectorXd& voltages,
                       const std::vector<double>& expected) {
  const std::vector<double> found = laws_of(element, currents, voltages);
  BOOST_TEST_REQUIRE(found.size() == expected.size());
  for (std::size_t k = 0; k < found.size(); ++k)
    BOOST_TEST(std::abs(found[k] - expected[k]) < 1e-12 * (1.0 + std::abs(expected[k])));
}

// What an element stores, beside a mass that comes before it.
inline double energy_of(const Element& element, const VectorXd& own) {
  NetworkAssembly assembly;
  assembly.add("before", mass(2.0), {9});
  std::vector<Index> nodes;
  for (Index k = 0; k < element.terminal_count(); ++k) nodes.push_back(k + 1);
  assembly.add("E", element, nodes);
  VectorXd x(own.size() + 1);
  x << 4.0, own;
  return assembly.energy()(constants(x), 0.0).value() - 4.0;
}

// By hand, at these currents and voltages.
inline const VectorXd i1{{2.0}}, v1{{5.0}}, i2{{2.0, 3.0}}, v2{{5.0, 11.0}}, three{{3.0}};

}  // namespace courant::elements
