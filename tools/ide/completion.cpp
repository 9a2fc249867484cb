// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/completion.h"

#include <algorithm>
#include <unordered_set>

#include "frontend/source/scanner.h"
#include "frontend/syntax/keywords.h"
#include "frontend/syntax/sfc.h"
#include "sema/declarations/libraries.h"
#include "tools/ide/clause.h"
#include "tools/ide/completion_context.h"
#include "tools/ide/completion_trial.h"
#include "tools/ide/completion_words.h"
#include "tools/ide/default_values.h"
#include "tools/ide/hover.h"
#include "tools/ide/keywords.h"
#include "tools/ide/notation.h"
#include "tools/ide/open_blocks.h"
#include "tools/ide/signature.h"
#include "tools/ide/symbols.h"

namespace rung::ide {
namespace {

// The order of items: what fits the expected type, then what is near.
enum Rank : uint8_t { kFits, kPin, kLocal, kMember, kGlobal, kDeclared, kWord, kLibrary };

struct WordSnippet {
  const char* word;
  const char* snippet;
};
constexpr WordSnippet kStatements[] = {
    {"IF", "IF ${1:TRUE} THEN\n\t$0\nEND_IF;"},
    {"CASE", "CASE ${1:0} OF\n\t${2:1}:\n\t\t$0\nEND_CASE;"},
    {"WHILE", "WHILE ${1:FALSE} DO\n\t$0\nEND_WHILE;"},
    {"REPEAT", "REPEAT\n\t$0\nUNTIL ${1:TRUE}\nEND_REPEAT;"},
    {"RETURN", "RETURN;"},
};
constexpr WordSnippet kElsif[] = {{"ELSIF", "ELSIF ${1:TRUE} THEN\n\t$0"}};
constexpr WordSnippet kInLoops[] = {{"EXIT", "EXIT;"}, {"CONTINUE", "CONTINUE;"}};
constexpr WordSnippet kDeclarations[] = {
    {"PROGRAM", "PROGRAM ${1:Main}\nVAR\n\t$2\nEND_VAR\n$0\nEND_PROGRAM"},
    {"FUNCTION_BLOCK", "FUNCTION_BLOCK ${1:Block}\nVAR_INPUT\n\t$2\nEND_VAR\n$0\nEND_FUNCTION_BLOCK"},
    {"FUNCTION", "FUNCTION ${1:Compute} : ${2:INT}\nVAR_INPUT\n\t$3\nEND_VAR\n$0\nEND_FUNCTION"},
    {"TYPE", "TYPE ${1:Name} :\n\t$0\nEND_TYPE"},
    {"VAR_GLOBAL", "VAR_GLOBAL\n\t$0\nEND_VAR"},
    {"INTERFACE", "INTERFACE ${1:IName}\n$0\nEND_INTERFACE"},
    {"CLASS", "CLASS ${1:Name}\n$0\nEND_CLASS"},
    {"NAMESPACE", "NAMESPACE ${1:Name}\n$0\nEND_NAMESPACE"},
    {"CONFIGURATION",
     "CONFIGURATION ${1:Plant}\n\tTASK ${2:fast}(INTERVAL := ${3:T#10ms}, PRIORITY := 1);\n\t"
     "PROGRAM ${4:main} WITH ${2:fast} : ${5:Main};\nEND_CONFIGURATION"},
};
constexpr WordSnippet kSections[] = {
    {"VAR", "VAR\n\t$0\nEND_VAR"},
    {"VAR_INPUT", "VAR_INPUT\n\t$0\nEND_VAR"},
    {"VAR_OUTPUT", "VAR_OUTPUT\n\t$0\nEND_VAR"},
    {"VAR_IN_OUT", "VAR_IN_OUT\n\t$0\nEND_VAR"},
    {"VAR_TEMP", "VAR_TEMP\n\t$0\nEND_VAR"},
    {"VAR_EXTERNAL", "VAR_EXTERNAL\n\t$0\nEND_VAR"},
};
constexpr WordSnippet kMembers[] = {
    {"METHOD", "METHOD ${1:Name} : ${2:BOOL}\n$0\nEND_METHOD"},
    {"PROPERTY", "PROPERTY ${1:Name} : ${2:INT}\nGET\n\t$0\nEND_GET\nEND_PROPERTY"},
};
constexpr WordSnippet kTypes[] = {
    {"ARRAY", "ARRAY[${1:0}..${2:9}] OF ${3:INT}"},
    {"POINTER TO", "POINTER TO ${1:INT}"},
    {"REFERENCE TO", "REFERENCE TO ${1:INT}"},
};

std::string closingOf(std::string_view word) { return "END_" + upper(word); }

// After the name of an instance: a call with its pins.
constexpr std::string_view kCall = "(…)";

// Of paths to what is in records and arrays.
constexpr int kMostSteps = 2;
constexpr size_t kMostPaths = 400;

class Completer {
 public:
  Completer(const View& view, const LibraryIndex& libraries, const Cursor& cursor)
      : view_(view),
        libraries_(libraries),
        cursor_(cursor),
        scope_(view.meanings().scope()),
        project_(scope_.project()),
        context_(contextAt(view, cursor)),
        defaults_(view, cursor.pou) {
    if (!context_.is_in_body || !cursor.pou) return;
    if (isInNotation(view, cursor))
      notation_ = notationAt(view, cursor);
    else
      clause_ = clauseAround(view, cursor, context_);
  }

