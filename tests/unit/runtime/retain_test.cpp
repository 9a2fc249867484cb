// Retained data: start kinds, torn files, another layout.
#include "stdlib/runtime/host/retain.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <sstream>

#include "sample_module.h"

using namespace rung::host;

namespace {

struct State {
  Memory memory;
  Symbols symbols;
  Retain retain;
  State(const rung_module& module, const std::string& path)
      : memory(module), symbols(module, memory), retain(module, memory, path) {
    memory.reset();
  }
  sample::Main& main() { return *reinterpret_cast<sample::Main*>(memory.block(0)); }
};

std::string freshPath() {
  const std::string path = testing::TempDir() + "rung_retain";
  remove(path.c_str());
  return path;
}

void save(const std::string& path, int kept) {
  std::string error;
  State state(sample::module(), path);
  EXPECT_TRUE(state.retain.restore(RUNG_WARM, state.symbols, error));
  state.main().kept = kept;
  state.main().kept_always = kept * 10;
  EXPECT_TRUE(state.retain.save(state.symbols, error)) << error;
}

std::pair<int, int> load(const std::string& path, rung_start start, const rung_module& module = sample::module()) {
  std::string error;
  State state(module, path);
  EXPECT_TRUE(state.retain.restore(start, state.symbols, error)) << error;
  return {state.main().kept, state.main().kept_always};
}

TEST(RetainFile, StartKinds) {
  const std::string path = freshPath();
  EXPECT_EQ(load(path, RUNG_WARM), std::make_pair(5, 50));  // no file: initial values
  save(path, 7);
  EXPECT_EQ(load(path, RUNG_WARM), std::make_pair(7, 70));
  EXPECT_EQ(load(path, RUNG_COLD), std::make_pair(5, 70));
  EXPECT_EQ(load(path, RUNG_ORIGIN), std::make_pair(5, 50));
  save(path, 8);
  save(path, 9);
  EXPECT_EQ(load(path, RUNG_WARM), std::make_pair(9, 90));
}

TEST(RetainFile, AnotherLayoutKeepsWhatHasTheSameName) {
  const std::string path = freshPath();
  save(path, 7);
  EXPECT_EQ(load(path, RUNG_WARM, sample::changedModule()), std::make_pair(7, 70));
  EXPECT_EQ(load(path, RUNG_COLD, sample::changedModule()), std::make_pair(5, 70));
}

// Cuts the write of the newer state at every 64th byte: always the old state, or the new one when it is complete.
TEST(RetainFile, ATornWriteLeavesTheOldState) {
  const std::string path = freshPath();
  const auto content = [&] {
    std::ostringstream all;
    all << std::ifstream(path, std::ios::binary).rdbuf();
    return all.str();
  };
  save(path, 1);
  save(path, 2);
  const std::string before = content();
  save(path, 3);
  const std::string after = content();
  ASSERT_EQ(before.size(), after.size());
  for (size_t cut = 0; cut <= after.size(); cut += 64) {
    for (const bool forward : {true, false}) {
      const std::string torn =
          forward ? after.substr(0, cut) + before.substr(cut) : before.substr(0, cut) + after.substr(cut);
      std::ofstream(path, std::ios::binary | std::ios::trunc) << torn;
      const int kept = load(path, RUNG_WARM).first;
      EXPECT_TRUE(kept == 2 || kept == 3) << cut;
    }
  }
  std::ofstream(path, std::ios::binary | std::ios::trunc) << "garbage";
  EXPECT_EQ(load(path, RUNG_WARM), std::make_pair(5, 50));
}

TEST(RetainFile, Crc32) { EXPECT_EQ(crc32("123456789", 9), 0xCBF43926u); }

}  // namespace
