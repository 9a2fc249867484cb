// SPDX-License-Identifier: Apache-2.0
#include "sema/bodies/replacement.h"

#include <algorithm>
#include <vector>

#include "sema/project.h"
#include "sema/scopes.h"

namespace rung::sema {
namespace {

bool declaresTemporaries(const Symbols& symbols, PouId pou) {
  const std::vector<VarId>& vars = symbols.pou(pou).vars;
  return std::any_of(vars.begin(), vars.end(), [&](VarId var) {
    const Var& of = symbols.var(var);
    return of.section == SectionKind::Temp || of.sharing.holds;
  });
}

// Whether the names in the body decide where temporaries live: declarations/shared_temporaries.cpp.
bool sharesTemporaries(const Symbols& symbols, PouId id) {
  const Pou& pou = symbols.pou(id);
  if (pou.kind != PouKind::Action && !pou.base) return false;
  for (PouId at = pou.owner ? pou.owner : id; at; at = symbols.pou(at).base)
    if (declaresTemporaries(symbols, at)) return true;
  return false;
}

void takeBackMentions(Symbols& symbols, const std::vector<Mention>& mentions) {
  for (const Mention& mention : mentions) {
    if (mention.access == Access::Qualifier || mention.access == Access::Pin) continue;  // not counted
    VarId var = mention.entity.entityKind() == EntityKind::Var ? VarId{mention.entity.index} : VarId{};
    for (; var; var = symbols.var(var).external) {
      Var::Used& used = symbols.var(var).used;
      if (reads(mention.access)) --used.reads;
      if (mention.access != Access::Read) --used.writes;
    }
  }
}

}  // namespace

bool isReplaceable(Context& context, PouId id) {
  const Symbols& symbols = context.symbols;
  const Pou& pou = symbols.pou(id);
  const bool is_own = !pou.library && pou.decl && !pou.generic && !pou.instance.of;
  return is_own && context.tree().as<PouDecl>(pou.decl).body_kind == BodyKind::St && !pou.pragmas.native &&
         !pou.body.affects_others && !sharesTemporaries(symbols, id);
}

void takeBackBodies(Context& context, std::span<const PouId> pous) {
  Project& project = context.project;
  std::vector<bool> is_gone(project.pous.size());
  for (const PouId id : pous) {
    is_gone[id.index] = true;
    Pou& pou = project.pou(id);
    takeBackMentions(project, pou.body.mentions);
    pou.body = {};
    pou.progress.body = Pou::Progress::Body::New;
  }
  std::erase_if(project.call_edges, [&](const Project::CallEdge& edge) { return is_gone[edge.caller.index]; });
  std::erase_if(project.global_writes, [&](const Project::GlobalWrite& write) { return is_gone[write.pou.index]; });
  std::erase_if(context.scopes.reported, [&](const Scopes::Reported& known) { return is_gone[known.body.index]; });
  project.diagnostics.retract([&](const Diagnostic& diagnostic) {
    return diagnostic.reporter < is_gone.size() && is_gone[diagnostic.reporter];
  });
}

}  // namespace rung::sema
