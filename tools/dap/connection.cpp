// SPDX-License-Identifier: Apache-2.0
#include "tools/dap/connection.h"

#include <unistd.h>

#include <utility>

#include "tools/protocol/framing.h"

namespace rung::dap {

namespace {

constexpr size_t kMostQueued = 1000;

}  // namespace

Connection::Connection(int input, int output) : input_(input), output_(output) {
  if (pipe(stop_) != 0) stop_[0] = stop_[1] = -1;
  thread_ = std::thread([this] { read(); });
}

Connection::~Connection() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_stopped_ = true;
  }
  changed_.notify_all();
  if (stop_[1] >= 0) close(stop_[1]);
  thread_.join();
  if (stop_[0] >= 0) close(stop_[0]);
}

void Connection::put(Received received) {
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait(lock, [this] { return is_stopped_ || queue_.size() < kMostQueued; });
  queue_.push_back(std::move(received));
  if (when_received_) when_received_();
  changed_.notify_all();
}

void Connection::read() {
  protocol::MessageReader reader(input_, stop_[0]);
  for (;;) {
    protocol::MessageReader::Result result = reader.next();
    if (result.kind == protocol::MessageReader::Kind::End) break;
    if (result.kind == protocol::MessageReader::Kind::Broken) {
      put({{}, result.text});
      continue;
    }
    protocol::JsonResult parsed = protocol::parseJson(result.text);
    put({std::move(parsed.value), std::move(parsed.error)});
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  has_ended_ = true;
  if (when_received_) when_received_();
  changed_.notify_all();
}

std::optional<Received> Connection::next() {
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait(lock, [this] { return has_ended_ || !queue_.empty(); });
  if (queue_.empty()) return std::nullopt;
  Received received = std::move(queue_.front());
  queue_.pop_front();
  changed_.notify_all();
  return received;
}

bool Connection::hasNext() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return has_ended_ || !queue_.empty();
}

void Connection::whenReceived(std::function<void()> call) {
  const std::lock_guard<std::mutex> lock(mutex_);
  when_received_ = std::move(call);
}

// From the thread of the program, too: what it prints.
void Connection::send(Json message) {
  const std::lock_guard<std::mutex> lock(sending_);
  message.set("seq", ++sequence_);
  if (!protocol::writeMessage(output_, message.toText())) return;  // the reader notices that the client is gone
}

void Connection::respond(const Json& request, Json body) {
  Json message = {{"type", "response"},
                  {"request_seq", request["seq"].integer()},
                  {"success", true},
                  {"command", request["command"].text()}};
  if (!body.isNull()) message.set("body", std::move(body));
  send(std::move(message));
}

void Connection::refuse(const Json& request, const std::string& why) {
  send({{"type", "response"},
        {"request_seq", request["seq"].integer()},
        {"success", false},
        {"command", request["command"].text()},
        {"message", why},
        {"body", Json{{"error", Json{{"id", 1}, {"format", why}, {"showUser", true}}}}}});
}

void Connection::event(const char* name, Json body) {
  send({{"type", "event"}, {"event", name}, {"body", std::move(body)}});
}

}  // namespace rung::dap
