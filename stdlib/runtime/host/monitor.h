// SPDX-License-Identifier: Apache-2.0
// The monitor of a run (--monitor): HTTP with JSON and Server-Sent Events by which browsers and tools see the variables
// of the running program, write and force them, and give it commands. docs/monitor.md lists the requests. In: requests
// of anybody who has the token. Out: answers; the program is touched only by the run's own threads, between
// activations.
//
//     Monitor monitor(session, options, obey);
//     monitor.start(error);             // serves in a thread of its own
//     monitor.completeCycle(cycle, ns)  // at the end of each cycle, in its thread
//     monitor.attend();                 // when the run has time: does what clients wait for
//
// Called by run.cpp.
#pragma once

#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "changes.h"
#include "http_server.h"
#include "json.h"
#include "monitor_access.h"
#include "monitor_gate.h"
#include "monitor_log.h"
#include "rung/host.h"
#include "session.h"

namespace rung::host {

// A query parameter that is a number of at most `most`, or not there; false: something else.
bool readNumber(const HttpRequest& request, std::string_view name, uint64_t most, uint64_t& number);

class Monitor : private HttpServer::Handler {
 public:
  enum class State : uint8_t { Running, Stopped, Faulted };
  // In the run's thread.
  using Obey = std::function<Answer(const Command& command)>;
  using Change = std::function<std::optional<Changes::Outcome>(const Command& command)>;

  // The bodies of the version that runs; asked while hold() is not held.
  using Pous = std::function<const std::vector<rung_pou_view>&()>;

  Monitor(Session& session, const RunOptions& options, Obey obey, Change change, Pous pous);
  ~Monitor() override { server_.stop(); }
  bool start(std::string& error);
  std::string url() const { return access_.url(); }
  MonitorLog& log() { return log_; }

  // ---- the run
  // The cycle is complete. Does not wait.
  void completeCycle(int64_t cycle, int64_t time_ns);
  // Where no activation runs, or from the hook `idle` in real time.
  void attend();
  // Does so until that moment, or less.
  void attendUntil(int64_t monotonic_ns);
  void setState(State state) { state_.store(state); }
  // While one holds this, the thread of the server does not look at the program, and another version can take over.
  std::unique_lock<std::mutex> hold() { return std::unique_lock<std::mutex>(program_mutex_); }
  // It has: clients see this one from now on.
  void followChange();
  // Of a change that a client has begun. False: none has.
  bool answerChange(const Changes::Outcome& outcome);
  void noteRollback(const std::string& fault);
  // Clients get the answers that there are, and no more.
  void stop() { server_.stop(); }

 private:
  struct Stream {
    SharedList list;
    int64_t interval_ns, next_ns;
  };
  struct Reader {  // waits for values
    SharedList list;
    int64_t asked_ns;
    bool is_command = false;  // `get`, which is answered by lines
  };
  struct Route {
    const char *method, *path;
    void (Monitor::*serve)(HttpServer::Client, const HttpRequest&);
  };
  static const Route kRoutes[];
  static constexpr size_t kMostLists = 64, kMostStreams = 16;

  void onStart() override;
  void onRequest(HttpServer::Client client, const HttpRequest& request) override;
  void onClosed(HttpServer::Client client) override;
  int64_t onTurn(int64_t now_ns) override;

  void servePage(HttpServer::Client client, const HttpRequest& request);
  void serveInfo(HttpServer::Client client, const HttpRequest& request);
  void serveSymbols(HttpServer::Client client, const HttpRequest& request);
  void serveValues(HttpServer::Client client, const HttpRequest& request);
  void serveWatch(HttpServer::Client client, const HttpRequest& request);
  void serveStream(HttpServer::Client client, const HttpRequest& request);
  void serveWrite(HttpServer::Client client, const HttpRequest& request);
  void serveForce(HttpServer::Client client, const HttpRequest& request);
  void serveUnforce(HttpServer::Client client, const HttpRequest& request);
  void serveForces(HttpServer::Client client, const HttpRequest& request);
  void serveTasks(HttpServer::Client client, const HttpRequest& request);
  void serveFaults(HttpServer::Client client, const HttpRequest& request);
  void serveMessages(HttpServer::Client client, const HttpRequest& request);
  void serveCommand(HttpServer::Client client, const HttpRequest& request);
  void serveChange(HttpServer::Client client, const HttpRequest& request);
  void servePous(HttpServer::Client client, const HttpRequest& request);
  void serveDiagram(HttpServer::Client client, const HttpRequest& request);
  void serveScope(HttpServer::Client client, const HttpRequest& request);
  void serveScopeStart(HttpServer::Client client, const HttpRequest& request);
  void serveScopeStop(HttpServer::Client client, const HttpRequest& request);
  void serveScopeData(HttpServer::Client client, const HttpRequest& request);

  void fail(HttpServer::Client client, int status, std::string_view sentence);
  void ask(HttpServer::Client client, MonitorGate::Act act);
  bool readBody(HttpServer::Client client, const HttpRequest& request, Json& body);
  bool readPaths(HttpServer::Client client, const HttpRequest& request, std::vector<std::string>& paths);
  SharedList makeList(HttpServer::Client client, const std::vector<std::string>& paths);
  SharedList listOf(HttpServer::Client client, const HttpRequest& request);
  bool readAssignments(HttpServer::Client client, const HttpRequest& request, Command& command);
  void askCommand(HttpServer::Client client, Command command);
  HttpReply obey(const Command& command);
  void askChange(HttpServer::Client client, Command command);
  HttpReply changeReply(const Changes::Outcome& outcome) const;
  const char* stateName() const;
  void wantSample(int64_t now_ns);
  void sendSample(int64_t now_ns);
  std::string sampleText(size_t number, const WatchList& list, bool as_lines);

  Session& session_;
  const MonitorOptions& options_;
  const bool is_realtime_;
  const Obey obey_;
  const Pous pous_;
  const Change change_;
  MonitorAccess access_;
  MonitorLog log_;
  MonitorGate gate_;
  HttpServer server_;

  // Of the last complete cycle; written by the run.
  std::atomic<int64_t> cycle_{0}, time_ns_{0};
  std::atomic<State> state_{State::Running};
  std::atomic<bool> was_rolled_back_{false};
  std::atomic<uint32_t> changes_{0};  // another version took over, or went back
  HttpServer::Client changing_ = 0;   // the client whose change is being compiled
  bool is_changing_ = false;
  std::mutex program_mutex_;

  // In the thread of the server.
  std::map<uint64_t, SharedList> lists_;  // by number, of `watch`
  uint64_t next_list_ = 1;
  std::map<HttpServer::Client, Stream> streams_;
  std::map<HttpServer::Client, Reader> readers_;
  std::vector<HttpServer::Client> sampled_;  // clients of the lists in the sample
};

}  // namespace rung::host
