// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/completion_trial.h"

#include <algorithm>
#include <map>
#include <unordered_map>
#include <unordered_set>

#include "tools/ide/completion_context.h"
#include "tools/ide/notation.h"
#include "tools/ide/signature.h"

namespace rung::ide {
namespace {

constexpr size_t kMostTried = 300, kMostTriedInCopy = 120;  // statements of one trial
constexpr uint8_t kLast = 8;                                // the rank of what needs more
constexpr std::string_view kNoName = "rung_no_name";

// What is there when the item is accepted as it is: the places have their first text.
std::string acceptedText(const CompletionItem& item) {
  const std::string& snippet = item.insert.empty() ? item.label : item.insert;
  if (!item.is_snippet) return snippet;
  std::string out;
  for (size_t at = 0; at < snippet.size(); ++at) {
    if (snippet[at] != '$') {
      out += snippet[at] == '\n' || snippet[at] == '\t' ? ' ' : snippet[at];
      continue;
    }
    const bool is_place = at + 1 < snippet.size() && snippet[at + 1] == '{';
    const size_t end = is_place ? snippet.find('}', at) : at + 1;
    const size_t text = is_place ? snippet.find(':', at) : std::string::npos;
    if (end == std::string::npos) break;
    if (text != std::string::npos && text < end) out += snippet.substr(text + 1, end - text - 1);
    at = end;
  }
  return out;
}

bool begins(const CompletionItem& item, const Cursor& cursor) {
  return sameIdentifier(std::string_view(item.label).substr(0, cursor.prefix.size()), cursor.prefix);
}

std::string statementWith(const Clause& clause, const std::string& text) {
  std::string after = clause.after;
  if (text.ends_with(';') && after == ";") after.clear();
  return clause.before + text + after;
}

// The codes, sorted; without those at one column.
std::vector<std::string> codesOf(const std::string& errors, const std::string& without_column) {
  std::vector<std::string> codes;
  for (size_t at = 0; at < errors.size();) {
    const size_t end = std::min(errors.find(' ', at), errors.size());
    const std::string error = errors.substr(at, end - at);
    const size_t colon = error.find(':');
    if (colon != std::string::npos && error.substr(0, colon) != without_column)
      codes.push_back(error.substr(colon + 1));
    at = end + 1;
  }
  std::sort(codes.begin(), codes.end());
  return codes;
}

}  // namespace

namespace {

void tryItemsOnce(const Cursor& cursor, const Clause& clause, std::vector<CompletionItem>& items,
                  CompletionTrial& trial, bool in_copy) {
  const auto isOne = [&](const CompletionItem& item) {
    return item.fit == Fit::Tried && item.is_tried_in_copy == in_copy;
  };
  const size_t most = in_copy ? kMostTriedInCopy : kMostTried;
  std::unordered_map<std::string, size_t> by_key;  // the statement of each
  std::vector<std::string> statements = {statementWith(clause, std::string(kNoName))};
  for (const bool is_begin : {true, false})  // what begins as the word at the cursor is more likely
    for (const CompletionItem& item : items) {
      if (begins(item, cursor) != is_begin || !isOne(item) || statements.size() > most) continue;
      if (!by_key.emplace(item.key, statements.size()).second) continue;
      statements.push_back(statementWith(clause, item.tried.empty() ? acceptedText(item) : item.tried));
    }
  if (by_key.empty()) return;
  const auto errors = trial.errorsOf(cursor.pou, statements, in_copy);
  if (!errors) return;
  // What is wrong with any name: other arguments, the rest of the line.
  const auto known = codesOf(errors->front(), std::to_string(clause.before.size() + 1));
  for (CompletionItem& item : items) {
    if (!isOne(item)) continue;
    const auto tried = by_key.find(item.key);
    const auto codes = tried == by_key.end() ? std::vector<std::string>{} : codesOf((*errors)[tried->second], {});
    const bool is_good = tried != by_key.end() && std::includes(known.begin(), known.end(), codes.begin(), codes.end());
    item.fit = is_good ? Fit::Whole : Fit::Part;
  }
}

}  // namespace

void tryItems(const Cursor& cursor, const Clause& clause, std::vector<CompletionItem>& items, CompletionTrial& trial) {
  tryItemsOnce(cursor, clause, items, trial, false);
  tryItemsOnce(cursor, clause, items, trial, true);
}

// ---- types

namespace {

// The variables whose type is at the cursor, and the statements that name them.
class TypeUses {
 public:
  TypeUses(const View& view, const Cursor& cursor)
      : view_(view), cursor_(cursor), scope_(view.meanings().scope()), project_(scope_.project()) {}

