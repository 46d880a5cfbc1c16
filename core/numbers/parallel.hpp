// Work on all cores.
#pragma once

#include <cstddef>
#include <functional>

namespace courant {

// As many as the machine has cores, at least 1.
unsigned core_count();

// work(i) for i = 0 … count - 1, in this order of beginning, by so many threads at once. Returns
// when all have ended. What a call throws is thrown here after that; calls that have not begun by
// then are left out.
void in_parallel(std::size_t count, unsigned threads, const std::function<void(std::size_t)>& work);

}  // namespace courant
