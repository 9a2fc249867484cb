// SPDX-License-Identifier: Apache-2.0
// The network connection of the simulated control: one socket, which never makes a cycle wait. In: blocks of services.
// Out: codes of execution, packets, errors by their Windows numbers. Used by control.cpp and services.cpp. NCT
// manual 6.22.
#pragma once

#include <vector>

#include "block.h"

namespace rung::nct {

class Network {
 public:
  Network() = default;
  Network(const Network&) = delete;
  Network& operator=(const Network&) = delete;
  ~Network() { close(); }

  // A cycle of Main: takes a client, sends what is left.
  void beginCycle();
  // `request` tells requests apart, `waited` counts cycles.
  Code open(Block& block, uint32_t request, uint64_t waited);  // MW60
  Code close(const Block& block);                              // MW61
  Code receive(Block& block, uint32_t* memory);                // MR62
  Code send(Block& block, const uint32_t* memory);             // MW63

 private:
  enum class Protocol : uint32_t { Udp = 1, Server, Client };
  enum class Connecting : uint8_t { No, Yes };

  bool isOpen() const { return socket_ >= 0 && connecting_request_ == 0; }
  // The socket of packets; -1: no client is there.
  int stream() const { return protocol_ == Protocol::Server ? client_ : socket_; }
  int start(Connecting& connecting);
  Code check(const Block& block, uint32_t first_address) const;
  void acceptClient();
  int sendRest();
  void lose();
  void close();

  Protocol protocol_ = Protocol::Udp;
  uint32_t ip_ = 0, port_ = 0;
  int socket_ = -1, client_ = -1;
  uint32_t connecting_request_ = 0;  // 0: not under way
  std::vector<uint8_t> rest_;        // of a packet, not sent yet
};

}  // namespace rung::nct
