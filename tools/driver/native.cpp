// SPDX-License-Identifier: Apache-2.0
// From generated C++ to a library or program; see native.h.
#include "tools/driver/native.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string_view>
#include <unordered_map>
#include <unordered_set>

#include "frontend/source/diagnostics.h"
#include "frontend/source/files.h"
#include "tools/driver/compile.h"
#include "tools/driver/diagnostics.h"
#include "tools/driver/file_provider.h"
#include "tools/driver/installation.h"
#include "tools/driver/module_library.h"
#include "tools/driver/output_files.h"
#include "tools/driver/process.h"

namespace rung::driver {
namespace {

using codegen::OutputFile;

// Below this many units to compile, making the precompiled header costs more than it saves.
constexpr size_t kPrecompileFrom = 6;

std::vector<std::string> splitFlags(const char* text) {
  std::vector<std::string> out;
  std::string word;
  for (const char* c = text == nullptr ? "" : text;; c++) {
    if (*c != '\0' && *c != ' ' && *c != '\t' && *c != '\n') {
      word += *c;
      continue;
    }
    if (!word.empty()) out.push_back(std::move(word));
    word.clear();
    if (*c == '\0') return out;
  }
}

std::string baseName(const std::string& path) { return path.substr(path.rfind('/') + 1); }

// Hashes which executable a command starts, with size and time: a new compiler makes new objects.
void addIdentity(Hash& hash, const std::vector<std::string>& command) {
  for (const std::string& word : command) {
    hash.add(word);
    std::string path = word;
    if (word.find('/') == std::string::npos) {
      const char* folders = std::getenv("PATH");
      for (std::string_view rest = folders == nullptr ? "" : folders; !rest.empty();) {
        size_t colon = rest.find(':');
        std::string candidate = std::string(rest.substr(0, colon)) + "/" + word;
        if (access(candidate.c_str(), X_OK) == 0) {
          path = candidate;
          break;
        }
        rest = colon == std::string_view::npos ? "" : rest.substr(colon + 1);
      }
    }
    struct stat info;
    if (stat(path.c_str(), &info) != 0) continue;
    hash.add(static_cast<uint64_t>(info.st_size));
    hash.add(static_cast<uint64_t>(info.st_mtim.tv_sec));
    hash.add(static_cast<uint64_t>(info.st_mtim.tv_nsec));
  }
}

void addFile(Hash& hash, const std::string& path) {
  ReadResult read = readFile(path);
  hash.add(read.content);
}

// Hashes the contents of all headers below a folder, in a fixed order.
void addHeaders(Hash& hash, const std::string& folder) {
  for (const std::string& name : namesIn(folder)) {
    hash.add(name);
    struct stat info;
    std::string path = folder + "/" + name;
    if (stat(path.c_str(), &info) == 0 && S_ISDIR(info.st_mode))
      addHeaders(hash, path);
    else
      addFile(hash, path);
  }
}

struct CompileUnit {
  std::string source;  // path below the work folder
  std::string key, object;
  const OutputFile* user_file = nullptr;  // contains a body in C++ that the user wrote
};

class Builder {
 public:
  Builder(Cache& cache, const NativeRequest& request, Sink& sink)
      : cache_(cache),
        request_(request),
        sink_(sink),
        compiler_(compilerCommand()),
        user_flags_(splitFlags(std::getenv("CXXFLAGS"))) {}

  NativeResult& result() { return result_; }

