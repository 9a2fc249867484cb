// SPDX-License-Identifier: Apache-2.0
// EtherCAT mailboxes of simulated devices. In: blocks of services, devices and objects that a test sets up. Out: codes
// of execution, data. Used by control.cpp and services.cpp. NCT manual 6.28.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include "block.h"

namespace rung::nct {

class Mailbox {
 public:
  // `waited`: cycles.
  Code read(Block& block, uint32_t* memory, uint64_t waited) const;   // MR201
  Code write(Block& block, const uint32_t* memory, uint64_t waited);  // MW202

  // A test sets these up; false: there is no such device, or protocol.
  bool setDevice(uint32_t index, uint32_t protocol, bool exists);
  bool setError(uint32_t index, uint32_t error, bool times_out);
  bool setObject(uint32_t index, uint32_t protocol, uint32_t object, uint64_t value, uint32_t bytes, uint32_t element);

  template <class Archive>
  void transfer(Archive& archive) {
    archive.map(devices_, [&](Device& device) {
      archive.set(device.protocols);
      archive.map(device.objects, [&](Bytes& bytes) { archive.list(bytes); });
      archive.values(device.error, device.times_out);
    });
  }

 private:
  using Bytes = std::vector<uint8_t>;
  struct Device {
    std::set<uint32_t> protocols;
    // By protocol, element of SoE, and object: the index or IDN with the subindex or drive above it.
    std::map<uint64_t, Bytes> objects;
    uint32_t error = 0;
    bool times_out = false;
  };

  static uint64_t keyOf(uint32_t protocol, uint32_t object, uint32_t element);
  Code check(const Block& block, uint32_t first_address) const;
  static uint32_t select(const Block& block, Device& device, std::vector<Bytes*>& selected);

  mutable std::map<uint32_t, Device> devices_;
};

}  // namespace rung::nct
