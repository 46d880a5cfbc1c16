#include "courant/core/linear/two_ended_ordering.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <numeric>
#include <random>
#include <set>
#include <utility>

// Mistakes that these cases have to notice:
//  * one half comes after the other
//  * a graph is cut where it is wide
//  * what cuts a graph does not come last
//  * levels are counted from the middle
BOOST_AUTO_TEST_SUITE(two_ended_ordering)

namespace {

// A graph as the pattern of a symmetric matrix, its nodes in any order.
class Pattern {
 public:
  explicit Pattern(int n, unsigned seed = 0)
      : name_(static_cast<std::size_t>(n)), columns_(name_.size()) {
    std::iota(name_.begin(), name_.end(), 0);
    std::mt19937 generator(seed);
    if (seed > 0) std::shuffle(name_.begin(), name_.end(), generator);
    for (std::size_t i = 0; i < columns_.size(); ++i) columns_[i].insert(static_cast<int>(i));
  }
  void join(int i, int j) {
    const int a = name_[static_cast<std::size_t>(i)], b = name_[static_cast<std::size_t>(j)];
    columns_[static_cast<std::size_t>(a)].insert(b);
    columns_[static_cast<std::size_t>(b)].insert(a);
  }
  std::vector<int> ordering() const {
    std::vector<int> offsets{0}, rows;
    for (const auto& column : columns_) {
      rows.insert(rows.end(), column.begin(), column.end());
      offsets.push_back(static_cast<int>(rows.size()));
    }
    return courant::two_ended_ordering(offsets, rows);
  }
  bool are_joined(int a, int b) const { return columns_[static_cast<std::size_t>(a)].contains(b); }
  // Entries of L below the diagonal, by elimination in this order.
  std::size_t fill(const std::vector<int>& order) const {
    auto left = columns_;
    std::size_t result = 0;
    for (const int i : order) {
      auto around = left[static_cast<std::size_t>(i)];
      around.erase(i);
      result += around.size();
      for (const int j : around) {
        left[static_cast<std::size_t>(j)].insert(around.begin(), around.end());
        left[static_cast<std::size_t>(j)].erase(i);
      }
    }
    return result;
  }

 private:
  std::vector<int> name_;
  std::vector<std::set<int>> columns_;
};

Pattern line(int n, unsigned seed) {
  Pattern result(n, seed);
  for (int i = 0; i + 1 < n; ++i) result.join(i, i + 1);
  return result;
}

// Two lines with rungs, and a node hanging at each rung.
Pattern ladder(int rungs) {
  Pattern result(3 * rungs, 5);
  for (int i = 0; i < rungs; ++i) {
    result.join(i, rungs + i);
    result.join(i, 2 * rungs + i);
    if (i + 1 < rungs) result.join(i, i + 1), result.join(rungs + i, rungs + i + 1);
  }
  return result;
}

Pattern grid(int side) {
  Pattern result(side * side);
  for (int i = 0; i < side; ++i)
    for (int j = 0; j + 1 < side; ++j) {
      result.join(i * side + j, i * side + j + 1);
      result.join(j * side + i, (j + 1) * side + i);
    }
  return result;
}

bool is_permutation(std::vector<int> order, std::size_t n) {
  std::ranges::sort(order);
  for (std::size_t i = 0; i < order.size(); ++i)
    if (order[i] != static_cast<int>(i)) return false;
  return order.size() == n;
}

// Of the unknowns, the part that is joined with the one before.
double waiting(const Pattern& pattern, const std::vector<int>& order) {
  double count = 0.0;
  for (std::size_t k = 1; k < order.size(); ++k)
    count += pattern.are_joined(order[k - 1], order[k]);
  return count / static_cast<double>(order.size());
}

}  // namespace

// With as little fill as from one end to the other, and only in the middle something waits for what was just before.
BOOST_AUTO_TEST_CASE(a_line_is_taken_from_both_ends) {
  for (const int n : {32, 33, 100, 1001}) {
    const Pattern pattern = line(n, static_cast<unsigned>(n));
    const std::vector<int> order = pattern.ordering();
    BOOST_TEST_REQUIRE(is_permutation(order, static_cast<std::size_t>(n)));
    BOOST_TEST(pattern.fill(order) == static_cast<std::size_t>(n - 1));
    BOOST_TEST(waiting(pattern, order) <= 4.0 / n);
  }
}

BOOST_AUTO_TEST_CASE(rings_and_ladders_are_cut) {
  Pattern ring = line(200, 3);
  ring.join(0, 199);
  const std::vector<int> of_ring = ring.ordering();
  BOOST_TEST_REQUIRE(is_permutation(of_ring, 200));
  BOOST_TEST(ring.fill(of_ring) <= 2u * 200u);
  BOOST_TEST(waiting(ring, of_ring) < 0.05);

  const Pattern of_rungs = ladder(150);
  const std::vector<int> order = of_rungs.ordering();
  BOOST_TEST_REQUIRE(is_permutation(order, 450));
  BOOST_TEST(of_rungs.fill(order) < 5u * 150u);
  BOOST_TEST(waiting(of_rungs, order) < 0.05);
}

// Small ones, such as are in several parts, and such as are as wide as long, have no ends.
BOOST_AUTO_TEST_CASE(others_are_left_alone) {
  BOOST_TEST(line(20, 1).ordering().empty());
  BOOST_TEST(grid(30).ordering().empty());
  BOOST_TEST(Pattern(100).ordering().empty());
  Pattern apart(200);
  for (int i = 0; i + 1 < 200; ++i)
    if (i != 99) apart.join(i, i + 1);
  BOOST_TEST(apart.ordering().empty());
  Pattern star(300);
  for (int i = 1; i < 300; ++i) star.join(0, i);
  BOOST_TEST(star.ordering().empty());
  Pattern knot = line(300, 4);  // with a clique in its middle
  for (int i = 140; i < 160; ++i)
    for (int j = 140; j < i; ++j) knot.join(i, j);
  BOOST_TEST(knot.ordering().empty());
}

BOOST_AUTO_TEST_SUITE_END()
