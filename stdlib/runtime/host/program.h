// SPDX-License-Identifier: Apache-2.0
// A module with its memory, tasks and schedule: what an online change replaces, while devices, files and connections
// stay. In: a module, and the version before it. Out: a program that can run. A part of a session.
#pragma once

#include <memory>
#include <vector>

#include "drivers.h"
#include "forces.h"
#include "hsio.h"
#include "loaded_module.h"
#include "memory.h"
#include "schedule.h"
#include "symbols.h"
#include "tasks.h"

namespace rung::host {

struct Program {
  struct Around {
    Drivers& drivers;
    Hsio& hsio;
    int64_t interval_ns;  // of cyclic tasks without one
    bool others_go_on;    // a fault stops its task alone
  };
  Program(const rung_module& from, const Around& around)
      : module(from),
        memory(module),
        symbols(module, memory),
        forces(symbols),
        tasks(symbols, memory, around.drivers, forces, around.interval_ns),
        schedule(tasks, memory.context(), around.hsio, around.others_go_on) {}
  // `kept`: see Memory. `keeper` holds what the module is part of.
  Program(const rung_module& from, std::shared_ptr<const void> keeper_of_module, const Around& around,
          const Program& before, const std::vector<uint32_t>& kept)
      : keeper(std::move(keeper_of_module)),
        module(from),
        memory(module, before.memory, kept),
        symbols(module, memory),
        forces(symbols),
        tasks(symbols, memory, around.drivers, forces, around.interval_ns),
        schedule(tasks, memory.context(), around.hsio, around.others_go_on) {}
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  std::shared_ptr<const void> keeper;  // null: the caller of the session
  const LoadedModule module;
  Memory memory;
  Symbols symbols;
  Forces forces;
  Tasks tasks;
  Schedule schedule;
};

}  // namespace rung::host
