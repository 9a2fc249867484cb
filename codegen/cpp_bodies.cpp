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
using types::RecordKind;
using types::TypeInfo;
using types::TypeKind;
using types::TypeTable;

namespace {

constexpr uint64_t kMaxBlocks = 256;  // of an array: each gets an object

std::string mangled(std::string_view name) {
  std::string out;
  appendMangled(out, name);
  return out;
}

class Writer {
 public:
  Writer(const ir::Module& module, const EmitOptions& options, const Facts& facts, const ir::CppBody& cpp)
      : module_(module),
        types_(module.types),
        options_(options),
        facts_(facts),
        cpp_(cpp),
        body_(module.body(cpp.body)) {}

  CppFile write() {
    Group& group = file_.group;
    group.stem = "cpp_" + fileStem(string(body_.name));
    group.bodies.push_back(cpp_.body);
    if (body_.self) need(body_.self);
    for (const Local& local : body_.locals) need(local.type);
    splitSource(cpp_.source, cpp_.loc, source_);
    splitSource(cpp_.file_source, cpp_.file_loc, file_source_);
    for (const ir::BodyId function : cpp_.functions) declareFunction(function);
    const std::string variables = this->variables();
    group.code += "\nnamespace {\n\nusing namespace rung::cpp;\n" + times() + definitions_;
    // Internal to this file: two POUs may define the same name.
    if (!cpp_.file_source.empty()) group.code += "\n" + file_source_ + "\n#line 1 \"" + group.stem + ".cpp\"\n";
    group.code += "\n}  // namespace\n\n// ";
    group.code += string(body_.spelling);
    group.code += '\n';
    appendSignature(group.code, module_, body_);
    group.code += " {\n  [[maybe_unused]] rung_context* const rung_ctx_ = ctx;\n" + running() + names_ + "  {\n" +
                  fields_ + "  {\n" + variables + "    [&]() -> void {\n" + source_ + "\n    }();\n" + ending_ +
                  "  }\n  }\n}\n";
    return std::move(file_);
  }

 private:
  std::string_view string(NameId name) const { return module_.names.string(name); }
  const TypeInfo& info(TypeId type) const { return types_.info(types_.resolve(type)); }
  bool isString(TypeId type) const { return TypeTable::isString(types_.plainKind(type)); }
  bool isBlock(TypeId type) const {
    return types_.kind(type) == TypeKind::Record && (info(type).record_kind == RecordKind::FunctionBlock);
  }

  // True for types that need an object, which knows its context: a block, and a structure with blocks inside.
  bool holdsBlock(TypeId type) const {
    type = elementOf(types_, type);
    if (types_.kind(type) != TypeKind::Record || isBlock(type)) return isBlock(type);
    const std::vector<Field>& fields = info(type).fields;
    return info(type).record_kind == RecordKind::Struct &&
           std::any_of(fields.begin(), fields.end(), [&](const Field& field) { return holdsBlock(field.type); });
  }

  // Notes that the file needs the definition of a record.
  void need(TypeId type) {
    type = elementOf(types_, type);
    std::vector<TypeId>& records = file_.group.records;
    if (types_.kind(type) == TypeKind::Record && std::find(records.begin(), records.end(), type) == records.end())
      records.push_back(type);
  }

  // For messages about a body that crashes or does not end.
  std::string running() const {
    if (!options_.counts_steps) return {};
    const std::string where = std::string(module_.sources.path(body_.file)) + '\n' +
                              std::to_string(module_.sources.location(cpp_.loc).line) + '\n' +
                              std::string(string(body_.spelling));
    std::string out = "  const rung::cpp::Running rung_running_(ctx, ";
    appendQuoted(out, where);
    return out + ");\n";
  }

  // A preprocessor directive, `include`; empty: not a directive.
  static std::string_view directiveOf(std::string_view row) {
    const auto blanks = [&] {
      const size_t first = row.find_first_not_of(" \t");
      row.remove_prefix(std::min(first, row.size()));
    };
    blanks();
    if (!row.starts_with('#')) return {};
    row.remove_prefix(1);
    blanks();
    return row.substr(0, std::min(row.find_first_of(" \t\r<\"(!"), row.size()));
  }
  static bool isCondition(std::string_view directive) {
    return directive.starts_with("if") || directive.starts_with("el") || directive == "endif";
  }

