#include "courant/structures/linear_dirac.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <ostream>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "courant/core/linear/fundamental_subspaces.hpp"
#include "courant/core/linear/lu_decomposition.hpp"
#include "courant/core/linear/qr_decomposition.hpp"
#include "courant/core/linear/singular_value_decomposition.hpp"
#include "courant/core/words/message.hpp"
#include "courant/core/words/text_layout.hpp"
#include "courant/structures/blocks.hpp"

namespace courant {
namespace {

void require_size(const std::string& name, const Eigen::Ref<const MatrixXd>& matrix, Index rows,
                  Index columns) {
  if (matrix.rows() == rows && matrix.cols() == columns) return;
  throw std::invalid_argument("LinearDirac: " + name + " is " +
                              size_text(matrix.rows(), matrix.cols()) + "; expected " +
                              size_text(rows, columns) + ".");
}

MatrixXd skew_part(const MatrixXd& matrix) { return 0.5 * (matrix - matrix.transpose()); }

// The skew part, if it is all of the matrix up to rounding.
MatrixXd skew(const std::string& name, const Eigen::Ref<const MatrixXd>& matrix) {
  require_size(name, matrix, matrix.rows(), matrix.rows());
  const double defect = (matrix + matrix.transpose()).norm();
  if (defect > 1e-10 * matrix.norm()) {
    throw std::domain_error("LinearDirac: " + name + " has a symmetric part, |" + name + " + " +
                            name + "ᵀ| = " + number_text(defect, 3) + "; expected a skew matrix.");
  }
  return skew_part(matrix);
}

// An orthonormal basis (columns) of {(u, α) : u ∈ im F, α(f_j) = ω(u, f_j)}, f_j the columns of F:
// (q, α) for q ∈ im F with the least such α, and (0, α) with α ∈ F°.
struct Generators {
  MatrixXd range, other;
};

Generators generators(const Eigen::Ref<const MatrixXd>& F, const std::string& name,
                      const Eigen::Ref<const MatrixXd>& omega) {
  require_size(name, omega, F.cols(), F.cols());
  const FundamentalSubspaces of_F(F);
  const Index n = F.rows(), r = F.cols();
  if (of_F.rank() < r) {
    throw std::domain_error("LinearDirac: F has " + std::to_string(r) + " columns of rank " +
                            std::to_string(of_F.rank()) + "; expected a basis.");
  }
  const MatrixXd Q = of_F.range(), annihilator = of_F.left_kernel();
  MatrixXd graph(2 * r, r);  // of the form in the basis Q: F = Q T, ω = Tᵀ ω' T
  if (r > 0) {
    const LuDecomposition transposed((Q.transpose() * F).transpose());
    const MatrixXd half = transposed.solve(skew(name, omega));
    graph << MatrixXd::Identity(r, r), skew_part(transposed.solve(half.transpose()));
    graph = orthonormalized(graph);
  }
  return {beside(Q * graph.topRows(r), MatrixXd::Zero(n, n - r)),
          beside(Q * graph.bottomRows(r), annihilator)};
}

constexpr RankOptions orthonormal{.magnitude = 1.0};

PairedSubspace subspace(const FormOnSubspace& pair) {
  const auto [vectors, covectors] = generators(pair.F, "omega", pair.omega);
  return PairedSubspace::image(vectors, covectors, orthonormal);
}

// β(v) = Λ(β, α) is v(β) = (-Λ)(α, β): the form -Λ on the subspace F of V*, with the parts of V and
// V* exchanged.
PairedSubspace subspace(const BivectorOnSubspace& pair) {
  const auto [covectors, vectors] = generators(pair.F, "lambda", -pair.lambda);
  return PairedSubspace::image(vectors, covectors, orthonormal);
}

PairedSubspace subspace(const ConstrainedRepresentation<MatrixXd>& representation) {
  const auto& [J, G] = representation;
  require_size("J", J, G.rows(), G.rows());
  const MatrixXd efforts = FundamentalSubspaces(G.transpose()).kernel();
  return PairedSubspace::image(beside(skew("J", J) * efforts, G),
                               beside(efforts, MatrixXd::Zero(G.rows(), G.cols())));
}

// 0 … n - 1. As a vector: clang 14 does not compile std::views::iota of GCC 12.
std::vector<Index> all_indices(Index n) {
  std::vector<Index> indices(static_cast<std::size_t>(n));
  std::iota(indices.begin(), indices.end(), Index{0});
  return indices;
}

PairedSubspace subspace(const HybridRepresentation<MatrixXd>& representation) {
  const auto& [effort_driven, flow_driven, M] = representation;
  std::vector<Index> order(effort_driven);
  order.insert(order.end(), flow_driven.begin(), flow_driven.end());
  const auto n = static_cast<Index>(order.size());
  require_size("M", M, n, n);
  if (!std::ranges::is_permutation(order, all_indices(n))) {
    throw std::invalid_argument("LinearDirac: effort_driven and flow_driven together are not 0 … " +
                                std::to_string(n - 1) + "; expected each coordinate once.");
  }
  const MatrixXd outputs = skew("M", M), inputs = MatrixXd::Identity(n, n);
  const auto effort_count = static_cast<Index>(effort_driven.size());
  MatrixXd vectors(n, n), covectors(n, n);
  for (Index k = 0; k < n; ++k) {
    const bool effort_is_given = k < effort_count;
    const Index coordinate = order[static_cast<std::size_t>(k)];
    vectors.row(coordinate) = (effort_is_given ? outputs : inputs).row(k);
    covectors.row(coordinate) = (effort_is_given ? inputs : outputs).row(k);
  }
  return PairedSubspace::image(vectors, covectors);
}

MatrixXd random_matrix(Index rows, Index columns, std::mt19937& generator) {
  std::normal_distribution<double> normal;
  return MatrixXd::NullaryExpr(rows, columns, [&] { return normal(generator); });
}

// The first `count` columns that Gram-Schmidt with pivoting takes, in increasing order.
std::vector<Index> independent_columns(const MatrixXd& matrix, Index count) {
  if (count == 0) return {};
  std::vector<Index> columns = QrDecomposition::pivoted(matrix).order();
  columns.resize(static_cast<std::size_t>(count));
  std::ranges::sort(columns);
  return columns;
}

std::vector<Index> others(const std::vector<Index>& columns, Index n) {
  std::vector<Index> rest;
  std::ranges::set_difference(all_indices(n), columns, std::back_inserter(rest));
  return rest;
}

// "3 α[1] - 2 α[2]": the terms of a linear form, those of rounding size left out.
std::string linear_form(const Eigen::Ref<const Eigen::RowVectorXd>& coefficients,
                        const std::vector<std::string>& names) {
  std::string text;
  for (Index k = 0; k < coefficients.size(); ++k) {
    const double c = coefficients[k];
    if (std::abs(c) <= 1e-12 * std::max(1.0, coefficients.cwiseAbs().maxCoeff())) continue;
    add_term(text, c, names[static_cast<std::size_t>(k)], 3);
  }
  return text.empty() ? "0" : text;
}

}  // namespace

LinearDirac::LinearDirac(const PairedSubspace& subspace) : PairedSubspace(subspace) {
  if (is_dirac(1e-8)) return;
  throw std::domain_error("LinearDirac: the subspace has dimension " + std::to_string(dimension()) +
                          ", isotropy defect " + number_text(isotropy_defect(), 3) +
                          " and coisotropy defect " + number_text(coisotropy_defect(), 3) +
                          "; expected dimension " + std::to_string(space_dimension()) +
                          " = dim V and defects of at most 1e-08.");
}

LinearDirac::LinearDirac(const KernelRepresentation<MatrixXd>& representation)
    : LinearDirac(PairedSubspace::kernel(representation.F, representation.E)) {}

LinearDirac::LinearDirac(const ImageRepresentation<MatrixXd>& representation)
    : LinearDirac(PairedSubspace::image(representation.F, representation.E)) {}

LinearDirac::LinearDirac(const ConstrainedRepresentation<MatrixXd>& representation)
    : LinearDirac(subspace(representation)) {}

LinearDirac::LinearDirac(const HybridRepresentation<MatrixXd>& representation)
    : LinearDirac(subspace(representation)) {}

// A form of size 1e6 costs its basis six digits of isotropy, which theory gives back.
LinearDirac::LinearDirac(const FormOnSubspace& pair) : LinearDirac(nearest(subspace(pair))) {}

LinearDirac::LinearDirac(const BivectorOnSubspace& pair) : LinearDirac(nearest(subspace(pair))) {}

LinearDirac LinearDirac::annihilator_sum(const Eigen::Ref<const MatrixXd>& F) {
  const FundamentalSubspaces of_transpose(F.transpose());
  const MatrixXd span = of_transpose.row_space(), annihilator = of_transpose.kernel();
  return LinearDirac(PairedSubspace::image(
      beside(span, MatrixXd::Zero(F.rows(), annihilator.cols())),
      beside(MatrixXd::Zero(F.rows(), span.cols()), annihilator), orthonormal));
}

LinearDirac LinearDirac::graph_of_form(const Eigen::Ref<const MatrixXd>& omega) {
  const MatrixXd identity = MatrixXd::Identity(omega.rows(), omega.rows());
  return LinearDirac(PairedSubspace::image(identity, skew("omega", omega).transpose()));
}

LinearDirac LinearDirac::graph_of_bivector(const Eigen::Ref<const MatrixXd>& lambda) {
  const MatrixXd identity = MatrixXd::Identity(lambda.rows(), lambda.rows());
  return LinearDirac(PairedSubspace::image(skew("lambda", lambda), identity));
}

LinearDirac LinearDirac::from_scattering(const Eigen::Ref<const MatrixXd>& O) {
  require_size("O", O, O.rows(), O.rows());
  const MatrixXd identity = MatrixXd::Identity(O.rows(), O.rows());
  return LinearDirac(
      PairedSubspace::image(0.5 * (identity + O), 0.5 * (identity - O), orthonormal));
}

// In a = v + α and b = v - α, halves of the orthonormal basis, D is b = O a; U has bᵀb ≈ aᵀa.
LinearDirac LinearDirac::nearest(const PairedSubspace& U) {
  const Index n = U.space_dimension();
  if (U.dimension() != n || !U.is_dirac(1e-4)) {
    throw std::domain_error("LinearDirac::nearest: the subspace has dimension " +
                            std::to_string(U.dimension()) + " and isotropy defect " +
                            number_text(U.isotropy_defect(), 3) + "; expected dimension " +
                            std::to_string(n) + " = dim V and a defect of at most 1e-04.");
  }
  const auto svd = singular_value_decomposition((U.vectors() - U.covectors()) *
                                                (U.vectors() + U.covectors()).transpose());
  return from_scattering(svd.U * svd.V.transpose());
}

LinearDirac LinearDirac::random(Index n, std::mt19937& generator) {
  const auto below = [&](Index count) {
    return std::uniform_int_distribution<Index>(0, count - 1)(generator);
  };
  const Index r = below(n + 1);
  const Index half_rank = below(r / 2 + 1);
  const MatrixXd A = random_matrix(r, half_rank, generator);
  const MatrixXd B = random_matrix(r, half_rank, generator);
  return LinearDirac(FormOnSubspace{.F = random_matrix(n, r, generator),
                                    .omega = A * B.transpose() - B * A.transpose()});
}

// For f_j in F_D there is λ with (f_j, Yλ) ∈ D, Xλ = f_j, where [X; Y] is the basis.
FormOnSubspace LinearDirac::form() const {
  const FundamentalSubspaces of_vectors(vectors(), block_options());
  const MatrixXd F = of_vectors.range();
  return {F, skew_part((covectors() * of_vectors.pseudo_solve(F)).transpose() * F)};
}

BivectorOnSubspace LinearDirac::bivector() const {
  const FundamentalSubspaces of_covectors(covectors(), block_options());
  const MatrixXd F = of_covectors.range();
  return {F, skew_part(F.transpose() * (vectors() * of_covectors.pseudo_solve(F)))};
}

// XᵀX + YᵀY = 1 and XᵀY + YᵀX = 0 make X ± Y orthogonal, for the orthonormal basis [X; Y].
MatrixXd LinearDirac::scattering() const {
  return (vectors() - covectors()) * (vectors() + covectors()).transpose();
}

KernelRepresentation<MatrixXd> LinearDirac::kernel_representation() const {
  return {covectors().transpose(), vectors().transpose()};
}

ImageRepresentation<MatrixXd> LinearDirac::image_representation() const {
  return {vectors(), covectors()};
}

ConstrainedRepresentation<MatrixXd> LinearDirac::constrained_representation() const {
  const auto [F, lambda] = bivector();
  return {F * lambda * F.transpose(), vector_kernel()};
}

// If F₁ is a maximal set of independent columns of F in Fv + Eα = 0, then [F₁ E₂] is regular.
HybridRepresentation<MatrixXd> LinearDirac::hybrid_representation() const {
  const Index n = space_dimension();
  const auto [F, E] = kernel_representation();
  const Index rank_F = decide_rank(F, block_options()).rank;
  const Index rank_E = decide_rank(E, block_options()).rank;
  HybridRepresentation<MatrixXd> result;
  if (rank_F >= rank_E) {
    result.effort_driven = independent_columns(F, rank_F);
    result.flow_driven = others(result.effort_driven, n);
  } else {
    result.flow_driven = independent_columns(E, rank_E);
    result.effort_driven = others(result.flow_driven, n);
  }
  const MatrixXd outputs =
      beside(F(Eigen::all, result.effort_driven), E(Eigen::all, result.flow_driven));
  const MatrixXd inputs =
      beside(E(Eigen::all, result.effort_driven), F(Eigen::all, result.flow_driven));
  result.M = skew_part(-LuDecomposition(outputs).solve(inputs));
  return result;
}

LinearDirac LinearDirac::gauge_transformed(const Eigen::Ref<const MatrixXd>& B) const {
  require_size("B", B, space_dimension(), space_dimension());
  return LinearDirac(
      PairedSubspace::image(vectors(), covectors() + skew("B", B).transpose() * vectors()));
}

std::string LinearDirac::kind() const {
  const Index n = space_dimension(), r = vector_range().cols(), s = covector_range().cols();
  const Index rank_of_form = r + s - n;  // the kernel of ω_D is D ∩ V, of dimension n - s
  if (r == n && s == n) return "graph of a symplectic form";
  if (r == n && s == 0) return "V ⊕ 0";
  if (r == 0 && s == n) return "0 ⊕ V*";
  if (rank_of_form == 0) return "F ⊕ F°";
  if (r == n) return "graph of a presymplectic form";
  if (s == n) return "graph of a bivector";
  return "a form on a subspace";
}

std::ostream& operator<<(std::ostream& out, const LinearDirac& D) {
  const Index n = D.space_dimension();
  const Index r = D.vector_range().cols(), s = D.covector_range().cols();
  std::ostringstream text;
  text << "Dirac structure on V, dim V = " << n << ": " << D.kind() << "\n  dim F_D = " << r
       << ", rank ω_D = " << r + s - n << ", dim D ∩ V = " << n - s << ", dim D ∩ V* = " << n - r
       << '\n';
  if (D.decision().ambiguous()) text << "  the dimension is doubtful: " << D.decision() << '\n';

  const auto [effort_driven, flow_driven, M] = D.hybrid_representation();
  std::vector<std::string> inputs, outputs;
  for (const Index k : effort_driven) {
    inputs.push_back("α[" + std::to_string(k) + "]");
    outputs.push_back("v[" + std::to_string(k) + "]");
  }
  for (const Index k : flow_driven) {
    inputs.push_back("v[" + std::to_string(k) + "]");
    outputs.push_back("α[" + std::to_string(k) + "]");
  }
  for (Index k = 0; k < n; ++k) {
    text << "  " << outputs[static_cast<std::size_t>(k)] << " = " << linear_form(M.row(k), inputs)
         << '\n';
  }
  return out << text.str();
}

}  // namespace courant
