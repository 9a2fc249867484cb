// SPDX-License-Identifier: Apache-2.0
#include "tools/protocol/framing.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <random>
#include <thread>

namespace rung::protocol {
namespace {

struct Pipe {
  Pipe() { EXPECT_EQ(pipe(ends), 0); }
  ~Pipe() {
    close(ends[0]);
    if (ends[1] >= 0) close(ends[1]);
  }
  void finish() {
    close(ends[1]);
    ends[1] = -1;
  }
  int ends[2];
};

// What a reader makes of some bytes: messages, `broken`, one a line.
std::string resultsOf(const std::string& bytes) {
  Pipe stream, stop;
  std::thread writer([&] {
    for (size_t at = 0; at < bytes.size();) {
      const ssize_t count = write(stream.ends[1], bytes.data() + at, bytes.size() - at);
      if (count <= 0) break;
      at += static_cast<size_t>(count);
    }
    stream.finish();
  });
  MessageReader reader(stream.ends[0], stop.ends[0]);
  std::string out;
  for (;;) {
    const MessageReader::Result result = reader.next();
    if (result.kind == MessageReader::Kind::End) break;
    out += result.kind == MessageReader::Kind::Message ? result.text + "\n" : "broken\n";
  }
  writer.join();
  return out;
}

TEST(Framing, MessagesFollowEachOther) {
  EXPECT_EQ(resultsOf("Content-Length: 2\r\n\r\n{}Content-Length: 3\r\n\r\n[1]"), "{}\n[1]\n");
  EXPECT_EQ(resultsOf("Content-Type: x\r\ncontent-length:  1 \r\n\r\n7\r\n\r\nContent-Length: 0\n\n"), "7\n\n");
}

TEST(Framing, ABrokenHeaderIsSkipped) {
  EXPECT_EQ(resultsOf("nonsense\r\n\r\nContent-Length: 1\r\n\r\n7"), "broken\n7\n");
  EXPECT_EQ(resultsOf("Content-Length: many\r\n\r\nContent-Length: 1\r\n\r\n7"), "broken\n7\n");
  EXPECT_EQ(resultsOf(std::string(5'000'000, 'x') + "\r\n\r\nContent-Length: 1\r\n\r\n7"), "broken\n7\n");
  std::string many;
  for (int i = 0; i < 5000; ++i) many += "Name: value\r\n";
  EXPECT_EQ(resultsOf(many + "\r\nContent-Length: 1\r\n\r\n7"), "broken\n7\n");
}

TEST(Framing, AMessageThatIsTooLongIsSkipped) {
  const std::string length = std::to_string(kMaxMessageBytes + 1);
  EXPECT_EQ(resultsOf("Content-Length: " + length + "\r\n\r\n" + std::string(kMaxMessageBytes + 1, ' ') +
                      "Content-Length: 1\r\n\r\n7"),
            "broken\n7\n");
}

TEST(Framing, TheEndInsideOfAMessageEnds) {
  EXPECT_EQ(resultsOf("Content-Length: 20\r\n\r\n{}"), "");
  EXPECT_EQ(resultsOf("Content-Len"), "");
  EXPECT_EQ(resultsOf(""), "");
}

TEST(Framing, RandomBytesEnd) {
  std::mt19937 random(7);
  for (int round = 0; round < 300; ++round) {
    std::string bytes = "Content-Length: 12\r\n\r\n{\"method\":1}Content-Length: 2\r\n\r\n{}";
    for (uint32_t i = 1 + random() % 5; i > 0; --i) bytes[random() % bytes.size()] = static_cast<char>(random());
    resultsOf(bytes);
  }
}

TEST(Framing, AWaitingReaderIsStopped) {
  Pipe stream, stop;
  MessageReader reader(stream.ends[0], stop.ends[0]);
  std::thread stopper([&] { stop.finish(); });
  EXPECT_EQ(reader.next().kind, MessageReader::Kind::End);
  stopper.join();
}

TEST(Framing, WritingToAClosedStreamFails) {
  signal(SIGPIPE, SIG_IGN);
  Pipe stream;
  EXPECT_TRUE(writeMessage(stream.ends[1], "{}"));
  close(stream.ends[0]);
  EXPECT_FALSE(writeMessage(stream.ends[1], "{}"));
  stream.ends[0] = -1;
}

}  // namespace
}  // namespace rung::protocol