  // Copies a source with its lines kept. #include lines go to the front of the file, and where conditions surround one
  // of them, a copy of these too.
  void splitSource(std::string_view source, Loc loc, std::string& out) {
    if (source.empty()) return;
    const SourceLocation location = module_.sources.location(loc);
    std::string path;
    appendQuoted(path, module_.sources.path(body_.file));
    const auto lineDirective = [&](std::string& to, uint32_t line) {
      to += "#line ";
      appendUnsigned(to, line);
      to += ' ' + path + '\n';
    };
    std::vector<std::string_view> rows;
    for (size_t at = 0; at <= source.size();) {
      const size_t end = std::min(source.find('\n', at), source.size());
      rows.push_back(source.substr(at, end - at));
      at = end + 1;
    }
    bool is_nested = false;
    uint32_t depth = 0;
    for (const std::string_view row : rows) {
      const std::string_view directive = directiveOf(row);
      if (directive.starts_with("if")) ++depth;
      if (directive == "endif" && depth > 0) --depth;
      is_nested = is_nested || (directive == "include" && depth > 0);
    }
    bool continues = false, moves = false, copies = false;
    for (size_t i = 0; i < rows.size(); ++i) {
      const uint32_t line = location.line + static_cast<uint32_t>(i);
      if (i == 0) {
        lineDirective(out, line);
        out.append(location.column - 1, ' ');
      } else {
        out += '\n';
      }
      if (!continues) {
        const std::string_view directive = directiveOf(rows[i]);
        moves = directive == "include";
        copies = is_nested && isCondition(directive);
      }
      if (moves || copies) {
        if (!continues) lineDirective(file_.front, line);
        file_.front += std::string(rows[i]) + '\n';
      }
      if (!moves) out += rows[i];
      continues = (moves || copies) && rows[i].ends_with('\\');
    }
  }

  // ---- types

  // The C++ type that the body uses; empty: not accessible from C++.
  std::string view(TypeId type) {
    type = types_.resolve(type);
    const TypeInfo& of = types_.info(type);
    if (of.kind == TypeKind::Enum && of.name) return named(type);
    if (isString(type)) {
      const TypeId plain = types_.resolve(type);
      const TypeKind kind = types_.plainKind(plain);
      std::string out = kind == TypeKind::WString   ? "WideString<"
                        : kind == TypeKind::UString ? "Utf8String<"
                                                    : "String<";
      appendUnsigned(out, info(plain).length);
      return out + ">";
    }
    if (of.kind == TypeKind::Array) {
      const std::string element = holdsBlock(type) ? "" : view(of.base);
      if (element.empty()) return {};
      std::string out = "Array<" + element;
      for (const types::Dimension& dimension : of.dimensions) {
        out += '[';
        appendUnsigned(out, dimension.count());
        out += ']';
      }
      return out + ">";
    }
    if (of.kind == TypeKind::Record)
      return of.record_kind == RecordKind::Struct && !holdsBlock(type) ? named(type) : "";
    if (of.kind == TypeKind::Pointer || of.kind == TypeKind::Reference) return "void*";
    return typeKindName(types_, type) + 5;  // RUNG_INT
  }

  // The C++ type of a located variable: its bytes lie at any address.
  std::string located(TypeId type) {
    type = types_.resolve(type);
    const TypeInfo& of = types_.info(type);
    if (of.kind == TypeKind::Array) {
      std::string out = "Array<" + located(of.base);
      for (const types::Dimension& dimension : of.dimensions) {
        out += '[';
        appendUnsigned(out, dimension.count());
        out += ']';
      }
      return out + ">";
    }
    const std::string seen = view(type);
    if (of.kind == TypeKind::Record) return locatedStructure(type, seen);
    const bool is_bytes = of.size == 1 || (isString(type) && types_.plainKind(type) != TypeKind::WString);
    if (is_bytes) return seen;
    return (of.kind == TypeKind::Enum && of.name ? "LocatedEnum<" : "Located<") + seen + ">";
  }

