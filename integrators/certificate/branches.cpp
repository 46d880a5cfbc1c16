#include "courant/integrators/certificate/branches.hpp"

#include <algorithm>
#include <optional>
#include <random>
#include <stdexcept>
#include <utility>

#include "courant/core/algebra/normal_form.hpp"
#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/core/expressions/subgraph.hpp"
#include "courant/integrators/certificate/constraint_formulas.hpp"
#include "courant/integrators/certificate/equation_reduction.hpp"
#include "courant/structures/branch_system.hpp"

namespace courant {
namespace {

using SystemToBranch = std::shared_ptr<const ImplicitSystem>;

constexpr Index kMostUnknowns = 100, kMostLevels = 4;
constexpr std::size_t kMostBranches = 16, kMostProducts = 8, kMostNodes = 5000;
// As many as kMostProducts products of two factors have; more cost their square.
constexpr std::size_t kMostChoices = 256;

// A point of M with a velocity and unknowns at which nothing vanishes by chance.
std::optional<State> any_state(const ImplicitSystem& system) {
  const Manifold& M = *system.manifold();
  std::mt19937 generator(7);
  const auto numbers = [&](Index size) {
    VectorXd values(size);
    for (double& value : values)
      value = 0.5 + static_cast<double>(generator()) / static_cast<double>(std::mt19937::max());
    return values;
  };
  try {
    const VectorXd x = M.project(numbers(M.ambient_dimension()));
    return State{.t = 0.7,
                 .x = x,
                 .v = numbers(M.tangent_dimension()),
                 .z = numbers(system.auxiliary_size())};
  } catch (const std::domain_error&) {
    return std::nullopt;
  }
}

// Sets of numbers, ascending. The smallest ones that have one of each of these; nothing where there are too many on
// the way.
using Choice = std::vector<std::size_t>;
std::optional<std::vector<Choice>> smallest_choices(const std::vector<Choice>& of) {
  std::vector<Choice> found = {{}};
  for (const Choice& one : of) {
    std::vector<Choice> longer;
    const auto add = [&](Choice choice) {
      if (std::ranges::find(longer, choice) == longer.end()) longer.push_back(std::move(choice));
    };
    for (const Choice& choice : found) {
      const auto has = [&](std::size_t i) { return std::ranges::binary_search(choice, i); };
      if (std::ranges::any_of(one, has)) {
        add(choice);
        continue;
      }
      for (const std::size_t i : one) {
        Choice with = choice;
        with.insert(std::ranges::upper_bound(with, i), i);
        add(std::move(with));
      }
      if (longer.size() > kMostChoices) return std::nullopt;
    }
    found.clear();
    for (const Choice& choice : longer) {
      const bool is_smallest = std::ranges::none_of(longer, [&](const Choice& other) {
        return other.size() < choice.size() &&
               std::includes(choice.begin(), choice.end(), other.begin(), other.end());
      });
      if (is_smallest) found.push_back(choice);
    }
  }
  return found;
}

// The products of one system at the first level at which there are any.
class ProductSearch {
 public:
  ProductSearch(const ImplicitSystem& system, const State& somewhere)
      : system_(system),
        reduction_(system, velocity_names(system), somewhere, {}),
        form_(reduction_.variables(), {}) {}

  struct Found {
    Index level = 0;
    std::vector<ExprVector> choices = {};  // factors that are 0 together
  };

  std::optional<Found> run() {
    if (reduction_.is_too_large()) return std::nullopt;
    std::vector<Expr> constraints;
    for (Index level = 0; level < kMostLevels; ++level) {
      reduction_.solve_by_numbers();
      if (auto found = products(constraints); !found.empty())
        return Found{.level = level, .choices = std::move(found)};
      const std::vector<Expr> added = reduction_.constraints();
      // 1 = 0: nothing is consistent.
      if (std::ranges::any_of(added, [](const Expr& one) { return one.is_constant(); })) break;
      constraints.insert(constraints.end(), added.begin(), added.end());
      for (const Expr& function : added)
        reduction_.add(reduction_.reduced(reduction_.derivative(function)));
      if (added.empty() || reduction_.has_divided()) break;
    }
    return std::nullopt;
  }

