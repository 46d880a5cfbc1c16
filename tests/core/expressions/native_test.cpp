#include "courant/core/expressions/native.hpp"

#include <boost/test/unit_test.hpp>
#include <cstdlib>
#include <set>
#include <stdexcept>

#include "courant/core/expressions/function.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * a number of a formula stands in the source (core/expressions/program_c_source.cpp)
//  * the Jacobian is called with the numbers of the value (core/expressions/function.hpp)
BOOST_AUTO_TEST_SUITE(native_test)

namespace {

// A host's own compiler, which knows the code of what was compiled beforehand.
class KnownCode final : public NativeCompiler, public NativeCode {
 public:
  std::shared_ptr<const NativeCode> compile(const std::string& c_source) const override {
    if (c_source.find("courant_value") == std::string::npos)
      throw std::runtime_error("KnownCode::compile: unknown source:\n" + c_source);
    ++*compiled;
    sources->insert(c_source);
    return {std::shared_ptr<const NativeCode>(), this};
  }
  bool is_available() const override { return available; }
  Evaluate function(const std::string&) const override {
    return [](const double* const*, const double*, double* out) { out[0] = 42.0; };
  }

  bool available = true;
  std::shared_ptr<int> compiled = std::make_shared<int>(0);
  std::shared_ptr<std::set<std::string>> sources = std::make_shared<std::set<std::string>>();
};

BOOST_AUTO_TEST_CASE(a_function_is_compiled_by_the_compiler_that_it_is_given) {
  const auto compiler = std::make_shared<KnownCode>();
  const Graph graph;
  const ExprVector x = graph.variables("x", 2);
  const ExprVector y = ExprVector::Constant(1, sin(x[0]) * exp(x[1]) / (1.0 + x[0] * x[1]));
  const VectorXd at{{0.5, 0.25}};
  for (const Backend& kind : {Backend::native, Backend::automatic})
    BOOST_TEST(Function("f", {{"x", x}}, y, {.backend = kind.with(compiler)})({at})[0] == 42.0);
  BOOST_TEST(*compiler->compiled == 2);

  compiler->available = false;
  const double value = std::sin(0.5) * std::exp(0.25) / 1.125;
  for (const Backend& kind : {Backend::interpreter, Backend::automatic}) {
    const Function f("f", {{"x", x}}, y, {.backend = kind.with(compiler)});
    BOOST_TEST(!f.is_native());
    BOOST_TEST(f({at})[0] == value, boost::test_tools::tolerance(1e-15));
  }
  BOOST_TEST(*compiler->compiled == 2);
}

BOOST_AUTO_TEST_CASE(functions_together_take_one_run_of_the_compiler) {
  const auto compiler = std::make_shared<KnownCode>();
  const Graph graph;
  const ExprVector x = graph.variables("x", 2);
  const VectorXd at{{0.5, 0.25}};
  const Backend together = Backend::automatic.with(compiler).together();
  std::vector<Function> functions;
  for (int k = 1; k <= 3; ++k)
    functions.emplace_back("f", std::vector<Function::Input>{{"x", x}},
                           ExprVector::Constant(1, sin(x[0] * k) * exp(x[1]) / (1.0 + x[0])),
                           Function::Options{.backend = together});
  const Function copy = functions[1];
  BOOST_TEST(copy({at})[0] == std::sin(1.0) * std::exp(0.25) / 1.5,
             boost::test_tools::tolerance(1e-15));
  BOOST_TEST(*compiler->compiled == 0);
  together.compile();
  BOOST_TEST(*compiler->compiled == 1);
  for (const Function& f : functions) BOOST_TEST(f({at})[0] == 42.0);
  BOOST_TEST(copy.is_native());
}

// As the cases of a sweep: numbers that are powers of two stand in the source, others do not.
BOOST_AUTO_TEST_CASE(functions_that_differ_in_numbers_have_one_source) {
  const auto compiler = std::make_shared<KnownCode>();
  const auto compiled = [](double a, double b, const Backend& backend) {
    const Graph graph;
    const ExprVector x = graph.variables("x", 2);
    const Expr y = sin(a * x[0]) * exp(x[1] / b) + a * x[1] / 4.0;
    return Function("f", {{"x", x}}, ExprVector::Constant(1, y),
                    {.differentiate = {"x"}, .backend = backend});
  };
  for (const double a : {1.1, 2.5, -7.0, 1e30})
    for (const double b : {0.3, 3.0}) compiled(a, b, Backend::native.with(compiler));
  BOOST_TEST(*compiler->compiled == 8);
  BOOST_TEST(compiler->sources->size() == 1u);
  compiled(2.0, 3.0, Backend::native.with(compiler));
  BOOST_TEST(compiler->sources->size() == 2u);

  // Each has the numbers of its own.
  if (!machine_compiler()->is_available()) return;
  const VectorXd at{{0.5, 0.25}};
  std::vector<Function> native, interpreted;
  for (const double a : {1.1, 2.5, 2.0}) {
    native.push_back(compiled(a, 0.3, Backend::native));
    interpreted.push_back(compiled(a, 0.3, Backend::interpreter));
  }
  for (std::size_t k = 0; k < native.size(); ++k) {
    BOOST_TEST(native[k].is_native());
    BOOST_TEST(native[k]({at})[0] == interpreted[k]({at})[0]);
    BOOST_TEST((native[k].jacobian({at}) - interpreted[k].jacobian({at})).norm() == 0.0);
  }
}

BOOST_AUTO_TEST_CASE(what_hinders_a_compiler_is_one_line_without_its_place) {
  BOOST_TEST(KnownCode().defect() == "unknown source:");
}

BOOST_AUTO_TEST_CASE(backends_are_compared_with_their_compilers) {
  BOOST_CHECK(Backend(Backend::Kind::native) == Backend::native);
  BOOST_CHECK(!(Backend::native == Backend::automatic));
  const auto compiler = std::make_shared<KnownCode>();
  BOOST_CHECK(!(Backend::native.with(compiler) == Backend::native));
  BOOST_CHECK(Backend::native.with(compiler).compiler() == compiler);
}

}  // namespace

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
