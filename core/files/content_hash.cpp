#include "courant/core/files/content_hash.hpp"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <fstream>

#include "courant/core/files/input_file.hpp"

namespace courant {
namespace {

void add_digits(std::string& text, std::uint64_t bits) {
  for (int shift = 60; shift >= 0; shift -= 4) text += "0123456789abcdef"[(bits >> shift) & 0xF];
}

}  // namespace

std::string content_hash(std::string_view content) {
  const XXH128_hash_t hash = XXH3_128bits(content.data(), content.size());
  std::string digits;
  add_digits(digits, hash.high64);
  add_digits(digits, hash.low64);
  return digits;
}

// The hash of a part is the sum of those of its leaves, each with its place: parts are joined by
// addition.
void HashedBytes::add(Record& record, std::uintmax_t leaf, std::string_view bytes) {
  std::size_t part = leaf / (record.part / kLeast);
  if (part == kMostParts) {
    for (std::size_t i = 0; i < kMostParts / 2; ++i)
      record.hashes[i] = record.hashes[2 * i] + record.hashes[2 * i + 1];
    record.hashes.resize(kMostParts / 2);
    record.part *= 2;
    part /= 2;
  }
  if (part == record.hashes.size()) record.hashes.push_back(0);
  record.hashes[part] += XXH3_64bits_withSeed(bytes.data(), bytes.size(), leaf);
  record.size += bytes.size();
}

void HashedBytes::append(std::string_view bytes) {
  size_ += bytes.size();
  while (!bytes.empty()) {
    const std::size_t taken = std::min(bytes.size(), kLeast - leaf_.size());
    leaf_ += bytes.substr(0, taken);
    bytes.remove_prefix(taken);
    if (leaf_.size() < kLeast) return;
    add(whole_, whole_.size / kLeast, leaf_);
    leaf_.clear();
  }
}

HashedBytes::Record HashedBytes::record() const {
  Record record = whole_;
  if (!leaf_.empty()) add(record, whole_.size / kLeast, leaf_);
  return record;
}

Difference difference(const std::filesystem::path& file, std::uintmax_t begin,
                      const HashedBytes::Record& record, HashedBytes* found) {
  HashedBytes bytes;
  std::ifstream stream = input_file(file);
  stream.seekg(static_cast<std::streamoff>(begin));
  std::array<char, 1 << 16> block;
  while (stream && bytes.size() < record.size) {
    stream.read(block.data(), static_cast<std::streamsize>(std::min<std::uintmax_t>(
                                  block.size(), record.size - bytes.size())));
    bytes.append({block.data(), static_cast<std::size_t>(stream.gcount())});
  }
  const HashedBytes::Record there = bytes.record();
  if (found != nullptr) *found = std::move(bytes);
  if (there == record) return {};
  std::size_t part = 0;  // a file that is too short may have smaller parts
  const std::size_t last = std::max<std::size_t>(record.hashes.size(), 1) - 1;
  if (there.part == record.part)
    while (part < std::min(there.hashes.size(), last) && there.hashes[part] == record.hashes[part])
      ++part;
  const std::uintmax_t from = part * record.part;
  return {.from = begin + from, .to = begin + std::min(from + record.part, record.size)};
}

}  // namespace courant
