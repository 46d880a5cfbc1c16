// Files that are read.
#pragma once

#include <filesystem>
#include <fstream>
#include <system_error>

namespace courant {

// A file, to be read from its beginning. The stream has failed if it cannot be read, or is none: a
// folder, or a pipe or a device, which may have no end and nobody who writes to it.
inline std::ifstream input_file(const std::filesystem::path& file) {
  std::error_code error;
  std::ifstream stream;
  // Opening a pipe waits for somebody who writes to it.
  if (std::filesystem::is_regular_file(file, error))
    stream.open(file, std::ios::binary);
  else
    stream.setstate(std::ios::failbit);
  return stream;
}

}  // namespace courant
