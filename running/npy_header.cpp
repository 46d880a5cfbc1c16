#include "courant/running/npy_header.hpp"

#include <bit>

namespace courant {

static_assert(std::endian::native == std::endian::little);

std::string npy_header(const std::vector<std::size_t>& shape) {
  std::string text = "{'descr': '<f8', 'fortran_order': False, 'shape': (";
  for (std::size_t i = 0; i < shape.size(); ++i)
    text += (i > 0 ? ", " : "") + std::to_string(shape[i]);
  text += "), }";
  text.resize(kNpyHeader - 11, ' ');
  return std::string("\x93NUMPY\x01\x00\x76\x00", 10) + text + '\n';
}

}  // namespace courant
