#include "courant/integrators/methods/projector_laws.hpp"

#include <algorithm>
#include <random>

#include "courant/core/linear/qr_decomposition.hpp"
#include "courant/core/linear/singular_value_decomposition.hpp"
#include "courant/manifolds/measurement.hpp"

namespace courant {
namespace {

MatrixXd random_rotation(Index n, std::mt19937& generator) {
  std::normal_distribution<double> normal;
  return orthonormalized(MatrixXd::NullaryExpr(n, n, [&] { return normal(generator); }));
}

// The sine of the largest angle between the spans of two matrices with orthonormal columns.
double angle(const MatrixXd& A, const MatrixXd& B) { return (A - B * (B.transpose() * A)).norm(); }

// W at a point, as tangent vectors.
MatrixXd directions(const Projector& projector, const ConstrainedPoint& at,
                    const LinearMap<double>& basis, const MatrixXd& turn) {
  const MatrixXd conormals = orthonormalized(basis.transpose() * at.conormals.transpose()) * turn;
  return basis * projector.directions(at.x, basis, conormals);
}

}  // namespace

std::vector<LawResult> check_projector(const Projector& projector, const Manifold& manifold,
                                       std::span<const ConstrainedPoint> points,
                                       const LawOptions& options) {
  std::mt19937 generator(options.seed);
  const std::string subject = "Projector(" + projector.name() + ") on " + manifold.name();
  LawMeasurement complement(subject, "J1 W(x) is orthonormal, a complement of T_xM_f", 1e-12);
  LawMeasurement intrinsic(subject, "J2 the span of W(x) does not depend on bases", 1e-9);
  LawMeasurement claims(subject, "J3 W(x) is orthogonal to T_xM_f, or constant, as said", 1e-9);
  MatrixXd first;
  for (const ConstrainedPoint& at : points) {
    const std::string where = describe("x", at.x);
    const Index d = at.conormals.rows();
    const LinearMap<double> basis = manifold.tangent_basis(at.x);
    const MatrixXd one = MatrixXd::Identity(d, d);
    complement.add(
        [&] {
          const MatrixXd W = directions(projector, at, basis, one);
          const MatrixXd seen = at.conormals.rowwise().normalized() * W;
          const double least = d == 0 ? 1.0 : singular_values(seen)[d - 1];
          return (W.transpose() * W - one).norm() + (least > 1e-12 ? 0.0 : 1.0);
        },
        where);
    intrinsic.add(
        [&] {
          const MatrixXd turned = basis * random_rotation(basis.cols(), generator);
          return angle(directions(projector, at, basis, one),
                       directions(projector, at, turned, random_rotation(d, generator)));
        },
        where);
    claims.add(
        [&] {
          const MatrixXd W = directions(projector, at, basis, one);
          double defect = 0.0;
          if (projector.is_orthogonal())
            defect =
                angle(W, basis * orthonormalized(basis.transpose() * at.conormals.transpose()));
          if (projector.has_constant_directions(d)) {
            if (first.size() == 0) first = W;
            defect = std::max(defect, angle(W, first));
          }
          return defect;
        },
        where);
  }
  return {complement.result(), intrinsic.result(), claims.result()};
}

}  // namespace courant
