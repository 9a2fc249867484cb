// SPDX-License-Identifier: Apache-2.0
// `rung fmt`: files in one style, in place; and the text of an editor in this style. Every file is parsed first,
// because bodies in IL are known by their POU only, and a file with syntax errors stays as it is. Files are written
// whole, and only when they change.
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <map>
#include <set>

#include "frontend/format/format.h"
#include "frontend/import/diagnostics.h"
#include "frontend/import/formats.h"
#include "frontend/syntax/sfc.h"
#include "tools/driver/changes.h"
#include "tools/driver/commands.h"
#include "tools/driver/compile.h"
#include "tools/driver/encoding.h"
#include "tools/driver/formatted_text.h"

namespace rung::driver {
namespace {

namespace fs = std::filesystem;
using importer::Formatting;

constexpr const char* kStandardInput = "stdin.st";

// Tells whether it reports a body in a form that Rung does not read: nothing of it is formatted.
bool isUnreadBody(Diag diag) {
  return diag == diag::NetworkBody || diag == diag::XmlBodyLanguage || diag == diag::ArchiveObject ||
         diag == diag::ArchiveIl;
}

// What is wrong has been reported when the file was read.
std::vector<importer::TextPart> partsOf(FileKind kind, std::string_view text) {
  Sources sources;
  const FileId file = sources.add({}, std::string(text));
  Diagnostics unused(sources);
  return file ? importer::formatOf(kind).parts(sources, file, unused) : std::vector<importer::TextPart>();
}

// The bodies in IL of each file.
class BodyFinder {
 public:
  BodyFinder(const Compilation& compilation) : tree_(compilation.tree), sources_(compilation.sources) {
    for (const FileUnit& unit : tree_.files) visit(unit.decls);
    for (auto& [file, bodies] : found_)
      std::sort(bodies.il.begin(), bodies.il.end(), [](const auto& a, const auto& b) { return a.begin < b.begin; });
  }
  const format::Bodies& of(FileId file) {
    return found_[sources_.fileOf(sources_.originalLocation(sources_.begin(file))).index];
  }

 private:
  void visit(Slice<DeclId> decls) {
    for (const DeclId id : tree_.list(decls)) visit(id);
  }
  void visit(DeclId id) {
    if (tree_.kind(id) == DeclKind::Namespace) visit(tree_.as<NamespaceDecl>(id).decls);
    if (tree_.kind(id) == DeclKind::Property) {
      const auto& property = tree_.as<PropertyDecl>(id);
      if (property.get) visit(property.get);
      if (property.set) visit(property.set);
    }
    if (tree_.kind(id) != DeclKind::Pou) return;
    const auto& pou = tree_.as<PouDecl>(id);
    visit(pou.members);
    for (const SfcTransition& transition : tree_.list(pou.transitions))
      if (transition.body) visit(transition.body);
    if (pou.body_kind != BodyKind::Il) return;
    const Loc begin = sources_.originalLocation(pou.body_begin);
    const Loc last = sources_.originalLocation({pou.body_end.offset - 1});
    const FileId file = sources_.fileOf(begin);
    const uint32_t base = sources_.begin(file).offset;
    found_[file.index].il.push_back({begin.offset - base, last.offset + 1 - base});
  }

  const Tree& tree_;
  const Sources& sources_;
  std::map<uint32_t, format::Bodies> found_;
};

class FileFormatter {
 public:
  FileFormatter(Compilation& compilation, const FormatOptions& options, Sink& sink)
      : compilation_(compilation), options_(options), sink_(sink), bodies_(compilation) {
    const Sources& sources = compilation.sources;
    for (const Diagnostic& diagnostic : compilation.diagnostics.all())
      if (diagnostic.severity == Severity::Error && diagnostic.loc && !isUnreadBody(diagnostic.diag))
        broken_.insert(std::string(sources.path(sources.fileOf(sources.originalLocation(diagnostic.loc)))));
  }

  // It has no syntax errors.
  bool canFormat(const InputFile& input) const { return broken_.count(input.below) == 0; }

  // The exit code.
  int run() {
    for (const std::vector<InputFile>* files : {&compilation_.inputs.files, &compilation_.inputs.message_files})
      for (const InputFile& input : *files)
        if (!input.is_library && canFormat(input) && !format(input)) return kUsage;
    if (options_.only_checks && !options_.shows_changes) {
      const std::string error = sink_.output(listed_);
      if (!error.empty()) return usageError(sink_, error);
    }
    return options_.only_checks && changed_ > 0 ? kInputErrors : kSuccess;
  }

