// SPDX-License-Identifier: Apache-2.0
// The command line shared by the tools for generated programs: differential, il_differential, sfc_differential,
// network_differential. In: the arguments. Out: Options; by default rung is beside the tool, and a temporary folder is
// made.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstdio>
#include <string>
#include <thread>
#include <vector>

namespace rung::generated {

struct Options {
  uint64_t first = 0, count = 200, cycles = 0;     // --first --count --cycles
  unsigned jobs = 1;                               // -j
  std::string rung, folder;                        // --rung --folder
  std::string ways = "interp", engine = "interp";  // --ways --engine
  bool keeps_folder = false;                       // --folder was given
  bool has_print = false;                          // --print=SEED: the program alone
  uint64_t print = 0;
};

// `taken`: the options that this tool has besides --first, --count, --rung, --folder and --print. False: an unknown
// option, reported on stderr.
bool readOptions(int argc, char** argv, const char* tool, const char* taken, Options& options);

// Distributes all seeds in batches to `options.jobs` workers, each made by `makeWorker(folder)`, whose
// compare(first, count) returns how many differ. Returns the sum.
template <class MakeWorker>
unsigned runJobs(const Options& options, uint64_t batch, MakeWorker makeWorker) {
  std::atomic<uint64_t> next{options.first};
  std::atomic<unsigned> differ{0};
  const uint64_t end = options.first + options.count;
  const auto work = [&](unsigned job) {
    auto worker = makeWorker(options.folder + "/" + std::to_string(job));
    for (uint64_t first = next.fetch_add(batch); first < end; first = next.fetch_add(batch)) {
      differ += worker.compare(first, std::min(batch, end - first));
      std::fflush(stdout);
    }
  };
  std::vector<std::thread> threads;
  for (unsigned k = 0; k < options.jobs; ++k) threads.emplace_back(work, k);
  for (std::thread& thread : threads) thread.join();
  return differ.load();
}

// splitmix64: the same numbers with every C++ library.
inline uint64_t nextRandom(uint64_t& state) {
  uint64_t z = (state += 0x9E3779B97F4A7C15u);
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
  return z ^ (z >> 31);
}

}  // namespace rung::generated
