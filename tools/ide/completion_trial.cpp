// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/completion_trial.h"

#include <algorithm>
#include <map>
#include <unordered_map>
#include <unordered_set>

#include "tools/ide/completion_context.h"
#include "tools/ide/notation.h"

namespace rung::ide {
namespace {

constexpr size_t kMostTried = 300;  // statements of one trial
constexpr uint8_t kLast = 8;        // the rank of what needs more
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

void tryItems(const Cursor& cursor, const Clause& clause, std::vector<CompletionItem>& items, CompletionTrial& trial) {
  std::unordered_map<std::string, size_t> by_key;  // the statement of each
  std::vector<std::string> statements = {statementWith(clause, std::string(kNoName))};
  for (const CompletionItem& item : items) {
    if (item.fit != Fit::Tried || statements.size() > kMostTried || by_key.count(item.key) != 0) continue;
    by_key.emplace(item.key, statements.size());
    statements.push_back(statementWith(clause, acceptedText(item)));
  }
  if (by_key.empty()) return;
  const auto errors = trial.errorsOf(cursor.pou, statements);
  if (!errors) return;
  // What is wrong with any name: other arguments, the rest of the line.
  const auto known = codesOf(errors->front(), std::to_string(clause.before.size() + 1));
  for (CompletionItem& item : items) {
    if (item.fit != Fit::Tried) continue;
    const auto tried = by_key.find(item.key);
    const auto codes = tried == by_key.end() ? std::vector<std::string>{} : codesOf((*errors)[tried->second], {});
    const bool is_good = tried != by_key.end() && std::includes(known.begin(), known.end(), codes.begin(), codes.end());
    item.fit = is_good ? Fit::Whole : Fit::Part;
  }
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
    if (trial_.vars.empty()) return std::move(trial_);
    findInitialValue();
    for (const sema::Pou& pou : project_.pous) add(pou.body.mentions);
    for (const auto& [pou, statements] : statements_) trial_.bodies.push_back({{pou}, statements});
    return std::move(trial_);
  }

  // What follows the variables: `.x`, `(`, `[`; empty where nothing does.
  const std::vector<std::string>& members() const { return members_; }

 private:
  // `a, b AT %IX0.0 : |`
  void findVars() {
    size_t at = cursor_.units.size();
    if (at == 0 || cursor_.before() != ":") return;
    for (--at; at > 0; --at) {
      const std::string_view text = cursor_.text(at - 1);
      if (text == ";" || cursor_.units[at - 1].kind == UnitKind::Comment) break;
      const Entity entity =
          scope_.declaredAt({cursor_.base.offset + static_cast<uint32_t>(cursor_.units[at - 1].begin)});
      if (entity.entityKind() == EntityKind::Var) trial_.vars.push_back({entity.index});
    }
  }
  // `: | := 5`
  void findInitialValue() {
    const std::string_view rest = cursor_.source.substr(cursor_.offset);
    Scanner scanner(rest);
    const Unit first = scanner.nextCode(), second = scanner.nextCode();
    if (scanner.textOf(first) != ":" || scanner.textOf(second) != "=" || !cursor_.pou) return;
    const size_t end = std::min(rest.find_first_of(";\n"), rest.size());
    std::string value(rest.substr(second.end, end - second.end));
    value = value.substr(0, value.find("//"));
    const std::string name(view_.names().string(project_.var(trial_.vars.front()).name));
    statements_[cursor_.pou.index] += name + " := " + value + ";\n";
  }

  void add(const std::vector<sema::Mention>& mentions) {
    constexpr size_t kMostUses = 40;
    for (const sema::Mention& mention : mentions) {
      const bool is_one =
          mention.entity.entityKind() == EntityKind::Var &&
          std::find(trial_.vars.begin(), trial_.vars.end(), VarId{mention.entity.index}) != trial_.vars.end();
      if (!is_one || uses_ >= kMostUses) continue;
      const FileRange at = view_.nameInFile(mention.loc);
      if (!at || !seen_.insert(uint64_t{at.file.index} << 32 | at.begin).second) continue;
      const Cursor use = cursorAt(view_, at.file, at.end);
      const CompletionContext context = contextAt(view_, use);
      if (use.place != CursorPlace::Code || !context.is_in_body || !use.pou) continue;
      if (isInNotation(view_, use)) {
        statements_.try_emplace(use.pou.index);
        continue;
      }
      ++uses_;
      const Clause clause = clauseAround(view_, use, context);
      statements_[use.pou.index] += clause.before + std::string(use.prefix) + clause.after + "\n";
      const std::string_view after = clause.after;
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
  std::unordered_set<uint64_t> seen_;
  size_t uses_ = 0;
};

TypeId typeOf(const View& view, const CompletionItem& item) {
  const Scope& scope = view.meanings().scope();
  if (item.entity) return scope.typeOf(item.entity);
  const NameId name = item.library == nullptr && !item.is_snippet ? view.names().find(item.label) : NameId{};
  return name ? scope.project().types.elementary(view.names().key(name)) : TypeId{};
}

// What the uses ask for at once, without a trial.
bool mayHave(const View& view, TypeId type, const std::vector<std::string>& members) {
  const Scope& scope = view.meanings().scope();
  return std::all_of(members.begin(), members.end(), [&](const std::string& member) {
    if (member == "(") return static_cast<bool>(scope.blockOf(scope.recordOf(type)));
    if (member == "[") return scope.project().types.kind(scope.project().types.resolve(type)) == types::TypeKind::Array;
    const NameId name = view.names().find(member);
    return member.empty() || !scope.hasMembers(type) || (name && scope.memberOf(type, view.names().key(name)));
  });
}

}  // namespace

void tryTypes(const View& view, const Cursor& cursor, std::vector<CompletionItem>& items, CompletionTrial& trial) {
  constexpr size_t kMostTypes = 60;
  TypeUses uses(view, cursor);
  workspace::Analysis::TypeTrial tried = uses.read();
  if (tried.vars.empty() || tried.bodies.empty()) return;
  std::vector<CompletionItem*> of;
  for (CompletionItem& item : items) {
    const TypeId type = typeOf(view, item);
    const bool is_possible = type && tried.types.size() < kMostTypes && mayHave(view, type, uses.members());
    item.fit = is_possible ? Fit::Tried : Fit::Part;
    if (!is_possible) continue;
    tried.types.push_back(type);
    of.push_back(&item);
  }
  const auto good = trial.goodTypes(tried);
  for (size_t i = 0; good && i < of.size(); ++i) of[i]->fit = (*good)[i] == '+' ? Fit::Whole : Fit::Part;
}

void sortOut(const Cursor& cursor, Completion& completion) {
  constexpr size_t kMost = 300;
  std::vector<CompletionItem>& items = completion.items;
  const size_t count = items.size();
  if (cursor.prefix.empty()) std::erase_if(items, [](const CompletionItem& item) { return item.fit == Fit::Part; });
  for (CompletionItem& item : items)
    if (item.fit == Fit::Part) item.rank = kLast;
  std::stable_sort(items.begin(), items.end(),
                   [](const CompletionItem& a, const CompletionItem& b) { return a.rank < b.rank; });
  if (items.size() > kMost) items.resize(kMost);
  completion.is_incomplete = completion.is_incomplete || items.size() != count;
}

}  // namespace rung::ide
