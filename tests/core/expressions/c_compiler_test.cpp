#include "courant/core/expressions/c_compiler.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <bit>
#include <boost/test/unit_test.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <thread>

#include "../numbers/operation_catalogue.hpp"
#include "../random_expressions.hpp"
#include "courant/core/expressions/function.hpp"
#include "courant/core/expressions/native_cache.hpp"
#include "courant/core/files/content_hash.hpp"
#include "courant/core/files/own_file.hpp"
#include "courant/core/files/work_folder.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * the sources of somebody are compiled code (core/expressions/native_cache.cpp)
BOOST_AUTO_TEST_SUITE(c_compiler_test, *boost::unit_test::precondition([](auto) {
                        return machine_compiler()->is_available();
                      }))

namespace {

namespace fs = std::filesystem;

// Each test has a cache of its own; nothing of the user's is read or written.
class Cache {
 public:
  Cache() {
    std::string name = (fs::temp_directory_path() / "courant-test-XXXXXX").string();
    folder_ = mkdtemp(name.data());
    setenv("COURANT_CACHE", path().c_str(), 1);
  }
  ~Cache() {
    unsetenv("COURANT_CACHE");
    unsetenv("COURANT_CC");
    fs::remove_all(folder_);
  }
  Cache(const Cache&) = delete;
  Cache& operator=(const Cache&) = delete;

  fs::path folder() const { return folder_; }
  fs::path path() const { return folder_ / "cache"; }
  std::vector<fs::path> files() const {
    std::vector<fs::path> result;
    for (const auto& entry : fs::directory_iterator(path())) result.push_back(entry.path());
    return result;
  }
  std::vector<fs::path> objects() const {
    std::vector<fs::path> result;
    if (fs::exists(path()))
      for (const auto& entry : fs::directory_iterator(path()))
        if (entry.path().extension() == ".so") result.push_back(entry.path());
    return result;
  }

 private:
  fs::path folder_;
};

std::string constant_function(double value) {
  return "void f(const double *const *in, const double *constants, double *out) { (void)in; "
         "(void)constants; out[0] = " +
         std::to_string(value) + "; }\n";
}

double call(const NativeCode& library) {
  double out = 0.0;
  library.function("f")(nullptr, nullptr, &out);
  return out;
}

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) ||
         (std::isnan(a) && std::isnan(b));
}

BOOST_FIXTURE_TEST_CASE(every_operation_gives_the_bits_of_the_interpreter, Cache) {
  Graph graph;
  std::vector<Expr> outputs;
  std::vector<Expr> variables;
  std::vector<double> numbers;
  for (const auto& sample : operation_catalogue()) {
    for (const VectorXd& point : sample.points) {
      const ExprVector u = graph.variables("u", point.size());
      variables.insert(variables.end(), u.begin(), u.end());
      numbers.insert(numbers.end(), point.begin(), point.end());
      outputs.push_back(sample.apply(u));
    }
  }
  for (const double special :
       {0.0, -0.0, 1e308, -1e308, 5e-324, std::numeric_limits<double>::infinity(),
        std::numeric_limits<double>::quiet_NaN()}) {
    const Expr u = graph.variable("u"), v = graph.variable("v");
    variables.insert(variables.end(), {u, v});
    numbers.insert(numbers.end(), {special, 0.0});
    for (const Expr& y : {sqrt(u), exp(u), sign(u), abs(u), -u, min(u, v), max(u, v), u < v, u <= v,
                          equal(u, v), u / v, logical_and(u, v), logical_or(u, v), logical_not(u),
                          select(u, v, 1.0), atan2(u, v), pow(u, 3)})
      outputs.push_back(y);
  }
  const ExprVector x =
      Eigen::Map<ExprVector>(variables.data(), static_cast<Index>(variables.size()));
  const ExprVector y = Eigen::Map<ExprVector>(outputs.data(), static_cast<Index>(outputs.size()));
  const VectorXd point = Eigen::Map<VectorXd>(numbers.data(), static_cast<Index>(numbers.size()));
  const VectorXd interpreted = Function("f", {{"x", x}}, y)({point});
  const Function native("f", {{"x", x}}, y, {.backend = Backend::native});
  BOOST_TEST(native.is_native());
  const VectorXd compiled = native({point});
  for (Index i = 0; i < y.size(); ++i)
    BOOST_TEST(same_bits(interpreted[i], compiled[i]),
               y[i] << ": " << interpreted[i] << " and " << compiled[i]);
}

