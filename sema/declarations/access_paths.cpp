// SPDX-License-Identifier: Apache-2.0
// VAR_ACCESS: names under which the host finds single variables. In: the sections of configurations and programs, once
// all instances are known. Out: Project::access_paths, each with the location that it names. Without a direction an
// access path is READ_ONLY. IEC 61131-3 ed. 3 table 62, 10 and table 47, 9.
#include "sema/declarations/access_paths.h"

#include "sema/declarations/configuration.h"

#include <algorithm>

#include "sema/declarations/addresses.h"
#include "sema/declarations/collect.h"
#include "sema/declarations/constants.h"
#include "sema/declarations/diagnostics.h"
#include "sema/declarations/mentions.h"
#include "sema/declarations/names.h"
#include "sema/declarations/types.h"
#include "sema/project.h"
#include "sema/scopes.h"
#include "sema/shorthands.h"

namespace rung::sema {

using types::TypeInfo;
using types::TypeKind;

namespace {

struct Step {
  Ident name;
  ExprId element;  // an IndexExpr; none: no element
};

struct AccessPathResolver {
  Context context;
  Project& project;
  NameMap names;  // declared so far, by the whole symbol

  const Tree& tree() const { return context.tree(); }
  std::string_view string(NameId name) const { return context.names().string(name); }

  // `Cpu.p.list[3].value` from left to right.
  void flatten(ExprId path, std::vector<Step>& to) const {
    ExprId element;
    if (tree().kind(path) == ExprKind::Index) {
      element = path;
      path = tree().as<IndexExpr>(path).base;
    }
    if (tree().kind(path) == ExprKind::Member) {
      const MemberExpr& node = tree().as<MemberExpr>(path);
      flatten(node.base, to);
      to.push_back({{node.member, node.h.loc}, element});
    } else if (tree().kind(path) == ExprKind::Name) {
      const NameExpr& node = tree().as<NameExpr>(path);
      to.push_back({{node.name, node.h.loc}, element});
    }
  }

  // Forbids a path that does not name a variable.
  //   passes  level : Cpu.p.level : INT;       fails   level : Cpu.p.lvl : INT;       E0890
  bool lost(const Ident& at) {
    context.report(diag::AccessPath, at.loc, {string(at.name)});
    return false;
  }

  // The bytes before a member, inherited ones included.
  uint64_t offsetOf(TypeId record, const Var& member) {
    uint64_t offset = 0;
    const NamedType* named = context.scopes.named(context.types().resolve(record));
    PouId object = named == nullptr ? PouId{} : named->pou;
    while (member.pou && object && !(object == member.pou)) {
      const Pou& pou = project.pou(object);
      offset += context.types().info(pou.record).fields[project.var(pou.object.base_var).field].offset;
      object = pou.base;
      record = project.pou(object).record;
    }
    return offset + context.types().info(context.types().resolve(record)).fields[member.field].offset;
  }

  bool enter(AccessPath& out, TypeId record, VarId id, const Step& step, TypeId& type) {
    const Var& var = project.var(id);
    type = var.type;
    if (type == types::kError) return false;
    const bool elsewhere =
        var.section == SectionKind::InOut || context.types().kind(type) == TypeKind::Reference || var.external;
    if (elsewhere || var.storage == Storage::Local) return lost(step.name);
    if (var.storage == Storage::Image) {
      out.located = true;
      out.image = var.image;
    } else if (var.storage == Storage::Field) {
      out.offset += offsetOf(record, var);
    }
    if (var.bits.is_bit) out.bit = var.bits.bit;
    if (var.constant) out.read_only = true;
    noteName(context, entity(id), step.name.loc);
    ++project.var(id).used.reads;
    if (!out.read_only) ++project.var(id).used.writes;
    return !step.element || enterElement(out, step, type);
  }

  bool enterElement(AccessPath& out, const Step& step, TypeId& type) {
    const Slice<ExprId> indices = tree().as<IndexExpr>(step.element).indices;
    const TypeInfo& info = context.types().info(context.types().resolve(type));
    if (info.kind != TypeKind::Array || info.dimensions.size() != indices.count) return lost(step.name);
    uint64_t element = 0;
    for (uint32_t i = 0; i < indices.count; ++i) {
      const auto value = boundAsWritten(context, tree().list(indices)[i]);
      if (!value) return false;
      const types::Dimension& dimension = info.dimensions[i];
      if (*value < dimension.low || *value > dimension.high) return lost(step.name);
      element = element * dimension.count() + static_cast<uint64_t>(*value - dimension.low);
    }
    type = info.base;
    const uint64_t bytes = element * context.types().info(context.types().resolve(type)).size;
    if (out.located)
      out.image.byte += static_cast<uint32_t>(bytes);
    else
      out.offset += bytes;
    return true;
  }

