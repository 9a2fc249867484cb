// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/completion.h"

#include <algorithm>
#include <unordered_set>

#include "frontend/source/scanner.h"
#include "frontend/syntax/keywords.h"
#include "sema/declarations/libraries.h"
#include "tools/driver/project_file.h"
#include "tools/ide/completion_context.h"
#include "tools/ide/hover.h"
#include "tools/ide/keywords.h"
#include "tools/ide/pragma_words.h"
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
    {"IF", "IF ${1:condition} THEN\n\t$0\nEND_IF;"},
    {"CASE", "CASE ${1:selector} OF\n\t${2:1}:\n\t\t$0\nEND_CASE;"},
    {"FOR", "FOR ${1:i} := ${2:0} TO ${3:9} DO\n\t$0\nEND_FOR;"},
    {"WHILE", "WHILE ${1:condition} DO\n\t$0\nEND_WHILE;"},
    {"REPEAT", "REPEAT\n\t$0\nUNTIL ${1:condition}\nEND_REPEAT;"},
    {"RETURN", "RETURN;"},
};
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
constexpr const char* kSections[] = {"VAR", "VAR_INPUT", "VAR_OUTPUT", "VAR_IN_OUT", "VAR_TEMP", "VAR_EXTERNAL"};
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

// An argument `pin := ${1:pin}` for each input and in-out; by position where there are few and the callee is a
// function.
std::string callSnippet(const PouSignature& signature) {
  std::string out = signature.name + "(";
  const bool is_function = signature.kind == PouKind::Function;
  const auto inputs =
      static_cast<size_t>(std::count_if(signature.pins.begin(), signature.pins.end(),
                                        [](const SignaturePin& pin) { return pin.section != SectionKind::Output; }));
  uint32_t place = 0;
  for (const SignaturePin& pin : signature.pins) {
    if (pin.section == SectionKind::Output) continue;
    if (place++ > 0) out += ", ";
    if (!is_function || inputs > 3) out += pin.name + " := ";
    out += "${" + std::to_string(place) + ":" + pin.name + "}";
  }
  return out + ")";
}

// After the name of an instance: a call with its pins.
constexpr std::string_view kCall = "(…)";

// The places to fill in of a function, a method or the call of an instance.
void addCallSnippet(const View& view, CompletionItem& item) {
  if (!item.is_snippet || !item.insert.empty() || item.entity.entityKind() != EntityKind::Pou) return;
  PouSignature signature = signatureOf(view, {item.entity.index});
  const bool is_instance = item.label.ends_with(kCall);
  if (is_instance) signature.name = item.label.substr(0, item.label.size() - kCall.size());
  item.insert = callSnippet(signature) + (is_instance ? ";" : "");
}

class Completer {
 public:
  Completer(const View& view, const LibraryIndex& libraries, const Cursor& cursor)
      : view_(view),
        libraries_(libraries),
        cursor_(cursor),
        scope_(view.meanings().scope()),
        project_(scope_.project()),
        context_(contextAt(view, cursor)) {}

  Completion complete() {
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
  template <class List>
  void keywords(const List& list) {
    for (const char* word : list)
      if (matches(word)) add(word, CompletionKind::Keyword, kWord);
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

  void addEntity(NameId name, Entity entity, uint8_t rank) {
    CompletionItem& item = add(text(name), kindOf(entity), rank);
    item.entity = entity;
    if (const TypeId type = scope_.typeOf(entity); type && entity.entityKind() != EntityKind::Type)
      item.detail = project_.types.toString(type);
    const bool is_called = item.kind == CompletionKind::Function || item.kind == CompletionKind::Method;
    item.is_snippet = is_called && !followsParenthesis();
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
      if (!matches(view_.names().string(name)) || !isTaken(entity)) return;
      if (seen.insert(view_.names().key(name).index).second) use(name, entity);
    });
  }

  uint8_t rankOf(Entity entity) const {
    if (fits(scope_.typeOf(entity)) && entity.entityKind() != EntityKind::Type) return kFits;
    if (entity.entityKind() == EntityKind::Property) return kMember;
    if (entity.entityKind() != EntityKind::Var) return kDeclared;
    const sema::Var& var = project_.vars[entity.index];
    if (!var.pou) return kGlobal;
    return var.pou == cursor_.pou ? kLocal : kMember;
  }

