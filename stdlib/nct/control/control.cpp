// SPDX-License-Identifier: Apache-2.0
// The simulated control: see control.h.
#include "control.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace rung::nct {
namespace {

constexpr int32_t kFirstMacro = 100, kLastMacro = 999;

}  // namespace

Control::Control()
    : channels_(words_, parameters_),
      spindles_(words_, parameters_),
      axes_(words_, parameters_, channels_, spindles_),
      tools_(words_, parameters_, channels_, spindles_),
      pallets_(parameters_),
      macros_(static_cast<size_t>(kLastMacro - kFirstMacro + 1) * kChannels) {
  channels_.findToolsBy([](void* data, uint32_t type) { return static_cast<Tools*>(data)->find(type); }, &tools_);
}

#define CONTROL                                    \
  Control& control = *static_cast<Control*>(data); \
  const std::lock_guard<std::mutex> lock(control.mutex_)

const rung_nc Control::kFunctions = {
    // exchange
    [](void* data, uint32_t* slice, uint32_t* nonvolatile, bool is_cycle, int64_t now_ns) {
      CONTROL;
      control.exchange(slice, nonvolatile, is_cycle, now_ns);
    },
    // title
    [](void* data, uint32_t button, const char* text) {
      CONTROL;
      control.titles_.emplace_back(button, text);
    },
    // message
    [](void* data, const rung_nc_message* message, bool is_new) {
      CONTROL;
      if (is_new && control.on_message) control.on_message({message->code, message->text});
      return control.messages_.send(*message, is_new);
    },
    // withdraw
    [](void* data, const rung_nc_message* message) {
      CONTROL;
      control.messages_.withdraw(*message);
    },
    // move
    [](void* data, int32_t axis, int32_t code, double speed, double distance) {
      CONTROL;
      return control.axes_.command(axis, code, speed, distance);
    },
    // read_macro
    [](void* data, int32_t channel, int32_t number, double* value) -> int32_t {
      CONTROL;
      const double* const at = control.macro(channel, number);
      if (at == nullptr) return RUNG_NC_REFUSED;
      *value = *at;
      return RUNG_NC_DONE;
    },
    // write_macro
    [](void* data, int32_t channel, int32_t number, double value) -> int32_t {
      CONTROL;
      double* const at = control.macro(channel, number);
      if (at == nullptr) return RUNG_NC_REFUSED;
      *at = value;
      return RUNG_NC_DONE;
    },
    // scope
    [](void* data, int32_t scope, int32_t first, int32_t second, double* value) -> int32_t {
      CONTROL;
      return control.readScope(static_cast<uint32_t>(scope), first, second, *value) ? RUNG_NC_DONE : RUNG_NC_REFUSED;
    },
    // submit
    [](void* data, const rung_nc_request* request) -> uint32_t {
      CONTROL;
      control.requests_.push_back({++control.last_request_, request->is_write != 0, request->function, request->address,
                                   Block({request->block, request->block + request->count}),
                                   control.clock_.cycles + control.latency_});
      return control.last_request_;
    },
    // poll
    [](void* data, uint32_t number, uint32_t* memory) {
      CONTROL;
      return control.poll(number, memory);
    },
    // cancel
    [](void* data, uint32_t number) {
      CONTROL;
      auto& requests = control.requests_;
      requests.erase(std::remove_if(requests.begin(), requests.end(),
                                    [&](const Request& request) { return request.number == number; }),
                     requests.end());
    },
    // simulate
    [](void* data, int32_t what, const double* values, uint32_t, double* result) -> int32_t {
      CONTROL;
      return control.simulate(what, Settings(values), *result) ? RUNG_NC_DONE : RUNG_NC_REFUSED;
    },
    // text
    [](void* data, int32_t place, int32_t row, char* text) -> uint32_t {
      CONTROL;
      return control.text(place, row, text);
    },
};
#undef CONTROL

void Control::serve(rung_host& host) {
  host.nc = &kFunctions;
  host.nc_data = this;
}

// ---- what goes to the program and comes from it

void Control::exchange(uint32_t* slice, uint32_t* nonvolatile, bool is_cycle, int64_t now_ns) {
  words_.beginExchange(slice);
  nonvolatile_ = nonvolatile;
  if (!clock_.has_begun) begin();
  has_slices_ = has_slices_ || !is_cycle;
  const double seconds = static_cast<double>(now_ns - clock_.last_ns) / 1e9;
  clock_.last_ns = now_ns;
  if (!is_cycle || !has_slices_) takeHandwheels();
  tellInputs();
  if (is_cycle) {
    ++clock_.cycles;
    channels_.beginCycle();
    network_.beginCycle();
  }
  spindles_.move(seconds);
  axes_.move(seconds);
  if (!is_cycle) return;
  tools_.beginCycle(static_cast<double>(now_ns - clock_.last_cycle_ns) / 1e9);
  clock_.last_cycle_ns = now_ns;
  spindles_.answer();
  axes_.answer();
  tellCommon();
  tellConstants();
  tellDrives();
}

uint32_t checksumOf(const uint32_t* words) {
  uint32_t sum = 0;
  for (uint32_t k = 0; k < RUNG_NC_NONVOLATILE_WORDS; ++k) sum = (sum << 5 | sum >> 27) + words[k] * (2 * k + 1);
  return sum;
}

