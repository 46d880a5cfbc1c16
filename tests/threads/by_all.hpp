// Eight threads that ask the same at once.
#pragma once

#include <array>
#include <functional>
#include <iostream>
#include <latch>
#include <string>
#include <thread>
#include <vector>

#include "courant/core/expressions/expr.hpp"

namespace courant {

inline constexpr std::size_t kThreads = 8;
inline int differences = 0;

// The results of all threads, which begin at once. What they throw ends the program.
inline std::array<VectorXd, kThreads> by_all(const std::function<VectorXd()>& work) {
  std::array<VectorXd, kThreads> results;
  std::latch begin(kThreads);
  {
    std::vector<std::jthread> threads;
    for (VectorXd& result : results)
      threads.emplace_back([&] {
        begin.arrive_and_wait();
        result = work();
      });
  }
  return results;
}

inline void require_one_answer(const std::string& what, const std::function<VectorXd()>& work) {
  const auto results = by_all(work);
  for (const VectorXd& result : results)
    if (result.size() != results[0].size() || !(result.array() == results[0].array()).all()) {
      std::cout << what << ": threads found different numbers\n";
      ++differences;
      return;
    }
}

}  // namespace courant