  // A value, or what leads to one: an instance, a list of globals, a type of enumerations.
  bool isInExpression(Entity entity) const {
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

  bool isType(Entity entity) const {
    if (entity.entityKind() != EntityKind::Pou) return entity.entityKind() == EntityKind::Type;
    const sema::Pou& pou = project_.pous[entity.index];
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
      if (seen.insert(view_.names().key(name).index).second && matches(view_.names().string(name)))
        addEntity(name, entity, kMember);
    };
    if (context_.base.entity)
      scope_.membersOf(context_.base.entity, use);
    else
      scope_.membersOf(context_.base.type, use);
    if (result_.items.empty()) ofLibrary(context_.base_name);
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
    keywords(kSections);
  }

  // ---- statements

  void statement() {
    caseLabels();
    visible([&](Entity entity) { return isInStatement(entity); },
            [&](NameId name, Entity entity) {
              addEntity(name, entity, rankOf(entity));
              if (entity.entityKind() == EntityKind::Var) call(name, entity);
            });
    snippets(kStatements, CompletionKind::Snippet);
    closers();
    libraryNames([](std::string_view word) { return word == "FUNCTION"; });
  }

  // The call of an instance with its pins.
  void call(NameId name, Entity entity) {
    const PouId block = scope_.blockOf(scope_.recordOf(scope_.typeOf(entity)));
    if (!block || project_.pou(block).kind != PouKind::FunctionBlock || followsParenthesis()) return;
    CompletionItem& item = add(text(name) + std::string(kCall), CompletionKind::Snippet, kLocal);
    item.is_snippet = true;
    item.detail = project_.types.toString(scope_.typeOf(entity));
    item.entity = Entity::of(EntityKind::Pou, block.index);
  }

  std::string_view innermostBlock() const {
    return context_.blocks.empty() ? std::string_view() : cursor_.text(context_.blocks.back());
  }

  // The values of the selector, between CASE and OF.
  void caseLabels() {
    if (!sameIdentifier(innermostBlock(), "CASE")) return;
    for (size_t at = context_.blocks.back() + 1; at < cursor_.units.size(); ++at)
      if (sameIdentifier(cursor_.text(at), "OF")) return items(valueBefore(view_, cursor_, at).type, true);
  }

  void closers() {
    const std::string_view block = innermostBlock();
    const bool is_in_loop = std::any_of(context_.blocks.begin(), context_.blocks.end(), [&](size_t unit) {
      return !sameIdentifier(cursor_.text(unit), "IF") && !sameIdentifier(cursor_.text(unit), "CASE");
    });
    if (is_in_loop) snippets(kInLoops, CompletionKind::Keyword);
    if (sameIdentifier(block, "IF")) words({"ELSIF", "ELSE"});
    if (sameIdentifier(block, "CASE")) words({"ELSE"});
    if (sameIdentifier(block, "REPEAT")) words({"UNTIL"});
    if (!block.empty()) {
      const std::string closing = closingOf(block);
      if (matches(closing)) add(closing, CompletionKind::Keyword, kWord).insert = closing + ";";
      return;
    }
    if (!context_.has_body) keywords(kSections);
    if (!cursor_.pou) return;
    const PouKind kind = project_.pou(cursor_.pou).kind;
    if (kind == PouKind::FunctionBlock || kind == PouKind::Class || kind == PouKind::Interface)
      snippets(kMembers, CompletionKind::Snippet);
    if (const std::string closing = closingOf(keywordOf(kind)); matches(closing))
      add(closing, CompletionKind::Keyword, kWord);
  }

  // ---- expressions

