// SPDX-License-Identifier: Apache-2.0
// `rung list`: the libraries, the POUs or tasks of a project, the warnings, or the declaration of a library block.
#include <algorithm>
#include <cstdio>

#include "frontend/syntax/keywords.h"
#include "sema/declarations/libraries.h"
#include "tools/driver/commands.h"
#include "tools/driver/compile.h"
#include "tools/driver/libraries.h"
#include "tools/driver/list.h"

namespace rung::driver {
namespace {

int listPous(const ProjectOptions& project, Sink& sink) {
  if (project.inputs.empty()) return usageError(sink, "`rung list pous` needs files or folders to read");
  PhaseTimes times;
  Compilation compilation(project, times, sink);
  if (!compilation.parse() || compilation.diagnostics.hasErrors()) return compilation.finish();
  const Tree& tree = compilation.tree;
  List list(project.report);
  for (const FileUnit& unit : tree.files) {
    for (DeclId id : tree.list(unit.decls)) {
      if (tree.kind(id) != DeclKind::Pou) continue;
      const PouDecl& pou = tree.as<PouDecl>(id);
      std::string name(compilation.names.string(pou.name)), shown(compilation.sources.displayPath(unit.file));
      const uint32_t line = compilation.sources.location(pou.h.loc).line;
      list.add(
          std::string(keywordOf(pou.pou_kind)) + " " + name + "  " + shown + ":" + std::to_string(line) + "\n",
          JsonRow().text("kind", keywordOf(pou.pou_kind)).text("name", name).text("file", shown).number("line", line));
    }
  }
  int exit = compilation.finish();
  return exit == kSuccess ? printResult(sink, list.text()) : exit;
}

// One line each: the code, the name for `-W` and the message, with A, B, ... for its arguments.
int listWarnings(const ProjectOptions& project, Sink& sink) {
  List list(project.report);
  for (const DiagInfo& info : allDiags()) {
    if (info.severity == Severity::Error) continue;
    const std::string name = switchName(info);
    const std::string padding(name.size() < 30 ? 30 - name.size() : 0, ' ');
    const std::string message = formatMessage(info.text, {"A", "B", "C", "D", "E", "F"});
    list.add(std::string(info.code) + "  " + name + padding + "  " + message + "\n",
             JsonRow().text("code", info.code).text("name", name).text("message", message));
  }
  return printResult(sink, list.text());
}

// Visits every name that the libraries declare, with the range of its source.
template <class Visit>
void eachBlock(const LibrarySet& libraries, Visit visit) {
  for (const sema::LibraryFile& file : libraries.files())
    for (const sema::IndexedBlock& block : sema::indexLibrary(file.source)) visit(file, block);
}

int listLibraries(const ProjectOptions& project, Sink& sink) {
  LibrarySet libraries;
  std::string error = libraries.load(project);
  if (!error.empty()) return usageError(sink, error);
  List list(project.report);
  std::string library;
  std::vector<std::string> names;
  auto flush = [&] {
    if (library.empty()) return;
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    std::string out = library + ":\n", line = " ";
    for (const std::string& name : names) {
      if (line.size() + name.size() > 100) {
        out += line + "\n";
        line = " ";
      }
      line += " " + name;
    }
    list.add(out + line + "\n", JsonRow().text("library", library).texts("names", names));
    names.clear();
  };
  eachBlock(libraries, [&](const sema::LibraryFile& file, const sema::IndexedBlock& block) {
    if (library != file.library) flush();
    library = file.library;
    if ((block.standards & sema::bitOf(project.dialect)) == 0) return;
    for (std::string_view name : block.names) names.emplace_back(name);
  });
  flush();
  return printResult(sink, list.text());
}

// The header of a declaration: everything up to the body, with the doc comment above it.
std::string headerOf(std::string_view text, const sema::IndexedBlock& block) {
  size_t begin = block.begin;
  for (;;) {  // `///` lines above
    size_t line_end = text.rfind('\n', begin == 0 ? 0 : begin - 1);
    if (line_end == std::string_view::npos || line_end == 0) break;
    size_t line_begin = text.rfind('\n', line_end - 1);
    line_begin = line_begin == std::string_view::npos ? 0 : line_begin + 1;
    if (!text.substr(line_begin).starts_with("///")) break;
    begin = line_begin;
  }
  std::string_view declaration = text.substr(block.begin, block.end - block.begin);
  size_t end = declaration.rfind("END_VAR");
  end = end == std::string_view::npos || declaration.starts_with("TYPE") ? declaration.size() : end + 7;
  return std::string(text.substr(begin, block.begin - begin)) + std::string(declaration.substr(0, end)) + "\n";
}

// The names that begin with this one, as a list of at most ten.
std::string namesBeginning(std::string_view begin, std::vector<std::string_view> names) {
  constexpr size_t kMost = 10;
  std::erase_if(names, [&](std::string_view name) {
    return name.size() <= begin.size() || !sameIdentifier(name.substr(0, begin.size()), begin);
  });
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  std::string list;
  for (size_t i = 0; i < names.size() && i < kMost; ++i) list += (i > 0 ? ", `" : "`") + std::string(names[i]) + "`";
  if (names.size() > kMost) list += " and " + std::to_string(names.size() - kMost) + " more";
  return list;
}

int listSignature(const ProjectOptions& project, const std::string& signature, Sink& sink) {
  LibrarySet libraries;
  std::string error = libraries.load(project);
  if (!error.empty()) return usageError(sink, error);
  List list(project.report);
  std::vector<std::string_view> known;
  auto add = [&](std::string_view where, std::string_view text, const sema::IndexedBlock& block) {
    for (std::string_view name : block.names) {
      known.push_back(name);
      if (!sameIdentifier(name, signature)) continue;
      const std::string declaration = headerOf(text, block);
      list.add("// " + std::string(where) + "\n" + declaration,
               JsonRow().text("file", where).text("declaration", declaration));
    }
  };
  PhaseTimes times;
  Compilation compilation(project, times, sink);
  if (!project.inputs.empty()) {
    if (!compilation.read()) return compilation.finish();
    for (const InputFile& file : compilation.inputs.files) {
      std::string_view text = compilation.sources.sourceText(file.file);
      for (const sema::IndexedBlock& block : sema::indexLibrary(text)) add(file.shown, text, block);
    }
  }
  eachBlock(libraries, [&](const sema::LibraryFile& file, const sema::IndexedBlock& block) {
    if ((block.standards & sema::bitOf(project.dialect)) != 0) add(file.path, file.source, block);
  });
  if (!list.empty()) return printResult(sink, list.text());
  const std::string unknown = "unknown function, block or type `" + signature + "`";
  const std::string offered = namesBeginning(signature, known);
  if (!offered.empty()) return usageError(sink, unknown + "; these begin so: " + offered);
  const std::string_view near = nearest(signature, known);
  return usageError(sink, unknown + (near.empty() ? "" : "; did you mean `" + std::string(near) + "`?"));
}

}  // namespace

int runList(const ProjectOptions& project, const ListOptions& options, Sink& sink) {
  if (!options.signature.empty()) return listSignature(project, options.signature, sink);
  if (options.what == "pous") return listPous(project, sink);
  if (options.what == "tasks") return listTasks(project, sink);
  if (options.what == "libraries" && project.inputs.empty()) return listLibraries(project, sink);
  if (options.what == "nct" && project.inputs.empty()) return listNct(project, sink);
  if (options.what == "warnings" && project.inputs.empty()) return listWarnings(project, sink);
  return usageError(sink, "unknown argument `" + options.what +
                              "` of `rung list`; it takes `libraries`, `nct`, `pous FILE|DIR ...`, `tasks FILE|DIR "
                              "...`, `warnings` or `--signature NAME`");
}

}  // namespace rung::driver
