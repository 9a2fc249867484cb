// SPDX-License-Identifier: Apache-2.0
// Variables of a stopped program: those of a call, of its instance, the globals and the process image, and what is
// inside of each. In: frames. Out: names, types and values as traces print them; places that can be set. They hold
// until the program goes on.
#pragma once

#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "stdlib/runtime/host/symbols.h"
#include "tools/debug/execution.h"

namespace rung::debug {

using host::Variable;

struct ShownVariable {
  std::string name, value, type;
  Variable place;
  uint64_t named = 0, indexed = 0;  // what is inside
};

class Values {
 public:
  explicit Values(Execution& execution) : execution_(execution) {}
  // The program went on: all places of frames are gone.
  void forget() { memories_.clear(); }

  // The variables of a function or of the call itself.
  std::vector<ShownVariable> locals(const DebugFrame& frame);
  // Of the instance of a frame, inherited ones included.
  std::vector<ShownVariable> instance(const DebugFrame& frame);
  // The lists of global variables and the program instances.
  std::vector<ShownVariable> globals();
  // The areas of the image that have memory, as bytes.
  std::vector<ShownVariable> image();
  // What is inside of a variable, from `start` on, at most `count`.
  std::vector<ShownVariable> inside(const Variable& variable, uint64_t start, uint64_t count) const;
  ShownVariable show(std::string name, const Variable& variable) const;

  // The variable of this name as the code of a frame sees it; null: as code outside of POUs. False: there is none.
  bool find(const DebugFrame* frame, std::string_view name, Variable& variable);
  bool instanceOf(const DebugFrame& frame, Variable& variable);
  // It lies in the frame of a call, not in an instance or a global list.
  static bool isOfCall(const Variable& variable);
  // Goes on from a variable: `.name`, `[1,2]`, `^`, `.3`. False: `error`.
  bool step(Variable& variable, const std::string& text, std::string& error) const;
  // `Belt (Main.belt)`.
  std::string nameOf(const DebugFrame& frame) const;
  std::string instancePath(const DebugFrame& frame) const;

 private:
  // A frame as memory that variables refer to.
  struct FrameMemory {
    DebugFrame frame;
    void* blocks[2];
    rung_context context;
  };
  const FrameMemory& memoryOf(const DebugFrame& frame);
  Variable local(const DebugFrame& frame, const ir::interpreter::DebugLocal& local);

  const rung_module& module() const { return execution_.module(); }
  Execution& execution_;
  std::deque<FrameMemory> memories_;
};

}  // namespace rung::debug
