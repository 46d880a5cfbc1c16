#include "courant/structures/stokes_dirac/cell_complex.hpp"

#include <Eigen/Geometry>
#include <boost/test/unit_test.hpp>

#include "courant/structures/stokes_dirac/cell_complex_laws.hpp"
#include "meshes.hpp"

// Mistakes that these cases have to notice:
//  * the signs of faces of a box do not alternate (structures/stokes_dirac/cell_complex_grid.cpp)
//  * a triangle or tetrahedron is oriented by the numbers of its vertices (structures/stokes_dirac/cell_complex_simplices.cpp)
//  * a distance has no sign (structures/stokes_dirac/cell_complex_simplices.cpp)
//  * duals of the boundary belong to all of it (structures/stokes_dirac/cell_complex.cpp)
BOOST_AUTO_TEST_SUITE(cell_complex_test)

using namespace courant;
using namespace courant::test;

namespace {

std::vector<std::pair<const char*, CellComplex>> complexes() {
  std::mt19937 generator(3);
  std::vector<std::pair<const char*, CellComplex>> all;
  all.emplace_back("interval", CellComplex::grid({random_lines(5, generator)}));
  all.emplace_back("rectangle",
                   CellComplex::grid({random_lines(4, generator), random_lines(3, generator)}));
  all.emplace_back("box", CellComplex::grid({random_lines(3, generator), random_lines(2, generator),
                                             random_lines(4, generator)}));
  all.emplace_back("triangle", triangle(5, 0.1));
  all.emplace_back("tetrahedra", two_tetrahedra());
  all.emplace_back("graph", CellComplex::graph(4, {{0, 1}, {2, 1}, {1, 3}, {3, 2}},
                                               VectorXd{{1.0, 2.0, 0.5, 0.7}}));
  return all;
}

// The point of all its vertices with the same weight: where the integral of a linear form is exact.
MatrixXd centroids(const CellComplex& K, Index k) {
  MatrixXd sums = K.positions(0);
  MatrixXd counts = MatrixXd::Ones(K.count(0), 1);
  SparseMatrixXd down(K.count(0), K.count(0));
  down.setIdentity();
  // Vertices of cells: of faces of faces, each once.
  for (Index j = 0; j < k; ++j) {
    SparseMatrixXd up = SparseMatrixXd(K.coboundary(j).cwiseAbs()) * down;
    for (Index c = 0; c < up.outerSize(); ++c)
      for (SparseMatrixXd::InnerIterator it(up, c); it; ++it) it.valueRef() = 1.0;
    down = up;
  }
  const VectorXd number = down * VectorXd::Ones(K.count(0));
  return number.cwiseInverse().asDiagonal() * (down * sums);
}

// The integrals of a linear vector field along edges or through faces.
VectorXd integrals(const CellComplex& K, Index k, const Eigen::Matrix3d& A) {
  const MatrixXd field = centroids(K, k) * A.transpose();
  return K.measures(k).cwiseProduct(field.cwiseProduct(K.directions(k)).rowwise().sum());
}

Eigen::Matrix3d some_matrix() {
  Eigen::Matrix3d A;
  A << 0.3, -1.0, 0.7, 0.2, 0.9, -0.4, 1.1, 0.5, -0.6;
  return A;
}

bool refuses(const std::function<void()>& action, const std::string& part) {
  try {
    action();
  } catch (const std::invalid_argument& error) {
    return std::string(error.what()).find(part) != std::string::npos;
  }
  return false;
}

}  // namespace

BOOST_AUTO_TEST_CASE(laws) {
  for (const auto& [name, complex] : complexes())
    for (const LawResult& law : check_cell_complex(complex))
      BOOST_TEST(law.passed(), name << ": " << law.law << ", " << law.defect << " " << law.where);
}

// Stokes' theorem on each cell: d of the integrals of a field are those of its curl, and of its divergence.
BOOST_AUTO_TEST_CASE(stokes_theorem) {
  const Eigen::Matrix3d A = some_matrix();
  const Eigen::Vector3d curl(A(2, 1) - A(1, 2), A(0, 2) - A(2, 0), A(1, 0) - A(0, 1));
  for (const auto& [name, K] : complexes()) {
    if (K.dimension() < 2) continue;
    const VectorXd along = integrals(K, 1, A);
    const VectorXd through = K.measures(2).cwiseProduct(K.directions(2) * curl);
    BOOST_TEST((K.coboundary(1) * along - through).norm() < 1e-13, name);
    BOOST_TEST(through.norm() > 0.1, name);
    if (K.dimension() < 3) continue;
    const VectorXd out = K.coboundary(2) * integrals(K, 2, A);
    BOOST_TEST((out - A.trace() * K.measures(3)).norm() < 1e-13, name);
  }
}

