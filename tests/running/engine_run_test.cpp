// Runs whose steps an engine solves: here one of this process, which divides nothing.
#include <Eigen/LU>
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "courant/reading/experiment.hpp"
#include "courant/running/run_in_memory.hpp"

namespace courant {
namespace {

BOOST_AUTO_TEST_SUITE(engine_run_test)

// What was asked of an engine.
struct Asked {
  int systems = 0, solutions = 0, fresh = 0;
  int last = -1;  // the solution after which it is stopped; -1: it is not
};

class Equations final : public EngineEquations {
 public:
  Equations(Function function, std::shared_ptr<Asked> asked)
      : function_(std::move(function)),
        asked_(std::move(asked)),
        contained_(function_.pattern_col()) {
    std::ranges::sort(contained_);
    contained_.erase(std::unique(contained_.begin(), contained_.end()), contained_.end());
  }
  const std::vector<Index>& contained() const override { return contained_; }
  bool is_native() const override { return false; }
  Answer solve(const Question& question) const override {
    if (asked_->solutions == asked_->last) throw EngineStopped("Stopped by the test.");
    ++asked_->solutions;
    asked_->fresh += question.keeps_matrix ? 0 : 1;
    BOOST_TEST(question.ends.back() == std::ssize(contained_));
    Answer answer;
    VectorXd all(function_.output_size() + function_.nonzeros());
    for (; answer.iterations < 50; ++answer.iterations) {
      function_.value_and_jacobian(question.in.data(), all.data());
      const VectorXd residual = all.head(function_.output_size());
      MatrixXd J(residual.size(), std::ssize(contained_));
      const MatrixXd whole = function_.dense_jacobian(all);
      for (Index k = 0; k < J.cols(); ++k)
        J.col(k) = whole.col(contained_[static_cast<std::size_t>(k)]);
      const VectorXd change = J.partialPivLu().solve(residual);
      for (Index k = 0; k < J.cols(); ++k)
        question.in.unknowns()[contained_[static_cast<std::size_t>(k)]] -= change[k];
      ++answer.factorizations;
      answer.residual = residual.norm();
      if (change.lpNorm<Eigen::Infinity>() <= 1e-14) {
        answer.has_converged = true;
        break;
      }
    }
    return answer;
  }

 private:
  Function function_;
  std::shared_ptr<Asked> asked_;
  std::vector<Index> contained_;
};

class Engine final : public EquationEngine {
 public:
  explicit Engine(std::shared_ptr<Asked> asked) : asked_(std::move(asked)) {}
  std::shared_ptr<const NativeCode> compile(const std::string& source) const override {
    return machine_compiler()->compile(source);
  }
  std::shared_ptr<const EngineEquations> take(const std::string& name,
                                              const std::vector<Function::Input>& inputs,
                                              const ExprVector& equations,
                                              Backend::Kind) const override {
    ++asked_->systems;
    return std::make_shared<Equations>(
        Function(name, inputs, equations, {.differentiate = {inputs[0].name}}), asked_);
  }
  int taken() const override { return asked_->systems; }
  std::string name() const override { return "test"; }
  int ranks() const override { return 3; }

 private:
  std::shared_ptr<Asked> asked_;
};

std::string chain(const std::string& method, const std::string& output = "{}") {
  return R"({"system": {"type": "mechanical", "coordinates": ["q[5]"],
    "potential": "sum(i, 0, 3, (q[i+1] - q[i])^2/2 + (q[i+1] - q[i])^4/4) + q[0]^2/2"},
    "initial": {"q": [0.3, 0, -0.2, 0.1, 0.4], "p_q": [0, 0.1, 0, -0.3, 0]},
    "method": )" +
         method + R"(, "time": {"step": 0.1, "end": 3}, "output": )" + output + "}";
}

RunInMemory run_by(const std::shared_ptr<Asked>& asked, const std::string& text) {
  RunInMemoryOptions options;
  if (asked) options.run.engine = std::make_shared<Engine>(asked);
  return run_in_memory(read_experiment(text), options);
}

