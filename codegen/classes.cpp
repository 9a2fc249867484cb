// SPDX-License-Identifier: Apache-2.0
// Class numbers and dispatch tables: see classes.h.
#include "codegen/classes.h"

#include <algorithm>
#include <vector>

#include "codegen/cxx/print.h"
#include "codegen/names.h"
#include "codegen/signature.h"
#include "codegen/types.h"

namespace rung::codegen {

namespace {

// `extern const uint32_t NAME = value;`, without a value a declaration.
cxx::Variable* number(cxx::Tree& tree, std::string_view name, cxx::Ex value = nullptr) {
  cxx::Variable* const made = tree.variable("uint32_t", name, value);
  made->prefix = "extern const";
  return made;
}

// `NAME_call* const NAME_table[]`
cxx::Variable* table(cxx::Tree& tree, const ir::Module& module, ir::BodyId method) {
  const cxx::Type functions{
      tree.kept(methodName(module, method, "call") + "* const"), {}, tree.copy(std::vector<uint64_t>{0})};
  return tree.variable(functions, methodName(module, method, "table"));
}

// The table of a method: a function for each class from the first one that has it; null: that one has not.
cxx::Variable* tableOf(cxx::Tree& tree, const ir::Module& module, const ir::Dispatch& dispatch) {
  std::vector<cxx::Ex> functions;
  for (const ir::BodyId body : dispatch.bodies) {
    std::string name;
    if (body) appendFunctionName(name, module, module.body(body));
    functions.push_back(body ? tree.name(name) : tree.fixed("nullptr"));
  }
  functions.push_back(tree.fixed(functions.empty() ? "nullptr" : ""));  // a comma at the end
  cxx::Variable* const made = table(tree, module, dispatch.method);
  made->value = tree.braces(functions);
  return made;
}

// The functions in the tables, declared in the order of their text.
std::vector<std::string> prototypesOf(const ir::Module& module) {
  std::vector<uint32_t> used;
  for (const ir::Dispatch& dispatch : module.dispatches)
    for (const ir::BodyId body : dispatch.bodies)
      if (body) used.push_back(body.index);
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  std::vector<std::string> prototypes;
  for (const uint32_t body : used) {
    appendSignature(prototypes.emplace_back(), module, module.bodies[body]);
    prototypes.back() += ";\n";
  }
  std::sort(prototypes.begin(), prototypes.end());
  return prototypes;
}

}  // namespace

void declareDispatch(cxx::Tree& tree, const ir::Module& module, ir::BodyId method, cxx::Declarations& to) {
  const std::string call = methodName(module, method, "call");
  cxx::Function* const type = signatureOf(tree, module, module.body(method), call);
  type->prefix = "typedef";
  to.add(type);
  cxx::Variable* const functions = table(tree, module, method);
  functions->prefix = "extern";
  to.add(functions);
  to.add(number(tree, methodName(module, method, "first")));
  to.add(number(tree, methodName(module, method, "count")));
}

std::string classesSource(const ir::Module& module, std::string_view name_space) {
  cxx::Tree tree;
  cxx::Declarations file;
  file.add(tree.textual(cxx::DeclKind::Comment, "The numbers of classes, and which method each of them has."));
  file.add(tree.textual(cxx::DeclKind::Directive, "define RUNG_GENERATED"));
  file.add(tree.textual(cxx::DeclKind::Include, "rung/code.h"));
  file.add(tree.blank());
  cxx::Namespace* const space = hiddenNamespace(tree, name_space);
  file.add(space);
  cxx::Declarations& to = space->members;
  to.add(tree.blank());
  for (size_t i = 0; i < module.classes.size(); ++i)
    to.add(number(tree, className(module.types, module.classes[i].record), tree.number(i + 1)));
  to.add(tree.blank());
  for (const std::string& line : prototypesOf(module)) to.add(tree.textual(cxx::DeclKind::Printed, line));
  to.add(tree.blank());
  for (const ir::Dispatch& dispatch : module.dispatches) {
    declareDispatch(tree, module, dispatch.method, to);
    to.add(number(tree, methodName(module, dispatch.method, "first"), tree.number(dispatch.first)));
    to.add(number(tree, methodName(module, dispatch.method, "count"), tree.number(dispatch.bodies.size())));
    to.add(tableOf(tree, module, dispatch));
  }
  std::string out;
  cxx::print(out, tree, file);
  return out;
}

}  // namespace rung::codegen
