// SPDX-License-Identifier: Apache-2.0
// Modbus servers: see modbus_server.h.
#include "modbus_server.h"

#include <sys/epoll.h>
#include <sys/socket.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <cstring>

#include "sockets.h"

namespace rung::host {
namespace {

constexpr int64_t kLeastSilenceNs = 1'750'000;  // above 19200 bit/s
constexpr int64_t kDiscardNs = 50'000'000;      // parts of a frame that arrive later do not belong to it
constexpr uint32_t kFastRate = 19200;
constexpr int kAcceptsPerEvent = 64, kReadsPerTurn = 8;

}  // namespace

// ---- a serial line

void RtuLine::open(const rung_channel_settings& settings) {
  silence_ns_ = settings.rate > kFastRate ? kLeastSilenceNs : lineNs(settings, 7) / 2;
  size_ = 0;
  is_too_long_ = is_looked_at_ = false;
}

void RtuLine::receive(const uint8_t* bytes, size_t count, int64_t now_ns) {
  if (size_ > 0 && now_ns - last_ns_ >= std::max(kDiscardNs, silence_ns_)) size_ = 0;
  const size_t taken = std::min(count, sizeof bytes_ - size_);
  std::copy_n(bytes, taken, bytes_ + size_);  // nothing may be taken from a null pointer
  size_ += static_cast<uint32_t>(taken);
  is_too_long_ = is_too_long_ || taken < count;
  is_looked_at_ = false;
  last_ns_ = now_ns;
}

int64_t RtuLine::dueNs() const {
  if (size_ == 0) return INT64_MAX;
  return last_ns_ + (is_looked_at_ ? std::max(kDiscardNs, silence_ns_) : silence_ns_);
}

uint32_t RtuLine::answer(ServedImage& image, const ServedImage::Server& server, int64_t now_ns, uint8_t* reply) {
  if (now_ns < dueNs()) return 0;
  const int32_t frame = is_too_long_ ? -1 : rung_modbus_rtu_request(bytes_, size_);
  if (frame == 0 && !is_looked_at_) {  // the system may deliver a frame in parts
    is_looked_at_ = true;
    return 0;
  }
  const uint32_t size = size_;
  size_ = 0;
  is_too_long_ = is_looked_at_ = false;
  if (frame <= 0 || static_cast<uint32_t>(frame) != size) return 0;
  return image.answerRtu(server, bytes_, size, reply);
}

// ---- a TCP master

bool TcpMaster::receive(ServedImage& image, const ServedImage::Server& server, uint32_t count) {
  in_size_ += count;
  has_more_ = false;
  uint32_t at = 0;
  int32_t frame = 0;
  while ((frame = rung_modbus_tcp_frame(in_ + at, in_size_ - at)) > 0) {
    has_more_ = out_size_ + RUNG_MODBUS_MAX_TCP > kReplyBytes;
    if (has_more_) break;
    out_size_ += image.answerTcp(server, in_ + at, out_ + out_size_);
    at += static_cast<uint32_t>(frame);
  }
  memmove(in_, in_ + at, in_size_ - at);
  in_size_ -= at;
  return frame >= 0;
}

void TcpMaster::sent(uint32_t count) {
  memmove(out_, out_ + count, out_size_ - count);
  out_size_ -= count;
}

// ---- all of them

TcpMasters::TcpMasters(int epoll, ServedImage& image) : epoll_(epoll), image_(image) { connections_.reserve(kMost); }

TcpMasters::~TcpMasters() {
  for (const std::unique_ptr<Connection>& connection : connections_) close(*connection);
}

TcpMasters::Connection* TcpMasters::free() {
  for (const std::unique_ptr<Connection>& connection : connections_)
    if (connection->fd < 0) return connection.get();
  if (connections_.size() < kMost) {
    connections_.push_back(std::make_unique<Connection>());
    return connections_.back().get();
  }
  return closeOldest();
}

TcpMasters::Connection* TcpMasters::closeOldest() {
  Connection* oldest = nullptr;
  for (const std::unique_ptr<Connection>& connection : connections_)
    if (connection->fd >= 0 && (oldest == nullptr || connection->last_ns < oldest->last_ns)) oldest = connection.get();
  if (oldest != nullptr) close(*oldest);
  return oldest;
}

void TcpMasters::close(Connection& connection) const {
  if (connection.fd >= 0) ::close(connection.fd);
  connection.fd = -1;
}

void TcpMasters::accept(int listener, const ServedImage::Server& server, int64_t now_ns) {
  for (int i = 0; i < kAcceptsPerEvent; ++i) {
    int32_t error = 0;
    const int fd = acceptClient(listener, error);
    if (fd < 0 && error == RUNG_CHANNEL_LIMIT) closeOldest();  // else it would wait for ever
    if (fd < 0) return;
    Connection* const connection = free();
    connection->fd = fd;
    connection->last_ns = now_ns;
    connection->server = &server;
    connection->waits_to_send = false;
    connection->master.clear();
    const auto index = static_cast<uint64_t>(std::find_if(connections_.begin(), connections_.end(),
                                                          [&](const auto& each) { return each.get() == connection; }) -
                                             connections_.begin());
    epoll_event event{EPOLLIN, {}};
    event.data.u64 = kEvents | index;
    epoll_ctl(epoll_, EPOLL_CTL_ADD, fd, &event);
  }
}

// A master that does not read its replies is not read either, so what is kept for it has a bound.
void TcpMasters::watch(Connection& connection, bool waits_to_send) {
  if (connection.waits_to_send == waits_to_send) return;
  connection.waits_to_send = waits_to_send;
  for (size_t i = 0; i < connections_.size(); ++i) {
    if (connections_[i].get() != &connection) continue;
    epoll_event event{static_cast<uint32_t>(waits_to_send ? EPOLLOUT : EPOLLIN), {}};
    event.data.u64 = kEvents | i;
    epoll_ctl(epoll_, EPOLL_CTL_MOD, connection.fd, &event);
  }
}

bool TcpMasters::send(Connection& connection) {
  TcpMaster& master = connection.master;
  while (master.replyBytes() > 0) {
    const ssize_t count = ::send(connection.fd, master.replies(), master.replyBytes(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0 && errno != EAGAIN) return false;
    if (count < 0) break;
    master.sent(static_cast<uint32_t>(count));
  }
  watch(connection, master.replyBytes() > 0);
  return true;
}

bool TcpMasters::answer(Connection& connection, uint32_t received) {
  do {
    if (!connection.master.receive(image_, *connection.server, received) || !send(connection)) return false;
    received = 0;
  } while (connection.master.hasMore() && !connection.waits_to_send);
  return true;
}

bool TcpMasters::receive(Connection& connection) {
  TcpMaster& master = connection.master;
  for (int i = 0; i < kReadsPerTurn && !connection.waits_to_send; ++i) {
    const uint32_t room = master.room();
    const ssize_t count = recv(connection.fd, master.free(), room, MSG_DONTWAIT);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return errno == EAGAIN;
    if (count == 0) return false;
    if (!answer(connection, static_cast<uint32_t>(count))) return false;
    if (static_cast<uint32_t>(count) < room) return true;  // all is read
  }
  return true;
}

void TcpMasters::onEvent(uint32_t index, int64_t now_ns) {
  if (index >= connections_.size() || connections_[index]->fd < 0) return;
  Connection& connection = *connections_[index];
  connection.last_ns = now_ns;
  bool goes_on = true;
  if (connection.waits_to_send) {
    goes_on = send(connection);
    if (goes_on && !connection.waits_to_send) goes_on = answer(connection, 0);
  }
  if (!goes_on || !receive(connection)) close(connection);
}

void TcpMasters::closeOf(const ServedImage::Server& server) {
  for (const std::unique_ptr<Connection>& connection : connections_)
    if (connection->server == &server) close(*connection);
}

}  // namespace rung::host
