// SPDX-License-Identifier: Apache-2.0
// The cache of compiled C++: entries, limits, abandoned folders, concurrent writers.
#include "tools/driver/cache.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <thread>
#include <vector>

#include "tests/unit/tools/temporary_folder.h"

namespace rung::driver {
namespace {

std::string hashOf(const std::vector<std::string>& parts) {
  Hash hash;
  for (const std::string& part : parts) hash.add(part);
  return hash.hex();
}

void age(const std::string& path, time_t seconds) {
  timespec times[2];
  clock_gettime(CLOCK_REALTIME, &times[0]);
  times[0].tv_sec -= seconds;
  times[1] = times[0];
  utimensat(AT_FDCWD, path.c_str(), times, 0);
}

class CacheTest : public testing::Test {
 protected:
  CacheTest() { setenv("RUNG_CACHE_DIR", (folder.path() + "/cache").c_str(), 1); }
  ~CacheTest() override { unsetenv("RUNG_CACHE_DIR"); }
  std::string fill(Cache& cache, const std::string& key, size_t bytes) {
    std::string work = cache.workFolder();
    FILE* file = fopen((work + "/x").c_str(), "wb");
    std::string text(bytes, 'x');
    fwrite(text.data(), 1, text.size(), file);
    fclose(file);
    std::string entry = cache.path(key, "o");
    EXPECT_TRUE(cache.put(work + "/x", entry));
    cache.drop(work);
    return entry;
  }
  TemporaryFolder folder;
};

TEST(Hash, SeparatesPartsAndContents) {
  EXPECT_NE(hashOf({"a", "bc"}), hashOf({"ab", "c"}));
  EXPECT_NE(hashOf({""}), hashOf({}));
  EXPECT_NE(hashOf({std::string(16, 'a')}), hashOf({std::string(17, 'a')}));
  EXPECT_NE(hashOf({std::string("a\0", 2)}), hashOf({"a"}));
  EXPECT_EQ(hashOf({"same"}), hashOf({"same"}));
  EXPECT_EQ(hashOf({"same"}).size(), 32u);
}

TEST_F(CacheTest, EntriesAppearAndStay) {
  std::string entry;
  {
    Cache cache;
    EXPECT_FALSE(cache.has(cache.path("0123456789", "o")));
    entry = fill(cache, "0123456789", 10);
    EXPECT_TRUE(cache.has(entry));
  }
  Cache again;
  EXPECT_TRUE(again.has(entry));
}

TEST_F(CacheTest, WorkFoldersOfTwoRunsDiffer) {
  Cache a, b;
  EXPECT_NE(a.workFolder(), b.workFolder());
}

TEST_F(CacheTest, TrimTakesTheLongestUnused) {
  Cache cache;
  std::string oldest = fill(cache, "aaaaaaaa", 100'000), older = fill(cache, "bbbbbbbb", 100'000),
              young = fill(cache, "cccccccc", 100'000);
  age(oldest, 5000);
  age(older, 4000);
  cache.trim(250'000);
  EXPECT_FALSE(cache.has(oldest));
  EXPECT_EQ(access(older.c_str(), F_OK), 0);
  cache.trim(0);  // entries used in the last minutes may be in use
  EXPECT_NE(access(older.c_str(), F_OK), 0);
  EXPECT_EQ(access(young.c_str(), F_OK), 0);
}

TEST_F(CacheTest, AbandonedWorkFoldersGo) {
  Cache cache;
  std::string work = cache.workFolder();
  age(work, 3 * 24 * 3600);
  cache.trim(1 << 20);
  EXPECT_NE(access(work.c_str(), F_OK), 0);
}

TEST_F(CacheTest, FallsBackToATemporaryFolder) {
  folder.write("cache", "a file where the folder should be");
  std::string used;
  {
    Cache cache;
    used = cache.folder();
    EXPECT_FALSE(used.empty());
    EXPECT_NE(used, folder.path() + "/cache");
    EXPECT_TRUE(cache.has(fill(cache, "0123456789", 10)));
  }
  EXPECT_NE(access(used.c_str(), F_OK), 0);
}

TEST_F(CacheTest, ManyWritersOneEntry) {
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; i++)
    threads.emplace_back([this] {
      for (int k = 0; k < 20; k++) {
        Cache cache;
        std::string entry = fill(cache, "sharedkey", 4096);
        struct stat info;
        ASSERT_EQ(stat(entry.c_str(), &info), 0);
        ASSERT_EQ(info.st_size, 4096);  // never a part of it
      }
    });
  for (std::thread& thread : threads) thread.join();
}

TEST(CacheLimit, FromTheEnvironment) {
  unsetenv("RUNG_CACHE_SIZE");
  EXPECT_EQ(Cache::limitBytes(), uint64_t{1} << 30);
  setenv("RUNG_CACHE_SIZE", "10", 1);
  EXPECT_EQ(Cache::limitBytes(), uint64_t{10} << 20);
  setenv("RUNG_CACHE_SIZE", "lots", 1);
  EXPECT_EQ(Cache::limitBytes(), uint64_t{1} << 30);
  unsetenv("RUNG_CACHE_SIZE");
}

}  // namespace
}  // namespace rung::driver
