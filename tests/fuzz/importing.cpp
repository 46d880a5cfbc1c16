#include "importing.hpp"

#include "answer.hpp"
#include "words.hpp"

namespace courant::fuzz {

void require_import(const std::string& text) {
  const Answer import = require_answer({"import", "-"}, text);
  if (import.status != 0) return;
  const Answer ladder = require_answer({"constraints", "-"}, import.out);
  require(ladder.status != 2 || (ladder.err.find("JSON") == std::string::npos &&
                                 ladder.err.find(": /system") == std::string::npos),
          "what was imported does not read", ladder.err);
  require_answer({"run", "-", "--quiet", "--force", "--backend", "interpreter", "-o", run_folder()},
                 import.out);
}

}  // namespace courant::fuzz
