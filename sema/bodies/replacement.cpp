// SPDX-License-Identifier: Apache-2.0
#include "sema/bodies/replacement.h"

#include <algorithm>
#include <utility>

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

OtherBody::OtherBody(Context& context, PouId pou, DeclId decl)
    : context_(context),
      pou_(pou),
      edges_(context.project.call_edges.size()),
      writes_(context.project.global_writes.size()),
      reported_(context.scopes.reported.size()) {
  for (const Pou& of : context.project.pous) used_.push_back(of.progress.used);
  Pou& of = context.project.pou(pou);
  own_decl_ = std::exchange(of.decl, decl);
  own_body_ = std::exchange(of.body, {});
  own_state_ = std::exchange(of.progress.body, Pou::Progress::Body::New);
}

OtherBody::~OtherBody() {
  Project& project = context_.project;
  Pou& of = project.pou(pou_);
  takeBackMentions(project, of.body.mentions);
  of.decl = own_decl_;
  of.body = std::move(own_body_);
  of.progress.body = own_state_;
  for (size_t i = 0; i < used_.size(); ++i) project.pous[i].progress.used = used_[i];
  project.call_edges.resize(edges_);
  project.global_writes.resize(writes_);
  context_.scopes.reported.resize(reported_);
}

}  // namespace rung::sema
