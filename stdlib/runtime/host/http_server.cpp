// SPDX-License-Identifier: Apache-2.0
// A server of HTTP: see http_server.h.
#include "http_server.h"

#include <poll.h>
#include <pthread.h>
#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>

#include "clock.h"
#include "sockets.h"

namespace rung::host {
namespace {

constexpr int64_t kOneSecondNs = 1'000'000'000, kOneMillisecondNs = 1'000'000;
constexpr int64_t kRequestNs = 10 * kOneSecondNs;  // for a request to arrive whole, and for a client to read something
constexpr int64_t kSilenceNs = 60 * kOneSecondNs;  // between two requests
constexpr int64_t kChanceNs = 100 * kOneMillisecondNs;  // to show the token, when others wait
constexpr int64_t kFarewellNs = 200 * kOneMillisecondNs;
constexpr uint32_t kRequestsPerSecond = 2000;             // of a connection
constexpr size_t kMostUnsent = size_t{64} << 20;          // of all connections together
constexpr size_t kMostUnsentOfStream = size_t{64} << 10;  // before it misses events
constexpr size_t kMostDropped = size_t{4} << 20;          // of what a client sends in vain
constexpr size_t kBytesPerTurn = size_t{16} << 10;
constexpr int kAcceptsPerTurn = 16, kMostEvents = 32;
constexpr uint64_t kListener = ~uint64_t{0}, kWake = kListener - 1;

void addToEpoll(int epoll, int fd, uint64_t what) {
  epoll_event event{EPOLLIN, {}};
  event.data.u64 = what;
  epoll_ctl(epoll, EPOLL_CTL_ADD, fd, &event);
}

}  // namespace

// ---- the thread

HttpServer::~HttpServer() {
  stop();
  for (const int fd : {listener_, epoll_, wake_})
    if (fd >= 0) ::close(fd);
}

bool HttpServer::start(uint32_t address, uint16_t port, std::string& error) {
  int32_t ignored = 0;
  listener_ = openTcpServer(address, port, ignored);
  if (listener_ < 0) return error = strerror(errno), false;
  sockaddr_in own{};
  socklen_t size = sizeof own;
  getsockname(listener_, reinterpret_cast<sockaddr*>(&own), &size);
  port_ = ntohs(own.sin_port);
  epoll_ = epoll_create1(EPOLL_CLOEXEC);
  wake_ = eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
  if (epoll_ < 0 || wake_ < 0) return error = strerror(errno), false;
  addToEpoll(epoll_, listener_, kListener);
  addToEpoll(epoll_, wake_, kWake);
  sigset_t all, before;  // signals are for the threads of the run
  sigfillset(&all);
  pthread_sigmask(SIG_BLOCK, &all, &before);
  thread_ = std::thread([this] { run(); });
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  return true;
}

void HttpServer::stop() {
  if (!thread_.joinable()) return;
  ends_.store(true);
  is_woken_.store(false);
  wake();
  thread_.join();
}

void HttpServer::wake() {
  const uint64_t once = 1;
  if (!is_woken_.exchange(true)) (void)!::write(wake_, &once, sizeof once);
}

void HttpServer::run() {
  handler_.onStart();
  while (!ends_.load()) turn();
  const int64_t end = monotonicNs() + kFarewellNs;
  do turn();  // what has been answered meanwhile
  while (unsent() > 0 && monotonicNs() < end);
  for (Connection& connection : connections_) close(connection);
}

int64_t HttpServer::nextLimit() const {
  int64_t next = INT64_MAX;
  for (const Connection& connection : connections_)
    if (connection.fd >= 0) next = std::min(next, connection.limit_ns);
  if (is_listening_) return next;
  for (const Connection& connection : connections_)
    if (!connection.is_trusted) next = std::min(next, connection.accepted_ns + kChanceNs);
  return next;
}

void HttpServer::turn() {
  constexpr int64_t kLongestWaitNs = kOneSecondNs, kLastWaitNs = 10 * kOneMillisecondNs;
  const int64_t wanted = handler_.onTurn(monotonicNs());
  const int64_t now = monotonicNs();
  serveDue(now);
  const int64_t most = ends_.load() ? kLastWaitNs : kLongestWaitNs;
  const int64_t wait = std::clamp<int64_t>(std::min(wanted, nextLimit()) - now, 0, most);
  epoll_event events[kMostEvents];
  const int64_t wait_ms = (wait + kOneMillisecondNs - 1) / kOneMillisecondNs;
  const int count = epoll_wait(epoll_, events, kMostEvents, static_cast<int>(wait_ms));
  const int64_t then = monotonicNs();
  for (int i = 0; i < count; ++i) {
    const uint64_t what = events[i].data.u64;
    if (what == kListener) {
      accept(then);
    } else if (what == kWake) {
      uint64_t times = 0;
      (void)!::read(wake_, &times, sizeof times);
      is_woken_.store(false);
    } else {
      onEvent(static_cast<uint32_t>(what), events[i].events, then);
    }
  }
  closeOverdue(then);
  if (!is_listening_) accept(then);
}

void HttpServer::serveDue(int64_t now_ns) {
  for (Connection& connection : connections_) {
    if (!connection.is_due) continue;
    connection.is_due = false;
    serve(connection, now_ns);
  }
}

// ---- connections

HttpServer::Client HttpServer::clientOf(const Connection& connection) const {
  const auto index = static_cast<uint64_t>(&connection - connections_.data());
  return uint64_t{connection.generation} << 8 | index;
}

HttpServer::Connection* HttpServer::find(Client client) {
  Connection& connection = connections_[client % kConnections];
  return connection.fd >= 0 && clientOf(connection) == client ? &connection : nullptr;
}

void HttpServer::close(Connection& connection) {
  if (connection.fd < 0) return;
  ::close(connection.fd);
  const Client client = clientOf(connection);
  const uint32_t generation = connection.generation;
  connection = Connection();
  connection.generation = generation + 1;
  handler_.onClosed(client);
}

// When all are in use, the oldest one that has not shown the token in time goes. Null: none.
HttpServer::Connection* HttpServer::room(int64_t now_ns) {
  Connection* oldest = nullptr;
  for (Connection& connection : connections_) {
    if (connection.fd < 0) return &connection;
    if (connection.is_trusted || now_ns - connection.accepted_ns < kChanceNs) continue;
    if (oldest == nullptr || connection.accepted_ns < oldest->accepted_ns) oldest = &connection;
  }
  if (oldest != nullptr) close(*oldest);
  return oldest;
}

void HttpServer::accept(int64_t now_ns) {
  for (int i = 0; i < kAcceptsPerTurn; ++i) {
    pollfd waiting{listener_, POLLIN, 0};
    if (poll(&waiting, 1, 0) <= 0) return listen(true);
    Connection* const connection = room(now_ns);
    if (connection == nullptr) return listen(false);
    int32_t error = 0;
    const int fd = acceptClient(listener_, error);
    if (fd < 0) return;
    connection->fd = fd;
    connection->accepted_ns = now_ns;
    connection->limit_ns = now_ns + kRequestNs;
    connection->events = EPOLLIN;
    addToEpoll(epoll_, fd, static_cast<uint64_t>(connection - connections_.data()));
  }
}

void HttpServer::listen(bool listens) {
  if (listens == is_listening_) return;
  is_listening_ = listens;
  epoll_event event{listens ? uint32_t{EPOLLIN} : 0, {}};
  event.data.u64 = kListener;
  epoll_ctl(epoll_, EPOLL_CTL_MOD, listener_, &event);
}

// A client that does not read its replies is not read either, so what is kept for it has a bound.
void HttpServer::watch(Connection& connection) const {
  uint32_t events = connection.unsent() > 0 ? uint32_t{EPOLLOUT} : 0;
  if (connection.state == State::Streaming || connection.state == State::Draining ||
      (connection.state == State::Reading && events == 0))
    events |= EPOLLIN;
  if (events == connection.events) return;
  connection.events = events;
  epoll_event event{events, {}};
  event.data.u64 = static_cast<uint64_t>(&connection - connections_.data());
  epoll_ctl(epoll_, EPOLL_CTL_MOD, connection.fd, &event);
}

void HttpServer::closeOverdue(int64_t now_ns) {
  for (Connection& connection : connections_)
    if (connection.fd >= 0 && now_ns >= connection.limit_ns) close(connection);
  const auto hasLess = [](const Connection& a, const Connection& b) { return a.unsent() < b.unsent(); };
  while (unsent() > kMostUnsent) close(*std::max_element(connections_.begin(), connections_.end(), hasLess));
}

size_t HttpServer::unsent() const {
  size_t total = 0;
  for (const Connection& connection : connections_) total += connection.unsent();
  return total;
}

// ---- what a connection does

void HttpServer::onEvent(uint32_t index, uint32_t events, int64_t now_ns) {
  Connection& connection = connections_[index];
  if (connection.fd < 0) return;
  const bool is_gone = (events & (EPOLLHUP | EPOLLERR)) != 0;
  if (is_gone || ((events & EPOLLIN) != 0 && !receive(connection, now_ns))) return close(connection);
  serve(connection, now_ns);
}

// False: the client is gone, or has sent more than anybody needs to.
bool HttpServer::receive(Connection& connection, int64_t now_ns) const {
  char bytes[kBytesPerTurn];
  const ssize_t count = recv(connection.fd, bytes, sizeof bytes, MSG_DONTWAIT);
  if (count < 0) return errno == EAGAIN || errno == EINTR;
  if (count == 0) return false;
  if (connection.state != State::Reading) {
    connection.dropped += static_cast<size_t>(count);
    return connection.dropped <= kMostDropped;
  }
  if (connection.reader.isEmpty()) connection.limit_ns = now_ns + kRequestNs;
  connection.reader.add(bytes, static_cast<size_t>(count));
  return true;
}

// Goes on as far as it can: sends what is there, and takes the next request when the reply has left.
void HttpServer::serve(Connection& connection, int64_t now_ns) {
  while (connection.fd >= 0) {
    if (!send(connection, now_ns)) return close(connection);
    if (connection.unsent() > 0) break;
    if (connection.state == State::Closing && !endReply(connection, now_ns)) return close(connection);
    if (connection.state != State::Reading || !takeRequest(connection, now_ns)) break;
  }
  if (connection.fd >= 0) watch(connection);
}

// False: there is none yet.
bool HttpServer::takeRequest(Connection& connection, int64_t now_ns) {
  HttpRequest request;
  HttpReply refusal;
  switch (connection.reader.next(request, refusal)) {
    case HttpReader::State::Incomplete: return false;
    case HttpReader::State::Broken: break;
    case HttpReader::State::Complete:
      if (!countRequest(connection, now_ns)) {
        refusal = httpError(400, "more than 2000 requests in a second");
        break;
      }
      connection.state = State::Waiting;
      connection.keeps_alive = request.keeps_alive;
      connection.limit_ns = INT64_MAX;  // the handler answers in time
      handler_.onRequest(clientOf(connection), request);
      return true;
  }
  connection.out = httpText(refusal, false);
  connection.state = State::Closing;
  return true;
}

// False: it is a flood.
bool HttpServer::countRequest(Connection& connection, int64_t now_ns) const {
  if (now_ns - connection.second_ns >= kOneSecondNs) {
    connection.second_ns = now_ns;
    connection.requests = 0;
  }
  return ++connection.requests <= kRequestsPerSecond;
}

// Sends what the client takes now. False: it is gone.
bool HttpServer::send(Connection& connection, int64_t now_ns) const {
  while (connection.unsent() > 0) {
    const ssize_t count = ::send(connection.fd, connection.out.data() + connection.sent, connection.unsent(),
                                 MSG_NOSIGNAL | MSG_DONTWAIT);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return errno == EAGAIN;
    connection.sent += static_cast<size_t>(count);
    connection.limit_ns = now_ns + kRequestNs;
  }
  if (connection.sent == 0) return true;
  connection.out.clear();
  connection.sent = 0;
  if (connection.state == State::Reading) connection.limit_ns = now_ns + kSilenceNs;
  if (connection.state == State::Streaming) connection.limit_ns = INT64_MAX;
  return true;
}

// A connection that is closed while bytes arrive is reset, and the client may lose the reply.
bool HttpServer::endReply(Connection& connection, int64_t now_ns) const {
  if (shutdown(connection.fd, SHUT_WR) != 0) return false;
  connection.state = State::Draining;
  connection.limit_ns = now_ns + kOneSecondNs;
  return true;
}

// ---- for the handler

void HttpServer::reply(Client client, const HttpReply& reply) {
  Connection* const connection = find(client);
  if (connection == nullptr) return;
  const bool is_kept = connection->keeps_alive && !reply.closes;
  connection->out += httpText(reply, is_kept);
  connection->state = is_kept ? State::Reading : State::Closing;
  connection->limit_ns = monotonicNs() + kRequestNs;
  connection->is_due = true;
}

void HttpServer::trust(Client client) {
  if (Connection* const connection = find(client)) connection->is_trusted = true;
}

void HttpServer::beginStream(Client client) {
  Connection* const connection = find(client);
  if (connection == nullptr) return;
  connection->out += httpStreamHead();
  connection->state = State::Streaming;
  connection->limit_ns = monotonicNs() + kRequestNs;
  connection->is_due = true;
}

bool HttpServer::sendEvent(Client client, std::string_view event) {
  Connection* const connection = find(client);
  if (connection == nullptr || connection->unsent() > kMostUnsentOfStream) return false;
  if (connection->unsent() == 0) connection->limit_ns = monotonicNs() + kRequestNs;
  connection->out += event;
  connection->is_due = true;
  return true;
}

}  // namespace rung::host
