// SPDX-License-Identifier: Apache-2.0
#include "tools/lsp/server.h"

#include <chrono>
#include <csignal>

#include "frontend/source/invariant.h"
#include "tools/driver/commands.h"
#include "tools/lsp/inbox.h"
#include "tools/lsp/lifecycle.h"
#include "tools/lsp/methods.h"
#include "tools/lsp/publisher.h"

namespace rung::lsp {
namespace {

using Clock = std::chrono::steady_clock;

class Server {
 public:
  Server(const driver::ProjectOptions& options, int input, int output, Log& log)
      : log_(log), session_(options, output, log), publisher_(session_), inbox_(input) {}

  int run() {
    while (!is_done_ && !session_.isGone()) {
      if (inbox_.isEmpty()) checkProjects();
      std::optional<Incoming> incoming = inbox_.next();
      if (!incoming) break;
      take(*incoming);
    }
    return state_ == State::Shutdown ? driver::kSuccess : driver::kInputErrors;
  }

 private:
  enum class State : uint8_t { New, Running, Shutdown };

  // ---- messages

  void take(const Incoming& incoming) {
    const Json& message = incoming.message;
    if (!incoming.error.empty()) return fail({}, {kParseError, incoming.error});
    log_.received(message.toText());
    const Json& id = message["id"];
    if (!message["method"].isText()) return fail(id, {kInvalidRequest, "the message has no `method`"});
    if (!id.isNull() && !id.isText() && !id.isInteger())
      return fail({}, {kInvalidRequest, "`id` must be a number or a string"});
    if (id.isNull())
      takeNotification(message["method"].text(), message["params"]);
    else
      takeRequest(id, message["method"].text(), message["params"]);
  }

  void fail(const Json& id, const Answer& answer) {
    session_.send({{"jsonrpc", "2.0"},
                   {"id", id},
                   {"error", Json{{"code", static_cast<int>(answer.error)}, {"message", answer.message}}}});
  }

  void takeRequest(const Json& id, std::string_view method, const Json& params) {
    session_.cancelled = inbox_.beginRequest(id);
    Answer answer = answerTo(method, params);
    if (session_.cancelled->load()) answer = {kCancelled, "the request was cancelled"};
    inbox_.end();
    session_.cancelled = nullptr;
    if (answer.error != kNoError) return fail(id, answer);
    session_.send({{"jsonrpc", "2.0"}, {"id", id}, {"result", std::move(answer.result)}});
  }

  Answer answerTo(std::string_view method, const Json& params) {
    if (method == "initialize") {
      if (state_ != State::New) return {kInvalidRequest, "the server is initialized already"};
      state_ = State::Running;
      return initialize(session_, params);
    }
    if (state_ == State::New) return {kNotInitialized, "the first request must be `initialize`"};
    if (state_ == State::Shutdown) return {kInvalidRequest, "the server has been shut down"};
    if (method == "shutdown") {
      state_ = State::Shutdown;
      return Json();
    }
    if (session_.cancelled->load()) return Json();
    const RequestMethod* const request = findRequest(method);
    if (request == nullptr) return {kMethodNotFound, "unknown method `" + std::string(method) + "`"};
    setPhase(request->name);
    return request->answer(session_, params);
  }

  void takeNotification(std::string_view method, const Json& params) {
    if (method == "exit") is_done_ = true;
    if (state_ != State::Running) return;
    is_stale_ = true;
    if (method == "initialized") return initialized(session_);
    if (const NotificationMethod* const notification = findNotification(method)) notification->take(session_, params);
  }

  // ---- diagnostics

  // Somebody who types without a pause sees them after this time too.
  static constexpr std::chrono::milliseconds kLongestWait{1500};

  void checkProjects() {
    if (state_ != State::Running || !is_stale_) return;
    for (const auto& project : session_.projects.all()) {
      if (!project->isChanged()) continue;
      if (!waiting_) waiting_ = Clock::now();
      const std::atomic<bool>* interrupted = inbox_.beginBackground();
      const bool is_late = Clock::now() - *waiting_ > kLongestWait;
      if (project->view() == nullptr && progress_.empty()) beginProgress(*project);
      const ide::View* const view = session_.projects.update(*project, is_late ? nullptr : interrupted);
      inbox_.end();
      if (view == nullptr) return;
    }
    waiting_.reset();
    is_stale_ = false;
    endProgress();
    for (const auto& project : session_.projects.all()) publisher_.update(*project);
    publisher_.publish();
    for (const std::string& notice : session_.projects.takeNotices())
      session_.notify("window/showMessage", {{"type", 2}, {"message", "rung: " + notice}});
  }

  void beginProgress(const ide::Project& project) {
    if (!session_.client.progress) return;
    progress_ = "rung-check-" + std::to_string(++progress_count_);
    session_.request("window/workDoneProgress/create", {{"token", progress_}});
    session_.notify("$/progress", {{"token", progress_},
                                   {"value", Json{{"kind", "begin"},
                                                  {"title", "Rung"},
                                                  {"message", "checks " + project.input()},
                                                  {"cancellable", false}}}});
  }
  void endProgress() {
    if (!progress_.empty()) session_.notify("$/progress", {{"token", progress_}, {"value", Json{{"kind", "end"}}}});
    progress_.clear();
  }

  Log& log_;
  Session session_;
  Publisher publisher_;
  Inbox inbox_;
  State state_ = State::New;
  bool is_stale_ = false;  // a notification has come since the last diagnostics; before the first the client reads none
  bool is_done_ = false;
  std::optional<Clock::time_point> waiting_;  // since when changes have no diagnostics
  std::string progress_;                      // its token
  uint32_t progress_count_ = 0;
};

}  // namespace

int runServer(const driver::ProjectOptions& options, const std::string& log_path, int input, int output,
              driver::Sink& sink) {
  Log log;
  if (!log_path.empty())
    if (const std::string error = log.open(log_path); !error.empty()) return driver::usageError(sink, error);
  signal(SIGPIPE, SIG_IGN);  // a client that is gone is a write that fails
  return Server(options, input, output, log).run();
}

}  // namespace rung::lsp
