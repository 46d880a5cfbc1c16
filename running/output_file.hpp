// Files that are never seen half-written.
#pragma once

#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

namespace courant {

// A file that cannot be written: one line, `file: what it is`.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// A new file, written as its owner says. An existing one is replaced at once. Throws OutputError.
class OutputFile {
 public:
  explicit OutputFile(const std::filesystem::path& path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  // All of the bytes or, with OutputError, what fits; a kill does not interrupt it.
  void write(std::string_view bytes);
  // Replaces bytes at the beginning.
  void overwrite(std::string_view bytes);
  // What was written reaches the disk.
  void close();

 private:
  [[noreturn]] void fail() const;
  std::filesystem::path path_;
  int descriptor_;
};

// Writes a file whole: under another name in its folder first, then moved. Throws OutputError.
void write_file(const std::filesystem::path& path, std::string_view content);

// The folder, and those above it. Throws OutputError.
void make_folder(const std::filesystem::path& path);

}  // namespace courant
