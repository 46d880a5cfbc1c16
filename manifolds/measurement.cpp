#include "courant/manifolds/measurement.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/linear/complete_orthogonal_decomposition.hpp"
#include "courant/core/words/message.hpp"

namespace courant {

double log_log_slope(const std::vector<double>& steps, const std::vector<double>& errors,
                     double floor) {
  std::vector<double> x, y;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (errors[i] <= floor) continue;
    x.push_back(std::log(steps[i]));
    y.push_back(std::log(errors[i]));
  }
  if (x.empty()) return std::numeric_limits<double>::infinity();
  const auto count = static_cast<Index>(x.size());
  MatrixXd A = MatrixXd::Ones(count, 2);
  A.col(0) = Eigen::Map<const VectorXd>(x.data(), count);
  return CompleteOrthogonalDecomposition(A).solve(Eigen::Map<const VectorXd>(y.data(), count))(0);
}

CurveFamily::CurveFamily(const Curve& curve, Index data_size) {
  Graph graph;
  const ExprVector t = graph.variables("t", 1);
  const ExprVector data = graph.variables("data", data_size);
  const ExprVector F = curve(t[0], data);
  const ExprVector one = ExprVector::Ones(1);
  const ExprVector dF = tangent(F, t, one);
  ExprVector outputs(3 * F.size());
  outputs << F, dF, tangent(dF, t, one);
  function_ = Function("curve", {{"t", t}, {"data", data}}, outputs);
}

MatrixXd CurveFamily::at(double t, const VectorXd& data) const {
  return function_({VectorXd::Constant(1, t), data}).reshaped(function_.output_size() / 3, 3);
}

double CurveFamily::derivative_defect(const VectorXd& data, double step) const {
  const MatrixXd exact = at(0.0, data).rightCols(2);
  return std::min({difference_defect(data, exact, step), difference_defect(data, exact, step / 4),
                   difference_defect(data, exact, step / 16)});
}

double CurveFamily::difference_defect(const VectorXd& data, const MatrixXd& exact,
                                      double step) const {
  MatrixXd difference = MatrixXd::Zero(exact.rows(), 2);
  const double weights[] = {45.0, -9.0, 1.0};
  for (int k = 1; k <= 3; ++k)
    difference +=
        weights[k - 1] / (60.0 * step) * (at(k * step, data) - at(-k * step, data)).leftCols(2);
  double worst = 0.0;
  for (Index j = 0; j < 2; ++j) {
    const double scale = 1.0 + exact.col(j).lpNorm<Eigen::Infinity>();
    for (Index i = 0; i < exact.rows(); ++i) {
      const double defect = std::abs(exact(i, j) - difference(i, j)) / scale;
      if (!std::isfinite(defect)) return std::numeric_limits<double>::infinity();
      worst = std::max(worst, defect);
    }
  }
  return worst;
}

std::vector<LawSample> draw_samples(const Manifold& M, int count, double far,
                                    std::mt19937& generator, double limit) {
  std::vector<LawSample> samples;
  for (int i = 0; i < count; ++i) {
    LawSample sample;
    sample.x = M.random_point(generator);
    sample.radius = std::min(limit, M.injectivity_radius(sample.x));
    const bool bounded = std::isfinite(sample.radius);
    for (const double length : {0.0, 1e-8, 1e-4, bounded ? 0.5 * sample.radius : 0.5,
                                bounded ? 0.99 * sample.radius : far})
      sample.vectors.push_back(M.random_tangent(sample.x, length, generator));
    sample.w = M.random_tangent(sample.x, 1.0, generator);
    sample.u = M.random_tangent(sample.x, 1.0, generator);
    samples.push_back(std::move(sample));
  }
  return samples;
}

LawResult measure_derivatives(LawMeasurement measured, const Manifold& M,
                              const std::vector<LawSample>& samples, const SampleCurve& curve) {
  const Index N = M.ambient_dimension();
  const Index size = M.tangent_dimension();
  try {
    const CurveFamily family(
        [&](const Expr& t, const ExprVector& data) {
          return curve(t, data.head(N), data.segment(N, size), data.segment(N + size, size),
                       data.tail(size));
        },
        N + 3 * size);
    for_vectors(samples, [&](const LawSample& s, const VectorXd& v) {
      VectorXd data(N + 3 * size);
      data << s.x, s.w, v, s.u;
      // Small against the distance to where the maps may end.
      const double step = 1e-2 * std::min(1.0, s.radius - v.norm());
      measured.add([&] { return family.derivative_defect(data, step); }, describe(s, v));
    });
  } catch (const std::exception& error) {
    measured.add(std::numeric_limits<double>::infinity(), without_place(error.what()));
  }
  return measured.result();
}

VectorXd point_near(const Manifold& M, const VectorXd& x, double distance,
                    std::mt19937& generator) {
  std::normal_distribution<double> normal;
  const VectorXd offset = VectorXd::NullaryExpr(x.size(), [&] { return normal(generator); });
  return M.project(x + distance / (1.0 + offset.norm()) * offset);
}

double relative(const VectorXd& difference, const VectorXd& scale) {
  return difference.norm() / (1.0 + scale.norm());
}

std::string describe(const char* name, const VectorXd& x) {
  constexpr Index kShown = 6;
  std::string text = std::string(name) + " = (";
  for (Index i = 0; i < std::min(x.size(), kShown); ++i)
    text += (i > 0 ? ", " : "") + number_text(x[i]);
  return text + (x.size() > kShown ? ", …)" : ")");
}

std::string describe(const LawSample& sample, const VectorXd& v) {
  return describe("x", sample.x) + ", " + describe("v", v);
}

}  // namespace courant
