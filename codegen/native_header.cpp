// SPDX-License-Identifier: Apache-2.0
// Header for native blocks: see native_header.h.
#include "codegen/native_header.h"

#include <vector>

#include "codegen/cxx/print.h"
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
    cxx::Function* const prototype = signatureOf(tree_, module_, body, {}, self);
    prototype->prefix = "extern \"C\"";
    prototypes_.add(prototype);
  }

  std::string text(std::string_view name_space) {
    cxx::Declarations all;
    if (!structs_.empty()) {
      cxx::Namespace* const space = tree_.declaration<cxx::Namespace>();
      space->name = tree_.kept(name_space);
      space->members = structs_;
      all.add(space);
      all.add(tree_.blank());
    }
    all.append(prototypes_);
    std::string out;
    cxx::print(out, tree_, all);
    return out;
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
    structs_.add(tree_.blank());
    structs_.add(recordDefinition(tree_, types_, type, false));
    structs_.add(layoutAssertion(tree_, types_, type));
  }

  void enumeration(TypeId type) {
    const TypeInfo& info = types_.info(type);
    const auto mangled = [&](NameId name) {
      std::string out;
      appendMangled(out, types_.names().string(name));
      return out;
    };
    std::vector<cxx::Enumeration::Item> items;
    for (const auto& [name, value] : info.items) {
      std::string constant;
      appendConstant(constant, types_, info.base, static_cast<uint64_t>(value));
      items.push_back({tree_.kept(mangled(name)), tree_.name(constant)});
    }
    cxx::Enumeration* const made = tree_.declaration<cxx::Enumeration>();
    made->name = tree_.kept(mangled(info.name) + "type");
    made->base = scalarType(types_, type);
    made->items = tree_.copy(items);
    structs_.add(tree_.blank());
    structs_.add(made);
  }

  const ir::Module& module_;
  const TypeTable& types_;
  std::vector<bool> is_declared_;  // by type
  std::vector<TypeId> pointed_;    // to declare later
  cxx::Tree tree_;
  cxx::Declarations structs_, prototypes_;
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