  // The members of the structure `seen` without alignment; those that overlap an earlier one are not shown.
  std::string locatedStructure(TypeId type, const std::string& seen) {
    const std::string name = seen + "_located";
    for (const TypeId known : located_)
      if (known == type) return name;
    located_.push_back(type);
    std::string fields;
    uint32_t at = 0, gaps = 0;
    const auto addGap = [&](uint32_t end) {
      if (end <= at) return;
      fields += "  unsigned char rung_gap";
      appendUnsigned(fields, gaps++);
      fields += "_[";
      appendUnsigned(fields, end - at);
      fields += "];\n";
      at = end;
    };
    const TypeInfo& of = info(type);
    for (const Field& field : of.fields) {
      const std::string_view field_name = string(field.name);
      if (view(field.type).empty() || field_name.empty() || mangled(field_name) != std::string(field_name) + "_" ||
          field.offset < at)
        continue;
      addGap(field.offset);
      fields += "  " + located(field.type) + ' ' + cppIdentifier(field_name) + ";\n";
      at += info(field.type).size;
    }
    addGap(of.size);
    definitions_ += "\nstruct RUNG_MAY_ALIAS " + name + " {\n" + fields + "  operator " + seen +
                    "() const { return rung::cpp::bits<" + seen + ">(*this); }\n  " + name + "& operator=(const " +
                    seen + "& value) { return *this = rung::cpp::bits<" + name + ">(value); }\n};\n";
    return name;
  }

  // Defines the type, unless already known, and returns its name.
  std::string named(TypeId type) {
    for (const auto& [known, name] : named_) {
      if (known == type) return name;
    }
    std::string name = cppIdentifier(cppUpper(string(info(type).name)));
    for (size_t i = 0; i < named_.size(); ++i) {
      if (named_[i].second == name) name += '_', i = 0;
    }
    named_.push_back({type, name});
    std::string definition = info(type).kind == TypeKind::Enum ? enumeration(type, name)
                             : holdsBlock(type)                ? object(type, name)
                                                               : structure(type, name);
    definitions_ += '\n' + definition;
    return name;
  }

  std::string enumeration(TypeId type, const std::string& name) {
    const std::string scalar = scalarType(types_, type);
    std::string out = "struct RUNG_MAY_ALIAS " + name + " {\n  enum Value : " + scalar + " {";
    const char* separator = " ";
    for (const auto& [item, value] : info(type).items) {
      std::string item_name = cppIdentifier(cppUpper(string(item)));
      if (item_name == name) item_name += '_';
      out += separator + item_name + " = ";
      appendConstant(out, types_, type, static_cast<uint64_t>(value));
      separator = ", ";
    }
    return out + " };\n  Value value;\n  " + name + "() = default;\n  constexpr " + name +
           "(Value of) : value(of) {}\n  constexpr operator Value() const { return value; }\n};\n";
  }

  std::string structure(TypeId type, const std::string& name) {
    const TypeInfo& of = info(type);
    const RecordPlacement placement = placementOf(types_, type);
    std::string fields;
    const auto addGap = [&](uint32_t bytes, size_t number) {
      if (bytes == 0) return;
      fields += "  unsigned char rung_gap";
      appendUnsigned(fields, number);
      fields += "_[";
      appendUnsigned(fields, bytes);
      fields += "];\n";
    };
    for (size_t i = 0; i < of.fields.size(); ++i) {
      const Field& field = of.fields[i];
      const std::string seen = view(field.type);
      const std::string_view field_name = string(field.name);
      const bool is_plain =
          !seen.empty() && !field_name.empty() && mangled(field_name) == std::string(field_name) + "_";
      addGap(placement.members[i].gap, i);
      if (is_plain) {
        fields += "  " + (placement.members[i].before.empty() ? "" : placement.members[i].before + ' ') + seen + ' ' +
                  cppIdentifier(field_name) + placement.members[i].after + ";\n";
      } else {
        fields += "  alignas(";
        appendUnsigned(fields, std::min(types_.fieldAlign(field), of.placed_align));
        fields += ") ";
        fields += "unsigned char rung_hidden";
        appendUnsigned(fields, i);
        fields += "_[";
        appendUnsigned(fields, info(field.type).size);
        fields += "];\n";
      }
    }
    addGap(placement.gap, of.fields.size());
    std::string out = "struct RUNG_MAY_ALIAS " + name + " {\n" + fields + "};\nstatic_assert(sizeof(" + name + ") == ";
    appendUnsigned(out, of.size);
    return out + ", \"layout\");\n";
  }

  // The fields of a block and of those that it extends, each with its lvalue.
  void fieldsOf(TypeId type, const std::string& place, std::vector<std::pair<const Field*, std::string>>& out) const {
    for (const Field& field : info(type).fields) {
      const std::string own = place + '.' + mangled(string(field.name));
      if (field.role == FieldRole::Base)
        fieldsOf(types_.resolve(field.type), own, out);
      else
        out.push_back({&field, own});
    }
  }