  workspace::Analysis::TypeTrial read() {
    findVars();
    if (trial_.vars.empty() && !trial_.result_of) return std::move(trial_);
    trial_.pou = cursor_.pou;
    for (const sema::Pou& pou : project_.pous) add(pou.body.mentions);
    for (const auto& [pou, statements] : statements_) trial_.bodies.push_back({{pou}, statements});
    return std::move(trial_);
  }

  // What follows the variables: `.x`, `(`, `[`; empty where nothing does.
  const std::vector<std::string>& members() const { return members_; }
  // Of `a : ARRAY[0..9] OF | := [1, 2];` what is around the name of the type.
  std::string typeWith(const std::string& name) const { return before_ + name + after_; }
  bool isPlain() const { return before_.empty(); }
  bool hasAfter() const { return !after_.empty(); }
  bool hasArguments() const { return after_.starts_with('(') || after_.starts_with('['); }
  // A single bit has this address.
  bool isBit() const { return is_bit_; }

 private:
  // `a, b AT %IX0.0 : |`, `a : ARRAY[0..9] OF |`, `FUNCTION f : |`
  void findVars() {
    size_t colon = cursor_.units.size();
    while (colon > 0 && !isColon(colon - 1) && cursor_.text(colon - 1) != ";") --colon;
    if (colon == 0 || !isColon(colon - 1)) return;
    if (colon < cursor_.units.size()) before_ = onOneLine(cursor_.units[colon].begin, cursor_.units.back().end) + " ";
    for (size_t at = colon - 1; at > 0; --at) {
      const std::string_view text = cursor_.text(at - 1);
      if (text == ";" || upper(text) == "VAR" || upper(text).starts_with("VAR_")) break;
      if (text == "%") is_bit_ = upper(cursor_.text(at)).find('X') != std::string::npos;
      const Entity entity =
          scope_.declaredAt({cursor_.base.offset + static_cast<uint32_t>(cursor_.units[at - 1].begin)});
      if (entity.entityKind() == EntityKind::Var) trial_.vars.push_back({entity.index});
      if (entity.entityKind() == EntityKind::Pou) {
        trial_.result_of = {entity.index};
        if (const VarId result = project_.pous[entity.index].result_var) trial_.vars.push_back(result);
      }
      if (entity.entityKind() == EntityKind::Pou) break;
    }
    findAfter();
  }
  bool isColon(size_t unit) const {
    return cursor_.text(unit) == ":" && (unit + 1 == cursor_.units.size() || cursor_.text(unit + 1) != "=");
  }
  // `| := 5`, `|(0..9)`, on the line of the cursor.
  void findAfter() {
    size_t end = cursor_.offset;
    while (end < cursor_.source.size() && isNameCharacter(cursor_.source[end])) ++end;
    const size_t line = std::min(cursor_.source.find_first_of("\r\n", end), cursor_.source.size());
    Scanner scanner(cursor_.source);
    scanner.moveTo(end);
    size_t last = end;
    for (Unit unit = scanner.nextCode(); unit.kind != UnitKind::End && unit.begin < line; unit = scanner.nextCode()) {
      if (scanner.textOf(unit) == ";") break;
      last = unit.end;
    }
    const std::string after = onOneLine(end, last);
    if (after.starts_with(":=") || after.starts_with('(') || after.starts_with('[')) after_ = after;
  }
  // Without comments.
  std::string onOneLine(size_t begin, size_t end) const {
    std::string out;
    Scanner scanner(cursor_.source);
    scanner.moveTo(begin);
    size_t last = begin;
    for (Unit unit = scanner.nextCode(); unit.kind != UnitKind::End && unit.begin < end; unit = scanner.nextCode()) {
      if (unit.begin > last && !out.empty()) out += ' ';
      out += scanner.textOf(unit);
      last = unit.end;
    }
    return out;
  }

