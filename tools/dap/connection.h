// SPDX-License-Identifier: Apache-2.0
// The messages of a client of the debug adapter, in order. A thread reads them, so that a program that runs learns that
// somebody wants something. In: a stream. Out: messages; responses and events with their numbers.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "tools/protocol/json.h"

namespace rung::dap {

using protocol::Json;

struct Received {
  Json message;
  std::string error;  // what is wrong with it; empty: nothing
};

class Connection {
 public:
  Connection(int input, int output);
  ~Connection();
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  // Waits for the next message; none: the client is gone.
  std::optional<Received> next();
  bool hasNext() const;
  // Called by the reading thread for each message that comes; null: nothing is called.
  void whenReceived(std::function<void()> call);

  void respond(const Json& request, Json body);
  void refuse(const Json& request, const std::string& why);
  void event(const char* name, Json body);

 private:
  void read();
  void put(Received received);
  void send(Json message);

  const int input_, output_;
  int stop_[2] = {-1, -1};  // a pipe that ends the thread
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Received> queue_;
  std::function<void()> when_received_;
  bool has_ended_ = false, is_stopped_ = false;
  std::mutex sending_;
  int sequence_ = 0;
  std::thread thread_;
};

}  // namespace rung::dap
