// SPDX-License-Identifier: Apache-2.0
// What the methods of the protocol share: the open buffers, the projects, what the client can do, and the way back to
// it. In: parameters of requests. Out: the place that they mean, and ranges as JSON. One for a server.
#pragma once

#include <atomic>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "tools/ide/projects.h"
#include "tools/lsp/documents.h"
#include "tools/lsp/log.h"
#include "tools/lsp/positions.h"

namespace rung::lsp {

using protocol::Json;

// Error codes of JSON-RPC and of the protocol.
enum ErrorCode : int {
  kNoError = 0,
  kParseError = -32700,
  kInvalidRequest = -32600,
  kMethodNotFound = -32601,
  kInvalidParams = -32602,
  kNotInitialized = -32002,
  kRequestFailed = -32803,
  kCancelled = -32800
};

struct Answer {
  Answer(Json value) : result(std::move(value)) {}
  Answer(ErrorCode code, std::string message) : error(code), message(std::move(message)) {}

  Json result;
  ErrorCode error = kNoError;
  std::string message;
};

// Of `initialize`.
struct ClientCapabilities {
  bool progress = false;       // window/workDoneProgress
  bool watches_files = false;  // dynamic registration of workspace/didChangeWatchedFiles
  bool snippets = false;       // in completion items
  bool hierarchical_symbols = false;
  bool location_links = false;  // of definitions
  bool only_line_folding = false;
  bool document_changes = false;   // of workspace edits
  bool renames_files = false;      // in workspace edits
  std::set<std::string> commands;  // of its own, that a lens may name
};

// The semantic tokens that the client has of an open buffer.
struct SentTokens {
  uint64_t id = 0;
  Json::Numbers data;
};

class Session {
 public:
  Session(driver::ProjectOptions options, int output, Log& log)
      : projects(std::move(options)), output_(output), log_(log) {}

  Documents documents;
  ide::Projects projects;
  Encoding encoding = Encoding::Utf16;
  ClientCapabilities client;
  std::map<std::string, SentTokens> sent_tokens;  // by path
  const std::atomic<bool>* cancelled = nullptr;   // of the request that is being answered

  // The current view of the project of a file; null: there is none, or the request was cancelled.
  const ide::View* viewOf(const std::string& path);

  void send(const Json& message);
  void notify(const char* method, Json params);
  void request(const char* method, Json params);
  // The client does not read any more.
  bool isGone() const { return gone_; }

 private:
  int output_;
  Log& log_;
  bool gone_ = false;
  int64_t next_request_ = 1;
};

// Ranges of the files of one view as JSON.
class Translator {
 public:
  Translator(const ide::View& view, Encoding encoding) : view_(view), encoding_(encoding) {}

  const Positions& positionsOf(FileId file);
  Json position(FileId file, uint32_t byte);
  Json range(const ide::FileRange& range);
  // With the URI of the file; null: the range is of no file.
  Json location(const ide::FileRange& range);

 private:
  const ide::View& view_;
  Encoding encoding_;
  std::map<uint32_t, Positions> positions_;  // by file
};

Json json(Position position);

// A file that a request is about, and a byte of it.
struct Place {
  const ide::View* view = nullptr;  // null: no project has the file
  std::string path;
  FileId file;
  uint32_t byte = 0;
};
// Of `textDocument` and `position`. None: they are not what the protocol says.
std::optional<Place> placeOf(Session& session, const Json& params);

}  // namespace rung::lsp
