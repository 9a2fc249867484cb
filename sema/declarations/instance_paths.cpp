// SPDX-License-Identifier: Apache-2.0
// Open addresses and VAR_CONFIG: see instance_paths.h. A variable AT %I* of a list, or of a program with one instance,
// is a view of the image like any located variable. One of a block has a field in each instance, which the program's
// activation copies from and to the image (ir/lower). {attribute 'instance-path'} is an initial value of the same kind.
#include "sema/declarations/instance_paths.h"

#include <algorithm>

#include "sema/declarations/addresses.h"
#include "sema/declarations/diagnostics.h"
#include "sema/declarations/initial_values.h"
#include "sema/declarations/mentions.h"
#include "sema/declarations/names.h"
#include "sema/declarations/types.h"
#include "sema/project.h"
#include "sema/scopes.h"
#include "sema/shorthands.h"
#include "sema/synthesized_nodes.h"

namespace rung::sema {

using types::TypeInfo;
using types::TypeKind;

namespace {

struct InstancePathResolver {
  Context& context;
  Project& project;
  std::vector<InstancePath> targets;           // of fields, in order of instances and declarations
  std::vector<uint8_t> has_open_;              // by TypeId of a record: 0 unknown, 1 no, 2 yes
  std::vector<std::pair<VarId, bool>> whole_;  // open addresses that are views themselves; completed?

  const Tree& tree() const { return context.tree(); }
  std::string_view string(NameId name) const { return context.names().string(name); }

  bool inField(const Var& var) const { return var.storage == Storage::Field; }

  bool holdsPath(const Var& var) const {
    return var.pragmas.instance_path && inField(var) && context.types().kind(var.type) == TypeKind::String;
  }

  // `plc.Main.fb[2]` of a variable in that block, in the format of CODESYS and TwinCAT.
  ExprId pathLiteral(const InstancePath& target) {
    std::string out(project.options.name);
    if (target.program)
      out.append(".").append(string(target.instance == InstancePath::kNone ? project.pou(target.program).name
                                                                           : project.instances[target.instance].name));
    TypeId type;
    for (size_t i = 0; i + 1 < target.path.size(); ++i) {
      const PathStep& step = target.path[i];
      if (step.var) {
        type = project.var(step.var).type;
        const Var& var = project.var(step.var);
        const bool inherited = var.pou && project.pou(var.pou).object.base_var == step.var;
        if (!inherited) out.append(".").append(string(var.name));
        continue;
      }
      const TypeInfo& array = context.types().info(context.types().resolve(type));
      int64_t rest = step.element;
      std::string indices;
      for (size_t d = array.dimensions.size(); d-- > 0;) {
        const types::Dimension& dimension = array.dimensions[d];
        const auto count = static_cast<int64_t>(dimension.count());
        indices = std::to_string(dimension.low + rest % count) + (indices.empty() ? "" : ",") + indices;
        rest /= count;
      }
      out += "[" + indices + "]";
      type = array.base;
    }
    const Var& var = project.var(target.var);
    const uint32_t capacity = context.types().info(context.types().resolve(var.type)).length;
    if (out.size() > capacity) out.resize(capacity);
    return makeStringLiteral(context, out, var.loc);
  }

  // True when instances of the record hold a field with an open address.
  bool hasOpen(TypeId type) {
    type = context.types().resolve(type);
    const TypeInfo& info = context.types().info(type);
    if (info.kind == TypeKind::Array) return hasOpen(info.base);
    if (info.kind != TypeKind::Record) return false;
    if (has_open_.size() <= type.index) has_open_.resize(context.types().count());
    if (has_open_[type.index] != 0) return has_open_[type.index] == 2;
    has_open_[type.index] = 1;
    const NamedType* named = context.scopes.named(type);
    if (named == nullptr) return false;
    bool found = false;
    for (const VarId id : named->fields) {
      const Var& var = project.var(id);
      if (var.section == SectionKind::InOut) continue;
      found = found || var.open_address || holdsPath(var) || hasOpen(var.type);
    }
    has_open_[type.index] = found ? 2 : 1;
    return found;
  }

  void walkValue(InstancePath& at, TypeId type) {
    if (!hasOpen(type)) return;
    type = context.types().resolve(type);
    const TypeInfo& info = context.types().info(type);
    if (info.kind == TypeKind::Array) {
      uint64_t count = 1;
      for (const types::Dimension& dimension : info.dimensions) count *= dimension.count();
      const TypeId element = info.base;
      for (uint64_t i = 0; i < count; ++i) {
        at.path.push_back({{}, static_cast<int64_t>(i)});
        walkValue(at, element);
        at.path.pop_back();
      }
      return;
    }
    for (const VarId id : context.scopes.named(type)->fields) {
      if (project.var(id).section == SectionKind::InOut) continue;
      at.path.push_back({id, -1});
      if (project.var(id).open_address) {
        at.var = id;
        targets.push_back(at);
      } else if (holdsPath(project.var(id))) {
        at.var = id;
        targets.push_back(at);
        targets.back().init = pathLiteral(at);
      } else {
        walkValue(at, project.var(id).type);
      }
      at.path.pop_back();
    }
  }

