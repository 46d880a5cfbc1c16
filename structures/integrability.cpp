#include "courant/structures/integrability.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <random>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/linear/fundamental_subspaces.hpp"
#include "courant/core/linear/singular_value_decomposition.hpp"
#include "courant/structures/blocks.hpp"

namespace courant {
namespace {

// A matrix that depends on chart coordinates ξ, and its derivatives, at ξ = 0.
struct MatrixJet {
  MatrixXd value;
  std::vector<MatrixXd> derivative;  // by ξ_1, …, ξ_n
};

// The chart of the retraction at x: y(ξ) = R_x(B ξ), and V(ξ) = C(y) ∂y/∂ξ, the tangent
// representation of the coordinate fields; V(0) = B.
class Chart {
 public:
  Chart(const Manifold& manifold, const VectorXd& x)
      : xi_(graph_.variables("xi", manifold.dimension())),
        basis_(manifold.tangent_basis(x)),
        y_(manifold.chart(constants(x), constants(basis_), xi_)),
        V_(manifold.coframe(y_) * jacobian(y_, xi_).dense()) {}

  const Graph& graph() const { return graph_; }
  const ExprVector& y() const { return y_; }
  const ExprMatrix& V() const { return V_; }
  Index n() const { return xi_.size(); }

  MatrixJet jet(const ExprMatrix& matrix) const {
    const ExprVector entries = Eigen::Map<const ExprVector>(matrix.data(), matrix.size());
    const ExprMatrix by_xi = jacobian(entries, xi_).dense();
    const MatrixXd zero_order = at_origin(entries);
    MatrixJet result;
    result.value = zero_order.reshaped(matrix.rows(), matrix.cols());
    for (Index k = 0; k < n(); ++k)
      result.derivative.push_back(
          at_origin(ExprVector(by_xi.col(k))).reshaped(matrix.rows(), matrix.cols()));
    return result;
  }

 private:
  MatrixXd at_origin(const ExprVector& entries) const {
    return values(substitute(entries, xi_, ExprVector::Zero(n())));
  }

