// SPDX-License-Identifier: Apache-2.0
#include "tools/lsp/semantic_tokens.h"

#include <algorithm>

#include "tools/ide/tokens.h"
#include "tools/lsp/requests.h"

namespace rung::lsp {
namespace {

// By ide::TokenKind, and by the bits of ide::TokenTrait.
constexpr const char* kTypes[] = {"namespace", "type",      "class",    "interface", "struct", "enum",     "enumMember",
                                  "variable",  "parameter", "property", "function",  "method", "property", "keyword",
                                  "comment",   "string",    "number",   "operator",  "macro"};
constexpr const char* kModifiers[] = {"declaration", "readonly", "static", "defaultLibrary", "documentation"};
static_assert(std::size(kTypes) == static_cast<size_t>(ide::TokenKind::Pragma) + 1);

// Each token by its distance from the one before it.
Json::Numbers encoded(const ide::View& view, FileId file, Encoding encoding, uint32_t begin, uint32_t end) {
  Json::Numbers numbers;
  Translator translator(view, encoding);
  const Positions& positions = translator.positionsOf(file);
  const std::string_view text = view.textOf(file);
  Position last;
  for (const ide::Token& token : ide::tokensOf(view, file)) {
    if (token.range.begin < begin || token.range.begin >= end) continue;
    const Position at = positions.positionOf(token.range.begin);
    const uint32_t length = unitsOf(text.substr(token.range.begin, token.range.end - token.range.begin), encoding);
    const uint32_t character = at.line == last.line ? at.character - last.character : at.character;
    for (const uint32_t number :
         {at.line - last.line, character, length, static_cast<uint32_t>(token.kind), uint32_t{token.traits}})
      numbers.push_back(number);
    last = at;
  }
  return numbers;
}

// The edit that makes the one of the other, of whole tokens; none where they are equal.
Json::Array difference(const Json::Numbers& before, const Json::Numbers& after) {
  constexpr size_t kToken = 5;
  const size_t shorter = std::min(before.size(), after.size());
  size_t head = 0, tail = 0;
  while (head + kToken <= shorter &&
         std::equal(before.begin() + head, before.begin() + head + kToken, after.begin() + head))
    head += kToken;
  while (head + tail + kToken <= shorter &&
         std::equal(before.end() - tail - kToken, before.end() - tail, after.end() - tail - kToken))
    tail += kToken;
  if (head == before.size() && head == after.size()) return {};
  Json edit{{"start", static_cast<int64_t>(head)}, {"deleteCount", static_cast<int64_t>(before.size() - head - tail)}};
  edit.set("data", Json::Numbers(after.begin() + head, after.end() - tail));
  return {std::move(edit)};
}

}  // namespace

Json semanticTokensLegend() {
  Json::Array types, modifiers;
  for (const char* type : kTypes) types.emplace_back(type);
  for (const char* modifier : kModifiers) modifiers.emplace_back(modifier);
  return {{"tokenTypes", std::move(types)}, {"tokenModifiers", std::move(modifiers)}};
}

Answer semanticTokensFull(Session& session, const Json& params) {
  const std::optional<Place> place = placeOf(session, params);
  if (!place) return noDocument();
  if (place->view == nullptr) return Json();
  Json::Numbers data = encoded(*place->view, place->file, session.encoding, 0, UINT32_MAX);
  if (session.documents.find(place->path) == nullptr) return Json{{"data", std::move(data)}};
  SentTokens& sent = session.sent_tokens[place->path];
  sent = {sent.id + 1, std::move(data)};
  return Json{{"resultId", std::to_string(sent.id)}, {"data", sent.data}};
}

Answer semanticTokensDelta(Session& session, const Json& params) {
  const std::optional<Place> place = placeOf(session, params);
  if (!place) return noDocument();
  if (place->view == nullptr) return Json();
  const auto known = session.sent_tokens.find(place->path);
  if (known == session.sent_tokens.end() || std::to_string(known->second.id) != params["previousResultId"].text())
    return semanticTokensFull(session, params);
  SentTokens& sent = known->second;
  Json::Numbers data = encoded(*place->view, place->file, session.encoding, 0, UINT32_MAX);
  Json::Array edits = difference(sent.data, data);
  sent = {sent.id + 1, std::move(data)};
  return Json{{"resultId", std::to_string(sent.id)}, {"edits", std::move(edits)}};
}

Answer semanticTokensRange(Session& session, const Json& params) {
  const std::optional<Place> place = placeOf(session, params);
  if (!place) return noDocument();
  if (place->view == nullptr) return Json();
  const Positions positions(place->view->textOf(place->file), session.encoding);
  const uint32_t begin = positions.byteOf(positionOf(params["range"]["start"]));
  const uint32_t end = positions.byteOf(positionOf(params["range"]["end"]));
  return Json{{"data", encoded(*place->view, place->file, session.encoding, begin, end)}};
}

}  // namespace rung::lsp