  // The objects of a variable: `OBJECT name`, or for an array `struct { OBJECT table[2][3]; } name`; and the
  // initialiser. Empty: too many.
  struct Objects {
    std::string declaration, begin;
  };
  Objects objectsOf(const std::string& name, TypeId type, const std::string& place) {
    const TypeId element = elementOf(types_, type);
    const std::string object = named(element);
    if (element == type) return {object + ' ' + name, "(rung_ctx_, " + place + ")"};
    std::vector<std::string> places = {place};
    std::string extents;
    for (TypeId at = type; types_.kind(at) == TypeKind::Array; at = types_.resolve(info(at).base)) {
      if (at != type) return {};  // an array of arrays of blocks
      for (const types::Dimension& dimension : info(at).dimensions) {
        if (dimension.count() * places.size() > kMaxBlocks) return {};
        std::vector<std::string> next;
        extents += '[' + std::to_string(dimension.count()) + ']';
        for (const std::string& one : places) {
          for (uint64_t i = 0; i < dimension.count(); ++i) next.push_back(one + '[' + std::to_string(i) + ']');
        }
        places = std::move(next);
      }
    }
    std::string list;
    for (const std::string& one : places) list += (list.empty() ? "" : ", ") + object + "(rung_ctx_, " + one + ")";
    return {"struct {\n      " + object + " table" + extents + ";\n    } " + name, "{{" + list + "}}"};
  }

  // Inputs and outputs are references, in-outs are values that Body() passes to the block. Inner blocks are objects
  // again; an in-out that is a block is the address of such an object.
  std::string object(TypeId type, const std::string& name) {
    need(type);
    const std::string memory = recordName(types_, type);
    std::string members, init, lend, take_back;
    std::vector<std::pair<const Field*, std::string>> fields;
    fieldsOf(type, "rung_self_", fields);
    for (const auto& [known, place] : fields) {
      const Field& field = *known;
      const bool is_pin =
          field.role == FieldRole::Input || field.role == FieldRole::Output || field.role == FieldRole::InOut;
      const bool is_member = field.role == FieldRole::Member && !isBlock(type);
      if (!is_pin && !is_member) continue;
      const std::string pin = cppIdentifier(string(field.name));
      const TypeId field_type = types_.resolve(field.type);
      if (holdsBlock(field_type)) {
        if (field.role == FieldRole::InOut) {
          if (!isBlock(field_type)) continue;
          members += "  " + named(field_type) + "* " + pin + " = nullptr;\n";
          lend += "    const auto rung_before_" + pin + " = " + place + ";\n    if (" + pin + " != nullptr) " + place +
                  " = &" + pin + "->rung_self_;\n";
          take_back += "    " + place + " = rung_before_" + pin + ";\n";
          continue;
        }
        const Objects objects = objectsOf(pin, field_type, place);
        if (objects.declaration.empty()) continue;
        members += "  " + objects.declaration + ";\n";
        init += ", " + pin + objects.begin;
        continue;
      }
      const std::string seen = view(field.type);
      if (seen.empty()) continue;
      if (field.role == FieldRole::InOut) {
        members += "  " + seen + ' ' + pin + "{};\n";
        lend += "    const auto rung_before_" + pin + " = " + place + ";\n    " + place +
                " = reinterpret_cast<decltype(" + place + ")>(&" + pin + ");\n";
        take_back += "    " + place + " = rung_before_" + pin + ";\n";
        continue;
      }
      members += "  " + (field.role == FieldRole::Output ? constantOf(seen) : seen) + "& " + pin + ";\n";
      init += ", " + pin + "(rung::cpp::view<" + seen + ">(" + place + "))";
    }
    const std::string body = isBlock(type) ? bodyOf(type, lend, take_back) + methodsOf(type) : "";
    return "class " + name + " {\n public:\n  rung_context* const rung_ctx_;\n  " + memory + "& rung_self_;\n" +
           members + "  " + name + "(rung_context* ctx, " + memory + "& self) : rung_ctx_(ctx), rung_self_(self)" +
           init + " {}\n  " + name + "(const " + name + "&) = delete;\n" + body + "};\n";
  }

