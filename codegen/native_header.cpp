// SPDX-License-Identifier: Apache-2.0
// Header for native blocks: see native_header.h.
#include "codegen/native_header.h"

#include <vector>

#include "codegen/names.h"
#include "codegen/signature.h"
#include "codegen/types.h"

namespace rung::codegen {

using types::Field;
using types::TypeInfo;
using types::TypeKind;
using types::TypeTable;

namespace {

class Declarations {
 public:
  explicit Declarations(const ir::Module& module)
      : module_(module), types_(module.types), is_declared_(module.types.count()) {}

  void prototype(const ir::Body& body, std::string_view name_space) {
    std::string self;
    if (body.self) {
      declareAll(body.self);
      self = std::string(name_space) + "::" + recordName(types_, body.self);
    }
    for (const ir::Local& local : body.locals)
      if (isParameter(local)) declareAll(local.type);
    prototypes_ += "extern \"C\" ";
    appendSignature(prototypes_, module_, body, {}, self);
    prototypes_ += ";\n";
  }

  std::string text(std::string_view name_space) const {
    if (structs_.empty()) return prototypes_;
    std::string out = "namespace ";
    out += name_space;
    out += " {\n\n" + structs_ + "}  // namespace ";
    out += name_space;
    return out += "\n\n" + prototypes_;
  }

 private:
  // A type and all that it holds or points to.
  void declareAll(TypeId type) {
    pointed_.push_back(type);
    while (!pointed_.empty()) {
      const TypeId next = pointed_.back();
      pointed_.pop_back();
      declare(next);
    }
  }

  // The types that a type holds come before it, those that it only points to after it: they may hold it.
  void declare(TypeId type) {
    type = elementOf(types_, type);
    const TypeKind kind = types_.kind(type);
    if (kind == TypeKind::Pointer || kind == TypeKind::Reference) return pointed_.push_back(types_.info(type).base);
    if (is_declared_[type.index] || (kind != TypeKind::Record && kind != TypeKind::Enum)) return;
    is_declared_[type.index] = true;
    if (kind == TypeKind::Enum) return enumeration(type);
    for (const Field& field : types_.info(type).fields) {
      if (field.by_reference)
        pointed_.push_back(field.type);
      else
        declare(field.type);
    }
    appendRecordDefinition(structs_, types_, type, false);
    appendLayoutAssert(structs_, types_, type);
    structs_ += '\n';
  }

  void enumeration(TypeId type) {
    const TypeInfo& info = types_.info(type);
    structs_ += "enum ";
    appendMangled(structs_, types_.names().string(info.name));
    structs_ += "type : ";
    structs_ += scalarType(types_, type);
    structs_ += " {\n";
    for (const auto& [name, value] : info.items) {
      structs_ += "  ";
      appendMangled(structs_, types_.names().string(name));
      structs_ += " = ";
      appendConstant(structs_, types_, info.base, static_cast<uint64_t>(value));
      structs_ += ",\n";
    }
    structs_ += "};\n\n";
  }

  const ir::Module& module_;
  const TypeTable& types_;
  std::vector<bool> is_declared_;  // by type
  std::vector<TypeId> pointed_;    // to declare later
  std::string structs_, prototypes_;
};

}  // namespace

std::string nativeDeclarations(const ir::Module& module, std::span<const ir::BodyId> bodies,
                               std::string_view name_space) {
  Declarations declarations(module);
  for (const ir::BodyId id : bodies) declarations.prototype(module.body(id), name_space);
  return declarations.text(name_space);
}

std::string nativeHeader(std::string_view declarations) {
  std::string out =
      "// Native blocks: a C++ file includes this and defines the functions below. Made by rung from the "
      "declarations.\n"
      "#pragma once\n\n#include <stddef.h>\n#include <stdint.h>\n\n#include \"rung/module.h\"\n\n";
  out += declarations;
  return out;
}

}  // namespace rung::codegen
