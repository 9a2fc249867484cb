// SPDX-License-Identifier: Apache-2.0
// Between the thread of the monitor's server and those of the run: what clients ask of the program waits here for a
// moment at which the run has time, and the values that they want for the end of a cycle. No side waits for the other.
// Called by monitor.cpp (server) and run.cpp.
#pragma once

#include <poll.h>
#include <atomic>
#include <deque>
#include <functional>
#include <vector>

#include "http_server.h"
#include "monitor_values.h"
#include "priority_mutex.h"

namespace rung::host {

class MonitorGate {
 public:
  using Client = HttpServer::Client;
  static constexpr int64_t kPatienceNs = 2'000'000'000;  // of a client that waits for the run
  // The first part of an answer is made in the run's thread, the second one by the server.
  using Finish = std::function<HttpReply()>;
  using Act = std::function<Finish()>;
  struct Answer {
    Client client;
    Finish finish;
  };

  MonitorGate();
  ~MonitorGate();
  MonitorGate(const MonitorGate&) = delete;
  MonitorGate& operator=(const MonitorGate&) = delete;

  // ---- the server
  void ask(Client client, Act act, int64_t now_ns);
  std::vector<Answer> takeAnswers();
  // Clients whose questions the run has not taken up in time: they get no other answer.
  std::vector<Client> takeOverdue(int64_t now_ns);
  // When that may be the case next; INT64_MAX: nothing waits.
  int64_t nextOverdueNs();
  Sample& sample() { return sample_; }
  // The run has time for it at once, if it waits.
  void wakeRun();

  // ---- the run
  void answer(Client client, Finish finish);
  // Answers some of the questions, as long as `goes_on`; one whose answer is empty gets it later. False: there was
  // none.
  bool answerSome(const std::function<bool()>& goes_on);
  // Waits until something is asked or wanted, a signal arrives, or until that moment.
  void waitUntil(int64_t monotonic_ns);

 private:
  struct Question {
    Client client;
    Act act;
    int64_t asked_ns;
  };
  bool takeQuestion(Question& question);

  PriorityMutex mutex_;
  std::deque<Question> questions_;
  std::atomic<bool> has_questions_{false};  // also there; asked in each cycle
  std::vector<Answer> answers_;
  Sample sample_;
  int wake_ = -1;
};

}  // namespace rung::host
