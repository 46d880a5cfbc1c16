#include "courant/cli/progress_bar.hpp"

#include <cmath>
#include <cstdio>
#include <ostream>

#include "courant/cli/text.hpp"

namespace courant::cli {
namespace {

constexpr int kCells = 24;
constexpr const char* kClearLine = "\r\x1b[K";

std::string duration(double seconds) {
  const auto whole = static_cast<long>(std::ceil(seconds));
  char buffer[40];
  if (whole < 60)
    std::snprintf(buffer, sizeof buffer, "%ld s", whole);
  else if (whole < 3600)
    std::snprintf(buffer, sizeof buffer, "%ld:%02ld min", whole / 60, whole % 60);
  else
    std::snprintf(buffer, sizeof buffer, "%ld:%02ld h", whole / 3600, whole / 60 % 60);
  return buffer;
}

}  // namespace

ProgressBar::~ProgressBar() {
  if (shown_) out_ << kClearLine << std::flush;
}

void ProgressBar::show(const Progress& progress) {
  const double share = static_cast<double>(progress.step) / static_cast<double>(progress.steps);
  const double rate = static_cast<double>(progress.step - progress.first) / progress.seconds;
  const double left = static_cast<double>(progress.steps - progress.step) / rate;
  const int full = static_cast<int>(share * kCells);
  out_ << kClearLine << '[' << std::string(static_cast<std::size_t>(full), '#')
       << std::string(static_cast<std::size_t>(kCells - full), '.') << "] "
       << static_cast<int>(share * 100.0) << " %  " << shown(rate, 3) << " steps/s  "
       << duration(left) << " left";
  if (!std::isnan(progress.energy_drift)) out_ << "  H-H(0) " << shown(progress.energy_drift, 3);
  out_ << std::flush;
  shown_ = true;
}

}  // namespace courant::cli
