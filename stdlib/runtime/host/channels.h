// SPDX-License-Identifier: Apache-2.0
// Channels of a program (rung_channels) on sockets and serial lines of this machine. Functions of the program only copy
// bytes and leave wishes; one engine, an epoll loop, opens, sends, receives and answers Modbus masters. It has a thread
// of its own in real time; in virtual time the host polls it between the rows. In: devices of the serial ports
// (--serial). Out: the table for the host. Buffers are allocated by the engine when a channel opens, never in a cycle.
#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "byte_ring.h"
#include "modbus_server.h"
#include "priority_mutex.h"
#include "served_image.h"

namespace rung::host {

using SerialDevices = std::map<uint32_t, std::string>;  // by the number of the port

class Channels {
 public:
  Channels(const SerialDevices& devices, ServedImage& image);
  ~Channels();
  Channels(const Channels&) = delete;
  Channels& operator=(const Channels&) = delete;

  // Adds the table to a host.
  void serve(rung_host& host);
  // A channel is open: virtual time keeps pace with the clock.
  bool isUsed() const { return used_.load() > 0 || is_woken_.load(); }
  void start();
  void stop();
  // Without a thread: does what is to do until this time of the monotonic clock.
  void runUntil(int64_t monotonic_ns);

  // The functions of rung_channels; from any thread.
  int64_t open(const rung_channel_settings& settings);
  int64_t status(int64_t channel, rung_channel_status& status);
  int64_t read(int64_t channel, void* bytes, uint64_t count, rung_endpoint* from);
  int64_t write(int64_t channel, const void* bytes, uint64_t count, const rung_endpoint* to);
  int64_t close(int64_t channel);
  // The program begins again.
  void closeAll();

 private:
  static constexpr uint32_t kMost = 1024;
  static constexpr uint32_t kMostServers = 16;  // that answer Modbus masters

  enum class State : uint8_t {
    Free,
    Asked,    // by the program
    Opening,  // a connection is on its way, or a server waits for its client
    Open,
    Ended,   // `error` says why; what was received can still be read
    Closing  // by the program
  };
  struct Channel {
    // Guarded by mutex_.
    State state = State::Free;
    int32_t error = 0;
    uint32_t generation = 0;
    bool is_queued = false;
    bool is_full = false;      // what arrives waits in the system until there is room
    bool is_finished = false;  // the peer sends no more, but may still receive
    uint32_t in_driver = 0;
    rung_channel_settings settings{};
    char address[48] = {};
    ByteRing received, unsent;
    uint32_t served = 0;  // of Modbus servers: 1 + index in servers_
    // Of the engine.
    int fd = -1;
    uint32_t events = 0;
    RtuLine line;
  };

  Channel* find(int64_t handle);
  int64_t handleOf(const Channel& channel) const;
  static bool isDatagram(const Channel& channel);
  static bool isServer(const Channel& channel);
  int64_t refuse(const rung_channel_settings& settings) const;
  void enqueue(Channel& channel);
  void wake();

  void work(int64_t until_ns);
  void takeWishes();
  void serveWish(Channel& channel);
  void openChannel(Channel& channel);
  int openDescriptor(const rung_channel_settings& settings, bool& is_open, int32_t& error);
  int openSender(uint32_t address, uint16_t port, int32_t& error);
  void finishOpening(Channel& channel, int fd, bool is_open, int32_t error);
  void release(Channel& channel);
  void end(Channel& channel, int32_t error);
  void watch(Channel& channel, uint32_t events);
  bool waitsFor(const Channel& channel, int64_t server);
  void watchServer(int64_t server);
  void acceptClients(Channel& server);
  void onEvent(Channel& channel, uint32_t events);
  void receive(Channel& channel);
  void receiveRequests(Channel& channel);
  void send(Channel& channel);
  bool sendOne(Channel& channel);
  int64_t runTimers();

  const SerialDevices devices_;
  ServedImage& image_;
  int epoll_ = -1, wake_ = -1;
  PriorityMutex mutex_;  // guards the channels; held for copies of bytes only
  std::unique_ptr<Channel[]> channels_;
  std::vector<uint32_t> queue_, taken_;  // channels with wishes; capacity kMost
  std::atomic<uint32_t> used_{0};
  std::atomic<bool> is_woken_{false}, ends_{false};
  std::unique_ptr<ServedImage::Server[]> servers_;
  bool is_served_[kMostServers] = {};
  std::unique_ptr<TcpMasters> masters_;
  std::unique_ptr<uint8_t[]> buffer_;  // of the engine
  bool waits_for_image_ = false;
  std::thread thread_;
};

}  // namespace rung::host
