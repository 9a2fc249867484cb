// SPDX-License-Identifier: Apache-2.0
// Bodies in C++: see cpp_bodies.h. Everything is a reference into the instance (views marked may_alias), so nothing is
// copied, except in-outs of blocks, which are values (syntax manual 5.8.6). Each kind of name in the facade:
//   scalar, string, array, structure     a reference to its memory, as a type of rung/cpp.h or a view defined here
//   enumeration                          struct COLOR with its items in upper case: COLOR::RED
//   block                                an object with references to its pins, values for its in-outs, Body(), and
//                                        its methods and actions by their names
//   structure with blocks inside         an object with references to its members
//   function that the source names       an object of its name in upper case, called with or without EN and ENO
//   method or action of this object      the same, by its own name
//   located variable                     a reference to its bytes as Located<…>, which have no alignment; LocatedBit
//   list of globals that the source      an object with references to those of its variables that the source names
//   names, `GVL.speed`
//   result of a function                 a variable of the function's name in upper case; of a method, of its own name
// Inputs are const inside, outputs are const outside (5.8.6). A word in upper case that names a function counts as a
// call, as does a word that names a method or action of the object.
#include "codegen/cpp_bodies.h"

#include <algorithm>
#include <utility>

#include "codegen/cpp_facade.h"
#include "codegen/cpp_names.h"
#include "codegen/cpp_source.h"
#include "codegen/cxx/print.h"
#include "codegen/names.h"
#include "codegen/signature.h"
#include "codegen/types.h"

namespace rung::codegen {

using ir::Local;
using ir::LocalKind;
using types::Field;
using types::FieldRole;
using types::TypeInfo;
using types::TypeKind;
using types::TypeTable;

namespace {

// The functions that make the values of times. Parts go from the least significant to the most significant; TIME takes
// a sign first.
constexpr std::string_view kTimeFunctions =
    "[[maybe_unused]] inline TIME TIME_CPP(int sign, double ms, double s, double min, double h, double days) {\n"
    "  const double span = ms + s * 1e3 + min * 6e4 + h * 36e5 + days * 864e5;\n"
    "  return rung::cpp::time<TIME>(sign < 0 ? -span : span);\n}\n"
    "[[maybe_unused]] inline TOD TOD_CPP(double s, double min, double h) {\n"
    "  return rung::cpp::time<TOD>(s * 1e3 + min * 6e4 + h * 36e5);\n}\n"
    "[[maybe_unused]] inline DATE DATE_CPP(int day, int month, int year) {\n"
    "  return rung::cpp::time<DATE>(static_cast<double>(rung::cpp::days(day, month, year)) * 86400);\n}\n"
    "[[maybe_unused]] inline DT DT_CPP(double s, double min, double h, int day, int month, int year) {\n"
    "  return rung::cpp::time<DT>(s + min * 60 + h * 3600 +\n"
    "                             static_cast<double>(rung::cpp::days(day, month, year)) * 86400);\n}\n";

struct TimeName {
  TypeKind kind;
  const char* name;
};
constexpr TimeName kTimeNames[] = {{TypeKind::Time, "TIME"},
                                   {TypeKind::LTime, "LTIME"},
                                   {TypeKind::Date, "DATE"},
                                   {TypeKind::LDate, "LDATE"},
                                   {TypeKind::TimeOfDay, "TOD"},
                                   {TypeKind::LTimeOfDay, "LTOD"},
                                   {TypeKind::TimeOfDay, "TIME_OF_DAY"},
                                   {TypeKind::DateTime, "DT"},
                                   {TypeKind::LDateTime, "LDT"},
                                   {TypeKind::DateTime, "DATE_AND_TIME"}};

class Writer {
 public:
  using Ex = cxx::Ex;
  Writer(const ir::Module& module, const EmitOptions& options, const Facts& facts, const ir::CppBody& cpp)
      : module_(module),
        types_(module.types),
        options_(options),
        facts_(facts),
        cpp_(cpp),
        body_(module.body(cpp.body)),
        facade_(module, facts, cpp.body, file_.group, tree_) {}

