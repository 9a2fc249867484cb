// SPDX-License-Identifier: Apache-2.0
// Writes the table through which the interpreter calls the native bodies of the libraries: a thunk for each, in C++;
// and the header that the native bodies include, with the structs of native blocks. In: the declarations of
// stdlib/*/*.st, read by the compiler's own front end. Out: two files, rewritten only if they change. Generic functions
// appear once for each tuple of types that they admit, so every function that a program may call is there, and linking
// rung fails when a library lacks a body. Run when rung is built.
//   native_table TABLE HEADER FILE...      FILE: <folder>/<library>/<name>.st
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <map>
#include <sstream>
#include <string>

#include "codegen/cxx/print.h"
#include "codegen/native_header.h"
#include "codegen/signature.h"
#include "codegen/types.h"
#include "frontend/source/dialect.h"
#include "frontend/source/render.h"
#include "ir/builder.h"
#include "ir/lower.h"
#include "sema/check.h"
#include "sema/declarations/collect.h"
#include "sema/declarations/generics.h"
#include "sema/declarations/libraries.h"
#include "sema/declarations/resolve.h"
#include "sema/declarations/variables.h"
#include "sema/scopes.h"
#include "sema/shorthands.h"
#include "tools/driver/namespaces.h"

namespace {

namespace cxx = rung::codegen::cxx;
using rung::TypeId;
using rung::sema::Context;
using rung::sema::PouId;
using rung::sema::VarId;
using rung::types::TypeKind;
using rung::types::TypeTable;

struct LibrarySources {
  std::vector<std::string> names, paths, contents;
  std::vector<rung::sema::LibraryFile> files;
};

// Every instance of a generic function.
void instantiateAll(Context& context, PouId generic) {
  rung::sema::resolvePou(context, generic);
  std::vector<TypeId> pins;
  std::vector<TypeKind> generics;
  const auto note = [&](TypeId type) {
    const TypeKind kind = context.types().kind(type);
    if (TypeTable::isGeneric(kind) && std::find(generics.begin(), generics.end(), kind) == generics.end()) {
      generics.push_back(kind);
    }
  };
  for (const VarId id : context.symbols.pou(generic).vars) {
    const rung::sema::Var& var = context.symbols.var(id);
    if (var.section != rung::SectionKind::Input && var.section != rung::SectionKind::InOut &&
        var.section != rung::SectionKind::Output) {
      continue;
    }
    pins.push_back(var.type);
    note(var.type);
  }
  const TypeId result = context.symbols.pou(generic).result;
  if (result) note(result);

  std::vector<TypeId> chosen(generics.size());
  const auto typeOf = [&](TypeId declared) {
    for (size_t i = 0; i < generics.size(); ++i) {
      if (generics[i] == context.types().kind(declared)) return chosen[i];
    }
    return declared;
  };
  const auto choose = [&](const auto& self, size_t at) -> void {
    if (at == generics.size()) {
      std::vector<TypeId> types;
      types.reserve(pins.size());
      for (const TypeId pin : pins) types.push_back(typeOf(pin));
      const PouId created = rung::sema::instantiate(context, generic, types, result ? typeOf(result) : TypeId{});
      context.symbols.pou(created).progress.used = true;
      return;
    }
    for (int kind = static_cast<int>(TypeKind::Bool); kind <= static_cast<int>(TypeKind::UString); ++kind) {
      const auto of = static_cast<TypeKind>(kind);
      if (!TypeTable::belongsToOrMixes(of, generics[at])) continue;
      // A string has its largest capacity inside: one instance serves every length.
      chosen[at] = rung::types::TypeTable::isString(of) ? context.types().string(of, 255) : rung::types::idOf(of);
      self(self, at + 1);
    }
  };
  choose(choose, 0);
}

// Calls `use` with a module that has all native bodies. False: a declaration has errors, which were printed.
bool withNatives(const LibrarySources& libraries, rung::Dialect dialect, uint32_t pointer_size,
                 rung::FunctionRef<void(const rung::ir::Module&)> use) {
  rung::Sources sources;
  rung::Names names;
  rung::Diagnostics diagnostics(sources);
  rung::Tree tree;
  rung::sema::Options options;
  for (const rung::types::MemoryArea& area : rung::types::nctAreas())
    options.areas.push_back(area);  // of the library nct
  options.dialect = dialect;
  options.pointer_size = pointer_size;
  options.libraries = libraries.files;
  rung::sema::Project project(sources, names, diagnostics, tree, options);
  rung::sema::Scopes scopes;
  Context context = rung::sema::contextOf(project, scopes);
  rung::sema::internKnownNames(context);
  rung::sema::indexLibraries(context);
  for (const rung::sema::LibraryFile& file : libraries.files) {
    for (const rung::sema::IndexedBlock& block : rung::sema::indexLibrary(file.source)) {
      for (const std::string_view name : block.names) {
        rung::sema::lookUpLibrary(context, names.key(names.intern(name)));
        rung::sema::resolveDeclarations(context);
      }
    }
  }
  const size_t declared = project.pous.size();
  for (uint32_t i = 1; i < declared; ++i) {
    if (!project.pous[i].pragmas.native) continue;
    if (project.pous[i].generic) {
      instantiateAll(context, {i});
    } else {
      project.pous[i].progress.used = true;
    }
  }
  if (diagnostics.hasErrors()) {
    diagnostics.sort();
    std::fputs(rung::render(diagnostics, sources, {}).c_str(), stderr);
    return false;
  }
  // Only native bodies matter, and they have no code to check.
  for (uint32_t i = 1; i < project.pous.size(); ++i) {
    if (!project.pous[i].pragmas.native) project.pous[i].progress.used = false;
  }
  rung::ir::Module module(project.types, names, sources);
  rung::ir::LowerOptions lower_options;
  lower_options.used_of_libraries = true;
  rung::ir::lower(project, lower_options, module);

  use(module);
  return true;
}

// The function that the interpreter calls for each native body: it takes the arguments from slots of 64 bits.
class Thunks {
 public:
  // Those of a module that are not known yet.
  void add(const rung::ir::Module& module) {
    for (size_t i = 1; i < module.bodies.size(); ++i) {
      const rung::ir::Body& body = module.bodies[i];
      if (!body.native) continue;
      const std::string function = rung::ir::nativeName(module, body);
      if (!by_function_.contains(function)) by_function_[function] = make(module, body, function);
    }
  }

