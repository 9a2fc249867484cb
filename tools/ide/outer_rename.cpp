// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/outer_rename.h"

#include <algorithm>

#include "frontend/source/names.h"
#include "tools/ide/meaning_check.h"

namespace rung::ide {
namespace {

std::string asWritten(std::string_view name) { return "`" + std::string(name) + "`"; }

std::string fileNameOf(const std::string& path) { return path.substr(path.rfind('/') + 1); }

// `Globals.st` becomes `Plant.st`.
FileMove moveOf(const std::string& path, const std::string& new_name) {
  return {path, path.substr(0, path.rfind('/') + 1) + new_name + path.substr(path.rfind('.'))};
}

// For the trial the file keeps its name: a pragma gives the list the one that the file will give it.
void addListPragma(const ListDeclaration& list, const std::string& new_name, std::vector<TextEdit>& edits) {
  edits.push_back({{list.section.file, list.section.begin, list.section.begin}, "{list '" + new_name + "'} "});
}

// In all of the project every name must mean what it meant.
std::string conflictOfOuter(const View& view, const std::vector<TextEdit>& edits, RenameTrial trial) {
  const Edits sorted(edits);
  const MeaningRecord before(view, &sorted, "", "");
  const auto said = trial(sorted.applied(view), [&](const View& after) { return before.differenceIn(after); });
  return said.value_or("the project could not be checked with it");
}

}  // namespace

std::string refusalOfOuter(const View& view, const OuterName& name) {
  const bool is_declared = name.kind == OuterKind::List
                               ? static_cast<bool>(declarationOfList(view, name).file)
                               : std::any_of(name.references.begin(), name.references.end(),
                                             [](const Reference& reference) { return reference.is_declaration; });
  if (is_declared) return {};
  return asWritten(name.name) + " has its name from a file or a library, not from a declaration";
}

Renaming renameOuter(const View& view, const OuterName& name, const std::string& new_name, bool renames_files,
                     RenameTrial trial) {
  Renaming renaming;
  const NameChange change{name.name, new_name};
  const std::string refused = asWritten(name.name) + " cannot become " + asWritten(new_name) + ": ";
  if (isOuterNameTaken(view, name, new_name)) {
    renaming.refusal = refused + "something else has this name";
    return renaming;
  }
  std::vector<TextEdit> edits;
  for (const Reference& reference : name.references) edits.push_back({reference.at, new_name});
  std::vector<TextEdit> tried;
  if (name.kind == OuterKind::List) {
    const ListDeclaration list = declarationOfList(view, name);
    const std::string path = view.pathOf(list.file);
    if (list.name) edits.push_back({list.name, new_name});
    tried = edits;
    if (sameIdentifier(listNameOf(path), name.name)) {
      if (!renames_files) {
        renaming.refusal = asWritten(name.name) + " has its name from the file " + asWritten(fileNameOf(path)) +
                           ", which the editor cannot rename";
        return renaming;
      }
      renaming.moves.push_back(moveOf(path, new_name));
      addListPragma(list, new_name, tried);
    }
  } else {
    addVendorNames(view, name.references, change, edits);
    tried = edits;
    if (renames_files) renaming.moves = movesFor(view, name.references, change);
  }
  if (const std::string conflict = conflictOfOuter(view, tried, trial); !conflict.empty()) {
    renaming.refusal = refused + conflict;
    return renaming;
  }
  for (const FileMove& move : renaming.moves) addNamesOfFile(view, move, edits);
  renaming.edits = Edits(std::move(edits)).all();
  return renaming;
}

}  // namespace rung::ide
