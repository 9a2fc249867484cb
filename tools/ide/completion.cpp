// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/completion.h"

#include <algorithm>

#include "frontend/syntax/keywords.h"
#include "tools/ide/completion_notation.h"
#include "tools/ide/completion_offers.h"
#include "tools/ide/completion_trial.h"
#include "tools/ide/completion_words.h"
#include "tools/ide/hover.h"
#include "tools/ide/keywords.h"
#include "tools/ide/open_blocks.h"
#include "tools/ide/signature.h"

namespace rung::ide {
namespace {

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

class Completer : Offers {
 public:
  using Offers::Offers;

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

  void addresses() {
    for (const types::MemoryArea& area : project_.options.areas)
      for (const char size : {'X', 'B', 'W', 'D', 'L'}) {
        const std::string label = std::string{area.letter, size} + (size == 'X' ? "0.0" : "0");
        if (matches(label)) add(label, CompletionKind::Key, kWord).detail = "%" + label;
      }
  }

  // ---- declarations

  // After EXTENDS and IMPLEMENTS.
  void bases() {
    const bool is_interface = base_word_ == "IMPLEMENTS" || isDeclared("INTERFACE");
    const PouKind kind = is_interface          ? PouKind::Interface
                         : isDeclared("CLASS") ? PouKind::Class
                                               : PouKind::FunctionBlock;
    const auto isBase = [&](Entity entity) {
      if (entity.entityKind() == EntityKind::Type) return isDeclared("TYPE") && isType(entity);
      return entity.entityKind() == EntityKind::Pou && project_.pous[entity.index].kind == kind && isType(entity) &&
             entity.index != cursor_.pou.index;
    };
    visible(isBase, [&](NameId name, Entity entity) { addEntity(name, entity, kGlobal); });
    libraryNames([&](const LibraryUse& use) {
      return use.kind == (is_interface ? LibraryKind::Interface : LibraryKind::Block);
    });
  }

