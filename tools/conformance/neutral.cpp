#include "tools/conformance/neutral.h"

#include <algorithm>
#include <map>
#include <set>

#include "frontend/syntax/children.h"
#include "tools/conformance/parts.h"
#include "tools/conformance/source.h"
#include "tools/conformance/standard_form.h"

namespace rung::conformance {
namespace {

constexpr const char* kInstance = "suite";
constexpr const char* kTask = "suite_task";
constexpr const char* kIdleProgram = "suite_program";  // of a configuration that has none

// A variable of the project: in VAR_GLOBAL of a file.
struct Global {
  std::string key, name, type;
  bool constant;
  size_t section;  // index in sections
};

class Writer {
 public:
  explicit Writer(const Program& program)
      : program_(program),
        source_(program.text, program.dialect),
        tree_(source_.tree),
        networks_(networksOf(source_)),
        base_(standardForm(program, source_)) {
    noteGlobals();
  }

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

  bool hasPragma(DeclId id, std::string_view name) const {
    for (const Pragma& pragma : tree_.list(tree_.decl(id).pragmas))
      if (upper(source_.names.string(pragma.name)) == name) return true;
    return false;
  }
  bool isTest(DeclId id) const { return tree_.kind(id) == DeclKind::Pou && hasPragma(id, "TEST"); }

  void collectTests(DeclId id, std::vector<Draft>& all) {
    if (isTest(id)) {
      all.push_back(draft(id));
    } else if (tree_.kind(id) == DeclKind::Namespace) {
      for (const DeclId inner : tree_.list(tree_.as<NamespaceDecl>(id).decls)) {
        if (!isTest(inner)) continue;
        Draft none;
        none.test = spelling(tree_.as<PouDecl>(inner).name);
        none.reason = "the test is inside of a NAMESPACE";
        all.push_back(none);
      }
    }
  }

  // ---- what the file has

  void noteGlobals() {
    for (const DeclId id : source_.decls) {
      if (tree_.kind(id) != DeclKind::Section) continue;
      const auto& section = tree_.as<SectionDecl>(id);
      if (section.section != SectionKind::Global) continue;
      sections_.push_back(id);
      for (const DeclId v : tree_.list(section.vars)) {
        if (tree_.kind(v) != DeclKind::Var) continue;
        const auto& var = tree_.as<VarDecl>(v);
        if (!var.type) continue;
        const Range type = tree_.range(var.type);
        const std::string written = part(source_.at(type.begin), source_.at(type.end), base_);
        for (const Ident& name : tree_.list(var.names))
          globals_.push_back({upper(spelling(name.name)), spelling(name.name), written,
                              (section.h.bits & kConstant) != 0, sections_.size() - 1});
      }
    }
  }

  // ---- what a test needs

  // The names in a part of the text, in upper case; those after a point are members.
  void addNames(size_t from, size_t to, std::set<std::string>& names) const {
    auto unit = source_.unitAt(from);
    bool after_point = false;
    for (; unit != source_.units.end() && unit->begin < to; ++unit) {
      if (unit->kind == UnitKind::Name && !after_point) names.insert(upper(textOf(*unit)));
      if (unit->kind == UnitKind::Comment) continue;
      if (unit->kind == UnitKind::Pragma && isInside(networks_, unit->begin)) addPragmaNames(textOf(*unit), names);
      after_point = unit->kind == UnitKind::Other && textOf(*unit) == ".";
    }
  }
  static void addPragmaNames(std::string_view pragma, std::set<std::string>& names) {
    Scanner scanner(pragma.substr(1));
    for (Unit unit = scanner.next(); unit.kind != UnitKind::End; unit = scanner.next())
      if (unit.kind == UnitKind::Name) names.insert(upper(scanner.textOf(unit)));
  }

  struct Needs {
    std::set<std::string> names;
    std::vector<DeclId> left_out;
    std::set<size_t> sections;  // of globals
  };
  Needs needsOf(DeclId test) const {
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
        addNames(begin(id), end(id), needs.names);
      }
    }
    for (bool more = true; more;) {
      more = false;
      for (size_t i = 0; i < open.size();) {
        const auto& pou = tree_.as<PouDecl>(open[i]);
        if (isTest(open[i]) || needs.names.count(upper(spelling(pou.name))) == 0) {
          ++i;
          continue;
        }
        addNames(begin(open[i]), end(open[i]), needs.names);
        open.erase(open.begin() + static_cast<std::ptrdiff_t>(i));
        more = true;
      }
      for (const Global& global : globals_)
        if (needs.names.count(global.key) != 0 && needs.sections.insert(global.section).second) {
          addNames(begin(sections_[global.section]), end(sections_[global.section]), needs.names);
          more = true;
        }
    }
    if (!test)
      for (size_t i = 0; i < sections_.size(); ++i) needs.sections.insert(i);
    else
      keepUnnamed(needs);
    needs.left_out = open;
    return needs;
  }
  // `AT %QW2 : WORD := 5;` has no name and may matter all the same.
  void keepUnnamed(Needs& needs) const {
    for (size_t i = 0; i < sections_.size(); ++i)
      for (const DeclId v : tree_.list(tree_.as<SectionDecl>(sections_[i]).vars))
        if (tree_.kind(v) == DeclKind::Var && tree_.as<VarDecl>(v).names.empty()) needs.sections.insert(i);
  }
  void addConfigurationNames(DeclId id, std::set<std::string>& names) const {
    size_t from = begin(id);
    for (const auto& instance : instancesOf(id)) {
      addNames(from, instance.begin, names);
      from = instance.end;
    }
    addNames(from, end(id), names);
  }
  // `PROGRAM p WITH t : Main;` of a configuration: a test runs alone.
  std::vector<Edit> instancesOf(DeclId configuration) const {
    std::vector<Edit> found;
    const auto visit = [&](const auto& self, Slice<DeclId> members) -> void {
      for (const DeclId member : tree_.list(members)) {
        if (tree_.kind(member) == DeclKind::Resource) self(self, tree_.as<ResourceDecl>(member).members);
        if (tree_.kind(member) == DeclKind::ProgramInstance) found.push_back({begin(member), end(member), {}});
      }
    };
    visit(visit, tree_.as<ConfigurationDecl>(configuration).members);
    return found;
  }

