// Bodies in C++: their source and the names that it may use. In: a checked POU. Out: a row of Module::cpp_bodies.
// Called by lowerBodies(); the body itself has no code, and codegen/cpp_bodies.cpp writes a file for it.
#include "ir/lower/lowering.h"

namespace rung::ir {

void ModuleLowering::lowerCpp(sema::PouId id) {
  const sema::Pou& pou = project.pou(id);
  const PouDecl& decl = project.tree.as<PouDecl>(pou.decl);
  CppBody cpp;
  cpp.body = bodyOf(id);
  const uint32_t base = project.sources.begin(pou.file).offset;
  constexpr uint32_t kOpen = 5, kClose = 9;  // {C++}, {END_C++}
  cpp.loc = {decl.body_begin.offset + kOpen};
  cpp.source = project.sources.sourceText(pou.file).substr(cpp.loc.offset - base,
                                                           decl.body_end.offset - kClose - cpp.loc.offset);
  for (sema::VarId var_id : pou.vars) {
    const sema::Var& own = project.var(var_id);
    if (!own.name) continue;
    const sema::Var& var = own.external ? project.var(own.external) : own;
    const TypeId type = types.resolve(var.type);
    if (var.storage == sema::Storage::Global) {
      declareRecordsOf(type);
      cpp.globals.push_back({own.name, listIndex(var.list), var.field, own.constant || var.constant});
    } else if (var.storage == sema::Storage::Constant && var.has_value) {
      cpp.constants.push_back({own.name, type, types::convert(types, var.value, type).value.bits});
    } else if (var.storage == sema::Storage::Local && var.init) {
      const auto value = constantOf(project, var.init);
      if (!value) continue;
      const bool is_string = TypeTable::isString(types.plainKind(type));
      cpp.initial.push_back({own.name, type, is_string ? value->bits : types::convert(types, *value, type).value.bits});
    }
  }
  for (sema::PouId function : pou.cpp_calls) cpp.functions.push_back(bodyOf(function));
  module.cpp_bodies.push_back(std::move(cpp));
  module.body(bodyOf(id)).cpp = static_cast<uint32_t>(module.cpp_bodies.size());
}

}  // namespace rung::ir
