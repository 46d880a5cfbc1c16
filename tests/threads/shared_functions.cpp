// What core calls immutable, or allows any number of threads to ask at once, is asked by eight: one graph that all extend,
// functions of it, one cache in which the same code is looked for and compiled at once, and how work is shared out. All
// threads must find the same numbers.
//
//   shared_functions [--plant]
//
// --plant: threads count without a lock, which the sanitizer of threads has to see.
#include <stdexcept>

#include "by_all.hpp"
#include "courant/core/expressions/function.hpp"
#include "courant/core/numbers/parallel.hpp"

namespace courant {
namespace {

// One graph, its names, and a function that holds a part of its work.
void extend_at_once(const Backend& backend) {
  const Graph graph;
  const ExprVector x = graph.variables("x", 3);
  const auto formula = [&] {
    Expr sum = 0;
    for (int i = 0; i < 300; ++i)
      sum += sin(static_cast<double>(i) * x[i % 3]) * exp(x[(i + 1) % 3] / 100.0);
    return ExprVector::Constant(1, sum);
  };
  const Function shared("shared", {{"x", x}}, formula(),
                        {.differentiate = {"x"}, .varying = {"x"}, .backend = backend});
  const VectorXd at = VectorXd::LinSpaced(3, 0.1, 0.9);
  require_one_answer("one graph", [&] {
    const Function own("own", {{"x", x}}, formula(), {.differentiate = {"x"}, .backend = backend});
    VectorXd found(8);
    found << own({at}), shared({at}), own.jacobian({at}).transpose(),
        shared.jacobian({at}).transpose();
    return found;
  });
}

// Work is shared out, and the first of what is thrown comes out.
void share_out() {
  std::vector<long> done(1000, 0);
  in_parallel(done.size(), kThreads, [&](std::size_t i) { done[i] = static_cast<long>(i); });
  for (std::size_t i = 0; i < done.size(); ++i) differences += done[i] != static_cast<long>(i);
  try {
    in_parallel(done.size(), kThreads, [&](std::size_t i) {
      if (i % 7 == 3) throw std::runtime_error(std::to_string(i));
    });
    ++differences;
  } catch (const std::runtime_error&) {
  }
}

void plant() {
  long count = 0;
  by_all([&] {
    for (int i = 0; i < 1000; ++i) ++count;
    return VectorXd(0);
  });
  std::cout << count << '\n';
}

}  // namespace
}  // namespace courant

int main(int count, char** words) {
  using namespace courant;
  if (count > 1 && std::string(words[1]) == "--plant") {
    plant();
    return 0;
  }
  for (const Backend& backend : {Backend::interpreter, Backend::native}) extend_at_once(backend);
  share_out();
  return differences > 0 ? 1 : 0;
}
