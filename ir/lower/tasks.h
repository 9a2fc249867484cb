// SPDX-License-Identifier: Apache-2.0
// The tasks of a module: their settings, what runs a program instance with connections or open addresses, blocks that a
// task runs by themselves, and the methods around the programs of a task. In: the project's tasks and instances. Out:
// Module::tasks, block_tasks, run and setup of programs. activation.cpp, task_calls.cpp. A part of ModuleLowering.
#pragma once

#include <span>
#include <vector>

#include "ir/lower/body_part.h"
#include "ir/lower/module_part.h"

namespace rung::ir {

class TaskLowering : ModulePart {
 public:
  using ModulePart::ModulePart;

  void addTasks();
  void addActivations();
  void addBlockTasks();
  // A function without parameters that a program instance has for itself.
  BodyId newActivation(uint32_t program, const char* what, Loc loc);
  // task_calls.cpp: methods marked {before_task} and {after_task}.
  void requestCalls();
  void addCalls();

 private:
  void addActivation(uint32_t program, const sema::ProgramInstance* instance,
                     std::span<const sema::InstancePath> places);
  struct Held;
  BodyId callsOf(NameId name, const char* suffix, std::span<const sema::PouId> methods,
                 std::span<const Held> variables);
  void findMethods();
  std::vector<Held> heldIn(const Root& root) const;
  bool goesWith(const Held& held, const std::vector<Held>& others) const;
  void shareGlobals(const std::vector<Held>& globals, std::vector<std::vector<Held>>& of_task) const;
  std::vector<Held> heldBy(const Test& test, const std::vector<Held>& globals) const;

  std::vector<sema::PouId> before_, after_;  // methods of the blocks that have instances
};

}  // namespace rung::ir
