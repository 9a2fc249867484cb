// Differential testing: generated programs must behave alike however they are run.
//   differential [--first=SEED] [--count=N] [--ways=interp|native|all|suite] [--rung=PATH] [--folder=PATH]
// `suite` interprets all of them and compiles one batch.
//   differential --print=SEED
// The judge is the interpreter at -O0: slow and plain. Each other way must give its exit code, its fault and its trace
// of all variables, once with the default checks and once with none. What differs is made small and printed; the exit
// code is then 1. Seeds go in batches of 25, so that one run of g++ serves many; the last of each batch may fault and
// runs alone. Called by tests/runner with few seeds and by hand with many.
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/fuzz/differential/program.h"
#include "tests/fuzz/differential/shrink.h"

namespace rung::differential {
namespace {

constexpr uint64_t kBatch = 25;

struct Options {
  uint64_t first = 0, count = 200;
  std::string ways = "interp", rung, folder;
};

struct Way {
  const char* compiler;  // null: interpreted
  const char* options;
};

const Way kJudge = {nullptr, "--engine=interp -O0"};
const Way kInterpreted[] = {{nullptr, "--engine=interp -O1"}, {nullptr, "--engine=interp -O2"}};
const Way kQuickNative[] = {{"g++", "--engine=native -O0"}, {"g++", "--engine=native -O2"}};
const Way kNative[] = {{"g++", "--engine=native -O0"},     {"g++", "--engine=native -O1"},
                       {"g++", "--engine=native -O2"},     {"clang++", "--engine=native -O0"},
                       {"clang++", "--engine=native -O1"}, {"clang++", "--engine=native -O2"}};

struct Outcome {
  int exit_code = 0;
  std::string trace;
  std::string errors;  // the headings only

  bool operator==(const Outcome& other) const {
    return exit_code == other.exit_code && trace == other.trace && errors == other.errors;
  }
  bool ran() const { return exit_code == 0 || exit_code == 3; }
};

std::string read(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(in), {});
}

class Differential {
 public:
  explicit Differential(const Options& options) : options_(options) {}

  // The number of seeds that differ.
  unsigned runAll();

 private:
  Outcome run(const std::string& text, const Way& way, const char* checks);
  unsigned compare(uint64_t first, uint64_t count, const Way& way, const char* checks);
  bool differs(const std::string& text, const Way& way, const char* checks);
  void report(uint64_t seed, const Way& way, const char* checks);

