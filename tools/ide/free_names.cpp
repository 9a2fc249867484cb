// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/free_names.h"

#include <algorithm>

#include "frontend/source/scanner.h"
#include "frontend/source/text.h"
#include "frontend/syntax/node_at.h"
#include "tools/ide/meanings.h"

namespace rung::ide {
namespace {

constexpr int kLongestLine = 1000;

bool isDerivedFrom(const sema::Project& project, PouId pou, PouId base) {
  int steps = 0;
  for (PouId at = pou; at && steps < kLongestLine; at = project.pou(at).base, ++steps)
    if (at == base) return true;
  return false;
}

// The declaration with its members, in the text that was parsed; whole is false where it is not one piece.
std::string_view textOf(const View& view, DeclId decl) {
  const Range range = extentOf(view.tree(), decl);
  const FileId file = view.sources().fileOf(view.sources().current(range.begin));
  const Loc begin = view.sources().current(range.begin), end = view.sources().current(range.end);
  const std::string_view text = view.sources().sourceText(file);
  const uint32_t base = view.sources().begin(file).offset;
  if (begin.offset < base || end < begin || end.offset - base > text.size()) return text;
  return text.substr(begin.offset - base, end.offset - begin.offset);
}

}  // namespace

bool hasName(std::string_view text, std::string_view name) {
  const auto is_same = [](char a, char b) { return upper(a) == upper(b); };
  for (auto at = text.begin(); at != text.end(); ++at) {
    at = std::search(at, text.end(), name.begin(), name.end(), is_same);
    if (at == text.end()) return false;
    const auto end = at + static_cast<std::ptrdiff_t>(name.size());
    if ((at == text.begin() || !isNameCharacter(at[-1])) && (end == text.end() || !isNameCharacter(*end))) return true;
  }
  return false;
}

std::vector<Range> codeThatSees(const View& view, Entity entity) {
  const sema::Project& project = view.meanings().scope().project();
  if (entity.entityKind() != EntityKind::Var) return {};
  const sema::Var& var = project.vars[entity.index];
  const bool is_local = var.section == SectionKind::Local || var.section == SectionKind::Temp;
  if (!is_local || !var.pou || project.pou(var.pou).owner) return {};
  const PouKind kind = project.pou(var.pou).kind;
  if (kind != PouKind::Function && kind != PouKind::FunctionBlock) return {};
  std::vector<Range> code;
  for (uint32_t i = 1; i < project.pous.size(); ++i) {
    const sema::Pou& pou = project.pous[i];
    if (pou.instance.of || pou.owner || !isDerivedFrom(project, {i}, var.pou)) continue;
    if (!pou.decl) return {};
    const Range whole = extentOf(view.tree(), pou.decl);
    const Range now{view.sources().current(whole.begin), view.sources().current(whole.end)};
    if (!(now.begin < now.end)) return {};
    code.push_back(now);
  }
  return code;
}

bool isFreeFor(const View& view, Entity entity, std::string_view name) {
  const Scope& scope = view.meanings().scope();
  const sema::Project& project = scope.project();
  if (entity.entityKind() != EntityKind::Var) return false;
  const sema::Var& var = project.vars[entity.index];
  if (!var.pou || var.external || project.pou(var.pou).owner || project.pou(var.pou).library) return false;
  const NameId known = view.names().find(name);
  const NameId key = known ? view.names().key(known) : NameId{};
  for (uint32_t i = 1; i < project.pous.size(); ++i) {
    const sema::Pou& pou = project.pous[i];
    const PouId object = pou.owner ? pou.owner : PouId{i};
    if (pou.instance.of || !isDerivedFrom(project, object, var.pou)) continue;
    if (scope.lookUp({i}, key)) return false;
    if (!pou.owner && (!pou.decl || hasName(textOf(view, pou.decl), name))) return false;
  }
  return true;
}

}  // namespace rung::ide
