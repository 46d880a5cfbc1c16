#include "courant/core/expressions/c_compiler.hpp"

#include <dlfcn.h>
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <system_error>
#include <vector>

#include "courant/core/expressions/host.hpp"
#include "courant/core/expressions/native_cache.hpp"
#include "courant/core/files/output_file.hpp"
#include "courant/core/files/own_file.hpp"
#include "courant/core/files/work_folder.hpp"

extern char** environ;

namespace courant {
namespace {

namespace fs = std::filesystem;

// The file that a program name stands for, as a shell would find it; empty if there is none.
fs::path find_program(const std::string& name) {
  const auto executable = [](const fs::path& file) {
    std::error_code unreadable;  // as a folder of PATH may be
    return fs::is_regular_file(file, unreadable) && access(file.c_str(), X_OK) == 0;
  };
  if (name.find('/') != std::string::npos) return executable(name) ? fs::path(name) : fs::path();
  std::istringstream path(environment_variable("PATH"));
  for (std::string folder; std::getline(path, folder, ':');) {
    fs::path file = fs::path(folder.empty() ? "." : folder) / name;
    if (executable(file)) return file;
  }
  return {};
}

// The same bits as the interpreter: no contraction of a*b+c into one rounding, nothing of
// -ffast-math (-fno-math-errno only lets sqrt be one instruction), and the functions of the C
// library themselves, not what the compiler knows about them.
std::vector<std::string> flags(std::size_t source_size) {
  // A long source is in parts (see Program::c_source) that -O3 makes hardly faster than -O1 but
  // compiles for twice as long.
  constexpr std::size_t kLongSource = 100'000;
  std::vector<std::string> result = {source_size > kLongSource ? "-O1" : "-O3",
                                     "-std=c99",
                                     "-ffp-contract=off",
                                     "-fno-math-errno",
                                     "-w",
                                     "-fPIC",
                                     "-shared"};
#if defined(__x86_64__) && defined(__GNUC__)
  // Instructions with a place of their own for the result, of which the baseline has none: up to a third fewer. They
  // round alike. Vectors stay short: long ones need more shuffles than they save.
  if (__builtin_cpu_supports("avx"))
    result.insert(result.end(), {"-mavx", "-mprefer-vector-width=128"});
#endif
  for (const char* name : {"exp", "log", "sin", "cos", "tan", "asin", "acos", "atan", "sinh",
                           "cosh", "tanh", "pow", "atan2"})
    result.push_back(std::string("-fno-builtin-") + name);
  return result;
}

// Runs the compiler, no shell between; throws std::runtime_error with what it said if it fails.
void run_compiler(const fs::path& compiler, const std::vector<std::string>& options,
                  const fs::path& source, const fs::path& object) {
  const fs::path log = object.parent_path() / "log";
  std::vector<std::string> words = {compiler.string()};
  words.insert(words.end(), options.begin(), options.end());
  words.insert(words.end(), {"-o", object.string(), source.string(), "-lm"});
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);

  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, log.c_str(),
                                   O_WRONLY | O_CREAT | O_APPEND, 0600);
  posix_spawn_file_actions_adddup2(&files, STDOUT_FILENO, STDERR_FILENO);
  pid_t child = 0;
  const int error =
      posix_spawn(&child, compiler.c_str(), &files, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  if (error != 0)
    throw std::runtime_error("CCompiler::compile: " + compiler.string() +
                             " cannot be started: " + std::strerror(error) + ".");

  int status = 0;
  pid_t waited = 0;
  while ((waited = waitpid(child, &status, 0)) < 0 && errno == EINTR) {
  }
  // Where the host program ignores SIGCHLD there is no status; the object tells then.
  const bool failed = waited == child && !(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  if (failed || !fs::is_regular_file(object)) {
    const std::string said = content_of(log).substr(0, 2000);
    const std::string what = failed ? " failed" : " made no object";
    throw std::runtime_error("CCompiler::compile: " + compiler.string() + what +
                             (said.empty() ? "." : ":\n" + said));
  }
}

// A shared object, unloaded with the last owner.
class SharedObject final : public NativeCode {
 public:
  // Null where it cannot be loaded; dlerror() says why.
  static std::shared_ptr<const NativeCode> load(const fs::path& file) {
    void* handle = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    return handle != nullptr ? std::make_shared<const SharedObject>(handle) : nullptr;
  }

  explicit SharedObject(void* handle) : handle_(handle) {}
  ~SharedObject() override { dlclose(handle_); }
  SharedObject(const SharedObject&) = delete;
  SharedObject& operator=(const SharedObject&) = delete;

  Evaluate function(const std::string& symbol) const override {
    if (void* address = dlsym(handle_, symbol.c_str())) return reinterpret_cast<Evaluate>(address);
    throw std::runtime_error("NativeCode::function: no symbol " + symbol + ".");
  }

 private:
  void* handle_;
};

}  // namespace

CCompiler::CCompiler(std::string program, bool keeps_objects)
    : program_(std::move(program)), keeps_objects_(keeps_objects) {}

CCompiler CCompiler::from_environment() {
  const std::string wanted = environment_variable("COURANT_CC");
  return CCompiler(wanted.empty() ? "cc" : wanted, true);
}

std::shared_ptr<const NativeCompiler> machine_compiler() {
  return std::make_shared<const CCompiler>(CCompiler::from_environment());
}

bool CCompiler::is_available() const { return !find_program(program_).empty(); }

std::shared_ptr<const NativeCode> CCompiler::compile(const std::string& c_source) const {
  const fs::path compiler = find_program(program_);
  if (compiler.empty())
    throw std::runtime_error(
        "CCompiler::compile: no C compiler: " + program_ +
        " is not found. Install one, name one in COURANT_CC, or use the interpreter.");
  const std::vector<std::string> options = flags(c_source.size());
  std::string content = "/* " + compiler.string();
  for (const std::string& option : options) content += " " + option;
  content += " */\n" + c_source;

  const auto cache = keeps_objects_ ? NativeCache::open() : std::nullopt;
  if (const auto cached = cache ? cache->find(content) : std::nullopt)
    if (auto code = SharedObject::load(*cached)) return code;  // one that doesn't load is made anew

  const WorkFolder work(cache ? cache->folder() : WorkFolder::temporary_folder());
  const fs::path source = work.path() / "source.c";
  fs::path object = work.path() / "object.so";
  write_file(source, content);
  run_compiler(compiler, options, source, object);
  if (cache) object = cache->add(content, source, object);
  if (auto code = SharedObject::load(object)) return code;
  throw std::runtime_error(std::string("CCompiler::compile: the object does not load: ") +
                           dlerror());
}

}  // namespace courant
