// SPDX-License-Identifier: Apache-2.0
// Blocks as objects of a body in C++, and structures with blocks inside: see cpp_facade.h. Inputs and outputs are
// references, in-outs are values that Body() passes to the block. Inner blocks are objects again; an in-out that is a
// block is the address of such an object.
#include <algorithm>

#include "codegen/cpp_facade.h"
#include "codegen/cpp_names.h"
#include "codegen/cxx/print.h"
#include "codegen/names.h"
#include "codegen/types.h"

namespace rung::codegen {

using types::Field;
using types::FieldRole;
using types::TypeKind;

namespace {

constexpr uint64_t kMaxBlocks = 256;  // of an array: each gets an object

std::string mangled(std::string_view name) {
  std::string out;
  appendMangled(out, name);
  return out;
}

}  // namespace

// The parts of an object in work.
struct CppFacade::ObjectParts {
  cxx::Declarations members;
  std::vector<cxx::Function::Initialised> initialised;
  cxx::Statements lend, take_back;  // before and after Body(): in-outs
};

void CppFacade::fieldsOf(TypeId type, Ex place, FieldPlaces& out) {
  for (const Field& field : info(type).fields) {
    const Ex own = tree_.member(place, tree_.kept(mangled(string(field.name))));
    if (field.role == FieldRole::Base)
      fieldsOf(types_.resolve(field.type), own, out);
    else
      out.push_back({&field, own});
  }
}

CppFacade::Objects CppFacade::objectsOf(std::string_view name, TypeId type, Ex place) {
  const TypeId element = elementOf(types_, type);
  const std::string object = named(element);
  const Ex context = tree_.fixed("rung_ctx_");
  if (element == type) return {tree_.variable(object, name), tree_.call("", {context, place}), true};
  const types::TypeInfo& array = info(type);
  if (types_.kind(array.base) == TypeKind::Array) return {};  // an array of arrays of blocks
  std::vector<Ex> places = {place};
  std::vector<uint64_t> extents;
  for (const types::Dimension& dimension : array.dimensions) {
    if (dimension.count() * places.size() > kMaxBlocks) return {};
    extents.push_back(dimension.count());
    std::vector<Ex> next;
    for (const Ex one : places)
      for (uint64_t i = 0; i < dimension.count(); ++i) next.push_back(tree_.element(one, tree_.number(i)));
    places = std::move(next);
  }
  std::vector<Ex> list;
  list.reserve(places.size());
  for (const Ex one : places) list.push_back(tree_.call(object, {context, one}));
  cxx::Variable* const table = tree_.variable(object, "table");
  table->type.extents = tree_.copy(extents);
  cxx::Record* const made = tree_.declaration<cxx::Record>();
  made->keyword = "struct";
  made->variable = tree_.kept(name);
  made->members.add(table);
  return {made, tree_.braces({tree_.braces(list)}), false};
}

cxx::Record* CppFacade::object(TypeId type, const std::string& name) {
  need(type);
  const std::string memory = recordName(types_, type);
  ObjectParts parts;
  parts.initialised = {{"rung_ctx_", tree_.call("", {tree_.fixed("ctx")})},
                       {"rung_self_", tree_.call("", {tree_.fixed("self")})}};
  parts.members.add(tree_.variable("rung_context* const", "rung_ctx_"));
  parts.members.add(tree_.variable(cxx::Type{tree_.kept(memory), "&", {}}, "rung_self_"));
  FieldPlaces fields;
  fieldsOf(type, tree_.fixed("rung_self_"), fields);
  for (const auto& [field, place] : fields) {
    const bool is_member = field->role == FieldRole::Member && !isBlock(type);
    if (field->role == FieldRole::InOut)
      addInOut(*field, place, parts);
    else if (field->role == FieldRole::Input || field->role == FieldRole::Output || is_member)
      addPin(*field, place, parts);
  }

  cxx::Function* const made_of = member("", name);
  made_of->parameters.add(tree_.variable(cxx::Type{"rung_context", "*", {}}, "ctx"));
  made_of->parameters.add(tree_.variable(cxx::Type{tree_.kept(memory), "&", {}}, "self"));
  made_of->initialises = tree_.copy(parts.initialised);
  cxx::Function* const copied = member("", name);
  copied->parameters.add(tree_.variable("const " + name + "&", ""));
  copied->suffix = " = delete";
  copied->form = cxx::Function::Form::Prototype;

  cxx::Record* const record = tree_.declaration<cxx::Record>();
  record->keyword = "class";
  record->name = tree_.kept(name);
  record->has_access = true;
  record->members = parts.members;
  record->members.add(made_of);
  record->members.add(copied);
  if (!isBlock(type)) return record;
  record->members.add(bodyOf(type, parts));
  addMethods(type, record->members);
  return record;
}

// A value that the block gets while it runs: its memory holds the address of an in-out.
void CppFacade::addInOut(const Field& field, Ex place, ObjectParts& to) {
  const TypeId type = types_.resolve(field.type);
  const bool is_object = holdsBlock(type);
  if (is_object && !isBlock(type)) return;
  const std::string seen = is_object ? named(type) : view(type);
  if (seen.empty()) return;
  const std::string pin_name = cppIdentifier(string(field.name)), before_name = "rung_before_" + pin_name;
  const Ex pin = tree_.name(pin_name), before = tree_.name(before_name);
  to.lend.add(line(tree_.declare(tree_.variable("const auto", before_name, place))));
  to.take_back.add(assign(place, before));
  if (!is_object) {
    cxx::Variable* const value = tree_.variable(seen, pin_name);
    value->arguments = tree_.braces({});
    to.members.add(value);
    const Ex address = tree_.prefix("&", pin);
    to.lend.add(assign(place, tree_.call("reinterpret_cast<decltype(" + cxx::toString(place) + ")>", {address})));
    return;
  }
  to.members.add(tree_.variable(cxx::Type{tree_.kept(seen), "*", {}}, pin_name, tree_.fixed("nullptr")));
  cxx::Stmt* const given =
      line(tree_.stmt(cxx::StmtKind::ShortIf, tree_.infix(cxx::Op::Differs, pin, tree_.fixed("nullptr"))));
  given->first = tree_.stmt(cxx::StmtKind::Expression,
                            tree_.infix(cxx::Op::Assign, place, tree_.prefix("&", tree_.arrow(pin, "rung_self_"))));
  to.lend.add(given);
}

// An input, an output, or a member of a structure.
void CppFacade::addPin(const Field& field, Ex place, ObjectParts& to) {
  const std::string_view pin = tree_.kept(cppIdentifier(string(field.name)));
  const TypeId type = types_.resolve(field.type);
  if (holdsBlock(type)) {
    const Objects objects = objectsOf(pin, type, place);
    if (objects.declaration == nullptr) return;
    to.members.add(objects.declaration);
    to.initialised.push_back({pin, objects.arguments});
    return;
  }
  const std::string seen = view(type);
  if (seen.empty()) return;
  const std::string shown = field.role == FieldRole::Output ? constantOf(seen) : seen;
  to.members.add(tree_.variable(cxx::Type{tree_.kept(shown), "&", {}}, pin));
  to.initialised.push_back({pin, tree_.call("", {viewOf(seen, place)})});
}

cxx::Function* CppFacade::bodyOf(TypeId type, const ObjectParts& parts) {
  Ex call = tree_.fixed("");
  const Ex context = tree_.fixed("rung_ctx_"), self = tree_.fixed("rung_self_");
  for (const ir::Record& record : module_.records) {
    if (types_.resolve(record.type) != type || !record.body) continue;
    const ir::Body& body = module_.body(record.body);
    if (body.native) {
      group_.callees.push_back(record.body);
      call = tree_.call(ir::nativeName(module_, body), {context, tree_.prefix("&", self)});
    } else {
      if (facts_.is_inlined[record.body.index] != 0) group_.inlined.push_back(record.body);
      std::string name;
      appendFunctionName(name, module_, body);
      call = tree_.call(name, {self, context});
    }
  }
  cxx::Statements all = parts.lend;
  all.add(line(tree_.stmt(cxx::StmtKind::Expression, call)));
  all.append(parts.take_back);
  cxx::Function* const made = member("void", "Body");
  made->form = cxx::Function::Form::Lines;
  made->body = all.first();
  return made;
}

}  // namespace rung::codegen
