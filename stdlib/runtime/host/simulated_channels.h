// SPDX-License-Identifier: Apache-2.0
// Channels in tests: a network and serial lines inside the test, in virtual time. A test holds the other end of a
// serial line (RUNG_CHANNEL_SERIAL_PEER), and of TCP and UDP ports by ordinary channels at any address: a client finds
// the server with its address and port. In: the time of the context. Out: the table for the host. Nothing outside is
// opened, so a test runs alike everywhere. Called by session.cpp.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "modbus_server.h"
#include "served_image.h"
#include "state_archive.h"

namespace rung::host {

class SimulatedChannels {
 public:
  SimulatedChannels(const rung_context& context, ServedImage& image) : context_(context), image_(image) {}

  // Adds the table to a host.
  void serve(rung_host& host);
  // Closes everything: a test begins.
  void reset() { channels_.clear(); }
  // All channels, with the bytes on their way.
  void transfer(StateArchive& archive);
  // Between two activations: Modbus servers answer.
  void answerMasters();

  // The functions of rung_channels.
  int64_t open(const rung_channel_settings& settings);
  int64_t status(int64_t channel, rung_channel_status& status);
  int64_t read(int64_t channel, void* bytes, uint64_t count, rung_endpoint* from);
  int64_t write(int64_t channel, const void* bytes, uint64_t count, const rung_endpoint* to);
  int64_t close(int64_t channel);

 private:
  // Bytes on their way: of a stream what was written at once, or a datagram.
  struct Chunk {
    int64_t arrives_ns;
    std::string bytes;
    rung_endpoint from;
  };
  struct Channel {
    rung_channel_settings settings{};
    uint32_t address = 0;
    bool is_closed = false;  // by the program
    bool is_open = false;
    int32_t error = 0;
    int64_t decided_ns = 0;       // TCP client: when the answer of its server arrives
    int64_t peer = 0;             // of a connection: the handle of its other end
    int64_t peer_closed_ns = -1;  // when the end of the peer arrives
    int64_t line_free_ns = 0;     // serial line: when all that was written has left
    std::deque<Chunk> arriving;
    std::deque<int64_t> waiting;        // TCP server: ends of connections that wait to be accepted
    ServedImage::Server server;         // Modbus servers
    std::unique_ptr<TcpMaster> master;  // one end of a connection to one of them
    int64_t master_of = 0;
    RtuLine line;
  };
  static void transferChannel(Channel& channel, StateArchive& archive);
  Channel* find(int64_t handle);
  int64_t add(const rung_channel_settings& settings);
  void settle();
  void connect(Channel& client, int64_t handle);
  void accept(Channel& channel);
  Channel* otherEnd(const Channel& channel);
  Channel* lineEnd(uint16_t port, bool is_peer);
  bool isHost(uint32_t address) const;
  static uint32_t takeStream(Channel& channel, void* bytes, uint64_t count, int64_t now_ns);
  uint32_t arrived(const Channel& channel) const;
  int64_t send(Channel& channel, const void* bytes, uint64_t count, const rung_endpoint* to);
  int64_t sendOnLine(Channel& channel, const std::string& bytes);
  void answerLine(Channel& channel);
  void answerConnection(Channel& channel);

  const rung_context& context_;
  ServedImage& image_;
  std::deque<Channel> channels_;  // by handle - 1; a closed one stays
};

}  // namespace rung::host