  // [configuration .] [resource .] instance at the front of a path; 0: the path names no instance.
  size_t followInstance(std::span<const Step> steps, AccessPath& out) {
    for (uint32_t i = 0; i < project.instances.size(); ++i) {
      const ProgramInstance& instance = project.instances[i];
      size_t next = 0;
      const auto matches = [&](NameId name) {
        return next < steps.size() && name && context.names().same(name, steps[next].name.name);
      };
      if (matches(instance.configuration)) ++next;
      if (matches(instance.resource)) ++next;
      if (!matches(instance.name) || steps[next].element) continue;
      out.root = AccessPath::Root::Instance;
      out.index = i;
      if (!project.pou(instance.program).record) continue;
      noteName(context, Entity::of(EntityKind::Program, i), steps[next].name.loc);
      return next + 1;
    }
    return 0;
  }

  // [configuration .] [resource .] or the name of a list, in front of a global variable.
  size_t followQualifiers(std::span<const Step> steps) const {
    size_t next = 0;
    const auto matches = [&](NameId name, size_t step) {
      return step < steps.size() && name && context.names().same(name, steps[step].name.name);
    };
    for (const ProgramInstance& instance : project.instances)
      if (next == 0 && matches(instance.configuration, next)) ++next;
    for (const ProgramInstance& instance : project.instances)
      if (next < 2 && next + 1 < steps.size() && matches(instance.resource, next)) ++next;
    for (const GlobalList& globals : project.global_lists) {  // a resource may have globals and no program
      size_t matched = steps.size() > 1 && matches(globals.configuration, 0) ? 1 : 0;
      if (matched + 1 < steps.size() && matches(globals.resource, matched)) ++matched;
      next = std::max(next, matched);
    }
    const Entity list = context.scopes.qualifiers.find(keyOf(context, steps[0].name.name));
    return next == 0 && list.entityKind() == EntityKind::GlobalList && steps.size() > 1 ? 1 : next;
  }

  // A global variable, after its resource or configuration. 0: reported.
  size_t followGlobal(std::span<const Step> steps, AccessPath& out, TypeId& type) {
    const size_t at = followQualifiers(steps);
    if (at >= steps.size()) {
      lost(steps.back().name);
      return 0;
    }
    const NameId key = keyOf(context, steps[at].name.name);
    Entity found;
    if (at > 0) {
      const Entity list = context.scopes.qualifiers.find(keyOf(context, steps[at - 1].name.name));
      if (list.entityKind() == EntityKind::GlobalList) {
        found = context.scopes.lists[list.index].names.find(key);
        noteName(context, list, steps[at - 1].name.loc);
      }
    }
    if (!found) found = context.scopes.globals.find(key);
    if (found.entityKind() != EntityKind::Var) {
      lost(steps[at].name);
      return 0;
    }
    const Var& var = project.vars[found.index];
    out.root = AccessPath::Root::List;
    out.index = var.list.index;
    if (var.storage == Storage::Global)
      out.offset = context.types().info(project.global_lists[var.list.index].record).fields[var.field].offset;
    return enter(out, {}, VarId{found.index}, steps[at], type) ? at + 1 : 0;
  }

  // Resolves the steps, from the program `of` or from the whole project.
  bool follow(std::span<const Step> steps, AccessPath& out, TypeId& type) {
    size_t next = out.root == AccessPath::Root::Project ? followInstance(steps, out) : 0;
    TypeId record;
    if (out.root != AccessPath::Root::Project) {
      const PouId program =
          out.root == AccessPath::Root::Instance ? project.instances[out.index].program : PouId{out.index};
      record = project.pou(program).record;
    }
    if (!record) {
      next = followGlobal(steps, out, type);
      if (next == 0) return false;
      record = type;
    }
    for (; next < steps.size(); ++next) {
      const VarId member = findMember(context, record, steps[next].name.name);
      if (!member) return lost(steps[next].name);
      if (!enter(out, record, member, steps[next], type)) return false;
      record = type;
    }
    return static_cast<bool>(type) || lost(steps.back().name);
  }

