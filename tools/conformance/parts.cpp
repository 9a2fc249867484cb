// SPDX-License-Identifier: Apache-2.0
#include "tools/conformance/parts.h"

#include <algorithm>

#include "frontend/syntax/children.h"
#include "tools/conformance/source.h"

namespace rung::conformance {
namespace {

class Collector {
 public:
  Collector(const Source& source, size_t from, size_t to) : source_(source), from_(from), to_(to) {}

  template <class Id>
  void collect(Id id, bool is_in_statement, bool has_idle) {
    const Tree& tree = source_.tree;
    if constexpr (std::is_same_v<Id, DeclId>) {
      has_idle = tree.kind(id) == DeclKind::Pou ? partOf(id).find(kIdleStatement) != std::string_view::npos : has_idle;
      add(tree.decl(id).begin, tree.decl(id).end, false);
    }
    if constexpr (std::is_same_v<Id, StmtId>) {
      add(tree.range(id).begin, tree.range(id).end, is_in_statement && has_idle);
      is_in_statement = true;
    }
    // The only variable of a section goes with it: a section without any is not of edition 2.
    bool goes_as_whole = false;
    if constexpr (std::is_same_v<Id, DeclId>)
      goes_as_whole = tree.kind(id) == DeclKind::Section && tree.as<SectionDecl>(id).vars.count == 1;
    forEachChild(tree, id, [&](const auto& child) {
      if (std::is_same_v<std::decay_t<decltype(child)>, DeclId> && goes_as_whole) return;
      collect(child, is_in_statement, has_idle);
    });
  }

  std::vector<Part> parts;

 private:
  std::string_view partOf(DeclId id) const {
    return source_.text().substr(source_.begin(id), source_.end(id) - source_.begin(id));
  }
  void add(Loc first, Loc last, bool nested) {
    if (!first || !last || source_.sources.fileOf(first) != source_.file) return;
    const size_t begin = source_.at(first), end = source_.at(last);
    if (begin < to_ && end > from_) parts.push_back({begin, end, nested});
  }

  const Source& source_;
  size_t from_, to_;
};

void blankUnit(std::string& text, const Unit& unit) {
  std::fill(text.begin() + static_cast<std::ptrdiff_t>(unit.begin),
            text.begin() + static_cast<std::ptrdiff_t>(unit.end), ' ');
}

}  // namespace

std::vector<Part> partsAround(const std::string& text, Dialect dialect, uint32_t line) {
  size_t begin = 0;
  for (uint32_t n = 1; n < line && begin < text.size(); ++n)
    begin = std::min(text.find('\n', begin), text.size() - 1) + 1;
  const size_t end = std::min(text.find('\n', begin), text.size());
  const Source source(text, dialect);
  Collector collector(source, begin, end);
  for (const DeclId id : source.decls) collector.collect(id, false, false);
  collector.parts.push_back({begin, end});
  std::stable_sort(collector.parts.begin(), collector.parts.end(),
                   [](const Part& a, const Part& b) { return a.end - a.begin < b.end - b.begin; });
  return collector.parts;
}

void blank(std::string& text, const Part& part) {
  const std::string_view removed = std::string_view(text).substr(part.begin, part.end - part.begin);
  const std::string idle = std::string(kIdleDeclaration) + kIdleStatement;
  const bool is_line = removed.find('\n') == std::string_view::npos;
  const bool is_pou =
      removed.find("END_PROGRAM") != std::string_view::npos || removed.find("END_FUNCTION") != std::string_view::npos;
  const size_t found = is_line && !is_pou ? removed.find(idle) : std::string_view::npos;
  const size_t kept = found == std::string_view::npos ? part.end : part.begin + found;
  for (size_t i = part.begin; i < part.end; ++i)
    if (text[i] != '\n' && (i < kept || i >= kept + idle.size())) text[i] = ' ';
  if (part.nested) text.insert(part.begin, kIdleStatement);
}

void blankEmptySections(std::string& text) {
  Scanner scanner(text);
  std::vector<Unit> since;
  std::vector<Unit> gone;
  for (Unit unit = scanner.nextCode(); unit.kind != UnitKind::End; unit = scanner.nextCode()) {
    const std::string word = unit.kind == UnitKind::Name ? upper(scanner.textOf(unit)) : std::string();
    const bool opens = word == "TYPE" || word == "VAR" || word.starts_with("VAR_");
    if (opens) {
      since = {unit};
    } else if (!since.empty() && (word == "CONSTANT" || word == "RETAIN" || word == "NON_RETAIN")) {
      since.push_back(unit);
    } else {
      if (!since.empty() && (word == "END_TYPE" || word == "END_VAR")) {
        since.push_back(unit);
        gone.insert(gone.end(), since.begin(), since.end());
      }
      since.clear();
    }
  }
  for (const Unit& unit : gone) blankUnit(text, unit);
}

}  // namespace rung::conformance
