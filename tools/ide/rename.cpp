// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/rename.h"

#include <algorithm>
#include <array>

#include "frontend/source/scanner.h"
#include "frontend/source/text.h"
#include "tools/ide/free_names.h"
#include "tools/ide/keywords.h"
#include "tools/ide/meaning_check.h"
#include "tools/ide/navigation.h"
#include "tools/ide/occurrences.h"
#include "tools/ide/outer_rename.h"
#include "tools/ide/references.h"
#include "tools/ide/vendor_names.h"

namespace rung::ide {
namespace {

std::string asCode(std::string_view name) { return "`" + std::string(name) + "`"; }

// The language uses them because of their names.
constexpr std::array<std::string_view, 3> kKnownNames = {"FB_Init", "FB_Reinit", "FB_Exit"};
bool isKnownName(std::string_view name) {
  if (sameIdentifier(name.substr(0, 3), "SFC")) return true;  // the flags of a chart
  return std::any_of(kKnownNames.begin(), kKnownNames.end(),
                     [&](std::string_view known) { return sameIdentifier(known, name); });
}

std::string_view textAt(const View& view, const FileRange& at) {
  return view.textOf(at.file).substr(at.begin, at.end - at.begin);
}

// What a name at a place stands for, and all places with it.
struct Target {
  Renamable renamable;
  std::vector<Entity> declarations;  // none: a label, or `outer`
  std::optional<OuterName> outer;
  std::vector<Reference> references;
  bool is_complete = true;  // they are all places that the check knows
};

bool isOfLibrary(const View& view, const FileRange& declaration) {
  return !view.sources().displayPath(declaration.file).starts_with('/');
}

// Why what is declared there cannot have another name.
std::string refusalOf(const View& view, const Target& target) {
  const std::string name = asCode(target.renamable.name);
  bool is_declared = false;
  for (const Reference& reference : target.references) {
    if (!reference.is_declaration) continue;
    if (isOfLibrary(view, reference.at)) return name + " is declared in a library";
    is_declared = true;
  }
  if (isKnownName(target.renamable.name)) return name + " has a meaning because of its name";
  return is_declared ? std::string() : name + " has its name from a file or a library, not from a declaration";
}

Target targetAt(const View& view, FileId file, uint32_t byte) {
  Target target;
  target.renamable.refusal = "there is no name here that the project declares";
  if (view.snapshot().project() == nullptr) return target;
  target.outer = outerNameAt(view, file, byte);
  if (target.outer) {
    target.renamable = {refusalOfOuter(view, *target.outer), target.outer->at, target.outer->name};
    return target;
  }
  if (const std::optional<NamePlace> place = nameAt(view, file, byte)) {
    const Family family(view.meanings().scope(), place->entity);
    target.renamable.at = view.nameInFile(place->loc);
    target.renamable.name = textAt(view, target.renamable.at);
    target.declarations = family.members();
    target.references = referencesTo(view, family, {}, &target.is_complete);
  } else {
    target.references = labelsAt(view, view.parsedAt(file, byte));
    for (const Reference& reference : target.references)
      if (reference.at.file == file && reference.at.begin <= byte && byte <= reference.at.end)
        target.renamable.at = reference.at;
    if (target.renamable.at) target.renamable.name = textAt(view, target.renamable.at);
  }
  if (target.renamable.at) target.renamable.refusal = refusalOf(view, target);
  return target;
}

std::string refusalOfNewName(const std::string& name) {
  if (!isIdentifier(name))
    return asCode(name) + " is not an identifier; write letters, digits and single `_`, and a letter or `_` first";
  if (const WordKind kind = kindOfWord(name); kind == WordKind::Keyword || kind == WordKind::Type)
    return asCode(name) + " is a keyword";
  return isKnownName(name) ? asCode(name) + " would have a meaning because of its name" : std::string();
}

bool hasWord(std::string_view text, std::string_view word) {
  for (size_t at = text.find(word); at != std::string_view::npos; at = text.find(word, at + 1)) {
    const size_t end = at + word.size();
    if ((at == 0 || !isNameCharacter(text[at - 1])) && (end == text.size() || !isNameCharacter(text[end]))) return true;
  }
  return false;
}

// Why a body in C++, which no rename changes, forbids the names; empty: none does. Variables of another POU are not
// visible there.
std::string useInCpp(const View& view, const std::vector<Entity>& declarations, const NameChange& change) {
  const sema::Project& project = *view.snapshot().project();
  for (const sema::Pou& pou : project.pous) {
    if (!pou.decl || pou.library || view.tree().kind(pou.decl) != DeclKind::Pou) continue;
    const PouDecl& decl = view.tree().as<PouDecl>(pou.decl);
    const bool is_other = std::all_of(declarations.begin(), declarations.end(), [&](Entity entity) {
      const PouId owner = entity.entityKind() == EntityKind::Var ? project.vars[entity.index].pou : PouId{};
      return owner && project.pou(owner).decl != pou.decl && pou.owner != owner;
    });
    if (!pou.cpp.is_body || is_other) continue;
    const FileId file = view.sources().fileOf(decl.body_begin);
    const std::string_view body = view.sources().sourceText(file).substr(
        decl.body_begin.offset - view.sources().begin(file).offset, decl.body_end.offset - decl.body_begin.offset);
    // Functions are called there in capitals.
    const auto has = [&](const std::string& name) { return hasWord(body, name) || hasWord(body, upper(name)); };
    for (const std::string* name : {&change.from, &change.to})
      if (has(*name))
        return "the C++ body of " + asCode(view.names().string(pou.name)) + " uses " + asCode(*name) +
               (name == &change.from ? ", and code in C++ is not changed" : "");
  }
  return {};
}

// What files of other tools have as an object of its own.
bool isObject(const Target& target) {
  return std::any_of(target.declarations.begin(), target.declarations.end(), [](Entity entity) {
    const EntityKind kind = entity.entityKind();
    return kind == EntityKind::Pou || kind == EntityKind::Type || kind == EntityKind::Property;
  });
}

// Another place may need the same name: code that is made of a drawing, the pins of methods that implement one of an
// interface.
bool isTiedToOthers(const View& view, const Target& target) {
  return !target.is_complete || target.declarations.size() > 1 ||
         std::any_of(target.declarations.begin(), target.declarations.end(), [&](Entity entity) {
           if (entity.entityKind() == EntityKind::Program) return true;  // paths in files of other tools begin with it
           const sema::Project& project = *view.snapshot().project();
           const PouId pou = entity.entityKind() == EntityKind::Var ? project.vars[entity.index].pou : PouId{};
           return pou && project.pou(pou).owner;
         });
}

bool isProgramInstance(Entity entity) { return entity.entityKind() == EntityKind::Program; }

// Whether no other name can be concerned: no text and no library has the new one, or no code that sees the old one.
bool isSurelyFree(const View& view, const Target& target, const Edits& edits, const NameChange& change) {
  const std::vector<Entity>& declarations = target.declarations;
  if (!target.is_complete) return false;
  const bool is_new = !view.names().find(change.to);
  const bool is_free = is_new || (declarations.size() == 1 && isFreeFor(view, declarations.front(), change.to));
  if (!is_free) return false;
  if (!isTiedToOthers(view, target))
    return knowsAllOccurrences(view, change.from, edits,
                               codeThatSees(view, declarations.empty() ? Entity{} : declarations.front()));
  return is_new && std::none_of(declarations.begin(), declarations.end(), isProgramInstance) &&
         areAllOccurrences(view, change.from, edits);
}

// Else the edits are made on trial.
std::string conflictOf(const View& view, const Target& target, const Edits& edits, const NameChange& change,
                       RenameTrial trial) {
  if (isSurelyFree(view, target, edits, change)) return {};
  const MeaningRecord before(view, &edits, change.from, change.to);
  const auto said = trial(edits.applied(view), [&](const View& after) { return before.differenceIn(after); });
  return said.value_or("the project could not be checked with it");
}

}  // namespace

Renamable renamableAt(const View& view, FileId file, uint32_t byte) { return targetAt(view, file, byte).renamable; }

Renaming renameAt(const View& view, FileId file, uint32_t byte, const std::string& new_name, bool renames_files,
                  RenameTrial trial) {
  const Target target = targetAt(view, file, byte);
  Renaming renaming{target.renamable.refusal, {}, {}};
  if (renaming.refusal.empty()) renaming.refusal = refusalOfNewName(new_name);
  if (!renaming.refusal.empty()) return renaming;
  const NameChange change{target.renamable.name, new_name};
  if (target.outer) return renameOuter(view, *target.outer, new_name, renames_files, trial);
  std::vector<TextEdit> edits;
  for (const Reference& reference : target.references) edits.push_back({reference.at, new_name});
  if (isObject(target)) {
    addVendorNames(view, target.references, change, edits);
    if (renames_files) renaming.moves = movesFor(view, target.references, change);
  }
  const Edits sorted(std::move(edits));
  std::string conflict = useInCpp(view, target.declarations, change);
  if (conflict.empty()) conflict = conflictOf(view, target, sorted, change, trial);
  if (!conflict.empty()) {
    renaming.refusal = asCode(change.from) + " cannot become " + asCode(change.to) + ": " + conflict;
    return renaming;
  }
  // Only now: for the trial all files have the names that they have.
  std::vector<TextEdit> all = sorted.all();
  for (const FileMove& move : renaming.moves) addNamesOfFile(view, move, all);
  renaming.edits = Edits(std::move(all)).all();
  return renaming;
}

}  // namespace rung::ide
