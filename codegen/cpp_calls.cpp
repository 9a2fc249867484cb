// SPDX-License-Identifier: Apache-2.0
// Functions, methods and actions that a body in C++ calls: see cpp_facade.h. A function is an object of its name,
// called with or without EN and ENO; a method of a block is a member of its object.
#include <algorithm>

#include "codegen/cpp_facade.h"
#include "codegen/cpp_names.h"
#include "codegen/cxx/print.h"
#include "codegen/names.h"
#include "codegen/signature.h"
#include "codegen/types.h"
#include "ir/builder.h"

namespace rung::codegen {

using ir::Local;
using ir::LocalKind;
using types::Field;
using types::FieldRole;

// A function or method as the facade calls it.
struct CppFacade::Call {
  bool ok = false;
  std::vector<std::pair<cxx::Type, std::string>> parameters;
  std::vector<Ex> names;      // of the parameters
  std::vector<Ex> arguments;  // of the generated function
  std::string result;
  cxx::Statements code;

  void addParametersTo(cxx::Tree& tree, cxx::Function& function) const {
    for (const auto& [type, name] : parameters) function.parameters.add(tree.variable(type, name));
  }
};

cxx::Function* CppFacade::member(std::string_view result, std::string_view name) {
  cxx::Function* const made = tree_.declaration<cxx::Function>();
  made->result.base = tree_.kept(result);
  made->name = tree_.kept(name);
  made->form = cxx::Function::Form::OneLine;
  return made;
}

cxx::Stmt* CppFacade::line(cxx::Stmt* stmt) const {
  stmt->begins = true;
  return stmt;
}

cxx::Stmt* CppFacade::assign(Ex to, Ex value) {
  return line(tree_.stmt(cxx::StmtKind::Expression, tree_.infix(cxx::Op::Assign, to, value)));
}

std::string CppFacade::ownName(const ir::Body& method) const {
  const std::string_view name = string(method.spelling);
  return cppIdentifier(name.substr(name.rfind('.') + 1));
}

// The path from a block to one that it extends.
cxx::Ex CppFacade::placeOfBase(Ex place, TypeId from, TypeId to) {
  from = types_.resolve(from);
  if (from == types_.resolve(to)) return place;
  for (const Field& field : info(from).fields) {
    if (field.role != FieldRole::Base) continue;
    std::string base;
    appendMangled(base, string(field.name));
    return placeOfBase(tree_.member(place, tree_.kept(base)), field.type, to);
  }
  return place;
}

// The address of a view, converted to the parameter type of the function.
cxx::Ex CppFacade::pointer(TypeId type, Ex address, bool constant) {
  const std::string to = cxx::toString(pointerType(tree_, types_, type, constant), "");
  return tree_.call("reinterpret_cast<" + to + ">", {address});
}

// False: a parameter has no type that C++ could give.
bool CppFacade::addParameters(const ir::Body& function, Call& call) {
  bool ok = true;
  for (const Local& local : ir::parameters(function)) {
    const std::string seen = view(local.type), name = "rung_p" + std::to_string(call.names.size());
    ok = ok && !seen.empty() && !holdsBlock(local.type);
    need(local.type);
    const Ex parameter = tree_.name(name);
    call.names.push_back(parameter);
    if (local.kind == LocalKind::Input && local.by_reference) {
      call.parameters.push_back({{tree_.kept(seen.empty() ? seen : constantOf(seen)), "&", {}}, name});
      call.arguments.push_back(pointer(local.type, tree_.prefix("&", parameter), true));
    } else if (local.kind == LocalKind::Input) {
      call.parameters.push_back({{tree_.kept(seen), {}, {}}, name});
      call.arguments.push_back(bitsOf(scalarType(types_, local.type), parameter));
    } else {
      call.parameters.push_back({{tree_.kept(seen), "*", {}}, name});
      call.arguments.push_back(pointer(local.type, parameter, false));
      if (!passesLength(module_, function, local)) continue;
      cxx::Variable* const length = tree_.variable("uint32_t", name + "n", tree_.fixed("RUNG_UNCOUNTED"));
      call.code.add(tree_.declare(length));
      call.arguments.push_back(tree_.prefix("&", tree_.fixed(length->name)));
    }
  }
  return ok;
}

// `self`: the lvalue of its object; null: none.
CppFacade::Call CppFacade::callOf(ir::BodyId id, Ex self) {
  const ir::Body& function = module_.body(id);
  Call made;
  const Ex context = tree_.fixed("rung_ctx_");
  if (self != nullptr && isMethod(function)) made.arguments = {tree_.prefix("&", self), context};
  if (self != nullptr && !isMethod(function)) made.arguments = {self, context};
  if (self == nullptr) made.arguments = {context};
  const bool ok = addParameters(function, made);
  made.result = function.result ? view(function.result) : "void";
  if (!ok || made.result.empty()) return made;
  made.ok = true;
  (facts_.is_inlined[id.index] != 0 ? group_.inlined : group_.callees).push_back(id);

  std::string name;
  if (function.native)
    name = ir::nativeName(module_, function);
  else
    appendFunctionName(name, module_, function);
  const auto perform = [&](Ex call) { made.code.add(tree_.stmt(cxx::StmtKind::Expression, call)); };
  if (!function.result) {
    perform(tree_.call(name, made.arguments));
    return made;
  }
  if (!ir::isAggregate(types_, function.result)) {
    const Ex value = bitsOf(made.result, tree_.call(name, made.arguments));
    made.code.add(tree_.stmt(cxx::StmtKind::Return, value));
    return made;
  }
  need(function.result);
  const Ex result = tree_.fixed("rung_result");
  made.code.add(tree_.declare(tree_.variable(made.result, result->text)));
  made.arguments.push_back(pointer(function.result, tree_.prefix("&", result), false));
  if (function.native && isString(function.result))
    made.arguments.push_back(tree_.number(info(function.result).length));
  perform(tree_.call(name, made.arguments));
  made.code.add(tree_.stmt(cxx::StmtKind::Return, result));
  return made;
}

// The methods and actions of a block and of those that it extends, by their declared names.
void CppFacade::addMethods(TypeId type, cxx::Declarations& to) {
  std::vector<std::string> taken;
  for (Ex place = tree_.fixed("rung_self_"); type;) {
    for (uint32_t i = 1; i < module_.bodies.size(); ++i) {
      const ir::Body& method = module_.bodies[i];
      if (!isMethod(method) || method.abstract || types_.resolve(method.self) != type || i == body_.index) continue;
      const Call call = callOf({i}, place);
      std::string key = ownName(method);
      for (const auto& [parameter, name] : call.parameters) key += ", " + cxx::toString(parameter, name);
      if (!call.ok || std::find(taken.begin(), taken.end(), key) != taken.end()) continue;
      taken.push_back(key);
      cxx::Function* const made = member(call.result, ownName(method));
      call.addParametersTo(tree_, *made);
      made->body = call.code.first();
      to.add(made);
    }
    const std::vector<Field>& fields = info(type).fields;
    const auto base =
        std::find_if(fields.begin(), fields.end(), [](const Field& field) { return field.role == FieldRole::Base; });
    if (base == fields.end()) return;
    std::string name;
    appendMangled(name, string(base->name));
    place = tree_.member(place, tree_.kept(name));
    type = types_.resolve(base->type);
  }
}

cxx::Variable* CppFacade::functionObject(ir::BodyId id) {
  const ir::Body& function = module_.body(id);
  const Ex self = function.self ? tree_.fixed("rung_self_") : nullptr;
  const Call call = callOf(id, self);
  if (!call.ok) return nullptr;
  const std::string name = self != nullptr ? ownName(function) : cppIdentifier(cppUpper(string(function.spelling)));
  cxx::Record* const record = tree_.declaration<cxx::Record>();
  record->keyword = "struct";
  record->name = tree_.kept("rung_function_" + name);
  record->members.add(tree_.variable(cxx::Type{"rung_context", "*", {}}, "rung_ctx_"));
  std::vector<Ex> members = {tree_.fixed("rung_ctx_")};
  if (self != nullptr) {
    need(function.self);
    const std::string memory = recordName(types_, types_.resolve(function.self));
    record->members.add(tree_.variable(cxx::Type{tree_.kept(memory), "&", {}}, "rung_self_"));
    members.push_back(placeOfBase(self, module_.body(body_).self, function.self));
  }
  cxx::Function* const plain = member(call.result, "operator()");
  plain->suffix = " const";
  call.addParametersTo(tree_, *plain);
  plain->body = call.code.first();
  record->members.add(plain);
  if (self == nullptr) record->members.add(conditional(call, static_cast<bool>(function.result)));
  define(record);

  cxx::Variable* const object = tree_.variable(record->name, name);
  object->prefix = "const";
  object->arguments = tree_.braces(members);
  return object;
}

// The form with EN and ENO.
cxx::Function* CppFacade::conditional(const Call& call, bool has_result) {
  const Ex enabled = tree_.fixed("rung_en"), eno = tree_.fixed("rung_eno");
  cxx::Function* const made = member(call.result, "operator()");
  made->suffix = " const";
  made->form = cxx::Function::Form::Lines;
  made->parameters.add(tree_.variable("bool", enabled->text));
  made->parameters.add(tree_.variable(cxx::Type{"BOOL", "*", {}}, eno->text));
  call.addParametersTo(tree_, *made);
  const auto onlyIf = [&](Ex condition, Ex action) {
    cxx::Stmt* const test = line(tree_.stmt(cxx::StmtKind::ShortIf, condition));
    test->first = tree_.stmt(cxx::StmtKind::Expression, action);
    return test;
  };
  cxx::Statements code;
  code.add(onlyIf(tree_.infix(cxx::Op::Differs, eno, tree_.fixed("nullptr")),
                  tree_.infix(cxx::Op::Assign, tree_.prefix("*", eno), enabled)));
  const Ex done = tree_.call("(*this)", call.names);
  if (has_result)
    code.add(line(tree_.stmt(cxx::StmtKind::Return, tree_.choice(enabled, done, tree_.name(call.result + "{}")))));
  else
    code.add(onlyIf(enabled, done));
  made->body = code.first();
  return made;
}

}  // namespace rung::codegen
