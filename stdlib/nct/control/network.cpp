// SPDX-License-Identifier: Apache-2.0
// The network connection of the simulated control: see network.h.
#include "network.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "rung/nc.h"

namespace rung::nct {
namespace {

constexpr Code kWrongSocket = 60, kNotConnected = 61, kTransfer = 62, kSocketClosed = 63, kPacketLength = 64,
               kNothing = 65, kInputs = 66;
constexpr uint32_t kRegisters = 350;
constexpr uint64_t kConnectCycles = 500;

// Windows Sockets Error Codes.
uint32_t windowsNumber(int error) {
  switch (error) {
    case EINTR: return 10004;
    case EPERM:
    case EACCES: return 10013;
    case EFAULT: return 10014;
    case EINVAL: return 10022;
    case ENFILE:
    case EMFILE: return 10024;
    case EAGAIN: return 10035;
    case EMSGSIZE: return 10040;
    case EADDRINUSE: return 10048;
    case EADDRNOTAVAIL: return 10049;
    case ENETDOWN: return 10050;
    case ENETUNREACH: return 10051;
    case ENETRESET: return 10052;
    case ECONNABORTED: return 10053;
    case EPIPE:
    case ECONNRESET: return 10054;
    case ENOBUFS:
    case ENOMEM: return 10055;
    case EISCONN: return 10056;
    case ENOTCONN: return 10057;
    case ETIMEDOUT: return 10060;
    case ECONNREFUSED: return 10061;
    case EHOSTDOWN: return 10064;
    case EHOSTUNREACH: return 10065;
    default: return 10107;  // a system call that should never fail has failed
  }
}

sockaddr_in addressOf(uint32_t ip, uint32_t port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(ip);
  address.sin_port = htons(static_cast<uint16_t>(port));
  return address;
}

bool isTarget(uint32_t ip, uint32_t port) { return ip != 0 && ip != 0xFFFFFFFF && port >= 1 && port <= 65535; }

void putError(Block& block, uint32_t at, int error) {
  if (at < block.size()) block.put(at, error == 0 ? 0 : windowsNumber(error));
}

}  // namespace

void Network::close() {
  if (client_ >= 0) ::close(client_);
  if (socket_ >= 0) ::close(socket_);
  client_ = socket_ = -1;
  connecting_request_ = 0;
  rest_.clear();
}

// The other side is gone: a server waits for the next client.
void Network::lose() {
  if (protocol_ != Protocol::Server) {
    close();
    return;
  }
  ::close(client_);
  client_ = -1;
  rest_.clear();
}

void Network::beginCycle() {
  if (!isOpen() || protocol_ == Protocol::Udp) return;
  acceptClient();
  if (stream() >= 0 && sendRest() != 0) lose();
}

// One client at a time, and only from the device that the program has named.
void Network::acceptClient() {
  if (protocol_ != Protocol::Server || client_ >= 0) return;
  sockaddr_in from{};
  socklen_t size = sizeof from;
  const int client = accept4(socket_, reinterpret_cast<sockaddr*>(&from), &size, SOCK_NONBLOCK | SOCK_CLOEXEC);
  if (client < 0) return;
  if (ntohl(from.sin_addr.s_addr) == ip_)
    client_ = client;
  else
    ::close(client);
}

// 0, or what went wrong.
int Network::start(Connecting& connecting) {
  const int type = protocol_ == Protocol::Udp ? SOCK_DGRAM : SOCK_STREAM;
  socket_ = socket(AF_INET, type | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (socket_ < 0) return errno;
  const sockaddr_in own = addressOf(INADDR_ANY, port_), target = addressOf(ip_, port_);
  if (protocol_ == Protocol::Client) {
    if (connect(socket_, reinterpret_cast<const sockaddr*>(&target), sizeof target) == 0) return 0;
    connecting = errno == EINPROGRESS ? Connecting::Yes : Connecting::No;
    return connecting == Connecting::Yes ? 0 : errno;
  }
  const int on = 1;
  if (protocol_ == Protocol::Server) setsockopt(socket_, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  if (bind(socket_, reinterpret_cast<const sockaddr*>(&own), sizeof own) != 0) return errno;
  return protocol_ == Protocol::Server && listen(socket_, 1) != 0 ? errno : 0;
}

Code Network::open(Block& block, uint32_t request, uint64_t waited) {
  if (block.amount() != 5) return kWrongAmount;
  if (block.word(2) != 1) return kWrongSocket;
  if (block.word(4) < 1 || block.word(4) > 3 || !isTarget(block.word(5), block.word(6))) return kInputs;
  int error = 0;
  if (connecting_request_ == request && socket_ >= 0) {
    pollfd state{socket_, POLLOUT, 0};
    if (::poll(&state, 1, 0) == 0) {
      if (waited < kConnectCycles) return kBusy;
      error = ETIMEDOUT;
    } else {
      socklen_t size = sizeof error;
      if (getsockopt(socket_, SOL_SOCKET, SO_ERROR, &error, &size) != 0) error = errno;
    }
  } else {
    close();  // an open connection is opened again
    protocol_ = static_cast<Protocol>(block.word(4));
    ip_ = block.word(5);
    port_ = block.word(6);
    Connecting connecting = Connecting::No;
    error = start(connecting);
    if (error == 0 && connecting == Connecting::Yes) {
      connecting_request_ = request;
      return kBusy;
    }
  }
  connecting_request_ = 0;
  putError(block, 3, error);
  if (error == 0) return kDone;
  close();
  return kNotConnected;
}

// The manual names the amounts 1 and 2.
Code Network::close(const Block& block) {
  if (block.amount() != 1 && block.amount() != 2) return kWrongAmount;
  if (block.word(2) != 1) return kWrongSocket;
  close();
  return kDone;
}

// MR62 and MW63: connection, address, length.
Code Network::check(const Block& block, uint32_t first_address) const {
  if (block.amount() < 3 || block.amount() > 6) return kWrongAmount;
  if (block.word(2) != 1) return kWrongSocket;
  if (!isOpen()) return kSocketClosed;
  const uint32_t address = block.word(3), length = block.word(4);
  if (length < 1 || length > kRegisters) return kPacketLength;
  return address < first_address || address > RUNG_NC_WORDS - length ? kInputs : kDone;
}

// One packet; a shorter one fills the first words, the last of them with zeros, and a longer one is cut.
Code Network::receive(Block& block, uint32_t* memory) {
  if (const Code code = check(block, kFirstKept); code != kDone) return code;
  acceptClient();
  uint8_t bytes[4 * kRegisters] = {};
  sockaddr_in from = addressOf(ip_, port_);
  socklen_t size = sizeof from;
  ssize_t count = -1;
  errno = EAGAIN;
  if (stream() >= 0) {
    count = recvfrom(stream(), bytes, 4 * size_t{block.word(4)}, 0,
                     protocol_ == Protocol::Udp ? reinterpret_cast<sockaddr*>(&from) : nullptr, &size);
  }
  int error = count < 0 ? errno : 0;
  if (error == EAGAIN || error == EINTR) return kNothing;
  if (count == 0 && protocol_ != Protocol::Udp) error = ECONNRESET;
  putError(block, 5, error);
  if (error != 0) {
    if (protocol_ != Protocol::Udp) lose();
    return kTransfer;
  }
  if (protocol_ != Protocol::Udp) {
    size = sizeof from;
    getpeername(stream(), reinterpret_cast<sockaddr*>(&from), &size);
  }
  for (uint32_t k = 0; k < (static_cast<uint32_t>(count) + 3) / 4; ++k)
    memory[block.word(3) + k] = bytes[4 * k] | uint32_t{bytes[4 * k + 1]} << 8 | uint32_t{bytes[4 * k + 2]} << 16 |
                                uint32_t{bytes[4 * k + 3]} << 24;
  if (block.amount() >= 5) block.put(6, ntohl(from.sin_addr.s_addr));
  if (block.amount() >= 6) block.put(7, ntohs(from.sin_port));
  return kDone;
}

// 0, or what went wrong. What the network does not take now stays.
int Network::sendRest() {
  while (!rest_.empty()) {
    const ssize_t count = ::send(stream(), rest_.data(), rest_.size(), MSG_NOSIGNAL);
    if (count < 0) return errno == EAGAIN || errno == EINTR ? 0 : errno;
    rest_.erase(rest_.begin(), rest_.begin() + count);
  }
  return 0;
}

Code Network::send(Block& block, const uint32_t* memory) {
  if (const Code code = check(block, kFirstSent); code != kDone) return code;
  const uint32_t ip = block.amount() >= 5 && protocol_ == Protocol::Udp ? block.word(6) : ip_;
  const uint32_t port = block.amount() >= 6 && protocol_ == Protocol::Udp ? block.word(7) : port_;
  if (!isTarget(ip, port)) return kInputs;
  acceptClient();
  int error = stream() < 0 ? ENOTCONN : 0;
  if (error == 0) error = sendRest();
  if (error == 0 && !rest_.empty()) return kBusy;

  std::vector<uint8_t> bytes;
  for (uint32_t k = 0; k < block.word(4); ++k)
    for (uint32_t shift = 0; shift < 32; shift += 8)
      bytes.push_back(static_cast<uint8_t>(memory[block.word(3) + k] >> shift));
  if (error == 0 && protocol_ == Protocol::Udp) {
    const sockaddr_in target = addressOf(ip, port);
    const auto* const to = reinterpret_cast<const sockaddr*>(&target);
    if (sendto(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL, to, sizeof target) < 0) error = errno;
    if (error == EAGAIN || error == EINTR) return kBusy;
  } else if (error == 0) {
    rest_ = std::move(bytes);
    error = sendRest();
  }
  putError(block, 5, error);
  if (error == 0) return kDone;
  if (protocol_ != Protocol::Udp && stream() >= 0) lose();
  return kTransfer;
}

}  // namespace rung::nct
