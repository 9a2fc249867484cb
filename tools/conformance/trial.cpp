// SPDX-License-Identifier: Apache-2.0
#include "tools/conformance/trial.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <set>

#include "frontend/source/scanner.h"
#include "frontend/syntax/children.h"
#include "sema/project.h"
#include "tools/conformance/program.h"
#include "tools/driver/commands.h"
#include "tools/driver/compile.h"

namespace rung::conformance {
namespace {

namespace fs = std::filesystem;

// Keeps what a command says.
class Listener : public driver::Sink {
 public:
  Listener() : stream_(open_memstream(&bytes_, &size_)) {}
  ~Listener() override {
    if (stream_ != nullptr) std::fclose(stream_);
    std::free(bytes_);
  }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  void message(std::string_view text) override { said_ += text; }
  std::string output(std::string_view text) override {
    said_ += text;
    return {};
  }
  void internalError(std::string_view what) override { said_ += what; }
  std::FILE* programOutput() override { return stream_; }
  std::FILE* programErrors() override { return stream_; }

  std::string said() {
    std::fflush(stream_);
    return said_ + std::string(bytes_, size_);
  }

 private:
  std::string said_;
  char* bytes_ = nullptr;
  size_t size_ = 0;
  std::FILE* stream_;
};

driver::ProjectOptions projectOf(const std::string& file, Dialect dialect) {
  driver::ProjectOptions project;
  project.inputs = {file};
  project.dialect = dialect;
  project.dialect_given = true;
  return project;
}

std::set<std::string> namesIn(std::string_view text) {
  std::set<std::string> names;
  Scanner scanner(text);
  for (Unit unit = scanner.nextCode(); unit.kind != UnitKind::End; unit = scanner.nextCode())
    if (unit.kind == UnitKind::Name) names.insert(upper(scanner.textOf(unit)));
  return names;
}

// A conversion that was written has become the same node; its location is that of the function's name.
bool isConversion(std::string_view name) {
  const std::string word = upper(name);
  return word.find("TO_") != std::string::npos || word.find("TRUNC") != std::string::npos;
}

// Inputs of ANY_INT and ANY_NUM in the standard that the library declares with one type.
bool takesAnyNumber(std::string_view function) {
  static const std::set<std::string> kNames = {"LEFT", "RIGHT", "MID",     "INSERT",  "DELETE",   "REPLACE",
                                               "SHL",  "SHR",   "ROL",     "ROR",     "EXPT",     "MUX",
                                               "MUL",  "DIV",   "MULTIME", "DIVTIME", "MUL_TIME", "DIV_TIME"};
  return kNames.count(upper(function)) != 0;
}

// Tells whether the operand may have another type than the operation: a duration is multiplied by any number.
bool mayDiffer(const driver::Compilation& compilation, ExprId parent) {
  const Tree& tree = compilation.tree;
  const types::TypeTable& table = compilation.project->types;
  if (tree.kind(parent) == ExprKind::Call) {
    const ExprId callee = tree.as<CallExpr>(parent).callee;
    return callee && tree.kind(callee) == ExprKind::Name &&
           takesAnyNumber(compilation.sources.tokenAt(tree.loc(callee)));
  }
  if (tree.kind(parent) != ExprKind::Binary) return false;
  const auto isTime = [&](ExprId id) {
    const types::TypeKind kind = table.plainKind(sema::typeOf(tree, id));
    return types::TypeTable::isDuration(kind) || types::TypeTable::isDate(kind);
  };
  return isTime(tree.as<BinaryExpr>(parent).left) || isTime(tree.as<BinaryExpr>(parent).right);
}

// Lines with an implicit conversion from one elementary type to another, and with an integer literal used as a REAL.
template <class Id>
void collectConversions(const driver::Compilation& compilation, Id id, std::vector<uint32_t>& lines) {
  const Tree& tree = compilation.tree;
  if constexpr (std::is_same_v<Id, ExprId>) {
    const types::TypeTable& table = compilation.project->types;
    const Loc loc = tree.loc(id);
    if (tree.kind(id) == ExprKind::Convert) {
      const types::TypeKind from = table.plainKind(sema::typeOf(tree, tree.as<ConvertExpr>(id).operand));
      const types::TypeKind to = table.plainKind(sema::typeOf(tree, id));
      const bool is_text = types::TypeTable::isString(from) || types::TypeTable::isString(to);
      const bool is_written = isConversion(compilation.sources.tokenAt(loc));
      if (loc && !is_written && from != to && !is_text && types::TypeTable::isElementary(from) &&
          types::TypeTable::isElementary(to))
        lines.push_back(compilation.sources.lineNumber(loc));
    } else if (tree.kind(id) == ExprKind::Literal && tree.as<LiteralExpr>(id).literal() == LiteralKind::Real && loc) {
      const std::string_view token = compilation.sources.tokenAt(loc);
      if (!token.empty() && token.find_first_not_of("0123456789_") == std::string_view::npos)
        lines.push_back(compilation.sources.lineNumber(loc));
    }
  }
  const auto operandsMayDiffer = [&] {
    if constexpr (std::is_same_v<Id, ExprId>)
      return mayDiffer(compilation, id);
    else
      return false;
  };
  forEachChild(tree, id, [&](const auto& child) {
    if constexpr (std::is_same_v<std::decay_t<decltype(child)>, ExprId>) {
      if (tree.kind(child) == ExprKind::Convert && operandsMayDiffer())
        return collectConversions(compilation, tree.as<ConvertExpr>(child).operand, lines);
    }
    collectConversions(compilation, child, lines);
  });
}

}  // namespace

// Those of a file: in bodies and in initial values.
void collectConversions(const driver::Compilation& compilation, FileId file, std::vector<uint32_t>& lines) {
  const sema::Project& project = *compilation.project;
  for (const sema::Pou& pou : project.pous) {
    if (pou.file != file) continue;
    for (const StmtId statement : compilation.tree.list(pou.body.code))
      collectConversions(compilation, statement, lines);
  }
  for (const sema::Var& var : project.vars)
    if (var.init && var.loc && compilation.sources.fileOf(var.loc) == file)
      collectConversions(compilation, var.init, lines);
}

Checked check(const std::string& file, Dialect dialect) {
  Listener listener;
  driver::PhaseTimes times;
  driver::Compilation compilation(projectOf(file, dialect), times, listener);
  Checked checked;
  compilation.check();
  checked.refused = compilation.exitCode() == driver::kUsage;
  compilation.finish();
  for (const Diagnostic& diagnostic : compilation.diagnostics.all()) {
    if (diagnostic.severity != Severity::Error) continue;
    const Loc loc = diagnostic.loc ? compilation.sources.originalLocation(diagnostic.loc) : diagnostic.loc;
    checked.errors.push_back(
        {diagInfo(diagnostic.diag).code, diagnostic.message, diagnostic.loc ? compilation.sources.lineNumber(loc) : 0});
  }
  if (!compilation.project) return checked;
  if (!compilation.tree.files.empty())
    collectConversions(compilation, compilation.tree.files[0].file, checked.conversions);
  const std::set<std::string> named = namesIn(readFile(file).content);
  for (const sema::Pou& pou : compilation.project->pous) {
    if (!pou.library || pou.owner || !pou.name || pou.instance.of) continue;
    const std::string name(compilation.names.string(pou.name));
    if (named.count(upper(name)) != 0)
      checked.library_pous.emplace_back(name, compilation.names.string(pou.library_name));
  }
  std::sort(checked.library_pous.begin(), checked.library_pous.end());
  checked.library_pous.erase(std::unique(checked.library_pous.begin(), checked.library_pous.end()),
                             checked.library_pous.end());
  return checked;
}

Ran run(const std::string& file, Dialect dialect, const RunSetting& setting) {
  Listener listener;
  driver::RunOptions options;
  options.native.jobs = 1;
  options.engine = driver::Engine::Interpreter;
  const std::string trace = file + ".trace";
  options.host_arguments = {"--cycles=" + std::to_string(setting.cycles), "--trace=" + trace,
                            "--watch=" + joined(setting.watch, ",")};
  options.host_arguments.insert(options.host_arguments.end(), setting.options.begin(), setting.options.end());
  Ran ran;
  ran.exit = driver::runRun(projectOf(file, dialect), options, listener);
  ran.messages = listener.said();
  ran.trace = linesOf(readFile(trace).content);
  std::error_code error;
  fs::remove(trace, error);
  return ran;
}

std::string asSt(const std::string& file) {
  Listener listener;
  driver::PhaseTimes times;
  driver::Compilation compilation(projectOf(file, Dialect::Codesys), times, listener);
  if (!compilation.parse() || compilation.diagnostics.hasErrors() || compilation.tree.files.empty()) return {};
  return std::string(compilation.sources.sourceText(compilation.tree.files[0].file));
}

std::string asXml(const std::string& file, const std::string& scratch) {
  Listener listener;
  driver::ConvertOptions options;
  options.to = driver::ConvertTo::Xml;
  options.output = scratch;
  if (driver::runConvert(projectOf(file, Dialect::Iec3), options, listener) != driver::kSuccess) return {};
  const std::string path = scratch + "/" + fs::path(file).stem().string() + ".xml";
  std::string text = readFile(path).content;
  std::error_code error;
  fs::remove(path, error);
  return text;
}

}  // namespace rung::conformance
