// SPDX-License-Identifier: Apache-2.0
// Frames and answers of the Modbus servers. Hostile frames: random and corrupted ones never read or write outside of
// their buffers (each is in memory of exactly its size, for the preset asan) and get the answers of a second, slow
// implementation. RUNG_MUTATION_SEED and RUNG_MUTATION_COUNT try other ones.
#include "rung/modbus.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <random>
#include <vector>

#include "stdlib/runtime/host/modbus_server.h"

namespace rung::host {
namespace {

using Bytes = std::vector<uint8_t>;

uint32_t setting(const char* name, uint32_t otherwise) {
  const char* const value = std::getenv(name);
  return value == nullptr ? otherwise : static_cast<uint32_t>(std::strtoul(value, nullptr, 10));
}

// A module with the areas that its image needs.
struct Module {
  rung_area areas[3] = {
      {0, 0, RUNG_MODBUS_INPUT_BYTES, RUNG_AREA_INPUT}, {0, 0, 600, RUNG_AREA_OUTPUT}, {0, 0, 100, RUNG_AREA_MEMORY}};
  Bytes inputs = Bytes(RUNG_MODBUS_INPUT_BYTES), outputs = Bytes(600), memory = Bytes(100);
  uint8_t* pointers[3] = {inputs.data(), outputs.data(), memory.data()};
  rung_module description{};
  LoadedModule module;
  Module() : module(withAreas()) {}

 private:
  const rung_module& withAreas() {
    description.areas = {areas, 3, sizeof areas[0]};
    return description;
  }
};

// The image as one bit after the other, and the answers as the specification has them, one bit at a time.
struct Model {
  std::vector<bool> inputs = std::vector<bool>(RUNG_MODBUS_INPUT_BYTES * 8);
  std::vector<bool> outputs = std::vector<bool>(RUNG_MODBUS_OUTPUT_BYTES * 8);
  std::vector<bool> memory = std::vector<bool>(RUNG_MODBUS_MEMORY_BYTES * 8);