void Control::begin() {
  clock_.has_begun = true;
  words_.set(nc::N_NVRAMOK, 0, checksumOf(nonvolatile_) == nonvolatile_[RUNG_NC_NONVOLATILE_WORDS]);
  words_.set(nc::N_NCREADY, 0, true);
  words_.set(nc::N_SIMU, 0, true);
  // Probes are active at 0.
  for (const Symbol& probe :
       {nc::TN_TS1, nc::TN_TS2, nc::TN_TS3, nc::TN_TS4, nc::TN_TS5, nc::TN_TS6, nc::TN_TS7, nc::TN_TS8})
    words_.set(probe, 0, true);
}

// NCT manual 7.12.
void Control::tellCommon() {
  const std::vector<Message>& screen = messages_.screen();
  words_.set(nc::N_MONDIS, 0, drives_.is_forbidden);
  const bool forbidden = drives_.is_forbidden;
  if (forbidden) drives_.machine_on = {};
  drives_.machine_on.follow(words_.isSet(nc::P_MONREQ), !forbidden);
  words_.set(nc::N_MONST, 0, drives_.machine_on.is());
  words_.set(nc::N_CLRMSG, 0, messages_.takeCleared());
  words_.set(nc::N_PTEDT, 0, pallets_.isEdited());
  words_.set(nc::N_MSGA, 0, !screen.empty());
  words_.set(nc::N_MSG0, 0, !screen.empty());  // all are of the PLC
  words_.put(nc::N_ACTMSG, 0, screen.empty() ? 0 : screen.front().code);
}

// NCT manual 7.11.
void Control::tellConstants() {
  for (uint32_t k = 0; k < 8; ++k) words_.put(nc::N_P00, k, parameters_.word(1201 + k));
  for (uint32_t k = 0; k < 32; ++k) {
    words_.put(nc::N_PDW1, k, parameters_.word(1209 + k));
    words_.putReal(nc::N_PDB1, k, parameters_.real(1241 + k));
  }
}

// NCT manual 7.7.
void Control::tellDrives() {
  for (uint32_t k = 0; k < kDrives; ++k) {
    if (words_.isSet(nc::DP_ERRCLR, k)) drives_.errors[k] = 0;
    const bool ready = drives_.errors[k] == 0;
    if (!ready) drives_.enabled[k] = {};
    drives_.enabled[k].follow(words_.isSet(nc::DP_ENA2, k) && !words_.isSet(nc::DP_ENA1, k), ready);
    words_.set(nc::DN_RDY, k, ready);
    words_.set(nc::DN_ENA, k, drives_.enabled[k].is());
    words_.set(nc::DN_PRM1, k, words_.isSet(nc::DP_PRM1, k));
    words_.set(nc::DN_PRM2, k, words_.isSet(nc::DP_PRM2, k));
    words_.put(nc::DN_ERR, k, drives_.errors[k] | (ready ? 0u : 1u));
  }
}

void Control::takeHandwheels() {
  for (uint32_t k = 0; k < 4; ++k) {
    words_.put(nc::HWMOVE, k, static_cast<uint32_t>(handwheels_[k]));
    axes_.turnHandwheel(k, handwheels_[k]);
    handwheels_[k] = 0;
  }
}

// Byte addresses 1 to 64 are the words INP000 to INP071. NCT manual 7.3.
void Control::tellInputs() {
  for (uint32_t k = 0; k < 16; ++k) {
    uint32_t word = 0;
    for (uint32_t byte = 0; byte < 4; ++byte) word |= uint32_t{inputs_[4 * k + byte]} << 8 * byte;
    words_.put(nc::INP000, k, word);
  }
}

double* Control::macro(int32_t channel, int32_t number) {
  if (channel < 0 || channel >= static_cast<int32_t>(kChannels) || number < kFirstMacro || number > kLastMacro)
    return nullptr;
  return &macros_[static_cast<size_t>(channel) * (kLastMacro - kFirstMacro + 1) +
                  static_cast<size_t>(number - kFirstMacro)];
}

// NCT manual 6.17.
bool Control::readScope(uint32_t item, int32_t first, int32_t second, double& value) const {
  value = 0;
  if (first < 0 || second < 0) return false;
  const auto unit = static_cast<uint32_t>(first);
  if (item >= scope::ComPosAx && item <= scope::EGBvTarAx) return axes_.read(item, unit, value);
  if (item >= scope::ComPosSp && item <= scope::TachRealSp) return spindles_.read(item, unit, value);
  if (item == scope::CNCBufferCount) {
    if (unit < 1 || unit > kChannels) return false;
    value = channels_.blockCount(unit - 1);
    return true;
  }
  if (item == scope::NCTDriveMess) {
    if (unit < 1 || unit > kDrives || second > 5) return false;
    value = drives_.values[unit - 1][second];
    return true;
  }
  return item >= scope::Measured && item <= scope::TSliceErr;  // times of a control that needs none
}

// ---- what a test asks for

uint32_t Control::text(int32_t place, int32_t row, char* to) const {
  to[0] = '\0';
  const auto give = [&](uint32_t code, const std::string& text) {
    std::snprintf(to, 256, "%s", text.c_str());
    return code;
  };
  const auto at = static_cast<size_t>(row);
  if (row < 0) return 0;
  if (place == 2) return at < titles_.size() ? give(titles_[at].first, titles_[at].second) : 0;
  if (place != 0 && place != 1) return 0;
  const std::vector<Message>& messages = place == 0 ? messages_.screen() : messages_.log();
  return at < messages.size() ? give(messages[at].code, messages[at].text) : 0;
}

}  // namespace rung::nct
