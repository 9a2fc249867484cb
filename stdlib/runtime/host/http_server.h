// SPDX-License-Identifier: Apache-2.0
// A server of HTTP for few clients that are not trusted: one thread, connections without waiting, and limits on their
// number, on what they may send and leave unread, and on time. In: bytes of anybody. Out: requests for a handler, which
// answers at once or later, in the thread of the server. Called by monitor.cpp.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <string>
#include <string_view>
#include <thread>

#include "http.h"

namespace rung::host {

class HttpServer {
 public:
  using Client = uint64_t;  // of a connection; never used again
  // All of it is called in the thread of the server.
  class Handler {
   public:
    virtual ~Handler() = default;
    virtual void onStart() = 0;
    // To be answered by reply() or beginStream(), now or later. The next request of the client waits until then.
    virtual void onRequest(Client client, const HttpRequest& request) = 0;
    virtual void onClosed(Client client) = 0;
    // Between requests. Returns when it wants to be called again; INT64_MAX: when it is woken.
    virtual int64_t onTurn(int64_t now_ns) = 0;
  };

  explicit HttpServer(Handler& handler) : handler_(handler) {}
  ~HttpServer();
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  // Begins to serve; port 0 takes a free one. False: `error` says why not.
  bool start(uint32_t address, uint16_t port, std::string& error);
  uint16_t port() const { return port_; }
  // What has been answered leaves, as far as clients read it within a moment. From any thread, as wake().
  void stop();
  void wake();

  // For the handler. Replies of clients that are gone are dropped.
  void reply(Client client, const HttpReply& reply);
  // Clients that are not trusted make room for others.
  void trust(Client client);
  void beginStream(Client client);
  // False: the client has not yet read what was sent before, and misses this.
  bool sendEvent(Client client, std::string_view event);

 private:
  static constexpr uint32_t kConnections = 128;
  // Draining: the last reply has left, and what the client still sends is dropped, lest it never sees the reply.
  enum class State : uint8_t { Reading, Waiting, Streaming, Closing, Draining };
  struct Connection {
    int fd = -1;
    uint32_t generation = 0;
    State state = State::Reading;
    bool is_trusted = false, keeps_alive = true;
    bool is_due = false;  // the handler has written to it
    HttpReader reader;
    std::string out;
    size_t sent = 0;       // of out
    size_t dropped = 0;    // bytes
    int64_t limit_ns = 0;  // it is cut off then
    int64_t accepted_ns = 0;
    int64_t second_ns = 0;  // of the requests that are counted
    uint32_t requests = 0;  // in that second
    uint32_t events = 0;    // that epoll reports

    size_t unsent() const { return out.size() - sent; }
  };

  void run();
  void turn();
  void serveDue(int64_t now_ns);
  int64_t nextLimit() const;
  void accept(int64_t now_ns);
  Connection* room(int64_t now_ns);
  void listen(bool listens);
  void onEvent(uint32_t index, uint32_t events, int64_t now_ns);
  bool receive(Connection& connection, int64_t now_ns) const;
  void serve(Connection& connection, int64_t now_ns);
  bool takeRequest(Connection& connection, int64_t now_ns);
  bool countRequest(Connection& connection, int64_t now_ns) const;
  bool send(Connection& connection, int64_t now_ns) const;
  bool endReply(Connection& connection, int64_t now_ns) const;
  void watch(Connection& connection) const;
  void closeOverdue(int64_t now_ns);
  size_t unsent() const;
  void close(Connection& connection);
  Client clientOf(const Connection& connection) const;
  Connection* find(Client client);

  Handler& handler_;
  std::array<Connection, kConnections> connections_;
  int listener_ = -1, epoll_ = -1, wake_ = -1;
  bool is_listening_ = true;  // else those that come wait until there is room
  uint16_t port_ = 0;
  std::thread thread_;
  std::atomic<bool> ends_{false}, is_woken_{false};
};

}  // namespace rung::host
