#include "courant/extensions/petsc/petsc_session.hpp"

#include <petscsnes.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <mutex>
#include <thread>
#include <unordered_map>
#include <utility>

#include "courant/core/expressions/native.hpp"
#include "courant/extensions/petsc/block_graph.hpp"
#include "courant/extensions/petsc/equation_rows.hpp"
#include "courant/extensions/petsc/message.hpp"
#include "courant/extensions/petsc/petsc_call.hpp"
#include "courant/extensions/petsc/petsc_part.hpp"
#include "courant/extensions/petsc/petsc_partition.hpp"
#include "courant/extensions/petsc/petsc_thread.hpp"

namespace courant {
namespace {

// What all ranks are to do next; the same numbers on all of them.
struct Task {
  enum What : std::int64_t { end, take, solve };
  static constexpr std::size_t kMostGroups = PetscPart::kMostGroups;

  std::int64_t what = end, system = 0, keeps_matrix = 0, is_damped = 0, groups = 0;
  std::array<double, kMostGroups> scales = {};
};

PetscErrorCode note_complaint(MPI_Comm, int, const char*, const char*, PetscErrorCode code,
                              PetscErrorType type, const char* text, void*) {
  if (type == PETSC_ERROR_INITIAL && text != nullptr) petsc_complaint() = text;
  return code;
}

// The status of a rank that has failed, which mpirun makes its own.
constexpr int kFailed = 3;

// What is sent to each rank: how many numbers, and from where.
struct Shares {
  std::vector<int> counts, begins;

  void add(int count) {
    begins.push_back(counts.empty() ? 0 : begins.back() + counts.back());
    counts.push_back(count);
  }
  std::size_t size() const {
    return counts.empty() ? 0 : static_cast<std::size_t>(begins.back() + counts.back());
  }
};

}  // namespace

std::string& petsc_complaint() {
  static std::string complaint;
  return complaint;
}

// MPI and PETSc, and what all ranks do together. Members below are called in the thread, but where it is said.
class PetscSession::Team {
 public:
  Team(const std::vector<std::string>& options, const std::atomic<bool>* stop) : thread(stop) {
    thread.run([&] { begin(options); });
  }

  // What the first rank remembers of a system: which numbers go to which rank and come back.
  struct Division {
    std::vector<Index>
        unknowns;  // rank by rank, places among those that are contained, ascending in each
    std::vector<std::vector<DividedEquations::Parameter>> parameters;  // of each rank
    Shares sent, returned;
    std::vector<double> numbers;  // that are sent, and come back
  };
  // How the first rank divides a system, once the ranks of its blocks are known.
  using Divide = std::function<std::vector<Message>(const std::vector<int>& parts)>;

  void begin(const std::vector<std::string>& options) {
    std::string program = "courant";
    std::vector<std::string> words = options;
    std::vector<char*> pointers = {program.data()};
    for (std::string& word : words) pointers.push_back(word.data());
    int count = static_cast<int>(pointers.size());
    pointers.push_back(nullptr);
    char** arguments = pointers.data();
    int provided = 0;
    require_mpi(MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided));
    require_petsc(PetscOptionsSetValue(nullptr, "-no_signal_handler", "true"));
    require_petsc(PetscInitialize(&count, &arguments, nullptr, nullptr));
    require_petsc(PetscPushErrorHandler(note_complaint, nullptr));
    require_mpi(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
    require_mpi(MPI_Comm_size(PETSC_COMM_WORLD, &ranks));
  }

  void finish() {
    systems_.clear();
    require_petsc(PetscPopErrorHandler());
    require_petsc(PetscFinalize());
    require_mpi(MPI_Finalize());
  }

