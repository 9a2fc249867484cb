// SPDX-License-Identifier: Apache-2.0
#include "tools/conformance/checks.h"

#include <algorithm>

#include "frontend/syntax/children.h"

namespace rung::conformance {
namespace {

class Rewriter {
 public:
  explicit Rewriter(const Source& source) : source_(source), tree_(source.tree) {}

  Checks rewrite(DeclId test, size_t body, const std::set<std::string>& choices) const {
    Checks checks;
    std::vector<StmtId> assertions;
    findAssertions(test, assertions);
    std::sort(assertions.begin(), assertions.end(),
              [&](StmtId a, StmtId b) { return tree_.range(a).begin < tree_.range(b).begin; });
    const std::string prefix = unusedPrefix();
    for (const StmtId id : assertions) {
      std::string word;
      isAssertion(id, word);
      const std::string holds = condition(word, tree_.list(tree_.as<CallExpr>(tree_.as<CallStmt>(id).call).arguments));
      if (holds.empty()) {
        checks.reason = "an assertion that is not understood";
        return checks;
      }
      const Range range = tree_.range(id);
      // Neither sizes in memory nor what the standard leaves open.
      if (hasName(holds, "SIZEOF") || choices.count(holds) != 0) {
        checks.edits.push_back({source_.at(range.begin), source_.at(range.end), {}});
        continue;
      }
      const std::string name = prefix + std::to_string(checks.names.size() + 1);
      checks.edits.push_back({source_.at(range.begin), source_.at(range.end),
                              "IF " + holds + " THEN IF " + name + " = 0 THEN " + name + " := 1; END_IF; ELSE " + name +
                                  " := 2; END_IF;"});
      checks.names.push_back(name);
      checks.conditions.push_back(holds);
    }
    if (checks.names.empty())
      checks.reason = "the test asserts nothing";
    else
      becomeCycles(test, body, checks);
    return checks;
  }

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
    std::string written(
        source_.text().substr(source_.at(range.begin), source_.at(range.end) - source_.at(range.begin)));
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

  // TEST_ADVANCE(T#…) between the statements of the body: each part of the body is the branch of a cycle.
  void becomeCycles(DeclId test, size_t body, Checks& checks) const {
    int64_t time = 0;
    const std::span<const StmtId> statements = tree_.list(tree_.as<PouDecl>(test).body);
    std::vector<Edit> labels;
    for (const StmtId id : statements) {
      int64_t by = 0;
      if (!isAdvance(id, by)) continue;
      if (by <= 0 || by % kCycleNs != 0) {
        checks.reason = "TEST_ADVANCE by what is not a multiple of 10 ms";
        return;
      }
      time += by;
      const Range range = tree_.range(id);
      const bool is_last = id == statements.back();
      labels.push_back({source_.at(range.begin), source_.at(range.end),
                        "\n" + std::to_string(time / kCycleNs) + ": " + (is_last ? ";" : "")});
    }
    if (labels.empty()) return;
    const size_t end = source_.at(tree_.range(statements.back()).end);
    checks.edits.insert(checks.edits.end(), labels.begin(), labels.end());
    checks.edits.push_back({body, body, "\nCASE suite_cycle OF\n0: "});
    checks.edits.push_back({end, end, "\nEND_CASE;\nsuite_cycle := suite_cycle + 1;"});
    checks.variables.emplace_back("suite_cycle : DINT");
    checks.cycles = time / kCycleNs + 1;
  }
  bool isAdvance(StmtId id, int64_t& by) const {
    if (tree_.kind(id) != StmtKind::Call) return false;
    const ExprId call = tree_.as<CallStmt>(id).call;
    if (!call || tree_.kind(call) != ExprKind::Call) return false;
    const auto& advance = tree_.as<CallExpr>(call);
    if (tree_.kind(advance.callee) != ExprKind::Name ||
        upper(source_.names.string(tree_.as<NameExpr>(advance.callee).name)) != "TEST_ADVANCE")
      return false;
    const std::span<const Argument> arguments = tree_.list(advance.arguments);
    if (arguments.size() == 1 && tree_.kind(arguments[0].value) == ExprKind::Literal)
      by = static_cast<int64_t>(tree_.as<LiteralExpr>(arguments[0].value).value());
    return true;
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

  std::string unusedPrefix() const {
    for (const char* prefix : {"check_", "verdict_", "held_"}) {
      const bool used = std::any_of(source_.units.begin(), source_.units.end(), [&](const Unit& unit) {
        return unit.kind == UnitKind::Name && upper(source_.textOf(unit)).starts_with(upper(prefix));
      });
      if (!used) return prefix;
    }
    return "suite_check_";
  }

 private:
  const Source& source_;
  const Tree& tree_;
};

}  // namespace

Checks checksOf(const Source& source, DeclId test, size_t body, const std::set<std::string>& choices) {
  return Rewriter(source).rewrite(test, body, choices);
}

bool hasAssertions(const Source& source, DeclId id) {
  std::vector<StmtId> found;
  Rewriter(source).findAssertions(id, found);
  return !found.empty();
}

bool hasName(std::string_view text, std::string_view beginning) {
  Scanner scanner(text);
  for (Unit unit = scanner.nextCode(); unit.kind != UnitKind::End; unit = scanner.nextCode())
    if (unit.kind == UnitKind::Name && upper(scanner.textOf(unit)).starts_with(beginning)) return true;
  return false;
}

}  // namespace rung::conformance
