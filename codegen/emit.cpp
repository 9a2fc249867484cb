// SPDX-License-Identifier: Apache-2.0
// Assembles the parts of codegen: facts, groups, bodies, headers, description. See emit.h.
#include "codegen/emit.h"

#include <algorithm>
#include <map>

#include "codegen/body.h"
#include "codegen/classes.h"
#include "codegen/cpp_bodies.h"
#include "codegen/cxx/print.h"
#include "codegen/facts.h"
#include "codegen/group.h"
#include "codegen/module.h"
#include "codegen/names.h"
#include "codegen/native_header.h"
#include "codegen/records.h"
#include "codegen/signature.h"
#include "codegen/types.h"
#include "frontend/source/invariant.h"
#include "frontend/source/names.h"

namespace rung::codegen {

namespace {

// Prototypes, sorted, one per line.
std::string prototypes(cxx::Tree& tree, const ir::Module& module, const std::vector<ir::BodyId>& bodies, bool native) {
  std::vector<std::string> lines;
  for (ir::BodyId id : bodies) {
    const ir::Body& body = module.body(id);
    if (body.native != native) continue;
    cxx::Function* const prototype = signatureOf(tree, module, body);
    if (native) prototype->prefix = "extern \"C\"";
    cxx::print(lines.emplace_back(), tree, *prototype);
  }
  std::sort(lines.begin(), lines.end());
  std::string out;
  for (const std::string& line : lines) {
    out += line;
    out += '\n';
  }
  return out;
}

std::string inlineFile(const ir::Module& module, ir::BodyId id) {
  return fileStem(module.names.string(module.body(id).name)) + "fn.h";
}

// For each record once, beside its code.
void addLayoutAsserts(cxx::Tree& tree, const ir::Module& module, const Group& group, cxx::Declarations& to) {
  TypeId last;
  for (ir::BodyId id : group.bodies) {
    const TypeId self = module.body(id).self;
    if (!self || module.types.resolve(self) == last) continue;
    if (!last) to.add(tree.blank());
    last = module.types.resolve(self);
    to.add(layoutAssertion(tree, module.types, last));
  }
}

// Sorted, one per line.
std::string dispatchDeclarations(cxx::Tree& tree, const ir::Module& module, const Group& group) {
  std::vector<std::string> lines;
  for (TypeId record : group.classes)
    lines.push_back("extern const uint32_t " + className(module.types, record) + ";\n");
  for (ir::BodyId method : group.virtuals) {
    cxx::Declarations dispatch;
    declareDispatch(tree, module, method, dispatch);
    cxx::print(lines.emplace_back(), tree, dispatch);
  }
  std::sort(lines.begin(), lines.end());
  std::string out;
  for (const std::string& line : lines) out += line;
  return out;
}

// A file of C++ in work. What bodies need in front of them is known when they are written. The tree serves one file
// after the other.
struct FileInWork {
  explicit FileInWork(cxx::Tree& of) : tree(of) { tree.clear(); }
  cxx::Tree& tree;
  cxx::Declarations lines;

