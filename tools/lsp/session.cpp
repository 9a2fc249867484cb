// SPDX-License-Identifier: Apache-2.0
#include "tools/lsp/session.h"

#include "tools/lsp/uri.h"
#include "tools/protocol/framing.h"

namespace rung::lsp {

const ide::View* Session::viewOf(const std::string& path) {
  ide::Project* project = projects.projectOf(path);
  return project == nullptr ? nullptr : projects.update(*project, cancelled);
}

void Session::send(const Json& message) {
  const std::string text = message.toText();
  log_.sent(text);
  if (!gone_ && !protocol::writeMessage(output_, text)) gone_ = true;
}

void Session::notify(const char* method, Json params) {
  send({{"jsonrpc", "2.0"}, {"method", method}, {"params", std::move(params)}});
}

void Session::request(const char* method, Json params) {
  send({{"jsonrpc", "2.0"},
        {"id", "rung-" + std::to_string(next_request_++)},
        {"method", method},
        {"params", std::move(params)}});
}

Json json(Position position) { return {{"line", position.line}, {"character", position.character}}; }

const Positions& Translator::positionsOf(FileId file) {
  const auto known = positions_.find(file.index);
  if (known != positions_.end()) return known->second;
  return positions_.emplace(file.index, Positions(view_.textOf(file), encoding_)).first->second;
}

Json Translator::position(FileId file, uint32_t byte) { return json(positionsOf(file).positionOf(byte)); }

Json Translator::range(const ide::FileRange& range) {
  return {{"start", position(range.file, range.begin)}, {"end", position(range.file, range.end)}};
}

Json Translator::location(const ide::FileRange& at) {
  const std::string path = view_.pathOf(at.file);
  if (path.empty()) return {};
  return {{"uri", uriOf(path)}, {"range", range(at)}};
}

std::optional<Place> placeOf(Session& session, const Json& params) {
  const Json& uri = params["textDocument"]["uri"];
  if (!uri.isText()) return std::nullopt;
  Place place;
  place.path = pathOfUri(uri.text());
  if (place.path.empty()) return place;
  place.view = session.viewOf(place.path);
  if (place.view == nullptr) return place;
  place.file = place.view->fileAt(place.path);
  if (!place.file) place.view = nullptr;
  if (place.view != nullptr && params["position"].isObject())
    place.byte = Positions(place.view->textOf(place.file), session.encoding).byteOf(positionOf(params["position"]));
  return place;
}

}  // namespace rung::lsp
