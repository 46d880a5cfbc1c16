// What changes of a text by chance, of any format, have in common.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <random>
#include <string>

namespace courant::fuzz {

using Generator = std::mt19937;

// A number below the bound, which is positive.
inline std::size_t below(std::size_t bound, Generator& generator) {
  return std::uniform_int_distribution<std::size_t>(0, bound - 1)(generator);
}

// What LLVMFuzzerCustomMutator does: `change` makes one to three changes that the format knows; every fourth time, and
// where it leaves nothing (an empty text: it cannot be changed so) or too much, letters are changed. Returns the new
// size.
std::size_t mutate_text(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed,
                        const std::function<std::string(const std::string& text, std::size_t times,
                                                        Generator&)>& change);

}  // namespace courant::fuzz
