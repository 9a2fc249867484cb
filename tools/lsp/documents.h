// SPDX-License-Identifier: Apache-2.0
// The buffers that are open in the editor. In: notifications of the client, with the changed ranges. Out: their texts.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "tools/lsp/positions.h"
#include "tools/protocol/json.h"

namespace rung::lsp {

struct Document {
  std::string uri;  // as the client writes it
  std::string text;
  int64_t version = 0;
};

class Documents {
 public:
  // By path; null: it is not open.
  const Document* find(const std::string& path) const;
  std::vector<std::string> paths() const;
  void open(const std::string& path, Document document) { documents_[path] = std::move(document); }
  void close(const std::string& path) { documents_.erase(path); }
  // Applies the content changes of a notification, one after the other. False: it is not open.
  bool change(const std::string& path, int64_t version, const protocol::Json& changes, Encoding encoding);

 private:
  std::map<std::string, Document> documents_;
};

Position positionOf(const protocol::Json& json);

}  // namespace rung::lsp
