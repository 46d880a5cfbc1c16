// What the sources use of C++20 and the standard library of Emscripten in Debian (libc++ 13) lacks. It is included before all
// else where Emscripten compiles (cmake/CourantBrowser.cmake); the sources are as they are. Goes when Debian's Emscripten
// has libc++ 16.
#pragma once

#include <version>
#if defined(_LIBCPP_VERSION) && _LIBCPP_VERSION < 16000

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <iterator>
#include <memory>
#include <numeric>
#include <string>
#include <thread>
#include <type_traits>
#include <utility>

// NOLINTBEGIN(cert-dcl58-cpp): namespace std is added to, as a library of 2022 would have it.
namespace std {

template <class To, class From>
To bit_cast(const From& from) {
  To to;
  std::memcpy(&to, &from, sizeof(To));
  return to;
}

template <class T>
unique_ptr<T> make_unique_for_overwrite(size_t size) {
  return unique_ptr<T>(new remove_extent_t<T>[size]);
}

namespace ranges {

struct whole {
  template <class T>
  constexpr T&& operator()(T&& value) const {
    return static_cast<T&&>(value);
  }
};

template <class R, class T, class P = whole>
auto find(R&& range, const T& value, P of = {}) {
  return std::find_if(std::begin(range), std::end(range),
                      [&](auto&& one) { return std::invoke(of, one) == value; });
}
template <class R, class F, class P = whole>
auto find_if(R&& range, F is, P of = {}) {
  return std::find_if(std::begin(range), std::end(range),
                      [&](auto&& one) { return std::invoke(is, std::invoke(of, one)); });
}
template <class R, class F, class P = whole>
bool any_of(R&& range, F is, P of = {}) {
  return ranges::find_if(range, is, of) != std::end(range);
}
template <class R, class F, class P = whole>
bool none_of(R&& range, F is, P of = {}) {
  return !ranges::any_of(range, is, of);
}
template <class R, class F, class P = whole>
bool all_of(R&& range, F is, P of = {}) {
  return !ranges::any_of(
      range, [&](auto&& one) { return !std::invoke(is, one); }, of);
}
template <class R, class F, class P = whole>
auto count_if(R&& range, F is, P of = {}) {
  return std::count_if(std::begin(range), std::end(range),
                       [&](auto&& one) { return std::invoke(is, std::invoke(of, one)); });
}
template <class R, class T, class P = whole>
auto count(R&& range, const T& value, P of = {}) {
  return ranges::count_if(
      range, [&](auto&& one) { return one == value; }, of);
}
template <class C, class P>
auto ordered(C& less, P& of) {
  return
      [&](auto&& a, auto&& b) { return std::invoke(less, std::invoke(of, a), std::invoke(of, b)); };
}
template <class R, class C = std::less<>, class P = whole>
void sort(R&& range, C less = {}, P of = {}) {
  std::sort(std::begin(range), std::end(range), ordered(less, of));
}
template <class R, class C = std::less<>, class P = whole>
void stable_sort(R&& range, C less = {}, P of = {}) {
  std::stable_sort(std::begin(range), std::end(range), ordered(less, of));
}
template <class R, class C = std::less<>, class P = whole>
auto min_element(R&& range, C less = {}, P of = {}) {
  return std::min_element(std::begin(range), std::end(range), ordered(less, of));
}
template <class R, class C = std::less<>, class P = whole>
auto max_element(R&& range, C less = {}, P of = {}) {
  return std::max_element(std::begin(range), std::end(range), ordered(less, of));
}
template <class R, class C = std::less<>, class P = whole>
auto max(R&& range, C less = {}, P of = {}) {
  return *ranges::max_element(range, less, of);
}
template <class R, class C = std::less<>, class P = whole>
auto min(R&& range, C less = {}, P of = {}) {
  return *ranges::min_element(range, less, of);
}
template <class R, class T, class C = std::less<>, class P = whole>
auto lower_bound(R&& range, const T& value, C less = {}, P of = {}) {
  return std::lower_bound(
      std::begin(range), std::end(range), value,
      [&](auto&& one, const T& bound) { return std::invoke(less, std::invoke(of, one), bound); });
}
template <class R, class T, class C = std::less<>, class P = whole>
auto upper_bound(R&& range, const T& value, C less = {}, P of = {}) {
  return std::upper_bound(
      std::begin(range), std::end(range), value,
      [&](const T& bound, auto&& one) { return std::invoke(less, bound, std::invoke(of, one)); });
}
template <class R, class T, class C = std::less<>, class P = whole>
bool binary_search(R&& range, const T& value, C less = {}, P of = {}) {
  const auto at = ranges::lower_bound(range, value, less, of);
  return at != std::end(range) && !std::invoke(less, value, std::invoke(of, *at));
}
template <class R, class O, class F>
auto transform(R&& range, O to, F by) {
  return std::transform(std::begin(range), std::end(range), to,
                        [&](auto&& one) -> decltype(auto) { return std::invoke(by, one); });
}
template <class R, class S, class O, class F>
auto transform(R&& first, S&& second, O to, F by) {
  return std::transform(std::begin(first), std::end(first), std::begin(second), to, by);
}
template <class R, class A, class B>
void replace(R&& range, const A& old, const B& by) {
  std::replace(std::begin(range), std::end(range), old, by);
}
template <class R, class S, class E = std::equal_to<>>
bool equal(R&& first, S&& second, E same = {}) {
  return std::equal(std::begin(first), std::end(first), std::begin(second), std::end(second), same);
}
template <class R, class S>
bool is_permutation(R&& first, S&& second) {
  return std::is_permutation(std::begin(first), std::end(first), std::begin(second),
                             std::end(second));
}
template <class R>
void reverse(R&& range) {
  std::reverse(std::begin(range), std::end(range));
}
template <class R, class O>
auto copy(R&& range, O to) {
  return std::copy(std::begin(range), std::end(range), to);
}
template <class R, class O, class F>
auto copy_if(R&& range, O to, F is) {
  return std::copy_if(std::begin(range), std::end(range), to,
                      [&](auto&& one) { return std::invoke(is, one); });
}
template <class R, class S, class O>
auto set_difference(R&& first, S&& second, O to) {
  return std::set_difference(std::begin(first), std::end(first), std::begin(second),
                             std::end(second), to);
}
template <class R, class F = std::equal_to<>>
auto adjacent_find(R&& range, F same = {}) {
  return std::adjacent_find(std::begin(range), std::end(range), same);
}

}  // namespace ranges

// The fewest digits that read back to the same double.
inline to_chars_result to_chars(char* first, char* last, const char* format, int precision,
                                double value) {
  char text[512];
  const int size = std::snprintf(text, sizeof text, format, precision, value);
  if (size > last - first) return {last, errc::value_too_large};
  std::memcpy(first, text, static_cast<size_t>(size));
  return {first + size, errc()};
}
inline to_chars_result to_chars_shortest(char* first, char* last, const char* format, int least,
                                         double value) {
  char text[512];
  int precision = least;
  for (; precision < 400; ++precision) {
    std::snprintf(text, sizeof text, format, precision, value);
    if (std::strtod(text, nullptr) == value || std::isnan(value)) break;
  }
  return to_chars(first, last, format, precision, value);
}
inline to_chars_result to_chars(char* first, char* last, double value) {
  return to_chars_shortest(first, last, "%.*g", 1, value);
}
inline to_chars_result to_chars(char* first, char* last, double value, chars_format format) {
  if (format == chars_format::fixed) return to_chars_shortest(first, last, "%.*f", 0, value);
  if (format == chars_format::scientific) return to_chars_shortest(first, last, "%.*e", 0, value);
  if (format != chars_format::hex) return to_chars(first, last, value);
  char text[64];
  const int size = std::snprintf(text, sizeof text, "%a", value);
  string digits(text, static_cast<size_t>(size));
  if (const auto prefix = digits.find("0x"); prefix != string::npos) digits.erase(prefix, 2);
  if (static_cast<ptrdiff_t>(digits.size()) > last - first) return {last, errc::value_too_large};
  std::memcpy(first, digits.data(), digits.size());
  return {first + digits.size(), errc()};
}
inline to_chars_result to_chars(char* first, char* last, double value, chars_format format,
                                int precision) {
  return to_chars(first, last,
                  format == chars_format::fixed        ? "%.*f"
                  : format == chars_format::scientific ? "%.*e"
                                                       : "%.*g",
                  precision, value);
}
inline from_chars_result from_chars(const char* first, const char* last, double& value,
                                    chars_format format = chars_format::general) {
  string text(first, last);
  if (text.empty() || text[0] == '+' || std::isspace(static_cast<unsigned char>(text[0])) != 0)
    return {first, errc::invalid_argument};
  size_t before = 0;
  if (format == chars_format::hex) {
    text.insert(text[0] == '-' ? 1 : 0, "0x");
    before = 2;
  }
  char* end = nullptr;
  const double read = std::strtod(text.c_str(), &end);
  if (end == text.c_str()) return {first, errc::invalid_argument};
  const char* const after = first + (end - text.c_str()) - before;
  if (std::isinf(read) && text.find_first_of("iI") == string::npos)
    return {after, errc::result_out_of_range};
  value = read;
  return {after, errc()};
}

// There is one thread: what another one would do is done at once.
struct stop_token {
  bool stop_requested() const { return false; }
};
struct jthread {
  jthread() = default;
  template <class F, class... A>
  explicit jthread(F&& work, A&&... arguments) {
    if constexpr (is_invocable_v<F, stop_token, A...>)
      work(stop_token{}, arguments...);
    else
      work(arguments...);
  }
  bool joinable() const { return false; }
  void join() {}
  bool request_stop() { return true; }
};

}  // namespace std
// NOLINTEND(cert-dcl58-cpp)

#endif