  // Makes every object; false: result() has the error.
  bool compile() {
    if (!installation().error.empty()) return fail(kUsage, installation().error);
    if (cache_.folder().empty()) return fail(kUsage, "cannot create a temporary folder for the C++ compiler");
    flags_ = {"-std=c++17", "-O" + std::to_string(request_.level), "-fPIC", "-fvisibility=hidden", "-ffp-contract=off"};
    if (request_.debug) flags_.push_back("-g");
    if (request_.has_call_paths) flags_.push_back("-DRUNG_CALL_PATHS");
    if (RUNG_SANITIZED) flags_.push_back("-fsanitize=address,undefined");
    flags_.insert(flags_.end(), user_flags_.begin(), user_flags_.end());

    Hash tool;
    tool.add("rung objects 2");
    addIdentity(tool, compiler_);
    for (const std::string& flag : flags_) tool.add(flag);
    addHeaders(tool, installation().include + "/rung");
    tool_key_ = tool.hex();

    findUnits();
    std::vector<CompileUnit*> missing;
    for (CompileUnit& unit : units_)
      if (!cache_.has(unit.object)) missing.push_back(&unit);
    if (request_.keep && !writeFiles()) return false;
    if (missing.empty()) return true;
    if (work_.empty() && !writeFiles()) return false;
    return compileUnits(missing);
  }

  // Links the objects to `out` in the work folder, with `before` and `after` around them.
  bool link(const std::vector<std::string>& before, const std::vector<std::string>& after, const std::string& out) {
    std::vector<Process> processes(1);
    Process& process = processes[0];
    process.arguments = compiler_;
    process.arguments.insert(process.arguments.end(), before.begin(), before.end());
    if (RUNG_SANITIZED) process.arguments.push_back("-fsanitize=address,undefined");
    process.arguments.insert(process.arguments.end(), user_flags_.begin(), user_flags_.end());
    process.arguments.push_back("-o");
    process.arguments.push_back(out);
    for (const CompileUnit& unit : units_) process.arguments.push_back(unit.object);
    process.arguments.insert(process.arguments.end(), after.begin(), after.end());
    for (std::string& flag : splitFlags(std::getenv("LDFLAGS"))) process.arguments.push_back(std::move(flag));
    process.log = work_ + "/link.log";
    return run(processes, "linking");
  }

  bool archive(const std::string& out) {
    std::vector<std::string> archiver = splitFlags(std::getenv("AR"));
    if (archiver.empty()) archiver = {"ar"};
    std::vector<Process> processes(1);
    Process& process = processes[0];
    process.arguments = archiver;
    process.arguments.push_back("rcsD");
    process.arguments.push_back(out);
    // ar keeps base names only: the units' own names instead of the cache's, so `ar t` shows readable names.
    for (const CompileUnit& unit : units_) {
      std::string name = work_ + "/" + baseName(unit.source) + ".o";
      if (::link(unit.object.c_str(), name.c_str()) != 0 && symlink(unit.object.c_str(), name.c_str()) != 0)
        return fail(kUsage, "cannot write to `" + work_ + "`: " + strerror(errno));
      process.arguments.push_back(name);
    }
    process.log = work_ + "/link.log";
    return run(processes, "archiving");
  }

  // A shared library for a product: exports one name, so the others cannot clash with those of another module.
  bool linkModule(const std::string& module_name, const std::string& output) {
    return needWork() && writePlain("exports.map", "{ global: " + module_name + "_module; local: *; };\n") &&
           link({"-shared", "-Wl,--version-script=" + work_ + "/exports.map"}, {installation().runtime_library},
                output);
  }

  // Adds the host's main() for an executable, and what its monitor shows.
  bool addMain(const std::string& module_name) {
    const std::string main = "#include \"rung/host.h\"\nextern \"C\" const rung_module* " + module_name +
                             "_module(void);\nconst rung_pou_view* rung_pou_views();\n"
                             "int main(int argc, char** argv) { return rung::host::applicationMain(*" +
                             module_name + "_module(), argc, argv, rung_pou_views()); }\n";
    return needWork() && addUnit("rung_main.cpp", main) && addUnit("rung_views.cpp", request_.views);
  }

  // Compiles a source of the tool itself, unless the cache has it.
  bool addUnit(const std::string& name, const std::string& text) {
    Hash hash;
    hash.add(tool_key_);
    hash.add(text);
    CompileUnit unit{name, hash.hex(), {}};
    unit.object = cache_.path(unit.key, "o");
    std::vector<CompileUnit*> missing;
    if (!cache_.has(unit.object)) missing.push_back(&unit);
    if (std::string error = writeFile(work_ + "/" + name, text); !error.empty()) return fail(kUsage, error);
    if (!missing.empty() && !compileUnits(missing)) return false;
    units_.push_back(unit);
    return true;
  }