  Graph graph_;
  ExprVector xi_;
  MatrixXd basis_;
  ExprVector y_;
  ExprMatrix V_;
};

// Sections of D through an orthonormal basis of D_x, in the coordinates of the chart: columns X, α,
// and their derivatives by ξ_k.
struct Sections {
  MatrixXd X, alpha;  // n × d
  std::vector<MatrixXd> X_by, alpha_by;
  double rank_defect = 0.0;  // of dA z from the range of A: not 0 where the rank of A changes
};

// A(ξ) z = 0 for z = (dξ/dt, α, u): the membership at y(ξ), and α = Πᵀ α where n < Ñ.
ExprMatrix equations(const DiracStructure& structure, Chart& chart) {
  const Manifold& M = *structure.manifold();
  const Index n = chart.n(), size = M.tangent_dimension(), m = structure.port_size();
  const ExprVector z = chart.graph().variables("z", n + size + m);
  const ExprVector residual = structure.membership(chart.y(), chart.V() * ExprVector(z.head(n)),
                                                   z.segment(n, size), z.tail(m));
  ExprMatrix A = jacobian(residual, z).dense();
  const ExprVector entries = substitute(
      ExprVector(Eigen::Map<const ExprVector>(A.data(), A.size())), z, ExprVector::Zero(z.size()));
  A = Eigen::Map<const ExprMatrix>(entries.data(), A.rows(), A.cols()).eval();
  if (n == size) return A;
  ExprMatrix all = ExprMatrix::Zero(A.rows() + size, A.cols());
  all.topRows(A.rows()) = A;
  all.block(A.rows(), n, size, size) = ExprMatrix(ExprMatrix::Identity(size, size)) -
                                       ExprMatrix(M.tangent_projector(chart.y()).transpose());
  return all;
}

// Sections through all of an orthonormal basis, or through `most` random orthonormal elements.
Sections sections(const DiracStructure& structure, const VectorXd& x, Index most) {
  Chart chart(*structure.manifold(), x);
  const Index n = chart.n(), size = structure.manifold()->tangent_dimension();
  const MatrixJet A = chart.jet(equations(structure, chart));
  const MatrixJet V = chart.jet(chart.V());
  const FundamentalSubspaces of_A(A.value, DiracStructure::rounding);
  const MatrixXd kernel = of_A.kernel();

  // Combinations of the kernel whose pairs (dξ/dt, Vᵀα) are an orthonormal basis of D_x.
  const MatrixXd pairs = above(kernel.topRows(n), V.value.transpose() * kernel.middleRows(n, size));
  const FundamentalSubspaces of_pairs(pairs, {.data_error = 1e-12, .magnitude = 1.0});
  MatrixXd z = kernel * of_pairs.pseudo_solve(of_pairs.range());
  if (z.cols() > most) {
    std::mt19937 generator(1);
    std::normal_distribution<double> normal;
    const MatrixXd random =
        MatrixXd::NullaryExpr(z.cols(), most, [&] { return normal(generator); });
    z *= range(random);
  }

  Sections result;
  result.X = z.topRows(n);
  result.alpha = V.value.transpose() * z.middleRows(n, size);
  const MatrixXd left_kernel = of_A.left_kernel();
  for (Index k = 0; k < n; ++k) {
    const auto at = static_cast<std::size_t>(k);
    const MatrixXd change = A.derivative[at] * z;
    const double scale = 1.0 + change.norm();
    result.rank_defect =
        std::max(result.rank_defect, (left_kernel.transpose() * change).norm() / scale);
    const MatrixXd z_by = -of_A.pseudo_solve(change);
    result.X_by.push_back(z_by.topRows(n));
    result.alpha_by.push_back(V.derivative[at].transpose() * z.middleRows(n, size) +
                              V.value.transpose() * z_by.middleRows(n, size));
  }
  return result;
}

// ⟨L_{X_i}α_j, X_l⟩ of all sections: ⟨dα_j(X_i), X_l⟩ + ⟨α_j, dX_i(X_l)⟩, and the sizes of the
// terms.
struct LieTerms {
  std::vector<MatrixXd> value, size;  // [i](j, l)
};

LieTerms lie_terms(const Sections& s) {
  const Index n = s.X.rows(), d = s.X.cols();
  LieTerms terms;
  for (Index i = 0; i < d; ++i) {
    MatrixXd along = MatrixXd::Zero(n, d);       // column j: dα_j(X_i)
    MatrixXd transposed = MatrixXd::Zero(n, n);  // row k: ∂_k X_i
    for (Index k = 0; k < n; ++k) {
      const auto at = static_cast<std::size_t>(k);
      along += s.X(k, i) * s.alpha_by[at];
      transposed.row(k) = s.X_by[at].col(i).transpose();
    }
    const MatrixXd first = along.transpose() * s.X;                    // (j, l)
    const MatrixXd second = (transposed * s.alpha).transpose() * s.X;  // (j, l)
    terms.value.push_back(first + second);
    terms.size.push_back(first.cwiseAbs() + second.cwiseAbs());
  }
  return terms;
}

double cyclic(const std::vector<MatrixXd>& terms, Index i, Index j, Index k) {
  const auto at = [&](Index a, Index b, Index c) {
    return terms[static_cast<std::size_t>(a)](b, c);
  };
  return at(i, j, k) + at(j, k, i) + at(k, i, j);
}

AlternatingTensor alternating(Index n, const std::vector<MatrixXd>& terms) {
  AlternatingTensor result(n);
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < i; ++j)
      for (Index k = 0; k < j; ++k) result.set(i, j, k, cyclic(terms, i, j, k));
  return result;
}

// Λ in the coordinates of the chart, and its derivatives there: Λ(y) = V λ Vᵀ on tangent vectors.
MatrixJet in_chart(Chart& chart, const MatrixField& bivector) {
  const MatrixJet ambient = chart.jet(bivector(chart.y())), V = chart.jet(chart.V());
  const MatrixXd& B = V.value;
  MatrixJet result{B.transpose() * ambient.value * B, {}};
  for (std::size_t k = 0; k < V.derivative.size(); ++k) {
    const MatrixXd turned = V.derivative[k] * result.value * B.transpose();
    result.derivative.push_back(B.transpose() *
                                (ambient.derivative[k] - turned + turned.transpose()) * B);
  }
  return result;
}

}  // namespace

