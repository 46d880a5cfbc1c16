// A method of one's own: the Verlet scheme for H = p²/2 + V(q), with the laws that every integrator is held to.
#include <cmath>
#include <courant/courant.hpp>
#include <iostream>
#include <memory>

using namespace courant;

// p ← p - h/2 V'(q),  q ← q + h p,  p ← p - h/2 V'(q), for the pendulum V = -cos q.
class Verlet final : public Integrator {
 public:
  explicit Verlet(std::shared_ptr<const ImplicitSystem> system) : Integrator(std::move(system)) {}

  std::string name() const override { return "verlet"; }
  int order() const override { return 2; }
  bool is_symmetric() const override { return true; }
  std::optional<bool> is_symplectic() const override { return true; }
  bool is_native() const override { return false; }

 private:
  class Workspace final : public Stepper {
   public:
    explicit Workspace(std::shared_ptr<const ImplicitSystem> system)
        : Stepper("verlet", system), system_(std::move(system)) {}

   private:
    void do_step(const State& before, double h, State& after) override {
      const double middle = before.x[1] - h / 2.0 * std::sin(before.x[0]);
      const double q = before.x[0] + h * middle, p = middle - h / 2.0 * std::sin(q);
      after.x = VectorXd{{q, p}};
      after.v = VectorXd{{p, -std::sin(q)}};
      after.z.resize(0);
    }
    // Nothing is kept from step to step.
    void do_keep(const State&, const State&) override {}
    void do_stage(Step& step) const override { step.stage = step.before; }
    void do_forget() override {}
    std::unique_ptr<Stepper> do_fresh() const override {
      return std::make_unique<Workspace>(system_);
    }

    std::shared_ptr<const ImplicitSystem> system_;
  };

  std::unique_ptr<Stepper> do_stepper() const override {
    return std::make_unique<Workspace>(system());
  }
};

int main() {
  const auto Q = std::make_shared<Euclidean>(1);
  const auto phase_space = std::make_shared<CotangentBundle>(Q);
  const auto structure = std::make_shared<CanonicalSymplectic>(phase_space);
  const auto energy = std::make_shared<Hamiltonian>(
      phase_space, [](const ExprVector& x, const Expr&) { return square(x[1]) / 2.0 - cos(x[0]); });
  const auto pendulum = std::make_shared<DiracSystem>(structure, energy);
  const Verlet verlet(pendulum);

  // The laws: order, symmetry, the symplectic form, restarts, steps back in time, failures.
  const IntegratorReport report = check_integrator(verlet, {.system = pendulum,
                                                            .initial = {.x = VectorXd{{2.0, 0.5}}},
                                                            .step = 0.1,
                                                            .structure = structure});
  bool passed = true;
  for (const LawResult& law : report.laws) {
    std::cout << law.law << (law.passed() ? "  passed" : "  failed") << '\n';
    passed = passed && law.passed();
  }

  // Of a method of order 2, symmetric and symplectic, compositions make higher orders.
  const auto order_4 = std::make_shared<Composition>(std::make_shared<Verlet>(pendulum), 4);
  const auto end = [&](int steps) {
    return order_4->advance({.x = VectorXd{{2.0, 0.5}}}, 4.0 / steps, steps).x[0];
  };
  const double ratio = (end(40) - end(80)) / (end(80) - end(160));
  std::cout << "order 4: half the step, error divided by " << std::round(ratio) << '\n';
  return passed && std::abs(ratio - 16.0) < 2.0 ? 0 : 1;
}