  std::string bodyOf(TypeId type, const std::string& lend, const std::string& take_back) {
    std::string call;
    for (const ir::Record& record : module_.records) {
      if (types_.resolve(record.type) != type || !record.body) continue;
      const ir::Body& body = module_.body(record.body);
      if (body.native) {
        file_.group.callees.push_back(record.body);
        call = ir::nativeName(module_, body) + "(rung_ctx_, &rung_self_)";
      } else {
        if (facts_.is_inlined[record.body.index] != 0) file_.group.inlined.push_back(record.body);
        appendFunctionName(call, module_, body);
        call += "(rung_self_, rung_ctx_)";
      }
    }
    return "  void Body() {\n" + lend + "    " + call + ";\n" + take_back + "  }\n";
  }

  // The methods and actions of a block and of those that it extends, by their declared names.
  std::string methodsOf(TypeId type) {
    std::string out;
    std::vector<std::string> taken;
    for (std::string place = "rung_self_"; type;) {
      for (uint32_t i = 1; i < module_.bodies.size(); ++i) {
        const ir::Body& method = module_.bodies[i];
        if (!isMethod(method) || method.abstract || types_.resolve(method.self) != type || i == cpp_.body.index)
          continue;
        const std::string name = ownName(method);
        const Call call = callOf({i}, place);
        const std::string key = name + '(' + call.parameters;
        if (!call.ok || std::find(taken.begin(), taken.end(), key) != taken.end()) continue;
        taken.push_back(key);
        out += "  " + call.result + ' ' + name + "(" + call.parameters + ") { " + call.code + " }\n";
      }
      const std::vector<Field>& fields = info(type).fields;
      const auto base =
          std::find_if(fields.begin(), fields.end(), [](const Field& field) { return field.role == FieldRole::Base; });
      if (base == fields.end()) break;
      place += '.' + mangled(string(base->name));
      type = types_.resolve(base->type);
    }
    return out;
  }

  // ---- functions

  // As declared: methods and actions are members like pins.
  std::string ownName(const ir::Body& method) const {
    const std::string_view name = string(method.spelling);
    return cppIdentifier(name.substr(name.rfind('.') + 1));
  }

  // The path from a block to one that it extends.
  std::string placeOf(const std::string& place, TypeId from, TypeId to) const {
    from = types_.resolve(from);
    if (from == types_.resolve(to)) return place;
    for (const Field& field : info(from).fields)
      if (field.role == FieldRole::Base) return placeOf(place + '.' + mangled(string(field.name)), field.type, to);
    return place;
  }

  // A function or method as the facade calls it; `self`: the lvalue of its object.
  struct Call {
    bool ok = false;
    std::string parameters, names, result, code;
  };
  Call callOf(ir::BodyId id, const std::string& self) {
    const ir::Body& function = module_.body(id);
    Call created;
    std::string arguments, lengths;
    bool ok = true;
    uint32_t count = 0;
    for (const Local& local : ir::parameters(function)) {
      const std::string seen = view(local.type);
      ok = ok && !seen.empty() && !holdsBlock(local.type);
      need(local.type);
      std::string name = "rung_p";
      appendUnsigned(name, count++);
      created.parameters += (created.parameters.empty() ? "" : ", ");
      created.names += (created.names.empty() ? "" : ", ") + name;
      if (local.kind == LocalKind::Input) {
        created.parameters += (local.by_reference ? constantOf(seen) + "& " : seen + ' ') + name;
        arguments += ", " + (local.by_reference ? pointer(local.type, "&" + name, true)
                                                : "rung::cpp::bits<" + std::string(scalarType(types_, local.type)) +
                                                      ">(" + name + ")");
      } else {
        created.parameters += seen + "* " + name;
        arguments += ", " + pointer(local.type, name, false);
        if (passesLength(module_, function, local)) {
          lengths += "uint32_t " + name + "n = RUNG_UNCOUNTED; ";
          arguments += ", &" + name + "n";
        }
      }
    }
    created.result = function.result ? view(function.result) : "void";
    if (!ok || created.result.empty()) return created;
    created.ok = true;
    if (facts_.is_inlined[id.index] != 0) {
      file_.group.inlined.push_back(id);
    } else {
      file_.group.callees.push_back(id);
    }
    std::string call;
    if (function.native) {
      call = ir::nativeName(module_, function);
    } else {
      appendFunctionName(call, module_, function);
    }
    call += self.empty() ? "(rung_ctx_" : isMethod(function) ? "(&" + self + ", rung_ctx_" : "(" + self + ", rung_ctx_";
    call += arguments;
    if (!function.result) {
      created.code = call + ");";
    } else if (!ir::isAggregate(types_, function.result)) {
      created.code = "return rung::cpp::bits<" + created.result + ">(" + call + "));";
    } else {
      need(function.result);
      created.code = created.result + " rung_result; " + call + ", " + pointer(function.result, "&rung_result", false);
      if (function.native && isString(function.result)) {
        created.code += ", ";
        appendUnsigned(created.code, info(function.result).length);
      }
      created.code += "); return rung_result;";
    }
    created.code.insert(0, lengths);
    return created;
  }