  void expression() {
    const bool is_argument = context_.call && context_.call->is_at_beginning;
    if (is_argument) pins(*context_.call);
    if (is_argument && isPinFollowing()) return;
    items(context_.expected, true);
    const auto isListed = [&](Entity entity) {  // by items()
      return entity.entityKind() == EntityKind::EnumValue && context_.expected &&
             scope_.typeOf(entity) == project_.types.resolve(context_.expected);
    };
    visible([&](Entity entity) { return !isListed(entity) && isInExpression(entity) && mayFit(entity); },
            [&](NameId name, Entity entity) { addEntity(name, entity, rankOf(entity)); });
    if (context_.needs != Needs::Any) return;
    const types::TypeKind wanted = project_.types.plainKind(context_.expected);
    if (!context_.expected || wanted == types::TypeKind::Bool) words({"TRUE", "FALSE"});
    if (!context_.expected || wanted == types::TypeKind::Bool || types::TypeTable::isBits(wanted)) words({"NOT"});
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
    return kind == wanted || (types::TypeTable::isNumber(kind) && types::TypeTable::isNumber(wanted)) ||
           types::categoryOf(kind) == types::categoryOf(wanted);
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
      const char* const sign = isPinFollowing() ? "" : var.section == SectionKind::Output ? " => " : " := ";
      CompletionItem& item = add(name + sign, CompletionKind::Pin, kPin);
      item.entity = Entity::of(EntityKind::Var, pin.index);
      item.detail = project_.types.toString(var.type);
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
  const CompletionContext context_;
  Completion result_;
};

// ---- pragmas and rung.project

void addPragma(const PragmaWord& word, Completion& result) {
  CompletionItem& item = result.items.emplace_back();
  item.label = word.name;
  item.kind = CompletionKind::Pragma;
  item.documentation = word.meaning;
  if (!item.label.ends_with("''")) return;
  item.insert = item.label.substr(0, item.label.size() - 1) + "$1'";
  item.is_snippet = true;
}

// The values in `{attribute 'symbol' := '`.
void addAttributeValues(std::string_view attribute, Completion& result) {
  for (const PragmaWord& word : pragmaWords()) {
    if (!word.is_attribute || word.values == nullptr || !sameIdentifier(word.name, attribute)) continue;
    for (std::string_view values = word.values; !values.empty();) {
      const std::string_view value = values.substr(0, values.find(' '));
      CompletionItem& item = result.items.emplace_back();
      item.label = value;
      item.kind = CompletionKind::Item;
      values.remove_prefix(std::min(value.size() + 1, values.size()));
    }
  }
}

// A pragma after its brace, the name of an attribute in quotes, or the value of one.
void addPragmas(const Cursor& cursor, Completion& result) {
  const std::string_view text = cursor.prefix;  // from the brace on
  const auto quotes = std::count(text.begin(), text.end(), '\'');
  const size_t open = text.find('\''), close = text.find('\'', open + 1);
  const bool is_attribute = sameIdentifier(text.substr(0, 10), "{attribute");
  if (quotes == 3 && is_attribute) addAttributeValues(text.substr(open + 1, close - open - 1), result);
  if (quotes > 1 || (quotes == 1 && !is_attribute)) return;
  for (const PragmaWord& word : pragmaWords())
    if (word.is_attribute == (quotes == 1)) addPragma(word, result);
}

// The sections after `[`, and the keys of the section around the cursor.
void addProjectKeys(std::string_view source, size_t offset, Completion& result) {
  const size_t begin = source.find_last_of("\r\n", offset == 0 ? 0 : offset - 1);
  const size_t line = begin == std::string_view::npos || offset == 0 ? 0 : begin + 1;
  const std::string_view before = source.substr(line, offset - line);
  if (before.find('=') != std::string_view::npos) return;
  const bool is_section = before.starts_with('[');
  const size_t header = line < 2 ? std::string_view::npos : source.rfind("\n[", line - 2);
  const size_t section = header == std::string_view::npos ? (source.starts_with('[') ? 0 : source.size()) : header + 1;
  const std::string_view kind = source.substr(section, source.find_first_of(" ]\r\n", section) - section);
  for (const driver::ProjectSchema& schema : driver::projectSchemas()) {
    if (is_section) {
      CompletionItem& item = result.items.emplace_back();
      item.label = schema.kind;
      item.kind = CompletionKind::Key;
      item.insert = std::string(schema.kind) + (schema.named ? " " : "");
    } else if (schema.keys != nullptr && kind == "[" + std::string(schema.kind)) {
      std::string_view keys = schema.keys;
      while (!keys.empty()) {
        const std::string_view key = keys.substr(0, keys.find(' '));
        CompletionItem& item = result.items.emplace_back();
        item.label = key;
        item.kind = CompletionKind::Key;
        item.insert = std::string(key) + " = ";
        keys.remove_prefix(std::min(key.size() + 1, keys.size()));
      }
    }
  }
}

bool isProjectFile(std::string_view path) { return path.ends_with("/rung.project"); }

}  // namespace

Completion completionsAt(const View& view, const LibraryIndex& libraries, FileId file, uint32_t byte) {
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
  Completion found = Completer(view, libraries, cursor).complete();
  found.replaced = result.replaced;
  // The best; more letters find the others.
  constexpr size_t kMost = 300;
  std::stable_sort(found.items.begin(), found.items.end(),
                   [](const CompletionItem& a, const CompletionItem& b) { return a.rank < b.rank; });
  if (found.items.size() > kMost) {
    found.items.resize(kMost);
    found.is_incomplete = true;
  }
  for (CompletionItem& item : found.items) addCallSnippet(view, item);
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
