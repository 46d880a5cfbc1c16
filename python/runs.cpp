// Runs in memory.
#include <atomic>
#include <chrono>
#include <csignal>
#include <utility>

#include "courant/core/numbers/parallel.hpp"
#include "courant/python/conversions.hpp"
#include "courant/running/ensemble_run.hpp"
#include "courant/running/run_files.hpp"
#include "courant/running/run_in_memory.hpp"

namespace courant::python {
namespace {

std::atomic<bool> interrupted = false;  // by a signal
std::atomic<bool> stopped = false;      // the run in the main thread

extern "C" void interrupt(int) {
  interrupted = true;
  stopped = true;
}

// What stops a run after its step. In the main thread that is SIGINT too while this lives, rather than a flag that Python
// would look at when the run is over.
class Stop {
 public:
  explicit Stop(bool is_main_thread) : is_main_thread_(is_main_thread) {
    if (!is_main_thread_) return;
    interrupted = false;
    stopped = false;
    before_ = PyOS_setsig(SIGINT, interrupt);
  }
  ~Stop() {
    if (is_main_thread_) PyOS_setsig(SIGINT, before_);
  }
  Stop(const Stop&) = delete;
  Stop& operator=(const Stop&) = delete;

  std::atomic<bool>& flag() { return is_main_thread_ ? stopped : own_; }

