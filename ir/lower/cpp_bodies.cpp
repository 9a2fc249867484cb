// SPDX-License-Identifier: Apache-2.0
// Bodies in C++: their source and the names that it may use. In: a checked POU. Out: a row of Module::cpp_bodies.
// Called by lowerBodies(); the body itself has no code, and codegen/cpp_bodies.cpp writes a file for it.
#include <algorithm>

#include "ir/lower/lowering.h"
#include "sema/declarations/constants.h"

namespace rung::ir {

namespace {

// The text after the opening `{…}` of a part in C++, up to its {END_C++}.
std::string_view sourceOf(const sema::Project& project, FileId file, Loc begin, Loc end, Loc& loc) {
  constexpr uint32_t kClose = 9;  // {END_C++}
  const uint32_t base = project.sources.begin(file).offset;
  const std::string_view text = project.sources.sourceText(file);
  const size_t from = text.find('}', begin.offset - base) + 1, to = end.offset - kClose - base;
  loc = {base + static_cast<uint32_t>(from)};
  return text.substr(from, to - from);
}

}  // namespace

// A variable that is neither a field nor a local. `list`: what it is named with; `of_object`: of the block of a method.
void ModuleLowering::addCppVariable(CppBody& cpp, sema::VarId id, NameId list, bool of_object) {
  const sema::Var& own = project.var(id);
  if (!own.name) return;
  const sema::Var& var = own.external ? project.var(own.external) : own;
  const bool is_constant = own.constant || var.constant;
  const TypeId type = types.resolve(var.type);
  const auto hides = [&](const auto& known) { return !known.list && project.names.same(known.name, own.name); };
  if (of_object && (std::any_of(cpp.variables.begin(), cpp.variables.end(), hides) ||
                    std::any_of(cpp.constants.begin(), cpp.constants.end(), hides)))
    return;
  const auto bitsOf = [&](const types::Value& value) {
    return TypeTable::isString(types.plainKind(type)) ? value.bits : types::convert(types, value, type).value.bits;
  };
  switch (var.storage) {
    case sema::Storage::Global:
      records.declare(type);
      cpp.variables.push_back(
          {list, own.name, type, false, instances.listIndex(var.list), var.field, kNoBit, is_constant, of_object});
      break;
    case sema::Storage::Image: {
      records.declare(type);
      const uint32_t bit = var.image.is_bit ? var.image.bit : kNoBit;
      cpp.variables.push_back(
          {list, own.name, type, true, var.image.area.index, var.image.byte, bit, is_constant, of_object});
      break;
    }
    case sema::Storage::Constant:
      if (var.has_value) cpp.constants.push_back({list, own.name, type, bitsOf(var.value), of_object});
      break;
    case sema::Storage::Local:
      if (of_object || !var.init) break;
      if (const auto value = sema::constantOf(project, var.init))
        cpp.initial.push_back({{}, own.name, type, bitsOf(*value), false});
      break;
    case sema::Storage::Field: break;
  }
}

void ModuleLowering::lowerCpp(sema::PouId id) {
  const sema::Pou& pou = project.pou(id);
  const PouDecl& decl = project.tree.as<PouDecl>(pou.decl);
  CppBody cpp;
  cpp.body = bodyOf(id);
  cpp.source = sourceOf(project, pou.file, decl.body_begin, decl.body_end, cpp.loc);
  if (decl.cpp_file_begin != decl.cpp_file_end)
    cpp.file_source = sourceOf(project, pou.file, decl.cpp_file_begin, decl.cpp_file_end, cpp.file_loc);
  for (const sema::VarId var : pou.vars) addCppVariable(cpp, var, {}, false);
  for (sema::PouId object = pou.owner ? pou.owner : pou.base; object; object = project.pou(object).base)
    for (const sema::VarId var : project.pou(object).vars) addCppVariable(cpp, var, {}, true);
  for (const sema::VarId var : pou.cpp.globals)
    addCppVariable(cpp, var, project.global_lists[project.var(var).list.index].name, false);
  for (sema::PouId function : pou.cpp.calls) cpp.functions.push_back(bodyOf(function));
  module.cpp_bodies.push_back(std::move(cpp));
  module.body(bodyOf(id)).cpp = static_cast<uint32_t>(module.cpp_bodies.size());
}

}  // namespace rung::ir
