// SPDX-License-Identifier: Apache-2.0
// The monitor of a run: see monitor.h. Here are its turns and streams; the requests are in monitor_requests.cpp.
#include "monitor.h"

#include <algorithm>

#include "clock.h"
#include "trace.h"

namespace rung::host {
namespace {

constexpr int64_t kLongCycleNs = 20'000'000;  // values are not left to the end of a longer one

}  // namespace

Monitor::Monitor(Session& session, const RunOptions& options, Obey obey, Change change, Pous pous)
    : session_(session),
      options_(options.monitor),
      is_realtime_(options.realtime),
      obey_(std::move(obey)),
      pous_(std::move(pous)),
      change_(std::move(change)),
      server_(*this) {}

bool Monitor::start(std::string& error) {
  MonitorAddress address;
  if (error = readMonitorAddress(options_.address, address); !error.empty()) return false;
  if (!server_.start(address.address, address.port, error))
    return error.insert(0, "--monitor: cannot listen at `" + options_.address + "`: "), false;
  address.port = server_.port();
  if (!access_.prepare(address)) return error = "--monitor: the system has no random numbers", false;
  return true;
}

// ---- the run

void Monitor::completeCycle(int64_t cycle, int64_t time_ns) {
  cycle_.store(cycle, std::memory_order_relaxed);
  time_ns_.store(time_ns, std::memory_order_relaxed);
  if (gate_.sample().isWanted() && gate_.sample().take(cycle, time_ns)) server_.wake();
}

// A single cycle runs before the next question is taken up.
void Monitor::attend() {
  bool has_news = gate_.answerSome([this] { return !session_.isSingleCycle(); });
  if (state_.load() != State::Faulted) state_.store(session_.isStopped() ? State::Stopped : State::Running);
  Sample& sample = gate_.sample();
  const auto isLeft = [&] {
    return !is_realtime_ || state_.load() == State::Faulted || monotonicNs() - sample.wantedSince() >= kLongCycleNs;
  };
  if (sample.isWanted() && isLeft())
    session_.between([&] { has_news = sample.take(cycle_.load(), time_ns_.load()) || has_news; });
  if (has_news) server_.wake();
}

void Monitor::attendUntil(int64_t monotonic_ns) {
  gate_.waitUntil(monotonic_ns);
  attend();
}

// Whoever waits for values gets those of this version.
void Monitor::followChange() {
  gate_.sample().cancel();
  sampled_.clear();
  const auto move = [this](SharedList& list) { list = std::make_shared<WatchList>(list->movedTo(session_.symbols())); };
  for (auto& [number, list] : lists_) move(list);
  for (auto& [client, stream] : streams_) move(stream.list);
  for (auto& [client, reader] : readers_) move(reader.list);
  was_rolled_back_.store(false);
  changes_.fetch_add(1);
  server_.wake();
}

bool Monitor::answerChange(const Changes::Outcome& outcome) {
  if (!std::exchange(is_changing_, false)) return false;
  gate_.answer(changing_, [reply = changeReply(outcome)] { return reply; });
  server_.wake();
  return true;
}

void Monitor::noteRollback(const std::string& fault) {
  was_rolled_back_.store(true);
  log_.addFault(session_.nowNs(), cycle_.load(), fault);
  log_.addMessage(session_.nowNs(), "error", "the change was rolled back: " + fault);
}

// ---- the thread of the server

void Monitor::onStart() { yieldToTasks(std::max(session_.module().resources.size(), 1u)); }

void Monitor::onClosed(HttpServer::Client client) {
  const std::lock_guard<std::mutex> held(program_mutex_);
  streams_.erase(client);
  readers_.erase(client);
}

int64_t Monitor::onTurn(int64_t now_ns) {
  const std::lock_guard<std::mutex> held(program_mutex_);
  for (const MonitorGate::Answer& answer : gate_.takeAnswers()) server_.reply(answer.client, answer.finish());
  for (const HttpServer::Client client : gate_.takeOverdue(now_ns))
    fail(client, 409, "the program did not end its cycle within 2 s");
  Sample& sample = gate_.sample();
  if (sample.isTaken()) sendSample(now_ns);
  for (auto reader = readers_.begin(); reader != readers_.end();) {
    const auto next = std::next(reader);
    if (now_ns - reader->second.asked_ns >= MonitorGate::kPatienceNs) {
      fail(reader->first, 409, "the program did not end its cycle within 2 s");
      readers_.erase(reader);
    }
    reader = next;
  }
  if (sample.isIdle()) wantSample(now_ns);
  int64_t next_ns = gate_.nextOverdueNs();
  for (const auto& [client, reader] : readers_) next_ns = std::min(next_ns, reader.asked_ns + MonitorGate::kPatienceNs);
  if (sample.isIdle())
    for (const auto& [client, stream] : streams_) next_ns = std::min(next_ns, stream.next_ns);
  return next_ns;
}

void Monitor::wantSample(int64_t now_ns) {
  std::vector<SharedList> lists;
  sampled_.clear();
  const auto add = [&](HttpServer::Client client, const SharedList& list) {
    sampled_.push_back(client);
    lists.push_back(list);
  };
  for (const auto& [client, reader] : readers_) add(client, reader.list);
  for (const auto& [client, stream] : streams_)
    if (stream.next_ns <= now_ns) add(client, stream.list);
  if (lists.empty()) return;
  gate_.sample().want(std::move(lists), now_ns);
  if (!is_realtime_) gate_.wakeRun();
}

std::string Monitor::sampleText(size_t number, const WatchList& list, bool as_lines) {
  const Sample& sample = gate_.sample();
  std::string json = "{\"cycle\":" + std::to_string(sample.cycle());
  json += ",\"time_ms\":" + millisecondsOf(sample.timeNs());
  if (as_lines) {
    std::string lines;
    list.appendLines(session_.module(), sample.values(number), lines);
    appendJsonText(json += ",\"text\":", lines);
    return json += '}';
  }
  list.append(session_.module(), sample.values(number), json += ",\"values\":{");
  return json += "}}";
}

// Clients that have gone meanwhile are neither readers nor streams any more.
void Monitor::sendSample(int64_t now_ns) {
  for (size_t i = 0; i < sampled_.size(); ++i) {
    if (const auto reader = readers_.find(sampled_[i]); reader != readers_.end()) {
      HttpReply reply;
      reply.body = sampleText(i, *reader->second.list, reader->second.is_command);
      server_.reply(sampled_[i], reply);
      readers_.erase(reader);
    } else if (const auto stream = streams_.find(sampled_[i]); stream != streams_.end()) {
      Stream& due = stream->second;
      server_.sendEvent(sampled_[i], "data: " + sampleText(i, *due.list, false) + "\n\n");
      due.next_ns = std::max(due.next_ns + due.interval_ns, now_ns - due.interval_ns);
    }
  }
  gate_.sample().release();
}

}  // namespace rung::host