  // Both in the order of the C functions.
  std::string definitions() const {
    cxx::Declarations all;
    for (const auto& [function, thunk] : by_function_) {
      all.add(thunk.native);
      all.add(thunk.caller);
    }
    std::string out;
    cxx::print(out, tree_, all);
    return out;
  }
  std::string rows() const {
    std::string out;
    for (const auto& [function, thunk] : by_function_) out += "    {\"" + function + "\", call_" + function + "},\n";
    return out;
  }

 private:
  struct Thunk {
    cxx::Function* native;
    cxx::Function* caller;
  };

  Thunk make(const rung::ir::Module& module, const rung::ir::Body& body, const std::string& function) {
    const TypeTable& types = module.types;
    slots_ = 0;
    std::vector<cxx::Ex> arguments{tree_.fixed("ctx")};
    if (body.self) arguments.push_back(slot("void*"));
    for (const rung::ir::Local& local : rung::ir::parameters(body))
      arguments.push_back(slot(typeOf(types, local.type, local.by_reference)));
    const bool is_aggregate = body.result && rung::ir::isAggregate(types, body.result);
    const bool is_string = is_aggregate && TypeTable::isString(types.kind(body.result));
    if (is_aggregate) arguments.push_back(slot(typeOf(types, body.result, is_string)));
    if (is_string) arguments.push_back(slot("uint32_t"));  // its capacity
    cxx::Ex call = tree_.call(function, arguments);
    if (body.result && !is_aggregate) call = tree_.call("put", {nextSlot(), call});

    cxx::Function* const native = rung::codegen::signatureOf(tree_, module, body);
    native->prefix = "extern \"C\"";
    cxx::Function* const caller = tree_.declaration<cxx::Function>();
    caller->prefix = "static";
    caller->result.base = "void";
    caller->name = tree_.kept("call_" + function);
    caller->parameters.add(tree_.variable(cxx::Type{"rung_context", "*", {}}, "ctx"));
    caller->parameters.add(tree_.variable(cxx::Type{"[[maybe_unused]] uint64_t", "*", {}}, "slots"));
    caller->form = cxx::Function::Form::OneLine;
    caller->body = tree_.stmt(cxx::StmtKind::Expression, call);
    return {native, caller};
  }

  static std::string typeOf(const TypeTable& types, TypeId type, bool by_reference) {
    const TypeKind kind = types.kind(type);
    if (kind == TypeKind::Array || kind == TypeKind::Record) return "void*";
    return std::string(rung::codegen::scalarType(types, type)) + (by_reference ? "*" : "");
  }
  cxx::Ex nextSlot() { return tree_.infix(cxx::Op::Add, tree_.fixed("slots"), tree_.number(slots_++)); }
  cxx::Ex slot(const std::string& type) { return tree_.call("at<" + type + ">", {nextSlot()}); }

