// SPDX-License-Identifier: Apache-2.0
// The numerical control of an NCT program: see numerical_control.h.
#include "numerical_control.h"

#include <algorithm>
#include <cstdio>
#include <string_view>

#include "control/control.h"

namespace rung::host {

bool isNct(const LoadedModule& module) {
  const auto has = [&](std::string_view name) {
    return std::any_of(module.areas.begin(), module.areas.end(),
                       [&](const rung_area& area) { return module.strings + area.name == name; });
  };
  return has("N") && has("T");
}

NumericalControl::NumericalControl() = default;
NumericalControl::~NumericalControl() = default;

void NumericalControl::serve(const LoadedModule& module, rung_host& host,
                             std::function<void(const std::string&)> on_message) {
  if (!isNct(module)) return;
  const bool is_simulated = simulated_ != nullptr && host.nc_data == simulated_.get();
  if (host.nc != nullptr && !is_simulated) return;  // a product's, whose data may be null
  simulated_ = std::make_unique<nct::Control>();
  if (on_message)
    simulated_->on_message = [on_message](const nct::Message& message) {
      char code[16];
      std::snprintf(code, sizeof code, "%08u ", message.code);
      on_message(code + message.text);
    };
  simulated_->serve(host);
}

void NumericalControl::transfer(StateArchive& archive) {
  if (simulated_ != nullptr) simulated_->transfer(archive);
}

}  // namespace rung::host
