// SPDX-License-Identifier: Apache-2.0
// The types that a body in C++ uses for the memory of its program: see cpp_facade.h.
#include <algorithm>

#include "codegen/cpp_facade.h"
#include "codegen/cpp_names.h"
#include "codegen/names.h"
#include "codegen/types.h"

namespace rung::codegen {

using types::Field;
using types::RecordKind;
using types::TypeInfo;
using types::TypeKind;
using types::TypeTable;

void CppFacade::need(TypeId type) {
  type = elementOf(types_, type);
  std::vector<TypeId>& records = group_.records;
  if (types_.kind(type) == TypeKind::Record && std::find(records.begin(), records.end(), type) == records.end())
    records.push_back(type);
}

bool CppFacade::isString(TypeId type) const { return TypeTable::isString(types_.plainKind(type)); }

bool CppFacade::isBlock(TypeId type) const {
  return types_.kind(type) == TypeKind::Record && info(type).record_kind == RecordKind::FunctionBlock;
}

bool CppFacade::holdsBlock(TypeId type) const {
  type = elementOf(types_, type);
  if (types_.kind(type) != TypeKind::Record || isBlock(type)) return isBlock(type);
  const std::vector<Field>& fields = info(type).fields;
  return info(type).record_kind == RecordKind::Struct &&
         std::any_of(fields.begin(), fields.end(), [&](const Field& field) { return holdsBlock(field.type); });
}

std::string CppFacade::view(TypeId type) {
  type = types_.resolve(type);
  const TypeInfo& of = types_.info(type);
  if (of.kind == TypeKind::Enum && of.name) return named(type);
  if (isString(type)) {
    const TypeKind kind = types_.plainKind(type);
    const char* const name = kind == TypeKind::WString   ? "WideString<"
                             : kind == TypeKind::UString ? "Utf8String<"
                                                         : "String<";
    return name + std::to_string(of.length) + ">";
  }
  if (of.kind == TypeKind::Array) {
    const std::string element = holdsBlock(type) ? "" : view(of.base);
    return element.empty() ? "" : arrayOf(element, of);
  }
  if (of.kind == TypeKind::Record) return of.record_kind == RecordKind::Struct && !holdsBlock(type) ? named(type) : "";
  if (of.kind == TypeKind::Pointer || of.kind == TypeKind::Reference) return "void*";
  return typeKindName(types_, type) + 5;  // RUNG_INT
}

std::string CppFacade::arrayOf(const std::string& element, const TypeInfo& array) const {
  std::string out = "Array<" + element;
  for (const types::Dimension& dimension : array.dimensions) out += '[' + std::to_string(dimension.count()) + ']';
  return out + ">";
}

std::string CppFacade::located(TypeId type) {
  type = types_.resolve(type);
  const TypeInfo& of = types_.info(type);
  if (of.kind == TypeKind::Array) return arrayOf(located(of.base), of);
  std::string seen = view(type);
  if (of.kind == TypeKind::Record) return locatedStructure(type, seen);
  const bool is_bytes = of.size == 1 || (isString(type) && types_.plainKind(type) != TypeKind::WString);
  if (is_bytes) return seen;
  return (of.kind == TypeKind::Enum && of.name ? "LocatedEnum<" : "Located<") + seen + ">";
}

void CppFacade::define(cxx::Decl* definition) {
  definitions_.add(tree_.blank());
  definitions_.add(definition);
}

cxx::Record* CppFacade::alias(std::string_view name) {
  cxx::Record* const made = tree_.declaration<cxx::Record>();
  made->keyword = "struct";
  made->attributes = "RUNG_MAY_ALIAS";
  made->name = tree_.kept(name);
  return made;
}

// What the body does not see: `unsigned char name[count];`
cxx::Variable* CppFacade::bytes(std::string_view prefix, const std::string& name, uint64_t count) {
  cxx::Variable* const made = tree_.variable("unsigned char", name);
  made->prefix = tree_.kept(prefix);
  made->type.extents = tree_.copy(std::vector<uint64_t>{count});
  return made;
}

// Its name in C++ is that in the program; the runtime has the others.
static bool isShown(std::string_view name) {
  std::string mangled;
  appendMangled(mangled, name);
  return !name.empty() && mangled == std::string(name) + "_";
}

// The members of the structure `seen` without alignment; those that overlap an earlier one are not shown.
std::string CppFacade::locatedStructure(TypeId type, const std::string& seen) {
  std::string name = seen + "_located";
  if (std::find(located_.begin(), located_.end(), type) != located_.end()) return name;
  located_.push_back(type);
  cxx::Record* const record = alias(name);
  uint32_t at = 0, gaps = 0;
  const auto addGap = [&](uint32_t end) {
    if (end <= at) return;
    record->members.add(bytes("", "rung_gap" + std::to_string(gaps++) + "_", end - at));
    at = end;
  };
  for (const Field& field : info(type).fields) {
    if (view(field.type).empty() || !isShown(string(field.name)) || field.offset < at) continue;
    addGap(field.offset);
    record->members.add(tree_.variable(located(field.type), cppIdentifier(string(field.name))));
    at += info(field.type).size;
  }
  addGap(info(type).size);

  const Ex self = tree_.fixed("*this");
  cxx::Function* const value = member("", "operator " + seen);
  value->suffix = " const";
  value->body = tree_.stmt(cxx::StmtKind::Return, bitsOf(seen, self));
  record->members.add(value);
  cxx::Function* const store = member(name + "&", "operator=");
  store->parameters.add(tree_.variable(cxx::Type{tree_.kept("const " + seen), "&", {}}, "value"));
  store->body =
      tree_.stmt(cxx::StmtKind::Return, tree_.infix(cxx::Op::Assign, self, bitsOf(name, tree_.fixed("value"))));
  record->members.add(store);
  define(record);
  return name;
}

std::string CppFacade::named(TypeId type) {
  for (const auto& [known, name] : named_)
    if (known == type) return name;
  std::string name = cppIdentifier(cppUpper(string(info(type).name)));
  for (size_t i = 0; i < named_.size(); ++i)
    if (named_[i].second == name) name += '_', i = 0;
  named_.push_back({type, name});
  if (info(type).kind == TypeKind::Enum)
    define(enumeration(type, name));
  else if (holdsBlock(type))
    define(object(type, name));
  else
    structure(type, name);
  return name;
}

// A structure around the value: items are COLOR::RED, and only COLOR converts to it.
cxx::Record* CppFacade::enumeration(TypeId type, const std::string& name) {
  std::vector<cxx::Enumeration::Item> items;
  for (const auto& [item, value] : info(type).items) {
    std::string item_name = cppIdentifier(cppUpper(string(item))), constant;
    if (item_name == name) item_name += '_';
    appendConstant(constant, types_, type, static_cast<uint64_t>(value));
    items.push_back({tree_.kept(item_name), tree_.name(constant)});
  }
  cxx::Enumeration* const values = tree_.declaration<cxx::Enumeration>();
  values->name = "Value";
  values->base = scalarType(types_, type);
  values->is_line = true;
  values->items = tree_.copy(items);
  cxx::Function* const empty = member("", name);
  empty->suffix = " = default";
  empty->form = cxx::Function::Form::Prototype;
  cxx::Function* const from_value = member("", name);
  from_value->prefix = "constexpr";
  from_value->parameters.add(tree_.variable("Value", "of"));
  from_value->initialises =
      tree_.copy(std::vector<cxx::Function::Initialised>{{"value", tree_.call("", {tree_.fixed("of")})}});
  cxx::Function* const to_value = member("", "operator Value");
  to_value->prefix = "constexpr";
  to_value->suffix = " const";
  to_value->body = tree_.stmt(cxx::StmtKind::Return, tree_.fixed("value"));

  cxx::Record* const record = alias(name);
  record->members.add(values);
  record->members.add(tree_.variable("Value", "value"));
  for (cxx::Function* const function : {empty, from_value, to_value}) record->members.add(function);
  return record;
}

// The same memory as the structure of the module, with the user's names.
void CppFacade::structure(TypeId type, const std::string& name) {
  const TypeInfo& of = info(type);
  const RecordPlacement placement = placementOf(types_, type);
  cxx::Record* const record = alias(name);
  const auto addGap = [&](uint32_t count, size_t number) {
    if (count > 0) record->members.add(bytes("", "rung_gap" + std::to_string(number) + "_", count));
  };
  for (size_t i = 0; i < of.fields.size(); ++i) {
    const Field& field = of.fields[i];
    const std::string seen = view(field.type);
    addGap(placement.members[i].gap, i);
    if (seen.empty() || !isShown(string(field.name))) {
      const uint32_t align = std::min(types_.fieldAlign(field), of.placed_align);
      record->members.add(bytes("alignas(" + std::to_string(align) + ")", "rung_hidden" + std::to_string(i) + "_",
                                info(field.type).size));
      continue;
    }
    cxx::Variable* const shown = tree_.variable(seen, cppIdentifier(string(field.name)));
    shown->prefix = tree_.kept(placement.members[i].before);
    shown->suffix = tree_.kept(placement.members[i].after);
    record->members.add(shown);
  }
  addGap(placement.gap, of.fields.size());
  define(record);
  cxx::Assertion* const layout = tree_.declaration<cxx::Assertion>();
  layout->text = "layout";
  layout->condition = tree_.infix(cxx::Op::Equal, tree_.call("sizeof", {tree_.name(name)}), tree_.number(of.size));
  definitions_.add(layout);
}

}  // namespace rung::codegen
