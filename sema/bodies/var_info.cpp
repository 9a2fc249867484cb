// SPDX-License-Identifier: Apache-2.0
// __VARINFO(x), __POUNAME() and __POSITION() of codesys: compile-time facts about a variable and the source location.
// In: calls. Out: literals, and an AnyValue node with the constant members of __SYSTEM.VAR_INFO.
#include "sema/access.h"
#include "sema/bodies/addressable.h"
#include "sema/bodies/any_inputs.h"
#include "sema/bodies/diagnostics.h"
#include "sema/bodies/expressions.h"
#include "sema/bodies/names.h"
#include "sema/bodies/pseudo_functions.h"
#include "sema/declarations/libraries.h"
#include "sema/declarations/names.h"
#include "sema/declarations/objects.h"
#include "sema/declarations/resolve.h"
#include "sema/declarations/variables.h"
#include "sema/project.h"
#include "sema/shorthands.h"
#include "sema/synthesized_nodes.h"

namespace rung::sema {

namespace {

struct Facts {
  Context& context;
  Loc loc;
  TypeId record;
  std::vector<FieldInit> fields;

  TypeId typeOf(std::string_view name) const {
    const VarId member = findMember(context, record, context.names().intern(name));
    return member ? context.symbols.var(member).type : types::kError;
  }
  void add(std::string_view name, int64_t value) {
    const TypeId type = context.types().plain(typeOf(name));
    fields.push_back({{context.names().intern(name), loc}, makeInteger(context, type, value, loc)});
  }
  void add(std::string_view name, std::string_view text) {
    fields.push_back({{context.names().intern(name), loc}, makeStringLiteral(context, text, loc)});
  }
};

// The content of the `///` line above a declaration.
std::string commentOf(const Context& context, const Var& var) {
  if (!var.decl || !context.tree().decl(var.decl).doc) return {};
  const Loc doc = context.tree().decl(var.decl).doc;
  const FileId file = context.symbols.sources.fileOf(doc);
  std::string_view text = context.symbols.sources.sourceText(file);
  text.remove_prefix(doc.offset - context.symbols.sources.begin(file).offset);
  text = text.substr(0, text.find_first_of("\r\n"));
  while (!text.empty() && (text.front() == '/' || text.front() == ' ')) text.remove_prefix(1);
  return std::string(text);
}

// False: reported.
bool addLvalue(Facts& facts, ExprId lvalue) {
  Context& context = facts.context;
  int64_t bit = -1;
  if (context.tree().kind(lvalue) == ExprKind::BitAccess) {
    const BitAccessExpr& access = context.tree().as<BitAccessExpr>(lvalue);
    if (access.width == 1) bit = access.position;
    lvalue = access.base;
  }
  const Entity entity = entityOf(context, lvalue);
  int64_t offset = 0, area = -1, bit_address = 0, memory = 5;
  std::string comment;
  if (entity.entityKind() == EntityKind::Var) {
    const Var* var = &context.symbols.vars[entity.index];
    if (var->external) var = &context.symbols.var(var->external);
    comment = commentOf(context, *var);
    TypeId holder = var->record;
    if (var->pou) holder = context.symbols.pou(var->pou).record;
    if (var->list) holder = context.symbols.global_lists[var->list.index].record;
    const bool in_record = var->storage == Storage::Field || var->storage == Storage::Global;
    if (in_record && holder && !checkLayout(context, "__VARINFO", holder, context.tree().begin(lvalue))) return false;
    if (in_record && holder && ensureLayout(context, holder))
      offset = context.types().info(context.types().resolve(holder)).fields[var->field].offset;
    if (var->storage == Storage::Global) area = 0, memory = 4;
    if (var->keeping.retain) memory = 3;
    if (var->storage == Storage::Image) {
      const auto number = static_cast<int64_t>(var->image.area.index);  // I, Q, M
      area = number + 1;
      memory = number == 2 ? 0 : number + 1;
      offset = var->image.byte;
      if (var->image.is_bit) bit = var->image.bit;
      bit_address = offset * 8 + (bit < 0 ? 0 : bit);
    }
  }
  facts.add("ByteOffset", offset);
  facts.add("Area", area);
  facts.add("BitNr", bit);
  facts.add("BitAddress", bit_address);
  facts.add("MemoryArea", memory);
  facts.add("Comment", comment);
  return true;
}

void addType(Facts& facts, TypeId type, bool is_bit) {
  Context& context = facts.context;
  const auto bits = [&](TypeId of) {
    return static_cast<int64_t>(context.types().info(context.types().resolve(of)).size) * 8;
  };
  facts.add("BitSize", is_bit ? 1 : bits(type));
  facts.add("TypeClass", is_bit ? 1 : typeClassOf(context, type));  // TYPE_BIT
  facts.add("TypeName", context.types().toString(type));
  const types::TypeInfo& info = context.types().info(context.types().resolve(type));
  if (info.kind != TypeKind::Array) return;
  int64_t count = 1;
  for (const types::Dimension& dimension : info.dimensions) count *= static_cast<int64_t>(dimension.count());
  facts.add("NumElements", count);
  facts.add("BaseTypeClass", typeClassOf(context, info.base));
  facts.add("ElemBitSize", bits(info.base));
}

// The byte of the image that holds a located bit; none for other lvalues.
ExprId byteOfImage(Context& context, ExprId lvalue) {
  const Entity entity = entityOf(context, lvalue);
  if (entity.entityKind() != EntityKind::Var) return {};
  const Var* var = &context.symbols.vars[entity.index];
  if (var->external) var = &context.symbols.var(var->external);
  if (var->storage != Storage::Image || !var->image.is_bit) return {};
  const Slice<uint32_t> path = context.code().addList<uint32_t>({&var->image.byte, 1});
  const char letter = context.project.options.areas[var->image.area.index].letter;
  const DirectAddress byte{.area = letter, .size = 'B', .incomplete = false, .size_given = true, .path = path};
  return typed(context, context.build().address(byte, context.tree().loc(lvalue)), types::kByte);
}

std::string pouName(const Context& context) {
  if (!context.pou) return {};
  const Pou& pou = context.symbols.pou(context.pou);
  const std::string own(string(context, pou.name));
  return pou.owner ? std::string(string(context, context.symbols.pou(pou.owner).name)) + "." + own : own;
}

std::string position(const Context& context, Loc loc) {
  const SourceLocation location = context.symbols.sources.location(loc);
  const std::string line = "Line " + std::to_string(location.line);
  return context.body ? line + ", Column " + std::to_string(location.column) + " (Impl)" : line + " (Decl)";
}

}  // namespace

TypeId checkVarInfo(Context& context, ExprId& expr, const PseudoCall& pseudo) {
  ExprId lvalue = pseudo.arguments[0].value;
  const Loc loc = context.tree().loc(expr);
  const TypeId type = check(context, lvalue, {}, Access::Address);
  const Entity record = lookUpSystem(context, "VAR_INFO");
  if (!type || type == types::kError || record.entityKind() != EntityKind::Type) return types::kError;
  const bool is_bit = context.tree().kind(lvalue) == ExprKind::BitAccess;
  ExprId whole = lvalue;
  if (is_bit) whole = context.tree().as<BitAccessExpr>(lvalue).base;
  if (const ExprId byte = byteOfImage(context, lvalue)) whole = byte;
  if (context.types().isOpenArray(type) || !hasMemory(context, whole)) {
    context.report(diag::NotAVariable, context.tree().begin(lvalue));
    return types::kError;
  }
  if (const PouId pou = pouOf(context, type)) resolvePou(context, pou);
  const Loc begin = context.tree().begin(lvalue);
  if (!checkLayout(context, "__VARINFO", type, begin) || !ensureLayout(context, type)) return types::kError;
  const CallExpr& call = context.tree().as<CallExpr>(expr);
  const FileId file = context.symbols.sources.fileOf(begin);
  std::string_view written = context.symbols.sources.sourceText(file);
  const uint32_t base = context.symbols.sources.begin(file).offset;
  written = written.substr(begin.offset - base, call.end.offset - begin.offset);
  while (!written.empty() && (written.back() == ' ' || written.back() == ')')) written.remove_suffix(1);

  Facts facts{context, loc, TypeId{record.index}, {}};
  if (!addLvalue(facts, lvalue)) return types::kError;
  addType(facts, type, is_bit);
  facts.add("Symbol", written.substr(0, 39));
  const ExprId members = typed(context, context.build().structInit(facts.fields, loc), facts.record);
  context.replace(expr, typed(context, context.build().anyValue(whole, members, 0, loc), facts.record));
  return facts.record;
}

static TypeId putText(Context& context, ExprId& expr, std::string_view text) {
  context.replace(expr, makeStringLiteral(context, text, context.tree().loc(expr)));
  return context.type(expr);
}

TypeId checkPouName(Context& context, ExprId& expr, const PseudoCall&) {
  return putText(context, expr, pouName(context));
}

TypeId checkPosition(Context& context, ExprId& expr, const PseudoCall&) {
  return putText(context, expr, position(context, context.tree().loc(expr)));
}

}  // namespace rung::sema
