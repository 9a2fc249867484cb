// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/completion_offers.h"

#include <algorithm>

namespace rung::ide {
namespace {

// Of paths to what is in records and arrays.
constexpr int kMostSteps = 2;
constexpr size_t kMostPaths = 400;

}  // namespace

CompletionItem& Offers::add(std::string label, CompletionKind kind, uint8_t rank) {
  CompletionItem& item = result_.items.emplace_back();
  item.label = std::move(label);
  item.kind = kind;
  item.rank = rank;
  return item;
}

void Offers::words(std::initializer_list<const char*> list) {
  for (const char* word : list)
    if (matches(word)) add(word, CompletionKind::Keyword, kWord);
}

void Offers::partialWords(std::initializer_list<const char*> list) {
  for (const char* word : list)
    if (matches(word)) add(word, CompletionKind::Keyword, kWord).fit = Fit::Part;
}

CompletionKind Offers::kindOf(Entity entity) const {
  switch (entity.entityKind()) {
    case EntityKind::Var: {
      const sema::Var& var = project_.vars[entity.index];
      if (var.constant) return CompletionKind::Constant;
      return var.record && !var.pou ? CompletionKind::Field : CompletionKind::Variable;
    }
    case EntityKind::Pou: return kindOf(project_.pous[entity.index].kind);
    case EntityKind::Type: {
      const types::TypeKind kind = project_.types.kind({entity.index});
      if (kind == types::TypeKind::Enum) return CompletionKind::Enumeration;
      return kind == types::TypeKind::Record ? CompletionKind::Structure : CompletionKind::Type;
    }
    case EntityKind::EnumValue: return CompletionKind::Item;
    case EntityKind::Property: return CompletionKind::Property;
    case EntityKind::Program: return CompletionKind::Variable;
    case EntityKind::GlobalList:
    case EntityKind::Namespace:
    case EntityKind::None:
    case EntityKind::Error: break;
  }
  return CompletionKind::List;
}

CompletionKind Offers::kindOf(PouKind kind) {
  switch (kind) {
    case PouKind::Function: return CompletionKind::Function;
    case PouKind::Method:
    case PouKind::Action: return CompletionKind::Method;
    case PouKind::Interface: return CompletionKind::Interface;
    case PouKind::FunctionBlock:
    case PouKind::Class:
    case PouKind::Program: break;
  }
  return CompletionKind::Block;
}

std::string Offers::keyOf(Entity entity) const {
  if (entity.entityKind() == EntityKind::EnumValue)
    return "e" + std::to_string(project_.enum_values[entity.index].type.index);
  if (entity.entityKind() != EntityKind::Var)
    return "x" + std::to_string(static_cast<int>(entity.entityKind())) + "." + std::to_string(entity.index);
  const sema::Var& var = project_.vars[entity.index];
  const char where = !var.pou ? 'g' : var.pou == cursor_.pou ? 'o' : 'm';
  return std::string{'v', where} + (var.constant ? "c" : "") + (var.external ? "x" : "") +
         std::to_string(static_cast<int>(var.section)) + "." + std::to_string(static_cast<int>(var.access)) + "." +
         (hasPragmas(var) ? std::to_string(entity.index) : "") + "." +
         std::to_string(project_.types.resolve(var.type).index);
}

void Offers::addEntity(NameId name, Entity entity, uint8_t rank) {
  CompletionItem& item = add(text(name), kindOf(entity), rank);
  item.entity = entity;
  item.fit = Fit::Tried;
  item.key = keyOf(entity);
  if (const TypeId type = scope_.typeOf(entity); type && entity.entityKind() != EntityKind::Type)
    item.detail = project_.types.toString(type);
  const bool is_called = item.kind == CompletionKind::Function || item.kind == CompletionKind::Method;
  if (is_called && !followsParenthesis()) {
    item.is_snippet = true;
    is_open_ = false;
    item.insert = callSnippet(item.label, {entity.index}) + (isStatement() ? ";" : "");
    if (is_open_) item.fit = Fit::Part;
  } else if (isStatement()) {
    assign(item, scope_.typeOf(entity), 1);
  }
}

void Offers::assign(CompletionItem& item, TypeId type, int place) const {
  const std::string value = defaults_.literalOf(type);
  if (value.empty()) return;
  item.insert =
      (item.insert.empty() ? item.label : item.insert) + " := ${" + std::to_string(place) + ":" + value + "};";
  item.is_snippet = true;
}

std::string Offers::callSnippet(const std::string& callee, PouId pou) {
  std::vector<VarId> pins = scope_.pinsOf(pou);
  std::erase_if(pins, [&](VarId pin) { return project_.var(pin).section == SectionKind::Output; });
  const bool is_named = project_.pou(pou).kind != PouKind::Function || pins.size() > 3;
  std::string out = callee + "(";
  uint32_t place = 0;
  for (const VarId pin : pins) {
    std::string value = defaults_.argumentFor(pin);
    if (value.empty() && is_named) continue;
    if (value.empty()) is_open_ = true;
    if (value.empty()) value = text(project_.var(pin).name);
    if (place++ > 0) out += ", ";
    if (is_named) out += text(project_.var(pin).name) + " := ";
    out += "${" + std::to_string(place) + ":" + value + "}";
  }
  return out + ")";
}

bool Offers::followsParenthesis() const {
  return cursor_.offset < cursor_.source.size() && cursor_.source[cursor_.offset] == '(';
}

bool Offers::fits(TypeId type) const {
  if (!context_.expected || !type) return false;
  if (project_.types.resolve(type) == project_.types.resolve(context_.expected)) return true;
  const types::TypeKind wanted = project_.types.kind(context_.expected), kind = project_.types.kind(type);
  if (wanted == types::TypeKind::Enum || kind == types::TypeKind::Enum) return false;
  const types::TypeKind plain = project_.types.plainKind(type),
                        plain_wanted = project_.types.plainKind(context_.expected);
  return plain == plain_wanted && types::TypeTable::isElementary(plain);
}

bool Offers::canBe(TypeId type) const {
  const types::TypeKind kind = project_.types.plainKind(type), wanted = project_.types.plainKind(context_.expected);
  if (!types::TypeTable::isElementary(kind) || !types::TypeTable::isElementary(wanted))
    return project_.types.resolve(type) == project_.types.resolve(context_.expected);
  return kind == wanted || (types::TypeTable::isNumber(kind) && types::TypeTable::isNumber(wanted)) ||
         types::categoryOf(kind) == types::categoryOf(wanted);
}

bool Offers::isOfChart(Entity entity) const {
  return entity.entityKind() == EntityKind::Var && project_.vars[entity.index].of_chart;
}

bool Offers::isHidden(NameId name, Entity entity) const {
  const std::string_view written = view_.names().string(name);
  if ((isMade(written) && isOfChart(entity)) || written.find("__") != std::string_view::npos) return true;
  if (entity.entityKind() == EntityKind::GlobalList) {
    const FileRange at = view_.bytesInFile(project_.global_lists[entity.index].loc, 1);
    return !at || !view_.sources().displayPath(at.file).starts_with('/');
  }
  if (entity.entityKind() == EntityKind::Var && project_.vars[entity.index].list && isInternal(entity)) return true;
  if (entity.entityKind() != EntityKind::Var || !isDrawn(project_.vars[entity.index].pou)) return false;
  const sema::Var& var = project_.vars[entity.index];
  return !var.of_chart && !sameIdentifier(view_.sources().tokenAt(var.loc), written);
}

bool Offers::isDrawn(PouId pou) const {
  const DeclId decl = pou ? project_.pou(pou).decl : DeclId{};
  return decl && view_.tree().kind(decl) == DeclKind::Pou && view_.tree().as<PouDecl>(decl).body_kind != BodyKind::St;
}

uint8_t Offers::rankOf(Entity entity) const {
  if (fits(scope_.typeOf(entity)) && entity.entityKind() != EntityKind::Type) return kFits;
  if (entity.entityKind() == EntityKind::Property) return kMember;
  if (entity.entityKind() != EntityKind::Var) return kDeclared;
  const sema::Var& var = project_.vars[entity.index];
  if (!var.pou) return kGlobal;
  return var.pou == cursor_.pou ? kLocal : kMember;
}

bool Offers::isInternal(Entity entity) const {
  const FileRange at = view_.bytesInFile(scope_.locOf(entity), 1);
  if (!at || view_.sources().displayPath(at.file).starts_with('/')) return false;
  return libraries_.find(view_.names().string(scope_.nameOf(entity)), project_.options.dialect) == nullptr;
}

bool Offers::isFollowedBy(std::string_view signs) const {
  const size_t at = cursor_.source.find_first_not_of(" \t", cursor_.offset);
  return at != std::string_view::npos && signs.find(cursor_.source[at]) != std::string_view::npos;
}

void Offers::leadOn(const std::string& label, const std::string& insert, Entity entity, TypeId type,
                    const std::string& key, uint8_t rank, int depth) {
  if (!clause_ || depth > kMostSteps || paths_ >= kMostPaths || isFollowedBy(".[^(#")) return;
  const types::TypeInfo& info = project_.types.info(project_.types.resolve(type));
  if (info.kind == types::TypeKind::Array) {
    if (info.dimensions.empty()) return;
    std::string index, places;
    for (const types::Dimension& dimension : info.dimensions) {
      const std::string low = std::to_string(dimension.low);
      index += (index.empty() ? "" : ", ") + low;
      places += (places.empty() ? "" : ", ") + ("${" + std::to_string(++place_) + ":" + low + "}");
    }
    addStep(label + "[" + index + "]", insert + "[" + places + "]", {}, info.base, key + "[]", rank, depth);
    return;
  }
  const EntityKind kind = entity.entityKind();
  const bool is_list = kind == EntityKind::GlobalList || kind == EntityKind::Program;
  if (is_list ? !needsPath(entity) : kind == EntityKind::Pou || !scope_.hasMembers(type)) return;
  std::unordered_set<uint32_t> seen;
  const auto use = [&](NameId name, Entity member) {
    if (member.entityKind() != EntityKind::Var && member.entityKind() != EntityKind::Property) return;
    if (isHidden(name, member) || (isOfChart(entity) && isMade(view_.names().string(name)))) return;
    if (!seen.insert(view_.names().key(name).index).second) return;
    addStep(label + "." + text(name), insert + "." + text(name), member, scope_.typeOf(member), key + keyOf(member),
            rank, depth);
  };
  if (is_list)
    scope_.membersOf(entity, use);
  else
    scope_.membersOf(type, use);
}

bool Offers::needsPath(Entity list) const {
  if (list.entityKind() == EntityKind::GlobalList) return project_.global_lists[list.index].qualified_only;
  return project_.instances[list.index].program != cursor_.pou;
}

void Offers::addStep(const std::string& label, const std::string& insert, Entity entity, TypeId type,
                     const std::string& key, uint8_t rank, int depth) {
  const bool is_value = !context_.expected || canBe(type);
  if (is_value && matches(label) && paths_ < kMostPaths) {
    ++paths_;
    CompletionItem& item = add(label, CompletionKind::Field, fits(type) ? uint8_t{kFits} : rank);
    item.fit = Fit::Tried;
    item.key = key;
    item.entity = entity;
    item.detail = project_.types.toString(type);
    if (insert != label) {
      item.insert = insert;
      item.is_snippet = true;
    }
    if (isStatement()) assign(item, type, place_ + 1);
  }
  leadOn(label, insert, entity, type, key, rank, depth + 1);
}

void Offers::items(TypeId type, bool needs_name) {
  const TypeId of = project_.types.resolve(type);
  if (project_.types.kind(of) != types::TypeKind::Enum) return;
  const std::string type_name = project_.types.toString(of);
  scope_.membersOf(Entity::of(EntityKind::Type, of.index), [&](NameId name, Entity entity) {
    const Entity alone = scope_.lookUp(cursor_.pou, view_.names().key(name));
    const bool is_qualified =
        needs_name && (alone.entityKind() != EntityKind::EnumValue || alone.index != entity.index);
    const std::string label = (is_qualified ? type_name + "#" : std::string()) + text(name);
    if (!matches(label) && !matches(text(name))) return;
    CompletionItem& item = add(label, CompletionKind::Item, kFits);
    item.entity = entity;
    item.detail = type_name;
    item.fit = Fit::Tried;
    item.key = (is_qualified ? "#" : "") + keyOf(entity);
  });
}

void Offers::ofLibrary(std::string_view library) {
  for (const LibraryName& name : libraries_.all())
    if (sameIdentifier(name.library, library) && matches(name.name)) addLibraryName(name);
}

bool Offers::isWhole(std::string_view library) {
  if (library_files_.empty())
    for (const sema::LibraryFile& file : project_.options.libraries) ++library_files_[file.library];
  return library_files_[library] >= libraries_.filesOf(library);
}

void Offers::addLibraryName(const LibraryName& name) {
  const LibraryUse& use = libraries_.useOf(name);
  const CompletionKind kinds[] = {CompletionKind::Function, CompletionKind::Block, CompletionKind::Interface,
                                  CompletionKind::Type, CompletionKind::Constant};
  CompletionItem& item = add(std::string(name.name), kinds[static_cast<size_t>(use.kind)], kLibrary);
  item.detail = name.library;
  item.library = &name;
  const bool is_member = context_.writes == Writes::Member && clause_;
  if (use.kind == LibraryKind::Function) libraryFunction(item, use);
  if (!is_member || item.fit == Fit::Part) return;
  item.fit = Fit::Tried;
  item.key = "l" + item.label;
  item.tried.clear();
  item.is_tried_in_copy = true;
}

// A call whose inputs are literals of their types. It is good where a literal of the type of its result is.
void Offers::libraryFunction(CompletionItem& item, const LibraryUse& use) const {
  if (use.is_for_tests && !isInTest()) item.fit = Fit::Part;
  if (followsParenthesis()) {
    if (!takesArguments(use.pins, use.is_extensible)) item.fit = Fit::Part;
    if (item.fit != Fit::Part && clause_) {
      item.fit = Fit::Tried;
      item.key = "l" + item.label;
      item.is_tried_in_copy = true;
    }
    return;
  }
  item.is_snippet = true;
  item.insert = use.call.empty() ? item.label + "($1)" : use.call;
  if (use.call.empty()) item.fit = Fit::Part;
  if (isStatement()) {
    item.insert += ';';
  } else if (clause_ && item.fit != Fit::Part) {
    item.fit = use.result.empty() ? Fit::Part : Fit::Tried;
    item.key = "l" + use.result;
    item.tried = use.result;
  }
}

bool Offers::takesArguments(const std::vector<std::string>& pins, bool is_extensible) const {
  Scanner scanner(cursor_.source);
  scanner.moveTo(cursor_.offset);
  size_t count = 0, depth = 0;
  std::string_view last;
  for (Unit unit = scanner.nextCode(); unit.kind != UnitKind::End; unit = scanner.nextCode()) {
    const std::string_view text = scanner.textOf(unit);
    if (text == ";") break;
    if (text == "(") ++depth;
    if (depth == 1 && (text == "(" || text == ",")) ++count;
    if (text == ")" && last == "(" && depth == 1) count = 0;
    if (text == ")" && --depth == 0) break;
    const char next = unit.end < cursor_.source.size() ? cursor_.source[unit.end] : '\0';
    const bool is_sign = (text == ":" && next == '=') || (text == "=" && next == '>');
    const auto is_pin = [&](const std::string& pin) { return sameIdentifier(pin, last); };
    if (depth == 1 && is_sign && std::none_of(pins.begin(), pins.end(), is_pin)) return false;
    last = text;
  }
  return is_extensible || count <= pins.size();
}

bool Offers::isInTest() const {
  if (!cursor_.pou) return false;
  const sema::Pou::Pragmas& pragmas = project_.pou(cursor_.pou).pragmas;
  return pragmas.test || pragmas.test_only || pragmas.replaces;
}

}  // namespace rung::ide