  void directive(std::string_view text) { lines.add(tree.textual(cxx::DeclKind::Directive, text)); }
  void include(std::string_view path) { lines.add(tree.textual(cxx::DeclKind::Include, path)); }
  void paragraph(std::string_view text, cxx::Declarations& to) {
    if (text.empty()) return;
    to.add(tree.blank());
    to.add(tree.textual(cxx::DeclKind::Printed, text));
  }
};

// Adds what a group's code needs in front, and the code, in the namespace of the module.
std::string withCode(const ir::Module& module, const Group& group, RecordDefinitions& records,
                     std::string_view name_space, FileInWork& file) {
  cxx::Tree& tree = file.tree;
  std::vector<std::string> files;
  cxx::Namespace* const space = hiddenNamespace(tree, name_space);
  records.collect(group.records, files, tree, space->members);
  for (ir::BodyId id : group.inlined) files.push_back(inlineFile(module, id));
  std::sort(files.begin(), files.end());
  for (NameId library : group.libraries) file.include("rung/" + foldedIdentifier(module.names.string(library)) + ".h");
  for (const std::string& path : files) file.include(path);
  file.paragraph(prototypes(tree, module, group.callees, true), file.lines);
  file.lines.add(tree.blank());
  file.lines.add(space);
  addLayoutAsserts(tree, module, group, space->members);
  file.paragraph((group.sites.empty() ? "" : "extern const uint32_t sites_" + group.stem + ";\n") +
                     prototypes(tree, module, group.callees, false) + dispatchDeclarations(tree, module, group) +
                     group.data,
                 space->members);
  space->members.add(tree.printed(group.code));
  std::string out;
  out.reserve(group.code.size() + group.code.size() / 2);  // most of the file
  cxx::print(out, tree, file.lines);
  return out;
}

std::string sourceOf(cxx::Tree& tree, const ir::Module& module, const Group& group, RecordDefinitions& records,
                     std::string_view name_space) {
  const auto nameOf = [&](ir::BodyId id) { return std::string(module.names.string(module.body(id).name)); };
  FileInWork file(tree);
  file.lines.add(file.tree.textual(cxx::DeclKind::Comment, "Bodies from " + nameOf(group.bodies.front()) + " to " +
                                                               nameOf(group.bodies.back()) + "."));
  file.directive("define RUNG_GENERATED");
  file.include("rung/code.h");
  return withCode(module, group, records, name_space, file);
}

// The file of a body in C++.
std::string sourceOf(cxx::Tree& tree, const ir::Module& module, const CppFile& cpp, RecordDefinitions& records,
                     std::string_view name_space) {
  const std::string_view name = module.names.string(module.body(cpp.group.bodies[0]).spelling);
  FileInWork file(tree);
  file.lines.add(file.tree.textual(cxx::DeclKind::Comment, "The body of " + std::string(name) + ", which is in C++."));
  file.directive("define RUNG_GENERATED");
  file.include("rung/cpp.h");
  file.lines.add(file.tree.printed(cpp.front));
  file.directive("line 1 \"" + cpp.group.stem + ".cpp\"");
  return withCode(module, cpp.group, records, name_space, file);
}

std::string headerOf(cxx::Tree& tree, const ir::Module& module, const Group& group, RecordDefinitions& records,
                     std::string_view name_space) {
  FileInWork file(tree);
  file.directive("pragma once");
  file.lines.add(file.tree.blank());
  file.include("rung/code.h");
  return withCode(module, group, records, name_space, file);
}

// One header for each library with native bodies that are not Rung's.
void appendNativeHeaders(const ir::Module& module, const EmitOptions& options, std::vector<OutputFile>& files) {
  std::map<std::string, std::vector<ir::BodyId>> bodies;  // by library
  for (uint32_t i = 1; i < module.bodies.size(); ++i) {
    const ir::Body& body = module.bodies[i];
    if (body.native && !options.is_native_of_rung(ir::nativeName(module, body)))
      bodies[std::string(module.names.string(body.library_name))].push_back({i});
  }
  for (auto& [library, ids] : bodies) {
    std::sort(ids.begin(), ids.end(), [&](ir::BodyId a, ir::BodyId b) {
      return module.names.string(module.body(a).name) < module.names.string(module.body(b).name);
    });
    files.push_back({nativeFolder(library) + "native_blocks.h",
                     nativeHeader(nativeDeclarations(module, ids, ir::nativePrefix(library)))});
  }
}

// The code of the module: its bodies in groups, those in C++, and a header for each small body that others inline.
class Code {
 public:
  Code(const ir::Module& module, const EmitOptions& options, const Facts& facts)
      : groups(makeGroups(module, facts)),
        module_(module),
        options_(options),
        facts_(facts),
        is_listed_(module.bodies.size()) {
    marks_.body.resize(module.bodies.size());
    marks_.hot.resize(module.bodies.size());
    marks_.record.resize(module.types.count());
    marks_.data.resize(module.data.size());
    marks_.data_number.resize(module.data.size());
  }