  CppFile write() {
    Group& group = file_.group;
    group.stem = "cpp_" + fileStem(string(body_.name));
    group.bodies.push_back(cpp_.body);
    if (body_.self) facade_.need(body_.self);
    for (const Local& local : body_.locals) facade_.need(local.type);
    const std::string_view path = module_.sources.path(body_.file);
    std::string source, file_source;
    splitCppSource(cpp_.source, path, module_.sources.location(cpp_.loc), source, file_.front);
    splitCppSource(cpp_.file_source, path, module_.sources.location(cpp_.file_loc), file_source, file_.front);
    for (const ir::BodyId id : cpp_.functions)
      if (const cxx::Variable* const object = facade_.functionObject(id)) declare(functions_, object);
    addVariables();
    addLists();
    if (body_.self) addFields();
    addLocals();

    cxx::Declarations lines;
    lines.add(tree_.blank());
    lines.add(ownDefinitions(file_source));
    lines.add(tree_.blank());
    lines.add(tree_.textual(cxx::DeclKind::Comment, string(body_.spelling)));
    lines.add(function(source));
    cxx::print(group.code, tree_, lines);
    return std::move(file_);
  }

 private:
  std::string_view string(NameId name) const { return module_.names.string(name); }
  const TypeInfo& info(TypeId type) const { return types_.info(types_.resolve(type)); }
  static std::string mangled(std::string_view name) {
    std::string out;
    appendMangled(out, name);
    return out;
  }
  std::string_view keptMangled(NameId name) { return tree_.kept(mangled(string(name))); }

  // ---- the file

  // Internal to this file: two POUs may define the same name.
  cxx::Namespace* ownDefinitions(std::string_view file_source) {
    cxx::Namespace* const space = tree_.declaration<cxx::Namespace>();
    cxx::Declarations& to = space->members;
    const auto use = [&](std::string_view name, std::string_view of) {
      cxx::Using* const made = tree_.declaration<cxx::Using>();
      made->name = name;
      made->of = of;
      to.add(made);
    };
    to.add(tree_.blank());
    use("namespace rung::cpp", "");
    cxx::Variable* const truth = tree_.variable("bool", "TRUE", tree_.fixed("true"));
    truth->prefix = "constexpr";
    truth->also = tree_.variable("bool", "FALSE", tree_.fixed("false"));
    to.add(truth);
    for (const TimeName& time : kTimeNames) use(time.name, scalarType(types_, types::idOf(time.kind)));
    to.add(tree_.printed(kTimeFunctions));
    to.append(facade_.definitions());
    if (file_source.empty()) return space;
    to.add(tree_.blank());
    to.add(tree_.textual(cxx::DeclKind::Printed, std::string(file_source) + '\n'));
    to.add(tree_.textual(cxx::DeclKind::Directive, "line 1 \"" + file_.group.stem + ".cpp\""));
    return space;
  }

  // The names of the object are around those of the method and its parameters, which may hide them.
  cxx::Function* function(std::string_view source) {
    const auto block = [&](const cxx::Statements& list) {
      cxx::Stmt* const made = line(tree_.stmt(cxx::StmtKind::Lines));
      made->first = list.first();
      return made;
    };
    cxx::Statements inner = functions_;
    inner.append(variables_);
    inner.add(line(tree_.textual(cxx::StmtKind::Source, source)));
    inner.append(ending_);
    cxx::Statements fields = fields_;
    fields.add(block(inner));
    cxx::Statements all;
    cxx::Variable* const context = tree_.variable("rung_context* const", "rung_ctx_", tree_.fixed("ctx"));
    context->prefix = "[[maybe_unused]]";
    declare(all, context);
    if (options_.counts_steps) declare(all, running());
    all.append(names_);
    all.add(block(fields));
    cxx::Function* const made = signatureOf(tree_, module_, body_);
    made->form = cxx::Function::Form::Lines;
    made->body = all.first();
    return made;
  }

  // For messages about a body that crashes or does not end.
  cxx::Variable* running() {
    const std::string where = std::string(module_.sources.path(body_.file)) + '\n' +
                              std::to_string(module_.sources.location(cpp_.loc).line) + '\n' +
                              std::string(string(body_.spelling));
    cxx::Variable* const made = tree_.variable("const rung::cpp::Running", "rung_running_");
    made->arguments = tree_.call("", {tree_.fixed("ctx"), quoted(where)});
    return made;
  }

  // ---- C++