  std::string linkKey() const {
    Hash hash;
    hash.add(tool_key_);
    for (const CompileUnit& unit : units_) hash.add(unit.key);
    for (const std::string& flag : splitFlags(std::getenv("LDFLAGS"))) hash.add(flag);
    addFile(hash, installation().runtime_library);
    return hash.hex();
  }

  bool needWork() {
    if (work_.empty()) work_ = cache_.workFolder();
    return !work_.empty() || fail(kUsage, "cannot write to the cache folder `" + cache_.folder() + "`");
  }
  const std::string& work() const { return work_; }

  void finish() {
    if (work_.empty()) return;
    if (request_.keep && result_.exit == kSuccess) sink_.message("rung: generated C++ kept in " + work_ + "\n");
    if (!request_.keep && result_.exit != kInternal) cache_.drop(work_);
  }

  bool fail(int exit, std::string message) {
    result_.exit = exit;
    result_.message = std::move(message);
    return false;
  }

 private:
  // The hash of a file with everything that it includes from its own part.
  const std::string& closure(const NativePart& part,
                             const std::unordered_map<std::string_view, const OutputFile*>& files,
                             const OutputFile& file) {
    std::string id = part.folder + "/" + file.path;
    auto [entry, fresh] = closures_.try_emplace(std::move(id));
    if (!fresh) return entry->second;
    Hash hash;
    hash.add(contentHash(part, file));
    std::vector<const OutputFile*> stack = {&file};
    std::unordered_set<const OutputFile*> seen = {&file};
    while (!stack.empty()) {
      const OutputFile* at = stack.back();
      stack.pop_back();
      for (const std::string& name : includes(part, *at)) {
        auto found = files.find(at->path.substr(0, at->path.rfind('/') + 1) + name);  // beside the file
        if (found == files.end() || !seen.insert(found->second).second) continue;
        stack.push_back(found->second);
        hash.add(contentHash(part, *found->second));
      }
    }
    return entry->second = hash.hex();
  }

  const std::string& contentHash(const NativePart& part, const OutputFile& file) {
    auto [entry, fresh] = contents_.try_emplace(part.folder + "/" + file.path);
    if (fresh) {
      Hash hash;
      hash.add(file.path);
      hash.add(file.content);
      entry->second = hash.hex();
    }
    return entry->second;
  }

  // Names in `#include "…"` lines; generated files have them at the top, in one block.
  const std::vector<std::string>& includes(const NativePart& part, const OutputFile& file) {
    auto [entry, fresh] = includes_.try_emplace(part.folder + "/" + file.path);
    if (!fresh) return entry->second;
    std::string_view text = file.content;
    for (size_t at = 0; (at = text.find("#include \"", at)) != std::string_view::npos;) {
      at += 10;
      size_t end = text.find('"', at);
      if (end == std::string_view::npos) break;
      entry->second.emplace_back(text.substr(at, end - at));
      at = end;
    }
    return entry->second;
  }

