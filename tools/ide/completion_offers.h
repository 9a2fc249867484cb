// SPDX-License-Identifier: Apache-2.0
// What the completions of all places are made of: words, names with what is inserted for them, paths to what lies in
// records and arrays, names of libraries. In: the place of the cursor. Out: items. The base of those that know which of
// them a place takes: completion.cpp for code, completion_notation.cpp for charts and networks.
#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>

#include "frontend/source/scanner.h"
#include "sema/declarations/libraries.h"
#include "tools/ide/clause.h"
#include "tools/ide/completion.h"
#include "tools/ide/completion_context.h"
#include "tools/ide/default_values.h"
#include "tools/ide/library_calls.h"
#include "tools/ide/scope.h"
#include "tools/ide/symbols.h"

namespace rung::ide {

// The order of items: what fits the expected type, then what is near.
enum Rank : uint8_t { kFits, kPin, kLocal, kMember, kGlobal, kDeclared, kWord, kLibrary };

struct WordSnippet {
  const char* word;
  const char* snippet;
};

class Offers {
 public:
  Offers(const View& view, const LibraryIndex& libraries, const Cursor& cursor, const CompletionContext& context,
         const std::optional<Clause>& clause)
      : view_(view),
        libraries_(libraries),
        cursor_(cursor),
        scope_(view.meanings().scope()),
        project_(scope_.project()),
        context_(context),
        defaults_(view, cursor.pou),
        clause_(clause) {}

 protected:
  bool matches(std::string_view name) const { return cursor_.prefix.empty() || matchScore(name, cursor_.prefix) > 0; }
  std::string text(NameId name) const { return std::string(view_.names().string(name)); }
  CompletionItem& add(std::string label, CompletionKind kind, uint8_t rank);
  void words(std::initializer_list<const char*> list);
  // Words that need more to be a program.
  void partialWords(std::initializer_list<const char*> list);
  template <size_t count>
  void snippets(const WordSnippet (&list)[count], CompletionKind kind) {
    for (const WordSnippet& row : list) {
      if (!matches(row.word)) continue;
      CompletionItem& item = add(row.word, kind, kWord);
      item.insert = row.snippet;
      item.is_snippet = true;
    }
  }
  bool followsParenthesis() const;
  // The beginning of a statement of which nothing follows.
  bool isStatement() const { return clause_ && clause_->is_begin && clause_->ends_here; }
  // The next sign after the cursor is one of these.
  bool isFollowedBy(std::string_view signs) const;
  void addEntity(NameId name, Entity entity, uint8_t rank);
  // A value that is written to.
  void assign(CompletionItem& item, TypeId type, int place) const;
  // Arguments for the inputs and in-outs, by position where a function has few of them. An argument is left out where
  // nothing can be written for it.
  std::string callSnippet(const std::string& callee, PouId pou);
  // Those of an enumeration; with its name where the item alone would mean something else.
  void items(TypeId type, bool needs_name);
  // The values in a record, an array or through a pointer: `pump.on`, `list[0].y`. `insert` has places to fill in.
  void leadOn(const std::string& label, const std::string& insert, Entity entity, TypeId type, const std::string& key,
              uint8_t rank, int depth);
  // `Standard.TON`
  void ofLibrary(std::string_view library);
  // Those that begin as what is typed; nothing is listed before a letter is typed, there are thousands.
  template <class Test>
  void libraryNames(Test test) {
    result_.is_incomplete = true;
    if (cursor_.prefix.empty()) return;
    std::unordered_set<std::string> seen;
    for (const CompletionItem& item : result_.items) seen.insert(foldedIdentifier(item.label));
    for (const LibraryName& name : libraries_.all()) {
      if (!sameIdentifier(name.name.substr(0, cursor_.prefix.size()), cursor_.prefix)) continue;
      if ((name.standards & sema::bitOf(project_.options.dialect)) == 0 || !isWhole(name.library)) continue;
      if (!test(libraries_.useOf(name))) continue;
      if (seen.insert(foldedIdentifier(name.name)).second) addLibraryName(name);
    }
  }
  // Whether a value of one type can be where another is expected, roughly: what the check would refuse surely is out.
  bool fits(TypeId type) const;
  // Whether what has these pins can be called with the arguments after the cursor, by their names and number.
  bool takesArguments(const std::vector<std::string>& pins, bool is_extensible) const;
  // The cursor is in a test, or in what only tests use.
  bool isInTest() const;
  // Of the kind that is expected.
  bool canBe(TypeId type) const;
  // Declared in a library, which does not give the name to others.
  bool isInternal(Entity entity) const;
  uint8_t rankOf(Entity entity) const;
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
  CompletionKind kindOf(Entity entity) const;
  static CompletionKind kindOf(PouKind kind);
  // Names of one key are good at the same places.
  std::string keyOf(Entity entity) const;
  // What a chart has beside its steps: `_belt`, `sfc_entered`.
  static bool isMade(std::string_view name) {
    return name.starts_with('_') || sameIdentifier(name.substr(0, 4), "sfc_");
  }
  bool isOfChart(Entity entity) const;

  const View& view_;
  const LibraryIndex& libraries_;
  const Cursor& cursor_;
  const Scope& scope_;
  const sema::Project& project_;
  CompletionContext context_;
  DefaultValues defaults_;
  const std::optional<Clause> clause_;  // none: not in a body
  Completion result_;

 private:
  bool hasPragmas(const sema::Var& var) const { return var.decl && !view_.tree().decl(var.decl).pragmas.empty(); }
  // Not written by anybody: instances of boxes without a name, lists of globals in libraries.
  bool isHidden(NameId name, Entity entity) const;
  bool isDrawn(PouId pou) const;
  // Whose variables are not known by their names alone.
  bool needsPath(Entity list) const;
  void addStep(const std::string& label, const std::string& insert, Entity entity, TypeId type, const std::string& key,
               uint8_t rank, int depth);
  void addLibraryName(const LibraryName& name);
  // The project has all of the library: the memory of another machine may be missing.
  bool isWhole(std::string_view library);
  void libraryFunction(CompletionItem& item, const LibraryUse& use) const;

  bool is_open_ = false;  // a call lacks an argument
  size_t paths_ = 0;
  std::unordered_map<std::string_view, uint32_t> library_files_;  // of the project
  int place_ = 0;                                                 // the last place to fill in
};

}  // namespace rung::ide
