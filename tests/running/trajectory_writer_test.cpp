#include "courant/running/trajectory_writer.hpp"

#include <boost/test/unit_test.hpp>
#include <limits>
#include <random>

#include "courant/running/run_files.hpp"
#include "temporary_folder.hpp"

namespace courant {
namespace {

using Format = Output::Format;

std::vector<std::vector<double>> random_rows(std::size_t count) {
  std::mt19937_64 generator(5);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> exponent(-300, 300);
  std::vector<std::vector<double>> rows(count, std::vector<double>(3));
  for (auto& row : rows)
    for (double& value : row) value = normal(generator) * std::pow(10.0, exponent(generator));
  rows[0] = {0.0, -0.0, std::numeric_limits<double>::denorm_min()};
  rows[1] = {0.1, std::numeric_limits<double>::max(), 1.0 / 3.0};
  return rows;
}

void append(TrajectoryWriter& writer, const std::vector<double>& row) {
  writer.append(row[0], Eigen::Map<const VectorXd>(row.data() + 1, 2));
}

void check_equal(const TrajectoryTable& table, const std::vector<std::vector<double>>& rows) {
  BOOST_REQUIRE(table.rows() == rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t j = 0; j < 3; ++j)
      BOOST_REQUIRE(table.column(table.names()[j])[i] == rows[i][j]);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(trajectory_writer)

BOOST_AUTO_TEST_CASE(every_number_reads_back_to_itself) {
  const TemporaryFolder folder;
  const auto rows = random_rows(20000);  // more than one block
  for (const Format format : {Format::csv, Format::npy}) {
    const auto writer = make_trajectory_writer(format, folder.path(), {"t", "x", "H"});
    for (const auto& row : rows) append(*writer, row);
    writer->flush();
  }
  check_equal(read_trajectory_csv(folder / "trajectory.csv"), rows);
  check_equal(read_trajectory_npy(folder / "trajectory.npy", {"t", "x", "H"}), rows);
  BOOST_TEST(read_text(folder / "columns.json") == "[\"t\",\"x\",\"H\"]\n");
}

BOOST_AUTO_TEST_CASE(writes_the_fewest_digits) {
  const TemporaryFolder folder;
  const auto writer = make_trajectory_writer(Format::csv, folder.path(), {"t", "x", "y"});
  append(*writer, {0.1, 1e22, -0.5});
  writer->flush();
  BOOST_TEST(read_text(folder / "trajectory.csv") == "t,x,y\n0.1,1e+22,-0.5\n");
}

// What is on disk at any moment is whole: a reader takes it.
BOOST_AUTO_TEST_CASE(there_are_only_whole_rows_at_any_moment) {
  const TemporaryFolder folder;
  const auto rows = random_rows(30000);
  const auto csv = make_trajectory_writer(Format::csv, folder.path(), {"t", "x", "H"});
  const auto npy = make_trajectory_writer(Format::npy, folder.path(), {"t", "x", "H"});
  std::size_t most = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    append(*csv, rows[i]);
    append(*npy, rows[i]);
    if (i % 5000 != 17) continue;
    const auto from_csv = read_trajectory_csv(folder / "trajectory.csv");
    const auto from_npy = read_trajectory_npy(folder / "trajectory.npy", {"t", "x", "H"});
    BOOST_TEST(from_csv.rows() <= i + 1);
    BOOST_TEST(from_npy.rows() <= i + 1);
    most = std::max(from_csv.rows(), from_npy.rows());
  }
  BOOST_TEST(most > 0u);  // something was written before the end
}

BOOST_AUTO_TEST_CASE(says_why_a_file_cannot_be_written) {
  const TemporaryFolder folder;
  write_text(folder / "file", "");
  BOOST_CHECK_EXCEPTION(make_trajectory_writer(Format::csv, folder / "file", {"t"}), OutputError,
                        [&](const OutputError& error) {
                          return error.what() == (folder / "file" / "trajectory.csv").string() +
                                                     ": cannot be written: Not a directory";
                        });
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
