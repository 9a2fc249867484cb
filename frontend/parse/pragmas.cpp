// SPDX-License-Identifier: Apache-2.0
// Pragmas and doc comments of declarations, as the lexer found them before a token.
#include <algorithm>

#include "frontend/parse/cursor.h"

namespace rung::text {

Slice<Pragma> Cursor::takePragmas() {
  if ((t_->flags & kPragma) == 0) return {};
  const auto& all = stream_.pragmas;
  auto it = std::lower_bound(all.begin(), all.end(), t_->offset,
                             [](const PragmaRange& p, uint32_t offset) { return p.token_offset < offset; });
  std::vector<Pragma> list;
  for (; it != all.end() && it->token_offset == t_->offset; ++it) {
    list.push_back(readPragma(*it));
    if (sameIdentifier(names_.string(list.back().name), "mock")) splitList(*it, list);
  }
  return tree_.addList<Pragma>(list);
}

// {mock 'A', 'B'} and {mock A, B} are {mock 'A'} {mock 'B'}.
void Cursor::splitList(const PragmaRange& pragma, std::vector<Pragma>& list) {
  const Pragma whole = list.back();
  std::string_view rest = source_.substr(pragma.begin + 1, pragma.end - pragma.begin - 2);
  const auto isBlank = [](char c) { return static_cast<unsigned char>(c) <= ' '; };
  while (!rest.empty() && isBlank(rest.front())) rest.remove_prefix(1);
  const std::string_view name = names_.string(whole.name);
  if (sameIdentifier(rest.substr(0, name.size()), name)) {
    rest.remove_prefix(name.size());
  } else {  // {attribute 'mock' := 'A', 'B'}
    const size_t sign = rest.find(":=");
    if (sign == std::string_view::npos) return;
    rest.remove_prefix(sign + 2);
  }
  list.pop_back();
  for (bool more = true; more;) {
    const size_t comma = rest.find(',');
    more = comma != std::string_view::npos;
    std::string_view one = rest.substr(0, comma);
    rest.remove_prefix(more ? comma + 1 : rest.size());
    while (!one.empty() && (isBlank(one.front()) || one.front() == ':' || one.front() == '=')) one.remove_prefix(1);
    while (!one.empty() && isBlank(one.back())) one.remove_suffix(1);
    if (one.size() >= 2 && (one.front() == '\'' || one.front() == '"') && one.back() == one.front())
      one = one.substr(1, one.size() - 2);
    list.push_back({whole.name, tree_.addString(one), whole.loc, whole.end});
  }
}

// {name}  {name 'value'}  {name := 'value'}  {name: "value"}  {attribute 'name' := 'value'}; in any other pragma the
// rest after the name is the value, unchanged.
Pragma Cursor::readPragma(const PragmaRange& pragma) {
  std::string_view rest = source_.substr(pragma.begin + 1, pragma.end - pragma.begin - 2);
  const auto skip = [&] {
    while (!rest.empty() && (static_cast<unsigned char>(rest.front()) <= ' ')) rest.remove_prefix(1);
    while (!rest.empty() && (static_cast<unsigned char>(rest.back()) <= ' ')) rest.remove_suffix(1);
  };
  const auto word = [&] {
    size_t n = 0;
    while (n < rest.size() &&
           (rest[n] == '_' || rest[n] == '+' || (rest[n] | 0x20) >= 'a' || (rest[n] >= '0' && rest[n] <= '9')) &&
           static_cast<unsigned char>(rest[n]) < 0x80 && rest[n] != '{' && rest[n] != '|' && rest[n] != '[' &&
           rest[n] != '^')
      ++n;
    const std::string_view w = rest.substr(0, n);
    rest.remove_prefix(n);
    skip();
    return w;
  };
  const auto quoted = [&](std::string_view& out) {
    if (rest.empty() || (rest.front() != '\'' && rest.front() != '"')) return false;
    const size_t close = rest.find(rest.front(), 1);
    if (close == std::string_view::npos) return false;
    out = rest.substr(1, close - 1);
    rest.remove_prefix(close + 1);
    skip();
    return true;
  };
  skip();
  std::string_view name = word(), value;
  if (sameIdentifier(name, "attribute")) {
    if (!quoted(name)) name = word();
  }
  if (rest.substr(0, 2) == ":=") {
    rest.remove_prefix(2);
    skip();
  } else if (rest.substr(0, 1) == ":") {
    rest.remove_prefix(1);
    skip();
  }
  if (!quoted(value)) value = rest;
  return {names_.intern(name), tree_.addString(value), Loc{base_ + pragma.begin}, Loc{base_ + pragma.end}};
}

bool Cursor::pragmaNamed(Slice<Pragma> pragmas, std::string_view name) const {
  for (const Pragma& p : const_cast<const Tree&>(tree_).list(pragmas))
    if (sameIdentifier(names_.string(p.name), name)) return true;
  return false;
}

// The comment that belongs to the token.
static const DocRange* docOf(const std::vector<DocRange>& all, const Token* t) {
  const auto it = std::lower_bound(all.begin(), all.end(), t->offset,
                                   [](const DocRange& d, uint32_t offset) { return d.token_offset < offset; });
  return it != all.end() && it->token_offset == t->offset ? &*it : nullptr;
}

Loc Cursor::takeDoc() {
  if ((t_->flags & kDoc) == 0) return {};
  const DocRange* doc = docOf(stream_.docs, t_);
  return doc != nullptr ? Loc{base_ + doc->begin} : Loc{};
}

Loc Cursor::docAfter(const Token* t) const {
  if ((t->flags & kDocAfter) == 0) return {};
  const DocRange* doc = docOf(stream_.docs_after, t);
  return doc != nullptr ? Loc{base_ + doc->begin} : Loc{};
}

}  // namespace rung::text