// Cells of the plane look up, whatever order a table gives their vertices in.
BOOST_AUTO_TEST_CASE(orientation) {
  const CellComplex K = triangle(4);
  BOOST_TEST((K.directions(2).col(2).array() > 0.9).all());
  const CellComplex line = CellComplex::simplicial(
      MatrixXd{{2.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}}, {{0, 2}, {1, 2}});
  BOOST_TEST((line.directions(1).col(0).array() > 0.9).all());
  BOOST_TEST((line.coboundary(0) * line.positions(0).col(0)).minCoeff() > 0.9);
}

BOOST_AUTO_TEST_CASE(boundaries) {
  const CellComplex box = CellComplex::box({2.0, 3.0, 5.0}, {2, 3, 4});
  BOOST_TEST(box.boundary().size() == 2U * (2 * 3 + 2 * 4 + 3 * 4));
  const auto area = [&](const char* name) {
    return box.boundary_dual_measures(0, box.region(name)->facets).sum();
  };
  BOOST_TEST(std::abs(area("left") - 15.0) < 1e-13);
  BOOST_TEST(std::abs(area("top") - 10.0) < 1e-13);
  BOOST_TEST(std::abs(area("front") - 6.0) < 1e-13);
  // Edges of the front, with the length of their duals there: two directions.
  const VectorXd duals = box.boundary_dual_measures(1, box.region("front")->facets);
  BOOST_TEST(std::abs(duals.dot(box.measures(1)) - 12.0) < 1e-13);
  BOOST_TEST(box.cells_of(1, box.region("front")->facets).size() == 2U * 4 + 3U * 3);
  BOOST_TEST((box.positions(2)(box.region("front")->facets[0], 2) == 5.0));
  BOOST_TEST((box.positions(2)(box.region("bottom")->facets[0], 1) == 0.0));
  BOOST_TEST(!box.region("nowhere"));

  const CellComplex corner = triangle(3);
  BOOST_TEST(corner.boundary().size() == 9U);
  BOOST_TEST(std::abs(corner.boundary_dual_measures(0, corner.boundary()).sum() - 3.0) < 1e-13);
  const VectorXd bottom = corner.boundary_dual_measures(0, corner.region("bottom")->facets);
  BOOST_TEST(std::abs(bottom[0] - 1.0 / 6.0) < 1e-13);
  BOOST_TEST(std::abs(bottom.sum() - 1.0) < 1e-13);

  const CellComplex graph =
      CellComplex::graph(4, {{0, 1}, {1, 2}, {1, 3}}, VectorXd{{1.0, 2.0, 3.0}});
  BOOST_TEST((graph.boundary() == std::vector<Index>{0, 2, 3}));
  BOOST_TEST(graph.dual_measures(0)[1] == 3.0);
  BOOST_TEST(graph.region("end3")->facets[0] == 3);
}

// The dual of an edge that two obtuse angles look at would be negative: the lengths have signs.
BOOST_AUTO_TEST_CASE(refused) {
  const auto kite = [](double half_height) {
    CellComplex::simplicial(
        MatrixXd{
            {-1.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, half_height, 0.0}, {0.0, -half_height, 0.0}},
        {{0, 1, 2}, {0, 3, 1}});
  };
  BOOST_CHECK_NO_THROW(kite(1.2));
  BOOST_TEST(refuses([&] { kite(1.0); }, "the dual of the cell 0 of dimension 1"));
  BOOST_TEST(refuses([&] { kite(0.8); }, "the dual of the cell"));
  const MatrixXd vertices{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.4, 0.9, 0.0}, {2.0, 0.0, 0.0}};
  BOOST_TEST(refuses(
      [&] {
        CellComplex::simplicial(vertices, {{0, 1, 2}});
      },
      "belong to no simplex"));
  BOOST_TEST(refuses([&] { CellComplex::simplicial(vertices, {{0, 1, 3}}); }, "has the size 0"));
  BOOST_TEST(refuses(
      [&] {
        CellComplex::simplicial(vertices, {{0, 1, 4}});
      },
      "different ones from 0 to 3"));
  BOOST_TEST(refuses(
      [&] {
        CellComplex::simplicial(vertices, {{0, 1, 2}, {2, 1, 0}});
      },
      "is there already"));
  BOOST_TEST(refuses([] { CellComplex::interval(1.0, 0); }, "0 cells"));
  BOOST_TEST(refuses([] { CellComplex::grid({VectorXd{{0.0, 1.0, 1.0}}}); }, "do not increase"));
  BOOST_TEST(refuses(
      [] {
        CellComplex::interval(1.0, 3).with_region({"middle", {1}});
      },
      "not on the boundary"));
  BOOST_TEST(refuses(
      [] {
        CellComplex::graph(2, {{0, 2}}, VectorXd::Ones(1));
      },
      "leads from 0 to 2"));
}

BOOST_AUTO_TEST_SUITE_END()
