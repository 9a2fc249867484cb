// SPDX-License-Identifier: Apache-2.0
#include "tools/conformance/neutral.h"

#include <algorithm>
#include <map>
#include <set>

#include "frontend/syntax/children.h"
#include "tools/conformance/checks.h"
#include "tools/conformance/needs.h"
#include "tools/conformance/parts.h"
#include "tools/conformance/source.h"
#include "tools/conformance/standard_form.h"

namespace rung::conformance {
namespace {

constexpr const char* kInstance = "suite";
constexpr const char* kTask = "suite_task";
constexpr const char* kIdleProgram = "suite_program";  // of a configuration that has none

class Writer {
 public:
  explicit Writer(const Program& program)
      : program_(program),
        source_(program.text, program.dialect),
        tree_(source_.tree),
        base_(standardForm(program, source_)),
        declarations_(source_, base_) {}

  std::vector<Draft> drafts() {
    std::vector<Draft> all;
    if (!program_.expects)
      for (const DeclId id : source_.decls) collectTests(id, all);
    if (all.empty()) all.push_back(draft({}));
    return all;
  }

 private:
  std::string_view text() const { return source_.text(); }
  std::string_view textOf(const Unit& unit) const { return source_.textOf(unit); }
  std::string spelling(NameId name) const { return source_.spelling(name); }
  size_t begin(DeclId id) const { return source_.begin(id); }
  size_t end(DeclId id) const { return source_.end(id); }

  void collectTests(DeclId id, std::vector<Draft>& all) {
    if (declarations_.isTest(id)) {
      all.push_back(draft(id));
    } else if (tree_.kind(id) == DeclKind::Namespace) {
      for (const DeclId inner : tree_.list(tree_.as<NamespaceDecl>(id).decls)) {
        if (!declarations_.isTest(inner)) continue;
        Draft none;
        none.test = spelling(tree_.as<PouDecl>(inner).name);
        none.reason = "the test is inside of a NAMESPACE";
        all.push_back(none);
      }
    }
  }

  // ---- one draft

  void describe(DeclId id, Draft& draft) const {
    if (tree_.kind(id) == DeclKind::Namespace) {
      for (const DeclId inner : tree_.list(tree_.as<NamespaceDecl>(id).decls)) describe(inner, draft);
      return;
    }
    if (tree_.kind(id) == DeclKind::Property) draft.reason = "PROPERTY, of edition 4";
    if (tree_.kind(id) != DeclKind::Pou) return;
    const auto& pou = tree_.as<PouDecl>(id);
    if (pou.pou_kind == PouKind::Class || pou.pou_kind == PouKind::Interface || pou.pou_kind == PouKind::Method ||
        !pou.bases.empty() || !pou.implements.empty())
      draft.has_objects = true;
    std::string language;
    switch (pou.body_kind) {
      case BodyKind::None: break;
      case BodyKind::St: language = "ST"; break;
      case BodyKind::Il: language = "IL"; break;
      case BodyKind::Sfc: language = "SFC"; break;
      case BodyKind::Network:
        language = languageOf(pou);
        draft.has_networks = true;
        break;
      case BodyKind::Cpp:
      case BodyKind::Native: draft.reason = "a body in C++"; break;
    }
    if (!language.empty() &&
        std::find(draft.languages.begin(), draft.languages.end(), language) == draft.languages.end())
      draft.languages.push_back(language);
    for (const DeclId member : tree_.list(pou.members)) describe(member, draft);
    for (const SfcTransition& transition : tree_.list(pou.transitions))
      if (transition.body) describe(transition.body, draft);
  }
  std::string languageOf(const PouDecl& pou) const {
    const std::string_view body = text().substr(source_.at(pou.body_begin), 40);
    for (const std::string language : {"LD", "FBD", "CFC"})
      if (body.find(" " + language) != std::string_view::npos) return language;
    return "FBD";
  }

  void refuse(DeclId test, Draft& draft) const {
    for (const char* pragma : {"CASE", "SKIP", "MOCK"})
      if (declarations_.hasPragma(test, pragma)) draft.reason = "a service of `rung test`: {case}, {skip} or {mock}";
    for (const DeclId id : source_.decls)
      for (const char* pragma : {"SETUP", "TEARDOWN"})
        if (tree_.kind(id) == DeclKind::Pou && declarations_.hasPragma(id, pragma))
          draft.reason = "a service of `rung test`: {setup}";
    const auto& pou = tree_.as<PouDecl>(test);
    if (pou.pou_kind != PouKind::Program && pou.pou_kind != PouKind::FunctionBlock)
      draft.reason = "the test is a FUNCTION";
  }

