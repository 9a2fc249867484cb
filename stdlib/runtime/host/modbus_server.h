// SPDX-License-Identifier: Apache-2.0
// The Modbus servers of a run: connections of TCP masters and serial lines, answered from the ServedImage as soon as a
// request is whole. In: descriptors and their events, from the thread of the engine (channels.h). Out: replies. A peer
// that breaks the protocol loses its connection; on a line, what is not a request is dropped when the line is silent.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "served_image.h"

namespace rung::host {

// The frames that arrive on a serial line, and when to look at them: a request is whole when its length and checksum
// say so and the line has been silent for 3.5 characters (MODBUS over Serial Line 1.02, 2.5.1.1).
class RtuLine {
 public:
  void open(const rung_channel_settings& settings);
  // Bytes that arrived.
  void receive(const uint8_t* bytes, size_t count, int64_t now_ns);
  // After a silence: answers a request that is there. Returns the size of the reply.
  uint32_t answer(ServedImage& image, const ServedImage::Server& server, int64_t now_ns, uint8_t* reply);
  // When to call answer(); INT64_MAX: nothing has arrived.
  int64_t dueNs() const;

 private:
  uint8_t bytes_[RUNG_MODBUS_MAX_RTU] = {};
  uint32_t size_ = 0;
  bool is_too_long_ = false;
  int64_t silence_ns_ = 0, last_ns_ = 0;
  bool is_looked_at_ = false;  // since the last byte
};

// The bytes of a TCP master.
class TcpMaster {
 public:
  static constexpr uint32_t kReplyBytes = 4096;
  uint8_t* free() { return in_ + in_size_; }
  uint32_t room() const { return static_cast<uint32_t>(sizeof in_) - in_size_; }
  // `count` bytes were put to free(). Answers what is whole; false: it is not Modbus.
  bool receive(ServedImage& image, const ServedImage::Server& server, uint32_t count);
  // Further requests wait until there is room for their replies.
  bool hasMore() const { return has_more_; }
  const uint8_t* replies() const { return out_; }
  uint32_t replyBytes() const { return out_size_; }
  void sent(uint32_t count);
  void clear() { in_size_ = out_size_ = 0; }

 private:
  uint8_t in_[1024], out_[kReplyBytes];
  uint32_t in_size_ = 0, out_size_ = 0;
  bool has_more_ = false;
};

// The connections of all TCP servers.
class TcpMasters {
 public:
  static constexpr uint32_t kMost = 512;
  // `epoll` reports the events of connection i with the number kEvents | i.
  static constexpr uint64_t kEvents = uint64_t{2} << 32;
  TcpMasters(int epoll, ServedImage& image);
  ~TcpMasters();
  TcpMasters(const TcpMasters&) = delete;
  TcpMasters& operator=(const TcpMasters&) = delete;

  // A client waits at the listening descriptor. When there are too many, the one that is silent longest goes.
  void accept(int listener, const ServedImage::Server& server, int64_t now_ns);
  void onEvent(uint32_t index, int64_t now_ns);
  void closeOf(const ServedImage::Server& server);

 private:
  struct Connection {
    int fd = -1;
    bool waits_to_send = false;
    int64_t last_ns = 0;
    const ServedImage::Server* server = nullptr;
    TcpMaster master;
  };
  Connection* free();
  Connection* closeOldest();
  void close(Connection& connection) const;
  bool receive(Connection& connection);
  bool answer(Connection& connection, uint32_t received);
  bool send(Connection& connection);
  void watch(Connection& connection, bool waits_to_send);

  const int epoll_;
  ServedImage& image_;
  std::vector<std::unique_ptr<Connection>> connections_;  // allocated when they are first needed
};

}  // namespace rung::host