BOOST_FIXTURE_TEST_CASE(random_programs_give_the_bits_of_the_interpreter, Cache) {
  for (const Index size : {1, 30, 300, 1500}) {  // in one part and in several
    std::mt19937 generator(static_cast<unsigned>(size));
    Graph graph;
    const ExprVector x = graph.variables("x", 6), p = graph.variables("p", 2);
    ExprVector both(8);
    both << x, p;
    const ExprVector made = random_expressions(generator, both, size, false);
    ExprVector y(std::min<Index>(size, 40) + 2);
    y << made.tail(y.size() - 2), 1.0 / 3.0, p[1];
    const std::vector<Function::Input> inputs = {
        {"x", x}, {"unused", graph.variables("u", 2)}, {"p", p}};
    const Function interpreter("f", inputs, y, {.differentiate = {"x"}});
    const Function native("f", inputs, y, {.differentiate = {"x"}, .backend = Backend::native});
    Index finite = 0;
    for (int trial = 0; trial < 20; ++trial) {
      const VectorXd at_x = random_point(generator, 6), at_p = random_point(generator, 2);
      const double* const in[] = {at_x.data(), nullptr, at_p.data()};
      VectorXd a(y.size() + interpreter.nonzeros()), b(a.size());
      interpreter.value_and_jacobian(in, a.data());
      native.value_and_jacobian(in, b.data());
      for (Index i = 0; i < a.size(); ++i)
        BOOST_REQUIRE_MESSAGE(same_bits(a[i], b[i]), size << ", entry " << i);
      native.value(in, b.data());
      for (Index i = 0; i < y.size(); ++i) BOOST_REQUIRE(same_bits(a[i], b[i]));
      finite += a.array().isFinite().count();
    }
    BOOST_TEST(finite > 0);
  }
}

// A value of 330 instructions with a Jacobian of more than 12,000: the value is compiled alone.
BOOST_FIXTURE_TEST_CASE(a_huge_jacobian_is_interpreted, Cache) {
  Graph graph;
  const ExprVector x = graph.variables("x", 110);
  const Expr sum = x.sum();
  ExprVector y = x;
  for (Expr& entry : y) entry = sin(entry * sum);
  const auto make = [&](Backend backend) {
    return Function("f", {{"x", x}}, y, {.differentiate = {"x"}, .backend = backend});
  };
  const Function native = make(Backend::automatic), interpreted = make(Backend::interpreter);
  BOOST_TEST(native.is_native());
  const VectorXd at = VectorXd::LinSpaced(110, -1.0, 1.1);
  BOOST_TEST((native({at}) - interpreted({at})).norm() == 0.0);
  BOOST_TEST((native.jacobian({at}) - interpreted.jacobian({at})).norm() == 0.0);
}

BOOST_FIXTURE_TEST_CASE(automatic_is_native_for_what_is_worth_it, Cache) {
  Graph graph;
  const ExprVector x = graph.variables("x", 3);
  const Function small("f", {{"x", x}}, ExprVector::Constant(1, x[0] + x[1]),
                       {.backend = Backend::automatic});
  BOOST_TEST(!small.is_native());
  const ExprVector y = ExprVector::Constant(1, sin(x[0]) * exp(x[1]) / (1.0 + square(x[2])));
  BOOST_TEST(Function("f", {{"x", x}}, y, {.backend = Backend::automatic}).is_native());
  setenv("COURANT_CC", "/bin/false", 1);  // a compiler that doesn't work
  BOOST_TEST(!Function("f", {{"x", x}}, ExprVector(y * Expr(2.0)), {.backend = Backend::automatic})
                  .is_native());
  BOOST_CHECK_THROW(
      Function("f", {{"x", x}}, ExprVector(y * Expr(2.0)), {.backend = Backend::native}),
      std::runtime_error);
}

// Three short functions in one object, and a long one in another.
BOOST_FIXTURE_TEST_CASE(functions_together_are_one_object, Cache) {
  Graph graph;
  const ExprVector x = graph.variables("x", 3);
  const Backend together = Backend::native.together();
  std::vector<Function> functions, interpreted;
  const auto add = [&](const ExprVector& y) {
    const std::vector<Function::Input> inputs = {{"x", x}};
    functions.emplace_back("f", inputs, y,
                           Function::Options{.differentiate = {"x"}, .backend = together});
    interpreted.emplace_back("f", inputs, y, Function::Options{.differentiate = {"x"}});
  };
  for (int k = 1; k <= 3; ++k)
    add(ExprVector::Constant(1, sin(x[0] * k) * exp(x[1]) / (1.0 + square(x[2]))));
  Expr last = x[0];
  for (int k = 0; k < 400; ++k) last = sin(last * x[1] + k) * x[2] + last;
  add(ExprVector::Constant(1, last));
  together.compile();
  BOOST_TEST(objects().size() == 2);
  const VectorXd at{{0.5, -0.25, 1.5}};
  for (std::size_t k = 0; k < functions.size(); ++k) {
    BOOST_TEST(functions[k].is_native());
    BOOST_TEST((functions[k]({at}) - interpreted[k]({at})).norm() == 0.0);
    BOOST_TEST((functions[k].jacobian({at}) - interpreted[k].jacobian({at})).norm() == 0.0);
  }
}

