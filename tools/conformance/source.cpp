// SPDX-License-Identifier: Apache-2.0
#include "tools/conformance/source.h"

#include <algorithm>

#include "frontend/parse/conditions.h"
#include "frontend/parse/parse.h"

namespace rung::conformance {

Source::Source(const std::string& text, Dialect dialect) : diagnostics(sources) {
  file = sources.add("case.st", text);
  if (!file) return;
  const std::vector<FileId> files = {file};
  text::applyConditions(sources, files, {}, dialect, diagnostics);
  text::parseFile(tree, names, sources, file, dialect, diagnostics);
  if (!tree.files.empty())
    for (const DeclId id : tree.list(tree.files[0].decls)) decls.push_back(id);
  Scanner scanner(this->text());
  for (Unit unit = scanner.next(); unit.kind != UnitKind::End; unit = scanner.next()) units.push_back(unit);
}

std::vector<Unit>::const_iterator Source::unitAt(size_t offset) const {
  return std::lower_bound(units.begin(), units.end(), offset, [](const Unit& u, size_t at) { return u.begin < at; });
}

size_t Source::nextCode(size_t index) const {
  for (++index; index < units.size(); ++index)
    if (units[index].kind != UnitKind::Comment && units[index].kind != UnitKind::Pragma) break;
  return index;
}

}  // namespace rung::conformance