  void collect() {
    for (uint32_t i = 1; i < project.vars.size(); ++i) {
      const Var& var = project.vars[i];
      if (var.open_address && !inField(var) && !var.external && var.type != types::kError)
        whole_.push_back({{i}, false});
    }
    for (uint32_t i = 0; i < project.instances.size(); ++i) {
      InstancePath at;
      at.instance = i;
      at.program = project.instances[i].program;
      if (at.program) walkValue(at, project.pou(at.program).record);
    }
    for (uint32_t i = 1; i < project.pous.size(); ++i) {
      if (!project.pous[i].pragmas.test || project.pous[i].kind != PouKind::Program) continue;
      InstancePath at;
      at.program = {i};
      walkValue(at, project.pous[i].record);
    }
    for (uint32_t i = 1; i < project.global_lists.size(); ++i) {
      InstancePath at;
      walkValue(at, project.global_lists[i].record);
    }
  }

  // In the format of VAR_CONFIG.
  std::string pathString(const InstancePath& target) const {
    std::string out;
    if (target.instance != InstancePath::kNone) {
      const ProgramInstance& instance = project.instances[target.instance];
      if (instance.resource) out.append(string(instance.resource)).append(".");
      out += string(instance.name);
    } else if (target.program) {
      out += string(project.pou(target.program).name);
    }
    for (const PathStep& step : target.path) {
      if (!step.var) {
        out += "[" + std::to_string(step.element) + "]";
        continue;
      }
      if (!out.empty()) out += '.';
      out += string(project.var(step.var).name);
    }
    return out;
  }

  // ---- VAR_CONFIG

  // [configuration .] [resource .] instance at the front of a path; 0: the path names no instance.
  size_t followInstance(std::span<const Ident> names, InstancePath& out) {
    for (uint32_t i = 0; i < project.instances.size(); ++i) {
      const ProgramInstance& instance = project.instances[i];
      size_t next = 0;
      const auto matches = [&](NameId name) {
        return next < names.size() && name && context.names().same(name, names[next].name);
      };
      if (matches(instance.configuration)) ++next;
      if (matches(instance.resource)) ++next;
      if (!matches(instance.name)) continue;
      out.instance = i;
      out.program = instance.program;
      if (!out.program) continue;
      noteName(context, Entity::of(EntityKind::Program, i), names[next].loc);
      return next + 1;
    }
    return 0;
  }

  // The name of a program, or [list .] variable. 0: reported.
  size_t followGlobal(std::span<const Ident> names, InstancePath& out) {
    const NameId key = keyOf(context, names[0].name);
    const Entity named = context.scopes.pous_and_types.find(key);
    if (named.entityKind() == EntityKind::Pou && project.pous[named.index].kind == PouKind::Program) {
      out.program = PouId{named.index};
      noteName(context, named, names[0].loc);
      return 1;
    }
    const Entity list = context.scopes.qualifiers.find(key);
    const bool has_list = list.entityKind() == EntityKind::GlobalList && names.size() > 1;
    const Ident& name = names[has_list ? 1 : 0];
    const Entity found = has_list ? context.scopes.lists[list.index].names.find(keyOf(context, name.name))
                                  : context.scopes.globals.find(key);
    if (found.entityKind() != EntityKind::Var) {
      reportPath(name);
      return 0;
    }
    out.var = VarId{found.index};
    out.path.push_back({out.var, -1});
    if (has_list) noteName(context, list, names[0].loc);
    noteName(context, found, name.loc);
    return has_list ? 2 : 1;
  }

  bool reportPath(const Ident& name) {
    context.report(diag::ConfigPath, name.loc, {string(name.name)});
    return false;
  }

  // Resolves a path of VAR_CONFIG: a variable, and the path to it when it lives in an instance.
  //   passes  VAR_CONFIG Main.drive.ready AT %IX1.0 : BOOL; END_VAR
  //   fails   VAR_CONFIG Main.drivee.ready AT %IX1.0 : BOOL; END_VAR       E0825
  bool follow(std::span<const Ident> names, InstancePath& out) {
    size_t next = followInstance(names, out);
    if (next == 0) next = followGlobal(names, out);
    if (next == 0) return false;
    TypeId type = out.var ? project.var(out.var).type : project.pou(out.program).record;
    for (; next < names.size(); ++next) {
      const VarId member = findMember(context, type, names[next].name);
      if (!member) return type != types::kError && reportPath(names[next]);
      noteName(context, entity(member), names[next].loc);
      out.var = member;
      out.path.push_back({member, -1});
      type = project.var(member).type;
    }
    return out.var || reportPath(names[names.size() - 1]);
  }