  cxx::Stmt* line(cxx::Stmt* stmt) const {
    stmt->begins = true;
    return stmt;
  }
  void declare(cxx::Statements& to, const cxx::Decl* declaration) { to.add(line(tree_.declare(declaration))); }
  cxx::Type reference(const std::string& type) { return {tree_.kept(type), "&", {}}; }
  Ex quoted(std::string_view text) {
    std::string out;
    appendQuoted(out, text);
    return tree_.name(out);
  }
  Ex dereferenced(Ex pointer) { return tree_.group(tree_.prefix("*", pointer)); }
  // The memory at an address as `type`.
  Ex memoryAs(const std::string& type, Ex address) {
    return tree_.prefix("*", tree_.call("reinterpret_cast<" + type + "*>", {address}));
  }

  Ex constant(TypeId type, uint64_t bits) {
    const std::string seen = facade_.view(type);
    std::string value;
    if (facade_.isString(type)) {
      const std::string_view of = string(NameId{static_cast<uint32_t>(bits)});
      types_.plainKind(type) == TypeKind::WString ? appendQuotedWide(value, of) : appendQuoted(value, of);
      return tree_.call(seen, {tree_.name(value)});
    }
    appendConstant(value, types_, type, bits);
    return facade_.bitsOf(seen, tree_.call(scalarType(types_, type), {tree_.name(value)}));
  }

  cxx::Variable* constantVariable(const ir::CppBody::Constant& known) {
    cxx::Variable* const made = tree_.variable(facade_.view(known.type), cppIdentifier(string(known.name)));
    made->prefix = "const";
    made->value = constant(known.type, known.bits);
    return made;
  }

  // The initial value of a variable of a call.
  Ex initial(NameId name, TypeId type) {
    for (const ir::CppBody::Constant& known : cpp_.initial)
      if (known.name == name) return constant(type, known.bits);
    const TypeInfo& of = info(type);
    if (of.kind == TypeKind::Enum && !of.items.empty())
      return constant(type, static_cast<uint64_t>(of.items[0].second));
    if (of.kind == TypeKind::Subrange) return constant(type, static_cast<uint64_t>(of.initial));
    return tree_.name(facade_.view(type) + "{}");
  }

  // A name for an lvalue: a reference, the object of a block, or the objects of an array of blocks; null: none.
  cxx::Valued* variable(std::string_view name, TypeId type, Ex place, bool is_constant) {
    type = types_.resolve(type);
    const std::string called = cppIdentifier(name);
    if (!facade_.holdsBlock(type)) {
      const std::string seen = facade_.view(type);
      if (seen.empty()) return nullptr;
      return tree_.variable(reference(is_constant ? constantOf(seen) : seen), called, facade_.viewOf(seen, place));
    }
    const CppFacade::Objects objects = facade_.objectsOf(called, type, place);
    if (objects.declaration != nullptr) objects.declaration->arguments = objects.arguments;
    return objects.declaration;
  }
  void addVariable(cxx::Statements& to, std::string_view name, TypeId type, Ex place, bool is_constant) {
    if (const cxx::Valued* const made = variable(name, type, place, is_constant)) declare(to, made);
  }

  // ---- global variables

  // A global variable in its list.
  Ex placeOf(const ir::CppBody::Variable& known) {
    const ir::List& list = module_.lists[known.index];
    facade_.need(list.record);
    const Field& field = info(list.record).fields[known.offset];
    const Ex block =
        tree_.element(tree_.arrow(tree_.fixed("rung_ctx_"), "blocks"), tree_.number(facts_.list_block[known.index]));
    const Ex memory = tree_.call("static_cast<" + recordName(types_, list.record) + "*>", {block});
    return tree_.member(tree_.prefix("*", memory), keptMangled(field.name));
  }

  cxx::Variable* locatedVariable(const ir::CppBody::Variable& known) {
    const std::string name = cppIdentifier(string(known.name));
    const Ex area = tree_.element(tree_.arrow(tree_.fixed("rung_ctx_"), "areas"), tree_.number(known.index));
    const Ex address = tree_.infix(cxx::Op::Add, area, tree_.number(known.offset));
    if (known.bit != ir::kNoBit) {
      cxx::Variable* const bit = tree_.variable(known.constant ? "const ConstantBit" : "const LocatedBit", name);
      bit->arguments = tree_.call("", {address, tree_.number(known.bit)});
      return bit;
    }
    facade_.need(known.type);
    const std::string seen = facade_.located(known.type), type = known.constant ? constantOf(seen) : seen;
    return tree_.variable(reference(type), name, memoryAs(type, address));
  }