  // ---- assertions

  bool isAssertion(StmtId id, std::string& word) const {
    if (tree_.kind(id) != StmtKind::Call) return false;
    const ExprId call = tree_.as<CallStmt>(id).call;
    if (!call || tree_.kind(call) != ExprKind::Call) return false;
    const ExprId callee = tree_.as<CallExpr>(call).callee;
    if (tree_.kind(callee) != ExprKind::Name) return false;
    word = upper(source_.names.string(tree_.as<NameExpr>(callee).name));
    return word == "ASSERT" || word == "ASSERT_EQ" || word == "ASSERT_NEAR";
  }

  // `needs_parens`: beside an operator.
  std::string operand(ExprId id, bool needs_parens) const {
    const Range range = tree_.range(id);
    std::string written(text().substr(source_.at(range.begin), source_.at(range.end) - source_.at(range.begin)));
    const bool is_operation = tree_.kind(id) == ExprKind::Binary || tree_.kind(id) == ExprKind::Unary;
    return needs_parens && is_operation && tree_.expr(id).in_parens == 0 ? "(" + written + ")" : written;
  }
  std::string condition(const std::string& word, std::span<const Argument> arguments) const {
    if (word == "ASSERT" && !arguments.empty()) return operand(arguments[0].value, false);
    if (word == "ASSERT_EQ" && arguments.size() >= 2)
      return operand(arguments[0].value, true) + " = " + operand(arguments[1].value, true);
    if (word == "ASSERT_NEAR" && arguments.size() >= 3)
      return "ABS(" + operand(arguments[1].value, true) + " - " + operand(arguments[0].value, true) +
             ") <= " + operand(arguments[2].value, true);
    return {};
  }

  template <class Id>
  void findAssertions(Id id, std::vector<StmtId>& found) const {
    if constexpr (std::is_same_v<Id, StmtId>) {
      std::string word;
      if (isAssertion(id, word)) {
        found.push_back(id);
        return;
      }
    }
    forEachChild(tree_, id, [&](const auto& child) { findAssertions(child, found); });
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
      if (hasPragma(test, pragma)) draft.reason = "a service of `rung test`: {case}, {skip} or {mock}";
    for (const DeclId id : source_.decls)
      for (const char* pragma : {"SETUP", "TEARDOWN"})
        if (tree_.kind(id) == DeclKind::Pou && hasPragma(id, pragma))
          draft.reason = "a service of `rung test`: {setup}";
    const auto& pou = tree_.as<PouDecl>(test);
    if (pou.pou_kind != PouKind::Program && pou.pou_kind != PouKind::FunctionBlock)
      draft.reason = "the test is a FUNCTION";
  }

  // The place after the header and sections of a POU. Its body may begin later, after an empty statement.
  size_t bodyOf(const PouDecl& pou) const {
    size_t at = 0;
    for (const DeclId section : tree_.list(pou.sections)) at = std::max(at, end(section));
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
    addNames(begin(id), end(id), names);
    const std::set<std::string> declared = declaredIn(pou);
    std::string plain, constant;
    for (const Global& global : globals_)
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
    if (tree_.kind(id) != DeclKind::Pou || program_.dialect != Dialect::Codesys) return;
    const auto& pou = tree_.as<PouDecl>(id);
    for (const DeclId member : tree_.list(pou.members))
      declareAccess(member, pou.pou_kind == PouKind::Interface, edits);
    if (pou.pou_kind != PouKind::Method || pou.access != AccessLevel::None || in_interface) return;
    auto unit = source_.unitAt(begin(id));
    while (unit != source_.units.end() && (unit->kind != UnitKind::Name || upper(textOf(*unit)) != "METHOD")) ++unit;
    if (unit != source_.units.end()) edits.push_back({unit->end, unit->end, " PUBLIC"});
  }

