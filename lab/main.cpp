// The engine as functions that JavaScript calls. Texts are UTF-8; what is returned lives until the next call.
#include <emscripten.h>

#include <cstddef>
#include <string>

#include "courant/lab/engine.hpp"

namespace {

using courant::Json;

// Tells the worker, which tells the page. It is within a call of courant_answer.
EM_JS(void, tell_progress, (double step, double steps, double drift), {
  if (Module["onProgress"]) Module["onProgress"](step, steps, drift);
});

courant::lab::Engine& engine() {
  static courant::lab::Engine only([](const courant::Progress& progress) {
    tell_progress(static_cast<double>(progress.step), static_cast<double>(progress.steps),
                  progress.energy_drift);
  });
  return only;
}

std::string answer;

}  // namespace

extern "C" {

EMSCRIPTEN_KEEPALIVE const char* courant_answer(const char* question) {
  answer =
      engine().answer(Json::parse(question)).dump(-1, ' ', false, Json::error_handler_t::replace);
  return answer.c_str();
}

// Of the last runs the i-th: rows after each other, `courant_row_values` numbers in all.
EMSCRIPTEN_KEEPALIVE const double* courant_rows(int i) {
  return engine().runs()[static_cast<std::size_t>(i)].rows.values.data();
}
EMSCRIPTEN_KEEPALIVE int courant_row_values(int i) {
  return static_cast<int>(engine().runs()[static_cast<std::size_t>(i)].rows.values.size());
}

}  // extern "C"
