// SPDX-License-Identifier: Apache-2.0
// The messages of the client, in order. A thread reads them, so that the server learns while it works that a request
// was cancelled or that its work is out of date. In: a stream. Out: messages, one at a time. The thread waits while too
// many are queued.
#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "tools/protocol/json.h"

namespace rung::lsp {

using protocol::Json;

struct Incoming {
  Json message;
  std::string error;  // what is wrong with the message or its header; empty: nothing
};

class Inbox {
 public:
  explicit Inbox(int input);
  ~Inbox();
  Inbox(const Inbox&) = delete;
  Inbox& operator=(const Inbox&) = delete;

  // Waits for the next message; none: the client is gone.
  std::optional<Incoming> next();
  bool isEmpty() const;

  // What the server begins now. The result becomes true when the request is cancelled.
  const std::atomic<bool>* beginRequest(const Json& id);
  // The result becomes true when the client sends anything.
  const std::atomic<bool>* beginBackground();
  void end();

 private:
  void read(int input);
  void put(Incoming incoming, size_t bytes);
  void cancel(const Json& id);

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  struct Queued {
    Incoming incoming;
    size_t bytes;
  };
  std::deque<Queued> queue_;
  size_t queued_bytes_ = 0;
  bool ended_ = false, stopped_ = false;
  std::deque<Json> cancelled_;  // ids of requests that may still be in the queue
  Json running_;                // the id of the request that is being answered
  bool in_background_ = false;
  std::atomic<bool> interrupted_ = false;
  int stop_[2] = {-1, -1};  // a pipe that ends the thread
  std::thread thread_;
};

}  // namespace rung::lsp
