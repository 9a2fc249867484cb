// SPDX-License-Identifier: Apache-2.0
// Writes one IR body as a C++ function. In: a verified body and the facts of the module. Out: code in the group, and
// what the group must include and declare for it. Called by emit.cpp for each body of a group.
//
// Layout: all variables are declared at the top (a `goto` never crosses an initialisation), then the statements, each
// after its checks, then the exits:
//   void Ramp_body(Ramp_type& self, rung_context* ctx) {
//     float y_ = self.y_;  uint32_t at;  int64_t value;      scalars of the instance that live in locals (locals.h)
//     RUNG_CHECK(bad, site << 3 | kind, value)               jumps to fault:
//   leave: self.y_ = y_; return;
//   fault: self.y_ = y_; rung_raise(ctx, …);
//   }
// The analyses of the body come first (analysis.h), then the writers of its parts (body_parts.h).
#pragma once

#include "codegen/body_part.h"

namespace rung::codegen {

class BodyWriter {
 public:
  BodyWriter(const ir::Module& module, const EmitOptions& options, const Facts& facts, Group& group, Marks& marks,
             uint32_t group_number)
      : context_{module, options, facts, group, marks, group_number} {}

  // Appends to group.code.
  void write(ir::BodyId id);

 private:
  BodyContext context_;
  cxx::Tree tree_;  // of one body after the other
};

}  // namespace rung::codegen
