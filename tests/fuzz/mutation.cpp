#include "mutation.hpp"

#include <algorithm>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace courant::fuzz {

std::size_t mutate_text(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed,
                        const std::function<std::string(const std::string& text, std::size_t times,
                                                        Generator&)>& change) {
  Generator generator(seed);
  if (below(4, generator) == 0) return LLVMFuzzerMutate(data, size, most);
  const std::size_t times = 1 + below(3, generator);
  const std::string text = change({reinterpret_cast<const char*>(data), size}, times, generator);
  if (text.empty() || text.size() > most) return LLVMFuzzerMutate(data, size, most);
  std::copy(text.begin(), text.end(), data);
  return text.size();
}

}  // namespace courant::fuzz
