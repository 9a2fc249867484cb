// SPDX-License-Identifier: Apache-2.0
#include "tools/lsp/documents.h"

#include <algorithm>

namespace rung::lsp {

using protocol::Json;

Position positionOf(const Json& json) {
  const auto field = [&](std::string_view name) {
    return static_cast<uint32_t>(std::clamp<int64_t>(json[name].integer(), 0, INT32_MAX));
  };
  return {field("line"), field("character")};
}

const Document* Documents::find(const std::string& path) const {
  const auto found = documents_.find(path);
  return found == documents_.end() ? nullptr : &found->second;
}

std::vector<std::string> Documents::paths() const {
  std::vector<std::string> paths;
  for (const auto& [path, document] : documents_) paths.push_back(path);
  return paths;
}

bool Documents::change(const std::string& path, int64_t version, const Json& changes, Encoding encoding) {
  const auto found = documents_.find(path);
  if (found == documents_.end()) return false;
  Document& document = found->second;
  document.version = version;
  for (const Json& change : changes.items()) {
    if (!change["range"].isObject()) {
      document.text = change["text"].text();
      continue;
    }
    const Positions positions(document.text, encoding);
    const uint32_t begin = positions.byteOf(positionOf(change["range"]["start"]));
    const uint32_t end = std::max(begin, positions.byteOf(positionOf(change["range"]["end"])));
    document.text.replace(begin, end - begin, change["text"].text());
  }
  return true;
}

}  // namespace rung::lsp
