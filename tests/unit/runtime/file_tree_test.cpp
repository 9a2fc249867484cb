// SPDX-License-Identifier: Apache-2.0
// Copies of files and folders by the host: a copy that fails leaves nothing.
#include "stdlib/runtime/host/file_tree.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>

using namespace rung::host;

namespace {

// Files of this process may have so many bytes while it lives; more cannot be written.
class SizeLimit {
 public:
  explicit SizeLimit(rlim_t bytes) : handler_(signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit now{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &now);
  }
  ~SizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    signal(SIGXFSZ, handler_);
  }

 private:
  sighandler_t handler_;
  rlimit before_{};
};

std::string freshFolder() {
  const std::string root = testing::TempDir() + "rung_file_tree" + std::to_string(getpid());
  mkdir(root.c_str(), 0777);
  removeTree(root, "target");
  mkdir((root + "/target").c_str(), 0777);
  return root;
}

TEST(FileTree, ACopyThatCannotBeWrittenIsRemoved) {
  const std::string root = freshFolder();
  std::ofstream(root + "/long.txt") << std::string(50'000, 'x');
  {
    const SizeLimit limit(20'000);
    EXPECT_EQ(copyTree(root, "long.txt", "target", false, 0), RUNG_FILE_FAILED);
  }
  EXPECT_NE(access((root + "/target/long.txt").c_str(), F_OK), 0);
  EXPECT_EQ(copyTree(root, "long.txt", "target", false, 0), 0);
  EXPECT_EQ(access((root + "/target/long.txt").c_str(), F_OK), 0);
  removeTree(root, "long.txt");
  removeTree(root, "target");
  rmdir(root.c_str());
}

}  // namespace
