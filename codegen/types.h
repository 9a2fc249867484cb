// SPDX-License-Identifier: Apache-2.0
// Types in C++: names, declarations, constants, the struct of each record.
// In: types of the type table, laid out. Out: C++ as values (cxx/nodes.h), or as text appended to `out`. Called by
// every file of codegen.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "codegen/cxx/nodes.h"
#include "ir/ir.h"

namespace rung::codegen {

// `int16_t`, `float`; pointers and references `void*`; strings `char`, `char16_t`. Not for arrays and records.
const char* scalarType(const types::TypeTable& types, TypeId type);
// The same for memory of any type: `rung_i16_at`.
const char* scalarAliasType(const types::TypeTable& types, TypeId type);
// The constant of module.h for a type: `RUNG_INT`.
const char* typeKindName(const types::TypeTable& types, TypeId type);

// The type of a variable: `int16_t x_`, `float x_[3][4]`, `char x_[81]`, `struct Ramp_type x_`.
cxx::Type valueType(cxx::Tree& tree, const types::TypeTable& types, TypeId type);
// A pointer to such a variable: `int16_t* x_`, `float (*x_)[3][4]`, `char* x_`, `struct Ramp_type* x_`.
cxx::Type pointerType(cxx::Tree& tree, const types::TypeTable& types, TypeId type, bool constant = false);
void appendDeclaration(std::string& out, const types::TypeTable& types, TypeId type, std::string_view name);
std::string constantOf(const std::string& type);  // `const float`, `void* const`
// `struct Ramp_type` or `union Ramp_type`.
std::string recordType(const types::TypeTable& types, TypeId type);
std::string recordName(const types::TypeTable& types, TypeId type);  // `Ramp_type`, for a global list `Valves_list`
std::string recordFile(const types::TypeTable& types, TypeId type);  // `Ramp_.h`, `Valves_list.h`
// Pointer arithmetic has the bounds of ULINT.
inline bool isPointer(types::TypeKind kind) {
  return kind == types::TypeKind::Pointer || kind == types::TypeKind::Reference;
}
inline bool isMethod(const ir::Body& body) { return body.kind == ir::BodyKind::Function && body.self && !body.native; }
// `Motor_class`, and for a method `Motor__Start_call`, …: its number, the type and the table of its dispatch.
std::string className(const types::TypeTable& types, TypeId record);
std::string methodName(const ir::Module& module, ir::BodyId method, const char* what);
// `Ramp_body`, `Scale_fn`, `Ramp_init`.
void appendFunctionName(std::string& out, const ir::Module& module, const ir::Body& body);

// A scalar's value, in the C++ type that scalarType names or one that promotes to it. `negative`: begins with `-`.
void appendConstant(std::string& out, const types::TypeTable& types, TypeId type, uint64_t bits);

// The element type of an array, of any dimensions, or the type itself.
TypeId elementOf(const types::TypeTable& types, TypeId type);

// How a field becomes a member of a struct that has the layout of the type table. Usually the C++ compiler places it
// there by itself.
struct MemberPlacement {
  uint32_t gap = 0;    // bytes before it
  std::string before;  // `alignas(8)`
  std::string after;   // ` __attribute__((packed))`
};
struct RecordPlacement {
  std::vector<MemberPlacement> members;
  uint32_t gap = 0;  // bytes at the end
};
RecordPlacement placementOf(const types::TypeTable& types, TypeId record);

// The struct or union. `pointed`: pointers may read it as memory of another type.
cxx::Record* recordDefinition(cxx::Tree& tree, const types::TypeTable& types, TypeId type, bool pointed);
// One assertion for the whole layout: the size and the offsets of fields, about 16 of them in a large record.
cxx::Assertion* layoutAssertion(cxx::Tree& tree, const types::TypeTable& types, TypeId type);

// The namespace of a module. What it holds is hidden: a shared library exports only the module's function, and
// position-independent code calls and reads directly.
cxx::Namespace* hiddenNamespace(cxx::Tree& tree, std::string_view name);

}  // namespace rung::codegen