  cxx::Tree tree_;
  std::map<std::string, Thunk> by_function_;
  uint32_t slots_ = 0;  // that the function being made has used
};

// Adds the declarations of each library's native blocks and methods by its name, and the functions that take records.
void addDeclarations(const rung::ir::Module& module, std::map<std::string, std::string>& of_library) {
  std::map<std::string, std::vector<rung::ir::BodyId>> bodies;
  for (uint32_t i = 1; i < module.bodies.size(); ++i) {
    const rung::ir::Body& body = module.bodies[i];
    if (body.native && body.self) bodies[std::string(module.names.string(body.library_name))].push_back({i});
  }
  for (const auto& [library, ids] : bodies) {
    of_library[library] = rung::codegen::nativeDeclarations(module, ids, rung::ir::nativePrefix(library));
  }
}

// One program of all dialects may use a block, so its layout cannot differ between them.
bool header(const LibrarySources& libraries, std::string& out) {
  std::map<std::string, std::string> narrow, wide;
  for (const rung::LanguageProfile& profile : rung::kProfiles) {
    if (!profile.is_chosen) continue;
    for (const uint32_t pointer_size : {4u, 8u}) {
      std::map<std::string, std::string>& known = pointer_size == 4 ? narrow : wide;
      std::map<std::string, std::string> here;
      if (!withNatives(libraries, profile.dialect, pointer_size,
                       [&](const rung::ir::Module& module) { addDeclarations(module, here); }))
        return false;
      for (const auto& [library, declarations] : here) {
        if (known.try_emplace(library, declarations).first->second == declarations) continue;
        std::fprintf(stderr, "native_table: the native blocks of %s differ between the dialects\n", library.c_str());
        return false;
      }
    }
  }
  std::string text;
  for (const auto& [library, declarations] : wide) {
    if (narrow[library] == declarations)
      text += declarations + "\n";
    else
      text += "#if UINTPTR_MAX > UINT32_MAX\n\n" + declarations + "\n#else\n\n" + narrow[library] + "\n#endif\n\n";
  }
  out = rung::codegen::nativeHeader(text);
  return true;
}

// An unchanged file keeps its time, so what includes it is not compiled again.
bool write(const char* path, const std::string& text) {
  std::ostringstream old;
  if (std::ifstream file(path, std::ios::binary); file) old << file.rdbuf();
  if (old.str() == text) return true;
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file) std::perror(path);
  return bool(file);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    std::fputs("usage: native_table TABLE HEADER FILE...\n", stderr);
    return 2;
  }
  LibrarySources libraries;
  const auto count = static_cast<size_t>(argc - 3);
  libraries.names.reserve(count);
  libraries.paths.reserve(count);
  libraries.contents.reserve(count);
  for (int i = 3; i < argc; ++i) {
    const std::string path = argv[i];
    const size_t name = path.rfind('/'), folder = path.rfind('/', name - 1);
    rung::ReadResult read = rung::readFile(path);
    if (!read.error.empty() || name == std::string::npos || folder == std::string::npos) {
      std::fprintf(stderr, "native_table: cannot read `%s`: %s\n", argv[i], read.error.c_str());
      return 2;
    }
    libraries.names.push_back(rung::driver::namespaceOf(path.substr(folder + 1, name - folder - 1)));
    libraries.paths.push_back(path.substr(folder + 1));
    libraries.contents.push_back(std::move(read.content));
    libraries.files.push_back(
        {libraries.names.back().c_str(), libraries.paths.back().c_str(), libraries.contents.back()});
  }
  Thunks thunks;
  for (const rung::LanguageProfile& profile : rung::kProfiles) {
    if (!profile.is_chosen) continue;
    if (!withNatives(libraries, profile.dialect, sizeof(void*),
                     [&](const rung::ir::Module& module) { thunks.add(module); }))
      return 1;
  }

  std::string out =
      "// Made by native_table from the declarations of the libraries.\n#include <string.h>\n\n"
      "#include \"native_table.h\"\n\nnamespace {\n\n"
      "template <class T>\nT at(const uint64_t* slot) {\n  T value;\n  memcpy(&value, slot, sizeof value);\n"
      "  return value;\n}\n"
      "template <class T>\nvoid put(uint64_t* slot, T value) {\n  memcpy(slot, &value, sizeof value);\n}\n\n"
      "}  // namespace\n\n";
  out += thunks.definitions();
  out += "\nnamespace rung::natives {\n\nconst ir::interpreter::Native table[] = {\n" + thunks.rows() +
         "};\nconst size_t count = sizeof table / sizeof table[0];\n\n}  // namespace rung::natives\n";
  std::string blocks;
  if (!header(libraries, blocks)) return 1;
  return write(argv[1], out) && write(argv[2], blocks) ? 0 : 2;
}
