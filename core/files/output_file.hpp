// How a file is written: never half, never over what is there.
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

// The same, found before anything was written.
class RefusedOutput : public OutputError {
 public:
  using OutputError::OutputError;
};

// A file that grows, written as its owner says. Throws OutputError.
class OutputFile {
 public:
  // A new file. What stands under its name is removed, and a link leads nowhere.
  explicit OutputFile(const std::filesystem::path& path);
  // A file that is there and no link, to be written on.
  struct Existing {};
  OutputFile(const std::filesystem::path& path, Existing);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  // All of the bytes or, with OutputError, none of them, so that no half of a row is left, and on a full
  // disk there is place for a word on why; a kill does not interrupt it.
  void write(std::string_view bytes);
  // Replaces bytes at the beginning.
  void overwrite(std::string_view bytes);
  // Cuts off what is longer than so many bytes, and writes on there. Throws OutputError if there
  // are fewer.
  void cut(std::uintmax_t size);
  // What was written is on the disk, and outlasts a loss of power. Throws OutputError also if the
  // file was removed from its folder meanwhile: nobody would find what is written to it.
  void sync();

 private:
  // Errors have the name `asked`.
  OutputFile(const std::filesystem::path& path, std::filesystem::path asked, int flags);
  friend void write_file(const std::filesystem::path& path, std::string_view content);
  void close();
  [[noreturn]] void fail() const;
  std::filesystem::path asked_;
  int descriptor_;
};

// Bytes of a disk that nobody else can fill: for a last word on why a run ends, such as a full disk. They belong to
// the process, have no name, and are free again when it ends, however it ends. Where there is no room for them, or
// the file system cannot promise any, none are reserved, and that is no error.
class ReservedSpace {
 public:
  // On the disk of `folder`, which is there.
  ReservedSpace(const std::filesystem::path& folder, std::size_t bytes);
  ~ReservedSpace();
  ReservedSpace(const ReservedSpace&) = delete;
  ReservedSpace& operator=(const ReservedSpace&) = delete;

 private:
  int descriptor_;
};

// Writes a file whole: under another name in its folder first, which is synced, then moved to its
// name. A loss of power leaves the former file or this one. Where links lead to the file they stay;
// a device or a pipe is written to as it is. Whose the former file is asks FileMark. Throws
// OutputError with the name of the file.
void write_file(const std::filesystem::path& path, std::string_view content);

// Removes from a folder what write_file leaves there when it is killed. For a folder that nobody
// else writes to meanwhile.
void remove_unfinished_files(const std::filesystem::path& folder);

// The folder, and those above it. Throws OutputError.
void make_folder(const std::filesystem::path& path);

}  // namespace courant
