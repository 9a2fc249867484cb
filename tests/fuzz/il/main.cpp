// SPDX-License-Identifier: Apache-2.0
// ST against IL: generated function blocks in both languages get the same random inputs for many cycles, and their
// traces must be equal.
//   il_differential [--first=SEED] [--count=N] [--cycles=N] [-j N] [--rung=PATH] [--folder=PATH]
//   il_differential --print=SEED
// Blocks go in batches of 25, one program each: its trace has a checksum of all outputs per block and cycle. A batch
// that differs is run block by block, and the seeds that differ are printed. Called by tests/runner with few seeds and
// by hand with many.

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "tests/fuzz/generated/options.h"
#include "tests/fuzz/il/generator.h"
#include "tests/runner/process.h"

namespace rung::il_differential {
namespace {

constexpr uint64_t kBatch = 25;

using generated::Options;

const char* const kDeclarations =
    R"(TYPE Memory : STRUCT flag : BOOL; count : DINT; small : INT; level : REAL; END_STRUCT END_TYPE
TYPE Pattern : UNION r : REAL; w : DWORD; END_UNION END_TYPE
FUNCTION_BLOCK Accumulate
VAR_INPUT step : INT; END_VAR
VAR_OUTPUT sum : DINT; odd : BOOL; END_VAR
sum := sum + step;
odd := sum MOD 2 <> 0;
END_FUNCTION_BLOCK
)";

// Sets the inputs of each block for the cycle and adds its outputs to the checksum.
std::string driver(uint64_t first, uint64_t count) {
  std::string vars = "PROGRAM Main\nVAR\nstate : UDINT := " + std::to_string(first + 1) + "; pattern : Pattern;\n",
              body;
  for (uint64_t k = 0; k < count; ++k) {
    const std::string n = std::to_string(k), b = "b" + n, sum = "sum" + n;
    vars += b + " : B" + n + "; " + sum + " : DWORD;\n";
    body += "state := state * 1664525 + 1013904223;\n" + b +
            "(a := state.31, b := state.30, c := state.29 AND state.28, " +
            "d := state.27, i := UDINT_TO_DINT(state / 65536) - 32768, k := UDINT_TO_INT(state / 8388608),\n" +
            "j := UDINT_TO_DINT(state), x := UDINT_TO_REAL(state / 1048576) / 16.0);\n";
    body += sum + " := ROL(" + sum + ", 5) XOR DINT_TO_DWORD(" + b + ".m) XOR ROL(DINT_TO_DWORD(" + b + ".n), 7);\n";
    body += sum + " := ROL(" + sum + ", 3) XOR INT_TO_DWORD(" + b + ".s) XOR ROL(INT_TO_DWORD(" + b + ".u), 9);\n";
    for (const char* real : {".y", ".z", ".mem.level"}) {
      body += "pattern.r := " + b + real + ";\n";  // the sign of a NaN may differ
      body += "IF pattern.r = pattern.r THEN " + sum + " := ROL(" + sum + ", 1) XOR pattern.w; END_IF\n";
    }
    body +=
        sum + " := ROL(" + sum + ", 1) XOR DINT_TO_DWORD(" + b + ".mem.count) XOR INT_TO_DWORD(" + b + ".mem.small);\n";
    for (const char* flag : {".p", ".q", ".r", ".mem.flag"})
      body += "IF " + b + flag + " THEN " + sum + " := ROL(" + sum + ", 1) + 1; END_IF\n";
  }
  return vars + "END_VAR\n" + body + "END_PROGRAM\n";
}

class Worker {
 public:
  Worker(const Options& options, std::string folder) : options_(options), folder_(std::move(folder)) {
    std::error_code error;
    std::filesystem::create_directories(folder_, error);
  }

  // Returns the number of blocks that differ.
  unsigned compare(uint64_t first, uint64_t count) {
    std::string st = kDeclarations, il = kDeclarations;
    for (uint64_t k = 0; k < count; ++k) {
      const Twins twins = generate(first + k, static_cast<unsigned>(k));
      st += twins.st;
      il += twins.il;
    }
    const std::string rest = driver(first, count);
    const tests::Output a = run(st + rest, count), b = run(il + rest, count);
    if (a.exit_code == 0 && b.exit_code == 0 && a.out == b.out) return 0;
    if (count == 1) {
      const std::string& why = a.exit_code != 0 ? a.err : b.err;
      std::printf("seed %llu differs: exit codes %d and %d\n%s", static_cast<unsigned long long>(first), a.exit_code,
                  b.exit_code, why.substr(0, 3000).c_str());
      return 1;
    }
    unsigned differ = 0;
    for (uint64_t k = 0; k < count; ++k) differ += compare(first + k, 1);
    if (differ == 0) std::printf("seeds from %llu differ together only\n", static_cast<unsigned long long>(first));
    return std::max(differ, 1u);
  }

 private:
  tests::Output run(const std::string& text, uint64_t count) {
    std::ofstream(folder_ + "/twin.st", std::ios::binary) << text;
    std::string watched;
    for (uint64_t k = 0; k < count; ++k) watched += (k > 0 ? ",Main.sum" : "Main.sum") + std::to_string(k);
    tests::Command command;
    command.folder = folder_;
    command.seconds = 600;
    command.arguments = {options_.rung,     "run",       "--cycles=" + std::to_string(options_.cycles),
                         "--engine=interp", "--trace=-", "--watch=" + watched,
                         "twin.st"};
    return tests::run(command);
  }

  const Options& options_;
  std::string folder_;
};

int runAll(const Options& options) {
  const unsigned differ =
      generated::runJobs(options, kBatch, [&](const std::string& folder) { return Worker(options, folder); });
  std::error_code error;
  std::filesystem::remove_all(options.folder, error);
  std::printf("%llu blocks, %u differ\n", static_cast<unsigned long long>(options.count), differ);
  return differ == 0 ? 0 : 1;
}

}  // namespace
}  // namespace rung::il_differential

int main(int argc, char** argv) {
  using namespace rung::il_differential;
  Options options;
  options.cycles = 10000;
  if (!rung::generated::readOptions(argc, argv, "il_differential", "--cycles -j", options)) return 2;
  if (!options.has_print) return runAll(options);
  const Twins twins = generate(options.print, 0);
  std::printf("%s\n%s", twins.st.c_str(), twins.il.c_str());
  return 0;
}
