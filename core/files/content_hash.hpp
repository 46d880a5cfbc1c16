// Hashes that tell whether bytes are what they were.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace courant {

// 32 hexadecimal digits (XXH3, 128 bits). Tells damage and edits, not forgery.
std::string content_hash(std::string_view content);

// Bytes that are appended one after the other, by hashes of their parts: of so many bytes that there
// are never more than kMostParts of them, so that a file that is no longer what it was is known
// where it differs. Appending costs 0.1 ns a byte.
class HashedBytes {
 public:
  static constexpr std::size_t kLeast = 4096;  // bytes of a part
  static constexpr std::size_t kMostParts = 256;

  // What is known of the bytes so far.
  struct Record {
    std::uintmax_t size = 0;       // bytes
    std::uintmax_t part = kLeast;  // bytes that a hash is of; the last may be of fewer
    std::vector<std::uintmax_t> hashes = {};
    bool operator==(const Record&) const = default;
  };

  void append(std::string_view bytes);
  std::uintmax_t size() const { return size_; }
  Record record() const;

 private:
  static void add(Record& record, std::uintmax_t leaf, std::string_view bytes);

  std::uintmax_t size_ = 0;
  Record whole_;      // of whole leaves, kLeast bytes each
  std::string leaf_;  // that is not whole yet
};

// Which bytes of a file, from `begin` on, are not those of a record: the first such part, [from, to);
// nothing, from = to, if all are. What the file has beyond them does not matter. A file that cannot
// be read or ends too early has other bytes there.
struct Difference {
  std::uintmax_t from = 0, to = 0;
  bool is_none() const { return from == to; }
};
// `found`: the bytes as they are in the file, to go on with.
Difference difference(const std::filesystem::path& file, std::uintmax_t begin,
                      const HashedBytes::Record& record, HashedBytes* found = nullptr);

}  // namespace courant
