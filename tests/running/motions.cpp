#include "motions.hpp"

namespace courant::test {
namespace {

Json on_cotangent_bundle(const Json& base, const Json& coordinates, const char* hamiltonian,
                         const Json& initial) {
  return {{"system",
           {{"type", "hamiltonian"},
            {"manifold", {{"type", "cotangent-bundle"}, {"base", base}}},
            {"coordinates", coordinates},
            {"hamiltonian", hamiltonian}}},
          {"initial", initial}};
}

const Json kOne = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

Json on_sphere(const Json& sphere) {
  return on_cotangent_bundle(sphere, {"x[3]"},
                             "(p_x[0]^2 + 2*p_x[1]^2 + p_x[2]^2)/2 + x[2] + x[0]*x[1]",
                             {{"x", {0.6, 0, 0.8}}, {"p_x", {0.4, 0.7, -0.3}}});
}

Json on_rotations(const Json& rotations) {
  return on_cotangent_bundle(rotations, {"R[3][3]"},
                             "(p_R[0]^2 + p_R[1]^2/2 + p_R[2]^2/3)/2 + R[2][2] + R[0][1]/2",
                             {{"R", kOne}, {"p_R", {0.7, -0.4, 1}}});
}

Json on_rigid_motions() {
  return on_cotangent_bundle(
      "se3", {"R[3][3]", "r[3]"},
      "(p_R[0]^2 + p_R[1]^2/2 + p_R[2]^2/3 + dot(p_r, p_r))/2 + R[2][2] + "
      "R[0][0]*r[1] + dot(r, r)/2",
      {{"R", kOne}, {"r", {1, 0, 0.5}}, {"p_R", {0.7, -0.4, 1}}, {"p_r", {0.2, 0.3, -0.5}}});
}

Json on_product() {
  return on_cotangent_bundle({{"type", "product"}, {"factors", {"sphere", "so3", "euclidean"}}},
                             {"x[3]", "R[3][3]", "s"},
                             "(dot(p_x, p_x) + dot(p_R, p_R) + p_s^2)/2 + "
                             "x[0]*R[0][0] + x[1]*R[1][0] + s*x[2] + s^2",
                             {{"x", {0.48, 0.36, 0.8}},
                              {"R", kOne},
                              {"s", 0.3},
                              {"p_x", {-0.3, 0.4, 0}},
                              {"p_R", {0.7, -0.4, 1}},
                              {"p_s", 0.1}});
}

// A spherical pendulum in a field, without a symplectic form.
Json on_tangent_bundle() {
  Json equations;
  for (const std::string i : {"[0]", "[1]", "[2]"}) {
    equations.push_back("x" + i + "' - v_x" + i);
    equations.push_back("v_x" + i + "' + gradient" + i + " + (dot(v_x, v_x) - dot(x, gradient))*x" +
                        i);
  }
  return {{"system",
           {{"type", "implicit"},
            {"manifold", {{"type", "tangent-bundle"}, {"base", "sphere"}}},
            {"coordinates", {"x[3]"}},
            {"definitions", {{"gradient", {"x[1]", "x[0]", "1"}}}},
            {"equations", equations},
            {"energy", "dot(v_x, v_x)/2 + x[0]*x[1] + x[2]"}}},
          {"initial", {{"x", {0.6, 0, 0.8}}, {"v_x", {0.4, 0.7, -0.3}}}}};
}

}  // namespace

const std::vector<Motion>& motions() {
  static const std::vector<Motion> all = {
      {"S²", on_sphere("sphere"), {"midpoint", "chordal", "spherical-midpoint"}},
      {"S², projective",
       on_sphere({{"type", "sphere"}, {"retraction", "projective"}}),
       {"midpoint"}},
      {"H²",
       on_cotangent_bundle("hyperbolic", {"x[3]"},
                           "(p_x[1]^2 + p_x[2]^2 - p_x[0]^2)/2 + x[0] + x[1]/2",
                           {{"x", {1, 0, 0}}, {"p_x", {0, 0.4, 0.7}}}),
       {"exponential"}},
      {"T²",
       on_cotangent_bundle("torus", {"a[2]"},
                           "(p_a[0]^2 + p_a[1]^2)/2 - cos(a[0] - 2*a[1]) - cos(a[1])",
                           {{"a", {1, 0.4}}, {"p_a", {0.3, -0.5}}}),
       {"midpoint"}},
      {"SO(3)", on_rotations("so3"), {"exponential", "cayley"}},
      {"SO(3), Cayley", on_rotations({{"type", "so3"}, {"retraction", "cayley"}}), {"midpoint"}},
      {"SE(3)", on_rigid_motions(), {"exponential", "cayley"}},
      {"St(3, 2)",
       on_cotangent_bundle(
           "stiefel", {"X[3][2]"},
           "sum(i, 0, 2, p_X[i][0]^2 + p_X[i][1]^2)/2 + X[0][0] + X[1][0]*X[2][1]",
           {{"X", {{1, 0}, {0, 1}, {0, 0}}}, {"p_X", {{0, 0.3}, {-0.3, 0}, {0.5, 0.7}}}}),
       {"midpoint"}},
      {"P(2)",
       on_cotangent_bundle(
           "symmetric-positive-definite", {"X[3]"},
           "(p_X[0]^2 + p_X[1]^2 + 2*p_X[2]^2)/2 + X[0] + X[2] - log(X[0]*X[2] - X[1]^2)",
           {{"X", {2, 0.3, 1.5}}, {"p_X", {0.2, 0.4, -0.3}}}),
       {"exponential"}},
      {"S² × SO(3) × R", on_product(), {"exponential"}},
      {"an ellipsoid",
       on_cotangent_bundle(
           {{"type", "implicit-submanifold"}, {"equations", {"x[0]^2 + x[1]^2/2 + x[2]^2/4 - 1"}}},
           {"x[3]"}, "dot(p_x, p_x)/2 + x[2] + 0.3*x[0]",
           {{"x", {0.6, 0, 1.6}}, {"p_x", {0.3, 0.5, -0.45}}}),
       {"midpoint", "projected"}},
      {"TS²", on_tangent_bundle(), {"midpoint"}},
  };
  return all;
}

}  // namespace courant::test
