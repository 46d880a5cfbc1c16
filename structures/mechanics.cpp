#include "courant/structures/mechanics.hpp"

#include <random>
#include <stdexcept>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/structures/canonical_symplectic.hpp"
#include "courant/structures/constrained_family.hpp"
#include "courant/structures/restricted_two_form.hpp"

namespace courant {

Lagrangian::Formula mechanical_lagrangian(
    MatrixField metric, std::function<Expr(const ExprVector& q, const Expr& t)> potential) {
  return [metric = std::move(metric), potential = std::move(potential)](
             const ExprVector& q, const ExprVector& w, const Expr& t) {
    const ExprVector momentum = metric(q) * w;
    return 0.5 * w.dot(momentum) - potential(q, t);
  };
}

std::shared_ptr<const GeneratingFamily> constrained_family(
    std::shared_ptr<const GeneratingFamily> family, const Mechanics& mechanics) {
  if (mechanics.holonomic.count() > 0) {
    const Index w = family->parameter_size();
    family = std::make_shared<ConstrainedFamily>(
        family,
        [formula = mechanics.holonomic.formula, w](const ExprVector& x, const ExprVector&,
                                                   const Expr& t) {
          return formula(x, ExprVector::Zero(w), t);
        },
        mechanics.holonomic.count());
  }
  if (!mechanics.vakonomic || mechanics.nonholonomic.count() == 0) return family;
  const auto phase_space = std::dynamic_pointer_cast<const CotangentBundle>(family->manifold());
  const Index size = phase_space ? phase_space->base()->tangent_dimension() : 0;
  if (!phase_space || family->parameter_size() != size + mechanics.holonomic.count())
    throw std::invalid_argument(
        "constrained_family: vakonomic constraints are conditions on velocities; expected the "
        "family of a Lagrangian.");
  return std::make_shared<ConstrainedFamily>(
      family,
      [formula = mechanics.nonholonomic.formula, size](
          const ExprVector& x, const ExprVector& lambda, const Expr& t) -> ExprVector {
        return -formula(x, lambda.head(size), t);
      },
      mechanics.nonholonomic.count());
}

DiracSystem::Exterior mechanical_exterior(const std::shared_ptr<const CotangentBundle>& phase_space,
                                          const Mechanics& mechanics) {
  DiracSystem::Exterior exterior;
  const auto vertical = [&](const Mechanics::Formula& force) -> DiracSystem::Law {
    if (!force) return {};
    return [phase_space, force](const ExprVector& x, const ExprVector& v, const ExprVector&,
                                const Expr& t) {
      const Index n = phase_space->base()->tangent_dimension();
      ExprVector source = ExprVector::Zero(4 * n);
      source.segment(2 * n, n) = force(x, phase_space->horizontal(v), t);
      return source;
    };
  };
  exterior.source = vertical(mechanics.force);
  exterior.damping = vertical(mechanics.damping);
  if (mechanics.nonholonomic.count() > 0 && !mechanics.vakonomic) {
    exterior.constraint = [phase_space, formula = mechanics.nonholonomic.formula](
                              const ExprVector& x, const ExprVector& v, const ExprVector&,
                              const Expr& t) { return formula(x, phase_space->horizontal(v), t); };
    exterior.constraint_count = mechanics.nonholonomic.count();
  }
  return exterior;
}

std::shared_ptr<const DiracStructure> nonholonomic_structure(
    const std::shared_ptr<const CotangentBundle>& phase_space, const Mechanics& mechanics) {
  const Index m = mechanics.nonholonomic.count(), N = phase_space->ambient_dimension();
  const Index n = phase_space->base()->tangent_dimension();
  if (m == 0 || mechanics.vakonomic) return nullptr;
  // μ at fresh variables (x, w, t).
  struct Form {
    Graph graph;
    ExprVector x, w, entries;
    Expr t;
  };
  const auto form = std::make_shared<Form>();
  form->x = form->graph.variables("x", N);
  form->w = form->graph.variables("w", n);
  form->t = form->graph.variable("t");
  const ExprVector g = mechanics.nonholonomic.formula(form->x, form->w, form->t);
  const ExprMatrix mu = jacobian(g, form->w).dense();
  form->entries = Eigen::Map<const ExprVector>(mu.data(), mu.size());
  if (depends(form->entries, joined(form->w, ExprVector::Constant(1, form->t)))) return nullptr;
  std::mt19937 generator(1);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 3; ++trial) {
    const VectorXd x = phase_space->random_point(generator);
    const ExprVector t = ExprVector::Constant(1, Expr(normal(generator)));
    const VectorXd at_rest =
        values(mechanics.nonholonomic.formula(constants(x), ExprVector::Zero(n), t[0]));
    if (!(at_rest.cwiseAbs().maxCoeff() <= 1e-12)) return nullptr;
  }
  return std::make_shared<RestrictedTwoForm>(
      phase_space,
      [structure = CanonicalSymplectic(phase_space)](const ExprVector& x) {
        return structure.form(x);
      },
      m,
      [form, m, n](const ExprVector& x) {
        const ExprVector entries = substitute(form->entries, form->x, x);
        ExprMatrix columns = ExprMatrix::Zero(2 * n, m);
        for (Index i = 0; i < n; ++i) columns.row(i) = entries.segment(i * m, m);
        return columns;
      });
}

}  // namespace courant
