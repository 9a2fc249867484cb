// SPDX-License-Identifier: Apache-2.0
// Sockets and serial lines of a program: see channels.h. The functions of the program are first, the engine follows.
#include "channels.h"

#include <fcntl.h>
#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <termios.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <mutex>

#include "clock.h"
#include "sockets.h"

namespace rung::host {
namespace {

constexpr uint32_t kDatagramBytes = 128 * 1024, kChunk = 64 * 1024;
constexpr int kEventsAtOnce = 64, kReadsPerEvent = 4;
constexpr int64_t kMillisecond = 1'000'000, kTickNs = kMillisecond;  // of serial lines that send
constexpr int64_t kLongestWaitMs = 1000;
constexpr uint32_t kGenerations = 1u << 20;  // handles fit into 32 bits
constexpr uint64_t kWakeEvent = 0, kChannelEvent = uint64_t{1} << 32;

Channels& asChannels(void* data) { return *static_cast<Channels*>(data); }

const rung_channels kChannelTable = {
    [](void* data, const rung_channel_settings* settings) { return asChannels(data).open(*settings); },
    [](void* data, int64_t channel, rung_channel_status* status) { return asChannels(data).status(channel, *status); },
    [](void* data, int64_t channel, void* bytes, uint64_t count, rung_endpoint* from) {
      return asChannels(data).read(channel, bytes, count, from);
    },
    [](void* data, int64_t channel, const void* bytes, uint64_t count, const rung_endpoint* to) {
      return asChannels(data).write(channel, bytes, count, to);
    },
    [](void* data, int64_t channel) { return asChannels(data).close(channel); },
};

bool isSerial(uint8_t kind) { return kind == RUNG_CHANNEL_SERIAL || kind == RUNG_CHANNEL_MODBUS_RTU; }

}  // namespace

Channels::Channels(const SerialDevices& devices, ServedImage& image) : devices_(devices), image_(image) {
  channels_ = std::make_unique<Channel[]>(kMost);
  servers_ = std::make_unique<ServedImage::Server[]>(kMostServers);
  queue_.reserve(kMost);
  taken_.reserve(kMost);
  buffer_ = std::make_unique<uint8_t[]>(kChunk);
  epoll_ = epoll_create1(EPOLL_CLOEXEC);
  wake_ = eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
  epoll_event event{EPOLLIN, {}};
  event.data.u64 = kWakeEvent;
  epoll_ctl(epoll_, EPOLL_CTL_ADD, wake_, &event);
  masters_ = std::make_unique<TcpMasters>(epoll_, image_);
}

Channels::~Channels() {
  stop();
  masters_.reset();
  for (uint32_t i = 0; i < kMost; ++i)
    if (channels_[i].fd >= 0) ::close(channels_[i].fd);
  ::close(wake_);
  ::close(epoll_);
}

void Channels::serve(rung_host& host) {
  host.channels = &kChannelTable;
  host.channels_data = this;
}

// ---- functions of the program

bool Channels::isDatagram(const Channel& channel) {
  return channel.settings.kind == RUNG_CHANNEL_UDP || channel.settings.kind == RUNG_CHANNEL_UDP_SENDER;
}

bool Channels::isServer(const Channel& channel) {
  const uint8_t kind = channel.settings.kind;
  return kind == RUNG_CHANNEL_TCP_SERVER || kind == RUNG_CHANNEL_MODBUS_TCP || kind == RUNG_CHANNEL_MODBUS_RTU;
}

int64_t Channels::handleOf(const Channel& channel) const {
  return int64_t{channel.generation} * kMost + (&channel - channels_.get()) + 1;
}

Channels::Channel* Channels::find(int64_t handle) {
  if (handle <= 0) return nullptr;
  Channel& channel = channels_[static_cast<size_t>((handle - 1) % kMost)];
  const bool is_its = handleOf(channel) == handle && channel.state != State::Free && channel.state != State::Closing;
  return is_its ? &channel : nullptr;
}

void Channels::wake() {
  if (is_woken_.exchange(true)) return;
  const uint64_t one = 1;
  (void)!::write(wake_, &one, sizeof one);
}

void Channels::enqueue(Channel& channel) {
  if (!channel.is_queued) queue_.push_back(static_cast<uint32_t>(&channel - channels_.get()));
  channel.is_queued = true;
  wake();
}

// Refuses settings that are wrong whatever the system says.
int64_t Channels::refuse(const rung_channel_settings& settings) const {
  uint32_t address = 0;
  if (settings.kind < RUNG_CHANNEL_SERIAL || settings.kind > RUNG_CHANNEL_MODBUS_RTU) return RUNG_CHANNEL_DENIED;
  if (!isSerial(settings.kind)) {
    const bool is_complete =
        settings.kind != RUNG_CHANNEL_TCP_CLIENT || (settings.address[0] != 0 && settings.port != 0);
    return is_complete && readAddress(settings.address, address) ? 0 : int64_t{RUNG_CHANNEL_ADDRESS};
  }
  if (devices_.count(settings.port) == 0) return RUNG_CHANNEL_ADDRESS;
  for (uint32_t i = 0; i < kMost; ++i) {
    const Channel& other = channels_[i];
    // One that closes is closed before this one opens.
    const bool is_open = other.state != State::Free && other.state != State::Ended && other.state != State::Closing &&
                         isSerial(other.settings.kind);
    if (is_open && other.settings.port == settings.port) return RUNG_CHANNEL_IN_USE;
  }
  return checkSerialSettings(settings);
}

int64_t Channels::open(const rung_channel_settings& settings) {
  const std::lock_guard<PriorityMutex> lock(mutex_);
  const int64_t refused = refuse(settings);
  if (refused != 0) return refused;
  if (settings.kind == RUNG_CHANNEL_TCP_ACCEPT) {
    const Channel* const server = find(settings.server);
    if (server == nullptr || server->settings.kind != RUNG_CHANNEL_TCP_SERVER) return RUNG_CHANNEL_HANDLE;
  }
  Channel* const last = channels_.get() + kMost;
  Channel* const channel =
      std::find_if(channels_.get(), last, [](const Channel& each) { return each.state == State::Free; });
  if (channel == last) return RUNG_CHANNEL_LIMIT;
  channel->served = 0;
  if (settings.kind == RUNG_CHANNEL_MODBUS_TCP || settings.kind == RUNG_CHANNEL_MODBUS_RTU) {
    bool* const free = std::find(is_served_, is_served_ + kMostServers, false);
    if (free == is_served_ + kMostServers) return RUNG_CHANNEL_LIMIT;
    *free = true;
    channel->served = static_cast<uint32_t>(free - is_served_) + 1;
    servers_[channel->served - 1].unit = settings.unit;
    servers_[channel->served - 1].register_count = 0;
    image_.use();
  }
  channel->state = State::Asked;
  channel->error = 0;
  channel->generation = channel->generation % kGenerations + 1;
  channel->is_full = channel->is_finished = false;
  channel->in_driver = 0;
  channel->settings = settings;
  strncpy(channel->address, settings.address == nullptr ? "" : settings.address, sizeof channel->address - 1);
  channel->settings.address = channel->address;
  channel->received.clear();
  channel->unsent.clear();
  used_.fetch_add(1);
  enqueue(*channel);
  return handleOf(*channel);
}

int64_t Channels::status(int64_t handle, rung_channel_status& status) {
  const std::lock_guard<PriorityMutex> lock(mutex_);
  status = {};
  const Channel* const channel = find(handle);
  if (channel == nullptr) return RUNG_CHANNEL_HANDLE;
  status.readable = channel->received.size();
  if (isDatagram(*channel) && status.readable > 0) {
    DatagramHeader header{};
    channel->received.peek(0, &header, sizeof header);
    status.readable = header.size;
  }
  status.unsent = channel->unsent.size() + channel->in_driver;
  const bool has_ended = channel->state == State::Ended || channel->is_finished;
  if (channel->received.size() == 0 && channel->state == State::Open && has_ended)
    status.state = RUNG_CHANNEL_CLOSED;
  else if (channel->state == State::Open || (has_ended && channel->received.size() > 0))
    status.state = 1;
  else if (channel->state == State::Ended)
    status.state = channel->error;
  return 0;
}

int64_t Channels::read(int64_t handle, void* bytes, uint64_t count, rung_endpoint* from) {
  const std::lock_guard<PriorityMutex> lock(mutex_);
  Channel* const channel = find(handle);
  if (channel == nullptr || isServer(*channel) || channel->settings.kind == RUNG_CHANNEL_UDP_SENDER)
    return RUNG_CHANNEL_HANDLE;
  if (channel->received.size() == 0) {
    if (channel->state == State::Ended) return channel->error;
    return channel->is_finished ? int64_t{RUNG_CHANNEL_CLOSED} : 0;
  }
  uint32_t taken = static_cast<uint32_t>(std::min<uint64_t>(count, channel->received.size()));
  if (isDatagram(*channel)) {
    DatagramHeader header{};
    channel->received.peek(0, &header, sizeof header);
    taken = static_cast<uint32_t>(std::min<uint64_t>(count, header.size));
    channel->received.peek(sizeof header, bytes, taken);
    channel->received.remove(static_cast<uint32_t>(sizeof header) + header.size);
    if (from != nullptr) *from = {header.address, header.port};
  } else {
    channel->received.peek(0, bytes, taken);
    channel->received.remove(taken);
  }
  if (channel->is_full) enqueue(*channel);
  return taken;
}

int64_t Channels::write(int64_t handle, const void* bytes, uint64_t count, const rung_endpoint* to) {
  const std::lock_guard<PriorityMutex> lock(mutex_);
  Channel* const channel = find(handle);
  if (channel == nullptr || channel->settings.kind == RUNG_CHANNEL_TCP_SERVER) return RUNG_CHANNEL_HANDLE;
  if (channel->state == State::Ended) return channel->error;
  if (channel->served != 0) {
    if (count > RUNG_MODBUS_OUTPUT_BYTES) return RUNG_CHANNEL_LIMIT;
    image_.setRegisters(servers_[channel->served - 1], bytes, static_cast<uint32_t>(count));
    return static_cast<int64_t>(count);
  }
  if (channel->state != State::Open) return 0;
  uint32_t taken = static_cast<uint32_t>(std::min<uint64_t>(count, channel->unsent.room()));
  if (isDatagram(*channel)) {
    if (to == nullptr) return RUNG_CHANNEL_ADDRESS;
    if (count > kMaxDatagram) return RUNG_CHANNEL_LIMIT;
    if (channel->unsent.room() < count + sizeof(DatagramHeader)) return 0;
    const DatagramHeader header{to->address, to->port, static_cast<uint16_t>(count)};
    channel->unsent.append(&header, sizeof header);
    taken = static_cast<uint32_t>(count);
  }
  channel->unsent.append(bytes, taken);
  enqueue(*channel);
  return taken;
}

int64_t Channels::close(int64_t handle) {
  const std::lock_guard<PriorityMutex> lock(mutex_);
  Channel* const channel = find(handle);
  if (channel == nullptr) return RUNG_CHANNEL_HANDLE;
  channel->state = State::Closing;
  used_.fetch_sub(1);
  enqueue(*channel);
  return 0;
}

void Channels::closeAll() {
  for (uint32_t i = 0; i < kMost; ++i) close(handleOf(channels_[i]));
}

// ---- the engine: wishes of the program

void Channels::takeWishes() {
  {
    const std::lock_guard<PriorityMutex> lock(mutex_);
    is_woken_.store(false);
    taken_.swap(queue_);
    for (const uint32_t index : taken_) channels_[index].is_queued = false;
  }
  for (const uint32_t index : taken_) serveWish(channels_[index]);
  taken_.clear();
}

void Channels::serveWish(Channel& channel) {
  State state;
  bool was_full = false;
  {
    const std::lock_guard<PriorityMutex> lock(mutex_);
    state = channel.state;
    was_full = channel.is_full;
    channel.is_full = false;
  }
  switch (state) {
    case State::Asked: openChannel(channel); break;
    case State::Closing: release(channel); break;
    case State::Open:
      if (was_full && !channel.is_finished) watch(channel, channel.events | EPOLLIN);
      send(channel);
      break;
    case State::Free:
    case State::Opening:
    case State::Ended: break;
  }
}

int Channels::openDescriptor(const rung_channel_settings& settings, bool& is_open, int32_t& error) {
  uint32_t address = 0;
  readAddress(settings.address, address);
  is_open = true;
  switch (settings.kind) {
    case RUNG_CHANNEL_TCP_CLIENT: return openTcpClient(address, settings.port, is_open, error);
    case RUNG_CHANNEL_TCP_SERVER:
    case RUNG_CHANNEL_MODBUS_TCP: return openTcpServer(address, settings.port, error);
    case RUNG_CHANNEL_UDP:
    case RUNG_CHANNEL_UDP_SENDER: return openSender(address, settings.port, error);
    default: return openSerial(devices_.at(settings.port).c_str(), settings, error);
  }
}

// A port has one socket, which a receiver and senders share.
int Channels::openSender(uint32_t address, uint16_t port, int32_t& error) {
  for (uint32_t i = 0; i < kMost && port != 0; ++i) {
    const Channel& other = channels_[i];
    uint32_t own = 0;
    if (other.fd < 0 || !isDatagram(other) || other.settings.port != port) continue;
    readAddress(other.address, own);
    if (own == address || own == INADDR_ANY || address == INADDR_ANY) return fcntl(other.fd, F_DUPFD_CLOEXEC, 0);
  }
  return openUdp(address, port, error);
}

void Channels::openChannel(Channel& channel) {
  const rung_channel_settings settings = channel.settings;
  if (channel.served != 0 && !image_.isReady()) {  // until the first border of an activation
    const std::lock_guard<PriorityMutex> lock(mutex_);
    waits_for_image_ = true;
    if (!channel.is_queued) queue_.push_back(static_cast<uint32_t>(&channel - channels_.get()));
    channel.is_queued = true;
    return;
  }
  if (settings.kind == RUNG_CHANNEL_TCP_ACCEPT) {
    finishOpening(channel, -1, false, 0);
    watchServer(settings.server);
    return;
  }
  if (settings.kind == RUNG_CHANNEL_UDP) {
    for (uint32_t i = 0; i < kMost; ++i) {
      const Channel& other = channels_[i];
      if (other.fd < 0 || other.settings.kind != RUNG_CHANNEL_UDP || other.settings.port != settings.port) continue;
      if (strcmp(other.address, channel.address) == 0) return end(channel, RUNG_CHANNEL_IN_USE);
    }
  }
  bool is_open = false;
  int32_t error = 0;
  const int fd = openDescriptor(settings, is_open, error);
  if (isSerial(settings.kind)) channel.line.open(settings);
  finishOpening(channel, fd, is_open, fd < 0 ? error : 0);
}

void Channels::finishOpening(Channel& channel, int fd, bool is_open, int32_t error) {
  const uint8_t kind = channel.settings.kind;
  const uint32_t capacity = isDatagram(channel) ? kDatagramBytes : isServer(channel) ? 0 : kStreamBytes;
  ByteRing received, unsent;
  if (capacity > 0 && error == 0) {
    received.allocate(kind == RUNG_CHANNEL_UDP_SENDER ? 0 : capacity);
    unsent.allocate(capacity);
  }
  {
    const std::lock_guard<PriorityMutex> lock(mutex_);
    if (channel.state == State::Asked) {
      channel.state = error != 0 ? State::Ended : is_open ? State::Open : State::Opening;
      channel.error = error;
      std::swap(channel.received, received);
      std::swap(channel.unsent, unsent);
    }
  }
  channel.fd = fd;
  channel.events = 0;
  if (fd < 0) return;
  if (!is_open)
    watch(channel, EPOLLOUT);
  else if (kind != RUNG_CHANNEL_UDP_SENDER && kind != RUNG_CHANNEL_TCP_SERVER)
    watch(channel, EPOLLIN);
}

// A descriptor without events is not watched at all: its end would be reported over and over.
void Channels::watch(Channel& channel, uint32_t events) {
  if (channel.fd < 0 || channel.events == events) return;
  const int change = channel.events == 0 ? EPOLL_CTL_ADD : events == 0 ? EPOLL_CTL_DEL : EPOLL_CTL_MOD;
  channel.events = events;
  epoll_event event{events, {}};
  event.data.u64 = kChannelEvent | static_cast<uint64_t>(&channel - channels_.get());
  epoll_ctl(epoll_, change, channel.fd, &event);
}

// The channel is the program's no more.
void Channels::release(Channel& channel) {
  send(channel);
  if (channel.fd >= 0) {
    if (isSerial(channel.settings.kind)) tcflush(channel.fd, TCOFLUSH);  // else closing waits for the line
    ::close(channel.fd);
  }
  channel.fd = -1;
  const bool was_server = channel.settings.kind == RUNG_CHANNEL_TCP_SERVER;
  const int64_t handle = handleOf(channel);
  if (channel.served != 0) {
    if (channel.settings.kind == RUNG_CHANNEL_MODBUS_TCP) masters_->closeOf(servers_[channel.served - 1]);
  }
  {
    const std::lock_guard<PriorityMutex> lock(mutex_);
    if (channel.served != 0) is_served_[channel.served - 1] = false;
    channel.state = State::Free;
  }
  for (uint32_t i = 0; was_server && i < kMost; ++i)
    if (waitsFor(channels_[i], handle)) end(channels_[i], RUNG_CHANNEL_CLOSED);
}

bool Channels::waitsFor(const Channel& channel, int64_t server) {
  const std::lock_guard<PriorityMutex> lock(mutex_);
  return channel.state == State::Opening && channel.settings.kind == RUNG_CHANNEL_TCP_ACCEPT &&
         channel.settings.server == server;
}

void Channels::end(Channel& channel, int32_t error) {
  if (channel.fd >= 0) ::close(channel.fd);
  channel.fd = -1;
  const std::lock_guard<PriorityMutex> lock(mutex_);
  if (channel.state == State::Closing) return;
  channel.state = State::Ended;
  channel.error = error;
  channel.in_driver = 0;
}

// ---- the engine: events

// Clients wait in the system while no channel waits for them.
void Channels::watchServer(int64_t server) {
  Channel& channel = channels_[static_cast<size_t>((server - 1) % kMost)];
  {
    const std::lock_guard<PriorityMutex> lock(mutex_);
    if (find(server) == nullptr) return;
  }
  bool is_wanted = false;
  for (uint32_t i = 0; i < kMost && !is_wanted; ++i) is_wanted = waitsFor(channels_[i], server);
  watch(channel, is_wanted ? uint32_t{EPOLLIN} : 0);
}

void Channels::acceptClients(Channel& server) {
  const int64_t handle = handleOf(server);
  for (uint32_t i = 0; i < kMost; ++i) {
    Channel& channel = channels_[i];
    if (!waitsFor(channel, handle)) continue;
    int32_t error = 0;
    const int fd = acceptClient(server.fd, error);
    if (fd < 0 && error != 0) end(channel, error);
    if (fd < 0) break;
    channel.fd = fd;
    channel.events = 0;
    watch(channel, EPOLLIN);
    const std::lock_guard<PriorityMutex> lock(mutex_);
    if (channel.state == State::Opening) channel.state = State::Open;
  }
  watchServer(handle);
}

void Channels::onEvent(Channel& channel, uint32_t events) {
  if (channel.fd < 0) return;
  State state;
  {
    const std::lock_guard<PriorityMutex> lock(mutex_);
    state = channel.state;
  }
  if (state == State::Opening) {
    const int32_t error = connectError(channel.fd);
    if (error != 0) return end(channel, error == RUNG_CHANNEL_CLOSED ? int32_t{RUNG_CHANNEL_REFUSED} : error);
    {
      const std::lock_guard<PriorityMutex> lock(mutex_);
      if (channel.state == State::Opening) channel.state = State::Open;
    }
    watch(channel, EPOLLIN);
    return;
  }
  if (state != State::Open) return;
  switch (channel.settings.kind) {
    case RUNG_CHANNEL_TCP_SERVER: acceptClients(channel); return;
    case RUNG_CHANNEL_MODBUS_TCP: masters_->accept(channel.fd, servers_[channel.served - 1], monotonicNs()); return;
    case RUNG_CHANNEL_MODBUS_RTU: receiveRequests(channel); return;
    default: break;
  }
  if ((events & EPOLLOUT) != 0) send(channel);
  if ((events & ~uint32_t{EPOLLOUT}) != 0) receive(channel);
}

void Channels::receive(Channel& channel) {
  const bool is_datagram = isDatagram(channel), is_line = isSerial(channel.settings.kind);
  for (int i = 0; i < kReadsPerEvent && channel.fd >= 0; ++i) {
    uint32_t room = kChunk;
    if (!is_datagram) {
      const std::lock_guard<PriorityMutex> lock(mutex_);
      room = std::min(room, channel.received.room());
      channel.is_full = room == 0;
    }
    if (room == 0) return watch(channel, channel.events & ~uint32_t{EPOLLIN});
    sockaddr_in peer{};
    socklen_t peer_size = sizeof peer;
    const ssize_t count = is_line ? ::read(channel.fd, buffer_.get(), room)
                                  : recvfrom(channel.fd, buffer_.get(), room, MSG_DONTWAIT,
                                             is_datagram ? reinterpret_cast<sockaddr*>(&peer) : nullptr,
                                             is_datagram ? &peer_size : nullptr);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0 && errno == EAGAIN) return;
    // What a peer of datagrams refuses says nothing about the next one.
    if (is_datagram && count < 0) return;
    if (count < 0) return end(channel, errno == ECONNRESET ? RUNG_CHANNEL_CLOSED : RUNG_CHANNEL_FAILED);
    if (count == 0 && is_line) return end(channel, RUNG_CHANNEL_FAILED);
    if (count == 0 && !is_datagram) {
      const std::lock_guard<PriorityMutex> lock(mutex_);
      channel.is_finished = true;
      return watch(channel, channel.events & ~uint32_t{EPOLLIN});
    }
    const std::lock_guard<PriorityMutex> lock(mutex_);
    if (channel.state != State::Open) return;
    if (is_datagram) {
      // Datagrams that find no room are lost, as on the way.
      if (channel.received.room() < sizeof(DatagramHeader) + static_cast<uint32_t>(count)) continue;
      const DatagramHeader header{ntohl(peer.sin_addr.s_addr), ntohs(peer.sin_port), static_cast<uint16_t>(count)};
      channel.received.append(&header, sizeof header);
    }
    channel.received.append(buffer_.get(), static_cast<uint32_t>(count));
    if (!is_datagram && static_cast<uint32_t>(count) < room) return;
  }
}