  const std::optional<Clause>& clause() const { return clause_; }
  bool writesType() const { return context_.writes == Writes::Type; }

  Completion complete() {
    if (notation_ && context_.writes != Writes::Address) {
      inNotation();
      return std::move(result_);
    }
    switch (context_.writes) {
      case Writes::Nothing: break;
      case Writes::Member: members(); break;
      case Writes::Item: items(context_.base.type, false); break;
      case Writes::Address: addresses(); break;
      case Writes::Declaration: snippets(kDeclarations, CompletionKind::Snippet); break;
      case Writes::Configuration:
        words({"RESOURCE", "TASK", "PROGRAM", "VAR_GLOBAL", "END_RESOURCE", "END_CONFIGURATION"});
        break;
      case Writes::Program: programs(); break;
      case Writes::Location: words({"AT"}); break;
      case Writes::Section: words({"CONSTANT", "RETAIN", "PERSISTENT", "NON_RETAIN", "END_VAR"}); break;
      case Writes::Variable: words({"END_VAR"}); break;
      case Writes::Type: types(); break;
      case Writes::Header: header(); break;
      case Writes::Statement: statement(); break;
      case Writes::Expression: expression(); break;
      case Writes::Operator: operators(); break;
    }
    return std::move(result_);
  }

 private:
  bool matches(std::string_view name) const { return cursor_.prefix.empty() || matchScore(name, cursor_.prefix) > 0; }
  std::string text(NameId name) const { return std::string(view_.names().string(name)); }

  CompletionItem& add(std::string label, CompletionKind kind, uint8_t rank) {
    CompletionItem& item = result_.items.emplace_back();
    item.label = std::move(label);
    item.kind = kind;
    item.rank = rank;
    return item;
  }

  // ---- words

  void words(std::initializer_list<const char*> list) {
    for (const char* word : list)
      if (matches(word)) add(word, CompletionKind::Keyword, kWord);
  }
  // Words that need more to be a program.
  void partialWords(std::initializer_list<const char*> list) {
    for (const char* word : list)
      if (matches(word)) add(word, CompletionKind::Keyword, kWord).fit = Fit::Part;
  }
  template <size_t count>
  void snippets(const WordSnippet (&list)[count], CompletionKind kind) {
    for (const WordSnippet& row : list) {
      if (!matches(row.word)) continue;
      CompletionItem& item = add(row.word, kind, kWord);
      item.insert = row.snippet;
      item.is_snippet = true;
    }
  }

  // ---- entities