  // Tells all ranks the same task. Those that wait for long sleep meanwhile, and leave their cores to others.
  void agree(Task& task) {
    constexpr std::chrono::milliseconds patience{2};
    constexpr std::chrono::microseconds pause{200};
    MPI_Request request = MPI_REQUEST_NULL;
    require_mpi(MPI_Ibcast(&task, sizeof task, MPI_BYTE, 0, PETSC_COMM_WORLD, &request));
    const auto begin = std::chrono::steady_clock::now();
    for (int has_come = 0;;) {
      require_mpi(MPI_Test(&request, &has_come, MPI_STATUS_IGNORE));
      if (has_come != 0) return;
      if (std::chrono::steady_clock::now() - begin > patience) std::this_thread::sleep_for(pause);
    }
  }

  // Until the first rank is at its end.
  void serve() {
    for (;;) {
      Task task;
      agree(task);
      if (task.what == Task::end) return;
      if (task.what == Task::take)
        take(nullptr, {});
      else
        solve(task, nullptr);
    }
  }

  // A system, which the first rank has: blocks and `divide` are its. Whether all ranks have native code.
  bool take(const BlockGraph* blocks, const Divide& divide) {
    const std::vector<int> parts = partition(PETSC_COMM_WORLD, blocks);
    Message own;
    if (rank == 0) {
      std::vector<Message> messages = divide(parts);
      for (int r = 1; r < ranks; ++r) send(messages[static_cast<std::size_t>(r)], r);
      own = std::move(messages[0]);
    } else {
      own = receive();
    }
    systems_.push_back(std::make_unique<PetscPart>(PETSC_COMM_WORLD, own));
    const PetscPart& part = *systems_.back();
    int is_native = part.is_native() || part.owned() == 0 ? 1 : 0;
    require_mpi(MPI_Allreduce(MPI_IN_PLACE, &is_native, 1, MPI_INT, MPI_MIN, PETSC_COMM_WORLD));
    return is_native != 0;
  }

  // `division`: of the first rank, with the numbers that are sent, and those that came back.
  EngineEquations::Answer solve(const Task& task, Division* division) {
    PetscPart& part = *systems_.at(static_cast<std::size_t>(task.system));
    std::vector<double> numbers(static_cast<std::size_t>(part.numbers()));
    const bool is_first = division != nullptr;
    double* const all = is_first ? division->numbers.data() : nullptr;
    require_mpi(MPI_Scatterv(all, is_first ? division->sent.counts.data() : nullptr,
                             is_first ? division->sent.begins.data() : nullptr, MPI_DOUBLE,
                             numbers.data(), static_cast<int>(numbers.size()), MPI_DOUBLE, 0,
                             PETSC_COMM_WORLD));
    const auto answer =
        part.solve(numbers.data(), {task.scales.begin(), task.scales.begin() + task.groups},
                   task.keeps_matrix != 0, task.is_damped != 0);
    require_mpi(MPI_Gatherv(numbers.data(), part.owned(), MPI_DOUBLE, all,
                            is_first ? division->returned.counts.data() : nullptr,
                            is_first ? division->returned.begins.data() : nullptr, MPI_DOUBLE, 0,
                            PETSC_COMM_WORLD));
    return answer;
  }

  int rank = 0, ranks = 1;
  int taken = 0;  // systems
  PetscThread thread;

 private:
  // In parts, as a count of bytes is an int.
  static constexpr std::size_t kPart = std::size_t{1} << 30;

  static void send(const Message& message, int to) {
    const std::vector<std::byte>& bytes = message.bytes();
    std::uint64_t size = bytes.size();
    require_mpi(MPI_Send(&size, 1, MPI_UINT64_T, to, 0, PETSC_COMM_WORLD));
    for (std::size_t at = 0; at < size; at += kPart)
      require_mpi(MPI_Send(bytes.data() + at, static_cast<int>(std::min(kPart, size - at)),
                           MPI_BYTE, to, 0, PETSC_COMM_WORLD));
  }
  static Message receive() {
    std::uint64_t size = 0;
    require_mpi(MPI_Recv(&size, 1, MPI_UINT64_T, 0, 0, PETSC_COMM_WORLD, MPI_STATUS_IGNORE));
    std::vector<std::byte> bytes(size);
    for (std::size_t at = 0; at < size; at += kPart)
      require_mpi(MPI_Recv(bytes.data() + at, static_cast<int>(std::min(kPart, size - at)),
                           MPI_BYTE, 0, 0, PETSC_COMM_WORLD, MPI_STATUS_IGNORE));
    return Message(std::move(bytes));
  }