  void findUnits() {
    std::vector<std::string> batch_source(request_.batches);
    std::vector<Hash> batch_hash(request_.batches);
    for (const NativePart& part : request_.parts) {
      std::unordered_map<std::string_view, const OutputFile*> files;
      for (const OutputFile& file : part.files) files.emplace(file.path, &file);
      const std::string prefix = part.folder.empty() ? "" : part.folder + "/";
      for (const OutputFile& file : part.files) {
        if (!file.path.ends_with(".cpp")) continue;
        const std::string& hash = closure(part, files, file);
        if (request_.batches == 0 || file.has_user_code) {
          Hash key;
          key.add(tool_key_);
          key.add(hash);
          units_.push_back({prefix + file.path, key.hex(), {}, file.has_user_code ? &file : nullptr});
          continue;
        }
        Hash name;
        name.add(part.folder);
        size_t batch = std::stoul(name.hex().substr(0, 8), nullptr, 16) % request_.batches;
        batch_source[batch] += "#include \"" + prefix + file.path + "\"\n";
        batch_hash[batch].add(prefix);
        batch_hash[batch].add(hash);
      }
    }
    for (uint32_t i = 0; i < request_.batches; i++) {
      if (batch_source[i].empty()) continue;
      Hash key;
      key.add(tool_key_);
      key.add(batch_hash[i].hex());
      units_.push_back({"batch_" + std::to_string(i) + ".cpp", key.hex(), {}});
      batch_files_.push_back({units_.back().source, batch_source[i]});
    }
    for (CompileUnit& unit : units_) unit.object = cache_.path(unit.key, "o");
  }

  bool writeFiles() {
    if (!needWork()) return false;
    for (const NativePart& part : request_.parts) {
      if (!part.folder.empty()) mkdir((work_ + "/" + part.folder).c_str(), 0777);
      for (const OutputFile& file : part.files)
        if (!writePlain((part.folder.empty() ? "" : part.folder + "/") + file.path, file.content)) return false;
    }
    for (const OutputFile& file : batch_files_)
      if (!writePlain(file.path, file.content)) return false;
    return true;
  }

  // No other process uses the work folder: no rename needed.
  bool writePlain(const std::string& path, const std::string& text) {
    for (size_t slash = path.find('/'); slash != std::string::npos; slash = path.find('/', slash + 1))
      mkdir((work_ + "/" + path.substr(0, slash)).c_str(), 0777);
    FILE* file = fopen((work_ + "/" + path).c_str(), "wb");
    if (file == nullptr) return fail(kUsage, "cannot write to `" + work_ + "`: " + strerror(errno));
    bool ok = fwrite(text.data(), 1, text.size(), file) == text.size();
    ok = fclose(file) == 0 && ok;
    return ok || fail(kUsage, "cannot write to `" + work_ + "`: " + strerror(errno));
  }

  bool compileUnits(const std::vector<CompileUnit*>& missing) {
    const std::string header = precompiled(missing.size());
    std::vector<Process> processes;
    for (size_t i = 0; i < missing.size(); i++) {
      Process process;
      process.arguments = compiler_;
      process.arguments.insert(process.arguments.end(), flags_.begin(), flags_.end());
      if (!header.empty()) process.arguments.insert(process.arguments.end(), {"-include", header});
      process.arguments.insert(process.arguments.end(),
                               {"-I", installation().include, "-c", missing[i]->source, "-o", objectPart(i)});
      hideFolders(process.arguments);
      process.folder = work_;
      process.log = work_ + "/" + std::to_string(i) + ".log";
      processes.push_back(std::move(process));
    }
    if (!run(processes, "compiling", &missing)) return false;
    for (size_t i = 0; i < missing.size(); i++)
      if (!cache_.put(objectPart(i), missing[i]->object))
        return fail(kUsage, "cannot write to the cache folder `" + cache_.folder() + "`: " + strerror(errno));
    return true;
  }

  // Debuggers look for the sources in their own folder, and no path of this machine gets into an object.
  void hideFolders(std::vector<std::string>& arguments) const {
    arguments.push_back("-ffile-prefix-map=" + installation().include + "=rung/include");
    arguments.push_back("-ffile-prefix-map=" + cache_.folder() + "=rung/cache");
    arguments.push_back("-ffile-prefix-map=" + work_ + "=.");  // the last match counts, and work_ is in the cache
  }

  std::string objectPart(size_t i) const { return work_ + "/" + std::to_string(i) + ".o"; }