  // The section may end with a semicolon, which is an empty statement in the standard.
  size_t endVarOf(DeclId section) const {
    size_t at = end(section);
    for (auto unit = source_.unitAt(begin(section)); unit != source_.units.end() && unit->end <= end(section); ++unit)
      if (unit->kind == UnitKind::Name && upper(textOf(*unit)) == "END_VAR") at = unit->end;
    return at;
  }
  // The place after the header and sections of a POU. Its body may begin later, after an empty statement.
  size_t bodyOf(const PouDecl& pou) const {
    size_t at = 0;
    for (const DeclId section : tree_.list(pou.sections)) at = std::max(at, endVarOf(section));
    if (at != 0) return at;
    at = source_.at(pou.body_begin);
    for (const DeclId member : tree_.list(pou.members)) at = std::min(at, begin(member));
    return at;
  }
  size_t sectionsOf(const PouDecl& pou) const {
    size_t at = bodyOf(pou);
    for (const DeclId section : tree_.list(pou.sections)) at = std::min(at, begin(section));
    return at;
  }

  std::set<std::string> declaredIn(const PouDecl& pou) const {
    std::set<std::string> names;
    const auto add = [&](const PouDecl& in) {
      for (const DeclId section : tree_.list(in.sections))
        for (const DeclId v : tree_.list(tree_.as<SectionDecl>(section).vars))
          if (tree_.kind(v) == DeclKind::Var)
            for (const Ident& name : tree_.list(tree_.as<VarDecl>(v).names)) names.insert(upper(spelling(name.name)));
    };
    add(pou);
    return names;
  }

  void declareExternals(DeclId id, std::vector<Edit>& edits) const {
    if (tree_.kind(id) == DeclKind::Namespace) {
      for (const DeclId inner : tree_.list(tree_.as<NamespaceDecl>(id).decls)) declareExternals(inner, edits);
      return;
    }
    if (tree_.kind(id) != DeclKind::Pou) return;
    const auto& pou = tree_.as<PouDecl>(id);
    if (pou.pou_kind == PouKind::Interface) return;
    std::set<std::string> names;
    declarations_.addNames(begin(id), end(id), names);
    const std::set<std::string> declared = declaredIn(pou);
    std::string plain, constant;
    for (const Global& global : declarations_.globals)
      if (names.count(global.key) != 0 && declared.count(global.key) == 0)
        (global.constant ? constant : plain) += " " + global.name + " : " + global.type + ";";
    std::string all;
    if (!plain.empty()) all += "VAR_EXTERNAL" + plain + " END_VAR ";
    if (!constant.empty()) all += "VAR_EXTERNAL CONSTANT" + constant + " END_VAR ";
    if (!all.empty()) edits.push_back({sectionsOf(pou), sectionsOf(pou), all});
  }

  // A method without an access specifier is PUBLIC in codesys, and PROTECTED in the standard.
  void declareAccess(DeclId id, bool in_interface, std::vector<Edit>& edits) const {
    if (tree_.kind(id) == DeclKind::Namespace) {
      for (const DeclId inner : tree_.list(tree_.as<NamespaceDecl>(id).decls)) declareAccess(inner, false, edits);
      return;
    }
    if (tree_.kind(id) != DeclKind::Pou || !profileOf(program_.dialect).public_members) return;
    const auto& pou = tree_.as<PouDecl>(id);
    for (const DeclId member : tree_.list(pou.members))
      declareAccess(member, pou.pou_kind == PouKind::Interface, edits);
    if (pou.pou_kind != PouKind::Method || pou.access != AccessLevel::None || in_interface) return;
    auto unit = source_.unitAt(begin(id));
    while (unit != source_.units.end() && (unit->kind != UnitKind::Name || upper(textOf(*unit)) != "METHOD")) ++unit;
    if (unit != source_.units.end()) edits.push_back({unit->end, unit->end, " PUBLIC"});
  }

