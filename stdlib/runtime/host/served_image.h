// SPDX-License-Identifier: Apache-2.0
// Modbus masters see this of the process image: a copy that is exchanged with the image at the borders of activations,
// so that a master never sees, or changes, the values of a cycle that runs. In: the areas at a border, requests of
// masters from another thread. Out: replies; what masters wrote enters the image at the next border. Addresses that the
// program does not have keep what masters wrote (AX manual, tables 3-1 and 3-3: the areas have a fixed size).
#pragma once

#include <atomic>
#include <vector>

#include "loaded_module.h"
#include "priority_mutex.h"
#include "rung/modbus.h"
#include "state_archive.h"

namespace rung::host {

class ServedImage {
 public:
  explicit ServedImage(const LoadedModule& module);
  ServedImage(const ServedImage&) = delete;
  ServedImage& operator=(const ServedImage&) = delete;

  // Another version of the program.
  void attach(const LoadedModule& module) { module_.store(&module); }
  // A server exists; before, exchange() does nothing.
  void use() { is_used_.store(true); }
  // The copy has values of the program.
  bool isReady() const { return is_ready_.load(); }
  // At a border of an activation; the caller holds the lock of the image. `force` is called between what masters wrote
  // and what they will see, and may be null.
  void exchange(uint8_t* const* areas, void (*force)(void* data) = nullptr, void* data = nullptr);
  // Forgets everything: a test begins.
  void reset();

  // What a server has of the image; nothing while there is none.
  void transfer(StateArchive& archive);

  // A server of this image: its number on the line, and registers that stand for its first holding registers.
  struct Server {
    uint8_t unit = 0;
    uint32_t register_count = 0;
    uint8_t registers[RUNG_MODBUS_OUTPUT_BYTES] = {};
  };
  void setRegisters(Server& server, const void* values, uint32_t bytes);
  // Of a whole frame; 0: no reply.
  uint32_t answerTcp(const Server& server, const uint8_t* frame, uint8_t* reply);
  uint32_t answerRtu(const Server& server, const uint8_t* frame, uint32_t size, uint8_t* reply);

 private:
  struct Part {
    uint32_t area;
    std::vector<uint8_t> bytes, written;
  };
  rung_modbus_image imageOf(const Server& server);
  void applyWritten(Part& part, uint8_t* common, uint32_t size) const;

  std::atomic<const LoadedModule*> module_;
  std::atomic<bool> is_used_{false}, is_ready_{false};
  PriorityMutex mutex_;  // guards all below
  bool has_written_ = false;
  Part inputs_, outputs_, memory_;
};

}  // namespace rung::host
