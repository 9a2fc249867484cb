// SPDX-License-Identifier: Apache-2.0
#include "sema/check.h"

#include <algorithm>

#include "frontend/schedule/network_pins.h"
#include "frontend/source/invariant.h"
#include "sema/bodies/body.h"
#include "sema/bodies/for_declarations.h"
#include "sema/bodies/literal_storage.h"
#include "sema/bodies/replacement.h"
#include "sema/checks/rules.h"
#include "sema/declarations/access_paths.h"
#include "sema/declarations/call_graph.h"
#include "sema/declarations/chosen_tests.h"
#include "sema/declarations/collect.h"
#include "sema/declarations/configuration.h"
#include "sema/declarations/initial_order.h"
#include "sema/declarations/initial_values.h"
#include "sema/declarations/instance_paths.h"
#include "sema/declarations/libraries.h"
#include "sema/declarations/objects.h"
#include "sema/declarations/overloads.h"
#include "sema/declarations/resolve.h"
#include "sema/declarations/signatures.h"
#include "sema/declarations/test_cases.h"
#include "sema/declarations/types.h"
#include "sema/scopes.h"

namespace rung::sema {
namespace {

// Reporters beside the bodies, each of which has the index of its POU.
constexpr uint32_t kByDeclarations = ~0u, kByRules = ~0u - 1;

void declare(Context& context) {
  setPhase("sema");
  context.symbols.diagnostics.closeLines();
  context.symbols.diagnostics.reporter = kByDeclarations;
  internKnownNames(context);
  indexLibraries(context);
  collectFiles(context);
  chooseTests(context);
  collectConfigurations(context);
  resolveHeaders(context);
  resolveDeclarations(context);
}

bool isCancelled(const Project& project) {
  return project.options.cancelled != nullptr && project.options.cancelled->load(std::memory_order_relaxed);
}

void checkBodies(Context& context) {
  Project& project = context.project;
  for (uint32_t i = 1; i < project.pous.size(); ++i) {  // grows while bodies use library POUs
    if (isCancelled(project)) break;
    if (!project.pous[i].generic) ensureBody(context, PouId{i});
  }
  setPhaseSubject("", 0);
}

}  // namespace

Context contextOf(Project& project, Scopes& scopes) {
  return Context{.symbols = project,
                 .project = project,
                 .scopes = scopes,
                 .pou = {},
                 .file = {},
                 .rules = &allRules(),
                 .expressions = &expressionsForDeclarations()};
}

std::vector<bool> inOutsOfBoxes(Project& project) {
  Scopes scopes;
  Context context = contextOf(project, scopes);
  declare(context);
  std::vector<bool> in_outs;
  const auto count = static_cast<uint32_t>(project.pous.size());  // those of libraries are added on demand
  for (uint32_t i = 1; i < count; ++i) {
    const Pou& pou = project.pous[i];
    if (pou.library || !pou.decl) continue;
    const PouDecl& decl = project.tree.as<PouDecl>(pou.decl);
    if (decl.body_kind != BodyKind::Network) continue;
    Context there = atPou(context, PouId{i});
    ProjectSignatures signatures(there);
    diagram::markInOuts(project.tree, project.names, signatures, project.network_variables, decl.diagram, in_outs);
  }
  return in_outs;
}

std::vector<ConstantCam> constantCams(Project& project) {
  Scopes scopes;
  Context context = contextOf(project, scopes);
  return constantCams(context);
}

static void checkRules(Context& context) {
  sortEffects(context.project);
  context.symbols.diagnostics.reporter = kByRules;
  context.rules->project(context);
  context.symbols.diagnostics.reporter = 0;
}

static void checkAll(Project& project, Scopes& scopes) {
  Context context = contextOf(project, scopes);
  declare(context);
  markOverloads(context);
  resolveConfigurations(context);
  resolveTestCases(context);
  for (uint32_t i = 1; i < project.pous.size(); ++i)
    if (project.pous[i].overloads.first.index == i) checkOverloads(context, PouId{i});
  context.rules->declarations(context);
  checkBodies(context);
  if (isCancelled(project)) return;
  addFreeProgram(context);
  setTaskDurations(context);
  setIoModules(context);
  declareLiteralStorage(context);
  orderInitialValues(context);
  resolveInstancePaths(context);
  resolveAccessPaths(context);
  checkRules(context);
}

void check(Project& project) {
  Scopes scopes;
  checkAll(project, scopes);
}

CheckedProject::CheckedProject(Project& project) : project_(project), scopes_(std::make_unique<Scopes>()) {
  checkAll(project_, *scopes_);
}

CheckedProject::~CheckedProject() = default;

std::span<const FileId> CheckedProject::librarySources() const { return scopes_->libraries.sources; }

size_t CheckedProject::knownBesideBodies() const {
  const auto checked = static_cast<size_t>(
      std::count_if(project_.pous.begin(), project_.pous.end(), [](const Pou& pou) { return pou.progress.checked(); }));
  return checked + project_.vars.size() + project_.pous.size() + project_.global_lists.size() + scopes_->code.size() +
         scopes_->written_types.size() + scopes_->initial_values.size();
}

void CheckedProject::tryBody(const NewBody& body) {
  Context context = contextOf(project_, *scopes_);
  takeBackBodies(context, {&body.pou, 1});
  project_.pou(body.pou).decl = body.decl;
  scopes_->reports_all = true;
  ensureBody(context, body.pou);
}

TypeId CheckedProject::typeOfDeclaration(PouId pou, DeclId var) {
  Context context = contextOf(project_, *scopes_);
  Context there = pou ? atPou(context, pou) : context;
  scopes_->reports_all = true;
  const VarDecl& decl = there.tree().as<VarDecl>(var);
  const TypeId type = resolveType(there, decl.type);
  if (type && type != types::kError && ensureLayout(there, type))
    if (ExprId init = there.code().copy(decl.init)) checkInitializer(there, init, type);
  return type;
}

bool CheckedProject::canTryBody(PouId pou) {
  Context context = contextOf(project_, *scopes_);
  const Diagnostics& diagnostics = project_.diagnostics;
  return isReplaceable(context, pou) && diagnostics.droppedCount() + diagnostics.droppedWarningCount() == 0;
}

void CheckedProject::tryBodyForNow(const NewBody& body) {
  Context context = contextOf(project_, *scopes_);
  const OtherBody other(context, body.pou, body.decl);
  scopes_->reports_all = true;
  ensureBody(context, body.pou);
  scopes_->reports_all = false;
}

bool CheckedProject::replaceBodies(std::span<const NewBody> bodies) {
  Context context = contextOf(project_, *scopes_);
  std::vector<PouId> pous;
  for (const NewBody& body : bodies) pous.push_back(body.pou);
  const auto may_be_replaced = [&](PouId pou) { return isReplaceable(context, pou); };
  if (!std::all_of(pous.begin(), pous.end(), may_be_replaced)) return false;
  Diagnostics& diagnostics = project_.diagnostics;
  takeBackBodies(context, pous);
  diagnostics.retract([](const Diagnostic& diagnostic) { return diagnostic.reporter == kByRules; });
  diagnostics.closeLines();
  for (const NewBody& body : bodies) project_.pou(body.pou).decl = body.decl;
  checkBodies(context);
  declareLiteralStorage(context);
  checkRules(context);
  return std::all_of(pous.begin(), pous.end(), may_be_replaced);
}

}  // namespace rung::sema
