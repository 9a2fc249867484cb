// SPDX-License-Identifier: Apache-2.0
// Which diagnostics the client shows. In: those of each project after each change. Out: a notification for each file
// whose diagnostics are other ones than before, and for each buffer that has changed since, with its version; a file
// that has none any more gets an empty list.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "tools/lsp/session.h"

namespace rung::lsp {

class Publisher {
 public:
  explicit Publisher(Session& session) : session_(session) {}

  // Notes the diagnostics of a project if it has a new view.
  void update(const ide::Project& project);
  // Sends what has changed; projects that are gone have none.
  void publish();

 private:
  using ByFile = std::map<std::string, Json::Array>;
  ByFile diagnosticsOf(const ide::View& view);
  void publish(const std::string& path, Json::Array diagnostics);

  Session& session_;
  struct OfProject {
    const ide::View* view = nullptr;
    uint64_t version = 0;
    ByFile by_file;
  };
  std::map<std::string, OfProject> of_projects_;  // by input
  struct Published {
    std::string text;  // the list
    int64_t version;   // of the buffer
    friend bool operator==(const Published&, const Published&) = default;
  };
  std::map<std::string, Published> published_;  // by path
};

}  // namespace rung::lsp
