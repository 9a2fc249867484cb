// SPDX-License-Identifier: Apache-2.0
#include "tools/conformance/needs.h"

#include <algorithm>

#include "tools/conformance/standard_form.h"

namespace rung::conformance {
namespace {

void addPragmaNames(std::string_view pragma, std::set<std::string>& names) {
  Scanner scanner(pragma.substr(1));
  for (Unit unit = scanner.next(); unit.kind != UnitKind::End; unit = scanner.next())
    if (unit.kind == UnitKind::Name) names.insert(upper(scanner.textOf(unit)));
}

bool isGlobal(const Tree& tree, DeclId id) {
  return tree.kind(id) == DeclKind::Section && tree.as<SectionDecl>(id).section == SectionKind::Global;
}

}  // namespace

bool Needs::has(DeclId id) const { return std::find(left_out.begin(), left_out.end(), id) == left_out.end(); }

Declarations::Declarations(const Source& source, const std::vector<Edit>& form)
    : source_(source), tree_(source.tree), networks_(networksOf(source)) {
  for (const DeclId id : source.decls)
    if (isGlobal(tree_, id)) {
      sections.push_back(id);
      noteGlobals(id, sections.size() - 1, form);
    }
  for (const DeclId id : source.decls)
    if (tree_.kind(id) == DeclKind::Configuration) noteMembers(tree_.as<ConfigurationDecl>(id).members, form);
}

void Declarations::noteMembers(Slice<DeclId> members, const std::vector<Edit>& form) {
  for (const DeclId id : tree_.list(members)) {
    if (isGlobal(tree_, id)) noteGlobals(id, kOfConfiguration, form);
    if (tree_.kind(id) == DeclKind::Resource) noteMembers(tree_.as<ResourceDecl>(id).members, form);
  }
}

void Declarations::noteGlobals(DeclId id, size_t section, const std::vector<Edit>& form) {
  const auto& declared = tree_.as<SectionDecl>(id);
  for (const DeclId v : tree_.list(declared.vars)) {
    if (tree_.kind(v) != DeclKind::Var || !tree_.as<VarDecl>(v).type) continue;
    const auto& var = tree_.as<VarDecl>(v);
    const Range type = tree_.range(var.type);
    const std::string written = rendered(source_.text(), source_.at(type.begin), source_.at(type.end), form);
    for (const Ident& one : tree_.list(var.names)) {
      const std::string name = source_.spelling(one.name), key = upper(name);
      const auto is_same = [&](const Global& global) { return global.key == key; };
      if (std::none_of(globals.begin(), globals.end(), is_same))
        globals.push_back({key, name, written, declared.qualifiers.constant, section});
    }
  }
}

bool Declarations::hasPragma(DeclId id, std::string_view name) const {
  for (const Pragma& pragma : tree_.list(tree_.decl(id).pragmas))
    if (upper(source_.names.string(pragma.name)) == name) return true;
  return false;
}
bool Declarations::isTest(DeclId id) const { return tree_.kind(id) == DeclKind::Pou && hasPragma(id, "TEST"); }

void Declarations::addNames(size_t from, size_t to, std::set<std::string>& names) const {
  auto unit = source_.unitAt(from);
  bool after_point = false;
  for (; unit != source_.units.end() && unit->begin < to; ++unit) {
    if (unit->kind == UnitKind::Name && !after_point) names.insert(upper(source_.textOf(*unit)));
    if (unit->kind == UnitKind::Comment) continue;
    if (unit->kind == UnitKind::Pragma && isInside(networks_, unit->begin))
      addPragmaNames(source_.textOf(*unit), names);
    after_point = unit->kind == UnitKind::Other && source_.textOf(*unit) == ".";
  }
}

Needs Declarations::needsOf(DeclId test) const {
  Needs needs;
  std::vector<DeclId> open;
  for (const DeclId id : source_.decls) {
    const DeclKind kind = tree_.kind(id);
    if (kind == DeclKind::Section) continue;
    if (test && id != test && kind == DeclKind::Pou) {
      open.push_back(id);
    } else if (kind == DeclKind::Configuration) {
      addConfigurationNames(id, needs.names);
    } else {
      addNames(source_.begin(id), source_.end(id), needs.names);
    }
  }
  for (bool more = true; more;) {
    more = false;
    for (size_t i = 0; i < open.size();) {
      const auto& pou = tree_.as<PouDecl>(open[i]);
      if (isTest(open[i]) || needs.names.count(upper(source_.spelling(pou.name))) == 0) {
        ++i;
        continue;
      }
      addNames(source_.begin(open[i]), source_.end(open[i]), needs.names);
      open.erase(open.begin() + static_cast<std::ptrdiff_t>(i));
      more = true;
    }
    for (const Global& global : globals)
      if (global.section != kOfConfiguration && needs.names.count(global.key) != 0 &&
          needs.sections.insert(global.section).second) {
        addNames(source_.begin(sections[global.section]), source_.end(sections[global.section]), needs.names);
        more = true;
      }
  }
  if (!test)
    for (size_t i = 0; i < sections.size(); ++i) needs.sections.insert(i);
  else
    keepUnnamed(needs);
  needs.left_out = open;
  return needs;
}
// `AT %QW2 : WORD := 5;` has no name and may matter all the same.
void Declarations::keepUnnamed(Needs& needs) const {
  for (size_t i = 0; i < sections.size(); ++i)
    for (const DeclId v : tree_.list(tree_.as<SectionDecl>(sections[i]).vars))
      if (tree_.kind(v) == DeclKind::Var && tree_.as<VarDecl>(v).names.empty()) needs.sections.insert(i);
}
void Declarations::addConfigurationNames(DeclId id, std::set<std::string>& names) const {
  size_t from = source_.begin(id);
  for (const auto& instance : instancesOf(id)) {
    addNames(from, instance.begin, names);
    from = instance.end;
  }
  addNames(from, source_.end(id), names);
}
std::vector<Edit> Declarations::instancesOf(DeclId configuration) const {
  std::vector<Edit> found;
  const auto visit = [&](const auto& self, Slice<DeclId> members) -> void {
    for (const DeclId member : tree_.list(members)) {
      if (tree_.kind(member) == DeclKind::Resource) self(self, tree_.as<ResourceDecl>(member).members);
      if (tree_.kind(member) == DeclKind::ProgramInstance)
        found.push_back({source_.begin(member), source_.end(member), {}});
    }
  };
  visit(visit, tree_.as<ConfigurationDecl>(configuration).members);
  return found;
}

}  // namespace rung::conformance