  std::string written(const Expr& factor) const { return reduction_.written_equation(factor); }

  // Equations in the variables of the system; those of S that vanish with them are left out.
  BranchSystem::Equations equations(const ExprVector& factors,
                                    std::vector<std::string> names) const {
    const Manifold& M = *system_.manifold();
    const ExprVector all = reduction_.variables();
    const Index n = M.ambient_dimension(), k = M.tangent_dimension();
    BranchSystem::Equations result{.functions = factors,
                                   .x = all.head(n),
                                   .v = all.segment(n + 1, k),
                                   .z = all.tail(system_.auxiliary_size()),
                                   .t = all[n],
                                   .names = std::move(names)};
    if (reduction_.has_ambient_velocities())
      result.functions = substitute(factors, result.v, M.frame(result.x) * result.v);
    return result;
  }
  // With the equations of S that they change.
  void complete(BranchSystem::Equations& branch) const {
    const ExprVector residual = system_.residual(branch.x, branch.v, branch.z, branch.t);
    const std::vector<Expr> zeros(branch.functions.begin(), branch.functions.end());
    NormalForm modulo(reduction_.variables(), zeros);
    std::vector<Expr> others;
    for (Index i = system_.tangent_blocks() * system_.manifold()->tangent_dimension();
         i < residual.size(); ++i) {
      if (residual[i].is_constant() || !modulo(residual[i]).is_constant(0.0)) continue;
      branch.left_out.push_back(i);
      for (const Expr& factor : NormalForm(form_).factors(residual[i]))
        if (!modulo(factor).is_constant(0.0)) others.push_back(factor);
    }
    ExprVector rewritten = residual;
    for (const Expr& other : others)
      for (Index j = 0; j < branch.z.size(); ++j) absorb(other, j, zeros, branch, rewritten);
    for (Index i = 0; i < residual.size(); ++i)
      if (!(rewritten[i] == residual[i])) branch.rewritten.emplace_back(i, rewritten[i]);
  }

 private:
  // Where f = 0 and an unknown stands with the factor g in all equations, it becomes the product: g = s with a new variable
  // s makes s c of its coefficient. Equations are linear in it then.
  void absorb(const Expr& g, Index unknown, const std::vector<Expr>& zeros,
              const BranchSystem::Equations& branch, ExprVector& equations) const {
    const ExprVector z = branch.z.segment(unknown, 1);
    const Expr s = z[0].graph().variable("s");
    const ExprVector tag = ExprVector::Constant(1, s), none = ExprVector::Constant(1, Expr(0.0));
    std::vector<Expr> relations = zeros;
    relations.push_back(g - s);
    NormalForm with_tag(joined(reduction_.variables(), tag), relations);
    ExprVector changed = equations;
    bool is_there = false;
    for (Index i = 0; i < equations.size(); ++i) {
      if (std::ranges::find(branch.left_out, i) != branch.left_out.end()) continue;
      const Expr coefficient = gradient(equations[i], z)[0];
      if (coefficient.is_constant(0.0)) continue;
      if (depends(ExprVector::Constant(1, coefficient), z)) return;
      const Expr reduced = with_tag(coefficient);
      if (reduced.is_constant() && !reduced.is_constant(0.0)) return;
      if (!reduced.is_constant() && !with_tag(substitute(reduced, tag, none)).is_constant(0.0))
        return;
      is_there = is_there || !reduced.is_constant();
      const Expr quotient = reduced.is_constant() ? reduced
                                                  : substitute(with_tag(reduced / s), tag,
                                                               ExprVector::Constant(1, g));
      changed[i] = substitute(equations[i], z, none) + z[0] * quotient;
    }
    if (is_there) equations = changed;
  }

  // Whether a function has more than time in it.
  bool is_of_state(const Expr& function) const {
    const ExprVector all = reduction_.variables();
    const Index n = system_.manifold()->ambient_dimension();
    return depends(ExprVector::Constant(1, function),
                   joined(all.head(n), all.tail(all.size() - n - 1)));
  }

