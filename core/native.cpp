#include "courant/core/native.hpp"

#include <dlfcn.h>
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <system_error>
#include <vector>

#include "courant/core/message.hpp"
#include "courant/core/native_cache.hpp"

extern char** environ;

namespace courant {
namespace {

namespace fs = std::filesystem;

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr ? value : "";
}

std::string compiler_name() {
  const std::string wanted = environment("COURANT_CC");
  return wanted.empty() ? "cc" : wanted;
}

// The file that a program name stands for, as a shell would find it; empty if there is none.
fs::path find_program(const std::string& name) {
  const auto executable = [](const fs::path& file) {
    std::error_code unreadable;  // as a folder of PATH may be
    return fs::is_regular_file(file, unreadable) && access(file.c_str(), X_OK) == 0;
  };
  if (name.find('/') != std::string::npos) return executable(name) ? fs::path(name) : fs::path();
  std::istringstream path(environment("PATH"));
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
  for (const char* name : {"exp", "log", "sin", "cos", "tan", "asin", "acos", "atan", "sinh",
                           "cosh", "tanh", "pow", "atan2"})
    result.push_back(std::string("-fno-builtin-") + name);
  return result;
}

std::string read(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

fs::path temporary_directory() {
  std::error_code error;
  const fs::path result = fs::temp_directory_path(error);
  return error ? "/tmp" : result;
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
    throw std::runtime_error("NativeLibrary::compile: " + compiler.string() +
                             " cannot be started: " + std::strerror(error) + ".");

  int status = 0;
  pid_t waited = 0;
  while ((waited = waitpid(child, &status, 0)) < 0 && errno == EINTR) {
  }
  // Where the host program ignores SIGCHLD there is no status; the object tells then.
  const bool failed =
      waited == child ? !(WIFEXITED(status) && WEXITSTATUS(status) == 0) : !fs::exists(object);
  if (failed)
    throw std::runtime_error("NativeLibrary::compile: " + compiler.string() + " failed:\n" +
                             read(log).substr(0, 2000));
}

void* load(const fs::path& object) { return dlopen(object.c_str(), RTLD_NOW | RTLD_LOCAL); }

}  // namespace

std::string native_compiler_defect() {
  try {
    NativeLibrary::compile("int courant_nothing;\n");
    return "";
  } catch (const std::runtime_error& error) {
    const std::string what = without_place(error.what());
    return what.substr(0, what.find('\n'));
  }
}

bool native_compiler_available() { return !find_program(compiler_name()).empty(); }

std::shared_ptr<const NativeLibrary> NativeLibrary::compile(const std::string& c_source) {
  const fs::path compiler = find_program(compiler_name());
  if (compiler.empty())
    throw std::runtime_error(
        "NativeLibrary::compile: no C compiler: " + compiler_name() +
        " is not found. Install one, name one in COURANT_CC, or use the interpreter.");
  const std::vector<std::string> options = flags(c_source.size());
  std::string content = "/* " + compiler.string();
  for (const std::string& option : options) content += " " + option;
  content += " */\n" + c_source;

  const auto cache = NativeCache::open();
  const auto owned = [](void* handle) {
    return std::shared_ptr<const NativeLibrary>(new NativeLibrary(handle));
  };
  if (const auto cached = cache ? cache->find(content) : std::nullopt)
    if (void* handle = load(*cached)) return owned(handle);  // one that doesn't load is made anew

  const CompilationFolder work(cache ? cache->folder() : temporary_directory());
  const fs::path source = work.path() / "source.c";
  fs::path object = work.path() / "object.so";
  std::ofstream(source, std::ios::binary) << content;
  run_compiler(compiler, options, source, object);
  if (cache) object = cache->add(content, source, object);
  if (void* handle = load(object)) return owned(handle);
  throw std::runtime_error(std::string("NativeLibrary::compile: the object does not load: ") +
                           dlerror());
}

NativeLibrary::~NativeLibrary() { dlclose(handle_); }

NativeLibrary::Evaluate NativeLibrary::function(const std::string& symbol) const {
  if (void* address = dlsym(handle_, symbol.c_str())) return reinterpret_cast<Evaluate>(address);
  throw std::runtime_error("NativeLibrary::function: no symbol " + symbol + ".");
}

}  // namespace courant