  const Options& options_;
};

Faults faultsOf(uint64_t seed) {
  if (seed % kBatch != kBatch - 1) return Faults::None;
  return seed / kBatch % 2 == 0 ? Faults::Division : Faults::Index;
}

std::string commandOf(const Options& options, const Way& way, const char* checks) {
  return (way.compiler != nullptr ? "CXX=" + std::string(way.compiler) + " " : "") + options.rung + " run " +
         way.options + " --checks=" + checks + " --cycles=6 --max-errors=5 --trace=- differential.st";
}

// A run that does not end is a difference like any other.
Outcome Differential::run(const std::string& text, const Way& way, const char* checks) {
  std::ofstream(options_.folder + "/differential.st", std::ios::binary) << text;
  const std::string command =
      "cd '" + options_.folder + "' && timeout 120 env " + commandOf(options_, way, checks) + " >out 2>err";
  const int status = std::system(command.c_str());
  Outcome outcome;
  outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128;
  outcome.trace = read(options_.folder + "/out");
  std::istringstream errors(read(options_.folder + "/err"));
  for (std::string line; std::getline(errors, line);) {
    const bool heading = line.find("error") != std::string::npos || line.find("fault[") != std::string::npos;
    if (heading && line.find("warning") == std::string::npos) outcome.errors += line + "\n";
  }
  return outcome;
}

// Programs that rung refuses are differences too: they are valid.
bool Differential::differs(const std::string& text, const Way& way, const char* checks) {
  const Outcome judge = run(text, kJudge, checks);
  return !judge.ran() || !(run(text, way, checks) == judge);
}

std::string textOf(uint64_t first, uint64_t count) {
  std::string text;
  for (uint64_t i = 0; i < count; ++i) {
    text += generate(first + i, static_cast<unsigned>(i), faultsOf(first + i)).print();
  }
  return text;
}

void Differential::report(uint64_t seed, const Way& way, const char* checks) {
  Node program = generate(seed, 0, faultsOf(seed));
  const Outcome judge = run(program.print(), kJudge, checks);
  const Outcome other = judge.ran() ? run(program.print(), way, checks) : judge;
  // What a smaller program must show: the same kind of difference.
  const std::string code = other.errors.substr(0, other.errors.find('\n'));
  const size_t bracket = code.find("error[");
  const std::string error = bracket == std::string::npos ? "" : code.substr(bracket, 12);
  shrink(program, [&] {
    const std::string text = program.print();
    const Outcome left = run(text, kJudge, checks);
    if (!judge.ran()) {
      const bool one = std::count(left.errors.begin(), left.errors.end(), '\n') == 1;
      return left.exit_code == judge.exit_code && left.errors.find(error) != std::string::npos && one;
    }
    if (!left.ran() || left.exit_code != judge.exit_code) return false;
    const Outcome right = run(text, way, checks);
    return right.exit_code == other.exit_code && !(right == left);
  });
  const std::string text = program.print();
  const Outcome left = run(text, kJudge, checks), right = run(text, way, checks);
  std::printf("seed %llu differs: %s\n%s---- judge: exit code %d\n%s%s---- exit code %d\n%s%s\n",
              static_cast<unsigned long long>(seed), commandOf(options_, way, checks).c_str(), text.c_str(),
              left.exit_code, left.errors.c_str(), left.trace.c_str(), right.exit_code, right.errors.c_str(),
              right.trace.c_str());
  std::fflush(stdout);
}

unsigned Differential::compare(uint64_t first, uint64_t count, const Way& way, const char* checks) {
  if (count == 0 || !differs(textOf(first, count), way, checks)) return 0;
  if (count == 1) {
    report(first, way, checks);
    return 1;
  }
  const unsigned found =
      compare(first, count / 2, way, checks) + compare(first + count / 2, count - count / 2, way, checks);
  if (found == 0) {
    std::printf("seeds %llu to %llu differ together only: %s\n", static_cast<unsigned long long>(first),
                static_cast<unsigned long long>(first + count - 1), commandOf(options_, way, checks).c_str());
  }
  return found == 0 ? 1 : found;
}

unsigned Differential::runAll() {
  std::vector<Way> ways;
  if (options_.ways != "native") ways.assign(std::begin(kInterpreted), std::end(kInterpreted));
  if (options_.ways == "native" || options_.ways == "all")
    ways.insert(ways.end(), std::begin(kNative), std::end(kNative));
  unsigned found = 0;
  for (uint64_t seed = options_.first; seed < options_.first + options_.count; seed += kBatch) {
    for (const char* checks : {"default", "none"}) {
      for (const Way& way : ways) {
        found += compare(seed, kBatch - 1, way, checks);
        const uint64_t last = seed + kBatch - 1;
        // Without the check an index beyond the array is undefined.
        if (checks[0] == 'd' || faultsOf(last) != Faults::Index) found += compare(last, 1, way, checks);
      }
    }
  }
  if (options_.ways == "suite") {  // g++ has time for one batch
    for (const Way& way : kQuickNative) found += compare(options_.first, kBatch - 1, way, "default");
  }
  return found;
}

}  // namespace
}  // namespace rung::differential

int main(int argc, char** argv) {
  using namespace rung::differential;
  namespace fs = std::filesystem;
  std::error_code error;
  Options options;
  options.rung = (fs::read_symlink("/proc/self/exe", error).parent_path() / "rung").string();
  options.folder = (fs::temp_directory_path(error) / ("differential." + std::to_string(getpid()))).string();
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i], name = word.substr(0, word.find('=')),
                      value = word.substr(std::min(name.size() + 1, word.size()));
    if (name == "--print") {
      const uint64_t seed = std::strtoull(value.c_str(), nullptr, 10);
      std::fputs(generate(seed, 0, faultsOf(seed)).print().c_str(), stdout);
      return 0;
    }
    if (name == "--first") {
      options.first = std::strtoull(value.c_str(), nullptr, 10) / kBatch * kBatch;
    } else if (name == "--count") {
      options.count = std::strtoull(value.c_str(), nullptr, 10);
    } else if (name == "--ways") {
      options.ways = value;
    } else if (name == "--rung") {
      options.rung = value;
    } else if (name == "--folder") {
      options.folder = value;
    } else {
      std::fprintf(stderr, "differential: there is no option %s\n", word.c_str());
      return 2;
    }
  }
  fs::create_directories(options.folder, error);
  const unsigned found = Differential(options).runAll();
  std::printf("%llu programs, %u differ\n", static_cast<unsigned long long>(options.count), found);
  fs::remove_all(options.folder, error);
  return found == 0 ? 0 : 1;
}
