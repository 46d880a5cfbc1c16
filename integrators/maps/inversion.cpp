#include "courant/integrators/maps/inversion.hpp"

#include <stdexcept>
#include <vector>

#include "courant/core/solve/gauss_newton.hpp"
#include "courant/core/words/message.hpp"

namespace courant {

Inversion::Inversion(std::string name, std::shared_ptr<const Manifold> manifold,
                     const Forward& forward)
    : name_(std::move(name)), manifold_(std::move(manifold)) {
  const Manifold& M = *manifold_;
  const Index n = M.dimension();
  Graph graph;
  const ExprVector y = graph.variables("y", 2 * n);
  const ExprVector x0 = graph.variables("x0", M.ambient_dimension());
  const ExprVector entries = graph.variables("basis", M.tangent_dimension() * n);
  const ExprMatrix basis = entries.reshaped(M.tangent_dimension(), n);
  const ExprVector x = M.chart(x0, basis, y.head(n));
  const ExprVector v = M.tangent_projector(x) * (basis * y.tail(n)).eval();
  const auto [first, second] = forward(x, v);
  ExprVector outputs(2 * x0.size() + x.size() + v.size());
  outputs << first, second, x, v;
  image_ = Function("inverse", {{"y", y}, {"x0", x0}, {"basis", entries}}, outputs);
}

Inversion::TangentVector Inversion::operator()(const VectorXd& x0, const VectorXd& x1) const {
  const Manifold& M = *manifold_;
  const Index n = M.dimension(), N = M.ambient_dimension();
  for (const auto& [argument, size] : {std::pair("x0", x0.size()), std::pair("x1", x1.size())})
    if (size != N)
      throw std::invalid_argument(name_ + "::inverse: " + argument + " has " +
                                  std::to_string(size) + " entries, expected " + std::to_string(N) +
                                  ".");
  const MatrixXd basis = M.tangent_basis(x0);
  const VectorXd entries = basis.reshaped();
  VectorXd target(2 * N);
  target << x0, x1;

  // y + s e_j and constants, as series in s.
  const auto constant = [](const VectorXd& values) {
    MatrixXd result = MatrixXd::Zero(values.size(), 2);
    result.col(0) = values;
    return result;
  };
  std::vector<MatrixXd> series = {MatrixXd::Zero(2 * n, 2), constant(x0), constant(entries)};

  VectorXd y = VectorXd::Zero(2 * n);
  y.tail(n) = basis.transpose() * (M.coframe(x0) * (x1 - x0));
  y.head(n) = 0.5 * y.tail(n);
  const auto defect = [&](const VectorXd& at) {
    return VectorXd(image_({at, x0, entries}).head(2 * N) - target);
  };
  const auto d_image = [&](const VectorXd& at) {
    MatrixXd J(2 * N, 2 * n);
    series[0].col(0) = at;
    for (Index j = 0; j < 2 * n; ++j) {
      series[0].col(1) = VectorXd::Unit(2 * n, j);
      J.col(j) = image_.taylor(series).col(1).head(2 * N);
    }
    return J;
  };
  const GaussNewtonResult zero =
      gauss_newton(defect, d_image, y, {.accepted = 1e-11 * (1.0 + target.norm())});
  if (zero.converged) {
    const VectorXd value = image_({zero.y, x0, entries});
    return {value.segment(2 * N, N), value.tail(M.tangent_dimension())};
  }
  throw std::domain_error(name_ + "::inverse: no tangent vector is mapped to (x0, x1), defect " +
                          number_text(zero.defect) +
                          " after Newton's method; expected 0. The points are too far apart for "
                          "this map.");
}

}  // namespace courant
