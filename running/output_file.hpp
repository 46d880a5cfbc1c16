// Files that are never seen half-written.
#pragma once

#include <cstddef>
#include <cstdint>
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

// A file, written as its owner says. Throws OutputError.
class OutputFile {
 public:
  // A new file; an existing one is replaced at once.
  explicit OutputFile(const std::filesystem::path& path);
  // A file that is there, to be written on.
  struct Existing {};
  OutputFile(const std::filesystem::path& path, Existing);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  // All of the bytes or, with OutputError, what fits; a kill does not interrupt it.
  void write(std::string_view bytes);
  // Replaces bytes at the beginning.
  void overwrite(std::string_view bytes);
  // Cuts off what is longer than so many bytes, and writes on there. Throws OutputError if there
  // are fewer.
  void cut(std::uintmax_t size);
  // What was written reaches the disk.
  void close();

 private:
  // Errors have the name `asked`.
  OutputFile(const std::filesystem::path& path, const std::filesystem::path& asked, int flags);
  friend void write_file(const std::filesystem::path& path, std::string_view content,
                         const std::filesystem::path& asked);
  [[noreturn]] void fail() const;
  std::filesystem::path asked_;
  int descriptor_;
};

// Writes a file whole: under another name in its folder first, then moved. Where links lead to the
// file they stay; a device or a pipe is written to as it is. Throws OutputError with the name of the
// file, or with `asked` if this file is made on the way to that one.
void write_file(const std::filesystem::path& path, std::string_view content);
void write_file(const std::filesystem::path& path, std::string_view content,
                const std::filesystem::path& asked);

// The folder, and those above it. Throws OutputError.
void make_folder(const std::filesystem::path& path);

}  // namespace courant