  void add(const std::vector<sema::Mention>& mentions) {
    constexpr size_t kMostUses = 40;
    for (const sema::Mention& mention : mentions) {
      const bool is_var =
          mention.entity.entityKind() == EntityKind::Var &&
          std::find(trial_.vars.begin(), trial_.vars.end(), VarId{mention.entity.index}) != trial_.vars.end();
      const bool is_one = is_var || (mention.entity.entityKind() == EntityKind::Pou && trial_.result_of &&
                                     mention.entity.index == trial_.result_of.index);
      if (!is_one || uses_ >= kMostUses) continue;
      const FileRange at = view_.nameInFile(mention.loc);
      if (!at || !seen_.insert(uint64_t{at.file.index} << 32 | at.begin).second) continue;
      const Cursor use = cursorAt(view_, at.file, at.end);
      const CompletionContext context = contextAt(view_, use);
      if (use.place != CursorPlace::Code || !context.is_in_body || !use.pou) continue;
      ++uses_;
      const Clause clause =
          isInNotation(view_, use) ? notationAt(view_, use).clause : clauseAround(view_, use, context);
      if (clause.before.empty() && clause.after.empty()) continue;
      statements_[use.pou.index] += clause.before + std::string(use.prefix) + clause.after + "\n";
      const std::string_view after = clause.after;
      if (!is_var || !before_.empty()) continue;
      if (after.starts_with('.')) {
        size_t end = 1;
        while (end < after.size() && isNameCharacter(after[end])) ++end;
        members_.emplace_back(after.substr(1, end - 1));
      } else if (after.starts_with('(') || after.starts_with('[')) {
        members_.emplace_back(after.substr(0, 1));
      }
    }
  }

  const View& view_;
  const Cursor& cursor_;
  const Scope& scope_;
  const sema::Project& project_;
  workspace::Analysis::TypeTrial trial_;
  std::map<uint32_t, std::string> statements_;  // by POU
  std::vector<std::string> members_;
  std::string before_, after_;
  bool is_bit_ = false;
  std::unordered_set<uint64_t> seen_;
  size_t uses_ = 0;
};

TypeId typeOf(const View& view, const CompletionItem& item) {
  const Scope& scope = view.meanings().scope();
  if (item.entity) return scope.typeOf(item.entity);
  const NameId name = item.library == nullptr && !item.is_snippet ? view.names().find(item.label) : NameId{};
  return name ? scope.project().types.elementary(view.names().key(name)) : TypeId{};
}

// What the uses ask for at once, without a trial: `=TON` is the type alone.
bool isNamed(const CompletionItem& item, const std::vector<std::string>& members) {
  return std::all_of(members.begin(), members.end(), [&](const std::string& member) {
    return !member.starts_with('=') || sameIdentifier(std::string_view(member).substr(1), item.label);
  });
}
bool mayHave(const View& view, TypeId type, const std::vector<std::string>& members) {
  const Scope& scope = view.meanings().scope();
  return std::all_of(members.begin(), members.end(), [&](const std::string& member) {
    if (member.starts_with('=')) return true;
    if (member == "(") return static_cast<bool>(scope.blockOf(scope.recordOf(type)));
    if (member == "[") return scope.project().types.kind(scope.project().types.resolve(type)) == types::TypeKind::Array;
    const NameId name = view.names().find(member);
    return member.empty() || !scope.hasMembers(type) || (name && scope.memberOf(type, view.names().key(name)));
  });
}
// The same of a block of a library.
bool mayHave(const LibraryName& name, const std::vector<std::string>& members) {
  if (members.empty()) return true;
  const std::optional<PouSignature> signature = signatureOf(name);
  return std::all_of(members.begin(), members.end(), [&](const std::string& member) {
    if (member == "(" || member.empty() || member.starts_with('=')) return signature.has_value();
    return !signature || std::any_of(signature->pins.begin(), signature->pins.end(),
                                     [&](const SignaturePin& pin) { return sameIdentifier(pin.name, member); });
  });
}

// The pin of another POU that a declared one must equal: of what a mock replaces, of the method that one implements.
class EqualPins {
 public:
  explicit EqualPins(const Scope& scope) : scope_(scope), project_(scope.project()) {}

  // None: it may have any type.
  TypeId typeOf(VarId var, PouId result_of) const {
    const PouId pou = result_of ? result_of : project_.var(var).pou;
    for (const PouId other : pou ? othersOf(pou) : std::vector<PouId>()) {
      if (result_of) return project_.pou(other).result;
      for (const VarId pin : scope_.isPin(var) ? scope_.pinsOf(other) : std::vector<VarId>())
        if (keyOf(project_.var(pin).name) == keyOf(project_.var(var).name)) return project_.var(pin).type;
    }
    return {};
  }

 private:
  NameId keyOf(NameId name) const { return project_.names.key(name); }