BOOST_FIXTURE_TEST_CASE(objects_are_cached_by_content, Cache) {
  BOOST_TEST(call(*machine_compiler()->compile(constant_function(1.0))) == 1.0);
  BOOST_REQUIRE(objects().size() == 1);
  const fs::path object = objects()[0];
  const auto made = fs::last_write_time(object);
  BOOST_TEST(call(*machine_compiler()->compile(constant_function(1.0))) == 1.0);
  BOOST_CHECK(fs::last_write_time(object) == made);
  BOOST_TEST(call(*machine_compiler()->compile(constant_function(2.0))) == 2.0);
  BOOST_TEST(objects().size() == 2);
  BOOST_TEST((fs::status(path()).permissions() == fs::perms::owner_all));
}

BOOST_FIXTURE_TEST_CASE(an_entry_of_another_source_is_not_used, Cache) {
  machine_compiler()->compile(constant_function(1.0));
  const fs::path object = objects().at(0), source = fs::path(object).replace_extension(".c");
  std::ofstream(source) << "something else of the same hash";
  BOOST_TEST(call(*machine_compiler()->compile(constant_function(1.0))) == 1.0);
  std::ofstream(object, std::ios::trunc)
      << "not an object";  // and one that doesn't load is made anew
  BOOST_TEST(call(*machine_compiler()->compile(constant_function(1.0))) == 1.0);
}

// All functions have the same symbol, so that an object of another entry loads, and computes something else.
BOOST_FIXTURE_TEST_CASE(an_entry_with_the_object_of_another_is_made_anew, Cache) {
  machine_compiler()->compile(constant_function(1.0));
  const fs::path first = objects().at(0);
  machine_compiler()->compile(constant_function(2.0));
  const auto all = objects();
  const fs::path second = all.at(0) == first ? all.at(1) : all.at(0);
  for (const char* extension : {".so", ".sum"})
    fs::copy_file(fs::path(second).replace_extension(extension),
                  fs::path(first).replace_extension(extension),
                  fs::copy_options::overwrite_existing);
  BOOST_TEST(call(*machine_compiler()->compile(constant_function(1.0))) == 1.0);
}

// A full disk or a crash leaves half of an object, and loading that ends the program (SIGBUS).
BOOST_FIXTURE_TEST_CASE(an_object_that_was_cut_off_is_made_anew, Cache) {
  machine_compiler()->compile(constant_function(1.0));
  const fs::path object = objects().at(0);
  const auto size = fs::file_size(object);
  for (const auto length : {size / 2, size - 1, std::uintmax_t{0}}) {
    fs::resize_file(object, length);
    BOOST_TEST(call(*machine_compiler()->compile(constant_function(1.0))) == 1.0);
    BOOST_TEST(fs::file_size(object) == size);
  }
  fs::remove(fs::path(object).replace_extension(".sum"));
  BOOST_TEST(call(*machine_compiler()->compile(constant_function(1.0))) == 1.0);
}

BOOST_FIXTURE_TEST_CASE(what_is_old_or_too_much_is_pruned, Cache) {
  for (const double value : {1.0, 2.0, 3.0}) machine_compiler()->compile(constant_function(value));
  const auto cache = NativeCache::open();
  BOOST_REQUIRE(cache);
  const auto entries = cache->entries();
  BOOST_REQUIRE(entries.size() == 3);
  const auto age = [&](const std::string& name, int days) {
    for (const char* extension : {".c", ".so", ".sum"})
      fs::last_write_time(path() / (name + extension),
                          fs::file_time_type::clock::now() - std::chrono::hours(24 * days));
  };
  age(entries[0].name, 100);
  age(entries[1].name, 10);
  cache->prune({});
  BOOST_TEST(cache->entries().size() == 2);
  cache->prune({.bytes = entries[0].bytes + 10});  // room for one
  BOOST_REQUIRE(cache->entries().size() == 1);
  BOOST_TEST(cache->entries()[0].name == entries[2].name);
  cache->clear();
  BOOST_TEST(files().size() == 1);  // the mark of the folder
}

