// SPDX-License-Identifier: Apache-2.0
// Bodies in C++: the checks that rung can make before g++ reads them. The source is not changed; a word in upper case
// that names a function counts as a call (syntax manual 5.8.5), and so does a method or action of the object; `GVL.x`
// uses a global variable of the list GVL. Reports variables for which the generated facade (codegen/cpp_bodies.cpp) has
// no form.
//   passes  VAR n : INT; END_VAR {C++} n = 1; {END_C++}
//   fails   VAR_INPUT e : Either; END_VAR {C++} {END_C++}, Either a UNION          E0751
// Called by checkBody().
#include "sema/bodies/cpp_bodies.h"

#include <algorithm>

#include "sema/bodies/diagnostics.h"
#include "sema/declarations/call_graph.h"
#include "sema/declarations/names.h"
#include "sema/declarations/objects.h"
#include "sema/declarations/variables.h"
#include "sema/shorthands.h"

namespace rung::sema {

namespace {

// The reason why the facade has no form for a variable; null: it has one.
const char* whyNot(Context& context, const Var& var) {
  const types::TypeTable& types = context.types();
  const TypeId type = types.resolve(var.type);
  if (types.isOpenArray(type)) return "an open array";
  TypeId element = type;
  while (types.kind(element) == TypeKind::Array) element = types.resolve(types.info(element).base);
  const bool is_record = types.kind(element) == TypeKind::Record;
  if (is_record && types.info(element).record_kind == types::RecordKind::Union) return "a union";
  if (is_record && types.info(element).record_kind == types::RecordKind::Interface) return "an interface";
  if (var.storage == Storage::Constant && !types::TypeTable::isScalar(types.plainKind(type)) &&
      !types::TypeTable::isString(types.plainKind(type)))
    return "a constant that is not a single value";
  const bool is_pin =
      var.section == SectionKind::Input || var.section == SectionKind::Output || var.section == SectionKind::InOut;
  if (var.storage != Storage::Local || is_pin) return nullptr;
  if (is_record) return "a structure that lives for one call";
  if (var.init && (types.kind(type) == TypeKind::Array || !context.meaning(var.init).is_constant))
    return "a variable of one call whose initial value is not a single constant";
  return nullptr;
}

// A variable of a packed block: no C++ reference can be bound to it.
bool isMisaligned(Context& context, const Var& var) {
  const TypeId record = var.pou ? context.symbols.pou(var.pou).record : TypeId{};
  if (var.storage != Storage::Field || !record || var.bits.is_bit) return false;
  const types::TypeTable& types = context.types();
  TypeId element = types.resolve(var.type);
  while (types.kind(element) == TypeKind::Array) element = types.resolve(types.info(element).base);
  const types::Field& field = types.info(record).fields[var.field];
  return types.kind(element) != TypeKind::Record && types.fieldAlign(field) < types.info(element).align;
}

// Forbids C++ bodies of a block, and of its methods, whose variables are less aligned than their types.
//   fails   {attribute 'pack_mode' := '1'} FUNCTION_BLOCK F VAR n : INT; END_VAR {C++} …      E0751
void checkPackedObject(Context& context) {
  for (PouId at = objectOf(context); at; at = context.symbols.pou(at).base) {
    for (const VarId id : context.symbols.pou(at).vars) {
      const Var& var = context.symbols.var(id);
      if (!var.name || !isMisaligned(context, var)) continue;
      context.report(diag::CppVariable, var.loc,
                     {string(context, var.name), "aligned to less than its type by the attribute `pack_mode`"});
      return;
    }
  }
}

bool isWordChar(char c) { return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_'; }
bool isLower(char c) { return c >= 'a' && c <= 'z'; }

bool noteMentionInCpp(Context& context, PouId callee, Loc loc) {
  std::vector<PouId>& calls = context.symbols.pou(context.pou).cpp.calls;
  if (std::find(calls.begin(), calls.end(), callee) != calls.end()) return false;
  calls.push_back(callee);
  resolvePou(context, callee);
  noteCall(context, callee, loc);
  return true;
}

// A method or action of the current object, in the spelling of its declaration.
bool noteMember(Context& context, std::string_view word, Loc loc) {
  const PouId object = objectOf(context);
  const NameId name = context.names().find(word);
  if (!object || !name) return false;
  const Entity found = findInObject(context, object, name);
  if (found.entityKind() != EntityKind::Pou || found.index == context.pou.index) return false;
  const PouId member{found.index};
  if (string(context, context.symbols.pou(member).name) != word) return false;
  if ((context.symbols.pou(member).object.modifiers & kAbstract) == 0) noteMentionInCpp(context, member, loc);
  return true;
}

// `GVL.speed`, in the spelling of its declaration; `at`: after the name of the list. The end of the member, or `at`.
size_t noteGlobal(Context& context, ListId list, std::string_view text, size_t at, Loc loc) {
  const auto skipBlanks = [&] {
    while (at < text.size() && (text[at] == ' ' || text[at] == '\t')) ++at;
  };
  const size_t before = at;
  skipBlanks();
  if (at == text.size() || text[at] != '.') return before;
  ++at;
  skipBlanks();
  const size_t begin = at;
  while (at < text.size() && (isWordChar(text[at]) || isLower(text[at]))) ++at;
  const std::string_view word = text.substr(begin, at - begin);
  const NameId name = context.names().find(word);
  if (!name) return at;
  const Entity found = lookUpIn(context, Entity::of(EntityKind::GlobalList, list.index), name);
  if (found.entityKind() != EntityKind::Var) return at;
  const VarId id{found.index};
  const Var& var = context.symbols.var(id);
  std::vector<VarId>& known = context.symbols.pou(context.pou).cpp.globals;
  if (string(context, var.name) != word || std::find(known.begin(), known.end(), id) != known.end()) return at;
  if (!var.type || context.types().kind(var.type) == types::TypeKind::Error) return at;
  if (const char* why = whyNot(context, var)) {
    context.report(diag::CppVariable, Loc{loc.offset + static_cast<uint32_t>(begin)}, {word, why});
  } else {
    known.push_back(id);
  }
  return at;
}

// A name after `.`, `->` or `::` belongs to what is before it.
bool isQualified(std::string_view text, size_t at) {
  while (at > 0 && (text[at - 1] == ' ' || text[at - 1] == '\t')) --at;
  if (at == 0) return false;
  const char before = text[at - 1];
  return before == '.' ||
         (at > 1 && ((before == '>' && text[at - 2] == '-') || (before == ':' && text[at - 2] == ':')));
}

// The offset after a comment or literal that begins at `at`; `at`: none does.
size_t skipOpaque(std::string_view text, size_t at) {
  const std::string_view rest = text.substr(at);
  const auto after = [&](std::string_view end) {
    const size_t found = text.find(end, at + 2);
    return found == std::string_view::npos ? text.size() : found + end.size();
  };
  if (rest.starts_with("//")) return after("\n");
  if (rest.starts_with("/*")) return after("*/");
  if (rest[0] != '"' && rest[0] != '\'') return at;
  for (size_t i = at + 1; i < text.size() && text[i] != '\n'; ++i) {
    if (text[i] == '\\')
      ++i;
    else if (text[i] == rest[0])
      return i + 1;
  }
  return at + 1;
}

void noteNames(Context& context, std::string_view text, Loc loc) {
  for (size_t i = 0; i < text.size();) {
    const size_t begin = i;
    while (i < text.size() && (isWordChar(text[i]) || isLower(text[i]))) ++i;
    if (i != begin && text[begin] <= '9' && i < text.size() && text[i] == '\'') ++i;  // 1'000
    if (i == begin) {
      i = std::max(skipOpaque(text, i), i + 1);
      continue;
    }
    const std::string_view word = text.substr(begin, i - begin);
    if (noteMember(context, word, Loc{loc.offset + static_cast<uint32_t>(begin)})) continue;
    const bool may_be_function = word[0] >= 'A' && word[0] <= 'Z' && std::none_of(word.begin(), word.end(), isLower);
    const NameId name = may_be_function ? context.names().intern(word) : context.names().find(word);
    if (!name) continue;
    const Entity found = lookUp(context, name);
    if (found.entityKind() == EntityKind::GlobalList && !isQualified(text, begin) &&
        string(context, context.symbols.global_lists[found.index].name) == word) {
      i = noteGlobal(context, ListId{found.index}, text, i, loc);
      continue;
    }
    if (!may_be_function || found.entityKind() != EntityKind::Pou || found.index == context.pou.index) continue;
    const PouId function{found.index};
    const Pou& callee = context.symbols.pou(function);
    if (callee.kind != PouKind::Function || callee.generic || callee.pragmas.operator_kind != OperatorKind::None)
      continue;
    noteMentionInCpp(context, function, Loc{loc.offset + static_cast<uint32_t>(begin)});
  }
}

}  // namespace

void checkCppBody(Context& context, const PouDecl& decl) {
  const Pou& pou = context.symbols.pou(context.pou);
  for (const VarId id : pou.vars) {
    const Var* var = &context.symbols.var(id);
    const Var& named = *var;
    if (var->external) var = &context.symbols.var(var->external);
    if (!named.name || !var->type || context.types().kind(var->type) == TypeKind::Error) continue;
    if (const char* why = whyNot(context, *var))
      context.report(diag::CppVariable, named.loc, {string(context, named.name), why});
  }
  checkPackedObject(context);
  const std::string_view text = context.symbols.sources.sourceText(pou.file);
  const uint32_t base = context.symbols.sources.begin(pou.file).offset;
  const Loc begin{decl.body_begin.offset + 5};
  noteNames(context, text.substr(begin.offset - base, decl.body_end.offset - 9 - begin.offset), begin);
}

}  // namespace rung::sema
