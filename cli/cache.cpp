#include <CLI/CLI.hpp>
#include <chrono>
#include <memory>
#include <ostream>

#include "courant/cli/command.hpp"
#include "courant/cli/text.hpp"
#include "courant/core/expressions/native_cache.hpp"

namespace courant::cli {
namespace {

constexpr std::size_t kMostListed = 20;

std::string size_in_words(std::uintmax_t bytes) {
  const auto size = static_cast<double>(bytes);
  return bytes < 1'000'000 ? shown(size / 1e3, 3) + " kB" : shown(size / 1e6, 3) + " MB";
}

std::string age_in_words(std::filesystem::file_time_type used) {
  const auto age = std::filesystem::file_time_type::clock::now() - used;
  const auto days = std::chrono::duration_cast<std::chrono::hours>(age).count() / 24;
  return days <= 0 ? "today" : days == 1 ? "a day ago" : std::to_string(days) + " days ago";
}

void print_entries(const Console& console, const NativeCache& cache) {
  const auto entries = cache.entries();
  std::uintmax_t bytes = 0;
  TextTable table({"compiled code", "size", "used"});
  for (std::size_t i = 0; i < entries.size(); ++i) {
    bytes += entries[i].bytes;
    if (i < kMostListed)
      table.add({entries[i].name, size_in_words(entries[i].bytes), age_in_words(entries[i].used)});
  }
  const NativeCache::Limits limits;
  console.out << shown_name(cache.folder()) << ": " << entries.size()
              << (entries.size() == 1 ? " entry, " : " entries, ") << size_in_words(bytes)
              << "; kept up to " << size_in_words(limits.bytes) << " and "
              << limits.age.count() / 24 << " days\n";
  if (!table.empty()) table.print(console.out, "  ", console.columns);
  if (entries.size() > kMostListed)
    console.out << "  … and " << entries.size() - kMostListed << " more\n";
}

}  // namespace

void add_cache(CLI::App& app, Session& session) {
  auto clear = std::make_shared<bool>(false);
  CLI::App* command =
      app.add_subcommand("cache", "List the compiled code that is kept on disk, or remove it");
  command->add_flag("--clear", *clear, "remove all of it");
  command->callback([&session, clear] {
    session.action = [clear](const Console& console) -> int {
      std::string defect;
      const auto cache = NativeCache::open(&defect);
      if (!cache) {
        print_error(console, defect);
        return failed;
      }
      if (*clear) cache->clear();
      print_entries(console, *cache);
      return done;
    };
  });
}

}  // namespace courant::cli
