#include "courant/core/numbers/parallel.hpp"

#include <atomic>
#include <boost/test/unit_test.hpp>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

namespace courant {

BOOST_AUTO_TEST_SUITE(parallel)

BOOST_AUTO_TEST_CASE(each_index_once) {
  for (const unsigned threads : {0U, 1U, 3U, 200U}) {
    std::vector<std::atomic<int>> calls(100);
    in_parallel(calls.size(), threads, [&](std::size_t i) { ++calls[i]; });
    for (const auto& count : calls) BOOST_TEST(count == 1);
  }
  in_parallel(0, 2, [](std::size_t) { BOOST_ERROR("there is nothing to do"); });
  BOOST_TEST(core_count() >= 1u);
}

// Two calls that wait for one another end only where both are under way.
BOOST_AUTO_TEST_CASE(several_at_once) {
  std::atomic<int> begun{0};
  in_parallel(2, 2, [&](std::size_t) {
    ++begun;
    while (begun < 2) std::this_thread::yield();
  });
  BOOST_TEST(begun == 2);
}

BOOST_AUTO_TEST_CASE(what_is_thrown_ends_it_and_is_thrown_on) {
  std::atomic<int> calls{0};
  BOOST_CHECK_THROW(in_parallel(1000, 2,
                                [&](std::size_t i) {
                                  ++calls;
                                  if (i == 3) throw std::runtime_error("three");
                                  std::this_thread::sleep_for(std::chrono::milliseconds(1));
                                }),
                    std::runtime_error);
  BOOST_TEST(calls < 1000);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
