// Message: arrays of numbers, one behind the other, as bytes that go from one process to another.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace courant {

// Written by put() and read back by take() in the same order, between processes of one program on machines of one kind.
class Message {
 public:
  Message() = default;
  explicit Message(std::vector<std::byte> bytes) : bytes_(std::move(bytes)) {}

  const std::vector<std::byte>& bytes() const { return bytes_; }

  template <class T>
  requires std::is_trivially_copyable_v<T>
  void put(std::span<const T> numbers) {
    const std::uint64_t count = numbers.size();
    append(&count, sizeof count);
    append(numbers.data(), numbers.size_bytes());
  }
  template <class T>
  void put(const std::vector<T>& numbers) {
    put(std::span<const T>(numbers));
  }
  template <class T>
  requires std::is_arithmetic_v<T>
  void put(T number) { put(std::span<const T>(&number, 1)); }
  void put(const std::string& text) { put(std::span<const char>(text)); }

  // Throws std::out_of_range if there are not so many bytes.
  template <class T>
  std::vector<T> take() {
    std::uint64_t count = 0;
    read(&count, sizeof count);
    std::vector<T> numbers(count);
    read(numbers.data(), count * sizeof(T));
    return numbers;
  }
  template <class T>
  T take_one() {
    return take<T>().at(0);
  }
  std::string take_text() {
    const std::vector<char> text = take<char>();
    return {text.begin(), text.end()};
  }

 private:
  void append(const void* from, std::size_t count) {
    const auto* const first = static_cast<const std::byte*>(from);
    bytes_.insert(bytes_.end(), first, first + count);
  }
  void read(void* to, std::size_t count) {
    if (count > bytes_.size() - place_)
      throw std::out_of_range("Message::take: the message has fewer bytes.");
    if (count > 0) std::memcpy(to, bytes_.data() + place_, count);
    place_ += count;
  }

  std::vector<std::byte> bytes_;
  std::size_t place_ = 0;
};

}  // namespace courant
