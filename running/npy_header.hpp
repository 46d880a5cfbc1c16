// The beginning of a file of numpy that grows.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace courant {

// Bytes before the numbers, whatever the shape is, so that it can be written over itself.
constexpr std::size_t kNpyHeader = 128;

// That of little-endian doubles of this shape, row after row (version 1.0 of the format, numpy.lib.format).
std::string npy_header(const std::vector<std::size_t>& shape);

}  // namespace courant