  // Forbids a type that differs from the variable's, and two access paths of one name.
  void declare(DeclId id, AccessPath out) {
    const VarDecl& decl = tree().as<VarDecl>(id);
    if (decl.names.empty() || !decl.type || tree().kind(decl.type) == TypeExprKind::Error) return;
    const Ident name = tree().list(decl.names)[0];
    const TypeId declared = resolveType(context, decl.type);
    if (declared == types::kError) return;
    out.name = name.name;
    out.loc = name.loc;
    out.read_only = decl.read_only;
    TypeId type = declared;
    Ident last = name;
    if (decl.located) {
      const auto view = resolveAddress(context, decl.address, decl.address_loc, declared);
      if (!view) return;
      out.located = true;
      out.image = *view;
    } else {
      std::vector<Step> steps;
      if (decl.init) flatten(decl.init, steps);
      if (steps.empty()) return;  // reported by the parser
      last = steps.back().name;
      type = {};
      if (!follow(steps, out, type)) return;
    }
    out.type = type;
    if (context.types().resolve(type) != context.types().resolve(declared)) {
      context.report(diag::ExternalType, tree().loc(decl.type),
                     {string(last.name), context.types().toString(declared), context.types().toString(type)});
      return;
    }
    std::string symbol = toString(context, out.name);
    if (out.prefix) symbol = toString(context, out.prefix) + "." + symbol;
    const auto index = static_cast<uint32_t>(project.access_paths.size());
    const NameId key = keyOf(context, context.names().intern(symbol));
    if (!names.insert(key, Entity::of(EntityKind::Error, index))) {
      reportTwice(context, out.name, out.loc, project.access_paths[names.find(key).index].loc);
      return;
    }
    project.access_paths.push_back(out);
  }

  void section(DeclId id, FileId file, NameId configuration) {
    if (tree().kind(id) != DeclKind::Section) return;
    const SectionDecl& section = tree().as<SectionDecl>(id);
    if (section.section != SectionKind::Access) return;
    context.file = file;
    AccessPath out;
    out.configuration = configuration;
    for (uint32_t i = 0; i < section.vars.count; ++i) declare(tree().list(section.vars)[i], out);
  }

  void configurations() {
    for (uint32_t u = 0; u < tree().files.size(); ++u) {
      const FileUnit unit = tree().files[u];
      for (const DeclId id : tree().list(unit.decls)) {
        section(id, unit.file, {});
        if (tree().kind(id) != DeclKind::Configuration) continue;
        const ConfigurationDecl configuration = tree().as<ConfigurationDecl>(id);
        for (const DeclId member : tree().list(configuration.members)) {
          section(member, unit.file, configuration.name);
          if (tree().kind(member) != DeclKind::Resource) continue;
          const Slice<DeclId> inner = tree().as<ResourceDecl>(member).members;
          for (uint32_t r = 0; r < inner.count; ++r) section(tree().list(inner)[r], unit.file, configuration.name);
        }
      }
    }
  }

  void programs() {
    for (uint32_t p = 1; p < project.pous.size(); ++p) {
      const Pou& pou = project.pous[p];
      if (pou.kind != PouKind::Program || pou.library || pou.pragmas.test || !pou.decl) continue;
      const PouDecl& decl = tree().as<PouDecl>(pou.decl);
      for (uint32_t s = 0; s < decl.sections.count; ++s) {
        const SectionDecl& section = tree().as<SectionDecl>(tree().list(decl.sections)[s]);
        if (section.section != SectionKind::Access) continue;
        context.file = pou.file;
        for (uint32_t i = 0; i < project.instances.size(); ++i) {
          if (!(project.instances[i].program == PouId{p})) continue;
          AccessPath out;
          out.root = AccessPath::Root::Instance;
          out.index = i;
          out.prefix = project.instances[i].name;
          out.configuration = project.instances[i].configuration;
          const uint32_t errors = project.diagnostics.errorCount();
          for (uint32_t v = 0; v < section.vars.count; ++v) declare(tree().list(section.vars)[v], out);
          if (project.diagnostics.errorCount() != errors) break;  // each instance would repeat the error
        }
      }
    }
  }
};

}  // namespace

void resolveAccessPaths(Context& context) {
  Context there = at(context, {}, {}, false);
  AccessPathResolver resolver{.context = there, .project = context.project, .names = {}};
  resolver.configurations();
  resolver.programs();
}

}  // namespace rung::sema