  // Factors that are 0 together. Of equations that those with one factor do not make 0, such as constraints and what was
  // chosen before, those that are products of several, which all have to hold.
  std::vector<ExprVector> products(const std::vector<Expr>& constraints) {
    std::vector<Expr> zeros;
    std::vector<std::pair<Expr, std::vector<Expr>>> candidates;
    for (const Expr& constraint : constraints) {
      const std::vector<Expr> parts = form_.factors(constraint);
      zeros.push_back(parts.size() == 1 ? parts.front() : constraint);
    }
    for (const Expr& equation : reduction_.open_equations()) {
      if (equation.is_constant() || Subgraph(ExprVector::Constant(1, equation)).size() > kMostNodes)
        continue;
      std::vector<Expr> parts = form_.factors(equation);
      std::erase_if(parts, [&](const Expr& part) { return !is_of_state(part); });
      if (parts.size() == 1) zeros.push_back(parts.front());
      if (parts.size() > 1) candidates.emplace_back(equation, std::move(parts));
    }
    if (candidates.empty()) return {};
    NormalForm modulo(reduction_.variables(), zeros);
    std::vector<std::vector<Expr>> of_equations;
    Expr together = 1.0;
    for (auto& [equation, parts] : candidates) {
      if (of_equations.size() == kMostProducts || modulo(equation).is_constant(0.0)) continue;
      for (const Expr& part : parts) together = together * part;
      of_equations.push_back(std::move(parts));
    }
    const std::vector<Expr> factors = form_.factors(together);
    std::vector<Choice> of_products;
    for (const std::vector<Expr>& parts : of_equations) {
      Choice numbers;
      for (std::size_t i = 0; i < factors.size(); ++i)
        if (std::ranges::any_of(parts, [&](const Expr& part) { return part == factors[i]; }))
          numbers.push_back(i);
      if (numbers.size() == parts.size()) of_products.push_back(std::move(numbers));
    }
    std::vector<ExprVector> choices;
    if (of_products.empty()) return choices;
    const auto smallest = smallest_choices(of_products);
    if (!smallest) return choices;
    for (const Choice& choice : *smallest) {
      ExprVector chosen(std::ssize(choice));
      for (std::size_t i = 0; i < choice.size(); ++i)
        chosen[static_cast<Index>(i)] = factors[choice[i]];
      choices.push_back(std::move(chosen));
    }
    return choices;
  }

  const ImplicitSystem& system_;
  EquationReduction reduction_;
  NormalForm form_;
};

void collect(const SystemToBranch& system, const Branch& before, std::vector<Branch>& all,
             int depth) {
  constexpr int deepest = 3;
  const auto end = [&] {
    if (!before.equations.empty()) all.push_back(before);
  };
  const std::optional<State> somewhere = any_state(*system);
  if (depth == deepest || !somewhere) return end();
  ProductSearch search(*system, *somewhere);
  const auto found = search.run();
  if (!found || all.size() + found->choices.size() > kMostBranches) return end();
  for (const ExprVector& choice : found->choices) {
    Branch branch{.level = found->level, .equations = before.equations, .system = nullptr};
    std::vector<std::string> names;
    for (const Expr& factor : choice) {
      const std::string text = search.written(factor);
      names.push_back(text.empty() ? "a factor of many terms" : text);
      branch.equations.push_back(names.back());
    }
    BranchSystem::Equations equations = search.equations(choice, std::move(names));
    search.complete(equations);
    branch.system = std::make_shared<BranchSystem>(system, std::move(equations));
    collect(branch.system, branch, all, depth + 1);
  }
}

}  // namespace

std::vector<Branch> branches(const std::shared_ptr<const ImplicitSystem>& system) {
  std::vector<Branch> all;
  if (system->manifold()->tangent_dimension() + system->auxiliary_size() > kMostUnknowns)
    return all;
  collect(system, {}, all, 0);
  return all;
}

}  // namespace courant