  void declareFunction(ir::BodyId id) {
    const ir::Body& function = module_.body(id);
    const Call call = callOf(id, function.self ? "rung_self_" : "");
    if (!call.ok) return;
    const std::string name = function.self ? ownName(function) : cppIdentifier(cppUpper(string(function.spelling)));
    const std::string type = "rung_function_" + name;
    std::string self;
    if (function.self) {
      need(function.self);
      self = recordName(types_, types_.resolve(function.self)) + "& rung_self_;\n  ";
    }
    definitions_ += "\nstruct " + type + " {\n  rung_context* rung_ctx_;\n  " + self + call.result + " operator()(" +
                    call.parameters + ") const { " + call.code + " }\n";
    if (!function.self) {
      definitions_ += "  " + call.result + " operator()(bool rung_en, BOOL* rung_eno" +
                      (call.parameters.empty() ? "" : ", " + call.parameters) +
                      ") const {\n    if (rung_eno != nullptr) *rung_eno = rung_en;\n    ";
      definitions_ += function.result ? "return rung_en ? (*this)(" + call.names + ") : " + call.result + "{};"
                                      : "if (rung_en) (*this)(" + call.names + ");";
      definitions_ += "\n  }\n";
    }
    definitions_ += "};\n";
    functions_ += "    const " + type + ' ' + name + "{rung_ctx_" +
                  (function.self ? ", " + placeOf("rung_self_", body_.self, function.self) : "") + "};\n";
  }

  // The address of a view, converted to the parameter type of the function.
  std::string pointer(TypeId type, const std::string& address, bool constant) {
    cxx::Tree tree;
    const std::string to = cxx::toString(pointerType(tree, types_, type, constant), "");
    return "reinterpret_cast<" + to + ">(" + address + ")";
  }

  // ---- variables

  static std::string quotedBits(const std::string& type, const std::string& value) {
    return "rung::cpp::bits<" + type + ">(" + value + ")";
  }

  std::string constant(TypeId type, uint64_t bits) {
    const std::string seen = view(type);
    std::string value;
    if (isString(type)) {
      const std::string_view of = string(NameId{static_cast<uint32_t>(bits)});
      if (types_.plainKind(type) == TypeKind::WString) {
        appendQuotedWide(value, of);
      } else {
        appendQuoted(value, of);
      }
      return seen + "(" + value + ")";
    }
    appendConstant(value, types_, type, bits);
    return quotedBits(seen, std::string(scalarType(types_, type)) + "(" + value + ")");
  }

  // The initial value of a variable of a call.
  std::string initial(NameId name, TypeId type) {
    for (const ir::CppBody::Constant& known : cpp_.initial) {
      if (known.name == name) return constant(type, known.bits);
    }
    const TypeInfo& of = info(type);
    if (of.kind == TypeKind::Enum && !of.items.empty())
      return constant(type, static_cast<uint64_t>(of.items[0].second));
    if (of.kind == TypeKind::Subrange) return constant(type, static_cast<uint64_t>(of.initial));
    return view(type) + "{}";
  }

  // Declares a name for an lvalue: a reference, the object of a block, or the objects of an array of blocks.
  std::string variable(std::string_view name, TypeId type, const std::string& place, bool constant) {
    type = types_.resolve(type);
    const std::string called = cppIdentifier(name);
    if (!holdsBlock(type)) {
      const std::string seen = view(type);
      if (seen.empty()) return {};
      return "    " + (constant ? constantOf(seen) : seen) + "& " + called + " = rung::cpp::view<" + seen + ">(" +
             place + ");\n";
    }
    const Objects objects = objectsOf(called, type, place);
    return objects.declaration.empty() ? "" : "    " + objects.declaration + objects.begin + ";\n";
  }

  // A global variable in its list.
  std::string placeOf(const ir::CppBody::Variable& known) {
    const ir::List& list = module_.lists[known.index];
    need(list.record);
    const Field& field = info(list.record).fields[known.offset];
    std::string block = "(*static_cast<" + recordName(types_, list.record) + "*>(rung_ctx_->blocks[";
    appendUnsigned(block, facts_.list_block[known.index]);
    return block + "]))." + mangled(string(field.name));
  }