  Draft draft(DeclId test) {
    Draft draft;
    if (test) draft.test = spelling(tree_.as<PouDecl>(test).name);
    if (tree_.files.empty()) {
      draft.reason = "it cannot be read";
      return draft;
    }
    const Needs needs = declarations_.needsOf(test);
    for (const DeclId id : source_.decls)
      if (needs.has(id)) {
        describe(id, draft);
      }
    if (test) refuse(test, draft);
    if (!draft.reason.empty()) return draft;

    std::vector<Edit> edits = base_;
    for (const DeclId id : needs.left_out)
      edits.push_back({begin(id), end(id), lineEndsOf(text(), begin(id), end(id))});
    std::string moved;
    for (size_t i = 0; i < declarations_.sections.size(); ++i) {
      const DeclId section = declarations_.sections[i];
      if (needs.sections.count(i) != 0) moved += part(begin(section), end(section), base_) + "\n";
      edits.push_back({begin(section), end(section), lineEndsOf(text(), begin(section), end(section))});
    }
    for (const DeclId id : source_.decls)
      if (needs.has(id)) declareExternals(id, edits);
    for (const DeclId id : source_.decls) declareAccess(id, false, edits);
    if (!test && program_.expects)
      for (const DeclId id : source_.decls) giveStatement(id, edits);
    std::string program;
    if (test) {
      program = draft.test;
      rewriteTest(test, edits, draft);
      if (tree_.as<PouDecl>(test).pou_kind == PouKind::FunctionBlock) program = wrap(draft);
      addDone(test, draft);
    }
    for (const DeclId id : source_.decls) {
      if (!needs.has(id) || id == test) continue;
      if (hasAssertions(source_, id)) draft.reason = "assertions outside of the test";
    }
    const std::string wrapper = program == draft.test ? std::string() : wrapperText(program, draft.test);
    placeConfiguration(program, moved, wrapper, edits);
    draft.text = part(0, text().size(), edits);
    if (!draft.text.ends_with('\n')) draft.text += '\n';
    draft.text += after_;
    while (draft.text.ends_with("\n\n")) draft.text.pop_back();
    if (test) draft.text = withFewBlankLines(draft.text);
    if (hasName(draft.text, "ASSERT")) draft.reason = "assertions outside of the test";
    if (draft.reason.empty() && hasName(draft.text, "TEST_ADVANCE"))
      draft.reason = "TEST_ADVANCE inside of a statement: time passes within a cycle";
    return draft;
  }

  // Only the lines of errors must stay where they are.
  static std::string withFewBlankLines(const std::string& text) {
    std::string out;
    for (const std::string& line : linesOf(text))
      if (line.find_first_not_of(' ') != std::string::npos) out += line + "\n";
    return out;
  }

  // A body keeps a statement when those with errors are left out: one without any is not of edition 2.
  void giveStatement(DeclId id, std::vector<Edit>& edits) const {
    if (tree_.kind(id) != DeclKind::Pou) return;
    const auto& pou = tree_.as<PouDecl>(id);
    const bool has_body =
        pou.pou_kind == PouKind::Program || pou.pou_kind == PouKind::FunctionBlock || pou.pou_kind == PouKind::Function;
    if (!has_body || pou.body_kind != BodyKind::St || !pou.members.empty()) return;
    edits.push_back({bodyOf(pou), bodyOf(pou), " " + std::string(kIdleDeclaration) + kIdleStatement + " "});
  }

  void rewriteTest(DeclId test, std::vector<Edit>& edits, Draft& draft) const {
    const size_t body = bodyOf(tree_.as<PouDecl>(test));
    std::set<std::string> choices;
    for (const std::string& choice : program_.choices)
      if (choice.starts_with(draft.test + ":")) choices.insert(choice.substr(draft.test.size() + 1));
    Checks checks = checksOf(source_, test, body, choices);
    if (!checks.reason.empty()) draft.reason = checks.reason;
    for (const std::string& name : checks.names) draft.watch.push_back(std::string(kInstance) + "." + name);
    draft.checks = checks.conditions;
    draft.cycles = checks.cycles;
    std::string variables = joined(checks.names, ", ") + " : INT;";
    for (const std::string& variable : checks.variables) variables += " " + variable + ";";
    edits.push_back({body, body, " VAR " + variables + " END_VAR\n"});
    edits.insert(edits.end(), checks.edits.begin(), checks.edits.end());
  }

