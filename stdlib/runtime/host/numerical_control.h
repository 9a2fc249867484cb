// SPDX-License-Identifier: Apache-2.0
// The numerical control of an NCT program: the one that a library of --driver brings, or a simulated one. In: a module.
// Out: rung_host.nc. docs/nct.md.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "loaded_module.h"
#include "rung/nc.h"
#include "state_archive.h"

namespace rung::nct {
class Control;
}

namespace rung::host {

// Tells whether the module has the memories of an NCT program.
bool isNct(const LoadedModule& module);

class NumericalControl {
 public:
  NumericalControl();
  ~NumericalControl();
  // A control as it is when it is switched on. Does nothing for other programs, and where the host has a control.
  // `on_message` gets `00002000 door open` when a message of the program appears.
  void serve(const LoadedModule& module, rung_host& host, std::function<void(const std::string&)> on_message);
  // Of the simulated one, if there is one.
  void transfer(StateArchive& archive);

 private:
  std::unique_ptr<nct::Control> simulated_;
};

}  // namespace rung::host
