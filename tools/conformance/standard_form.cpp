// SPDX-License-Identifier: Apache-2.0
#include "tools/conformance/standard_form.h"

#include <algorithm>

#include "frontend/syntax/children.h"

namespace rung::conformance {
namespace {

void collectNetworks(const Source& source, DeclId id, std::vector<std::pair<size_t, size_t>>& networks) {
  const Tree& tree = source.tree;
  if (tree.kind(id) == DeclKind::Namespace)
    for (const DeclId inner : tree.list(tree.as<NamespaceDecl>(id).decls)) collectNetworks(source, inner, networks);
  if (tree.kind(id) != DeclKind::Pou) return;
  const auto& pou = tree.as<PouDecl>(id);
  if (pou.body_kind == BodyKind::Network) networks.push_back({source.at(pou.body_begin), source.at(pou.body_end)});
  for (const DeclId member : tree.list(pou.members)) collectNetworks(source, member, networks);
  for (const SfcTransition& transition : tree.list(pou.transitions))
    if (transition.body) collectNetworks(source, transition.body, networks);
}

bool isHeadLine(std::string_view comment) {
  for (const std::string_view key :
       {"features:", "covers:", "args:", "run:", "with:", "expect:", "trace:", "exit:", "restart:"})
    if (comment.substr(3).starts_with(key)) return true;
  return comment.starts_with("// expect ");
}

std::string inParentheses(std::string_view words) {
  std::string out;
  for (const char c : words)
    if (c != '*' && (c == '\n' || static_cast<unsigned char>(c) >= 32) && static_cast<unsigned char>(c) < 127 &&
        c != '{' && c != '}' && c != '$')
      out += c;
  while (!out.empty() && out.front() == ' ') out.erase(0, 1);
  while (!out.empty() && out.back() == ' ') out.pop_back();
  return out.empty() ? out : "(* " + out + " *)";
}

class Former {
 public:
  Former(const Program& program, const Source& source)
      : program_(program), source_(source), tree_(source.tree), networks_(networksOf(source)) {}

  std::vector<Edit> edits() {
    comments();
    for (size_t i = 0; i < source_.units.size(); ++i) words(i);
    for (const DeclId id : source_.decls) declarations(id);
    return std::move(edits_);
  }

 private:
  std::string_view textOf(size_t i) const {
    return i < source_.units.size() ? source_.textOf(source_.units[i]) : std::string_view();
  }
  void replace(const Unit& unit, const std::string& by) { edits_.push_back({unit.begin, unit.end, by}); }
  void insert(size_t at, const std::string& text) { edits_.push_back({at, at, text}); }

  // Comments in the form that every edition has, unless they are the subject; pragmas go.
  void comments() {
    const auto isSubject = [&](const char* table) {
      return std::any_of(program_.features.begin(), program_.features.end(),
                         [&](const std::string& feature) { return feature.starts_with(table); });
    };
    const bool keeps_comments = isSubject("3/"), keeps_pragmas = isSubject("4/1");
    bool heads = true;
    for (const Unit& unit : source_.units) {
      if (unit.kind == UnitKind::Pragma) {
        heads = false;
        if (isInside(networks_, unit.begin) || (keeps_pragmas && source_.textOf(unit) != "{test}")) continue;
        replace(unit, lineEndsOf(source_.text(), unit.begin, unit.end));
      } else if (unit.kind != UnitKind::Comment) {
        heads = false;
      } else {
        comment(unit, keeps_comments && !heads);
      }
    }
  }
  void comment(const Unit& unit, bool is_kept) {
    const std::string_view comment = source_.textOf(unit);
    if (comment.starts_with("// ") && isHeadLine(comment)) return replace(unit, {});
    if (is_kept) return;
    if (comment.starts_with("//")) {
      const size_t words = std::min(comment.find_first_not_of('/'), comment.size());
      replace(unit, inParentheses(comment.substr(words)));
    } else if (comment.starts_with("/*") || comment.find("(*", 2) != std::string_view::npos) {
      replace(unit, inParentheses(comment.substr(2, comment.size() - 4)));
    }
  }

  void words(size_t i) {
    if (source_.units[i].kind != UnitKind::Name) return;
    const std::string word = upper(textOf(i));
    // SUPER^ and THIS^ of codesys are SUPER and THIS of the standard.
    if ((word == "SUPER" || word == "THIS") && textOf(i + 1) == "^") return replace(source_.units[i + 1], {});
    // STRING(20) of codesys is STRING[20].
    if ((word == "STRING" || word == "WSTRING") && textOf(i + 1) == "(" && textOf(i + 3) == ")") {
      replace(source_.units[i + 1], "[");
      return replace(source_.units[i + 3], "]");
    }
    semicolon(i, word);
  }
  // END_IF and the like end a statement, END_STRUCT a declaration: the standard wants a semicolon after them.
  void semicolon(size_t i, const std::string& word) {
    if (word != "END_IF" && word != "END_CASE" && word != "END_FOR" && word != "END_WHILE" && word != "END_REPEAT" &&
        word != "END_STRUCT")
      return;
    if (isInside(networks_, source_.units[i].begin)) return;
    const std::string_view after = textOf(source_.nextCode(i));
    if (after != ";" && after != ":" && after != ")") insert(source_.units[i].end, ";");
  }

  // ---- declarations

