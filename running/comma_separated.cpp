#include "courant/running/comma_separated.hpp"

#include <cmath>

#include "courant/core/words/message.hpp"

namespace courant {

std::string csv_cell(const Json& value) {
  if (value.is_null()) return "";
  if (value.is_number_float()) {
    const double number = value.get<double>();
    return std::isnan(number) ? "" : exact_text(number);
  }
  const std::string text = value.is_string() ? value.get<std::string>() : value.dump();
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

}  // namespace courant