  // Forbids two lines of VAR_CONFIG for one variable.   fails  Main.start AT %IX0 : BOOL; Main.start AT %IX1 : BOOL;
  // E0830
  void reportConfiguredTwice(const Ident& variable, Loc first) {
    Report report = context.report(diag::DuplicateConfigPath, variable.loc, {string(variable.name)});
    if (first) report.alsoDeclaredHere(first);
  }

  static bool samePath(const InstancePath& a, const InstancePath& b) {
    if (a.instance != b.instance || a.program != b.program || a.path.size() != b.path.size()) return false;
    for (size_t i = 0; i < a.path.size(); ++i) {
      if (!(a.path[i].var == b.path[i].var) || a.path[i].element != b.path[i].element) return false;
    }
    return true;
  }

  // A line of VAR_CONFIG.
  struct Line {
    const VarDecl& decl;
    Ident name;  // the last of its path
    TypeId type;
    InstancePath target;
    std::optional<ImageView> view;
    ExprId init;
  };

  // Forbids a line that does not fit the variable: another type, an address where none was left open, another area.
  bool fits(const Line& line, const Var& var) {
    if (line.type == types::kError || var.type == types::kError) return false;
    if (context.types().resolve(line.type) != context.types().resolve(var.type)) {
      context
          .report(diag::ExternalType, tree().loc(line.decl.type),
                  {string(line.name.name), context.types().toString(line.type), context.types().toString(var.type)})
          .declaredHere(var.loc);
      return false;
    }
    if (var.constant) {
      context.report(diag::ConfigConstant, line.name.loc, {string(line.name.name)}).declaredHere(var.loc);
      return false;
    }
    if (!line.decl.located || var.open_address) return true;
    context.report(diag::ConfigNotOpen, line.decl.address_loc, {string(line.name.name)}).declaredHere(var.loc);
    return false;
  }

  // Resolves the address of a line that has one.
  bool locate(Line& line, const Var& var) {
    const VarDecl& decl = line.decl;
    if (!decl.located) return true;
    const std::optional<types::AreaId> named = areaOf(context, decl.address, decl.address_loc);
    if (!named) return false;
    if (*named != var.image.area) {
      const std::string area(1, letterOf(var.image.area));
      context.report(diag::ConfigArea, decl.address_loc, {string(line.name.name), area}).declaredHere(var.loc);
      return false;
    }
    if (decl.address.incomplete) {
      context.report(diag::ConfigIncomplete, decl.address_loc, {string(line.name.name)});
      return false;
    }
    line.view = resolveAddress(context, decl.address, decl.address_loc, line.type);
    return line.view.has_value();
  }

  void checkInit(Line& line) {
    line.init = codeOf(context, line.decl.init);
    if (!line.init) return;
    checkInitializerAs(context, line.init, line.type,
                       "the initial value of `" + toString(context, line.name.name) + "`");
    for (const PathStep& step : line.target.path) {  // a configured variable has a value though no body writes it
      if (step.var) ++context.symbols.var(step.var).used.writes;
    }
  }

  void addTarget(Line& line) {
    line.target.configured = true;
    line.target.loc = line.name.loc;
    line.target.init = line.init;
    targets.push_back(line.target);
  }

  void configureField(Line& line) {
    const auto known = std::find_if(targets.begin(), targets.end(),
                                    [&](const InstancePath& target) { return samePath(target, line.target); });
    if (known == targets.end()) return addTarget(line);
    if (known->configured) return reportConfiguredTwice(line.name, known->loc);
    known->configured = true;
    known->loc = line.name.loc;
    known->init = line.init;
    if (!line.view) return;
    known->image = *line.view;
    known->located = true;
  }

  // An open address that is a view itself.
  void configureView(Line& line, Var& var) {
    for (auto& [open, complete] : whole_) {
      if (!(open == line.target.var)) continue;
      if (complete) return reportConfiguredTwice(line.name, {});
      complete = line.view.has_value();
      if (line.view) var.image = *line.view;
    }
    if (line.init) addTarget(line);
  }