// An entry that is used is young.
BOOST_FIXTURE_TEST_CASE(what_is_used_is_kept, Cache) {
  machine_compiler()->compile(constant_function(1.0));
  for (const auto& file : files())
    fs::last_write_time(file, fs::file_time_type::clock::now() - std::chrono::hours(24 * 80));
  machine_compiler()->compile(constant_function(1.0));
  NativeCache::open()->prune({.age = std::chrono::hours(24 * 60)});
  BOOST_TEST(NativeCache::open()->entries().size() == 1);
}

BOOST_FIXTURE_TEST_CASE(what_a_killed_compilation_left_is_removed, Cache) {
  const auto cache = NativeCache::open();
  const fs::path left = path() / "courant-work-abcdef";
  fs::create_directory(left);
  std::ofstream(left / "source.c") << "half";
  const WorkFolder in_use(path());
  for (const fs::path& folder : {left, in_use.path()})
    fs::last_write_time(folder, fs::file_time_type::clock::now() - std::chrono::hours(1));
  cache->prune({});
  BOOST_TEST(!fs::exists(left));
  BOOST_TEST(fs::exists(in_use.path()));
}

// Somebody's sources, whatever their age and their names: the folder is theirs, and no cache.
BOOST_FIXTURE_TEST_CASE(a_folder_with_other_files_is_not_used, Cache) {
  fs::create_directories(path());
  for (const char* name : {"main.c", "library.so"}) std::ofstream(path() / name) << "mine";
  std::string defect;
  BOOST_TEST(!NativeCache::open(&defect).has_value());
  BOOST_TEST(defect.find("beside files that are not of it: ") != std::string::npos);
  BOOST_TEST(call(*machine_compiler()->compile(constant_function(1.0))) == 1.0);
  BOOST_TEST(files().size() == 2);
}

BOOST_FIXTURE_TEST_CASE(a_folder_with_names_like_those_of_entries_is_not_used, Cache) {
  fs::create_directories(path());
  for (const char* extension : {".c", ".so", ".sum"})
    std::ofstream(path() / ("0123456789abcdef0123456789abcdef" + std::string(extension))) << "mine";
  BOOST_TEST(!NativeCache::open().has_value());
  BOOST_TEST(call(*machine_compiler()->compile(constant_function(1.0))) == 1.0);
  BOOST_TEST(files().size() == 3);
}

// What comes into a marked folder later is not ours either.
BOOST_FIXTURE_TEST_CASE(only_names_of_entries_are_removed, Cache) {
  machine_compiler()->compile(constant_function(1.0));
  const auto year_ago = fs::file_time_type::clock::now() - std::chrono::hours(24 * 365);
  std::vector<fs::path> mine;
  for (const char* name : {"main.c", "ABCDEF0123456789ABCDEF0123456789.c", "0123.so", "notes.sum"})
    mine.push_back(path() / name);
  for (const fs::path& file : mine) {
    std::ofstream(file) << "mine";
    fs::last_write_time(file, year_ago);
  }
  NativeCache::open()->prune({});
  NativeCache::open()->clear();
  for (const fs::path& file : mine) BOOST_TEST(fs::exists(file), file);
  BOOST_TEST(NativeCache::open()->entries().empty());
}

BOOST_FIXTURE_TEST_CASE(a_folder_in_the_place_of_an_object_does_not_stop_it, Cache) {
  machine_compiler()->compile(constant_function(1.0));
  const fs::path object = objects().at(0);
  fs::remove(object);
  fs::create_directory(object);
  BOOST_TEST(call(*machine_compiler()->compile(constant_function(1.0))) == 1.0);
}

BOOST_FIXTURE_TEST_CASE(a_compiler_that_makes_nothing_is_said, Cache) {
  BOOST_CHECK_EXCEPTION(CCompiler("/bin/true").compile(constant_function(1.0)), std::runtime_error,
                        [](const std::exception& error) {
                          return std::string(error.what()) ==
                                 "CCompiler::compile: /bin/true made no object.";
                        });
}

BOOST_FIXTURE_TEST_CASE(a_compiler_that_does_not_work_is_a_defect, Cache) {
  BOOST_TEST(machine_compiler()->defect() == "");
  setenv("COURANT_CC", "/bin/false", 1);
  BOOST_TEST(machine_compiler()->defect() == "/bin/false failed.");
  setenv("COURANT_CC", "no-such-compiler", 1);
  BOOST_TEST(
      machine_compiler()->defect().starts_with("no C compiler: no-such-compiler is not found."));
}

