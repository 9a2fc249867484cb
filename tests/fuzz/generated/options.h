// The command line that the tools of generated programs share: differential, il_differential, sfc_differential,
// network_differential. In: the words. Out: Options, with rung beside the tool and a folder of its own where none is
// given.
#pragma once

#include <cstdint>
#include <string>

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

// `taken`: the names that this tool has beside --first, --count, --rung, --folder and --print. False: an unknown word,
// told on stderr.
bool readOptions(int argc, char** argv, const char* tool, const char* taken, Options& options);

// splitmix64: the same numbers with every C++ library.
inline uint64_t nextRandom(uint64_t& state) {
  uint64_t z = (state += 0x9E3779B97F4A7C15u);
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
  return z ^ (z >> 31);
}

}  // namespace rung::generated