  // The path for -include, or empty when there is none and making one does not pay.
  std::string precompiled(size_t units) {
    Hash hash;
    hash.add(tool_key_);
    hash.add(installation().include);
    hash.add("header in the cache");
    const std::string compiled = cache_.path(hash.hex(), "gch");  // …/KEY.gch beside the header …/KEY
    std::string header = compiled.substr(0, compiled.size() - 4);
    // clang++ remembers the header's path and time: it is compiled in its final folder, and its time never updated.
    const bool has_header = access(header.c_str(), R_OK) == 0;
    if (has_header && cache_.has(compiled)) return header;
    if (units < kPrecompileFrom) return {};

    const std::string part = work_ + "/rung_runtime.h";
    if (!writePlain("rung_runtime.h", "#include \"rung/code.h\"\n")) return {};
    if (!has_header && !cache_.put(part, header)) return {};
    std::vector<Process> processes(1);
    processes[0].arguments = compiler_;
    processes[0].arguments.insert(processes[0].arguments.end(), flags_.begin(), flags_.end());
    processes[0].arguments.insert(processes[0].arguments.end(),
                                  {"-I", installation().include, "-x", "c++-header", header, "-o", part + ".gch"});
    hideFolders(processes[0].arguments);
    processes[0].log = work_ + "/header.log";
    if (runAll(processes, 1, "precompiling", sink_) != nullptr) return {};  // the objects can be made without it
    if (!cache_.put(part + ".gch", compiled)) return {};
    return header;
  }

  // The messages of g++ about a body that the user wrote, with their original lines.
  static std::vector<Refusal> refusalsOf(const OutputFile& file, const std::string& log) {
    std::vector<Refusal> refusals;
    for (size_t at = 0; at < log.size();) {
      const size_t end = std::min(log.find('\n', at), log.size());
      const std::string_view line = std::string_view(log).substr(at, end - at);
      at = end + 1;
      for (const std::string_view word : {": error: ", ": fatal error: "}) {
        const size_t severity_at = line.find(word);
        if (severity_at == std::string_view::npos) continue;
        const std::string location(line.substr(0, severity_at));  // path:line:column
        const size_t column = location.rfind(':');
        const size_t row = column == std::string::npos || column == 0 ? column : location.rfind(':', column - 1);
        if (row == std::string::npos) continue;
        const std::string path = location.substr(0, row);
        if (file.content.find(" \"" + path + "\"\n") == std::string::npos) continue;
        refusals.push_back({path, static_cast<uint32_t>(strtoul(location.c_str() + row + 1, nullptr, 10)),
                            static_cast<uint32_t>(strtoul(location.c_str() + column + 1, nullptr, 10)),
                            std::string(line.substr(severity_at + word.size()))});
      }
    }
    return refusals;
  }

  // `units`: the unit that each process compiles.
  bool run(std::vector<Process>& processes, const char* label, const std::vector<CompileUnit*>* units = nullptr) {
    uint32_t jobs = request_.jobs != 0 ? request_.jobs : processorCount();
    const Process* failed = runAll(processes, jobs, label, sink_);
    if (failed == nullptr) return true;
    if (failed->exit_code == 127)
      return fail(kUsage, "cannot start `" + failed->arguments[0] +
                              "`; install a C++ compiler or name one in the environment variable CXX");
    ReadResult log = readFile(failed->log);
    std::string first;
    size_t at = 0;
    for (int line = 0; line < 20 && at < log.content.size(); line++) {
      size_t end = log.content.find('\n', at);
      if (end == std::string::npos) end = log.content.size();
      first += "  " + log.content.substr(at, end - at) + "\n";
      at = end + 1;
    }
    // Errors of the machine or of the user's flags are not bugs of the generated code.
    for (const char* phrase : {"No space left", "unrecognized command", "unrecognized argument", "unknown argument",
                               "cannot execute", "Cannot allocate memory", "Killed signal", "Disk quota"})
      if (log.content.find(phrase) != std::string::npos || failed->exit_code > 128)
        return fail(kUsage, "`" + failed->arguments[0] + "` failed while " + label + ":\n" + first);
    if (const CompileUnit* unit = units == nullptr ? nullptr : (*units)[static_cast<size_t>(failed - processes.data())];
        unit != nullptr && unit->user_file != nullptr) {
      result_.refusals = refusalsOf(*unit->user_file, log.content);
      first.pop_back();
      return fail(kInputErrors, "error[" + std::string(diagInfo(diag::CppRefused).code) +
                                    "]: the C++ compiler rejects a C++ body:\n" + first);
    }
    if (log.content.find("error") == std::string::npos)
      return fail(kUsage, "`" + failed->arguments[0] + "` failed with exit code " + std::to_string(failed->exit_code) +
                              " while " + label + " and named no error; is it a C++ compiler?\n" + first);
    return fail(kInternal, "`" + failed->arguments[0] + "` rejected generated code while " + label +
                               "; the files are in " + work_ + "\n" + first);
  }

