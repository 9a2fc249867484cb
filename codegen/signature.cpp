// SPDX-License-Identifier: Apache-2.0
// Signatures of functions: see signature.h.
#include "codegen/signature.h"

#include <algorithm>

#include "codegen/cxx/print.h"
#include "codegen/names.h"
#include "codegen/types.h"
#include "ir/builder.h"

namespace rung::codegen {

using ir::LocalKind;
using types::TypeTable;

namespace {

// Arrays and records have no C type that a library could know.
cxx::Type parameterType(cxx::Tree& tree, const TypeTable& types, const ir::Local& local, bool native) {
  const bool read_only = local.kind == LocalKind::Input;
  const types::TypeKind kind = types.kind(local.type);
  if (!local.by_reference) return valueType(tree, types, local.type);
  if (native && (kind == types::TypeKind::Array || kind == types::TypeKind::Record))
    return {read_only ? "const void" : "void", "*", {}};
  return pointerType(tree, types, local.type, read_only);
}

// The name and the parameters of a signature.
class SignatureMaker {
 public:
  SignatureMaker(cxx::Tree& tree, const ir::Module& module, const ir::Body& body)
      : tree_(tree), module_(module), types_(module.types), body_(body) {}

  cxx::Function* make(std::string_view function, std::string_view self) {
    const bool by_value = body_.result && !ir::isAggregate(types_, body_.result);
    made_->result.base = by_value ? scalarType(types_, body_.result) : returnsString() ? "uint32_t" : "void";
    std::string name(function);
    if (name.empty() && body_.native)
      name = ir::nativeName(module_, body_);
    else if (name.empty())
      appendFunctionName(name, module_, body_);
    made_->name = tree_.kept(name);
    addContext(self);
    for (const ir::Local& local : ir::parameters(body_)) {
      add(parameterType(tree_, types_, local, body_.native), nameOf(local));
      if (passesLength(module_, body_, local)) add({"uint32_t", "*", {}}, nameOf(local) + "np");
    }
    if (body_.result && !by_value) addResult();
    return made_;
  }

 private:
  // A native returns the length of its string.
  bool returnsString() const { return body_.native && body_.result && TypeTable::isString(types_.kind(body_.result)); }

  void add(const cxx::Type& type, std::string_view name) { made_->parameters.add(tree_.variable(type, name)); }

  std::string nameOf(const ir::Local& local) const {
    std::string name;
    appendMangled(name, module_.names.string(local.name));
    return name;
  }

  // The context, and the instance of a block or object.
  void addContext(std::string_view self) {
    const cxx::Type context{"rung_context", "*", {}};
    if (isMethod(body_)) add({"void", "*", {}}, "object");
    if (body_.self && !body_.native && !isMethod(body_))
      add({tree_.kept(recordType(types_, body_.self)), "&", {}}, "self");
    add(context, "ctx");
    if (body_.self && body_.native) add({self.empty() ? "void" : tree_.kept(self), "*", {}}, "self");
  }

  void addResult() {
    const auto result = std::find_if(body_.locals.rbegin(), body_.locals.rend(),
                                     [](const ir::Local& local) { return local.kind == LocalKind::Result; });
    const bool is_named = result != body_.locals.rend() && !body_.native;
    if (body_.native && !returnsString())
      add({"void", "*", {}}, "out");
    else
      add(pointerType(tree_, types_, body_.result), is_named ? nameOf(*result) : "out");
    if (returnsString()) add({"uint32_t", {}, {}}, "capacity");
  }

  cxx::Tree& tree_;
  const ir::Module& module_;
  const TypeTable& types_;
  const ir::Body& body_;
  cxx::Function* const made_ = tree_.declaration<cxx::Function>();
};

}  // namespace

bool passesLength(const ir::Module& module, const ir::Body& function, const ir::Local& parameter) {
  const bool has_lengths = function.kind == ir::BodyKind::Function && !function.self && !function.native &&
                           !function.pure && function.cpp == 0;
  return has_lengths && parameter.kind == LocalKind::InOut && parameter.by_reference &&
         module.types.kind(parameter.type) == types::TypeKind::String;
}

cxx::Function* signatureOf(cxx::Tree& tree, const ir::Module& module, const ir::Body& body, std::string_view function,
                           std::string_view self) {
  return SignatureMaker(tree, module, body).make(function, self);
}

void appendSignature(std::string& out, const ir::Module& module, const ir::Body& body) {
  cxx::Tree tree;
  cxx::printSignature(out, *signatureOf(tree, module, body));
}

}  // namespace rung::codegen