  void addVariables() {
    for (const ir::CppBody::Variable& known : cpp_.variables) {
      if (known.list) continue;
      cxx::Statements& to = known.of_object ? fields_ : variables_;
      if (known.in_image)
        declare(to, locatedVariable(known));
      else
        addVariable(to, string(known.name), known.type, placeOf(known), known.constant);
    }
    for (const ir::CppBody::Constant& known : cpp_.constants)
      if (!known.list) declare(known.of_object ? fields_ : variables_, constantVariable(known));
  }

  // An object for each list of globals that the source names.
  void addLists() {
    std::vector<NameId> names;
    const auto note = [&](NameId list) {
      if (list && std::find(names.begin(), names.end(), list) == names.end()) names.push_back(list);
    };
    for (const ir::CppBody::Variable& known : cpp_.variables) note(known.list);
    for (const ir::CppBody::Constant& known : cpp_.constants) note(known.list);
    for (const NameId name : names) {
      cxx::Record* const list = tree_.declaration<cxx::Record>();
      list->keyword = "struct";
      list->variable = tree_.kept(cppIdentifier(string(name)));
      std::vector<Ex> values;
      for (const ir::CppBody::Variable& known : cpp_.variables)
        if (known.list == name) addListed(known, list->members, values);
      for (const ir::CppBody::Constant& known : cpp_.constants) {
        if (!(known.list == name)) continue;
        cxx::Variable* const member = constantVariable(known);
        values.push_back(std::exchange(member->value, nullptr));
        list->members.add(member);
      }
      list->value = tree_.braces(values);
      declare(variables_, list);
    }
  }

  // A member of such an object, and its value.
  void addListed(const ir::CppBody::Variable& known, cxx::Declarations& members, std::vector<Ex>& values) {
    const std::string name = cppIdentifier(string(known.name));
    cxx::Valued* member = nullptr;
    Ex value = nullptr;
    if (known.in_image) {
      member = locatedVariable(known);
      const Ex arguments = std::exchange(member->arguments, nullptr);
      value = std::exchange(member->value, nullptr);
      if (arguments != nullptr) value = tree_.braces({arguments->operands.begin(), arguments->operands.end()});
    } else if (facade_.holdsBlock(known.type)) {
      const CppFacade::Objects objects = facade_.objectsOf(name, types_.resolve(known.type), placeOf(known));
      if (objects.declaration == nullptr) return;
      member = objects.declaration;
      const std::string object = facade_.named(elementOf(types_, known.type));
      value = objects.arguments;
      if (objects.is_one) value = tree_.call(object, std::vector<Ex>(value->operands.begin(), value->operands.end()));
    } else {
      member = variable(string(known.name), known.type, placeOf(known), known.constant);
      if (member == nullptr) return;
      value = std::exchange(member->value, nullptr);
    }
    members.add(member);
    values.push_back(value);
  }

  // ---- the instance

  void addFields() {
    cxx::Variable* const self = tree_.variable(cxx::Type{"auto", "&", {}}, "rung_self_", tree_.fixed("self"));
    const std::string memory = recordName(types_, types_.resolve(body_.self));
    if (isMethod(body_))
      self->value = tree_.prefix("*", tree_.call("static_cast<" + memory + "*>", {tree_.fixed("object")}));
    declare(names_, self);
    CppFacade::FieldPlaces fields;
    facade_.fieldsOf(types_.resolve(body_.self), tree_.fixed("rung_self_"), fields);
    for (const auto& [field, place] : fields) addField(*field, place);
  }

