#include "courant/running/checkpoint_keeper.hpp"

#include <boost/test/unit_test.hpp>
#include <vector>

namespace courant {
// Mistakes that these cases have to notice:
//  * each checkpoint is written
BOOST_AUTO_TEST_SUITE(checkpoint_keeper)

namespace {

struct Written {
  std::vector<long> steps;
  CheckpointKeeper keeper(std::chrono::duration<double> interval) {
    return {[this](const Checkpoint& checkpoint) { steps.push_back(checkpoint.k); }, interval};
  }
};

}  // namespace

BOOST_FIXTURE_TEST_CASE(each_is_written_where_there_is_time, Written) {
  CheckpointKeeper all = keeper(std::chrono::seconds(0));
  all.keep({.run = "id", .k = 7});
  BOOST_TEST(steps == std::vector<long>{7});
}

BOOST_FIXTURE_TEST_CASE(not_every_checkpoint_is_written_but_the_last_is, Written) {
  CheckpointKeeper few = keeper(std::chrono::hours(1));
  few.flush();
  few.keep({.run = "id", .k = 1});
  few.keep({.run = "id", .k = 2});
  BOOST_TEST(steps.empty());
  few.flush();
  few.flush();  // it has been written
  BOOST_TEST(steps == std::vector<long>{2});
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
