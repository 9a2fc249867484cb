// SPDX-License-Identifier: Apache-2.0
// `rung emit`: writes the generated C++ to a folder, or the IR or the tree to stdout.
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <unordered_map>
#include <unordered_set>

#include "codegen/write.h"
#include "ir/text.h"
#include "tools/driver/cache.h"
#include "tools/driver/commands.h"
#include "tools/driver/compile.h"
#include "tools/driver/output_files.h"

namespace rung::driver {
namespace {

using codegen::OutputFile;

// Adds a fixed number of files whose names a build system knows before rung runs: each includes a share of the .cpp
// files, chosen by name, and a hash of all that they include, so its time stamp changes when one of them changes.
void addBundles(uint32_t count, const std::string& name, std::vector<OutputFile>& files) {
  std::unordered_map<std::string_view, const OutputFile*> by_name;
  for (const OutputFile& file : files) by_name.emplace(file.path, &file);

  std::vector<Hash> hashes(count);
  std::vector<std::string> includes(count);
  for (const OutputFile& file : files) {
    if (!file.path.ends_with(".cpp")) continue;
    Hash of_name;
    of_name.add(file.path);
    const size_t bundle = std::stoul(of_name.hex().substr(0, 8), nullptr, 16) % count;
    includes[bundle] += "#include \"" + file.path + "\"\n";

    std::vector<const OutputFile*> stack = {&file};
    std::unordered_set<const OutputFile*> seen = {&file};
    while (!stack.empty()) {
      const OutputFile* at = stack.back();
      stack.pop_back();
      hashes[bundle].add(at->content);
      std::string_view text = at->content;
      for (size_t from = 0; (from = text.find("#include \"", from)) != std::string_view::npos;) {
        from += 10;
        const std::string beside(at->path.substr(0, at->path.rfind('/') + 1));
        const std::string included = beside + std::string(text.substr(from, text.find('"', from) - from));
        auto found = by_name.find(included);
        if (found != by_name.end() && seen.insert(found->second).second) stack.push_back(found->second);
      }
    }
  }
  for (uint32_t i = 0; i < count; i++)
    files.push_back({name + "_bundle_" + std::to_string(i) + ".cpp", "// " + hashes[i].hex() + "\n" + includes[i]});
  std::sort(files.begin(), files.end(), [](const OutputFile& a, const OutputFile& b) { return a.path < b.path; });
}

std::string writeDepfile(const Compilation& compilation, const EmitOptions& options) {
  std::string target = options.depfile_target;
  if (target.empty()) target = options.output + "/rung.manifest";
  std::vector<std::string> read = compilation.inputs.read;
  read.insert(read.end(), compilation.libraries.read().begin(), compilation.libraries.read().end());
  std::sort(read.begin(), read.end());
  return writeFile(options.depfile, codegen::depfile(target, read));
}

int emitCpp(Compilation& compilation, const EmitOptions& options, PhaseTimes& times, Sink& sink) {
  std::vector<OutputFile> files;
  const bool ok = compilation.emit(files);
  int exit = compilation.finish();
  if (!ok || exit != kSuccess) return exit;

  if (options.bundles > 0) addBundles(options.bundles, compilation.options.moduleName(), files);
  if (options.list_outputs) {
    std::string list;
    for (const OutputFile& file : files) list += file.path + "\n";
    return printResult(sink, list);
  }
  times.begin("write");
  std::error_code folder_error;
  std::filesystem::create_directories(options.output, folder_error);
  if (folder_error)
    return usageError(sink, "cannot create the folder `" + options.output + "`: " + folder_error.message());
  codegen::WriteResult written = codegen::writeOutputs(options.output, files);
  times.end();
  if (!written.error.empty()) return usageError(sink, written.error);
  if (!options.depfile.empty()) {
    std::string error = writeDepfile(compilation, options);
    if (!error.empty()) return usageError(sink, error);
  }
  return kSuccess;
}

int emitText(Compilation& compilation, EmitKind kind, Sink& sink) {
  std::string out;
  if (kind == EmitKind::Tree) {  // also of a file with errors, whose nodes are `error`
    if (compilation.parse())
      for (const FileUnit& unit : compilation.tree.files)
        out += printTree(compilation.tree, compilation.names, compilation.sources, unit);
    const int printed = out.empty() ? kSuccess : printResult(sink, out);
    const int exit = compilation.finish();
    return exit == kSuccess ? printed : exit;
  }
  if (compilation.lower()) out = ir::print(*compilation.module);
  int exit = compilation.finish();
  return exit == kSuccess ? printResult(sink, out) : exit;
}

}  // namespace

int runEmit(const ProjectOptions& project, const EmitOptions& options, Sink& sink) {
  PhaseTimes times;
  ProjectOptions emitting = project;
  emitting.code.is_bundled = options.bundles > 0;
  Compilation compilation(emitting, times, sink);
  const int exit = options.kind == EmitKind::Cpp ? emitCpp(compilation, options, times, sink)
                                                 : emitText(compilation, options.kind, sink);
  if (project.time_phases) sink.message(times.table());
  return exit;
}

}  // namespace rung::driver