  std::vector<std::unique_ptr<PetscPart>> systems_;
};

// Of the first rank.
class PetscSession::Engine final : public EquationEngine {
 public:
  explicit Engine(std::shared_ptr<Team> team) : team_(std::move(team)) {}

  std::shared_ptr<const NativeCode> compile(const std::string& c_source) const override {
    return machine_compiler()->compile(c_source);
  }
  bool is_available() const override { return machine_compiler()->is_available(); }

  std::shared_ptr<const EngineEquations> take(const std::string& name,
                                              const std::vector<Function::Input>& inputs,
                                              const ExprVector& equations,
                                              Backend::Kind backend) const override;
  int taken() const override { return team_->taken; }
  std::string name() const override { return "petsc"; }
  int ranks() const override { return team_->ranks; }

 private:
  class Taken;
  std::shared_ptr<Team> team_;
};

class PetscSession::Engine::Taken final : public EngineEquations {
 public:
  Taken(std::shared_ptr<Team> team, std::vector<Index> contained)
      : team_(std::move(team)), contained_(std::move(contained)), system_(team_->taken++) {}

  // What each rank gets.
  std::vector<Message> divide(const std::string& name, const DividedEquations& equations,
                              const BlockGraph& blocks, const std::vector<int>& parts,
                              Backend::Kind backend);
  void set_native(bool is_native) { is_native_ = is_native; }

  const std::vector<Index>& contained() const override { return contained_; }
  bool is_native() const override { return is_native_; }
  Answer solve(const Question& question) const override;

