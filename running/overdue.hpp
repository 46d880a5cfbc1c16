// Work that was asked to end and does not.
#pragma once

#include <atomic>
#include <functional>
#include <thread>

namespace courant {

// Work looks at `stop` between its pieces, and a piece may take minutes: the constraint algorithm of
// hundreds of unknowns is decompositions, which nothing can interrupt. While the object is there, a
// thread of its own calls `end` once, two seconds after `stop` was set, in which the process computed
// for one: somebody who waits for a disk is not at fault. `end` says what is known and ends the program.
// Nothing is watched where `stop` is null or `end` is empty.
class Overdue {
 public:
  Overdue(const std::atomic<bool>* stop, std::function<void()> end);

 private:
  std::jthread thread_;
};

}  // namespace courant
