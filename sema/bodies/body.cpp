// SPDX-License-Identifier: Apache-2.0
// The body of a POU in any language. In: a POU whose declarations are resolved. Out: its statements, scheduled where it
// is IL, SFC or a diagram, and checked. Called for each POU of the project, and for each library POU in use.
#include "sema/bodies/body.h"

#include <utility>

#include "frontend/schedule/il_schedule.h"
#include "frontend/schedule/network_schedule.h"
#include "frontend/schedule/sfc_schedule.h"
#include "frontend/source/invariant.h"
#include "sema/bodies/cpp_bodies.h"
#include "sema/bodies/literal_storage.h"
#include "sema/bodies/statements.h"
#include "sema/bodies/temporaries.h"
#include "sema/declarations/charts.h"
#include "sema/declarations/names.h"
#include "sema/declarations/signatures.h"
#include "sema/declarations/variables.h"
#include "sema/hooks.h"
#include "sema/project.h"
#include "sema/shorthands.h"

namespace rung::sema {

// Turns a body in IL, SFC or networks into statements, once the declarations of all files are known.
static void schedule(Context& context, const PouDecl& decl) {
  Pou& pou = context.symbols.pou(context.pou);
  const BodyKind kind = decl.body_kind;
  if (pou.body.scheduled || (kind != BodyKind::Il && kind != BodyKind::Sfc && kind != BodyKind::Network)) return;
  ProjectSignatures signatures(context);
  Tree& tree = context.symbols.arena;
  Diagnostics& diagnostics = context.symbols.diagnostics;
  pou.body.scheduled = true;
  const auto take = [&](const ScheduledBody& made) {
    pou.body.statements = made.body;
    declareTemporaries(context, made.temporaries);
  };
  if (kind == BodyKind::Network) {
    take(diagram::scheduleNetworks(tree, context.names(), diagnostics, signatures, context.project.network_variables,
                                   context.project.options.edge_coils, decl));
  } else if (kind == BodyKind::Il) {
    take(text::scheduleIl(tree, context.names(), diagnostics, signatures, decl.il, context.profile().short_circuit));
  } else {
    if (decl.is_broken) return;
    const auto body = text::scheduleSfc(chartsOf(context), signatures, decl, chartContextOf(context, context.pou));
    if (!body) return;
    pou.body.statements = *body;
  }
  if (context.project.options.scheduled) context.project.options.scheduled(context.project, context.pou);
}

void checkBody(Context& context, PouId id) {
  Pou& pou = context.symbols.pou(id);
  if (!pou.decl) return;
  resolvePou(context, id);
  const PouDecl& decl = context.tree().as<PouDecl>(pou.decl);
  if (decl.body_kind == BodyKind::Native || pou.generic) return;
  const std::string_view name = string(context, pou.name);
  setPhaseSubject(name.data(), name.size());
  BodyState body;
  Context inner{.symbols = context.symbols,
                .project = context.project,
                .scopes = context.scopes,
                .pou = id,
                .file = pou.file,
                .body = &body,
                .library = pou.library,
                .region = context.region,
                .resource = context.resource,
                .rules = context.rules,
                .expressions = context.expressions};
  if (decl.body_kind == BodyKind::Cpp) return checkCppBody(inner, decl);
  pou.body.statements = decl.body;
  schedule(inner, decl);
  pou.body.code = inner.code().copy(pou.body.statements);
  body.statements = pou.body.code;
  checkStatements(inner, pou.body.code);
  finalizeTemporaries(inner);
  context.rules->pou(inner);
}

bool ensureBody(Context& context, PouId id) {
  using Body = Pou::Progress::Body;
  Project& project = context.project;
  Body& state = project.pou(id).progress.body;
  if (state != Body::New) return state == Body::Correct;
  const Pou& pou = project.pou(id);
  if (pou.pragmas.native || (pou.owner && (pou.object.modifiers & kAbstract) != 0)) {
    state = Body::Correct;
    return true;
  }
  const std::string_view name = project.names.string(pou.name);
  setPhaseSubject(name.data(), name.size());
  const uint32_t errors = project.diagnostics.errorCount();
  const uint32_t reporter = std::exchange(project.diagnostics.reporter, id.index);
  state = Body::Busy;
  resolvePou(context, id);
  Context there = atPou(context, id);
  checkBody(there, id);
  declareLiteralStorage(context, id);
  project.diagnostics.reporter = reporter;
  const bool broken = isBroken(context, id) || project.diagnostics.errorCount() != errors;
  state = broken ? Body::Broken : Body::Correct;
  return !broken;
}

}  // namespace rung::sema
