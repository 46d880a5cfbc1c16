// A campaign: many trials of one thing, which are run in parts.
#pragma once

#include <cstdlib>
#include <stdexcept>
#include <string>

namespace courant::test {

// The trials that this run makes: all of them; where COURANT_CAMPAIGN is "2/4" each fourth, from number 2 on, counted
// from 0. What is drawn at random for a trial has to be drawn for those of other parts too, so that a trial is the same
// in each run.
class Campaign {
 public:
  // All trials.
  Campaign() = default;
  // `words`: "2/4", or "whole". Throws std::invalid_argument if they are not such.
  explicit Campaign(const std::string& words) {
    if (words == "whole") return;
    const std::size_t slash = words.find('/');
    const auto number = [&](const std::string& digits) {
      if (digits.empty() || digits.find_first_not_of("0123456789") != std::string::npos)
        throw std::invalid_argument("COURANT_CAMPAIGN is \"" + words +
                                    "\": expected \"whole\", or a part as \"2/4\"");
      return std::stol(digits);
    };
    part_ = number(words.substr(0, slash));
    parts_ = number(slash == std::string::npos ? "" : words.substr(slash + 1));
    if (part_ >= parts_)
      throw std::invalid_argument("COURANT_CAMPAIGN is \"" + words +
                                  "\": expected the number of a part, from 0 on");
  }
  static Campaign of_environment() {
    const char* words = std::getenv("COURANT_CAMPAIGN");
    return words ? Campaign(std::string(words)) : Campaign();
  }

  bool has(long trial) const { return trial % parts_ == part_; }
  // How many of the trials 0, …, count - 1.
  long of(long count) const { return (count - part_ + parts_ - 1) / parts_; }
  bool is_whole() const { return parts_ == 1; }

 private:
  long part_ = 0, parts_ = 1;
};

}  // namespace courant::test
