// SPDX-License-Identifier: Apache-2.0
// Retained data: start kinds, torn files, another layout.
#include "stdlib/runtime/host/retain.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <sstream>

#include "rung/retain.h"
#include "sample_module.h"

using namespace rung::host;

namespace {

struct State {
  LoadedModule loaded;
  Memory memory;
  Symbols symbols;
  Retain retain;
  State(const rung_module& module, const std::string& path)
      : loaded(module), memory(loaded), symbols(loaded, memory), retain(symbols, memory, path) {
    memory.reset();
  }
  sample::Main& main() { return *reinterpret_cast<sample::Main*>(memory.block(0)); }
};

std::string freshPath() {
  const std::string path = testing::TempDir() + "rung_retain" + std::to_string(getpid());
  remove(path.c_str());
  return path;
}

std::string contentOf(const std::string& path) {
  std::ostringstream all;
  all << std::ifstream(path, std::ios::binary).rdbuf();
  return all.str();
}
void write(const std::string& path, const std::string& content) {
  std::ofstream(path, std::ios::binary | std::ios::trunc) << content;
}

void save(const std::string& path, int kept, const rung_module& module = sample::module()) {
  std::string error;
  State state(module, path);
  EXPECT_TRUE(state.retain.open(error)) << error;
  state.retain.restore(RUNG_WARM);
  state.main().kept = kept;
  state.main().kept_always = kept * 10;
  state.retain.copy(1'000'000 * kept);
  EXPECT_TRUE(state.retain.save(error)) << error;
}

struct Loaded {
  std::pair<int, int> values;
  int64_t time_ns;
  std::vector<std::string> changes;
};
Loaded loadAll(const std::string& path, rung_start start, const rung_module& module = sample::module()) {
  std::string error;
  State state(module, path);
  EXPECT_TRUE(state.retain.open(error)) << error;
  state.retain.restore(start);
  return {{state.main().kept, state.main().kept_always}, state.memory.context().now_ns, state.retain.changes()};
}
std::pair<int, int> load(const std::string& path, rung_start start, const rung_module& module = sample::module()) {
  return loadAll(path, start, module).values;
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

// Timers go on where they were: the time of the program is part of the state.
TEST(RetainFile, TimeGoesOn) {
  const std::string path = freshPath();
  save(path, 7);
  EXPECT_EQ(loadAll(path, RUNG_WARM).time_ns, 7'000'000);
  EXPECT_EQ(loadAll(path, RUNG_ORIGIN).time_ns, 0);
}

// Cuts the write of the newer state at every byte of it, from either end: always the old state, or the new one when it
// is complete. `then` may need larger slots than the file has.
void cutEverywhere(const rung_module& then) {
  const std::string path = freshPath();
  save(path, 1);
  save(path, 2);
  const std::string before = contentOf(path);
  save(path, 3, then);
  const std::string after = contentOf(path);
  ASSERT_GE(after.size(), before.size());
  const std::string old = before + std::string(after.size() - before.size(), 0);
  for (size_t cut = 0; cut <= after.size(); ++cut) {
    if (cut > 0 && old[cut - 1] == after[cut - 1]) continue;  // the same file as one byte before
    for (const bool forward : {true, false}) {
      write(path, forward ? after.substr(0, cut) + old.substr(cut) : old.substr(0, cut) + after.substr(cut));
      const std::pair<int, int> values = load(path, RUNG_WARM, then);
      EXPECT_TRUE(values == std::make_pair(2, 20) || values == std::make_pair(3, 30)) << cut;
    }
  }
}
TEST(RetainFile, ATornWriteLeavesTheOldState) {
  cutEverywhere(sample::module());
  cutEverywhere(sample::changedModule());
}

// A file that is cut off or has other bytes: a state that was complete, or initial values and a message.
TEST(RetainFile, DamagedFiles) {
  const std::string path = freshPath();
  save(path, 1);
  save(path, 2);
  const std::string whole = contentOf(path);
  for (size_t size = 1; size < whole.size(); size += 97) {
    write(path, whole.substr(0, size));
    const Loaded loaded = loadAll(path, RUNG_WARM);
    const bool is_state = loaded.values == std::make_pair(1, 10) || loaded.values == std::make_pair(2, 20);
    EXPECT_TRUE(is_state || loaded.values == std::make_pair(5, 50)) << size;
    EXPECT_EQ(loaded.changes.size(), !is_state && size >= 4096 + 64 ? 1u : loaded.changes.size()) << size;
  }
  std::string changed = whole;
  for (size_t at = 4096; at < changed.size(); at += 16) changed[at] = static_cast<char>(changed[at] ^ 0x41);
  write(path, changed);
  const Loaded loaded = loadAll(path, RUNG_WARM);
  EXPECT_EQ(loaded.values, std::make_pair(5, 50));
  ASSERT_EQ(loaded.changes.size(), 1u);
  EXPECT_NE(loaded.changes[0].find("damaged"), std::string::npos);
}

TEST(RetainFile, AForeignFileStaysAsItIs) {
  const std::string path = freshPath();
  for (const std::string& content : {std::string("garbage"), std::string(100'000, 'x'), std::string("Rung is")}) {
    write(path, content);
    State state(sample::module(), path);
    std::string error;
    EXPECT_FALSE(state.retain.open(error));
    EXPECT_NE(error.find("it is not a file of retained data"), std::string::npos) << error;
    EXPECT_EQ(contentOf(path), content);
  }
  State state(sample::module(), testing::TempDir());
  std::string error;
  EXPECT_FALSE(state.retain.open(error));
}

TEST(RetainFile, TwoProgramsDoNotShareIt) {
  const std::string path = freshPath();
  State one(sample::module(), path), other(sample::module(), path);
  std::string error;
  EXPECT_TRUE(one.retain.open(error)) << error;
  EXPECT_FALSE(other.retain.open(error));
  EXPECT_NE(error.find("another program uses it"), std::string::npos) << error;
}

TEST(RetainFile, Crc32) { EXPECT_EQ(rung_crc32("123456789", 9, 0), 0xCBF43926u); }

}  // namespace
