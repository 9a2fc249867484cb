// SPDX-License-Identifier: Apache-2.0
// Bodies in textual Sequential Function Chart. IEC 61131-3 ed. 2 annex B.1.6, ed. 3 tables 54 to 61.
//   chart      = {step | transition | macro (sfc_macros.cpp) | ACTION … END_ACTION}
//   step       = (INITIAL_STEP | STEP) name [position] ["(" TMIN ":=" e "," TMAX ":=" e ")"] ":"
//                {association ";"} END_STEP
//   transition = TRANSITION [name] [position] ["(" PRIORITY ":=" n ")"] [FROM steps TO steps] condition END_TRANSITION
//   position   = AT x "," y ["," width "," height]
// A transition with a body, or whose condition several transitions use, becomes a hidden action.
#include "frontend/syntax/sfc.h"
#include "frontend/parse/chart.h"
#include "frontend/parse/diagnostics.h"
#include "frontend/syntax/il.h"

namespace rung::text {
namespace {

struct Qualifier {
  std::string_view word;
  SfcQualifier qualifier;
};
constexpr Qualifier kQualifiers[] = {{"N", SfcQualifier::N},   {"R", SfcQualifier::R},   {"R0", SfcQualifier::R},
                                     {"S", SfcQualifier::S},   {"S0", SfcQualifier::S},  {"L", SfcQualifier::L},
                                     {"D", SfcQualifier::D},   {"P", SfcQualifier::P},   {"P0", SfcQualifier::P0},
                                     {"P1", SfcQualifier::P1}, {"SD", SfcQualifier::SD}, {"DS", SfcQualifier::DS},
                                     {"SL", SfcQualifier::SL}};

}  // namespace

// `INITIAL_STEP a`, `STEP a:`, `TRANSITION FROM`, which cannot begin a statement. STEP is a name elsewhere.
bool ChartParser::atSfc() const {
  if (!isName(kind())) return false;
  if ((t_[1].flags & kLineStart) != 0) return is(t_, "INITIAL_STEP") && (isName(peek()) || peek() == Tok::EndStep);
  if (!isName(peek()) && !nameReserved(t_ + 1) && peek() != Tok::LeftParen) return false;
  if (is(t_, "STEP") || is(t_, "MACRO_STEP"))
    return peek(2) == Tok::Colon || (peek() != Tok::LeftParen && (peek(2) == Tok::LeftParen || is(t_ + 2, "AT")));
  if (is(t_, "INITIAL_STEP")) return peek() != Tok::LeftParen;
  return is(t_, "TRANSITION") && (peek() != Tok::LeftParen || is(t_ + 2, "PRIORITY"));
}

// `TRANSITION name :=` and `TRANSITION name :`, a condition for transitions of this name in all charts of the block.
bool ChartParser::atCondition() const {
  return isName(kind()) && is(t_, "TRANSITION") && isName(peek()) && (peek(2) == Tok::Assign || peek(2) == Tok::Colon);
}

// An ACTION in the chart of an action or method whose END_… is still ahead. Without END_ACTION, which codesys allows,
// it is the next action of the block.
bool ChartParser::atOwnAction() const {
  if (!at(Tok::Action)) return false;
  uint32_t depth = 0;
  for (const Token* t = t_;; ++t) {
    if (t->kind == Tok::End || t->kind == Tok::EndFunctionBlock || t->kind == Tok::EndProgram) return false;
    if (t->kind == Tok::Action || t->kind == Tok::Method || t->kind == Tok::Property) ++depth;
    if (t->kind != Tok::EndAction && t->kind != Tok::EndMethod && t->kind != Tok::EndProperty) continue;
    if (depth == 0) return t->kind == pou_end_;
    --depth;
  }
}

// Members and shared conditions, before the body.
void ChartParser::parseMembersOf(const PouDecl& d, std::vector<DeclId>& members,
                                 std::vector<SfcTransition>& conditions) {
  const bool is_member = d.pou_kind == PouKind::Method || d.pou_kind == PouKind::Action;
  while (is_member ? atOwnAction() : atMember() || atCondition()) {
    if (atCondition())
      parseTransition(conditions, members);
    else
      parseMember(members);
    panic_ = false;
  }
}

// chart = {step | transition | macro | ACTION … END_ACTION}
void ChartParser::parseSfc(PouDecl& d, std::vector<DeclId>& members, std::vector<SfcTransition>& transitions) {
  const Token* first = t_;
  const uint32_t errors = diagnostics_.errorCount();
  const bool is_member = d.pou_kind == PouKind::Method || d.pou_kind == PouKind::Action;
  d.body_begin = here();
  d.body_kind = BodyKind::Sfc;
  if (d.pou_kind == PouKind::Function || d.pou_kind == PouKind::Class) {
    slip(diag::SfcInFunction, t_, {d.pou_kind == PouKind::Function ? "a function" : "a class"});
    d.body_kind = BodyKind::None;
  }
  std::vector<SfcStep> steps;
  std::vector<SfcMacro> macros;
  std::vector<uint32_t> open;  // macros
  for (;;) {
    panic_ = false;
    if (accept(Tok::Semicolon)) continue;
    if (is_member ? atOwnAction() : atMember()) {
      parseMember(members);
    } else if (atSfc() || (isName(kind()) && is(t_, "STEP"))) {
      if (is(t_, "TRANSITION"))
        parseTransition(transitions, members);
      else if (is(t_, "MACRO_STEP"))
        openMacro(macros, open, steps.size());
      else
        parseStep(steps);
    } else if (!open.empty() && atMacroEnd()) {
      advance();
      closeMacro(macros, open, steps);
    } else if (at(Tok::EndStep) || at(Tok::EndTransition) || atMacroEnd()) {
      slip(diag::StrayEnd, t_, {textOf(t_)});
      advance();
    } else if (atBlockEnd()) {
      break;
    } else {
      slip(diag::SfcNotInChart, t_, {describe(t_)});
      const Skipping skipping(*this);
      do advance();
      while (!atSfc() && !atMember() && !atBlockEnd() && !atMacroEnd());
    }
  }
  if (!open.empty()) {
    const std::string line = std::to_string(sources_.location(loc(macros[open.back()].open)).line);
    missing(diag::MissingEnd, {"END_MACRO_STEP", "MACRO_STEP", line});
  } else if (diagnostics_.errorCount() == errors) {
    inlineMacros(macros, steps, transitions);
  }
  if (t_ != first) d.body_end = endOf(t_ - 1);
  if (diagnostics_.errorCount() != errors) lost_ = true;  // checks of the chart need all of it
  if (d.body_kind == BodyKind::None) {
    transitions.clear();
    std::erase_if(members, [&](DeclId member) {  // generated for transitions that were dropped
      return tree_.kind(member) == DeclKind::Pou && tree_.decl(member).begin == tree_.as<PouDecl>(member).body_begin;
    });
    return;
  }
  d.steps = tree_.addList<SfcStep>(steps);
}

// After an error: skips to the END_… of the element, or to the next one.
void ChartParser::syncChart(Tok end) {
  const Token* open = t_;
  panic_ = false;
  const Skipping skipping(*this);
  while (!at(end) && !atSfc() && !atMacroEnd() && !(atMember() && t_ != open) && !at(Tok::EndStep) &&
         !at(Tok::EndTransition) && !at(Tok::End) && kind() != pou_end_)
    advance();
}

// (INITIAL_STEP | STEP) name [position] [times] ":" {association ";"} END_STEP
void ChartParser::parseStep(std::vector<SfcStep>& out) {
  const Token* open = t_;
  SfcStep step{};
  step.initial = is(t_, "INITIAL_STEP");
  advance();
  std::vector<SfcAssociation> actions;
  if (atLineStart()) {
    missing(diag::MissingNameAfter, {describe(t_ - 1)});
    panic_ = true;
  } else if (parseNewName(step.name)) {
    parsePosition(step.position);
    if (at(Tok::LeftParen)) parseStepTimes(step);
    if (!panic_) expect(Tok::Colon);
    while (!panic_ && !at(Tok::EndStep) && !atBlockEnd() && !atSfc() && !atMacroEnd()) {
      const Token* const first = t_;
      if (accept(Tok::Semicolon) || parseAssociation(actions)) continue;
      const Token* const before = t_;
      syncStatement();
      if (t_ == before && !at(Tok::EndStep) && (!atUnfinished() || t_ == first)) advance();
    }
  }
  if (panic_) syncChart(Tok::EndStep);
  if (!accept(Tok::EndStep)) {
    missingEnd("END_STEP", open, textOf(open));
  }
  if (!step.name.name) return;
  step.actions = tree_.addList<SfcAssociation>(actions);
  out.push_back(step);
}

// position = AT x, y [, w, h]
void NetworkParser::parsePosition(SfcPosition& position) {
  if (!is(t_, "AT") || (peek() != Tok::Number && peek() != Tok::Minus)) return;
  advance();
  int32_t* const numbers[] = {&position.x, &position.y, &position.width, &position.height};
  for (int32_t* const number : numbers)
    if (!takeCoordinate(*number) || !accept(Tok::Comma)) break;
  position.placed = true;
}

// "(" TMIN ":=" expression ["," TMAX ":=" expression] ")"
void ChartParser::parseStepTimes(SfcStep& step) {
  advance();
  do {
    const bool least = is(t_, "TMIN");
    if (!least && !is(t_, "TMAX")) {
      fail(diag::WrongKeyword, t_, {textOf(t_), "TMIN` or `TMAX"});
      return;
    }
    advance();
    expect(Tok::Assign);
    (least ? step.min : step.max) = parseSfcExpr();
  } while (!panic_ && accept(Tok::Comma));
  if (!panic_) expect(Tok::RightParen);
}

// expr, with the range that it covers
SfcExpr ChartParser::parseSfcExpr() {
  SfcExpr e{{}, here(), {}};
  e.value = parseExpr();
  e.end = t_ == tokens_.data() ? here() : endOf(t_ - 1);
  return e;
}

// name {"." name}: an action or variable of the chart's block, or of an instance. One name with points.
bool ChartParser::parseActionName(Ident& out) {
  if (!parseName(out)) return false;
  if (!at(Tok::Dot)) return true;
  std::string path(names_.string(out.name));
  while (accept(Tok::Dot)) {
    Ident member;
    if (!parseName(member)) return false;
    path += '.';
    path += names_.string(member.name);
  }
  out.name = names_.intern(path);
  return true;
}

// [{entry} | {active} | {exit}] action ["(" [qualifier ["," time]] {"," indicator} ")"]
bool ChartParser::parseAssociation(std::vector<SfcAssociation>& out) {
  const Token* first = t_;
  SfcAssociation a{};
  a.loc = here();
  const Slice<Pragma> pragmas = takePragmas();
  if (!parseActionName(a.action)) return false;
  bool timed = false;
  std::vector<Ident> indicators;
  if (accept(Tok::LeftParen)) {
    if (atLineStart() && lineEnds()) {
      fail(diag::MissingToken, t_, {")", describe(t_)});
    } else if (isName(kind())) {
      const Qualifier* found = nullptr;
      for (const Qualifier& row : kQualifiers)
        if (is(t_, row.word)) found = &row;
      a.loc = here();
      if (found == nullptr) {
        slip(diag::SfcQualifier, t_, {textOf(t_)});
      } else {
        a.qualifier = found->qualifier;
        a.word = nameOf(t_);
      }
      advance();
      if (takesTime(a.qualifier)) {
        if (accept(Tok::Comma)) {
          a.time = parseSfcExpr();
          timed = true;
        } else {
          diagnostics_.report(diag::SfcTimeMissing, a.loc, {found->word, textOf(first)});
        }
      }
      while (!panic_ && accept(Tok::Comma)) {  // variables that show the effect of the action; ignored
        if (found != nullptr && !timed && !isName(kind())) {
          slip(diag::SfcTimeSurplus, t_, {found->word});
          parseExpr();
          continue;
        }
        Ident indicator;
        if (!parseName(indicator)) return false;
        indicators.push_back(indicator);
      }
    }
    if (!panic_) expect(Tok::RightParen);
  }
  if (pragmaNamed(pragmas, "entry")) a.qualifier = SfcQualifier::Entry;
  if (pragmaNamed(pragmas, "active")) a.qualifier = SfcQualifier::Active;
  if (pragmaNamed(pragmas, "exit")) a.qualifier = SfcQualifier::Exit;
  if (panic_) return false;
  a.indicators = tree_.addList<Ident>(indicators);
  out.push_back(a);
  if (!accept(Tok::Semicolon)) missing(diag::MissingSemicolon, {describe(t_ - 1)});
  return true;
}

// step | "(" step {"," step} ")"
bool ChartParser::parseSteps(Slice<Ident>& out) {
  std::vector<Ident> steps;
  const bool several = accept(Tok::LeftParen);
  do {
    Ident step;
    if (!parseName(step)) return false;
    steps.push_back(step);
  } while (several && accept(Tok::Comma));
  if (several && !accept(Tok::RightParen)) {
    fail(diag::WrongKeyword, t_, {textOf(t_), ")"});
    return false;
  }
  out = tree_.addList<Ident>(steps);
  return true;
}

// TRANSITION [name] [position] ["(" [PRIORITY] ":=" number ")"] [FROM steps TO steps] condition END_TRANSITION
bool ChartParser::parseTransition(std::vector<SfcTransition>& out, std::vector<DeclId>& members) {
  const Token* open = t_;
  SfcTransition t{};
  t.loc = t.begin = here();
  advance();
  if (isName(kind()) && !is(t_, "FROM") && !is(t_, "AT")) {
    Ident name;
    t.loc = here();
    if (parseNewName(name)) t.name = name;
  }
  parsePosition(t.position);
  if (at(Tok::LeftParen)) {
    advance();
    if (is(t_, "PRIORITY")) advance();
    expect(Tok::Assign);
    if (at(Tok::Number)) {
      const ExprId number = parseExpr();
      if (tree_.kind(number) == ExprKind::Literal) t.priority = tree_.as<LiteralExpr>(number).low;
      t.has_priority = true;
      expect(Tok::RightParen);
    } else {
      fail(diag::MissingValue, t_, {describe(t_)});
    }
  }
  if (!panic_ && isName(kind()) && is(t_, "FROM")) {
    advance();
    if (parseSteps(t.from)) {
      if (is(t_, "TO"))
        advance();
      else
        fail(diag::WrongKeyword, t_, {textOf(t_), "TO"});
      if (!panic_) parseSteps(t.to);
    }
  } else if (!panic_ && !at(Tok::Assign) && !at(Tok::Colon) && !at(Tok::Semicolon) && !at(Tok::EndTransition)) {
    fail(diag::WrongKeyword, t_, {textOf(t_), "FROM"});
  }
  if (!panic_) parseCondition(t, members);
  const bool ok = !panic_;
  if (panic_) syncChart(Tok::EndTransition);
  if (!accept(Tok::EndTransition)) {
    missingEnd("END_TRANSITION", open, "TRANSITION");
  }
  t.end = endOf(t_ - 1);
  if (ok) out.push_back(t);
  return ok;
}

// A condition in IL stores the value of the accumulator at each RET, and at the end.
void ChartParser::storeCondition(PouDecl& d, const SfcTransition& t) {
  IlInstruction store{};
  store.kind = IlKind::Store;
  store.word = names_.intern("ST");
  store.loc = t.target.loc;
  const Argument operand{{}, build_.name(t.target.name, t.target.loc), false, false, t.target.loc};
  store.operands = tree_.addList<Argument>({&operand, 1});
  std::vector<IlInstruction> list;
  for (const IlInstruction& i : tree_.list(d.il)) {
    IlInstruction next = i;
    if (i.kind == IlKind::Return) {
      IlInstruction before = store;
      std::swap(before.label, next.label);
      list.push_back(before);
    }
    list.push_back(next);
  }
  if (list.empty() || list.back().kind != IlKind::Return || (list.back().flags & kIlConditional) != 0)
    list.push_back(store);
  d.il = tree_.addList<IlInstruction>(list);
}

// ":=" expression ";" [";"]. False: there is no body, or an error.
bool ChartParser::parseConditionValue(PouDecl& d, SfcTransition& t) {
  t.condition = parseSfcExpr();
  if (panic_) return false;
  if (!accept(Tok::Semicolon)) missing(diag::MissingSemicolon, {describe(t_ - 1)});
  accept(Tok::Semicolon);  // a condition of a drawing may end with its own
  if (!t.from.empty()) return false;
  const StmtId id =
      build_.assign(AssignOp::Assign, build_.name(t.target.name, t.target.loc), t.condition.value, t.condition.begin);
  tree_.stmt(id).end = t.condition.end;
  d.body = tree_.addList<StmtId>({&id, 1});
  d.body_kind = BodyKind::St;
  d.body_begin = t.condition.begin;
  d.body_end = t.condition.end;
  return true;
}

// ":" statements | ":" instructions | ":" networks. False: an error.
bool ChartParser::parseConditionBody(PouDecl& d, const SfcTransition& t, const Token* first) {
  const Tok pou_end = pou_end_;
  parseBody(d);
  pou_end_ = pou_end;
  if (panic_) return false;
  if (d.body_kind == BodyKind::Il) {
    storeCondition(d, t);
  } else if (d.body_kind == BodyKind::St && (!t.name.name || d.body.empty())) {
    slip(diag::SfcNoCondition, first);
    panic_ = true;
    return false;
  }
  return true;
}

// value | body | nothing: the transition or variable of its name
void ChartParser::parseCondition(SfcTransition& t, std::vector<DeclId>& members) {
  const Token* first = t_;
  PouDecl d{};
  d.h = header(DeclKind::Pou, t.loc);
  d.pou_kind = PouKind::Action;
  d.closed = true;
  if (t.name.name) {
    t.target = t.name;
  } else {  // for a body in IL, or of networks
    t.target = {names_.intern("Transition_" + std::to_string(sources_.location(t.loc).line)), t.loc};
  }
  if (accept(Tok::Assign)) {
    if (!parseConditionValue(d, t)) return;
  } else if (accept(Tok::Colon)) {
    if (!parseConditionBody(d, t, first)) return;
  } else {
    accept(Tok::Semicolon);
    if (t.name.name && !t.from.empty()) return;
    diagnostics_.report(diag::SfcNoCondition, t.loc);
    panic_ = true;
    return;
  }
  d.name = names_.intern(std::string(names_.string(t.target.name)) + "_condition");
  d.h.begin = d.body_begin;
  d.h.end = d.body_end;
  t.body = tree_.add<DeclId>(d);
  members.push_back(t.body);
}

// Steps among the statements of a body that began in ST: one error for all of them.
bool ChartParser::chartInSt() {
  if (!atSfc()) return false;
  slip(diag::SfcNotInChart, t_, {describe(t_)});
  skipBody();
  return true;
}

}  // namespace rung::text