void Channels::receiveRequests(Channel& channel) {
  const ssize_t count = ::read(channel.fd, buffer_.get(), kChunk);
  if (count > 0)
    channel.line.receive(buffer_.get(), static_cast<size_t>(count), monotonicNs());
  else if (count == 0 || (errno != EAGAIN && errno != EINTR))
    end(channel, RUNG_CHANNEL_FAILED);
}

// One piece of what waits to be sent. False: nothing waits, or the system takes no more.
bool Channels::sendOne(Channel& channel) {
  uint32_t count = 0, header_size = 0;
  DatagramHeader header{};
  {
    const std::lock_guard<PriorityMutex> lock(mutex_);
    count = std::min(channel.unsent.size(), kChunk);
    if (count == 0) return false;
    if (isDatagram(channel)) {
      header_size = sizeof header;
      channel.unsent.peek(0, &header, header_size);
      count = header.size;
    }
    channel.unsent.peek(header_size, buffer_.get(), count);
  }
  const bool is_line = isSerial(channel.settings.kind);
  const sockaddr_in peer = socketAddress(header.address, header.port);
  ssize_t sent = is_line            ? ::write(channel.fd, buffer_.get(), count)
                 : header_size == 0 ? ::send(channel.fd, buffer_.get(), count, MSG_NOSIGNAL | MSG_DONTWAIT)
                                    : sendto(channel.fd, buffer_.get(), count, MSG_NOSIGNAL | MSG_DONTWAIT,
                                             reinterpret_cast<const sockaddr*>(&peer), sizeof peer);
  if (sent < 0 && errno == EINTR) return true;
  if (sent < 0 && errno == EAGAIN) {
    watch(channel, channel.events | EPOLLOUT);
    return false;
  }
  if (sent < 0 && header_size == 0) {
    end(channel, errno == EPIPE || errno == ECONNRESET ? RUNG_CHANNEL_CLOSED : RUNG_CHANNEL_FAILED);
    return false;
  }
  if (header_size != 0) sent = count;  // a datagram that cannot go is lost
  const std::lock_guard<PriorityMutex> lock(mutex_);
  channel.unsent.remove(std::min(channel.unsent.size(), static_cast<uint32_t>(sent) + header_size));
  return true;
}