void AlternatingTensor::set(Index i, Index j, Index k, double value) {
  const std::array<std::array<Index, 3>, 3> even{{{i, j, k}, {j, k, i}, {k, i, j}}};
  for (const auto& [a, b, c] : even) {
    slices_[static_cast<std::size_t>(a)](b, c) = value;
    slices_[static_cast<std::size_t>(a)](c, b) = -value;
  }
}

double AlternatingTensor::max_abs() const {
  double result = 0.0;
  for (const MatrixXd& slice : slices_) result = std::max(result, slice.cwiseAbs().maxCoeff());
  return result;
}

AlternatingTensor exterior_derivative(const Manifold& manifold, const MatrixField& form,
                                      const VectorXd& x) {
  Chart chart(manifold, x);
  const MatrixJet omega = chart.jet(chart.V().transpose().eval() * (form(chart.y()) * chart.V()));
  return alternating(chart.n(), omega.derivative);
}

AlternatingTensor schouten_bracket(const Manifold& manifold, const MatrixField& first,
                                   const MatrixField& second, const VectorXd& x) {
  Chart chart(manifold, x);
  const Index n = chart.n();
  const MatrixJet one = in_chart(chart, first), two = in_chart(chart, second);
  std::vector<MatrixXd> terms(static_cast<std::size_t>(n), MatrixXd::Zero(n, n));
  for (Index i = 0; i < n; ++i)
    for (Index l = 0; l < n; ++l)
      terms[static_cast<std::size_t>(i)] +=
          one.value(i, l) * two.derivative[static_cast<std::size_t>(l)] +
          two.value(i, l) * one.derivative[static_cast<std::size_t>(l)];
  return alternating(n, terms);
}

AlternatingTensor courant_tensor(const DiracStructure& structure, const VectorXd& x) {
  const Sections s = sections(structure, x, std::numeric_limits<Index>::max());
  return alternating(s.X.cols(), lie_terms(s).value);
}

Integrability integrability(const DiracStructure& structure, const VectorXd& x) {
  Integrability result{.x = x};
  const PairedSubspace D = structure.fibre(x);
  if (!D.is_dirac(1e-8)) {
    result.undefined = "D is not Dirac at this point";
    return result;
  }
  const Sections s = sections(structure, x, 24);
  if (s.rank_defect > 1e-7) {
    result.undefined = "the rank of D is not constant at this point";
    return result;
  }
  const LieTerms terms = lie_terms(s);
  const Index d = s.X.cols();
  for (Index i = 0; i < d; ++i)
    for (Index j = 0; j < i; ++j)
      for (Index k = 0; k < j; ++k) {
        result.defect = std::max(result.defect, std::abs(cyclic(terms.value, i, j, k)));
        result.scale = std::max(result.scale, cyclic(terms.size, i, j, k));
      }
  return result;
}

IntegrabilitySurvey integrability(const DiracStructure& structure,
                                  std::span<const VectorXd> points) {
  IntegrabilitySurvey survey;
  survey.points = points.size();
  std::optional<Integrability> worst;
  for (const VectorXd& x : points) {
    const Integrability here = integrability(structure, x);
    if (!here.undefined.empty()) {
      ++survey.undefined;
      if (!worst) survey.worst = here;
      continue;
    }
    const auto excess = [](const Integrability& i) { return i.defect / (1e-9 * i.scale + 1e-13); };
    if (!worst || excess(here) > excess(*worst)) worst = here;
  }
  if (worst) survey.worst = *worst;
  return survey;
}

}  // namespace courant
