// `rung list`: the libraries, the POUs of a project, or the declaration of one of them.
#include <algorithm>
#include <cstdio>

#include "tools/rung/commands.h"
#include "tools/rung/compile.h"

namespace rung::tool {
namespace {

const char* word(PouKind kind) {
  switch (kind) {
    case PouKind::Function: return "FUNCTION";
    case PouKind::FunctionBlock: return "FUNCTION_BLOCK";
    case PouKind::Program: return "PROGRAM";
  }
  return "";
}

int printResult(const std::string& text) {
  std::string error = printOut(text);
  return error.empty() ? kGood : usageError(error);
}

int listPous(const Options& options) {
  if (options.inputs.size() < 2) return usageError("`rung list pous` needs files or folders to read");
  Options reading = options;
  reading.inputs.erase(reading.inputs.begin());
  PhaseTimes times;
  Compilation compilation(reading, times);
  if (!compilation.parse() || compilation.diagnostics.hasErrors()) return compilation.finish();
  const Tree& tree = compilation.tree;
  std::string out;
  for (const FileUnit& unit : tree.files) {
    for (DeclId id : tree.list(unit.decls)) {
      if (tree.kind(id) != DeclKind::Pou) continue;
      const PouDecl& pou = tree.as<PouDecl>(id);
      std::string name(compilation.names.text(pou.name)), shown(compilation.sources.path(unit.file));
      for (const InputFile& file : compilation.inputs.files)
        if (file.file == unit.file) shown = file.shown;
      out += std::string(word(pou.pou_kind)) + " " + name + "  " + shown + ":" +
             std::to_string(compilation.sources.place(pou.h.loc).line) + "\n";
    }
  }
  int exit = compilation.finish();
  return exit == kGood ? printResult(out) : exit;
}

}  // namespace

int runList(const Options& options) {
  if (!options.inputs.empty() && options.inputs[0] == "pous") return listPous(options);
  return usageError("`rung list` knows no `" + (options.inputs.empty() ? options.signature : options.inputs[0]) + "`");
}

}  // namespace rung::tool
