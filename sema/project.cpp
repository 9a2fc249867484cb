// SPDX-License-Identifier: Apache-2.0
// The project and its check: collect, resolve, then every body; library POUs join as they are used.
#include "sema/project.h"

#include <utility>

#include "frontend/schedule/network_pins.h"
#include "frontend/source/dialect.h"
#include "frontend/source/invariant.h"
#include "sema/bodies/signatures.h"
#include "sema/checks/mocks.h"
#include "sema/checks/object_members.h"
#include "sema/checks/task_settings.h"
#include "sema/checks/test_pragmas.h"
#include "sema/declarations/configuration.h"
#include "sema/declarations/declarations.h"
#include "sema/declarations/diagnostics.h"
#include "sema/declarations/instance_paths.h"
#include "sema/declarations/overloads.h"
#include "sema/declarations/test_cases.h"

namespace rung::sema {

Project::Project(Sources& the_sources, Names& the_names, Diagnostics& the_diagnostics, Tree& the_tree,
                 Options the_options)
    : Symbols{the_sources,
              the_names,
              the_diagnostics,
              the_tree,
              profileOf(the_options.dialect),
              the_options.native_width,
              types::TypeTable(the_names, the_options.pointer_size)},
      options(std::move(the_options)) {
  for (const types::MemoryArea& area : options.areas) area_bytes.push_back(area.bytes);
  types.time_is_signed = !profile.unsigned_time;
  types.long_time_is_signed = profile.signed_long_time;
}

VarId ResourceGlobals::of(NameId resource) const {
  VarId found = all.front().var;
  bool is_outer = false;
  for (const Own& own : all) {
    if (own.resource == resource) return own.var;
    if (own.resource || is_outer) continue;
    found = own.var;
    is_outer = true;
  }
  return found;
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
  state = Body::Busy;
  resolvePou(context, id);
  Context there = atPou(context, id);
  checkBody(there, id);
  declareLiteralStorage(context, id);
  const bool broken = isBroken(context, id) || project.diagnostics.errorCount() != errors;
  state = broken ? Body::Broken : Body::Correct;
  return !broken;
}

namespace {

void checkBodies(Context& context) {
  Project& project = context.project;
  for (uint32_t i = 1; i < project.pous.size(); ++i) {  // grows while bodies use library POUs
    if (!project.pous[i].generic) ensureBody(context, PouId{i});
  }
  setPhaseSubject("", 0);
}

// Warns of programs that are not assigned to a task and never called. Manual 5.1: compiled, but never executed.
void checkProgramsRun(Context& context) {
  Project& project = context.project;
  if (project.instances.empty()) return;
  std::vector<bool> runs(project.pous.size());
  for (const ProgramInstance& instance : project.instances) runs[instance.program.index] = true;
  for (uint32_t i = 1; i < project.pous.size(); ++i) {
    const Pou& pou = project.pous[i];
    if (pou.kind != PouKind::Program || pou.library || pou.pragmas.test || pou.pragmas.after_globals ||
        pou.progress.used || runs[i])
      continue;
    context.report(diag::ProgramNeverRuns, pou.loc, {project.names.string(pou.name)});
  }
}

}  // namespace

static void declare(Context& context) {
  setPhase("sema");
  context.symbols.diagnostics.closeLines();
  internKnownNames(context);
  indexLibraries(context);
  collectFiles(context);
  chooseTests(context);
  collectConfigurations(context);
  resolveHeaders(context);
  resolveDeclarations(context);
}

std::vector<bool> inOutsOfBoxes(Project& project) {
  Scopes scopes;
  Context context{.symbols = project, .project = project, .scopes = scopes, .pou = {}, .file = {}};
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
    diagram::markInOuts(project.tree, project.names, signatures, decl.diagram, in_outs);
  }
  return in_outs;
}

void check(Project& project) {
  Scopes scopes;
  Context context{.symbols = project, .project = project, .scopes = scopes, .pou = {}, .file = {}};
  declare(context);
  markOverloads(context);
  resolveConfigurations(context);
  checkTestPragmas(context);
  resolveTestCases(context);
  checkMocks(context);
  for (uint32_t i = 1; i < project.pous.size(); ++i) {
    if (project.pous[i].overloads.index == i) checkOverloads(context, PouId{i});
    if (project.pous[i].decl && !project.pous[i].owner && !project.pous[i].library)
      checkObjectMembers(context, PouId{i});
  }
  checkBodies(context);
  addFreeProgram(context);
  setTaskDurations(context);
  setIoModules(context);
  checkTaskSettings(context);
  declareLiteralStorage(context);
  orderInitialValues(context);
  resolveInstancePaths(context);
  resolveAccessPaths(context);
  checkAfterBodies(context);
  checkProgramsRun(context);
}

}  // namespace rung::sema