  // A test that is a block runs in a program.
  static std::string wrap(Draft& draft) {
    for (std::string& path : draft.watch) path.insert(std::string(kInstance).size() + 1, "tested.");
    return "run_" + draft.test;
  }
  static std::string wrapperText(const std::string& program, const std::string& block) {
    return "PROGRAM " + program + "\nVAR tested : " + block + "; END_VAR\ntested();\nEND_PROGRAM\n";
  }

  void addDone(DeclId test, Draft& draft) const {
    const auto& pou = tree_.as<PouDecl>(test);
    if (declaredIn(pou).count("DONE") == 0) return;
    draft.done = std::string(kInstance) + (pou.pou_kind == PouKind::FunctionBlock ? ".tested" : "") + ".done";
  }

  // The configuration that runs the test, and holds the variables of the project.
  void placeConfiguration(const std::string& program, const std::string& moved, const std::string& wrapper,
                          std::vector<Edit>& edits) {
    after_ = wrapper;
    DeclId configuration;
    for (const DeclId id : source_.decls)
      if (tree_.kind(id) == DeclKind::Configuration) configuration = id;
    const bool needs_program = program.empty() && !moved.empty() && !configuration;
    if (needs_program)
      after_ += "PROGRAM " + std::string(kIdleProgram) + " " + kIdleDeclaration + kIdleStatement + " END_PROGRAM\n";
    const std::string instance = "    PROGRAM " + std::string(kInstance) + " WITH " + kTask + " : " +
                                 (needs_program ? kIdleProgram : program) + ";\n";
    const std::string task = "    TASK " + std::string(kTask) + "(INTERVAL := T#10ms, PRIORITY := 1);\n";
    if (!configuration) {
      if (program.empty() && moved.empty()) return;
      after_ += "CONFIGURATION suite_configuration\n" + moved;
      after_ += "  RESOURCE suite_resource ON PLC\n" + task + instance + "  END_RESOURCE\nEND_CONFIGURATION\n";
      return;
    }
    const auto& decl = tree_.as<ConfigurationDecl>(configuration);
    const std::span<const DeclId> members = tree_.list(decl.members);
    if (members.empty()) return;
    if (!moved.empty()) edits.push_back({begin(members[0]), begin(members[0]), moved});
    if (program.empty()) return;
    for (Edit& gone : declarations_.instancesOf(configuration)) edits.push_back(gone);
    placeInstance(configuration, members, task, instance, edits);
  }
  void placeInstance(DeclId configuration, std::span<const DeclId> members, const std::string& task,
                     const std::string& instance, std::vector<Edit>& edits) const {
    for (const DeclId member : members) {
      if (tree_.kind(member) != DeclKind::Resource) continue;
      size_t task_at = 0, at = 0;
      for (const DeclId inner : tree_.list(tree_.as<ResourceDecl>(member).members)) {
        const DeclKind kind = tree_.kind(inner);
        if (task_at == 0 && (kind == DeclKind::Task || kind == DeclKind::ProgramInstance)) task_at = begin(inner);
        at = end(inner);
      }
      if (task_at == 0) task_at = at;
      if (at == 0) return;
      edits.push_back({task_at, task_at, task});
      edits.push_back({at, at, "\n" + instance});
      return;
    }
    size_t at = 0, task_at = 0;
    for (const DeclId member : members) {
      const DeclKind kind = tree_.kind(member);
      if (task_at == 0 && (kind == DeclKind::Task || kind == DeclKind::ProgramInstance)) task_at = begin(member);
      at = end(member);
    }
    if (task_at == 0) {  // no resource yet
      edits.push_back({at, at, "\n  RESOURCE suite_resource ON PLC\n" + task + instance + "  END_RESOURCE\n"});
      return;
    }
    edits.push_back({task_at, task_at, task});
    edits.push_back({at, at, "\n" + instance});
    static_cast<void>(configuration);
  }

  std::string part(size_t from, size_t to, const std::vector<Edit>& edits) const {
    return rendered(text(), from, to, edits);
  }

  const Program& program_;
  Source source_;
  const Tree& tree_;
  const std::vector<Edit> base_;  // to the standard's form
  const Declarations declarations_;
  std::string after_;
};

}  // namespace

std::vector<Draft> neutralDrafts(const Program& program) { return Writer(program).drafts(); }

}  // namespace rung::conformance
