// SPDX-License-Identifier: Apache-2.0
#include "tools/workspace/analysis.h"

#include <algorithm>
#include <utility>

#include "frontend/parse/parse.h"
#include "sema/project.h"
#include "tools/driver/file_provider.h"

namespace rung::workspace {
namespace {

// Words by which the tree may grow with what is replaced, before it is made again: 32 MB.
constexpr uint32_t kMostGarbage = 8 << 20;

uint64_t nextRevision() {
  static std::atomic<uint64_t> last = 0;
  return ++last;
}

}  // namespace

Analysis::Analysis(driver::ProjectOptions options, const std::atomic<bool>* cancelled)
    : revision(nextRevision()), compilation_(std::move(options), times_, sink_) {
  compilation_.is_edited = true;
  compilation_.cancelled = cancelled;
  compilation_.check();
  compilation_.cancelled = nullptr;
  compilation_.finish();
  first_size_ = compilation_.writtenSize();
  checked_size_ = compilation_.tree.size();
}

bool Analysis::edit(const std::map<std::string, std::string>& texts, const std::atomic<bool>* cancelled) {
  if (!compilation_.checked || !sink_.error_text.empty()) return false;
  for (const auto& [path, text] : texts)
    if (editedFile(path) == nullptr) return false;
  const auto replace = [&](const auto& change) {
    const bool has_room = compilation_.tree.size() < checked_size_ + kMostGarbage;
    return has_room && editedFile(change.first)->replace(change.second);
  };
  const bool is_done = std::all_of(texts.begin(), texts.end(), replace) || checkAgain(texts, cancelled);
  if (is_done) compilation_.finish();
  return is_done;
}

// The declaration of a POU with other statements, which are parsed as a file. None: it has no room.
DeclId Analysis::trialBody(sema::PouId id, const std::string& statements, FileId& file) {
  driver::Compilation& of = compilation_;
  const DeclId decl = of.project->pou(id).decl;
  if (!decl || of.tree.kind(decl) != DeclKind::Pou) return {};
  file = of.sources.add("trial", "PROGRAM trial\n" + statements + "END_PROGRAM\n");
  if (!file) return {};
  of.diagnostics.max_errors = UINT32_MAX;
  const bool lost_names = of.tree.lost_names;
  const FileUnit unit = text::parseFile(of.tree, of.names, of.sources, file, of.options.dialect, of.diagnostics);
  of.tree.lost_names = lost_names;
  of.tree.files.pop_back();
  const std::span<const DeclId> parsed = of.tree.list(unit.decls);
  if (parsed.empty() || of.tree.kind(parsed[0]) != DeclKind::Pou) return {};
  PouDecl pou = of.tree.as<PouDecl>(decl);
  pou.body = of.tree.as<PouDecl>(parsed[0]).body;
  pou.body_kind = BodyKind::St;
  return of.tree.add<DeclId>(pou);
}

// By their lines, the first of which is after that of the header.
std::vector<std::string> Analysis::errorsIn(FileId file, size_t lines) const {
  std::vector<std::string> errors(lines);
  const Sources& sources = compilation_.sources;
  for (const Diagnostic& diagnostic : compilation_.diagnostics.all()) {
    if (diagnostic.severity != Severity::Error || sources.fileOf(diagnostic.loc) != file) continue;
    const SourceLocation at = sources.location(diagnostic.loc);
    if (at.line >= 2 && at.line - 2 < errors.size())
      errors[at.line - 2] += std::to_string(at.column) + ":" + diagInfo(diagnostic.diag).code + " ";
  }
  return errors;
}

bool Analysis::staysUsable(sema::PouId pou, const std::vector<std::string>& statements) const {
  const auto has_address = [](const std::string& statement) { return statement.find('%') != std::string::npos; };
  return compilation_.checked && compilation_.checked->canTryBody(pou) &&
         std::none_of(statements.begin(), statements.end(), has_address);
}

std::vector<std::string> Analysis::errorsOf(sema::PouId id, const std::vector<std::string>& statements) {
  driver::Compilation& of = compilation_;
  std::vector<std::string> errors(statements.size());
  if (!of.checked) return errors;
  const bool is_kept = staysUsable(id, statements);
  const uint32_t size = of.tree.size();
  const size_t known = of.checked->knownBesideBodies(), said = of.diagnostics.all().size();
  const std::vector<bool> eno_read_of = of.tree.eno_read_of;
  const uint32_t most = of.diagnostics.max_errors;
  std::string text;
  for (const std::string& statement : statements) text += statement + "\n";
  FileId file;
  if (const DeclId body = trialBody(id, text, file)) {
    of.diagnostics.closeLines();
    is_kept ? of.checked->tryBodyForNow({id, body}) : of.checked->tryBody({id, body});
    errors = errorsIn(file, statements.size());
  }
  if (!is_kept) return errors;
  size_t at = 0;
  of.diagnostics.retract([&](const Diagnostic& diagnostic) {
    return at++ >= said && (diagnostic.reporter == 0 || diagnostic.reporter == id.index);
  });
  of.diagnostics.max_errors = most;
  of.tree.eno_read_of = eno_read_of;
  if (of.checked->knownBesideBodies() == known) of.tree.truncate(size);
  if (file) of.sources.forget(file);
  return errors;
}

size_t Analysis::errorsOf(const std::vector<sema::CheckedProject::NewBody>& bodies) const {
  const std::vector<Diagnostic>& all = compilation_.diagnostics.all();
  return static_cast<size_t>(std::count_if(all.begin(), all.end(), [&](const Diagnostic& diagnostic) {
    return diagnostic.severity == Severity::Error && std::any_of(bodies.begin(), bodies.end(), [&](const auto& body) {
             return body.pou.index == diagnostic.reporter;
           });
  }));
}

// Of the declarations; kError: the type does not exist, or does not take the initial value.
std::vector<TypeId> Analysis::typesOf(const TypeTrial& trial) {
  driver::Compilation& of = compilation_;
  std::vector<TypeId> types(trial.types.size(), types::kError);
  std::string text = "PROGRAM trial VAR\n";
  for (size_t i = 0; i < types.size(); ++i) text += "t" + std::to_string(i) + " : " + trial.types[i] + ";\n";
  const FileId file = of.sources.add("trial", text + "END_VAR END_PROGRAM\n");
  if (!file) return types;
  of.diagnostics.max_errors = UINT32_MAX;
  const FileUnit unit = text::parseFile(of.tree, of.names, of.sources, file, of.options.dialect, of.diagnostics);
  const std::span<const DeclId> parsed = of.tree.list(unit.decls);
  if (parsed.empty() || of.tree.kind(parsed[0]) != DeclKind::Pou) return types;
  for (const DeclId section : of.tree.list(of.tree.as<PouDecl>(parsed[0]).sections))
    for (const DeclId var : of.tree.list(of.tree.as<SectionDecl>(section).vars)) {
      const uint32_t line = of.sources.location(of.tree.decl(var).loc).line;
      if (line >= 2 && line - 2 < types.size()) types[line - 2] = of.checked->typeOfDeclaration(trial.pou, var);
    }
  const std::vector<std::string> errors = errorsIn(file, types.size());
  for (size_t i = 0; i < types.size(); ++i)
    if (!errors[i].empty()) types[i] = types::kError;
  return types;
}

std::string Analysis::goodTypes(const TypeTrial& trial) {
  driver::Compilation& of = compilation_;
  if (!of.checked) return {};
  const std::vector<TypeId> types = typesOf(trial);
  std::vector<sema::CheckedProject::NewBody> bodies;
  std::vector<FileId> files;
  for (const TypeTrial::Body& body : trial.bodies) {
    const DeclId own = of.project->pou(body.pou).decl;
    const DeclId decl = body.statements.empty() ? own : trialBody(body.pou, body.statements, files.emplace_back());
    if (decl) bodies.push_back({body.pou, decl});
  }
  const auto errorsWith = [&](TypeId type) {
    for (const sema::VarId var : trial.vars) of.project->var(var).type = type;
    if (trial.result_of) of.project->pou(trial.result_of).result = type;
    of.diagnostics.closeLines();
    for (const auto& body : bodies) of.checked->tryBody(body);
    return errorsOf(bodies);
  };
  const size_t known = bodies.empty() ? 0 : errorsWith(types::kError);
  std::string good;
  for (const TypeId type : types)
    good += type && type != types::kError && (bodies.empty() || errorsWith(type) <= known) ? '+' : '-';
  return good;
}

EditedFile* Analysis::editedFile(const std::string& path) {
  const std::string absolute = driver::absolutePath(path);
  const auto known = edited_.find(absolute);
  if (known != edited_.end()) return &known->second;
  const std::vector<driver::InputFile>& files = compilation_.inputs.files;
  const auto file = std::find_if(files.begin(), files.end(), [&](const driver::InputFile& candidate) {
    return driver::absolutePath(candidate.path) == absolute;
  });
  return file == files.end() ? nullptr : &edited_.try_emplace(absolute, compilation_, file->file).first->second;
}

// Parses the edited files alone.
bool Analysis::checkAgain(const std::map<std::string, std::string>& texts, const std::atomic<bool>* cancelled) {
  if (compilation_.writtenSize() > first_size_ + kMostGarbage || compilation_.asksForNames()) return false;
  for (const auto& [path, text] : texts)
    if (!editedFile(path)->take(text)) return false;
  std::vector<FileId> changed;
  for (const auto& [path, file] : edited_) changed.push_back(file.file());
  compilation_.cancelled = cancelled;
  const bool is_done = compilation_.checkAgain(changed);
  compilation_.cancelled = nullptr;
  for (auto& [path, file] : edited_) file.release();
  edited_.clear();
  checked_size_ = compilation_.tree.size();
  revision = nextRevision();
  return is_done && (cancelled == nullptr || !cancelled->load(std::memory_order_relaxed));
}

}  // namespace rung::workspace
