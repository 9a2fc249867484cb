// SPDX-License-Identifier: Apache-2.0
// The variables of a body that codegen may keep in C++ locals, numbered: first the body's locals, then the fields of
// the instance. In: a body. Out: the number of the variable that a place means. Called by the analyses of a body
// (uses.h, locals.h, counted_loops.h, lengths.h, slices.h), whose results are tables by this number, and by the
// printer.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "ir/ir.h"

namespace rung::codegen {

inline constexpr uint32_t kNoVariable = ~0u;

class Variables {
 public:
  Variables(const ir::Module& module, const ir::Body& body);

  // A local (but for parameters by reference), a field of the own instance, or bits of one; else none.
  uint32_t at(ir::ExprId place) const;
  // A STRING in a local or in a field of the own instance; also a parameter or the result by reference.
  uint32_t stringAt(ir::ExprId place) const;

  uint32_t count() const { return local_count_ + field_count_; }
  uint32_t localCount() const { return local_count_; }
  uint32_t fieldCount() const { return field_count_; }
  bool isField(uint32_t number) const { return number >= local_count_; }
  // Only for fields, only for locals.
  const types::Field& field(uint32_t number) const { return module_->types.info(record_).fields[fieldIndex(number)]; }
  uint32_t fieldIndex(uint32_t number) const { return number - local_count_; }
  const ir::Local& local(uint32_t number) const { return body_->locals[number]; }
  TypeId typeOf(uint32_t number) const { return isField(number) ? field(number).type : local(number).type; }
  TypeId record() const { return record_; }  // of the instance, or none

  void dropFields() { field_count_ = 0; }  // other code may reach the instance while the body runs

  // `level cached wide`, a line for each variable that has a row; for tests.
  std::string lines(const std::vector<std::string>& rows) const;

 private:
  const ir::Module* module_;
  const ir::Body* body_;
  TypeId record_;
  uint32_t local_count_, field_count_ = 0;
};

}  // namespace rung::codegen