  std::string unusedPrefix() const {
    for (const char* prefix : {"check_", "verdict_", "held_"}) {
      const bool used = std::any_of(source_.units.begin(), source_.units.end(), [&](const Unit& unit) {
        return unit.kind == UnitKind::Name && upper(textOf(unit)).starts_with(upper(prefix));
      });
      if (!used) return prefix;
    }
    return "suite_check_";
  }

  Draft draft(DeclId test) {
    Draft draft;
    if (test) draft.test = spelling(tree_.as<PouDecl>(test).name);
    if (tree_.files.empty()) {
      draft.reason = "it cannot be read";
      return draft;
    }
    const Needs needs = needsOf(test);
    for (const DeclId id : source_.decls)
      if (std::find(needs.left_out.begin(), needs.left_out.end(), id) == needs.left_out.end()) {
        describe(id, draft);
      }
    if (test) refuse(test, draft);
    if (!draft.reason.empty()) return draft;

    std::vector<Edit> edits = base_;
    for (const DeclId id : needs.left_out)
      edits.push_back({begin(id), end(id), lineEndsOf(text(), begin(id), end(id))});
    std::string moved;
    for (size_t i = 0; i < sections_.size(); ++i) {
      const DeclId section = sections_[i];
      if (needs.sections.count(i) != 0) moved += part(begin(section), end(section), base_) + "\n";
      edits.push_back({begin(section), end(section), lineEndsOf(text(), begin(section), end(section))});
    }
    for (const DeclId id : source_.decls)
      if (std::find(needs.left_out.begin(), needs.left_out.end(), id) == needs.left_out.end())
        declareExternals(id, edits);
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
      if (std::find(needs.left_out.begin(), needs.left_out.end(), id) != needs.left_out.end() || id == test) continue;
      std::vector<StmtId> elsewhere;
      findAssertions(id, elsewhere);
      if (!elsewhere.empty()) draft.reason = "assertions outside of the test";
    }
    const std::string wrapper = program == draft.test ? std::string() : wrapperText(program, draft.test);
    placeConfiguration(program, moved, wrapper, edits);
    draft.text = part(0, text().size(), edits);
    if (!draft.text.ends_with('\n')) draft.text += '\n';
    draft.text += after_;
    while (draft.text.ends_with("\n\n")) draft.text.pop_back();
    if (test) draft.text = withFewBlankLines(draft.text);
    if (isNamed(draft.text, "ASSERT")) draft.reason = "assertions outside of the test";
    if (isNamed(draft.text, "TEST_ADVANCE")) draft.reason = "TEST_ADVANCE: time passes within a cycle";
    return draft;
  }

  static bool isNamed(std::string_view text, std::string_view beginning) {
    Scanner scanner(text);
    for (Unit unit = scanner.nextCode(); unit.kind != UnitKind::End; unit = scanner.nextCode())
      if (unit.kind == UnitKind::Name && upper(scanner.textOf(unit)).starts_with(beginning)) return true;
    return false;
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
    std::vector<StmtId> assertions;
    findAssertions(test, assertions);
    std::sort(assertions.begin(), assertions.end(),
              [&](StmtId a, StmtId b) { return tree_.range(a).begin < tree_.range(b).begin; });
    const std::string prefix = unusedPrefix();
    std::string names;
    for (const StmtId id : assertions) {
      std::string word;
      isAssertion(id, word);
      const auto arguments = tree_.list(tree_.as<CallExpr>(tree_.as<CallStmt>(id).call).arguments);
      const std::string holds = condition(word, arguments);
      if (holds.empty()) {
        draft.reason = "an assertion that is not understood";
        return;
      }
      const Range range = tree_.range(id);
      // Neither sizes in memory nor what the standard leaves open.
      if (isNamed(holds, "SIZEOF") || program_.choices.count(draft.test + ":" + holds) != 0) {
        edits.push_back({source_.at(range.begin), source_.at(range.end), {}});
        continue;
      }
      const std::string name = prefix + std::to_string(draft.watch.size() + 1);
      edits.push_back({source_.at(range.begin), source_.at(range.end),
                       "IF " + holds + " THEN IF " + name + " = 0 THEN " + name + " := 1; END_IF; ELSE " + name +
                           " := 2; END_IF;"});
      names += (names.empty() ? "" : ", ") + name;
      draft.watch.push_back(std::string(kInstance) + "." + name);
      draft.checks.emplace_back(holds);
    }
    if (draft.watch.empty()) {
      draft.reason = "the test asserts nothing";
      return;
    }
    const auto& pou = tree_.as<PouDecl>(test);
    edits.push_back({bodyOf(pou), bodyOf(pou), " VAR " + names + " : INT; END_VAR\n"});
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
    for (Edit& gone : instancesOf(configuration)) edits.push_back(gone);
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
  std::vector<DeclId> sections_;
  std::vector<Global> globals_;
  const std::vector<std::pair<size_t, size_t>> networks_;
  const std::vector<Edit> base_;  // to the standard's form
  std::string after_;
};

}  // namespace

std::vector<Draft> neutralDrafts(const Program& program) { return Writer(program).drafts(); }

}  // namespace rung::conformance