  static int word(const Bytes& bytes, size_t at) { return bytes[at] * 256 + bytes[at + 1]; }
  // The bit of a coil or input; -1: illegal.
  std::vector<bool>* bit(int function, int address, size_t& at) {
    at = static_cast<size_t>(address);
    if (function == 2) return address < 4096 ? &inputs : nullptr;
    if (address < 4096) return &outputs;
    at = static_cast<size_t>(address - 5000);
    return address >= 5000 && address <= 65527 ? &memory : nullptr;
  }
  std::vector<bool>* firstBit(int function, int address, size_t& at) {
    at = static_cast<size_t>(address) * 16;
    if (function == 4) return address < 512 ? &inputs : nullptr;
    if (address < 512) return &outputs;
    at = static_cast<size_t>(address - 5000) * 16;
    return address >= 5000 && address <= 5000 + 8192 ? &memory : nullptr;
  }
  // All items are in one part of the image.
  template <class Find>
  bool areLegal(int address, int count, Find find) {
    const std::vector<bool>* part = nullptr;
    for (int i = 0; i < count; ++i) {
      size_t at = 0;
      const std::vector<bool>* const its = find(address + i, at);
      if (its == nullptr || (part != nullptr && its != part)) return false;
      part = its;
    }
    return true;
  }
  static Bytes refuse(const Bytes& request, uint8_t exception) {
    return {static_cast<uint8_t>(request[0] | 0x80), exception};
  }
  Bytes answer(const Bytes& request) {
    const int function = request[0];
    const bool is_bits = function == 1 || function == 2 || function == 5 || function == 15;
    const auto find = [&](int address, size_t& at) {
      return is_bits ? bit(function, address, at) : firstBit(function, address, at);
    };
    if ((function < 1 || function > 6) && function != 15 && function != 16) return refuse(request, 1);
    const bool is_long = function > 6;
    if (is_long ? request.size() < 6 : request.size() != 5) return refuse(request, 3);
    const int address = word(request, 1), value = word(request, 3);
    if (function == 5 && value != 0 && value != 0xff00) return refuse(request, 3);
    const int count = function == 5 || function == 6 ? 1 : value;
    const int most = function <= 2 ? 2000 : function <= 4 ? 125 : function == 15 ? 1968 : 123;
    if (count < 1 || count > most) return refuse(request, 3);
    const int bytes = is_bits ? (count + 7) / 8 : count * 2;
    if (is_long && (request[5] != bytes || request.size() != static_cast<size_t>(6 + bytes))) return refuse(request, 3);
    if (!areLegal(address, count, find)) return refuse(request, 2);
    Bytes reply = {request[0]};
    if (function <= 4) {
      reply.push_back(static_cast<uint8_t>(bytes));
      reply.resize(static_cast<size_t>(2 + bytes));
    } else {
      reply.assign(request.begin(), request.begin() + 5);
    }
    for (int i = 0; i < count; ++i) {
      for (int k = 0; k < (is_bits ? 1 : 16); ++k) {
        size_t at = 0;
        std::vector<bool>& part = *find(address + i, at);
        const size_t in_frame = is_bits ? static_cast<size_t>(i) : static_cast<size_t>(i * 16 + (k ^ 8));
        if (function <= 4) {
          if (part[at + static_cast<size_t>(k)]) reply[2 + in_frame / 8] |= static_cast<uint8_t>(1 << in_frame % 8);
        } else if (function == 5) {
          part[at] = value != 0;
        } else if (function == 6) {
          part[at + static_cast<size_t>(k)] = (value >> k & 1) != 0;
        } else {
          part[at + static_cast<size_t>(k)] = (request[6 + in_frame / 8] >> in_frame % 8 & 1) != 0;
        }
      }
    }
    return reply;
  }
};

// Requests of which most are legal or nearly so.
class Requests {
 public:
  explicit Requests(uint32_t seed) : random_(seed) {}
  uint32_t below(uint32_t bound) { return std::uniform_int_distribution<uint32_t>(0, bound - 1)(random_); }
  Bytes next() {
    static const uint8_t functions[] = {1, 2, 3, 4, 5, 6, 15, 16, 7, 0, 43, 129};
    static const uint32_t addresses[] = {0, 100, 505, 512, 4090, 4999, 5000, 5100, 13190, 13193, 65520, 65535};
    const uint8_t function = functions[below(below(4) == 0 ? 12 : 8)];
    const uint32_t address = (addresses[below(12)] + below(8)) & 0xffff;
    uint32_t count = below(8) == 0 ? below(65536) : 1 + below(below(3) == 0 ? 2010 : 130);
    if (function == 5) count = below(4) == 0 ? count : below(2) * 0xff00;
    Bytes request = {function, high(address), low(address), high(count), low(count)};
    if (function == 15 || function == 16) {
      const uint32_t bytes = function == 15 ? (count + 7) / 8 : count * 2;
      request.push_back(low(bytes));
      for (uint32_t i = 0; i < bytes && request.size() < RUNG_MODBUS_MAX_UNIT; ++i)
        request.push_back(static_cast<uint8_t>(below(256)));
    }
    if (below(10) == 0) request.resize(1 + below(RUNG_MODBUS_MAX_UNIT));
    if (below(10) == 0) request[below(static_cast<uint32_t>(request.size()))] = static_cast<uint8_t>(below(256));
    return request;
  }
  Bytes noise(uint32_t most) {
    Bytes bytes(below(most));
    for (uint8_t& byte : bytes) byte = static_cast<uint8_t>(below(256));
    return bytes;
  }

