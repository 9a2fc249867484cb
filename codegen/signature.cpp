// SPDX-License-Identifier: Apache-2.0
// Signatures of functions: see signature.h.
#include "codegen/signature.h"

#include "codegen/names.h"
#include "codegen/types.h"
#include "ir/builder.h"

namespace rung::codegen {

using ir::LocalKind;
using types::TypeTable;

namespace {

// Arrays and records have no C type that a library could know.
void appendParameter(std::string& out, const TypeTable& types, const ir::Local& local, std::string_view name,
                     bool native) {
  const bool read_only = local.kind == LocalKind::Input;
  const types::TypeKind kind = types.kind(local.type);
  if (!local.by_reference) {
    appendDeclaration(out, types, local.type, name);
  } else if (native && (kind == types::TypeKind::Array || kind == types::TypeKind::Record)) {
    out += read_only ? "const void* " : "void* ";
    out += name;
  } else {
    appendPointer(out, types, local.type, name, read_only);
  }
}

}  // namespace

bool passesLength(const ir::Module& module, const ir::Body& function, const ir::Local& parameter) {
  const bool has_lengths = function.kind == ir::BodyKind::Function && !function.self && !function.native &&
                           !function.pure && function.cpp == 0;
  return has_lengths && parameter.kind == LocalKind::InOut && parameter.by_reference &&
         module.types.kind(parameter.type) == types::TypeKind::String;
}

void appendSignature(std::string& out, const ir::Module& module, const ir::Body& body, std::string_view function,
                     std::string_view self) {
  const TypeTable& types = module.types;
  const ir::Local* result = nullptr;
  for (const ir::Local& local : body.locals) {
    if (local.kind == LocalKind::Result) result = &local;
  }
  const bool by_value = body.result && !ir::isAggregate(types, body.result);
  if (by_value) {
    const char* type = scalarType(types, body.result);
    out += type;
  } else if (body.native && body.result && TypeTable::isString(types.kind(body.result))) {
    out += "uint32_t";  // the length
  } else {
    out += "void";
  }
  out += ' ';
  if (!function.empty()) {
    out += function;
  } else if (body.native) {
    out += ir::nativeName(module, body);
  } else {
    appendFunctionName(out, module, body);
  }
  out += '(';
  if (body.native) {
    out += "rung_context* ctx";
    if (body.self) {
      out += ", ";
      out += self.empty() ? "void" : self;
      out += "* self";
    }
  } else if (isMethod(body)) {
    out += "void* object, rung_context* ctx";
  } else if (body.self) {
    appendRecordType(out, types, body.self);
    out += "& self, rung_context* ctx";
  } else {
    out += "rung_context* ctx";
  }
  std::string name;
  for (const ir::Local& local : ir::parameters(body)) {
    out += ", ";
    name.clear();
    appendMangled(name, module.names.string(local.name));
    appendParameter(out, types, local, name, body.native);
    if (passesLength(module, body, local)) out += ", uint32_t* " + name + "np";
  }
  if (body.result && !by_value) {
    name.clear();
    if (result != nullptr && !body.native) {
      appendMangled(name, module.names.string(result->name));
    } else {
      name = "out";
    }
    out += ", ";
    if (body.native && !TypeTable::isString(types.kind(body.result))) {
      out += "void* out";
    } else {
      appendPointer(out, types, body.result, name);
    }
    if (body.native && TypeTable::isString(types.kind(body.result))) out += ", uint32_t capacity";
  }
  out += ')';
}

}  // namespace rung::codegen