 private:
  bool is_main_thread_;
  std::atomic<bool> own_ = false;
  PyOS_sighandler_t before_ = nullptr;
};

Backend::Kind backend_of(const std::string& word) {
  if (word == "auto") return Backend::Kind::automatic;
  if (word == "native") return Backend::Kind::native;
  if (word == "interpreter") return Backend::Kind::interpreter;
  throw py::value_error("backend is \"" + word +
                        "\", expected \"auto\", \"native\" or \"interpreter\"");
}

py::tuple table(RunTable&& rows) {
  const auto count = static_cast<py::ssize_t>(rows.rows());
  const auto columns = static_cast<py::ssize_t>(rows.names.size());
  return py::make_tuple(rows.names, owned(std::move(rows.values), count, columns));
}

struct Settings {
  std::string backend;
  bool has_curve = false;
  bool is_main_thread = false;
  py::object progress;
};

// What is called with the progress may answer False, which stops the run.
RunOptions options_of(const Settings& settings, Stop& stop) {
  RunOptions options;
  options.backend = backend_of(settings.backend);
  options.stop = &stop.flag();
  if (!settings.progress.is_none())
    options.on_progress = [&settings, &stop](const Progress& progress) {
      const py::gil_scoped_acquire locked;
      const py::object answer =
          settings.progress(progress.step, progress.steps, progress.seconds, progress.energy_drift);
      if (answer.is(py::bool_(false))) stop.flag() = true;
    };
  return options;
}

// status, message, summary, (names, rows), {event: (names, rows)}, curve
py::tuple parts_of(RunInMemory&& run) {
  py::dict events;
  for (auto& [name, rows] : run.events) events[py::str(name)] = table(std::move(rows));
  return py::make_tuple(to_string(run.outcome.status), run.outcome.message,
                        to_python(courant::to_json(run.outcome.summary)),
                        table(std::move(run.rows)), events,
                        run.curve ? py::cast(run.curve) : py::none());
}

py::tuple run_here(const Experiment& experiment, const Settings& settings) {
  RunInMemory run;
  {
    Stop stop(settings.is_main_thread);
    const RunInMemoryOptions options{.run = options_of(settings, stop),
                                     .has_curve = settings.has_curve};
    const py::gil_scoped_release free;
    run = run_in_memory(experiment, options);
  }
  return parts_of(std::move(run));
}

// The same of several, on several threads. What one throws is its status and message.
py::list run_all(const std::vector<std::shared_ptr<Experiment>>& experiments,
                 const std::string& backend, unsigned threads) {
  RunInMemoryOptions options;
  options.run.backend = backend_of(backend);
  options.run.ahead = false;  // the cores have work
  std::vector<RunInMemory> runs(experiments.size());
  {
    const py::gil_scoped_release free;
    in_parallel(experiments.size(), threads, [&](std::size_t i) {
      try {
        runs[i] = run_in_memory(*experiments[i], options);
      } catch (const std::runtime_error& error) {
        runs[i].outcome.message = error.what();
      } catch (const std::domain_error& error) {
        runs[i].outcome.message = error.what();
      }
    });
  }
  py::list all;
  for (RunInMemory& run : runs) all.append(parts_of(std::move(run)));
  return all;
}

// The members of the experiment's ensemble: names, values (members, rows, columns), [status], [message], summary.
py::tuple run_ensemble(const Experiment& experiment, const std::string& backend, unsigned threads,
                       bool is_main_thread) {
  EnsembleInMemory all;
  {
    Stop stop(is_main_thread);
    const EnsembleOptions options{
        .backend = backend_of(backend), .threads = threads, .stop = &stop.flag()};
    const py::gil_scoped_release free;
    all = run_ensemble_in_memory(experiment, options);
  }
  std::vector<std::string> statuses;
  for (const RunStatus status : all.statuses) statuses.emplace_back(to_string(status));
  const auto done = static_cast<py::ssize_t>(statuses.size());
  const auto rows = static_cast<py::ssize_t>(all.opening.rows);
  const auto columns = static_cast<py::ssize_t>(all.opening.columns.size());
  const py::array values = owned(std::move(all.values), done * rows, columns);
  return py::make_tuple(all.opening.columns, values.attr("reshape")(done, rows, columns), statuses,
                        all.messages, to_python(all.outcome.summary));
}

void run_in_folder(const Experiment& experiment, const std::filesystem::path& folder,
                   const std::string& existing, const Settings& settings) {
  Stop stop(settings.is_main_thread);
  RunOptions options = options_of(settings, stop);
  options.folder = folder;
  options.existing = existing == "replace"  ? ExistingRun::replace
                     : existing == "resume" ? ExistingRun::resume
                                            : ExistingRun::refuse;
  const py::gil_scoped_release free;
  run(experiment, options);
}

py::tuple run_of_folder(const std::filesystem::path& folder) {
  const Run run = read_run(folder);
  const auto as_table = [](const TrajectoryTable& trajectory) {
    RunTable rows{.names = trajectory.names()};
    for (std::size_t i = 0; i < trajectory.rows(); ++i)
      for (const std::string& name : rows.names) rows.values.push_back(trajectory.column(name)[i]);
    return table(std::move(rows));
  };
  py::dict events;
  for (const auto& [name, rows] : run.events) events[py::str(name)] = as_table(rows);
  return py::make_tuple(to_string(run.summary.status), run.summary.message,
                        to_python(courant::to_json(run.summary)), as_table(run.trajectory), events,
                        py::none(), to_python(run.experiment));
}

}  // namespace

void bind_runs(py::module_& module) {
  py::class_<RunCurve, std::shared_ptr<RunCurve>>(module, "Curve")
      .def_property_readonly("names", &RunCurve::names)
      .def_property_readonly("first", &RunCurve::first)
      .def_property_readonly("last", &RunCurve::last)
      .def("__call__", [](RunCurve& curve, const VectorXd& times) {
        // times × names; the curve belongs to one thread at a time, so the GIL stays.
        MatrixXd rows(times.size(), static_cast<Index>(curve.names().size()));
        for (Index i = 0; i < times.size(); ++i) rows.row(i) = curve(times[i]).transpose();
        return rows;
      });
  module.def(
      "run",
      [](const Experiment& experiment, const std::string& backend, bool has_curve,
         bool is_main_thread, const py::object& progress) {
        return run_here(experiment, {backend, has_curve, is_main_thread, progress});
      },
      py::arg("experiment"), py::arg("backend") = "auto", py::arg("has_curve") = false,
      py::arg("is_main_thread") = false, py::arg("progress") = py::none());
  module.def("run_all", &run_all, py::arg("experiments"), py::arg("backend"), py::arg("threads"));
  module.def("run_ensemble", &run_ensemble, py::arg("experiment"), py::arg("backend"),
             py::arg("threads"), py::arg("is_main_thread"));
  module.def(
      "run_in_folder",
      [](const Experiment& experiment, const std::string& folder, const std::string& existing,
         const std::string& backend, bool is_main_thread, const py::object& progress) {
        run_in_folder(experiment, folder, existing, {backend, false, is_main_thread, progress});
      },
      py::arg("experiment"), py::arg("folder"), py::arg("existing") = "refuse",
      py::arg("backend") = "auto", py::arg("is_main_thread") = false,
      py::arg("progress") = py::none());
  module.def("run_of_folder", [](const std::string& folder) { return run_of_folder(folder); });
  module.def("was_interrupted", [] { return interrupted.exchange(false); });
}

}  // namespace courant::python