  Cache& cache_;
  const NativeRequest& request_;
  Sink& sink_;
  std::vector<std::string> compiler_, user_flags_, flags_;
  std::string tool_key_, work_;
  std::vector<CompileUnit> units_;
  std::vector<OutputFile> batch_files_;
  std::unordered_map<std::string, std::string> closures_, contents_;
  std::unordered_map<std::string, std::vector<std::string>> includes_;
  NativeResult result_;
};

std::string moveInto(const std::string& from, const std::string& to) {
  if (rename(from.c_str(), to.c_str()) == 0) return {};
  // Another file system: copy to a file beside the target, then rename.
  ReadResult read = readFile(from);
  if (!read.error.empty()) return "cannot read `" + from + "`: " + read.error;
  struct stat info;
  std::string error = writeFile(to, read.content);
  if (error.empty() && stat(from.c_str(), &info) == 0 && chmod(to.c_str(), info.st_mode & 0777) != 0)
    error = "cannot make `" + to + "` executable: " + strerror(errno);
  return error;
}

}  // namespace

std::vector<std::string> compilerCommand() {
  std::vector<std::string> command = splitFlags(std::getenv("CXX"));
  if (command.empty()) command = {"g++"};
  return command;
}

NativeResult makeShared(Cache& cache, const NativeRequest& request, Sink& sink) {
  if (!loadsCode()) {
    NativeResult refused;
    refused.exit = kUsage;
    refused.message =
        "this rung is one file that cannot load compiled programs; run what `rung build` makes, which has the options "
        "of "
        "`rung run`, or use the Debian package";
    return refused;
  }
  Builder builder(cache, request, sink);
  if (builder.compile()) {
    const std::string entry = cache.path(builder.linkKey(), "so");
    if (cache.has(entry)) {
      builder.result().path = entry;
    } else if (builder.needWork()) {
      const std::string part = builder.work() + "/module.so";
      if (builder.link({"-shared", "-Wl,-z,now"}, {installation().runtime_library}, part)) {
        if (cache.put(part, entry))
          builder.result().path = entry;
        else
          builder.fail(kUsage, "cannot write to the cache folder `" + cache.folder() + "`: " + strerror(errno));
      }
    }
  }
  builder.finish();
  return builder.result();
}

NativeResult makeOutput(Cache& cache, const NativeRequest& request, BuildKind kind, const std::string& module_name,
                        const std::string& output, Sink& sink) {
  Builder builder(cache, request, sink);
  bool ok = builder.compile() && builder.needWork();
  const std::string part = ok ? builder.work() + "/output" : "";
  const Installation& rung = installation();
  switch (kind) {
    case BuildKind::Executable:
      ok = ok && builder.addMain(module_name) &&
           builder.link({}, {rung.host_library, rung.runtime_library, "-ldl", "-pthread"}, part);
      break;
    case BuildKind::Shared: ok = ok && builder.linkModule(module_name, part); break;
    case BuildKind::Static: ok = ok && builder.archive(part); break;
  }
  if (ok) {
    std::string error = moveInto(part, output);
    if (!error.empty()) builder.fail(kUsage, error);
  }
  builder.finish();
  return builder.result();
}

}  // namespace rung::driver
