// SPDX-License-Identifier: Apache-2.0
// CONFIGURATION, RESOURCE, TASK and program instances.
#include "frontend/parse/diagnostics.h"
#include "frontend/parse/parser.h"

namespace rung::text {

// After an error: the rest of the line.
void Parser::skipLine() {
  const Skipping skipping(*this);
  while (!at(Tok::End) && !atLineStart() && !at(Tok::Semicolon)) advance();
}

// CONFIGURATION name {section | resource | task | program} END_CONFIGURATION
DeclId Parser::parseConfiguration() {
  const Token* open = t_;
  ConfigurationDecl d{declHeader(DeclKind::Configuration), {}, {}};
  advance();
  Ident name;
  if (parseNewName(name)) {
    d.name = name.name;
    d.h.loc = name.loc;
  }
  panic_ = false;
  accept(Tok::Semicolon);
  d.members = membersUntil(Tok::EndConfiguration, open);
  return finish(d);
}

// {member} `end` [";"]
Slice<DeclId> Parser::membersUntil(Tok end, const Token* open) {
  const size_t first = decls_.size();
  parseMembers(end, decls_);
  if (accept(end)) {
    accept(Tok::Semicolon);
  } else {
    missingEnd(spelling(end), open, spelling(open->kind));
  }
  return listFrom(decls_, first);
}

// member = section | resource | task | program
void Parser::parseMembers(Tok end, std::vector<DeclId>& out) {
  for (;;) {
    if (accept(Tok::Semicolon)) continue;
    if (at(end) || at(Tok::End) || at(Tok::EndConfiguration) || at(Tok::EndResource) || at(Tok::Configuration) ||
        at(Tok::Function) || at(Tok::FunctionBlock) || at(Tok::Type))
      return;
    DeclId member;
    if (atSection()) {
      member = parseSection();
    } else if (at(Tok::Resource)) {
      if (!enterDecl(Tok::EndResource)) continue;
      member = parseResource();
      --decl_depth_;
    } else if (at(Tok::Task)) {
      member = parseTask();
    } else if (at(Tok::Program)) {
      member = parseProgramInstance();
    } else {
      static constexpr Tok kKeywords[] = {Tok::Resource, Tok::Task, Tok::Program, Tok::VarGlobal};
      if (at(Tok::Ident) && isName(peek())) {
        if (const Tok meant = nearKeyword(t_, kKeywords); meant != Tok::End) {
          correctSpelling(meant);
          continue;
        }
      }
      slip(diag::NotInConfiguration, t_, {describe(t_)});
      advance();
      skipLine();
      continue;
    }
    out.push_back(member);
    if (panic_) {
      panic_ = false;
      skipLine();
    }
  }
}

// RESOURCE name ON type {member} END_RESOURCE
DeclId Parser::parseResource() {
  const Token* open = t_;
  ResourceDecl d{declHeader(DeclKind::Resource), {}, {}, {}};
  advance();
  Ident name, target;
  if (parseNewName(name)) {
    d.name = name.name;
    d.h.loc = name.loc;
  }
  if (!panic_ && !accept(Tok::On)) {
    if (isName(kind()) && !atLineStart())
      slip(diag::MissingToken, t_, {"ON", describe(t_)});
    else
      missing(diag::MissingToken, {"ON", describe(t_)}), panic_ = true;
  }
  if (!panic_) {
    if (atLineStart())
      missing(diag::MissingNameAfter, {describe(t_ - 1)});
    else if (parseName(target))
      d.target = target.name;
  }
  if (panic_) {
    skipLine();
    panic_ = false;
  }
  d.members = membersUntil(Tok::EndResource, open);
  return finish(d);
}

// TASK name "(" settings ")" ";"
DeclId Parser::parseTask() {
  TaskDecl d{declHeader(DeclKind::Task), {}, {}};
  advance();
  Ident name;
  if (!parseNewName(name)) {
    tree_.lost_names = true;
  } else {
    d.name = name.name;
    d.h.loc = name.loc;
    Loc end;
    if (at(Tok::LeftParen))
      d.settings = parseArguments(end);
    else if (!at(Tok::Semicolon))
      fail(diag::MissingToken, t_, {"(", describe(t_)});
  }
  endStatement();
  return finish(d);
}

// PROGRAM [RETAIN | NON_RETAIN] name [WITH task] ":" type ["(" arguments ")"] ";"
DeclId Parser::parseProgramInstance() {
  ProgramInstanceDecl d{};
  d.h = declHeader(DeclKind::ProgramInstance);
  advance();
  if ((at(Tok::Retain) || at(Tok::NonRetain)) && isName(peek())) {
    (at(Tok::Retain) ? d.qualifiers.retain : d.qualifiers.non_retain) = true;
    advance();
  }
  Ident name;
  if (parseNewName(name)) {
    d.name = name.name;
    d.h.loc = name.loc;
    if (accept(Tok::With)) {
      parseName(d.task);
    } else if (isName(kind()) && peek() == Tok::Colon && !atLineStart()) {
      if (isName(peek(2))) slip(diag::MissingToken, t_, {"WITH", describe(t_)});
      parseName(d.task);
    }
    if (!panic_) expect(Tok::Colon);
    if (!panic_) parseNamePath(d.type);
    Loc end;
    if (!panic_ && at(Tok::LeftParen)) {
      in_program_instance_ = true;
      d.arguments = parseArguments(end);
      in_program_instance_ = false;
      d.block_tasks = tree_.addList<Ident>(block_tasks_);
      block_tasks_.clear();
    }
  }
  endStatement();
  return finish(d);
}

}  // namespace rung::text
