// SPDX-License-Identifier: Apache-2.0
#include "tools/lsp/inbox.h"

#include <unistd.h>

#include <algorithm>

#include "tools/protocol/framing.h"

namespace rung::lsp {
namespace {

constexpr size_t kMaxQueued = 10'000, kMaxQueuedBytes = size_t{256} << 20, kMaxCancelled = 1000;

// The answer to a request of the server, none of which waits for it.
bool isResponse(const Json& message) {
  const auto has = [&](std::string_view name) {
    return std::any_of(message.members().begin(), message.members().end(),
                       [&](const protocol::JsonMember& member) { return member.name == name; });
  };
  return !has("method") && (has("result") || has("error"));
}

}  // namespace

Inbox::Inbox(int input) {
  if (pipe(stop_) != 0) stop_[0] = stop_[1] = -1;
  thread_ = std::thread([this, input] { read(input); });
}

Inbox::~Inbox() {
  {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
  }
  changed_.notify_all();
  close(stop_[1]);  // the thread sees the end of the pipe
  thread_.join();
  close(stop_[0]);
}

void Inbox::read(int input) {
  using Kind = protocol::MessageReader::Kind;
  protocol::MessageReader reader(input, stop_[0]);
  for (;;) {
    protocol::MessageReader::Result result = reader.next();
    if (result.kind == Kind::End) break;
    if (result.kind == Kind::Broken) {
      put({{}, std::move(result.text)}, 0);
      continue;
    }
    protocol::JsonResult json = protocol::parseJson(result.text);
    if (json.error.empty() && json.value["method"].text() == "$/cancelRequest" && json.value["id"].isNull()) {
      cancel(json.value["params"]["id"]);
    } else if (!isResponse(json.value)) {
      put({std::move(json.value), std::move(json.error)}, result.text.size());
    }
  }
  const std::lock_guard lock(mutex_);
  ended_ = true;
  if (in_background_) interrupted_ = true;
  changed_.notify_all();
}

void Inbox::put(Incoming incoming, size_t bytes) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] {
    return stopped_ || queue_.empty() || (queue_.size() < kMaxQueued && queued_bytes_ + bytes < kMaxQueuedBytes);
  });
  queue_.push_back({std::move(incoming), bytes});
  queued_bytes_ += bytes;
  if (in_background_) interrupted_ = true;
  changed_.notify_all();
}

void Inbox::cancel(const Json& id) {
  if (id.isNull()) return;
  const std::lock_guard lock(mutex_);
  if (running_ == id) {
    interrupted_ = true;
    return;
  }
  if (cancelled_.size() >= kMaxCancelled) cancelled_.pop_front();
  cancelled_.push_back(id);
}

std::optional<Incoming> Inbox::next() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return ended_ || !queue_.empty(); });
  if (queue_.empty()) return std::nullopt;
  Queued first = std::move(queue_.front());
  queue_.pop_front();
  queued_bytes_ -= first.bytes;
  changed_.notify_all();
  return std::move(first.incoming);
}

bool Inbox::isEmpty() const {
  const std::lock_guard lock(mutex_);
  return queue_.empty();
}

const std::atomic<bool>* Inbox::beginRequest(const Json& id) {
  const std::lock_guard lock(mutex_);
  running_ = id;
  const auto cancelled = std::find(cancelled_.begin(), cancelled_.end(), id);
  interrupted_ = cancelled != cancelled_.end();
  if (interrupted_) cancelled_.erase(cancelled);
  return &interrupted_;
}

const std::atomic<bool>* Inbox::beginBackground() {
  const std::lock_guard lock(mutex_);
  in_background_ = true;
  interrupted_ = ended_ || !queue_.empty();
  return &interrupted_;
}

void Inbox::end() {
  const std::lock_guard lock(mutex_);
  running_ = Json();
  in_background_ = false;
}

}  // namespace rung::lsp