  template <class Id>
  void declarations(Id id) {
    if constexpr (std::is_same_v<Id, TypeExprId>) {
      if (tree_.kind(id) == TypeExprKind::Struct)
        for (const DeclId field : tree_.list(tree_.as<StructTypeExpr>(id).fields)) oneForEachName(field);
    }
    if constexpr (std::is_same_v<Id, DeclId>) {
      if (tree_.kind(id) == DeclKind::Section && tree_.as<SectionDecl>(id).section == SectionKind::External)
        for (const DeclId var : tree_.list(tree_.as<SectionDecl>(id).vars)) oneForEachName(var);
      if (tree_.kind(id) == DeclKind::Section && tree_.as<SectionDecl>(id).section == SectionKind::Local) apart(id);
      if (tree_.kind(id) == DeclKind::Pou) bodies(tree_.as<PouDecl>(id));
    }
    forEachChild(tree_, id, [&](const auto& child) { declarations(child); });
  }
  // Located variables, partly located ones and others have sections of their own: located_var_declarations,
  // incompletely_located_var_declarations and var_declarations of annex B, Loc_Var_Decls and the like of annex A.
  void apart(DeclId id) {
    const std::span<const DeclId> vars = tree_.list(tree_.as<SectionDecl>(id).vars);
    const auto kindOf = [&](DeclId var) {
      if (tree_.kind(var) != DeclKind::Var || !tree_.as<VarDecl>(var).located) return 0;
      return tree_.as<VarDecl>(var).address.incomplete ? 1 : 2;
    };
    std::string head = "END_VAR";
    for (auto unit = source_.unitAt(source_.begin(id)); !vars.empty() && unit->begin < source_.begin(vars.front());
         ++unit)
      if (unit->kind == UnitKind::Name) head += " " + std::string(source_.textOf(*unit));
    for (size_t i = 1; i < vars.size(); ++i)
      if (kindOf(vars[i]) != kindOf(vars[i - 1])) insert(source_.begin(vars[i]), head + " ");
  }
  // `a, b : INT := 1;` is `a : INT := 1; b : INT := 1;`.
  void oneForEachName(DeclId id) {
    if (tree_.kind(id) != DeclKind::Var) return;
    const std::span<const Ident> names = tree_.list(tree_.as<VarDecl>(id).names);
    if (names.size() < 2) return;
    const auto colon = std::find_if(source_.unitAt(source_.at(names.back().loc)), source_.units.end(),
                                    [&](const Unit& unit) { return source_.textOf(unit) == ":"; });
    size_t end = source_.end(id);
    if (colon == source_.units.end() || end <= colon->begin) return;
    if (source_.text()[end - 1] == ';') --end;
    const std::string type(source_.text().substr(colon->begin, end - colon->begin));
    for (size_t i = 0; i + 1 < names.size(); ++i) {
      const auto comma = std::find_if(source_.unitAt(source_.at(names[i].loc)), source_.units.end(),
                                      [&](const Unit& unit) { return source_.textOf(unit) == ","; });
      if (comma != source_.units.end()) replace(*comma, " " + type + ";");
    }
  }

  void bodies(const PouDecl& pou) {
    for (const SfcStep& step : tree_.list(pou.steps))
      for (const SfcAssociation& one : tree_.list(step.actions)) qualifier(one);
    if (pou.body_kind == BodyKind::Il && !program_.expects)
      for (const IlInstruction& one : tree_.list(pou.il)) lineForEachPin(one);
  }
  // `Main;` at a step is `Main(N);`.
  void qualifier(const SfcAssociation& one) {
    const auto name = source_.unitAt(source_.at(one.action.loc));
    const size_t next = source_.nextCode(static_cast<size_t>(name - source_.units.begin()));
    if (!one.word && textOf(next) == ";") insert(source_.units[next].begin, "(N)");
  }
  // Annex B.2.1 has a line for each pin of a formal list.
  void lineForEachPin(const IlInstruction& one) {
    if ((one.kind != IlKind::Call && one.kind != IlKind::Function) || (one.flags & kIlFormal) == 0) return;
    auto unit = source_.unitAt(source_.at(one.loc));
    while (unit != source_.units.end() && source_.textOf(*unit) != "(") ++unit;
    int depth = 0;
    for (; unit != source_.units.end(); ++unit) {
      const std::string_view text = source_.textOf(*unit);
      if (text == "(") ++depth;
      if (text == "(" || (text == "," && depth == 1)) breakAfter(*unit);
      if (text == ")") breakBefore(*unit);
      if (text == ")" && --depth == 0) return;
    }
  }
  void breakAfter(const Unit& unit) {
    const size_t next = source_.text().find_first_not_of(" \t\r", unit.end);
    if (next != std::string_view::npos && source_.text()[next] != '\n') insert(unit.end, "\n");
  }
  void breakBefore(const Unit& unit) {
    const size_t last = source_.text().find_last_not_of(" \t\r", unit.begin - 1);
    const char c = last == std::string_view::npos ? '\n' : source_.text()[last];
    if (c != '\n' && c != '(') insert(unit.begin, "\n");
  }

  const Program& program_;
  const Source& source_;
  const Tree& tree_;
  const std::vector<std::pair<size_t, size_t>> networks_;
  std::vector<Edit> edits_;
};

}  // namespace

std::vector<std::pair<size_t, size_t>> networksOf(const Source& source) {
  std::vector<std::pair<size_t, size_t>> networks;
  for (const DeclId id : source.decls) collectNetworks(source, id, networks);
  return networks;
}

bool isInside(const std::vector<std::pair<size_t, size_t>>& ranges, size_t at) {
  return std::any_of(ranges.begin(), ranges.end(),
                     [&](const auto& range) { return range.first <= at && at < range.second; });
}

std::vector<Edit> standardForm(const Program& program, const Source& source) { return Former(program, source).edits(); }

}  // namespace rung::conformance