  // The declaration of a name, and the initialiser of a member of an object.
  struct Declared {
    std::string declaration, member, value;
  };
  Declared locatedVariable(const ir::CppBody::Variable& known, const std::string& name) {
    std::string address = "rung_ctx_->areas[";
    appendUnsigned(address, known.index);
    address += "] + ";
    appendUnsigned(address, known.offset);
    if (known.bit != ir::kNoBit) {
      const std::string type = known.constant ? "const ConstantBit " : "const LocatedBit ";
      address += ", ";
      appendUnsigned(address, known.bit);
      return {type + name + "(" + address + ")", type + name, "{" + address + "}"};
    }
    need(known.type);
    const std::string seen = located(known.type), type = known.constant ? constantOf(seen) : seen;
    const std::string value = "*reinterpret_cast<" + type + "*>(" + address + ")";
    return {type + "& " + name + " = " + value, type + "& " + name, value};
  }

  // An object for each list of globals that the source names.
  std::string lists() {
    std::vector<NameId> names;
    const auto note = [&](NameId list) {
      if (list && std::find(names.begin(), names.end(), list) == names.end()) names.push_back(list);
    };
    for (const ir::CppBody::Variable& known : cpp_.variables) note(known.list);
    for (const ir::CppBody::Constant& known : cpp_.constants) note(known.list);
    std::string out;
    for (const NameId list : names) {
      std::string members, values;
      const auto add = [&](const std::string& member, const std::string& value) {
        members += "      " + member + ";\n";
        values += (values.empty() ? "" : ", ") + value;
      };
      for (const ir::CppBody::Variable& known : cpp_.variables) {
        if (!(known.list == list)) continue;
        const std::string name = cppIdentifier(string(known.name));
        if (known.in_image) {
          const Declared declared = locatedVariable(known, name);
          add(declared.member, declared.value);
        } else if (holdsBlock(known.type)) {
          const Objects objects = objectsOf(name, types_.resolve(known.type), placeOf(known));
          if (objects.declaration.empty()) continue;
          const bool is_one = objects.begin.front() == '(';
          add(objects.declaration, is_one ? named(types_.resolve(known.type)) + objects.begin : objects.begin);
        } else if (const std::string seen = view(known.type); !seen.empty()) {
          add((known.constant ? constantOf(seen) : seen) + "& " + name,
              "rung::cpp::view<" + seen + ">(" + placeOf(known) + ")");
        }
      }
      for (const ir::CppBody::Constant& known : cpp_.constants)
        if (known.list == list)
          add("const " + view(known.type) + ' ' + cppIdentifier(string(known.name)), constant(known.type, known.bits));
      out += "    struct {\n" + members + "    } " + cppIdentifier(string(list)) + " = {" + values + "};\n";
    }
    return out;
  }