void require_near(const std::string& text) {
  const auto asked = std::make_shared<Asked>();
  const RunInMemory by_engine = run_by(asked, text), alone = run_by(nullptr, text);
  BOOST_TEST((by_engine.outcome.status == RunStatus::completed));
  BOOST_TEST(asked->solutions >= 30);
  BOOST_REQUIRE(by_engine.rows.values.size() == alone.rows.values.size());
  for (std::size_t i = 0; i < alone.rows.values.size(); ++i)
    BOOST_TEST(std::fabs(by_engine.rows.values[i] - alone.rows.values[i]) < 1e-13);
  BOOST_REQUIRE(by_engine.outcome.summary.engine.has_value());
  BOOST_TEST(!alone.outcome.summary.engine.has_value());
}

BOOST_AUTO_TEST_CASE(rows_are_those_of_this_process) {
  require_near(chain(R"({"type": "discretize-first"})"));
  require_near(chain(R"({"type": "discretize-first", "order": 4})"));
  require_near(chain(R"({"type": "discrete-gradient"})"));
  require_near(
      R"({"system": {"type": "mechanical", "coordinates": ["x", "y"], "potential": "9.81*y",
    "holonomic": ["x^2 + y^2 - 1"]}, "initial": {"x": 0.6, "y": -0.8, "p_x": 0.4, "p_y": 0.3},
    "method": "constrain-first", "time": {"step": 0.02, "end": 0.6}})");
}

BOOST_AUTO_TEST_CASE(summary_says_who_solved) {
  const RunInMemory run = run_by(std::make_shared<Asked>(), chain(R"("discretize-first")"));
  const RunSummary read = read_run_summary(to_json(run.outcome.summary));
  BOOST_REQUIRE(read.engine.has_value());
  BOOST_TEST(read.engine->name == "test");
  BOOST_TEST(read.engine->ranks == 3);
}

// At each of the two epochs the matrix is forgotten with all else; what watches over a run makes steps of its own, too.
BOOST_AUTO_TEST_CASE(matrix_is_kept_within_an_epoch) {
  const auto kept = std::make_shared<Asked>(), forgotten = std::make_shared<Asked>();
  run_by(kept, chain(R"("discretize-first")"));
  run_by(forgotten, chain(R"("discretize-first")", R"({"epoch": 10})"));
  BOOST_TEST(kept->fresh < kept->solutions - 20);
  BOOST_TEST(forgotten->fresh == kept->fresh + 2);
}

BOOST_AUTO_TEST_CASE(engine_that_is_stopped_interrupts_the_run) {
  const auto asked = std::make_shared<Asked>();
  asked->last = 12;
  const RunInMemory run = run_by(asked, chain(R"("discretize-first")"));
  BOOST_TEST((run.outcome.status == RunStatus::interrupted));
  BOOST_TEST(run.outcome.message == "Stopped by the test.");
  BOOST_TEST(run.outcome.summary.steps > 0);
  BOOST_TEST(run.outcome.summary.steps < 30);
  BOOST_TEST(run.rows.rows() == static_cast<std::size_t>(run.outcome.summary.steps) + 1);
}

bool is_at_the_method(const ExperimentError& error) {
  return error.problems().size() == 1 && error.problems()[0].where == "/method";
}

BOOST_AUTO_TEST_CASE(methods_that_solve_nothing_are_refused) {
  for (const char* method :
       {R"("rk4")", R"({"type": "discretize-first", "discretization": "verlet"})"})
    BOOST_CHECK_EXCEPTION(run_by(std::make_shared<Asked>(), chain(method)), ExperimentError,
                          is_at_the_method);
}

// Of equations that follow from others least squares are taken, which an engine does not solve.
BOOST_AUTO_TEST_CASE(redundant_equations_are_refused) {
  const std::string twice = R"json({"system": {"type": "mechanical", "coordinates": ["x", "y"],
    "potential": "9.81*y", "holonomic": ["x^2 + y^2 - 1", "2*(x^2 + y^2 - 1)"]},
    "initial": {"x": 0.6, "y": -0.8, "p_x": 0.4, "p_y": 0.3},
    "method": "constrain-first", "time": {"step": 0.02, "end": 0.6}})json";
  BOOST_CHECK_EXCEPTION(run_by(std::make_shared<Asked>(), twice), ExperimentError,
                        is_at_the_method);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace
}  // namespace courant
