// SPDX-License-Identifier: Apache-2.0
// Channels in virtual time: see simulated_channels.h.
#include "simulated_channels.h"

#include <algorithm>
#include <cstring>

#include "byte_ring.h"
#include "sockets.h"

namespace rung::host {
namespace {

constexpr int64_t kLatencyNs = 1'000'000;  // of the network
constexpr size_t kMostDatagrams = 256;
constexpr uint32_t kLoopback = 0x7f000001;
constexpr uint32_t kFirstFreePort = 49152;

SimulatedChannels& simulationOf(void* data) { return *static_cast<SimulatedChannels*>(data); }

const rung_channels kSimulatedTable = {
    [](void* data, const rung_channel_settings* settings) { return simulationOf(data).open(*settings); },
    [](void* data, int64_t channel, rung_channel_status* status) {
      return simulationOf(data).status(channel, *status);
    },
    [](void* data, int64_t channel, void* bytes, uint64_t count, rung_endpoint* from) {
      return simulationOf(data).read(channel, bytes, count, from);
    },
    [](void* data, int64_t channel, const void* bytes, uint64_t count, const rung_endpoint* to) {
      return simulationOf(data).write(channel, bytes, count, to);
    },
    [](void* data, int64_t channel) { return simulationOf(data).close(channel); },
};

bool isLine(uint8_t kind) {
  return kind == RUNG_CHANNEL_SERIAL || kind == RUNG_CHANNEL_MODBUS_RTU || kind == RUNG_CHANNEL_SERIAL_PEER;
}
bool isServer(uint8_t kind) { return kind == RUNG_CHANNEL_TCP_SERVER || kind == RUNG_CHANNEL_MODBUS_TCP; }
bool isDatagram(uint8_t kind) { return kind == RUNG_CHANNEL_UDP || kind == RUNG_CHANNEL_UDP_SENDER; }
bool isAt(uint32_t own, uint32_t address) { return own == 0 || own == address; }

}  // namespace

void SimulatedChannels::serve(rung_host& host) {
  host.channels = &kSimulatedTable;
  host.channels_data = this;
}

void SimulatedChannels::transferChannel(Channel& it, StateArchive& archive) {
  archive.values(it.settings, it.address, it.is_closed, it.is_open, it.error, it.decided_ns, it.peer,
                 it.peer_closed_ns);
  archive.values(it.line_free_ns, it.server, it.master_of, it.line);
  archive.sequence(it.arriving, Chunk{}, [&](Chunk& chunk) {
    archive.values(chunk.arrives_ns, chunk.from);
    archive.text(chunk.bytes);
  });
  archive.sequence(it.waiting, 0, [&](int64_t& handle) { archive.value(handle); });
  bool is_master = it.master != nullptr;
  archive.value(is_master);
  if (archive.isRestoring()) it.master = is_master ? std::make_unique<TcpMaster>() : nullptr;
  if (is_master) archive.value(*it.master);
}

void SimulatedChannels::transfer(StateArchive& archive) {
  size_t count = channels_.size();
  archive.value(count);
  channels_.resize(count);
  for (Channel& channel : channels_) transferChannel(channel, archive);
}

SimulatedChannels::Channel* SimulatedChannels::find(int64_t handle) {
  if (handle < 1 || handle > static_cast<int64_t>(channels_.size())) return nullptr;
  Channel& channel = channels_[static_cast<size_t>(handle - 1)];
  return channel.is_closed ? nullptr : &channel;
}

int64_t SimulatedChannels::add(const rung_channel_settings& settings) {
  channels_.emplace_back();
  channels_.back().settings = settings;
  channels_.back().settings.address = "";
  return static_cast<int64_t>(channels_.size());
}

SimulatedChannels::Channel* SimulatedChannels::lineEnd(uint16_t port, bool is_peer) {
  for (Channel& channel : channels_) {
    const uint8_t kind = channel.settings.kind;
    if (!channel.is_closed && isLine(kind) && channel.settings.port == port &&
        (kind == RUNG_CHANNEL_SERIAL_PEER) == is_peer)
      return &channel;
  }
  return nullptr;
}

bool SimulatedChannels::isHost(uint32_t address) const {
  return std::any_of(channels_.begin(), channels_.end(), [&](const Channel& channel) {
    return !channel.is_closed && isServer(channel.settings.kind) && isAt(channel.address, address);
  });
}

int64_t SimulatedChannels::open(const rung_channel_settings& settings) {
  uint32_t address = 0;
  const uint8_t kind = settings.kind;
  if (kind < RUNG_CHANNEL_SERIAL || kind > RUNG_CHANNEL_SERIAL_PEER) return RUNG_CHANNEL_DENIED;
  if (isLine(kind)) {
    if (settings.port < 1) return RUNG_CHANNEL_ADDRESS;
    if (lineEnd(settings.port, kind == RUNG_CHANNEL_SERIAL_PEER) != nullptr) return RUNG_CHANNEL_IN_USE;
    if (kind != RUNG_CHANNEL_SERIAL_PEER && checkSerialSettings(settings) != 0) return RUNG_CHANNEL_SETTING;
  } else if (kind == RUNG_CHANNEL_TCP_ACCEPT) {
    const Channel* const server = find(settings.server);
    if (server == nullptr || server->settings.kind != RUNG_CHANNEL_TCP_SERVER) return RUNG_CHANNEL_HANDLE;
  } else {
    const bool is_complete = kind != RUNG_CHANNEL_TCP_CLIENT || (settings.address[0] != 0 && settings.port != 0);
    if (!is_complete || !readAddress(settings.address, address)) return RUNG_CHANNEL_ADDRESS;
  }
  for (const Channel& other : channels_) {
    const bool is_same =
        isServer(kind) ? isServer(other.settings.kind) : kind == RUNG_CHANNEL_UDP && other.settings.kind == kind;
    if (is_same && !other.is_closed && other.settings.port == settings.port && settings.port != 0 &&
        (other.address == address || other.address == 0 || address == 0))
      return RUNG_CHANNEL_IN_USE;
  }
  const int64_t handle = add(settings);
  Channel& channel = *find(handle);
  channel.address = address;
  if (isDatagram(kind) && settings.port == 0)
    channel.settings.port = static_cast<uint16_t>(kFirstFreePort + handle % (65536 - kFirstFreePort));
  channel.is_open = kind != RUNG_CHANNEL_TCP_CLIENT && kind != RUNG_CHANNEL_TCP_ACCEPT;
  channel.decided_ns = context_.now_ns + kLatencyNs;
  channel.server.unit = settings.unit;
  if (kind == RUNG_CHANNEL_MODBUS_RTU) channel.line.open(settings);
  if (kind == RUNG_CHANNEL_MODBUS_RTU || kind == RUNG_CHANNEL_MODBUS_TCP) image_.use();
  return handle;
}

// ---- connections

// The server's end of a connection exists before it is accepted, so that what the client sends is not lost.
void SimulatedChannels::connect(Channel& client, int64_t handle) {
  for (size_t i = 0; i < channels_.size(); ++i) {
    Channel& server = channels_[i];
    if (server.is_closed || !isServer(server.settings.kind) || server.settings.port != client.settings.port ||
        !isAt(server.address, client.address))
      continue;
    client.is_open = true;
    rung_channel_settings settings{};
    settings.kind = RUNG_CHANNEL_TCP_ACCEPT;
    const bool is_modbus = server.settings.kind == RUNG_CHANNEL_MODBUS_TCP;
    const int64_t end_handle = add(settings);
    Channel& end = *find(end_handle);
    end.is_open = true;
    end.peer = handle;
    client.peer = end_handle;
    if (is_modbus) {
      end.master = std::make_unique<TcpMaster>();
      end.master_of = static_cast<int64_t>(i) + 1;
    } else {
      server.waiting.push_back(end_handle);
    }
    return;
  }
  if (isHost(client.address)) client.error = RUNG_CHANNEL_REFUSED;
}

void SimulatedChannels::accept(Channel& channel) {
  Channel* const server = find(channel.settings.server);
  if (server == nullptr) {
    channel.error = RUNG_CHANNEL_CLOSED;
    return;
  }
  if (server->waiting.empty()) return;
  Channel* const end = find(server->waiting.front());
  server->waiting.pop_front();
  channel.is_open = true;
  channel.peer = end->peer;
  channel.peer_closed_ns = end->peer_closed_ns;
  channel.arriving.swap(end->arriving);
  end->is_closed = true;
  if (Channel* const client = find(channel.peer))
    client->peer = static_cast<int64_t>(std::find_if(channels_.begin(), channels_.end(),
                                                     [&](const Channel& each) { return &each == &channel; }) -
                                        channels_.begin()) +
                   1;
}

// Opens or fails the channels whose time has come.
void SimulatedChannels::settle() {
  for (size_t i = 0; i < channels_.size(); ++i) {
    Channel& channel = channels_[i];
    if (channel.is_closed || channel.is_open || channel.error != 0) continue;
    if (channel.settings.kind == RUNG_CHANNEL_TCP_CLIENT && channel.decided_ns <= context_.now_ns)
      connect(channel, static_cast<int64_t>(i) + 1);
  }
  for (Channel& channel : channels_) {
    if (channel.is_closed || channel.is_open || channel.error != 0) continue;
    if (channel.settings.kind == RUNG_CHANNEL_TCP_ACCEPT) accept(channel);
  }
}

SimulatedChannels::Channel* SimulatedChannels::otherEnd(const Channel& channel) {
  if (isLine(channel.settings.kind))
    return lineEnd(channel.settings.port, channel.settings.kind != RUNG_CHANNEL_SERIAL_PEER);
  return find(channel.peer);
}

// ---- bytes

uint32_t SimulatedChannels::arrived(const Channel& channel) const {
  uint32_t count = 0;
  for (const Chunk& chunk : channel.arriving) {
    if (chunk.arrives_ns > context_.now_ns) break;
    count += static_cast<uint32_t>(chunk.bytes.size());
    if (isDatagram(channel.settings.kind)) break;
  }
  return count;
}

int64_t SimulatedChannels::status(int64_t handle, rung_channel_status& status) {
  status = {};
  settle();
  Channel* const channel = find(handle);
  if (channel == nullptr) return RUNG_CHANNEL_HANDLE;
  status.readable = arrived(*channel);
  const bool has_ended = channel->peer_closed_ns >= 0 && channel->peer_closed_ns <= context_.now_ns;
  if (channel->error != 0)
    status.state = channel->error;
  else if (has_ended && channel->arriving.empty())
    status.state = RUNG_CHANNEL_CLOSED;
  else
    status.state = channel->is_open ? 1 : 0;
  if (!isLine(channel->settings.kind)) return 0;
  if (const Channel* const end = otherEnd(*channel))
    for (const Chunk& chunk : end->arriving)
      if (chunk.arrives_ns > context_.now_ns) status.unsent += static_cast<uint32_t>(chunk.bytes.size());
  if (status.unsent == 0 && channel->line_free_ns > context_.now_ns) status.unsent = 1;  // the other end is not open
  return 0;
}

uint32_t SimulatedChannels::takeStream(Channel& channel, void* bytes, uint64_t count, int64_t now_ns) {
  uint32_t taken = 0;
  while (taken < count && !channel.arriving.empty() && channel.arriving.front().arrives_ns <= now_ns) {
    std::string& chunk = channel.arriving.front().bytes;
    const auto part = static_cast<uint32_t>(std::min<uint64_t>(count - taken, chunk.size()));
    memcpy(static_cast<char*>(bytes) + taken, chunk.data(), part);
    taken += part;
    chunk.erase(0, part);
    if (chunk.empty()) channel.arriving.pop_front();
  }
  return taken;
}

int64_t SimulatedChannels::read(int64_t handle, void* bytes, uint64_t count, rung_endpoint* from) {
  settle();
  Channel* const channel = find(handle);
  if (channel == nullptr || isServer(channel->settings.kind) || channel->settings.kind == RUNG_CHANNEL_MODBUS_RTU ||
      channel->settings.kind == RUNG_CHANNEL_UDP_SENDER)
    return RUNG_CHANNEL_HANDLE;
  rung_channel_status now{};
  status(handle, now);
  if (now.readable == 0) return std::min(now.state, 0);
  if (!isDatagram(channel->settings.kind)) return takeStream(*channel, bytes, count, context_.now_ns);
  const Chunk chunk = std::move(channel->arriving.front());
  channel->arriving.pop_front();
  const size_t taken = std::min<uint64_t>(count, chunk.bytes.size());
  memcpy(bytes, chunk.bytes.data(), taken);
  if (from != nullptr) *from = chunk.from;
  return static_cast<int64_t>(taken);
}

// A character takes its time; where no one listens it is lost.
int64_t SimulatedChannels::sendOnLine(Channel& channel, const std::string& bytes) {
  Channel* const end = otherEnd(channel);
  const rung_channel_settings& own =
      channel.settings.kind != RUNG_CHANNEL_SERIAL_PEER || end == nullptr ? channel.settings : end->settings;
  channel.line_free_ns = std::max(channel.line_free_ns, context_.now_ns) + lineNs(own, bytes.size());
  if (end != nullptr) end->arriving.push_back({channel.line_free_ns, bytes, {}});
  return static_cast<int64_t>(bytes.size());
}

int64_t SimulatedChannels::send(Channel& channel, const void* bytes, uint64_t count, const rung_endpoint* to) {
  const std::string text(static_cast<const char*>(bytes), count);
  if (isLine(channel.settings.kind)) return sendOnLine(channel, text);
  if (!isDatagram(channel.settings.kind)) {
    Channel* const end = otherEnd(channel);
    if (end == nullptr) return static_cast<int64_t>(count);  // the peer is gone; this end does not know yet
    size_t on_way = 0;
    for (const Chunk& chunk : end->arriving) on_way += chunk.bytes.size();
    const size_t taken = std::min<size_t>(count, kStreamBytes - std::min<size_t>(kStreamBytes, on_way));
    if (taken > 0) end->arriving.push_back({context_.now_ns + kLatencyNs, text.substr(0, taken), {}});
    return static_cast<int64_t>(taken);
  }
  if (to == nullptr) return RUNG_CHANNEL_ADDRESS;
  const rung_endpoint from = {channel.address == 0 ? kLoopback : channel.address, channel.settings.port};
  for (Channel& other : channels_) {
    if (other.is_closed || other.settings.kind != RUNG_CHANNEL_UDP || other.settings.port != to->port ||
        !isAt(other.address, to->address) || other.arriving.size() >= kMostDatagrams)
      continue;
    other.arriving.push_back({context_.now_ns + kLatencyNs, text, from});
  }
  return static_cast<int64_t>(count);
}

int64_t SimulatedChannels::write(int64_t handle, const void* bytes, uint64_t count, const rung_endpoint* to) {
  settle();
  Channel* const channel = find(handle);
  if (channel == nullptr || channel->settings.kind == RUNG_CHANNEL_TCP_SERVER) return RUNG_CHANNEL_HANDLE;
  if (channel->settings.kind == RUNG_CHANNEL_MODBUS_TCP || channel->settings.kind == RUNG_CHANNEL_MODBUS_RTU) {
    if (count > RUNG_MODBUS_OUTPUT_BYTES) return RUNG_CHANNEL_LIMIT;
    image_.setRegisters(channel->server, bytes, static_cast<uint32_t>(count));
    return static_cast<int64_t>(count);
  }
  rung_channel_status now{};
  status(handle, now);
  if (now.state <= 0) return now.state;
  if (count > kMaxDatagram && isDatagram(channel->settings.kind)) return RUNG_CHANNEL_LIMIT;
  return send(*channel, bytes, std::min<uint64_t>(count, kMaxDatagram), to);
}

int64_t SimulatedChannels::close(int64_t handle) {
  settle();
  Channel* const channel = find(handle);
  if (channel == nullptr) return RUNG_CHANNEL_HANDLE;
  channel->is_closed = true;
  const auto tell = [&](int64_t other) {
    if (Channel* const end = find(other)) end->peer_closed_ns = context_.now_ns + kLatencyNs;
  };
  if (channel->peer != 0) tell(channel->peer);
  for (const int64_t end : channel->waiting) tell(find(end)->peer);
  for (Channel& other : channels_) {
    if (other.is_closed || other.master_of != handle || other.master == nullptr) continue;
    other.is_closed = true;
    tell(other.peer);
  }
  return 0;
}

// ---- Modbus servers

void SimulatedChannels::answerConnection(Channel& channel) {
  TcpMaster& master = *channel.master;
  const ServedImage::Server& server = channels_[static_cast<size_t>(channel.master_of - 1)].server;
  for (;;) {
    const uint32_t count = takeStream(channel, master.free(), master.room(), context_.now_ns);
    const bool is_modbus = master.receive(image_, server, count);
    if (master.replyBytes() > 0) send(channel, master.replies(), master.replyBytes(), nullptr);
    master.sent(master.replyBytes());
    if (!is_modbus) {
      channel.is_closed = true;
      if (Channel* const client = find(channel.peer)) client->peer_closed_ns = context_.now_ns + kLatencyNs;
      return;
    }
    if (count == 0 && !master.hasMore()) return;
  }
}

void SimulatedChannels::answerLine(Channel& channel) {
  uint8_t bytes[RUNG_MODBUS_MAX_RTU];
  while (!channel.arriving.empty() && channel.arriving.front().arrives_ns <= context_.now_ns) {
    const int64_t arrived_ns = channel.arriving.front().arrives_ns;
    const uint32_t count = takeStream(channel, bytes, sizeof bytes, arrived_ns);
    channel.line.receive(bytes, count, arrived_ns);
  }
  uint8_t reply[RUNG_MODBUS_MAX_RTU];
  const uint32_t size = channel.line.answer(image_, channel.server, context_.now_ns, reply);
  if (size > 0) send(channel, reply, size, nullptr);
}

void SimulatedChannels::answerMasters() {
  settle();
  for (size_t i = 0; i < channels_.size(); ++i) {
    Channel& channel = channels_[i];
    if (channel.is_closed) continue;
    if (channel.settings.kind == RUNG_CHANNEL_MODBUS_RTU) answerLine(channel);
    if (channel.master != nullptr) answerConnection(channel);
  }
}

}  // namespace rung::host