// An interpreted run, a stranger's say, leaves no folder behind.
BOOST_FIXTURE_TEST_CASE(a_compiler_that_compiles_nothing_makes_no_cache, Cache) {
  BOOST_TEST(machine_compiler()->is_available());
  BOOST_TEST(!fs::exists(path()));
}

BOOST_FIXTURE_TEST_CASE(a_cache_that_others_may_write_to_is_not_used, Cache) {
  // What a stranger could put there: the right source beside the wrong object and its sum.
  machine_compiler()->compile(constant_function(2.0));
  const auto with = [](fs::path file, const char* extension) {
    return file.replace_extension(extension);
  };
  const fs::path wrong = objects().at(0);
  const std::string object = content_of(wrong);
  for (const char* extension : {".so", ".sum", ".c"}) fs::remove(with(wrong, extension));
  machine_compiler()->compile(constant_function(1.0));
  const fs::path right = objects().at(0);
  std::ofstream(right, std::ios::binary) << object;
  std::ofstream(with(right, ".sum"))
      << object.size() << ' ' << content_hash(right.stem().string() + object) << '\n';
  BOOST_TEST(call(*machine_compiler()->compile(constant_function(1.0))) ==
             2.0);  // such an entry would be believed
  fs::permissions(path(), fs::perms::group_write, fs::perm_options::add);
  BOOST_TEST(call(*machine_compiler()->compile(constant_function(1.0))) == 1.0);
  BOOST_TEST(objects().size() == 1);
}

BOOST_FIXTURE_TEST_CASE(without_a_directory_to_write_to_it_still_compiles, Cache) {
  std::ofstream(folder() / "file") << "";
  setenv("COURANT_CACHE", (folder() / "file" / "cache").c_str(), 1);
  BOOST_TEST(call(*machine_compiler()->compile(constant_function(3.0))) == 3.0);
}

BOOST_FIXTURE_TEST_CASE(a_folder_of_the_path_may_be_unreadable, Cache) {
  fs::create_symlink("loop", folder() / "loop");  // neither there nor absent: an error to ask about
  const std::string path = std::getenv("PATH");
  setenv("PATH", ((folder() / "loop").string() + ":" + path).c_str(), 1);
  BOOST_TEST(machine_compiler()->is_available());
  setenv("PATH", path.c_str(), 1);
}

BOOST_FIXTURE_TEST_CASE(threads_may_compile_the_same_at_once, Cache) {
  std::vector<double> result(4, 0.0);
  {
    std::vector<std::jthread> threads;
    for (double& value : result)
      threads.emplace_back(
          [&] { value = call(*machine_compiler()->compile(constant_function(4.0))); });
  }
  for (const double value : result) BOOST_TEST(value == 4.0);
  BOOST_TEST(objects().size() == 1);
  for (const auto& entry : fs::directory_iterator(path()))
    BOOST_TEST(!entry.is_directory(), "left behind: " << entry);
}

BOOST_FIXTURE_TEST_CASE(what_goes_wrong_is_said, Cache) {
  const auto says = [](const std::string& text) {
    return [text](const std::exception& e) {
      return std::string(e.what()).find(text) != std::string::npos;
    };
  };
  BOOST_CHECK_EXCEPTION(machine_compiler()->compile("void f( {"), std::runtime_error,
                        says("error"));
  BOOST_CHECK_EXCEPTION(
      machine_compiler()->compile("void undefined(void); void f(void) { undefined(); }"),
      std::runtime_error, says("undefined"));
  BOOST_CHECK_THROW(machine_compiler()->compile(constant_function(5.0))->function("g"),
                    std::runtime_error);
  setenv("COURANT_CC", "no-such-compiler", 1);
  BOOST_TEST(!machine_compiler()->is_available());
  BOOST_CHECK_EXCEPTION(machine_compiler()->compile(constant_function(6.0)), std::runtime_error,
                        says("no-such-compiler"));
  // A name is a program, never a command for a shell.
  setenv("COURANT_CC", ("touch " + (folder() / "touched").string() + ";cc").c_str(), 1);
  BOOST_CHECK_THROW(machine_compiler()->compile(constant_function(6.0)), std::runtime_error);
  BOOST_TEST(!fs::exists(folder() / "touched"));
}

}  // namespace

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