  void configure(DeclId id) {
    const VarDecl& decl = tree().as<VarDecl>(id);
    if (decl.names.empty() || !decl.type) return;
    const std::span<const Ident> names = tree().list(decl.names);
    Line line{.decl = decl, .name = names[names.size() - 1], .type = {}, .target = {}, .view = {}, .init = {}};
    if (!follow(names, line.target)) return;
    line.type = resolveType(context, decl.type);
    Var& var = project.var(line.target.var);
    if (!fits(line, var) || !locate(line, var)) return;
    checkInit(line);
    if (inField(var) || !var.open_address)
      configureField(line);
    else
      configureView(line, var);
  }

  void configureAll() {
    const auto sectionOf = [&](DeclId id, FileId file) {
      if (tree().kind(id) != DeclKind::Section) return;
      const SectionDecl& section = tree().as<SectionDecl>(id);
      if (section.section != SectionKind::Config) return;
      context.file = file;
      for (uint32_t i = 0; i < section.vars.count; ++i) configure(tree().list(section.vars)[i]);
    };
    for (uint32_t u = 0; u < tree().files.size(); ++u) {
      const FileUnit unit = tree().files[u];
      for (const DeclId id : tree().list(unit.decls)) {
        sectionOf(id, unit.file);
        if (tree().kind(id) != DeclKind::Configuration) continue;
        const Slice<DeclId> members = tree().as<ConfigurationDecl>(id).members;
        for (const DeclId member : tree().list(members)) {
          sectionOf(member, unit.file);
          if (tree().kind(member) != DeclKind::Resource) continue;
          const Slice<DeclId> inner = tree().as<ResourceDecl>(member).members;
          for (uint32_t r = 0; r < inner.count; ++r) sectionOf(tree().list(inner)[r], unit.file);
        }
      }
    }
  }

  // ---- addresses that VAR_CONFIG does not complete

  // The next free bits of each area.
  std::vector<uint64_t> free_bit_;

  char letterOf(types::AreaId area) const { return project.options.areas[area.index].letter; }

  // Manual 4.1.1: the system chooses; D: after the last fixed address, in order of declaration, aligned to the size.
  // The standard has no such choice: it is an error there, which names what to add.
  //   fails   iec: PROGRAM Main VAR x AT %I* : BOOL; END_VAR …              E0342
  bool complete(const Var& var, ImageView& view, const std::string& path) {
    const types::AreaId area = var.image.area;
    const bool is_bool = context.types().kind(var.type) == TypeKind::Bool;
    const TypeInfo& info = context.types().info(context.types().resolve(var.type));
    if (!context.profile().completed_addresses) {
      std::string address = "%";
      address += letterOf(area);
      address += is_bool ? "X0.0" : info.size == 2 ? "W0" : info.size == 4 ? "D0" : info.size == 8 ? "L0" : "B0";
      context.report(diag::AddressIncomplete, var.loc, {path, address, context.types().toString(var.type)});
      return false;
    }
    uint64_t& bit = free_bit_[area.index];
    view.area = area;
    if (is_bool) {
      view.byte = static_cast<uint32_t>(bit / 8);
      view.bit = static_cast<uint8_t>(bit % 8);
      view.is_bit = true;
      ++bit;
    } else {
      const uint64_t align = std::max<uint64_t>(info.align, 1);
      const uint64_t byte = ((bit + 7) / 8 + align - 1) / align * align;
      view.byte = static_cast<uint32_t>(byte);
      bit = (byte + info.size) * 8;
    }
    if ((bit + 7) / 8 > areaLimit(context, area)) {
      context.report(diag::AddressTooLarge, var.loc, {path, std::to_string(areaLimit(context, area))});
      return false;
    }
    uint32_t& bytes = project.area_bytes[area.index];
    bytes = std::max(bytes, static_cast<uint32_t>((bit + 7) / 8));
    return true;
  }

  void completeAll() {
    for (const uint32_t bytes : project.area_bytes) free_bit_.push_back(uint64_t{bytes} * 8);
    for (const auto& [id, done] : whole_) {
      if (done) continue;
      Var& var = project.var(id);
      std::string path;
      if (var.pou) path.append(string(project.pou(var.pou).name)).append(".");
      path += string(var.name);
      ImageView view;
      if (complete(var, view, path)) var.image = view;
    }
    for (InstancePath& target : targets) {
      const Var& var = project.var(target.var);
      if (target.located || !var.open_address || !inField(var) || var.type == types::kError) continue;
      target.located = complete(var, target.image, pathString(target));
    }
  }
};

}  // namespace

void resolveInstancePaths(Context& context) {
  Context there = at(context, {}, {}, false);
  InstancePathResolver resolver{
      .context = there, .project = context.project, .targets = {}, .has_open_ = {}, .whole_ = {}, .free_bit_ = {}};
  resolver.collect();
  resolver.configureAll();
  resolver.completeAll();
  allocateHierarchical(there);
  context.project.instance_paths = std::move(resolver.targets);
}

}  // namespace rung::sema
