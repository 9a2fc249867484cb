// SPDX-License-Identifier: Apache-2.0
// Random typing in a project: the snapshots must say what a check of the same texts says, and what they cost is
// measured.
//   snapshot_edits DIR [COUNT [SEED [COMPARED]]]      COUNT edits; every COMPARED-th snapshot is compared, 0: none
#include <sys/resource.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>

#include "tests/unit/workspace/typing.h"

namespace {

using rung::workspace::Snapshot;
using rung::workspace::Typing;
using rung::workspace::Workspace;

double cpuMs() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) * 1e3 + static_cast<double>(t.tv_nsec) * 1e-6;
}

size_t residentMiB() {
  std::ifstream status("/proc/self/statm");
  size_t pages = 0, resident = 0;
  status >> pages >> resident;
  return resident * 4096 >> 20;
}

struct Costs {
  std::vector<double> ms;
  void print(const char* what) {
    if (ms.empty()) return;
    std::sort(ms.begin(), ms.end());
    printf("%-9s %6zu snapshots, CPU ms: median %.1f, 99th percentile %.1f, most %.1f\n", what, ms.size(),
           ms[ms.size() / 2], ms[ms.size() * 99 / 100], ms.back());
  }
};

rung::driver::ProjectOptions optionsOf(const std::string& folder) {
  rung::driver::ProjectOptions options;
  options.inputs = {folder};
  options.report.max_errors = 100'000;
  return options;
}

// The messages of a check of these texts from nothing.
std::string coldMessages(const std::string& folder, const Typing& typing) {
  Workspace cold(optionsOf(folder));
  std::vector<rung::workspace::Change> changes;
  for (const auto& [path, text] : typing.texts()) changes.push_back({path, text});
  return messagesOf(*cold.apply(changes));
}

// The first line in which two texts differ, from both.
void printDifference(const std::string& have, const std::string& want) {
  const auto differ = std::mismatch(have.begin(), have.end(), want.begin(), want.end());
  const size_t at = have.rfind('\n', static_cast<size_t>(differ.first - have.begin()));
  const size_t begin = at == std::string::npos ? 0 : at + 1;
  const auto line = [&](const std::string& text) { return text.substr(begin, text.find('\n', begin) - begin); };
  printf("  snapshot: %s\n  check:    %s\n", line(have).c_str(), begin < want.size() ? line(want).c_str() : "");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  const std::string folder = argv[1];
  const int count = argc > 2 ? atoi(argv[2]) : 1000;
  const auto seed = static_cast<uint32_t>(argc > 3 ? atoi(argv[3]) : 1);
  const int compared = argc > 4 ? atoi(argv[4]) : 100;
  Typing typing(folder, seed);
  Workspace workspace(optionsOf(folder));
  const double begin = cpuMs();
  uint64_t revision = workspace.apply({})->revision();
  printf("start %.1f ms of CPU, %zu MiB\n", cpuMs() - begin, residentMiB());
  Costs in_place, whole;
  int differ = 0;
  for (int i = 1; i <= count; ++i) {
    const rung::workspace::Change change = typing.next();
    const double before = cpuMs();
    const auto snapshot = workspace.apply({change});
    const double ms = cpuMs() - before;
    (snapshot->revision() == revision ? in_place : whole).ms.push_back(ms);
    revision = snapshot->revision();
    if (compared == 0 || i % compared != 0) continue;
    const std::string have = messagesOf(*snapshot), want = coldMessages(folder, typing);
    if (have == want) continue;
    printf("edit %d of %s: the snapshot differs from a check\n", i, change.path.c_str());
    if (differ++ < 10) printDifference(have, want);
  }
  in_place.print("bodies");
  whole.print("whole");
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  printf("%d edits, %d differ, %zu MiB now, %ld MiB at most\n", count, differ, residentMiB(), usage.ru_maxrss >> 10);
  return differ == 0 ? 0 : 1;
}
