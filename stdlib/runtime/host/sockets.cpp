// SPDX-License-Identifier: Apache-2.0
// Sockets and serial lines: see sockets.h.
#include "sockets.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/tcp.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <termios.h>
#include <unistd.h>
#include <cerrno>

namespace rung::host {
namespace {

constexpr int kBacklog = 256;
constexpr int kSilenceSeconds = 30, kProbeSeconds = 5, kProbes = 3;  // of a peer that may have vanished

int32_t channelError(int number) {
  switch (number) {
    case EADDRNOTAVAIL:
    case EINVAL:
    case ENOENT: return RUNG_CHANNEL_ADDRESS;
    case EADDRINUSE:
    case EBUSY: return RUNG_CHANNEL_IN_USE;
    case EACCES:
    case EPERM: return RUNG_CHANNEL_DENIED;
    case EMFILE:
    case ENFILE:
    case ENOBUFS:
    case ENOMEM: return RUNG_CHANNEL_LIMIT;
    case ECONNREFUSED:
    case ENETUNREACH:
    case EHOSTUNREACH:
    case ETIMEDOUT: return RUNG_CHANNEL_REFUSED;
    case ECONNRESET:
    case EPIPE: return RUNG_CHANNEL_CLOSED;
    default: return RUNG_CHANNEL_FAILED;
  }
}

int fail(int fd, int32_t& error) {
  error = channelError(errno);
  if (fd >= 0) close(fd);
  return -1;
}

void setOption(int fd, int level, int name, int value) { setsockopt(fd, level, name, &value, sizeof value); }

void prepareStream(int fd) {
  setOption(fd, IPPROTO_TCP, TCP_NODELAY, 1);
  setOption(fd, SOL_SOCKET, SO_KEEPALIVE, 1);
  setOption(fd, IPPROTO_TCP, TCP_KEEPIDLE, kSilenceSeconds);
  setOption(fd, IPPROTO_TCP, TCP_KEEPINTVL, kProbeSeconds);
  setOption(fd, IPPROTO_TCP, TCP_KEEPCNT, kProbes);
}

int bindTo(int fd, uint32_t address, uint16_t port, int32_t& error) {
  const sockaddr_in own = socketAddress(address, port);
  if (bind(fd, reinterpret_cast<const sockaddr*>(&own), sizeof own) != 0) return fail(fd, error);
  return fd;
}

speed_t speedOf(uint32_t rate) {
  switch (rate) {
    case 300: return B300;
    case 600: return B600;
    case 1200: return B1200;
    case 2400: return B2400;
    case 4800: return B4800;
    case 9600: return B9600;
    case 19200: return B19200;
    case 38400: return B38400;
    case 57600: return B57600;
    case 115200: return B115200;
    case 230400: return B230400;
    case 460800: return B460800;
    case 921600: return B921600;
    default: return B0;
  }
}

// It has all settings but the parity, which the C library reports as an error.
bool isPseudoTerminal(int fd, const termios& wanted) {
  termios now{};
  return errno == EINVAL && tcgetattr(fd, &now) == 0 && cfgetospeed(&now) == cfgetospeed(&wanted) &&
         (wanted.c_cflag & PARENB) != 0 && (now.c_cflag & PARENB) == 0;
}

}  // namespace

bool readAddress(const char* text, uint32_t& address) {
  in_addr parsed{};
  if (*text != 0 && inet_pton(AF_INET, text, &parsed) != 1) return false;
  address = ntohl(parsed.s_addr);
  return true;
}

sockaddr_in socketAddress(uint32_t address, uint16_t port) {
  sockaddr_in socket{};
  socket.sin_family = AF_INET;
  socket.sin_port = htons(port);
  socket.sin_addr.s_addr = htonl(address);
  return socket;
}

int openTcpClient(uint32_t address, uint16_t port, bool& connected, int32_t& error) {
  const int fd = socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (fd < 0) return fail(fd, error);
  prepareStream(fd);
  const sockaddr_in peer = socketAddress(address, port);
  connected = connect(fd, reinterpret_cast<const sockaddr*>(&peer), sizeof peer) == 0;
  return connected || errno == EINPROGRESS ? fd : fail(fd, error);
}

int openTcpServer(uint32_t address, uint16_t port, int32_t& error) {
  int fd = socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (fd < 0) return fail(fd, error);
  setOption(fd, SOL_SOCKET, SO_REUSEADDR, 1);
  fd = bindTo(fd, address, port, error);
  if (fd >= 0 && listen(fd, kBacklog) != 0) return fail(fd, error);
  return fd;
}

int openUdp(uint32_t address, uint16_t port, int32_t& error) {
  const int fd = socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (fd < 0) return fail(fd, error);
  setOption(fd, SOL_SOCKET, SO_BROADCAST, 1);
  return bindTo(fd, address, port, error);
}

int acceptClient(int server, int32_t& error) {
  const int fd = accept4(server, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
  error = 0;
  if (fd >= 0)
    prepareStream(fd);
  else if (errno != EAGAIN && errno != ECONNABORTED && errno != EINTR)
    error = channelError(errno);
  return fd;
}

int32_t connectError(int fd) {
  int number = 0;
  socklen_t size = sizeof number;
  getsockopt(fd, SOL_SOCKET, SO_ERROR, &number, &size);
  return number == 0 ? 0 : channelError(number);
}

int32_t checkSerialSettings(const rung_channel_settings& settings) {
  const bool known = speedOf(settings.rate) != B0 && settings.data_bits >= 5 && settings.data_bits <= 8 &&
                     settings.parity <= RUNG_PARITY_EVEN && (settings.stop_bits == 1 || settings.stop_bits == 2);
  return known ? 0 : int32_t{RUNG_CHANNEL_SETTING};
}

int64_t lineNs(const rung_channel_settings& settings, uint64_t characters) {
  const int64_t bits = 1 + settings.data_bits + (settings.parity != RUNG_PARITY_NONE ? 1 : 0) + settings.stop_bits;
  return settings.rate == 0 ? 0 : bits * static_cast<int64_t>(characters) * 1'000'000'000 / settings.rate;
}

int openSerial(const char* device, const rung_channel_settings& settings, int32_t& error) {
  const int fd = open(device, O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (fd < 0) return fail(fd, error);
  termios line{};
  if (tcgetattr(fd, &line) != 0) {
    close(fd);
    error = RUNG_CHANNEL_ADDRESS;  // not a serial line
    return -1;
  }
  constexpr tcflag_t kSizes[] = {CS5, CS6, CS7, CS8};
  cfmakeraw(&line);
  line.c_cflag &= ~static_cast<tcflag_t>(CSIZE | CSTOPB | PARENB | PARODD | CRTSCTS);
  line.c_cflag |= kSizes[settings.data_bits - 5] | CLOCAL | CREAD;
  if (settings.stop_bits == 2) line.c_cflag |= CSTOPB;
  if (settings.parity != RUNG_PARITY_NONE) line.c_cflag |= PARENB;
  if (settings.parity == RUNG_PARITY_ODD) line.c_cflag |= PARODD;
  line.c_iflag &= ~static_cast<tcflag_t>(INPCK | ISTRIP);
  if (settings.parity != RUNG_PARITY_NONE) line.c_iflag |= INPCK;  // a character with an error arrives as 0
  line.c_cc[VMIN] = 1;                                             // nothing to read is EAGAIN, not the end
  line.c_cc[VTIME] = 0;
  cfsetispeed(&line, speedOf(settings.rate));
  cfsetospeed(&line, speedOf(settings.rate));
  if (tcsetattr(fd, TCSANOW, &line) != 0 && !isPseudoTerminal(fd, line)) return fail(fd, error);
  tcflush(fd, TCIOFLUSH);
  return fd;
}

const char* findOwnAddress(char* text, uint32_t size) {
  ifaddrs* all = nullptr;
  if (getifaddrs(&all) != 0) return nullptr;
  const char* found = nullptr;
  for (const ifaddrs* each = all; each != nullptr && found == nullptr; each = each->ifa_next) {
    if (each->ifa_addr == nullptr || each->ifa_addr->sa_family != AF_INET || (each->ifa_flags & IFF_LOOPBACK) != 0)
      continue;
    found = inet_ntop(AF_INET, &reinterpret_cast<const sockaddr_in*>(each->ifa_addr)->sin_addr, text, size);
  }
  freeifaddrs(all);
  return found;
}

uint32_t unsentOfDriver(int fd) {
  int count = 0;
  return ioctl(fd, TIOCOUTQ, &count) == 0 && count > 0 ? static_cast<uint32_t>(count) : 0;
}

}  // namespace rung::host
