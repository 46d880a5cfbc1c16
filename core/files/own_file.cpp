#include "courant/core/files/own_file.hpp"

#include <algorithm>
#include <array>
#include <boost/crc.hpp>
#include <cstdint>
#include <iterator>
#include <utility>

#include "courant/core/files/content_hash.hpp"
#include "courant/core/files/input_file.hpp"
#include "courant/core/files/output_file.hpp"

namespace courant {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kText = "Written by courant ", kCheck = "; check ",
                           kBeside = "; beside ";
constexpr std::size_t kCheckDigits = 32;

// What stands around a mark, and how the file ends behind it.
struct Place {
  std::string before, after, end;
};

std::string big_endian(std::uint32_t number) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(number >> shift);
  return bytes;
}

// A chunk of PNG: its length, its kind and its bytes, their check.
Place png_chunk(const std::string& text) {
  const std::string kind = "tEXt", keyword("Software\0", 9);
  boost::crc_32_type check;
  for (const std::string& part : {kind, keyword, text})
    check.process_bytes(part.data(), part.size());
  return {.before =
              big_endian(static_cast<std::uint32_t>(keyword.size() + text.size())) + kind + keyword,
          .after = big_endian(check.checksum()),
          .end = std::string("\0\0\0\0IEND\xae\x42\x60\x82", 12)};
}

// By how a content begins.
Place place_of(std::string_view content, const std::string& text) {
  if (content.starts_with("\x89PNG")) return png_chunk(text);
  if (content.starts_with('{'))
    return {.before = ",\n  \"// mark\": \"", .after = "\"", .end = "\n}\n"};
  if (content.starts_with('<') || content.starts_with("# "))  // HTML, SVG; Markdown
    return {.before = "<!-- ", .after = " -->\n", .end = ""};
  if (content.starts_with('%') || content.starts_with('\\'))  // PDF, LaTeX
    return {.before = "% ", .after = "\n", .end = ""};
  if (content.starts_with('.')) return {.before = ".\\\" ", .after = "\n", .end = ""};
  return {.before = "/* ", .after = " */\n", .end = ""};
}

// A word up to `end`, which is left out; empty if it does not end so.
std::string take_word(std::string_view& text, std::string_view end) {
  const std::size_t at = text.find(end);
  if (at == std::string_view::npos) return "";
  std::string word(text.substr(0, at));
  text.remove_prefix(at + end.size());
  return word;
}

}  // namespace

std::string FileMark::on(std::string content) const {
  if (!content.ends_with('\n') && !content.starts_with("\x89PNG")) content += '\n';
  const std::string text = std::string(kText) + command + std::string(kCheck) +
                           content_hash(content + '\n' + command + '\n' + beside) +
                           (beside.empty() ? "" : std::string(kBeside) + beside);
  const Place place = place_of(content, text);
  if (!content.ends_with(place.end)) return content;  // there is no place for it
  content.resize(content.size() - place.end.size());
  return content + place.before + text + place.after + place.end;
}

std::optional<FileMark> FileMark::of(const std::string& content) {
  const std::size_t at = content.rfind(kText);
  if (at == std::string::npos) return std::nullopt;
  std::string_view rest = std::string_view(content).substr(at + kText.size());
  FileMark mark{.command = take_word(rest, kCheck)};
  rest.remove_prefix(std::min(rest.size(), kCheckDigits));
  if (rest.starts_with(kBeside)) mark.beside = rest.substr(kBeside.size(), kCheckDigits);
  const Place place = place_of(content, "");
  if (at < place.before.size()) return std::nullopt;
  // Whether it would be written so.
  if (mark.on(content.substr(0, at - place.before.size()) + place.end) != content)
    return std::nullopt;
  return mark;
}

bool file_exists(const fs::path& file) {
  std::error_code error;
  return fs::exists(file, error);
}

std::string content_of(const fs::path& file) {
  std::ifstream stream = input_file(file);
  if (!stream) return "";
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::optional<FileMark> mark_of(const fs::path& file) {
  std::error_code error;
  if (!fs::is_regular_file(file, error)) return std::nullopt;
  return FileMark::of(content_of(file));
}

void refuse_foreign(const fs::path& file, const std::string& expected) {
  throw RefusedOutput(file.string() +
                      ": is there already, and is not as courant wrote it; expected " + expected);
}

void OwnFiles::check(const fs::path& file) const {
  std::error_code error;
  if (!fs::is_regular_file(file, error) || mark_of(file)) return;
  if (!force_) refuse_foreign(file, "another name (-o), or --force to replace it");
  if (fs::is_symlink(file, error))
    throw RefusedOutput(file.string() + ": is a link to " + fs::read_symlink(file, error).string() +
                        ", which is not as courant wrote it; expected the name of the file itself");
}

void OwnFiles::write(const fs::path& file, const std::string& content,
                     const std::string& beside) const {
  check(file);
  const FileMark mark{.command = command_, .beside = beside.empty() ? "" : content_hash(beside)};
  write_file(file, mark.on(content));
}

}  // namespace courant
