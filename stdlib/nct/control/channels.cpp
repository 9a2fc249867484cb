// SPDX-License-Identifier: Apache-2.0
// Channels of the simulated control: see channels.h.
#include "channels.h"

namespace rung::nct {
namespace {

constexpr uint32_t kModes = 7;
const Symbol* const kModeRequests[kModes] = {&nc::CP_JOG,  &nc::CP_INCR, &nc::CP_HNDL, &nc::CP_REFP,
                                             &nc::CP_EDIT, &nc::CP_AUTO, &nc::CP_MDI};
const Symbol* const kModeAnswers[kModes] = {&nc::CN_JOG,  &nc::CN_INCR, &nc::CN_HNDL, &nc::CN_REFP,
                                            &nc::CN_EDIT, &nc::CN_AUTO, &nc::CN_MDI};
// Toggles, and the requests that need an interrupted program.
const Symbol* const kToggleRequests[] = {&nc::CP_TEST, &nc::CP_MLCK,  &nc::CP_DRRUN,
                                         &nc::CP_FLCK, &nc::CP_BKRST, &nc::CP_BKRET};
const Symbol* const kMRegisters[kMCodes] = {&nc::CN_M1C, &nc::CN_M2C, &nc::CN_M3C, &nc::CN_M4C,
                                            &nc::CN_M5C, &nc::CN_M6C, &nc::CN_M7C, &nc::CN_M8C};
const Symbol* const kAuxiliaryRegisters[kAuxiliaries] = {&nc::CN_AUX1C, &nc::CN_AUX2C, &nc::CN_AUX3C};

// The strobes are bits of CN_1, in an order that CP_3 has for the acknowledgements, from its own first bit on.
const Symbol* const kStrobes[] = {&nc::CN_M1STB,   &nc::CN_M2STB,   &nc::CN_M3STB,  &nc::CN_M4STB, &nc::CN_M5STB,
                                  &nc::CN_M6STB,   &nc::CN_M7STB,   &nc::CN_M8STB,  &nc::CN_SSTB,  &nc::CN_TSTB,
                                  &nc::CN_AUX1STB, &nc::CN_AUX2STB, &nc::CN_AUX3STB};
const Symbol* const kAcknowledgements[] = {
    &nc::CP_M1ACK, &nc::CP_M2ACK, &nc::CP_M3ACK, &nc::CP_M4ACK,   &nc::CP_M5ACK,   &nc::CP_M6ACK,  &nc::CP_M7ACK,
    &nc::CP_M8ACK, &nc::CP_SACK,  &nc::CP_TACK,  &nc::CP_AUX1ACK, &nc::CP_AUX2ACK, &nc::CP_AUX3ACK};
constexpr uint32_t kFunctions = 13, kS = 8, kT = 9, kFirstAuxiliary = 10;

bool isManual(Mode mode) { return mode != Mode::Automatic && mode != Mode::Mdi; }

}  // namespace

void Channels::beginCycle() {
  for (uint32_t k = 0; k < kChannels; ++k) {
    takeModes(k);
    takeButtons(k);
    execute(k);
    tell(k);
  }
}

void Channels::interrupt(Channel& channel) {
  if (!channel.started && !channel.stopped) return;
  channel.started = channel.stopped = false;
  if (channel.mode == Mode::Automatic) {
    channel.interrupted = channel.executes || !channel.blocks.empty();
  } else {
    channel.executes = false;
    channel.blocks.clear();
  }
}

void Channels::changeMode(uint32_t k, Mode mode) {
  Channel& channel = channels_[k];
  if (mode == channel.mode) return;
  interrupt(channel);
  channel.mode = mode;
}

// Requests act when they rise; of several the first one counts. NCT manual 7.15.1.
void Channels::takeModes(uint32_t k) {
  Channel& channel = channels_[k];
  uint32_t requests = 0;
  for (uint32_t n = 0; n < kModes; ++n) requests |= static_cast<uint32_t>(words_.isSet(*kModeRequests[n], k)) << n;
  for (uint32_t n = 0; n < 6; ++n)
    requests |= static_cast<uint32_t>(words_.isSet(*kToggleRequests[n], k)) << (kModes + n);
  const uint32_t rising = requests & ~channel.requests;
  channel.requests = requests;
  if (words_.isSet(nc::CP_TLCM, k) || words_.isSet(nc::CP_WPCM, k)) {
    changeMode(k, Mode::Jog);
  } else {
    for (uint32_t n = 0; n < kModes; ++n) {
      if ((rising >> n & 1) == 0) continue;
      changeMode(k, static_cast<Mode>(n));
      break;
    }
  }
  const bool runs = channel.started && !isManual(channel.mode);
  bool* const toggles[] = {&channel.is_test, &channel.is_locked, &channel.is_dry, &channel.has_no_functions};
  for (uint32_t n = 0; n < 4; ++n)
    if ((rising >> (kModes + n) & 1) != 0 && !runs) *toggles[n] = !*toggles[n];
  if (channel.interrupted && (rising >> (kModes + 4) & 1) != 0) channel.restarts = true, channel.returns = false;
  if (channel.interrupted && (rising >> (kModes + 5) & 1) != 0) channel.returns = true, channel.restarts = false;
}

void Channels::takeButtons(uint32_t k) {
  Channel& channel = channels_[k];
  const bool start = words_.isSet(nc::CP_START, k), stop = words_.isSet(nc::CP_STOP, k);
  const bool reset = words_.isSet(nc::CP_RST, k) || words_.isSet(nc::CP_RSTREW, k);
  const bool starts = start && !channel.start, stops = stop && !channel.stop, resets = reset && !channel.reset;
  channel.start = start;
  channel.stop = stop;
  channel.reset = reset;
  if (resets) {
    channel.blocks.clear();
    channel.executes = channel.started = channel.stopped = channel.interrupted = false;
    channel.restarts = channel.returns = false;
  }
  if (stops && channel.started) {
    channel.started = false;
    channel.stopped = true;
  }
  const bool executable = channel.executes || !channel.blocks.empty();
  if (starts && executable && channel.mode != Mode::Edit && !stop) {
    // Functions that were not acknowledged are told again, when the program goes on after an interruption.
    if (channel.interrupted && channel.executes) {
      channel.asked &= ~acknowledged(k);
      channel.strobes = true;
    }
    channel.started = true;
    channel.stopped = channel.interrupted = channel.restarts = channel.returns = false;
  }
}

Channels::Functions Channels::acknowledged(uint32_t k) const {
  Functions functions = 0;
  for (uint32_t n = 0; n < kFunctions; ++n)
    functions |= static_cast<uint32_t>(words_.isSet(*kAcknowledgements[n], k)) << n;
  return functions;
}

void Channels::execute(uint32_t k) {
  Channel& channel = channels_[k];
  const bool held = words_.isSet(nc::CP_HOLD, k) || words_.isSet(nc::P_HOLD0);
  channel.counted = channel.finished = false;
  if (channel.strobes && channel.started) {  // again, after an interruption
    for (uint32_t n = 0; n < kFunctions; ++n) words_.set(*kStrobes[n], k, (channel.asked >> n & 1) != 0);
    channel.strobes = false;
    return;
  }
  for (uint32_t n = 0; n < kFunctions; ++n) words_.set(*kStrobes[n], k, false);
  if (!channel.started || held) return;
  if (channel.executes) {
    const bool finished = words_.isSet(nc::CP_FIN, k) && (acknowledged(k) & channel.asked) == channel.asked;
    if (channel.asked != 0 && !finished) return;
    endBlock(k);
    if (!channel.started) return;
  }
  if (channel.blocks.empty())
    channel.started = false;
  else
    beginBlock(k);
}

// The registers have their values before the strobes say so. NCT manual 7.15.2.
void Channels::beginBlock(uint32_t k) {
  Channel& channel = channels_[k];
  channel.block = channel.blocks.front();
  channel.blocks.pop_front();
  channel.executes = true;
  channel.asked = 0;
  if (channel.is_test || channel.is_locked || channel.has_no_functions) return;
  for (uint32_t n = 0; n < kMCodes; ++n) {
    if (channel.block.m[n] < 0) continue;
    words_.put(*kMRegisters[n], k, static_cast<uint32_t>(channel.block.m[n]));
    channel.asked |= 1u << n;
  }
  if (channel.block.s >= 0) {
    tellSpeed(k, channel.block.s);
    channel.asked |= 1u << kS;
  }
  if (channel.block.t >= 0) {
    tellTool(k, channel.block.t);
    channel.asked |= 1u << kT;
  }
  for (uint32_t n = 0; n < kAuxiliaries; ++n) {
    if (channel.block.auxiliary[n] < 0) continue;
    words_.put(*kAuxiliaryRegisters[n], k, static_cast<uint32_t>(channel.block.auxiliary[n]));
    channel.asked |= 1u << (kFirstAuxiliary + n);
  }
  for (uint32_t n = 0; n < kFunctions; ++n) words_.set(*kStrobes[n], k, (channel.asked >> n & 1) != 0);
}

void Channels::endBlock(uint32_t k) {
  Channel& channel = channels_[k];
  channel.executes = false;
  channel.finished = true;
  channel.block_before = channel.block;
  bool stops = words_.isSet(nc::CP_SGLBK, k), ends = false;
  for (const int32_t m : channel.block.m) {
    stops = stops || m == 0 || (m == 1 && words_.isSet(nc::CP_CNDSP, k));
    ends = ends || m == 2 || m == 30;
    if (m >= 0 && m == static_cast<int32_t>(parameters_.word(2305, k)) && m != 0 &&
        ++channel.parts == channel.part_target)
      channel.counted = true;
  }
  if (ends) {
    channel.blocks.clear();
    channel.started = false;
  } else if (stops) {
    channel.started = false;
    channel.stopped = !channel.blocks.empty();
  }
}

// The spindle, and the smallest range with S at most its greatest speed. NCT manual 7.15.2.
void Channels::tellSpeed(uint32_t k, int32_t speed) {
  const uint32_t number = parameters_.word(604, k), spindle = number >= 1 && number <= kSpindles ? number - 1 : 0;
  uint32_t range = 0;
  for (uint32_t n = 0; n < 8 && range == 0; ++n) {
    const double greatest = parameters_.real(650 + n, spindle);
    if (greatest > 0 && speed <= greatest) range = 11 + n;
  }
  words_.put(nc::CN_SC, k, static_cast<uint32_t>(speed));
  words_.put(nc::CN_SSEL, k, spindle + 1);
  words_.put(nc::CN_RNGREQ, k, range);
}

void Channels::tellTool(uint32_t k, int32_t type) {
  const FoundTool tool = find_tool_ == nullptr ? FoundTool{} : find_tool_(find_data_, static_cast<uint32_t>(type));
  words_.put(nc::CN_TC, k, static_cast<uint32_t>(type));
  words_.put(nc::CN_MGZNO, k, tool.magazine);
  words_.put(nc::CN_POTNO, k, tool.pot);
  words_.set(nc::CN_TLLE, k, tool.expired);
}

void Channels::tell(uint32_t k) {
  const Channel& channel = channels_[k];
  for (uint32_t n = 0; n < kModes; ++n) words_.set(*kModeAnswers[n], k, static_cast<uint32_t>(channel.mode) == n);
  words_.set(nc::CN_TEST, k, channel.is_test);
  words_.set(nc::CN_MLCK, k, channel.is_locked);
  words_.set(nc::CN_DRRUN, k, channel.is_dry);
  words_.set(nc::CN_FLCK, k, channel.has_no_functions);
  words_.set(nc::CN_BKRST, k, channel.restarts);
  words_.set(nc::CN_BKRET, k, channel.returns);
  words_.set(nc::CN_START, k, channel.started);
  words_.set(nc::CN_STOP, k, channel.stopped);
  words_.set(nc::CN_INTD, k, channel.interrupted);
  words_.set(nc::CN_BKBUF, k, channel.executes || !channel.blocks.empty());
  words_.set(nc::CN_IPEPTY, k, !channel.executes);
  words_.set(nc::CN_IPSTP, k, !channel.started || words_.real(nc::CP_FOVER, k) == 0);
  words_.set(nc::CN_WPCNT, k, channel.counted);
  words_.set(nc::CN_AHND, k, words_.isSet(nc::CP_AHND, k) && !isManual(channel.mode));
  const bool manual = isManual(channel.mode);
  words_.set(nc::CN_TAXF, k, manual && words_.isSet(nc::CP_TAXF, k));
  words_.set(nc::CN_TRGAF, k, manual && words_.isSet(nc::CP_TRGAF, k));
  words_.set(nc::CN_TTCRF, k, manual && words_.isSet(nc::CP_TTCRF, k));
  words_.set(nc::CN_TBLB, k, manual && words_.isSet(nc::CP_TBLB, k));
  words_.set(nc::CN_WMCAXF, k, words_.isSet(nc::CP_WMCAXF, k));
  words_.set(nc::CN_ABSOFF, k, words_.isSet(nc::CP_ABSOFF, k));
  words_.set(nc::CN_CSACK, k, words_.isSet(nc::CP_CSREQ, k));
  words_.set(nc::CN_RTRFIN, k, words_.isSet(nc::CP_EGBRRQ, k));
  // #1100 to #1135 belong to the part program, which the test sets.
}

}  // namespace rung::nct
