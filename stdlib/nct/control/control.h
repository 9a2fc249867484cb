// SPDX-License-Identifier: Apache-2.0
// A simulated numerical control: what `rung run` and `rung test` give an NCT program instead of a machine. In: the
// calls of rung/nc.h, and set-ups by NCT_SIMULATE. Out: inputs of the program, results of its instructions. Used by the
// bundled host. docs/nct.md.
#pragma once

#include <deque>
#include <functional>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "axes.h"
#include "channels.h"
#include "mailbox.h"
#include "messages.h"
#include "network.h"
#include "pallets.h"
#include "parameters.h"
#include "rung/nc.h"
#include "simulation.h"
#include "spindles.h"
#include "tools.h"
#include "words.h"

namespace rung::nct {

class Control {
 public:
  Control();
  Control(const Control&) = delete;
  Control& operator=(const Control&) = delete;

  // Lets a host's program use this control.
  void serve(rung_host& host);
  // Called with each message that appears.
  std::function<void(const Message&)> on_message;

  // Saves or restores everything but its connections to the network; in the host of one program.
  template <class Archive>
  void transfer(Archive& archive) {
    const std::lock_guard<std::mutex> lock(mutex_);
    words_.transfer(archive);
    parameters_.transfer(archive);
    channels_.transfer(archive);
    spindles_.transfer(archive);
    axes_.transfer(archive);
    tools_.transfer(archive);
    pallets_.transfer(archive);
    mailbox_.transfer(archive);
    messages_.transfer(archive);
    transferOwn(archive);
  }

 private:
  static const rung_nc kFunctions;

  void exchange(uint32_t* slice, uint32_t* nonvolatile, bool is_cycle, int64_t now_ns);
  void begin();
  void tellCommon();
  void tellConstants();
  void tellDrives();
  void takeHandwheels();
  void tellInputs();

  // ---- services
  struct Request {
    uint32_t number;
    bool is_write;
    int32_t function;
    uint32_t address;
    Block block;
    uint64_t due;  // the cycle in which it is served
    Code code = kBusy;
  };
  bool poll(uint32_t number, uint32_t* memory);
  Code serve(Request& request, uint32_t* memory);
  Code serveRead(Request& request, uint32_t* memory);
  Code serveWrite(Request& request, const uint32_t* memory);
  Code readNonvolatile(const Block& block, uint32_t* memory) const;
  Code writeNonvolatile(const Block& block, const uint32_t* memory);
  Code assignProgram(Block& block);
  Code assignPalletProgram(const Block& block);
  Code openWindow(const Block& block);
  Code dumpDrive(const Block& block);

  bool readScope(uint32_t item, int32_t first, int32_t second, double& value) const;
  double* macro(int32_t channel, int32_t number);

  // ---- what a test sets up: simulation.cpp
  // False: refused.
  bool simulate(int32_t what, const Settings& settings, double& result);
  Simulation simulateControl(int32_t what, const Settings& settings, double& result);
  Simulation simulateMachine(int32_t what, const Settings& settings, double& result);
  Simulation simulateChannel(int32_t what, const Settings& settings, double& result);
  Simulation simulateTools(int32_t what, const Settings& settings, double& result);
  Simulation simulateDevices(int32_t what, const Settings& settings, double& result);
  uint32_t text(int32_t place, int32_t row, char* to) const;

  template <class Archive>
  void transferOwn(Archive& archive) {
    archive.values(clock_.has_begun, clock_.last_ns, clock_.last_cycle_ns, clock_.cycles, nonvolatile_, last_request_,
                   latency_, assigned_);
    archive.values(display_ready_, window_, drives_.values, drives_.errors, drives_.enabled, drives_.machine_on);
    archive.values(drives_.is_forbidden, handwheels_, inputs_, has_slices_);
    const Request blank{0, false, 0, 0, Block({}), 0};
    archive.sequence(requests_, blank, [&](Request& it) {
      archive.values(it.number, it.is_write, it.function, it.address, it.due, it.code);
      it.block.transfer(archive);
    });
    archive.list(macros_);
    archive.set(programs_);
    archive.sequence(titles_, {}, [&](std::pair<uint32_t, std::string>& title) {
      archive.value(title.first);
      archive.text(title.second);
    });
  }

  mutable std::mutex mutex_;  // tasks may be threads
  Words words_;
  Parameters parameters_;
  Channels channels_;
  Spindles spindles_;
  Axes axes_;
  Tools tools_;
  Pallets pallets_;
  Mailbox mailbox_;
  Network network_;
  Messages messages_;

  struct Clock {
    bool has_begun = false;
    int64_t last_ns = 0, last_cycle_ns = 0;  // of exchange() and of a cycle
    uint64_t cycles = 0;
  };
  Clock clock_;
  uint32_t* nonvolatile_ = nullptr;

  std::deque<Request> requests_;
  uint32_t last_request_ = 0;
  uint32_t latency_ = 2;  // cycles

  std::vector<double> macros_;
  std::set<uint32_t> programs_;
  uint32_t assigned_[kChannels] = {};
  bool display_ready_ = true;
  uint32_t window_ = 0;
  // What a test sets up of the drives and the machine.
  struct Drives {
    double values[kDrives][6] = {};
    uint32_t errors[kDrives] = {};
    Answer enabled[kDrives];
    Answer machine_on;
    bool is_forbidden = false;
  };
  Drives drives_;
  int32_t handwheels_[4] = {};
  uint8_t inputs_[64] = {};  // of interface cards
  bool has_slices_ = false;
  std::vector<std::pair<uint32_t, std::string>> titles_;
};

}  // namespace rung::nct
