// SPDX-License-Identifier: Apache-2.0
// What the server learns of messages before their turn.
#include "tools/lsp/inbox.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>

namespace rung::lsp {
namespace {

class InboxTest : public testing::Test {
 protected:
  InboxTest() {
    EXPECT_EQ(pipe(ends), 0);
    inbox = std::make_unique<Inbox>(ends[0]);
  }
  ~InboxTest() override {
    if (ends[1] >= 0) close(ends[1]);
    inbox.reset();
    close(ends[0]);
  }
  void send(const std::string& json) {
    const std::string text = "Content-Length: " + std::to_string(json.size()) + "\r\n\r\n" + json;
    EXPECT_EQ(write(ends[1], text.data(), text.size()), static_cast<ssize_t>(text.size()));
  }
  static bool becomesTrue(const std::atomic<bool>& flag) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (!flag && std::chrono::steady_clock::now() < end) std::this_thread::yield();
    return flag;
  }

  int ends[2];
  std::unique_ptr<Inbox> inbox;
};

TEST_F(InboxTest, MessagesComeInOrderUntilTheEnd) {
  send(R"({"id":1,"method":"a"})");
  send("nonsense");
  send(R"({"id":"rung-1","result":null})");  // an answer, which nothing waits for
  send(R"({"method":"b"})");
  EXPECT_EQ(inbox->next()->message["method"].text(), "a");
  EXPECT_NE(inbox->next()->error, "");
  EXPECT_EQ(inbox->next()->message["method"].text(), "b");
  close(ends[1]);
  ends[1] = -1;
  EXPECT_FALSE(inbox->next());
}

TEST_F(InboxTest, ARequestIsCancelledWhileItRuns) {
  send(R"({"id":1,"method":"a"})");
  ASSERT_TRUE(inbox->next());
  const std::atomic<bool>* cancelled = inbox->beginRequest(1);
  EXPECT_FALSE(*cancelled);
  send(R"({"method":"$/cancelRequest","params":{"id":2}})");
  send(R"({"method":"$/cancelRequest","params":{"id":1}})");
  EXPECT_TRUE(becomesTrue(*cancelled));
  inbox->end();
  EXPECT_TRUE(*inbox->beginRequest(2)) << "cancelled before its turn";
  inbox->end();
  EXPECT_FALSE(*inbox->beginRequest(2)) << "another request of this id";
}

TEST_F(InboxTest, BackgroundWorkEndsWithTheNextMessage) {
  const std::atomic<bool>* interrupted = inbox->beginBackground();
  EXPECT_FALSE(*interrupted);
  send(R"({"method":"a"})");
  EXPECT_TRUE(becomesTrue(*interrupted));
  inbox->end();
  EXPECT_TRUE(*inbox->beginBackground()) << "the message still waits";
}

}  // namespace
}  // namespace rung::lsp
