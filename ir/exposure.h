// SPDX-License-Identifier: Apache-2.0
// Which fields of blocks can be reached by more than their own block: through a pointer, a reference or an in-out. In:
// the module. Out: tables by record. Used by passes, which forget only what a write can reach, and by codegen, which
// keeps the other fields in C++ locals.
#pragma once

#include <unordered_set>
#include <vector>

#include "ir/ir.h"

namespace rung::ir {

class Exposure {
 public:
  explicit Exposure(const Module& module);

  // True when the address of this variable of a block (record, field) is taken somewhere.
  bool isExposed(TypeId record, uint32_t field) const {
    return exposed_fields_.count(uint64_t{record.index} << 32 | field) != 0;
  }
  // True when instances of the record may be reached through globals or pointers while their body makes a call.
  bool isSeen(TypeId record) const { return seen_[record.index] == Seen::AtCalls; }

 private:
  enum class Seen : uint8_t { No, AtCalls, Whole };  // Whole: every field is exposed

  void scan(const Module& module, const Body& body);
  void expose(const Module& module, const Body& body, ExprId place);
  void exposeAll(const Module& module, TypeId type);
  void see(TypeId record) {
    if (seen_[record.index] == Seen::No) seen_[record.index] = Seen::AtCalls;
  }

  std::vector<Seen> seen_;  // by record
  std::unordered_set<uint64_t> exposed_fields_;
};

}  // namespace rung::ir