 private:
  const std::shared_ptr<Team> team_;
  const std::vector<Index> contained_;
  const int system_;
  bool is_native_ = false;
  mutable std::mutex mutex_;  // of what follows
  mutable Team::Division division_;
  mutable const void* asker_ = nullptr;  // of the matrix that is kept
};

std::vector<Message> PetscSession::Engine::Taken::divide(const std::string& name,
                                                         const DividedEquations& equations,
                                                         const BlockGraph& blocks,
                                                         const std::vector<int>& parts,
                                                         Backend::Kind backend) {
  const auto ranks = static_cast<std::size_t>(team_->ranks);
  std::vector<std::vector<Index>> owned(ranks), rows(ranks), places(ranks);
  for (std::size_t k = 0; k < contained_.size(); ++k) {
    const auto r = static_cast<std::size_t>(parts.at(static_cast<std::size_t>(blocks.block[k])));
    owned[r].push_back(contained_[k]);
    rows[r].push_back(blocks.equation[k]);
    places[r].push_back(static_cast<Index>(k));
  }
  std::unordered_map<Index, PetscInt> numbers;  // of unknowns, rank by rank
  std::vector<std::int64_t> offsets;
  for (std::size_t r = 0; r < ranks; ++r) {
    offsets.push_back(std::ssize(division_.unknowns));
    for (const Index unknown : owned[r])
      numbers.emplace(unknown, static_cast<PetscInt>(numbers.size()));
    division_.unknowns.insert(division_.unknowns.end(), places[r].begin(), places[r].end());
  }
  std::vector<Message> messages(ranks);
  for (std::size_t r = 0; r < ranks; ++r) {
    const DividedEquations::Part part = equations.part(rows[r], owned[r]);
    std::vector<PetscInt> ghosts;
    for (const Index unknown : part.ghosts) ghosts.push_back(numbers.at(unknown));
    Message& message = messages[r];
    message.put(name);
    message.put(static_cast<std::int32_t>(backend));
    message.put(offsets[r]);
    message.put(static_cast<std::int64_t>(owned[r].size()));
    message.put(ghosts);
    part.rows.put_into(message);
    const auto unknowns = static_cast<int>(owned[r].size());
    division_.returned.add(unknowns);
    division_.sent.add(unknowns + static_cast<int>(part.parameters.size() + Task::kMostGroups));
    division_.parameters.push_back(part.parameters);
  }
  division_.numbers.resize(division_.sent.size());
  return messages;
}

EngineEquations::Answer PetscSession::Engine::Taken::solve(const Question& question) const {
  const std::lock_guard lock(mutex_);
  Task task{.what = Task::solve,
            .system = system_,
            .keeps_matrix = question.keeps_matrix && asker_ == question.asker ? 1 : 0,
            .is_damped = question.is_damped ? 1 : 0,
            .groups = std::ssize(question.ends)};
  if (question.ends.size() > Task::kMostGroups)
    throw std::length_error("PetscSession: unknowns are measured in too many groups.");
  std::copy_n(question.scales, question.ends.size(), task.scales.begin());
  const Inputs& in = question.in;
  double* to = division_.numbers.data();
  const Index* places = division_.unknowns.data();
  for (std::size_t r = 0; r < division_.parameters.size(); ++r) {
    const std::span own(places, static_cast<std::size_t>(division_.returned.counts[r]));
    for (const Index k : own) *to++ = in[0][contained_[static_cast<std::size_t>(k)]];
    for (const auto [group, place] : division_.parameters[r]) *to++ = in[group][place];
    for (std::size_t g = 0; g < Task::kMostGroups; ++g)
      *to++ =
          g < question.ends.size()
              ? static_cast<double>(std::ranges::lower_bound(own, question.ends[g]) - own.begin())
              : 0.0;
    places += own.size();
  }
  asker_ = nullptr;
  Answer answer;
  try {
    team_->thread.run([&] {
      team_->agree(task);
      answer = team_->solve(task, &division_);
    });
  } catch (...) {
    team_->thread.lose();
    throw;
  }
  if (answer.has_converged) asker_ = question.asker;
  const double* from = division_.numbers.data();
  for (const Index k : division_.unknowns)
    in.unknowns()[contained_[static_cast<std::size_t>(k)]] = *from++;
  return answer;
}

std::shared_ptr<const EngineEquations> PetscSession::Engine::take(
    const std::string& name, const std::vector<Function::Input>& inputs,
    const ExprVector& equations, Backend::Kind backend) const {
  const DividedEquations divided(inputs, equations);
  const BlockGraph blocks(name, divided.size(), divided.pattern());
  const auto taken = std::make_shared<Taken>(team_, blocks.contained);
  try {
    team_->thread.run([&] {
      Task task{.what = Task::take};
      team_->agree(task);
      taken->set_native(team_->take(&blocks, [&](const std::vector<int>& parts) {
        return taken->divide(name, divided, blocks, parts, backend);
      }));
    });
  } catch (...) {
    team_->thread.lose();
    throw;
  }
  return taken;
}

std::string PetscSession::missing() { return {}; }

PetscSession::PetscSession(const std::vector<std::string>& options, const std::atomic<bool>* stop)
    : team_(std::make_shared<Team>(options, stop)) {}

PetscSession::~PetscSession() {
  if (is_lost()) return;
  try {
    team_->thread.run(
        [this] {
          Task task{.what = Task::end};
          if (is_first()) team_->agree(task);
          team_->finish();
        },
        PetscThread::Patience::endless);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "courant: %s\n", error.what());
  }
}

bool PetscSession::is_first() const { return team_->rank == 0; }
int PetscSession::ranks() const { return team_->ranks; }
bool PetscSession::is_lost() const { return team_->thread.is_lost(); }

std::shared_ptr<const EquationEngine> PetscSession::engine() const {
  return std::make_shared<Engine>(team_);
}

void PetscSession::serve() {
  team_->thread.run(
      [this] {
        try {
          team_->serve();
        } catch (const std::exception& error) {
          std::fprintf(stderr, "courant: rank %d: %s\n", team_->rank, error.what());
          MPI_Abort(PETSC_COMM_WORLD, kFailed);
        }
      },
      PetscThread::Patience::endless);
}

}  // namespace courant
