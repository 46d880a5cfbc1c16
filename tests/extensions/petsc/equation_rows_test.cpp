// Parts of a system of equations: sent, compiled elsewhere, they are the equations and their Jacobian.
#include "courant/extensions/petsc/equation_rows.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>

namespace courant {
namespace {

BOOST_AUTO_TEST_SUITE(equation_rows_test)

struct Example {
  Graph graph;
  ExprVector u = graph.variables("u", 4), a = graph.variables("a", 2), h = graph.variables("h", 1);
  std::vector<Function::Input> inputs = {{"u", u}, {"a", a}, {"h", h}};
  ExprVector equations{{u[0] * u[1] - a[0], sin(u[1]) + pow(u[2], 3) / h[0],
                        select(u[3] < Expr(1.0), exp(u[3]) * u[0], u[2]), u[3] - 2.5 * a[1]}};
};

BOOST_AUTO_TEST_CASE(pattern_of_a_system) {
  const Example example;
  const DividedEquations divided(example.inputs, example.equations);
  std::vector<std::pair<Index, Index>> found;
  for (const auto [row, column] : divided.pattern()) found.emplace_back(row, column);
  const std::vector<std::pair<Index, Index>> expected = {{0, 0}, {0, 1}, {1, 1}, {1, 2},
                                                         {2, 0}, {2, 2}, {2, 3}, {3, 3}};
  BOOST_TEST((found == expected));
}

BOOST_AUTO_TEST_CASE(parts_are_the_whole) {
  const Example example;
  const DividedEquations divided(example.inputs, example.equations);
  const Function whole("whole", example.inputs, example.equations, {.differentiate = {"u"}});
  const std::vector<VectorXd> in = {VectorXd{{0.3, -0.7, 1.1, 0.4}}, VectorXd{{2.0, 3.0}},
                                    VectorXd{{0.1}}};
  const VectorXd values = whole(in);
  const MatrixXd jacobian = whole.jacobian(in);
  for (const auto& [rows, owned] :
       {std::pair<std::vector<Index>, std::vector<Index>>{{2, 0}, {3, 0}},
        {{1, 3}, {1, 2}},
        {{}, {}}}) {
    const DividedEquations::Part part = divided.part(rows, owned);
    Message message;
    message.put(std::string("before"));
    part.rows.put_into(message);
    Message received(message.bytes());
    BOOST_TEST(received.take_text() == "before");
    const Function f = EquationRows::taken_from(received).compile("part", Backend::interpreter);
    std::vector<Index> unknowns = owned;
    unknowns.insert(unknowns.end(), part.ghosts.begin(), part.ghosts.end());
    VectorXd u(std::ssize(unknowns)), p(std::ssize(part.parameters));
    for (Index k = 0; k < u.size(); ++k) u[k] = in[0][unknowns[static_cast<std::size_t>(k)]];
    for (Index k = 0; k < p.size(); ++k) {
      const auto [group, place] = part.parameters[static_cast<std::size_t>(k)];
      p[k] = in[static_cast<std::size_t>(group)][place];
    }
    const VectorXd found = f({u, p});
    const MatrixXd rates = f.jacobian({u, p});
    for (std::size_t i = 0; i < rows.size(); ++i) {
      BOOST_TEST(found[static_cast<Index>(i)] == values[rows[i]]);  // to the last bit
      for (Index k = 0; k < u.size(); ++k)
        BOOST_TEST(rates(static_cast<Index>(i), k) ==
                   jacobian(rows[i], unknowns[static_cast<std::size_t>(k)]));
    }
  }
}

BOOST_AUTO_TEST_CASE(part_has_no_more_than_its_rows_need) {
  const Example example;
  const DividedEquations divided(example.inputs, example.equations);
  const DividedEquations::Part last = divided.part({3}, {3});
  BOOST_TEST(last.ghosts.empty());
  BOOST_REQUIRE(last.parameters.size() == 1u);
  BOOST_TEST(last.parameters[0].group == 1);
  BOOST_TEST(last.parameters[0].place == 1);
  BOOST_TEST(last.rows.instructions.size() <= 6u);
  const DividedEquations::Part first = divided.part({0}, {0});
  BOOST_TEST((first.ghosts == std::vector<Index>{1}));
}

BOOST_AUTO_TEST_CASE(constant_equation_is_sent_too) {
  const Example example;
  const DividedEquations divided(example.inputs, ExprVector{{Expr(3.5), example.u[0]}});
  const Function f = divided.part({0}, {0}).rows.compile("constant", Backend::interpreter);
  BOOST_TEST((f({VectorXd{{1.0}}, VectorXd(0)})[0]) == 3.5);
}

BOOST_AUTO_TEST_CASE(message_that_is_cut_off_is_refused) {
  Message message;
  message.put(std::vector<double>{1.0, 2.0});
  std::vector<std::byte> bytes = message.bytes();
  bytes.resize(bytes.size() - 1);
  Message cut(std::move(bytes));
  BOOST_CHECK_THROW(cut.take<double>(), std::out_of_range);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace
}  // namespace courant
