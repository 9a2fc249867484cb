// SPDX-License-Identifier: Apache-2.0
// The devices of a product (rung_driver), and the simulated modules of rung.project that no driver serves: their inputs
// enter the image before an activation of the task that they belong to, their outputs leave after it. In: drivers. Out:
// true, or which one failed. Called by tasks.cpp.
#pragma once

#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "modules/simulated.h"
#include "symbols.h"

namespace rung::host {

class Drivers {
 public:
  // The program whose image they exchange; before all else, and again for another version of it.
  void attach(const LoadedModule& module, Memory& memory) {
    module_ = &module;
    memory_ = &memory;
  }

  // Loads a shared library with the function `const rung_driver* rung_drivers(const char* argument, uint32_t* count)`,
  // that of drives, or that of a control. `spec`: PATH or PATH=ARGUMENT. False: `error` has the message.
  bool load(const std::string& spec, std::string& error);
  // Drives of axes that a library serves, by its function `const rung_drives* rung_axis_drives(const char* argument,
  // void** data)`, and a numerical control, by `const rung_nc* rung_numerical_control(const char* argument, void**
  // data)`.
  void serve(rung_host& host) const;
  // Simulates the project's modules, but those for which there is a driver of their name. Their terminals become
  // variables, `ad.V0`.
  void simulateModules(Symbols& symbols, Hsio& hsio, rung_diagnosis& diagnosis);
  // The same variables for another version of the program.
  void addTerminals(Symbols& symbols) const;
  // Checks areas and the names of tasks. `fastest`: the task of drivers that name none; RUNG_NONE: the first one.
  bool bind(uint32_t fastest, std::string& error);

  // The devices of a task; the caller holds the lock of the image. Empty, or the name of the driver that failed.
  std::string read(uint32_t task, int64_t now_ns) const;
  std::string write(uint32_t task, int64_t now_ns) const;
  // All inputs, before the first activation: tasks other than those of the devices see them too.
  std::string readAll(int64_t now_ns) const;
  // All outputs, after a stop, and that it is one. A driver that fails is not asked again; the others are.
  void writeAll(int64_t now_ns) const;
  // Of the simulated modules.
  void transfer(StateArchive& archive) {
    for (const std::unique_ptr<SimulatedModule>& module : modules_) module->transfer(archive);
  }
  // `di, ad`; empty: none.
  std::string simulatedNames() const;

 private:
  struct Bound {
    const rung_driver* driver;
    uint32_t task;
  };
  const LoadedModule* module_ = nullptr;
  Memory* memory_ = nullptr;
  std::vector<Bound> drivers_;
  const rung_drives* drives_ = nullptr;
  void* drives_data_ = nullptr;
  const rung_nc* control_ = nullptr;
  void* control_data_ = nullptr;
  std::vector<std::unique_ptr<SimulatedModule>> modules_;
  std::deque<rung_driver> of_modules_;
  std::deque<std::string> names_;  // of them and their tasks: the module may be replaced
};

}  // namespace rung::host