  std::string text(const InputFile& input, std::string_view source) {
    const Dialect dialect = compilation_.options.dialect;
    const format::Style& style = compilation_.inputs.project.style;
    switch (importer::formatOf(input.kind).formatting) {
      case Formatting::Text: {
        // The halves of a pair of files were joined: what the parser saw is not this file.
        const bool is_parsed = compilation_.sources.original(input.file) == source;
        static const format::Bodies kNone;
        return format::formatted(source, is_parsed ? bodies_.of(input.file) : kNone, style, dialect, options_.lines);
      }
      case Formatting::Ladder: return format::formattedLadder(source, style, options_.lines);
      case Formatting::Messages: return format::formattedMessages(source, style, options_.lines);
      case Formatting::Xml: return format::formattedXml(source, style, dialect);
      case Formatting::Parts: {
        std::vector<format::Span> parts;
        for (const importer::TextPart& part : partsOf(input.kind, source)) parts.push_back({part.begin, part.end});
        return format::formattedParts(source, parts, bodies_.of(input.file), style, dialect);
      }
      case Formatting::None: return std::string(source);
    }
    return std::string(source);
  }

 private:
  // False: an error has been printed.
  bool format(const InputFile& input) {
    const Formatting formatting = importer::formatOf(input.kind).formatting;
    const bool is_text =
        formatting == Formatting::Text || formatting == Formatting::Ladder || formatting == Formatting::Messages;
    if (!is_text && options_.lines.last != UINT32_MAX)
      return fail("`--lines` takes a file of ST, IL or NCT, not `" + input.shown + "`");
    ReadResult read = readFile(input.path);
    if (!read.error.empty()) return fail("cannot read `" + input.shown + "`: " + read.error);
    Encoding encoding;
    if (!decode(read.content, encoding)) return fail("`" + input.shown + "` is not UTF-16");
    const std::string_view source = read.content;
    const std::string result = text(input, source);
    if (result == source) return true;
    ++changed_;
    listed_ += input.shown + "\n";
    if (options_.shows_changes) {
      const std::string error = sink_.output(changesOf(source, result, input.shown));
      return error.empty() || fail(error);
    }
    if (options_.only_checks) return true;
    const std::string problem = rewriteFile(input.path, encoded(result, encoding));
    return problem.empty() || fail(problem);
  }

  bool fail(const std::string& what) {
    sink_.error(what);
    return false;
  }

  Compilation& compilation_;
  const FormatOptions& options_;
  Sink& sink_;
  BodyFinder bodies_;
  std::set<std::string> broken_;  // files with errors
  std::string listed_;
  uint32_t changed_ = 0;
};

int formatStandardInput(ProjectOptions project, const FormatOptions& options, Sink& sink) {
  std::string text{std::istreambuf_iterator<char>(std::cin), std::istreambuf_iterator<char>()};
  Encoding encoding;
  if (!decode(text, encoding)) return usageError(sink, "standard input is not UTF-16");
  project.inputs = {kStandardInput};
  project.unsaved = {{kStandardInput, text}};
  PhaseTimes times;
  Compilation compilation(project, times, sink);
  compilation.parse();
  const int exit = compilation.finish();
  if (exit == kUsage || exit == kInternal || compilation.inputs.files.empty()) return exit;
  FileFormatter formatter(compilation, options, sink);
  const InputFile& input = compilation.inputs.files.front();
  if (!formatter.canFormat(input)) return exit;
  const std::string result = formatter.text(input, text);
  if (options.only_checks) return result == text ? exit : kInputErrors;
  const int printed =
      printResult(sink, options.shows_changes ? changesOf(text, result, "stdin") : encoded(result, encoding));
  return exit != kSuccess ? exit : printed;
}

// Nothing that is only wrong in what the program means matters, and no limit may hide a mistake.
ProjectOptions forFormatting(ProjectOptions project) {
  project.report.warnings.push_back({"all", false});
  project.report.max_errors = ~0u;  // beyond a limit a file would seem to have none
  return project;
}

}  // namespace

std::optional<std::string> formattedText(const ProjectOptions& given, const UnsavedFile& file,
                                         const format::Style& style, format::LineRange lines) {
  ProjectOptions project = forFormatting(given);
  project.inputs = {file.path};
  project.unsaved = {file};
  PhaseTimes times;
  SilentSink sink;
  Compilation compilation(project, times, sink);
  if (!compilation.parse() || compilation.inputs.files.size() != 1) return std::nullopt;
  compilation.inputs.project.style = style;
  FormatOptions options;
  options.lines = lines;
  FileFormatter formatter(compilation, options, sink);
  const InputFile& input = compilation.inputs.files.front();
  if (!formatter.canFormat(input)) return std::nullopt;
  return formatter.text(input, file.text);
}

int runFormat(const ProjectOptions& given, const FormatOptions& options, Sink& sink) {
  const ProjectOptions project = forFormatting(given);
  const bool reads_input = std::find(project.inputs.begin(), project.inputs.end(), "-") != project.inputs.end();
  if (reads_input && project.inputs.size() > 1)
    return usageError(sink, "`-` is standard input; name no file beside it");
  if (reads_input) return formatStandardInput(project, options, sink);
  PhaseTimes times;
  Compilation compilation(project, times, sink);
  compilation.parse();
  const int exit = compilation.finish();
  if (exit == kUsage || exit == kInternal) return exit;
  const int result = FileFormatter(compilation, options, sink).run();
  return exit != kSuccess ? exit : result;
}

}  // namespace rung::driver
