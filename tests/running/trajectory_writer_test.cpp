#include "courant/running/trajectory_writer.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cstdio>
#include <limits>
#include <random>

#include "../core/files/temporary_folder.hpp"
#include "courant/running/run_files.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(trajectory_writer)

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

BOOST_AUTO_TEST_CASE(goes_on_with_a_file_from_any_row) {
  const auto rows = random_rows(20000);
  for (const Format format : {Format::csv, Format::npy})
    for (const std::size_t whole : {0u, 1u, 777u, 19999u}) {
      const TemporaryFolder folder, other;
      {
        const auto all = make_trajectory_writer(format, other.path(), {"t", "x", "H"});
        for (const auto& row : rows) append(*all, row);
        all->flush();
      }
      const auto file = folder / trajectory_name(format);
      const auto writer = make_trajectory_writer(format, folder.path(), {"t", "x", "H"});
      for (std::size_t i = 0; i < whole; ++i) append(*writer, rows[i]);
      const HashedBytes::Record kept = writer->record();  // also of what is kept back
      for (std::size_t i = whole; i < 20000; ++i) append(*writer, rows[i]);
      writer->flush();
      const auto again = make_trajectory_writer(format, folder.path(), {"t", "x", "H"}, &kept);
      BOOST_TEST((again->record() == kept));
      BOOST_TEST(std::filesystem::file_size(file) ==
                 kept.size + (format == Format::npy ? 128u : 0u));
      if (format == Format::npy)
        BOOST_TEST(read_trajectory_npy(file, {"t", "x", "H"}).rows() == whole);
      for (std::size_t i = whole; i < rows.size(); ++i) append(*again, rows[i]);
      again->flush();
      BOOST_TEST((read_text(file) == read_text(other / trajectory_name(format))));
    }
}

BOOST_AUTO_TEST_CASE(a_file_that_lost_rows_is_not_written_on) {
  const TemporaryFolder folder;
  for (const Format format : {Format::csv, Format::npy}) {
    const auto writer = make_trajectory_writer(format, folder.path(), {"t", "x", "H"});
    append(*writer, {0.1, 0.2, 0.3});
    const HashedBytes::Record record = writer->record();  // of a row that is kept back
    BOOST_TEST(damage(format, folder.path(), record).has_value());
    BOOST_CHECK_THROW(make_trajectory_writer(format, folder.path(), {"t", "x", "H"}, &record),
                      OutputError);
    std::filesystem::remove(folder / trajectory_name(format));
    BOOST_CHECK_THROW(make_trajectory_writer(format, folder.path(), {"t", "x", "H"}, &record),
                      OutputError);
  }
}

// A power cut leaves zeros, an editor another digit: each is found, and where.
BOOST_AUTO_TEST_CASE(damage_is_told_by_its_rows) {
  const auto rows = random_rows(2000);
  for (const Format format : {Format::csv, Format::npy}) {
    const TemporaryFolder folder;
    const auto file = folder / trajectory_name(format);
    const auto writer = make_trajectory_writer(format, folder.path(), {"t", "x", "H"});
    for (const auto& row : rows) append(*writer, row);
    writer->sync();
    const HashedBytes::Record record = writer->record();
    BOOST_TEST(!damage(format, folder.path(), record));
    const std::string whole = read_text(file);
    const auto damaged = [&](std::size_t at, const std::string& bytes) {
      std::string text = whole;
      write_text(file, text.replace(at, bytes.size(), bytes));
      return damage(format, folder.path(), record).value_or("whole");
    };
    const std::size_t at = whole.size() / 2;
    // Where the row is that the byte stands in, by the file as it was.
    const std::size_t row = format == Format::csv
                                ? static_cast<std::size_t>(std::count(
                                      whole.begin(), whole.begin() + static_cast<Index>(at), '\n'))
                                : (at - 128) / 24 + 1;
    if (format == Format::csv)
      BOOST_TEST(damaged(at, std::string(2000, '\0')) ==
                 "row " + std::to_string(row) + " is not as it was written");
    const std::string edited = damaged(at, whole[at] == '7' ? "8" : "7");
    std::size_t first = 0, last = 0;
    BOOST_TEST_REQUIRE(std::sscanf(edited.c_str(), "rows %zu to %zu are not as", &first, &last) ==
                       2);
    BOOST_TEST(first <= row);
    BOOST_TEST(row <= last);
    BOOST_TEST(last - first < 500u);
    write_text(file, whole.substr(0, at));
    BOOST_TEST(damage(format, folder.path(), record).has_value());
    write_text(file, whole + "1,2,3");  // what was written since does not matter
    BOOST_TEST(!damage(format, folder.path(), record));
  }
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
