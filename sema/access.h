// SPDX-License-Identifier: Apache-2.0
// The use of an lvalue that an expression names: read, written, bound, called.
#pragma once

#include <cstdint>

namespace rung::sema {

// The use of the lvalue that an expression names.
enum class Access : uint8_t {
  Read,
  Write,      // the target of an assignment or an output binding
  ReadWrite,  // a compound assignment
  InOut,      // an in-out argument: read and written, too
  Qualifier,  // the base of a member: may be a list, a library, a type or a program
  Bind,       // the target of REF=: the reference itself
  Address,    // ADR, SIZEOF: neither read nor written here
  Refer,      // bound to a REFERENCE, through which it may be written; otherwise like Address
  Call,       // an instance that is called; otherwise like ReadWrite
  Pin,        // the pin of an argument, the member of an initial value: named there, and no use of the variable
};

// Whether the value of the variable may be written.
constexpr bool writesValue(Access access) {
  return access == Access::Write || access == Access::ReadWrite || access == Access::InOut || access == Access::Call;
}

constexpr bool reads(Access access) { return access != Access::Write && access != Access::Bind; }

constexpr bool takesAddress(Access access) { return access == Access::Address || access == Access::Refer; }

}  // namespace rung::sema