  std::string variables() {
    std::string out;
    for (const ir::CppBody::Variable& known : cpp_.variables) {
      if (known.list) continue;
      const std::string name = cppIdentifier(string(known.name));
      std::string& to = known.of_object ? fields_ : out;
      if (known.in_image) {
        to += "    " + locatedVariable(known, name).declaration + ";\n";
      } else {
        to += variable(string(known.name), known.type, placeOf(known), known.constant);
      }
    }
    for (const ir::CppBody::Constant& known : cpp_.constants)
      if (!known.list)
        (known.of_object ? fields_ : out) += "    const " + view(known.type) + ' ' + cppIdentifier(string(known.name)) +
                                             " = " + constant(known.type, known.bits) + ";\n";
    out += lists();
    if (body_.self) {
      if (isMethod(body_)) {
        const std::string memory = recordName(types_, types_.resolve(body_.self));
        names_ += "  auto& rung_self_ = *static_cast<" + memory + "*>(object);\n";
      } else {
        names_ += "  auto& rung_self_ = self;\n";
      }
      const std::string instance = isMethod(body_) ? ownName(body_) + "__" : "";  // VAR_INST
      std::vector<std::pair<const Field*, std::string>> fields;
      fieldsOf(types_.resolve(body_.self), "rung_self_", fields);
      for (const auto& [known, place] : fields) {
        const Field& field = *known;
        const std::string_view name = string(field.name);
        if (mangled(name) != std::string(name) + "_" || name.starts_with("__")) continue;
        const bool is_const = field.role == FieldRole::Input || field.constant;
        const bool own = !instance.empty() && name.starts_with(instance);
        const std::string_view called = own ? name.substr(instance.size()) : name;
        if (field.by_reference && isString(field.type)) {
          fields_ += "    " + view(field.type) + "& " + cppIdentifier(called) + " = *reinterpret_cast<" +
                     view(field.type) + "*>(" + place + ");\n";
        } else {
          (own ? out : fields_) +=
              variable(called, field.type, field.by_reference ? "(*" + place + ")" : place, is_const);
        }
      }
    }
    uint32_t count = 0;
    for (const Local& local : body_.locals) {
      const std::string name = cppIdentifier(string(local.name)), seen = view(local.type);
      std::string passed = "rung_p";
      appendUnsigned(passed, count++);
      passed += '_';
      switch (local.kind) {
        case LocalKind::Temp: break;
        case LocalKind::Variable:
          out += "    " + seen + ' ' + name + " = " + initial(local.name, local.type) + ";\n";
          break;
        case LocalKind::Input:
          names_ += "  auto&& " + passed + " = " + mangled(string(local.name)) + ";\n";
          if (isString(local.type)) {
            out += "    const " + seen + ' ' + name + "(" + passed + ");\n";
          } else if (local.by_reference) {
            out += "    const " + seen + "& " + name + " = *reinterpret_cast<const " + seen + "*>(" + passed + ");\n";
          } else {
            out += "    const " + seen + ' ' + name + " = " + quotedBits(seen, passed) + ";\n";
          }
          break;
        case LocalKind::Output:
        case LocalKind::InOut:
          names_ += "  auto&& " + passed + " = " + mangled(string(local.name)) + ";\n";
          if (holdsBlock(local.type)) {
            out += variable(string(local.name), local.type, "(*" + passed + ")", false);
            break;
          }
          out += "    " + seen + "& " + name + " = *reinterpret_cast<" + seen + "*>(" + passed + ");\n";
          if (local.kind == LocalKind::Output) out += "    " + name + " = " + initial(local.name, local.type) + ";\n";
          break;
        case LocalKind::Result: {
          const std::string result = body_.self ? ownName(body_) : cppIdentifier(cppUpper(string(body_.spelling)));
          out += "    " + seen + ' ' + result + " = " + initial({}, local.type) + ";\n";
          if (local.by_reference) {
            names_ += "  auto&& " + passed + " = " + mangled(string(local.name)) + ";\n";
            ending_ += "    memcpy(static_cast<void*>(" + passed + "), &" + result + ", sizeof " + result + ");\n";
          } else {
            ending_ += "    return " + quotedBits(scalarType(types_, local.type), result) + ";\n";
          }
          break;
        }
      }
    }
    return functions_ + out;
  }

  // The types of time, whose C++ types depend on the dialect, and the functions that make their values. Parts go from
  // the least significant to the most significant; TIME takes a sign first.
  std::string times() const {
    std::string out = "constexpr bool TRUE = true, FALSE = false;\n";
    const std::pair<TypeKind, const char*> kinds[] = {{TypeKind::Time, "TIME"},
                                                      {TypeKind::LTime, "LTIME"},
                                                      {TypeKind::Date, "DATE"},
                                                      {TypeKind::LDate, "LDATE"},
                                                      {TypeKind::TimeOfDay, "TOD"},
                                                      {TypeKind::LTimeOfDay, "LTOD"},
                                                      {TypeKind::TimeOfDay, "TIME_OF_DAY"},
                                                      {TypeKind::DateTime, "DT"},
                                                      {TypeKind::LDateTime, "LDT"},
                                                      {TypeKind::DateTime, "DATE_AND_TIME"}};
    for (const auto& [kind, name] : kinds)
      out += std::string("using ") + name + " = " + scalarType(types_, types::idOf(kind)) + ";\n";
    return out +
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
  }

  const ir::Module& module_;
  const TypeTable& types_;
  const EmitOptions& options_;
  const Facts& facts_;
  const ir::CppBody& cpp_;
  const ir::Body& body_;
  CppFile file_;
  std::vector<std::pair<TypeId, std::string>> named_;
  std::vector<TypeId> located_;
  std::string definitions_, functions_, names_, fields_, source_, file_source_, ending_;
};

}  // namespace

CppFile writeCppBody(const ir::Module& module, const EmitOptions& options, const Facts& facts, const ir::CppBody& cpp) {
  return Writer(module, options, facts, cpp).write();
}

}  // namespace rung::codegen