  void addField(const Field& field, Ex place) {
    const std::string_view name = string(field.name);
    if (mangled(name) != std::string(name) + "_" || name.starts_with("__")) return;
    const std::string instance = isMethod(body_) ? facade_.ownName(body_) + "__" : "";  // VAR_INST
    const bool is_const = field.role == FieldRole::Input || field.constant;
    const bool own = !instance.empty() && name.starts_with(instance);
    const std::string_view called = own ? name.substr(instance.size()) : name;
    if (field.by_reference && facade_.isString(field.type)) {
      const std::string seen = facade_.view(field.type);
      declare(fields_, tree_.variable(reference(seen), cppIdentifier(called), memoryAs(seen, place)));
      return;
    }
    const Ex value = field.by_reference ? dereferenced(place) : place;
    addVariable(own ? variables_ : fields_, called, field.type, value, is_const);
  }

  // ---- parameters, variables and the result

  void addLocals() {
    uint32_t count = 0;
    for (const Local& local : body_.locals) {
      const std::string passed = "rung_p" + std::to_string(count++) + "_";
      switch (local.kind) {
        case LocalKind::Temp: break;
        case LocalKind::Variable:
          declare(variables_, tree_.variable(facade_.view(local.type), cppIdentifier(string(local.name)),
                                             initial(local.name, local.type)));
          break;
        case LocalKind::Input: addInput(local, passed); break;
        case LocalKind::Output:
        case LocalKind::InOut: addInOut(local, passed); break;
        case LocalKind::Result: addResult(local, passed); break;
      }
    }
  }

  // The parameter under a name that the facade does not have.
  Ex passedAs(const Local& local, const std::string& passed) {
    declare(names_, tree_.variable(cxx::Type{"auto", "&&", {}}, passed, tree_.name(mangled(string(local.name)))));
    return tree_.name(passed);
  }

  void addInput(const Local& local, const std::string& passed) {
    const Ex parameter = passedAs(local, passed);
    const std::string seen = facade_.view(local.type), name = cppIdentifier(string(local.name));
    cxx::Variable* made = nullptr;
    if (facade_.isString(local.type)) {
      made = tree_.variable(seen, name);
      made->arguments = tree_.call("", {parameter});
    } else if (local.by_reference) {
      made = tree_.variable(reference(seen), name, memoryAs("const " + seen, parameter));
    } else {
      made = tree_.variable(seen, name, facade_.bitsOf(seen, parameter));
    }
    made->prefix = "const";
    declare(variables_, made);
  }

  void addInOut(const Local& local, const std::string& passed) {
    const Ex parameter = passedAs(local, passed);
    if (facade_.holdsBlock(local.type))
      return addVariable(variables_, string(local.name), local.type, dereferenced(parameter), false);
    const std::string seen = facade_.view(local.type), name = cppIdentifier(string(local.name));
    declare(variables_, tree_.variable(reference(seen), name, memoryAs(seen, parameter)));
    if (local.kind != LocalKind::Output) return;
    const Ex value = tree_.infix(cxx::Op::Assign, tree_.name(name), initial(local.name, local.type));
    variables_.add(line(tree_.stmt(cxx::StmtKind::Expression, value)));
  }

  // A variable that is copied to the caller at the end, or returned.
  void addResult(const Local& local, const std::string& passed) {
    const std::string name = body_.self ? facade_.ownName(body_) : cppIdentifier(cppUpper(string(body_.spelling)));
    const Ex result = tree_.name(name);
    declare(variables_, tree_.variable(facade_.view(local.type), name, initial({}, local.type)));
    if (!local.by_reference) {
      ending_.add(line(tree_.stmt(cxx::StmtKind::Return, facade_.bitsOf(scalarType(types_, local.type), result))));
      return;
    }
    const Ex to = tree_.call("static_cast<void*>", {passedAs(local, passed)});
    const Ex copy = tree_.call("memcpy", {to, tree_.prefix("&", result), tree_.prefix("sizeof ", result)});
    ending_.add(line(tree_.stmt(cxx::StmtKind::Expression, copy)));
  }

  const ir::Module& module_;
  const TypeTable& types_;
  const EmitOptions& options_;
  const Facts& facts_;
  const ir::CppBody& cpp_;
  const ir::Body& body_;
  CppFile file_;
  cxx::Tree tree_;
  CppFacade facade_;
  cxx::Statements functions_, names_, fields_, variables_, ending_;
};

}  // namespace

CppFile writeCppBody(const ir::Module& module, const EmitOptions& options, const Facts& facts, const ir::CppBody& cpp) {
  return Writer(module, options, facts, cpp).write();
}

}  // namespace rung::codegen