  CompletionKind kindOf(Entity entity) const {
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
  static CompletionKind kindOf(PouKind kind) {
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

  // Names of one key are good at the same places.
  std::string keyOf(Entity entity) const {
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

  bool hasPragmas(const sema::Var& var) const { return var.decl && !view_.tree().decl(var.decl).pragmas.empty(); }

  void addEntity(NameId name, Entity entity, uint8_t rank) {
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

  // The beginning of a statement of which nothing follows.
  bool isStatement() const { return clause_ && clause_->is_begin && clause_->ends_here; }

  // A value that is written to.
  void assign(CompletionItem& item, TypeId type, int place) const {
    const std::string value = defaults_.literalOf(type);
    if (value.empty()) return;
    item.insert =
        (item.insert.empty() ? item.label : item.insert) + " := ${" + std::to_string(place) + ":" + value + "};";
    item.is_snippet = true;
  }

  // Arguments for the inputs and in-outs, by position where a function has few of them. An argument is left out where
  // nothing can be written for it.
  std::string callSnippet(const std::string& callee, PouId pou) {
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

  bool followsParenthesis() const {
    return cursor_.offset < cursor_.source.size() && cursor_.source[cursor_.offset] == '(';
  }

  // Whether a value of one type can be where another is expected, roughly: what the check would refuse surely is out.
  bool fits(TypeId type) const {
    if (!context_.expected || !type) return false;
    if (project_.types.resolve(type) == project_.types.resolve(context_.expected)) return true;
    const types::TypeKind wanted = project_.types.kind(context_.expected), kind = project_.types.kind(type);
    if (wanted == types::TypeKind::Enum || kind == types::TypeKind::Enum) return false;
    const types::TypeKind plain = project_.types.plainKind(type),
                          plain_wanted = project_.types.plainKind(context_.expected);
    return plain == plain_wanted && types::TypeTable::isElementary(plain);
  }

  // What the place takes, each name once: the first that is found hides the others.
  template <class Test, class Use>
  void visible(Test isTaken, Use use) {
    std::unordered_set<uint32_t> seen;
    scope_.visible(cursor_.pou, [&](NameId name, Entity entity) {
      if (isHidden(name, entity)) return;
      if (!matches(view_.names().string(name)) || !isTaken(entity)) return;
      if (seen.insert(view_.names().key(name).index).second) use(name, entity);
    });
  }

  // What a chart has beside its steps: `_belt`, `sfc_entered`.
  static bool isMade(std::string_view name) {
    return name.starts_with('_') || sameIdentifier(name.substr(0, 4), "sfc_");
  }
  bool isOfChart(Entity entity) const {
    return entity.entityKind() == EntityKind::Var && project_.vars[entity.index].of_chart;
  }
  // Not written by anybody: instances of boxes without a name, lists of globals in libraries.
  bool isHidden(NameId name, Entity entity) const {
    const std::string_view written = view_.names().string(name);
    if (isMade(written) && isOfChart(entity)) return true;
    if (entity.entityKind() == EntityKind::GlobalList) {
      const FileRange at = view_.bytesInFile(project_.global_lists[entity.index].loc, 1);
      return !at || !view_.sources().displayPath(at.file).starts_with('/');
    }
    if (entity.entityKind() == EntityKind::Var && project_.vars[entity.index].list && isInternal(entity)) return true;
    if (entity.entityKind() != EntityKind::Var || !isDrawn(project_.vars[entity.index].pou)) return false;
    const sema::Var& var = project_.vars[entity.index];
    return !var.of_chart && !sameIdentifier(view_.sources().tokenAt(var.loc), written);
  }
  bool isDrawn(PouId pou) const {
    const DeclId decl = pou ? project_.pou(pou).decl : DeclId{};
    return decl && view_.tree().kind(decl) == DeclKind::Pou && view_.tree().as<PouDecl>(decl).body_kind != BodyKind::St;
  }

  uint8_t rankOf(Entity entity) const {
    if (fits(scope_.typeOf(entity)) && entity.entityKind() != EntityKind::Type) return kFits;
    if (entity.entityKind() == EntityKind::Property) return kMember;
    if (entity.entityKind() != EntityKind::Var) return kDeclared;
    const sema::Var& var = project_.vars[entity.index];
    if (!var.pou) return kGlobal;
    return var.pou == cursor_.pou ? kLocal : kMember;
  }

  // `|#Green`
  bool hasItemAfter(Entity type) const {
    if (project_.types.kind({type.index}) != types::TypeKind::Enum) return false;
    const size_t begin = cursor_.source.find('#', cursor_.offset) + 1;
    size_t end = begin;
    while (end < cursor_.source.size() && isNameCharacter(cursor_.source[end])) ++end;
    const NameId name = view_.names().find(cursor_.source.substr(begin, end - begin));
    return name && scope_.memberOf(type, view_.names().key(name));
  }

  // A value, or what leads to one: an instance, a list of globals, a type of enumerations.
  bool isInExpression(Entity entity) const {
    if (isFollowedBy("#"))
      return entity.entityKind() == EntityKind::Type && !isInternal(entity) && hasItemAfter(entity);
    switch (entity.entityKind()) {
      case EntityKind::Pou: {
        const sema::Pou& pou = project_.pous[entity.index];
        return !pou.pragmas.test && (pou.kind == PouKind::Method || pou.kind == PouKind::Function) &&
               (pou.result || pou.kind == PouKind::Function);
      }
      case EntityKind::Type: return project_.types.kind({entity.index}) == types::TypeKind::Enum;
      case EntityKind::Var:
      case EntityKind::EnumValue:
      case EntityKind::GlobalList:
      case EntityKind::Program:
      case EntityKind::Property: return true;
      case EntityKind::Namespace:
      case EntityKind::None:
      case EntityKind::Error: break;
    }
    return false;
  }

  bool isInTest() const {
    if (!cursor_.pou) return false;
    const sema::Pou::Pragmas& pragmas = project_.pou(cursor_.pou).pragmas;
    return pragmas.test || pragmas.test_only || pragmas.replaces;
  }

  // Declared in a library, which does not give the name to others.
  bool isInternal(Entity entity) const {
    const FileRange at = view_.bytesInFile(scope_.locOf(entity), 1);
    if (!at || view_.sources().displayPath(at.file).starts_with('/')) return false;
    return libraries_.find(view_.names().string(scope_.nameOf(entity)), project_.options.dialect) == nullptr;
  }

  bool isType(Entity entity) const {
    if (isInternal(entity)) return false;
    if (entity.entityKind() != EntityKind::Pou) return entity.entityKind() == EntityKind::Type;
    const sema::Pou& pou = project_.pous[entity.index];
    if ((pou.pragmas.test_only || pou.pragmas.replaces) && !isInTest()) return false;
    return pou.record && pou.kind != PouKind::Program;
  }

  // What a statement may begin with.
  bool isInStatement(Entity entity) const {
    const EntityKind kind = entity.entityKind();
    if (kind == EntityKind::EnumValue || kind == EntityKind::Type) return false;
    if (kind == EntityKind::Var) return !project_.vars[entity.index].constant;
    if (kind == EntityKind::Pou) {
      const PouKind pou = project_.pous[entity.index].kind;
      if (pou == PouKind::Program || pou == PouKind::Action) return true;
    }
    return isInExpression(entity);
  }

  // ---- after a sign

  void members() {
    std::unordered_set<uint32_t> seen;
    const auto use = [&](NameId name, Entity entity) {
      if (!seen.insert(view_.names().key(name).index).second || !matches(view_.names().string(name))) return;
      addEntity(name, entity, kMember);
      leadOn(text(name), text(name), entity, scope_.typeOf(entity), keyOf(entity), kMember, 1);
    };
    if (context_.base.entity)
      scope_.membersOf(context_.base.entity, use);
    else
      scope_.membersOf(context_.base.type, use);
    if (result_.items.empty()) ofLibrary(context_.base_name);
  }

  // What a path may go on with.
  bool isFollowedBy(std::string_view signs) const {
    const size_t at = cursor_.source.find_first_not_of(" \t", cursor_.offset);
    return at != std::string_view::npos && signs.find(cursor_.source[at]) != std::string_view::npos;
  }

  // The values in a record, an array or through a pointer: `pump.on`, `list[0].y`. `insert` has places to fill in.
  void leadOn(const std::string& label, const std::string& insert, Entity entity, TypeId type, const std::string& key,
              uint8_t rank, int depth) {
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

  // Whose variables are not known by their names alone.
  bool needsPath(Entity list) const {
    if (list.entityKind() == EntityKind::GlobalList) return project_.global_lists[list.index].qualified_only;
    return project_.instances[list.index].program != cursor_.pou;
  }

  void addStep(const std::string& label, const std::string& insert, Entity entity, TypeId type, const std::string& key,
               uint8_t rank, int depth) {
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

  // Of the kind that is expected.
  bool canBe(TypeId type) const {
    const types::TypeKind kind = project_.types.plainKind(type), wanted = project_.types.plainKind(context_.expected);
    if (!types::TypeTable::isElementary(kind) || !types::TypeTable::isElementary(wanted))
      return project_.types.resolve(type) == project_.types.resolve(context_.expected);
    return kind == wanted || (types::TypeTable::isNumber(kind) && types::TypeTable::isNumber(wanted)) ||
           types::categoryOf(kind) == types::categoryOf(wanted);
  }

  // `Standard.TON`
  void ofLibrary(std::string_view library) {
    for (const LibraryName& name : libraries_.all())
      if (sameIdentifier(name.library, library) && matches(name.name)) addLibraryName(name);
  }

  // Those of an enumeration; with its name where the item alone would mean something else.
  void items(TypeId type, bool needs_name) {
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

  void addresses() {
    for (const types::MemoryArea& area : project_.options.areas)
      for (const char size : {'X', 'B', 'W', 'D', 'L'}) {
        const std::string label = std::string{area.letter, size} + (size == 'X' ? "0.0" : "0");
        if (matches(label)) add(label, CompletionKind::Key, kWord).detail = "%" + label;
      }
  }

  // ---- declarations

  void types() {
    for (const Word& word : ide::words())
      if (word.kind == WordKind::Type && matches(word.spelling))
        add(std::string(word.spelling), CompletionKind::Type, kDeclared);
    snippets(kTypes, CompletionKind::Snippet);
    visible([&](Entity entity) { return isType(entity); },
            [&](NameId name, Entity entity) { addEntity(name, entity, kGlobal); });
    libraryNames([](std::string_view word) {
      return word == "FUNCTION_BLOCK" || word == "TYPE" || word == "CLASS" || word == "INTERFACE";
    });
  }

  void programs() {
    const auto isProgram = [&](Entity entity) {
      return entity.entityKind() == EntityKind::Pou && project_.pous[entity.index].kind == PouKind::Program;
    };
    visible(isProgram, [&](NameId name, Entity entity) { addEntity(name, entity, kGlobal); });
  }

  void header() {
    words({"EXTENDS", "IMPLEMENTS"});
    snippets(kSections, CompletionKind::Keyword);
  }

  // ---- statements

  void statement() {
    following_ = followingOf(cursor_);
    const Branches branches = branchesAt(cursor_, context_);
    const bool is_in_case = sameIdentifier(innermostBlock(), "CASE");
    if (is_in_case && !branches.is_in_else) caseLabels(branches);
    if (is_in_case && ((!branches.has_label && !branches.is_in_else) || only_constants_)) return;
    visible([&](Entity entity) { return isInStatement(entity); },
            [&](NameId name, Entity entity) {
              const uint8_t rank = rankOf(entity);
              addEntity(name, entity, rank);
              if (entity.entityKind() == EntityKind::Var) call(name, entity);
              leadOn(text(name), text(name), entity, scope_.typeOf(entity), keyOf(entity), rank, 1);
            });
    if (!clause_ || clause_->ends_here) {
      snippets(kStatements, CompletionKind::Snippet);
      if (matches("FOR")) {
        const std::string variable = defaults_.variableOf(types::kInt);
        CompletionItem& item = add("FOR", CompletionKind::Snippet, kWord);
        item.insert = "FOR ${1:" + (variable.empty() ? "i" : variable) + "} := ${2:0} TO ${3:9} DO\n\t$0\nEND_FOR;";
        item.is_snippet = true;
        if (variable.empty()) item.fit = Fit::Part;
      }
      closers(branches);
    }
    libraryNames([](std::string_view word) { return word == "FUNCTION"; });
  }

  // The call of an instance with its pins.
  void call(NameId name, Entity entity) {
    const PouId block = scope_.blockOf(scope_.recordOf(scope_.typeOf(entity)));
    if (!block || project_.pou(block).kind != PouKind::FunctionBlock || !isStatement()) return;
    CompletionItem& item = add(text(name) + std::string(kCall), CompletionKind::Snippet, kLocal);
    item.is_snippet = true;
    item.detail = project_.types.toString(scope_.typeOf(entity));
    item.entity = Entity::of(EntityKind::Pou, block.index);
    item.insert = callSnippet(text(name), block) + ";";
    item.fit = Fit::Tried;
    item.key = keyOf(entity) + "()";
  }

  std::string_view innermostBlock() const {
    return context_.blocks.empty() ? std::string_view() : cursor_.text(context_.blocks.back());
  }

  // The values of the selector, between CASE and OF, that it has no branch for yet.
  void caseLabels(const Branches& branches) {
    const size_t first = result_.items.size();
    for (size_t at = context_.blocks.back() + 1; at < cursor_.units.size(); ++at)
      if (sameIdentifier(cursor_.text(at), "OF")) {
        items(valueBefore(view_, cursor_, at).type, true);
        break;
      }
    const bool is_label = isFollowedBy(":,.");
    only_constants_ = is_label;
    std::erase_if(result_.items, [&](const CompletionItem& item) {
      const std::string name = upper(item.label.substr(item.label.rfind('#') + 1));
      return std::find(branches.labels.begin(), branches.labels.end(), name) != branches.labels.end();
    });
    for (size_t at = first; at < result_.items.size() && !is_label; ++at) {
      CompletionItem& item = result_.items[at];
      item.fit = clause_ && clause_->ends_here ? Fit::Whole : Fit::Part;
      item.insert = item.label + ":\n\t$0";
      item.is_snippet = true;
    }
  }

  void closers(const Branches& branches) {
    const std::string_view block = innermostBlock();
    const bool is_in_loop = std::any_of(context_.blocks.begin(), context_.blocks.end(), [&](size_t unit) {
      return !sameIdentifier(cursor_.text(unit), "IF") && !sameIdentifier(cursor_.text(unit), "CASE");
    });
    if (is_in_loop) snippets(kInLoops, CompletionKind::Keyword);
    if (sameIdentifier(block, "IF") && !branches.is_in_else) snippets(kElsif, CompletionKind::Keyword);
    const bool has_else = sameIdentifier(block, "IF") || sameIdentifier(block, "CASE");
    if (has_else && !branches.is_in_else && !following_.has_branch) words({"ELSE"});
    if (sameIdentifier(block, "REPEAT") && following_.closed < context_.blocks.size()) partialWords({"UNTIL"});
    if (!block.empty()) {
      const std::string closing = closingOf(block);
      if (matches(closing) && following_.closed < context_.blocks.size())
        add(closing, CompletionKind::Keyword, kWord).insert = closing + ";";
      return;
    }
    closersOfPou();
  }

  void closersOfPou() {
    if (!context_.has_body) snippets(kSections, CompletionKind::Keyword);
    if (!cursor_.pou) return;
    const PouKind kind = project_.pou(cursor_.pou).kind;
    const bool has_methods = kind == PouKind::FunctionBlock || kind == PouKind::Class || kind == PouKind::Interface;
    if (has_methods && (!context_.has_body || !following_.has_statement)) snippets(kMembers, CompletionKind::Snippet);
    if (const std::string closing = closingOf(keywordOf(kind)); matches(closing) && !following_.closes_pou)
      add(closing, CompletionKind::Keyword, kWord);
  }

  // ---- charts and networks

  void inNotation() {
    const Notation& at = *notation_;
    const auto use = [&](NameId name, Entity entity) { addWhole(name, entity); };
    context_.expected = at.expected;
    switch (at.place) {
      case NotationPlace::None: return;
      case NotationPlace::Step: return visible([&](Entity entity) { return isStep(entity); }, use);
      case NotationPlace::Action:
        context_.expected = types::kBool;
        return visible(
            [&](Entity entity) {
              const bool is_var = entity.entityKind() == EntityKind::Var && !isStep(entity);
              return isAction(entity) ||
                     (is_var && fits(scope_.typeOf(entity)) && !project_.vars[entity.index].constant);
            },
            use);
      case NotationPlace::Value:
      case NotationPlace::Target:
        clause_ = at.clause;
        if (context_.writes == Writes::Member) return members();
        context_.needs = at.place == NotationPlace::Target ? Needs::Lvalue : Needs::Any;
        return expression();
      case NotationPlace::Callee: return callees();
      case NotationPlace::Instance:
        return visible(
            [&](Entity entity) {
              return entity.entityKind() == EntityKind::Var && at.callee &&
                     scope_.blockOf(scope_.recordOf(scope_.typeOf(entity))) == at.callee;
            },
            use);
      case NotationPlace::Pin: return pinsOfBox(true);
      case NotationPlace::Output: return pinsOfBox(false);
    }
  }

  // A name that needs no trial.
  void addWhole(NameId name, Entity entity) {
    CompletionItem& item = add(text(name), kindOf(entity), kLocal);
    item.entity = entity;
  }

  bool isStep(Entity entity) const {
    if (entity.entityKind() != EntityKind::Var || !project_.vars[entity.index].of_chart) return false;
    const PouId pou = project_.vars[entity.index].pou;
    const DeclId decl = pou ? project_.pou(pou).decl : DeclId{};
    if (!decl || view_.tree().kind(decl) != DeclKind::Pou) return false;
    const auto steps = view_.tree().list(view_.tree().as<PouDecl>(decl).steps);
    return std::any_of(steps.begin(), steps.end(), [&](const SfcStep& step) {
      return view_.names().same(step.name.name, project_.vars[entity.index].name);
    });
  }
  bool isAction(Entity entity) const {
    return entity.entityKind() == EntityKind::Pou && project_.pous[entity.index].kind == PouKind::Action &&
           !isMade(view_.names().string(project_.pous[entity.index].name));
  }

  // Blocks and functions that have the pins which the box has; with an instance those whose instance it is.
  void callees() {
    const Notation& at = *notation_;
    const NameId instance = at.instance.empty() ? NameId{} : view_.names().find(at.instance);
    const Entity of = instance ? scope_.lookUp(cursor_.pou, view_.names().key(instance)) : Entity{};
    const PouId block = scope_.blockOf(scope_.recordOf(scope_.typeOf(of)));
    visible(
        [&](Entity entity) {
          if (entity.entityKind() != EntityKind::Pou) return false;
          if (block) return block.index == entity.index;
          const PouKind kind = project_.pous[entity.index].kind;
          if (kind == PouKind::Program || kind == PouKind::Interface || !at.instance.empty()) return false;
          return std::all_of(at.given.begin(), at.given.end(),
                             [&](const std::string& pin) { return hasPin({entity.index}, pin); });
        },
        [&](NameId name, Entity entity) { addWhole(name, entity); });
  }
  bool hasPin(PouId pou, std::string_view name) const {
    if (sameIdentifier(name, "EN") || sameIdentifier(name, "ENO")) return true;
    const std::vector<VarId> pins = scope_.pinsOf(pou);
    return std::any_of(pins.begin(), pins.end(),
                       [&](VarId pin) { return sameIdentifier(view_.names().string(project_.var(pin).name), name); });
  }

  // Those of a box that it does not show yet, or its outputs.
  void pinsOfBox(bool is_list) {
    const Notation& at = *notation_;
    const bool is_signed = isFollowedBy(":=");
    for (const VarId pin : scope_.pinsOf(at.callee)) {
      const std::string name = text(project_.var(pin).name);
      const bool is_output = project_.var(pin).section == SectionKind::Output;
      const bool is_given = is_list && std::any_of(at.given.begin(), at.given.end(), [&](const std::string& given) {
                              return sameIdentifier(given, name);
                            });
      if (is_given || !matches(name) || (is_list ? is_signed && is_output != at.is_output : !is_output)) continue;
      CompletionItem& item = add(name, CompletionKind::Pin, kPin);
      item.entity = Entity::of(EntityKind::Var, pin.index);
      item.detail = project_.types.toString(project_.var(pin).type);
      if (is_list && !is_signed) item.fit = Fit::Part;
    }
  }

  // ---- expressions

  void expression() {
    const bool is_argument = context_.call && context_.call->is_at_beginning;
    if (is_argument) pins(*context_.call);
    if (isPinFollowing()) return;  // the name of a pin or of a field
    items(context_.expected, true);
    const auto isListed = [&](Entity entity) {  // by items()
      return entity.entityKind() == EntityKind::EnumValue && context_.expected &&
             scope_.typeOf(entity) == project_.types.resolve(context_.expected);
    };
    visible([&](Entity entity) { return !isListed(entity) && isInExpression(entity) && mayFit(entity); },
            [&](NameId name, Entity entity) {
              const uint8_t rank = rankOf(entity);
              addEntity(name, entity, rank);
              leadOn(text(name), text(name), entity, scope_.typeOf(entity), keyOf(entity), rank, 1);
            });
    if (context_.needs != Needs::Any) return;
    const types::TypeKind wanted = project_.types.plainKind(context_.expected);
    if (!context_.expected || wanted == types::TypeKind::Bool)
      for (const char* word : {"TRUE", "FALSE"})
        if (matches(word)) {
          CompletionItem& item = add(word, CompletionKind::Keyword, kWord);
          item.fit = Fit::Tried;
          item.key = word;
        }
    if (!context_.expected || wanted == types::TypeKind::Bool || types::TypeTable::isBits(wanted))
      partialWords({"NOT"});
    libraryNames([](std::string_view word) { return word == "FUNCTION"; });
  }

  // What has members may lead to a value that fits.
  bool mayFit(Entity entity) const {
    const types::TypeKind kind = project_.types.plainKind(scope_.typeOf(entity));
    const bool is_plain = types::TypeTable::isElementary(kind);
    const bool is_var = entity.entityKind() == EntityKind::Var;
    const bool is_item = entity.entityKind() == EntityKind::EnumValue;
    if (context_.needs == Needs::Lvalue && (!is_var || project_.vars[entity.index].constant)) return false;
    if (context_.needs == Needs::Selector) return !is_item && (!is_plain || types::TypeTable::isInteger(kind));
    const types::TypeKind wanted = project_.types.plainKind(context_.expected);
    const bool is_value = is_var || is_item || entity.entityKind() == EntityKind::Property;
    if (!context_.expected || !is_value || !is_plain || !types::TypeTable::isElementary(wanted)) return true;
    return canBe(scope_.typeOf(entity));
  }

  // `:=` or `=>` after the cursor.
  bool isPinFollowing() const {
    const size_t at = cursor_.source.find_first_not_of(" \t", cursor_.offset);
    const std::string_view rest = at == std::string_view::npos ? std::string_view() : cursor_.source.substr(at, 2);
    return rest == ":=" || rest == "=>";
  }

  void pins(const OpenCall& call) {
    const PouId callee = calledBy(scope_, call.callee);
    if (!callee) return;
    for (const VarId pin : scope_.pinsOf(callee)) {
      const sema::Var& var = project_.var(pin);
      const std::string name = text(var.name);
      const bool is_given = std::any_of(call.given.begin(), call.given.end(),
                                        [&](std::string_view given) { return sameIdentifier(given, name); });
      if (is_given || !matches(name)) continue;
      const bool is_output = var.section == SectionKind::Output;
      const char* const sign = isPinFollowing() ? "" : is_output ? " => " : " := ";
      CompletionItem& item = add(name + sign, CompletionKind::Pin, kPin);
      item.entity = Entity::of(EntityKind::Var, pin.index);
      item.detail = project_.types.toString(var.type);
      item.fit = Fit::Tried;
      item.key = "p" + std::to_string(pin.index);
      if (isPinFollowing()) continue;
      const std::string value = is_output ? defaults_.variableOf(var.type) : defaults_.argumentFor(pin);
      item.insert = name + sign + "${1" + (value.empty() ? "" : ":") + value + "}";
      item.is_snippet = true;
    }
  }

  void operators() {
    const types::TypeKind left = project_.types.plainKind(context_.expected);
    const bool is_known = context_.expected && types::TypeTable::isElementary(left);
    if (!is_known || left == types::TypeKind::Bool) words({"AND", "OR", "XOR", "AND_THEN", "OR_ELSE"});
    if (types::TypeTable::isBits(left)) words({"AND", "OR", "XOR"});
    if (!is_known || types::TypeTable::isInteger(left)) words({"MOD"});
    const std::string_view block = innermostBlock();
    if (sameIdentifier(block, "IF")) words({"THEN"});
    if (sameIdentifier(block, "WHILE") || sameIdentifier(block, "FOR")) words({"DO"});
    if (sameIdentifier(block, "FOR")) words({"TO", "BY"});
    if (sameIdentifier(block, "CASE")) words({"OF"});
  }

  // ---- libraries

  // Those that begin as what is typed; nothing is listed before a letter is typed, there are thousands.
  template <class Test>
  void libraryNames(Test test) {
    result_.is_incomplete = true;
    if (cursor_.prefix.empty()) return;
    std::unordered_set<std::string> seen;
    for (const CompletionItem& item : result_.items) seen.insert(foldedIdentifier(item.label));
    for (const LibraryName& name : libraries_.all()) {
      if (!sameIdentifier(name.name.substr(0, cursor_.prefix.size()), cursor_.prefix)) continue;
      if ((name.standards & sema::bitOf(project_.options.dialect)) == 0) continue;
      if (!test(firstWord(name.source.substr(name.begin, name.end - name.begin)))) continue;
      if (seen.insert(foldedIdentifier(name.name)).second) addLibraryName(name);
    }
  }

  void addLibraryName(const LibraryName& name) {
    const std::string word = firstWord(name.source.substr(name.begin, name.end - name.begin));
    const bool is_function = word == "FUNCTION";
    CompletionItem& item = add(std::string(name.name),
                               is_function      ? CompletionKind::Function
                               : word == "TYPE" ? CompletionKind::Type
                                                : CompletionKind::Block,
                               kLibrary);
    item.detail = name.library;
    item.library = &name;
    if (!is_function || followsParenthesis()) return;
    item.insert = std::string(name.name) + "($1)";
    item.is_snippet = true;
  }

  const View& view_;
  const LibraryIndex& libraries_;
  const Cursor& cursor_;
  const Scope& scope_;
  const sema::Project& project_;
  CompletionContext context_;
  DefaultValues defaults_;
  std::optional<Clause> clause_;      // none: not in a body
  std::optional<Notation> notation_;  // none: not in a chart or networks
  Following following_;
  bool only_constants_ = false;  // the label of a branch
  bool is_open_ = false;         // a call lacks an argument
  size_t paths_ = 0;
  int place_ = 0;  // the last place to fill in
  Completion result_;
};

bool isProjectFile(std::string_view path) { return path.ends_with("/rung.project"); }

}  // namespace

Completion completionsAt(const View& view, const LibraryIndex& libraries, FileId file, uint32_t byte,
                         CompletionTrial& trial) {
  Completion result;
  result.replaced = {file, byte, byte};
  const std::string_view text = view.textOf(file);
  while (result.replaced.begin > 0 && isNameCharacter(text[result.replaced.begin - 1])) --result.replaced.begin;
  if (isProjectFile(view.pathOf(file))) {
    addProjectKeys(text, byte, result);
    return result;
  }
  const Cursor cursor = cursorAt(view, file, byte);
  if (cursor.place == CursorPlace::Pragma) addPragmas(cursor, result);
  if (cursor.place != CursorPlace::Code) return result;
  Completer completer(view, libraries, cursor);
  Completion found = completer.complete();
  found.replaced = result.replaced;
  std::stable_sort(found.items.begin(), found.items.end(),
                   [](const CompletionItem& a, const CompletionItem& b) { return a.rank < b.rank; });
  if (completer.writesType()) tryTypes(view, cursor, found.items, trial);
  if (completer.clause()) tryItems(cursor, *completer.clause(), found.items, trial);
  sortOut(cursor, found);
  return found;
}

std::string documentationOf(const View& view, const CompletionItem& item) {
  Description description;
  if (item.entity) {
    description = describe(view, item.entity);
  } else if (item.library != nullptr) {
    if (const std::optional<PouSignature> signature = signatureOf(*item.library))
      description = {signature->declaration(), signature->documentation, {}};
  }
  if (description.declaration.empty()) return item.documentation;
  std::string out = "```iecst\n" + description.declaration + "\n```";
  if (!description.documentation.empty()) out += "\n\n" + description.documentation;
  return out + description.facts;
}

}  // namespace rung::ide