  void write() {
    for (uint32_t i = 0; i < groups.size(); ++i) writeGroup(groups[i], i + 1);
    for (const ir::CppBody& cpp : module_.cpp_bodies)
      list(cpp_files.emplace_back(writeCppBody(module_, options_, facts_, cpp)).group.inlined);
    for (size_t i = 0; i < inlined.size(); ++i) {  // it grows while they are written
      Group& header = headers.emplace_back();
      const auto number = static_cast<uint32_t>(groups.size() + i) + 1;
      BodyWriter(module_, options_, facts_, header, marks_, number).write(inlined[i]);
      list(header.inlined);
    }
    setPhaseSubject("", 0);
  }

  std::vector<Group> groups;
  std::vector<CppFile> cpp_files;
  std::vector<ir::BodyId> inlined;
  std::vector<Group> headers;  // of `inlined`

 private:
  void writeGroup(Group& group, uint32_t number) {
    markHot(module_, group, marks_, number);
    BodyWriter writer(module_, options_, facts_, group, marks_, number);
    for (ir::BodyId id : group.bodies) {
      const std::string_view name = module_.names.string(module_.body(id).name);
      setPhaseSubject(name.data(), name.size());
      writer.write(id);
    }
    list(group.inlined);
  }

  void list(const std::vector<ir::BodyId>& bodies) {
    for (ir::BodyId id : bodies) {
      if (is_listed_[id.index] != 0) continue;
      is_listed_[id.index] = 1;
      inlined.push_back(id);
    }
  }

  const ir::Module& module_;
  const EmitOptions& options_;
  const Facts& facts_;
  Marks marks_;
  std::vector<uint8_t> is_listed_;
};

}  // namespace

std::vector<OutputFile> emitCpp(const ir::Module& module, const EmitOptions& options) {
  setPhase("codegen");
  const std::string name_space = mangle(options.module_name);
  const Facts facts(module, options.optimize_all && !options.counts_steps);
  Code code(module, options, facts);
  code.write();

  RecordDefinitions records(module, facts, name_space, options.bundled);
  for (const Group& group : code.groups) records.need(group.records, false);
  for (const Group& header : code.headers) records.need(header.records, true);
  for (const CppFile& file : code.cpp_files) records.need(file.group.records, false);
  cxx::Tree tree;
  std::vector<OutputFile> files;
  files.reserve(code.groups.size() + code.headers.size() + 3);
  for (const Group& group : code.groups)
    files.push_back({group.stem + ".cpp", sourceOf(tree, module, group, records, name_space)});
  for (const CppFile& file : code.cpp_files)
    files.push_back({file.group.stem + ".cpp", sourceOf(tree, module, file, records, name_space), true});
  for (size_t i = 0; i < code.headers.size(); ++i)
    files.push_back(
        {inlineFile(module, code.inlined[i]), headerOf(tree, module, code.headers[i], records, name_space)});
  records.appendHeaders(files);
  Description description = describe(module, options, facts, code.groups, name_space);
  files.push_back({"module.cpp", std::move(description.module)});
  if (!module.classes.empty() || !module.dispatches.empty())
    files.push_back({"classes.cpp", classesSource(module, name_space)});
  files.push_back({"sites.cpp", std::move(description.sites)});
  files.push_back({kSymbolFile, std::move(description.symbols)});
  if (options.is_native_of_rung != nullptr) appendNativeHeaders(module, options, files);
  std::sort(files.begin(), files.end(), [](const OutputFile& a, const OutputFile& b) { return a.path < b.path; });
  return files;
}

std::string nativeFolder(std::string_view library) {
  return library.empty() ? "native/" : "native/" + std::string(library) + "/";
}

}  // namespace rung::codegen
