// SPDX-License-Identifier: Apache-2.0
// The channels of the simulated control: modes, start and stop, and the functions of blocks, which a strobe of one
// cycle tells the program and which it acknowledges. A part program is a queue of blocks with functions only. NCT
// manual 7.15.
#pragma once

#include <array>
#include <deque>

#include "parameters.h"
#include "words.h"

namespace rung::nct {

class Axes;

// In the order of their requests and answers. NCT manual 7.15.1.
enum class Mode : uint8_t { Jog, Increments, Handwheel, Reference, Edit, Automatic, Mdi };

// A channel asks this of the tools. NCT manual 6.26.1.
struct FoundTool {
  uint32_t magazine = 0, pot = 0;  // 0: not found
  bool expired = false;            // the group has only expired tools
};

// The functions of a block; -1: not programmed.
constexpr uint32_t kMCodes = 8, kAuxiliaries = 3;
struct PartBlock {
  int32_t m[kMCodes] = {-1, -1, -1, -1, -1, -1, -1, -1};
  int32_t s = -1, t = -1;
  int32_t auxiliary[kAuxiliaries] = {-1, -1, -1};
};

class Channels {
 public:
  Channels(Words& words, const Parameters& parameters) : words_(words), parameters_(parameters) {}

  // Where a T code finds its tool.
  using FindTool = FoundTool (*)(void* data, uint32_t type);
  void findToolsBy(FindTool find, void* data) {
    find_tool_ = find;
    find_data_ = data;
  }

  // A cycle of Main begins.
  void beginCycle();
  void append(uint32_t channel, const PartBlock& block) { channels_[channel].blocks.push_back(block); }
  void setPartTarget(uint32_t channel, uint32_t parts) { channels_[channel].part_target = parts; }

  Mode mode(uint32_t channel) const { return channels_[channel].mode; }
  bool runs(uint32_t channel) const { return channels_[channel].started; }
  bool isStopped(uint32_t channel) const { return channels_[channel].stopped; }
  bool hasBlocks(uint32_t channel) const { return channels_[channel].executes || !channels_[channel].blocks.empty(); }
  uint32_t blockCount(uint32_t channel) const { return static_cast<uint32_t>(channels_[channel].blocks.size()); }
  // In this cycle: a block with this M code.
  bool hasFinished(uint32_t channel, int32_t m) const {
    const Channel& it = channels_[channel];
    if (!it.finished) return false;
    for (const int32_t code : it.block_before.m)
      if (code == m) return true;
    return false;
  }
  bool isInterrupted(uint32_t channel) const { return channels_[channel].interrupted; }

  template <class Archive>
  void transfer(Archive& archive) {
    for (Channel& it : channels_) {
      archive.sequence(it.blocks, PartBlock{}, [&](PartBlock& block) { archive.value(block); });
      archive.values(it.mode, it.block, it.asked, it.executes, it.started, it.stopped, it.interrupted, it.strobes);
      archive.values(it.is_test, it.is_locked, it.is_dry, it.has_no_functions, it.restarts, it.returns, it.requests);
      archive.values(it.start, it.stop, it.reset, it.parts, it.part_target, it.counted, it.finished, it.block_before);
    }
  }

 private:
  // Functions by the bits of their strobes in CN_1 and of their acknowledgements in CP_3.
  using Functions = uint32_t;
  struct Channel {
    Mode mode = Mode::Jog;
    std::deque<PartBlock> blocks;
    PartBlock block;      // that is executed
    Functions asked = 0;  // functions of the block
    bool executes = false, started = false, stopped = false, interrupted = false, strobes = false;
    bool is_test = false, is_locked = false, is_dry = false, has_no_functions = false;
    bool restarts = false, returns = false;
    uint32_t requests = 0;                            // of modes and toggles, in the cycle before
    bool start = false, stop = false, reset = false;  // buttons, in the cycle before
    uint32_t parts = 0, part_target = 0;
    bool counted = false, finished = false;  // in this cycle
    PartBlock block_before;
  };

  void takeModes(uint32_t channel);
  void takeButtons(uint32_t channel);
  void changeMode(uint32_t channel, Mode mode);
  void interrupt(Channel& channel);
  void execute(uint32_t channel);
  void beginBlock(uint32_t channel);
  void endBlock(uint32_t channel);
  void tellSpeed(uint32_t channel, int32_t speed);
  void tellTool(uint32_t channel, int32_t type);
  Functions acknowledged(uint32_t channel) const;
  void tell(uint32_t channel);

  Words& words_;
  const Parameters& parameters_;
  std::array<Channel, kChannels> channels_;
  FindTool find_tool_ = nullptr;
  void* find_data_ = nullptr;
};

}  // namespace rung::nct
