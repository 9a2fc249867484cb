// SPDX-License-Identifier: Apache-2.0
// Which statements may change a variable that more than this body reaches: an in-out, or a variable whose address left
// the body. Such a variable may be the same memory as another in-out, as the target of a pointer, or as a field that
// was passed by reference somewhere. In: a body and the exposure of fields. Out: an answer for each statement. Called
// by lengths.cpp: the length of such a string is unknown afterwards.
#pragma once

#include "ir/exposure.h"

namespace rung::codegen {

class ForeignWrites {
 public:
  ForeignWrites(const ir::Module& module, const ir::Body& body, const ir::Exposure& exposure)
      : module_(module), body_(body), exposure_(exposure) {}

  // By the statement itself, without those in its blocks. A call of what is not pure changes everything.
  bool by(const ir::Stmt& stmt) const;

 private:
  bool isShared(ir::ExprId place) const;

  const ir::Module& module_;
  const ir::Body& body_;
  const ir::Exposure& exposure_;
};

}  // namespace rung::codegen