void Channels::send(Channel& channel) {
  if (channel.fd < 0 || isServer(channel)) return;
  while (sendOne(channel)) {
  }
  if (channel.fd < 0) return;
  const bool is_line = isSerial(channel.settings.kind);
  const uint32_t in_driver = is_line ? unsentOfDriver(channel.fd) : 0;
  const std::lock_guard<PriorityMutex> lock(mutex_);
  channel.in_driver = in_driver;
  if (channel.unsent.size() == 0 && (channel.events & EPOLLOUT) != 0) watch(channel, channel.events & ~EPOLLOUT);
}

// Serial lines: requests that are complete when the line is silent, and bytes that are still in the driver. Returns
// when to look again.
int64_t Channels::runTimers() {
  int64_t next = INT64_MAX;
  for (uint32_t i = 0; i < kMost; ++i) {
    Channel& channel = channels_[i];
    if (channel.fd < 0 || !isSerial(channel.settings.kind)) continue;
    const int64_t now = monotonicNs();
    if (channel.settings.kind == RUNG_CHANNEL_MODBUS_RTU) {
      uint8_t reply[RUNG_MODBUS_MAX_RTU];
      const uint32_t size = channel.line.answer(image_, servers_[channel.served - 1], now, reply);
      // A line that takes no bytes, since they are not read, loses the reply.
      if (size > 0) (void)!::write(channel.fd, reply, size);
      next = std::min(next, channel.line.dueNs());
    } else if (channel.in_driver > 0) {
      send(channel);
      next = std::min(next, now + kTickNs);
    }
  }
  return next;
}