 private:
  static uint8_t high(uint32_t value) { return static_cast<uint8_t>(value >> 8); }
  static uint8_t low(uint32_t value) { return static_cast<uint8_t>(value); }
  std::mt19937 random_;
};

Bytes onTcp(const Bytes& unit, uint8_t number, uint16_t transaction) {
  Bytes frame = {static_cast<uint8_t>(transaction >> 8),       static_cast<uint8_t>(transaction),     0,     0,
                 static_cast<uint8_t>((unit.size() + 1) >> 8), static_cast<uint8_t>(unit.size() + 1), number};
  frame.insert(frame.end(), unit.begin(), unit.end());
  return frame;
}

Bytes onLine(const Bytes& unit, uint8_t number) {
  Bytes frame = {number};
  frame.insert(frame.end(), unit.begin(), unit.end());
  const uint16_t crc = rung_modbus_crc(frame.data(), frame.size());
  frame.push_back(static_cast<uint8_t>(crc));
  frame.push_back(static_cast<uint8_t>(crc >> 8));
  return frame;
}

TEST(Modbus, ChecksumOfTheSpecification) {
  // MODBUS over Serial Line 1.02, appendix B: 02 07 gives 41 12.
  const uint8_t bytes[] = {2, 7};
  EXPECT_EQ(rung_modbus_crc(bytes, 2), 0x1241);
  EXPECT_EQ(rung_modbus_crc(bytes, 0), 0xffff);
}

TEST(Modbus, AnswersAreThoseOfTheModel) {
  Requests requests(setting("RUNG_MUTATION_SEED", 1));
  Module module;
  for (uint8_t& byte : module.inputs) byte = static_cast<uint8_t>(requests.below(256));
  ServedImage image(module.module);
  image.use();
  image.exchange(module.pointers);
  Model model;
  for (size_t i = 0; i < model.inputs.size(); ++i) model.inputs[i] = (module.inputs[i / 8] >> i % 8 & 1) != 0;
  ServedImage::Server server;
  server.unit = 9;
  const uint32_t count = setting("RUNG_MUTATION_COUNT", 20000);
  uint32_t normal = 0;
  for (uint32_t i = 0; i < count; ++i) {
    const Bytes request = requests.next(), frame = onTcp(request, 9, static_cast<uint16_t>(i));
    Bytes reply(RUNG_MODBUS_MAX_TCP);
    reply.resize(image.answerTcp(server, Bytes(frame).data(), reply.data()));
    const Bytes expected = onTcp(model.answer(request), 9, static_cast<uint16_t>(i));
    ASSERT_EQ(reply, expected) << "request " << i;
    normal += expected[7] < 0x80;
    if (i % 16 == 0) image.exchange(module.pointers);
  }
  EXPECT_GT(normal, count / 5) << "the requests are not hostile only";
  // What was written has entered the parts of the image that the program has, and only those.
  image.exchange(module.pointers);
  for (size_t i = 0; i < module.outputs.size() * 8; ++i)
    ASSERT_EQ((module.outputs[i / 8] >> i % 8 & 1) != 0, model.outputs[i]) << "output bit " << i;
  for (size_t i = 0; i < module.memory.size() * 8; ++i)
    ASSERT_EQ((module.memory[i / 8] >> i % 8 & 1) != 0, model.memory[i]) << "memory bit " << i;
}

// A bit that a master does not write keeps what the program writes meanwhile.
TEST(Modbus, OnlyWrittenBitsEnterTheImage) {
  Module module;
  ServedImage image(module.module);
  image.use();
  EXPECT_FALSE(image.isReady());
  image.exchange(module.pointers);
  EXPECT_TRUE(image.isReady());
  ServedImage::Server server;
  server.unit = 1;
  uint8_t reply[RUNG_MODBUS_MAX_TCP];
  const Bytes frame = onTcp({5, 0, 3, 0xff, 0}, 1, 1);  // %QX0.3
  EXPECT_EQ(image.answerTcp(server, frame.data(), reply), 12u);
  EXPECT_EQ(module.outputs[0], 0) << "until the border";
  module.outputs[0] = 0x81;
  image.exchange(module.pointers);
  EXPECT_EQ(module.outputs[0], 0x89);
  module.outputs[0] = 0;
  image.exchange(module.pointers);
  EXPECT_EQ(module.outputs[0], 0) << "written once";
}

TEST(Modbus, FramesOfTcpEndWhereTheirLengthSays) {
  Requests requests(setting("RUNG_MUTATION_SEED", 2));
  const uint32_t count = setting("RUNG_MUTATION_COUNT", 20000);
  for (uint32_t i = 0; i < count; ++i) {
    const Bytes frame = onTcp(requests.next(), 1, static_cast<uint16_t>(requests.below(65536)));
    const size_t part = requests.below(static_cast<uint32_t>(frame.size()));
    const Bytes begin(frame.begin(), frame.begin() + static_cast<ptrdiff_t>(part));
    EXPECT_EQ(rung_modbus_tcp_frame(begin.data(), begin.size()), 0) << "half a frame";
    EXPECT_EQ(rung_modbus_tcp_frame(frame.data(), frame.size()), static_cast<int32_t>(frame.size()));
    const Bytes noise = requests.noise(300);
    const int32_t found = rung_modbus_tcp_frame(noise.data(), noise.size());
    ASSERT_LE(found, static_cast<int32_t>(noise.size()));
    ASSERT_TRUE(found == 0 || found == -1 || (noise[2] == 0 && noise[3] == 0 && found >= 8));
  }
}

TEST(Modbus, FramesOfALineNeedTheirChecksum) {
  Requests requests(setting("RUNG_MUTATION_SEED", 3));
  const uint32_t count = setting("RUNG_MUTATION_COUNT", 20000);
  for (uint32_t i = 0; i < count; ++i) {
    Bytes frame = onLine(requests.next(), static_cast<uint8_t>(1 + requests.below(247)));
    const int32_t found = rung_modbus_rtu_request(frame.data(), frame.size());
    ASSERT_LE(found, static_cast<int32_t>(frame.size()));
    if (found == static_cast<int32_t>(frame.size())) {
      frame[requests.below(static_cast<uint32_t>(frame.size()))] ^= static_cast<uint8_t>(1 + requests.below(255));
      ASSERT_NE(rung_modbus_rtu_request(frame.data(), frame.size()), static_cast<int32_t>(frame.size()));
    }
    const Bytes noise = requests.noise(300);
    ASSERT_LE(rung_modbus_rtu_request(noise.data(), noise.size()), static_cast<int32_t>(noise.size()));
  }
}

// 9 bytes more than it announces are longer than a frame may be: nothing that follows could make it one.
TEST(Modbus, FramesOfALineHaveALimit) {
  for (const uint8_t function : {uint8_t{15}, uint8_t{16}}) {
    const uint8_t longest[] = {1, function, 0, 0, 0, 1, 247}, longer[] = {1, function, 0, 0, 0, 1, 248};
    EXPECT_EQ(rung_modbus_rtu_request(longest, sizeof longest), 0);
    EXPECT_EQ(rung_modbus_rtu_request(longer, sizeof longer), -1);
  }
}

// However the bytes of pipelined requests are cut, the replies are the same; and they have a bound.
TEST(Modbus, PiecesOfAStreamDoNotMatter) {
  Requests requests(setting("RUNG_MUTATION_SEED", 4));
  Module module;
  ServedImage image(module.module), other(module.module);
  image.use();
  image.exchange(module.pointers);
  other.use();
  other.exchange(module.pointers);
  ServedImage::Server server;
  server.unit = 1;
  Bytes stream, expected;
  for (uint16_t i = 0; i < 2000; ++i) {
    const Bytes frame = onTcp(requests.next(), static_cast<uint8_t>(requests.below(3)), i);
    stream.insert(stream.end(), frame.begin(), frame.end());
    uint8_t reply[RUNG_MODBUS_MAX_TCP];
    const uint32_t size = other.answerTcp(server, frame.data(), reply);
    expected.insert(expected.end(), reply, reply + size);
  }
  TcpMaster master;
  master.clear();
  Bytes replies;
  for (size_t at = 0; at < stream.size() || master.hasMore();) {
    const size_t piece = std::min<size_t>({1 + requests.below(900), master.room(), stream.size() - at});
    std::copy_n(stream.begin() + static_cast<ptrdiff_t>(at), piece, master.free());
    at += piece;
    ASSERT_TRUE(master.receive(image, server, static_cast<uint32_t>(piece)));
    const uint32_t taken = requests.below(master.replyBytes() + 1);  // a master that reads slowly
    ASSERT_LE(master.replyBytes(), TcpMaster::kReplyBytes);
    replies.insert(replies.end(), master.replies(), master.replies() + taken);
    master.sent(taken);
  }
  replies.insert(replies.end(), master.replies(), master.replies() + master.replyBytes());
  EXPECT_EQ(replies, expected);
}

TEST(Modbus, NoiseEndsAStream) {
  Requests requests(setting("RUNG_MUTATION_SEED", 5));
  Module module;
  ServedImage image(module.module);
  ServedImage::Server server;
  server.unit = 1;
  uint32_t ended = 0;
  for (int i = 0; i < 2000; ++i) {
    TcpMaster master;
    master.clear();
    bool goes_on = true;
    for (int piece = 0; piece < 50 && goes_on; ++piece) {
      const Bytes noise = requests.noise(std::min(200u, master.room() + 1));
      std::copy(noise.begin(), noise.end(), master.free());
      goes_on = master.receive(image, server, static_cast<uint32_t>(noise.size()));
      master.sent(master.replyBytes());
      ASSERT_LE(master.room(), 1024u);
    }
    ended += !goes_on;
  }
  EXPECT_EQ(ended, 2000u);
}

// On a line every right request is answered after any noise, when a silence has been between them.
TEST(Modbus, ALineRecovers) {
  Requests requests(setting("RUNG_MUTATION_SEED", 6));
  Module module;
  ServedImage image(module.module);
  ServedImage::Server server;
  server.unit = 17;
  rung_channel_settings settings{};
  settings.rate = 9600;
  settings.data_bits = 8;
  settings.stop_bits = 1;
  RtuLine line;
  line.open(settings);
  EXPECT_EQ(line.dueNs(), INT64_MAX);
  int64_t now = 0;
  uint8_t reply[RUNG_MODBUS_MAX_RTU];
  const auto pass = [&](int64_t until) {
    uint32_t size = 0;
    while (size == 0 && line.dueNs() <= until) size = line.answer(image, server, line.dueNs(), reply);
    now = until;
    return size;
  };
  for (int i = 0; i < 3000; ++i) {
    for (uint32_t pieces = requests.below(4); pieces > 0; --pieces) {
      const Bytes noise = requests.noise(400);
      line.receive(noise.data(), noise.size(), now);
      pass(now + requests.below(30'000'000));
    }
    pass(now + 200'000'000);
    const Bytes frame = onLine({3, 0, 0, 0, 1}, 17);  // in two parts, as a driver may give them
    const size_t cut = requests.below(static_cast<uint32_t>(frame.size()));
    line.receive(frame.data(), cut, now);
    EXPECT_EQ(pass(now + requests.below(3'000'000)), 0u);
    line.receive(frame.data() + cut, frame.size() - cut, now);
    EXPECT_EQ(line.answer(image, server, now + 3'645'832, reply), 0u) << "3.5 characters of 10 bits are 3.65 ms";
    EXPECT_EQ(pass(now + 3'645'834), 7u);
    EXPECT_EQ(reply[0], 17);
    EXPECT_EQ(line.dueNs(), INT64_MAX);
  }
}

}  // namespace
}  // namespace rung::host