  void types() {
    for (size_t back = 0; back < cursor_.units.size(); ++back) {
      const std::string word = upper(cursor_.before(back));
      if (word == "EXTENDS" || word == "IMPLEMENTS") base_word_ = word;
      if (!base_word_.empty() || (cursor_.before(back) != "," && back % 2 == 0)) break;
    }
    if (!base_word_.empty()) return bases();
    for (const Word& word : ide::words())
      if (word.kind == WordKind::Type && matches(word.spelling))
        add(std::string(word.spelling), CompletionKind::Type, kDeclared);
    snippets(kTypes, CompletionKind::Snippet);
    visible([&](Entity entity) { return isType(entity); },
            [&](NameId name, Entity entity) { addEntity(name, entity, kGlobal); });
    libraryNames(
        [](const LibraryUse& use) { return use.kind != LibraryKind::Function && use.kind != LibraryKind::Other; });
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

  bool isType(Entity entity) const {
    if (isInternal(entity)) return false;
    if (entity.entityKind() != EntityKind::Pou) return entity.entityKind() == EntityKind::Type;
    const sema::Pou& pou = project_.pous[entity.index];
    if ((pou.pragmas.test_only || pou.pragmas.replaces) && !isInTest()) return false;
    return pou.record && pou.kind != PouKind::Program;
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
    if (!clause_ || clause_->ends_here || followsParenthesis())
      libraryNames([](const LibraryUse& use) { return use.kind == LibraryKind::Function; });
  }

  // What a statement may begin with.
  bool isInStatement(Entity entity) const {
    const EntityKind kind = entity.entityKind();
    if (kind == EntityKind::EnumValue || kind == EntityKind::Type) return false;
    if (isFollowedBy("(") && !isCallable(entity)) return false;
    if (kind == EntityKind::Var) return !project_.vars[entity.index].constant;
    if (kind == EntityKind::Pou) {
      const PouKind pou = project_.pous[entity.index].kind;
      if (pou == PouKind::Program || pou == PouKind::Action) return true;
    }
    return isInExpression(entity);
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

  // ---- expressions

  void expression() {
    const bool is_argument = context_.call && context_.call->is_at_beginning;
    if (is_argument) pins(*context_.call);
    if (isPinFollowing()) return;  // the name of a pin or of a field
    if (isFollowedBy("#")) typesOfLiterals();
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
      complement(types::TypeTable::isBits(wanted) ? "0" : "FALSE");
    if (!isFollowedBy("#."))
      libraryNames([](const LibraryUse& use) { return use.kind == LibraryKind::Function && use.has_result; });
  }

  void complement(const char* value) {
    if (!matches("NOT")) return;
    CompletionItem& item = add("NOT", CompletionKind::Keyword, kWord);
    item.insert = std::string("NOT ${1:") + value + "}";
    item.is_snippet = true;
    item.fit = Fit::Tried;
    item.key = "NOT";
  }

  // The type of a literal or an item: `|#5`.
  void typesOfLiterals() {
    for (const Word& word : ide::words()) {
      if (word.kind != WordKind::Type || !matches(word.spelling)) continue;
      CompletionItem& item = add(std::string(word.spelling), CompletionKind::Type, kDeclared);
      item.fit = Fit::Tried;
      item.key = word.spelling;
    }
  }

  // A value, or what leads to one: an instance, a list of globals, a type of enumerations.
  bool isInExpression(Entity entity) const {
    if (isFollowedBy("#"))
      return entity.entityKind() == EntityKind::Type && !isInternal(entity) && hasItemAfter(entity);
    if (isFollowedBy("(") && !isCallable(entity)) return false;
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

  bool isCallable(Entity entity) const {
    PouId callee;
    if (entity.entityKind() == EntityKind::Pou) callee = {entity.index};
    if (entity.entityKind() == EntityKind::Var || entity.entityKind() == EntityKind::Program)
      callee = scope_.blockOf(scope_.recordOf(scope_.typeOf(entity)));
    if (!callee) return false;
    std::vector<std::string> pins;
    for (const VarId pin : scope_.pinsOf(callee)) {
      pins.push_back(text(project_.var(pin).name));
      for (const NameId alias : project_.var(pin).pragmas.aliases) pins.push_back(text(alias));
    }
    const bool is_extensible = project_.pou(callee).extensible || project_.pou(callee).generic;
    return takesArguments(pins, is_extensible);
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

  // What has members may lead to a value that fits.
  bool mayFit(Entity entity) const {
    const types::TypeKind kind = project_.types.plainKind(scope_.typeOf(entity));
    const bool is_plain = types::TypeTable::isElementary(kind);
    const bool is_var = entity.entityKind() == EntityKind::Var;
    const bool is_item = entity.entityKind() == EntityKind::EnumValue;
    if (context_.needs == Needs::Lvalue && (!is_var || project_.vars[entity.index].constant)) return false;
    if (context_.needs == Needs::Selector) return !is_item && (!is_plain || types::TypeTable::isInteger(kind));
    const types::TypeKind wanted = project_.types.plainKind(context_.expected);
    const bool is_result = entity.entityKind() == EntityKind::Pou && !types::TypeTable::isGeneric(kind);
    const bool is_value = is_var || is_item || is_result || entity.entityKind() == EntityKind::Property;
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

  // The declaration around the cursor begins with this word.
  bool isDeclared(std::string_view word) const {
    return std::any_of(cursor_.units.begin(), cursor_.units.end(), [&](const Unit& unit) {
      return sameIdentifier(cursor_.source.substr(unit.begin, unit.end - unit.begin), word);
    });
  }

  std::string base_word_;  // EXTENDS or IMPLEMENTS, which the name at the cursor belongs to
  Following following_;
  bool only_constants_ = false;  // the label of a branch
};

// An expression in a chart or network is completed as in code.
Completion codeOrNotation(const View& view, const LibraryIndex& libraries, const Cursor& cursor,
                          CompletionContext& context, std::optional<Clause>& clause) {
  const bool is_in_body = context.is_in_body && cursor.pou;
  if (is_in_body && !isInNotation(view, cursor)) {
    clause = clauseAround(view, cursor, context);
  } else if (is_in_body && context.writes != Writes::Address) {
    const Notation notation = notationAt(view, cursor);
    const bool is_target = notation.place == NotationPlace::Target;
    context.expected = notation.expected;
    if (!notation.clause.before.empty() || !notation.clause.after.empty()) clause = notation.clause;
    if (!is_target && notation.place != NotationPlace::Value)
      return completionInNotation(view, libraries, cursor, context, notation);
    if (context.writes != Writes::Member && context.writes != Writes::Item && context.writes != Writes::Operator) {
      context.writes = Writes::Expression;
      context.needs = is_target ? Needs::Lvalue : Needs::Any;
    }
  }
  return Completer(view, libraries, cursor, context, clause).complete();
}

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
  CompletionContext context = contextAt(view, cursor);
  const bool writes_type = context.writes == Writes::Type;
  std::optional<Clause> clause;  // none: not in a body
  Completion found = codeOrNotation(view, libraries, cursor, context, clause);
  found.replaced = result.replaced;
  std::stable_sort(found.items.begin(), found.items.end(),
                   [](const CompletionItem& a, const CompletionItem& b) { return a.rank < b.rank; });
  if (writes_type) tryTypes(view, cursor, found.items, trial);
  if (clause) tryItems(cursor, *clause, found.items, trial);
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