void Channels::work(int64_t until_ns) {
  takeWishes();
  int64_t next = std::min(until_ns, runTimers());
  if (waits_for_image_) next = std::min(next, monotonicNs() + kTickNs);
  waits_for_image_ = false;
  const int64_t now = monotonicNs();
  const int64_t wait_ms = next <= now ? 0 : std::min((next - now) / kMillisecond + 1, kLongestWaitMs);
  epoll_event events[kEventsAtOnce];
  const int count = epoll_wait(epoll_, events, kEventsAtOnce, next == INT64_MAX ? -1 : static_cast<int>(wait_ms));
  for (int i = 0; i < count; ++i) {
    const uint64_t what = events[i].data.u64;
    if (what == kWakeEvent) {
      uint64_t times = 0;
      (void)!::read(wake_, &times, sizeof times);
    } else if ((what & TcpMasters::kEvents) != 0) {
      masters_->onEvent(static_cast<uint32_t>(what), monotonicNs());
    } else {
      onEvent(channels_[static_cast<uint32_t>(what)], events[i].events);
    }
  }
}

void Channels::runUntil(int64_t monotonic_ns) {
  do work(monotonic_ns);
  while (monotonicNs() < monotonic_ns);
}

void Channels::start() {
  ends_.store(false);
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_BLOCK, &all, &before);
  thread_ = std::thread([this] {
    while (!ends_.load()) work(INT64_MAX);
  });
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

void Channels::stop() {
  if (!thread_.joinable()) return;
  ends_.store(true);
  is_woken_.store(false);
  wake();
  thread_.join();
}

}  // namespace rung::host