  std::vector<PouId> othersOf(PouId id) const {
    const sema::Pou& pou = project_.pou(id);
    if (pou.pragmas.replaces) {
      const Entity original = scope_.lookUp({}, keyOf(pou.pragmas.replaces));
      if (original.entityKind() == EntityKind::Pou) return {PouId{original.index}};
      return {};
    }
    std::vector<PouId> found;
    if (pou.kind != PouKind::Method || !pou.owner) return found;
    std::vector<PouId> objects = {pou.owner};
    for (size_t i = 0; i < objects.size() && i < kMostObjects; ++i) {
      const sema::Pou& object = project_.pou(objects[i]);
      for (const PouId member : object.members)
        if (i > 0 && keyOf(project_.pou(member).name) == keyOf(pou.name)) found.push_back(member);
      if (object.base) objects.push_back(object.base);
      objects.insert(objects.end(), object.object.interfaces.begin(), object.object.interfaces.end());
    }
    return found;
  }

  static constexpr size_t kMostObjects = 100;
  const Scope& scope_;
  const sema::Project& project_;
};

// `: Ramp(2.0)`
bool hasConstructor(const View& view, TypeId type) {
  const Scope& scope = view.meanings().scope();
  const NameId name = view.names().find("FB_Init");
  return type && name && scope.memberOf(type, view.names().key(name));
}

// Whether a type is worth a trial.
bool isPossible(const View& view, const CompletionItem& item, const TypeUses& uses) {
  const TypeId type = typeOf(view, item);
  const types::TypeTable& types = view.meanings().scope().project().types;
  if (uses.isBit() && (!type || types.plainKind(type) != types::TypeKind::Bool)) return false;
  const bool is_elementary = item.library == nullptr && !item.entity && !item.is_snippet;
  if (uses.hasArguments() && !is_elementary && !hasConstructor(view, type)) return false;
  if (!uses.isPlain()) return true;
  if (!isNamed(item, uses.members())) return false;
  if (item.library != nullptr) return mayHave(*item.library, uses.members());
  return item.is_snippet || (type && mayHave(view, type, uses.members()));
}

}  // namespace

void tryTypes(const View& view, const Cursor& cursor, std::vector<CompletionItem>& items, CompletionTrial& trial) {
  constexpr size_t kMostTypes = 60;
  TypeUses uses(view, cursor);
  workspace::Analysis::TypeTrial tried = uses.read();
  if (tried.vars.empty() && !tried.result_of) return;
  const types::TypeTable& types = view.meanings().scope().project().types;
  const TypeId equal =
      EqualPins(view.meanings().scope()).typeOf(tried.vars.empty() ? VarId{} : tried.vars.front(), tried.result_of);
  const bool needs_trial = !tried.bodies.empty() || uses.hasAfter();
  std::vector<CompletionItem*> of;
  for (const bool is_elementary : {true, false})  // these are the most likely ones
    for (CompletionItem& item : items) {
      if ((!item.entity && item.library == nullptr) != is_elementary) continue;
      const TypeId type = typeOf(view, item);
      const bool is_equal = !equal || (type && types.resolve(type) == types.resolve(equal));
      const bool is_possible = is_equal && isPossible(view, item, uses) && (!needs_trial || of.size() < kMostTypes);
      if (!is_possible || needs_trial) item.fit = is_possible ? Fit::Tried : Fit::Part;
      if (is_possible && needs_trial) of.push_back(&item);
    }
  for (const CompletionItem* item : of) tried.types.push_back(uses.typeWith(acceptedText(*item)));
  const auto good = tried.types.empty() ? std::nullopt : trial.goodTypes(tried);
  for (size_t i = 0; good && i < of.size(); ++i) of[i]->fit = (*good)[i] == '+' ? Fit::Whole : Fit::Part;
}

void sortOut(const Cursor& cursor, Completion& completion) {
  constexpr size_t kMost = 300;
  std::vector<CompletionItem>& items = completion.items;
  const size_t count = items.size();
  const bool has_whole = std::any_of(items.begin(), items.end(), [&](const CompletionItem& item) {
    return item.fit != Fit::Part && begins(item, cursor);
  });
  if (has_whole || cursor.prefix.empty())
    std::erase_if(items, [](const CompletionItem& item) { return item.fit == Fit::Part; });
  for (CompletionItem& item : items)
    if (item.fit == Fit::Part) item.rank = kLast;
  std::stable_sort(items.begin(), items.end(),
                   [](const CompletionItem& a, const CompletionItem& b) { return a.rank < b.rank; });
  if (items.size() > kMost) items.resize(kMost);
  completion.is_incomplete = completion.is_incomplete || items.size() != count;
}

}  // namespace rung::ide
