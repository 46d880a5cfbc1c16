#include "courant/running/checkpoint_keeper.hpp"

#include <boost/test/unit_test.hpp>

#include "courant/running/run_files.hpp"
#include "temporary_folder.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(checkpoint_keeper)

namespace {

struct Files {
  TemporaryFolder folder;
  std::unique_ptr<TrajectoryWriter> writer =
      make_trajectory_writer(Output::Format::csv, folder.path(), {"t", "x"});
  std::filesystem::path file = folder / "checkpoint.json";

  void keep(CheckpointKeeper& keeper, long k) {
    writer->append(static_cast<double>(k), VectorXd::Constant(1, 0.5));
    keeper.keep({.run = "id", .k = k, .trajectory_size = writer->size()});
  }
};

}  // namespace

BOOST_FIXTURE_TEST_CASE(rows_are_in_the_file_before_the_checkpoint_that_stands_on_them, Files) {
  CheckpointKeeper keeper(file, *writer, std::chrono::seconds(0));
  BOOST_TEST(std::filesystem::file_size(folder / "trajectory.csv") == 4u);
  keep(keeper, 7);
  BOOST_TEST(read_checkpoint(file).k == 7);
  BOOST_TEST(read_checkpoint(file).trajectory_size ==
             std::filesystem::file_size(folder / "trajectory.csv"));
}

BOOST_FIXTURE_TEST_CASE(not_every_checkpoint_is_written_but_the_last_is, Files) {
  CheckpointKeeper keeper(file, *writer, std::chrono::hours(1));
  keeper.flush();
  BOOST_TEST(!std::filesystem::exists(file));
  keep(keeper, 1);
  keep(keeper, 2);
  BOOST_TEST(!std::filesystem::exists(file));
  keeper.flush();
  BOOST_TEST(read_checkpoint(file).k == 2);
  std::filesystem::remove(file);
  keeper.flush();  // it has been written
  BOOST_TEST(!std::filesystem::exists(file));
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
