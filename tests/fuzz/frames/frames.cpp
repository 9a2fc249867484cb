// SPDX-License-Identifier: Apache-2.0
// libFuzzer over every reader of frames. The input is what peers send: to the Modbus servers of the bundled host as a
// TCP stream and on a serial line, and to a program with the blocks of Modbus masters and of the freeport
// (plant.iecst). The first byte says where cuts and right checksums are. Built and run by `tools/long.sh frames`.
#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <vector>

#include "modbus_server.h"
#include "rung/modbus.h"
#include "rung/module.h"

extern "C" const rung_module* plant_module(void);

namespace {

using namespace rung::host;

struct Peer {
  const uint8_t* bytes = nullptr;
  size_t left = 0;
  uint8_t piece = 1;
  bool adds_checksum = false;
};
Peer peer;

int64_t openAny(void*, const rung_channel_settings* settings) { return settings->kind; }
int64_t statusOfAny(void*, int64_t, rung_channel_status* status) {
  *status = {1, static_cast<uint32_t>(std::min<size_t>(peer.left, 1000)), 0};
  return 0;
}
int64_t readAny(void*, int64_t channel, void* bytes, uint64_t count, rung_endpoint* from) {
  size_t size = std::min<size_t>({count, peer.left, peer.piece});
  memcpy(bytes, peer.bytes, size);
  peer.bytes += size;
  peer.left -= size;
  if (from != nullptr) *from = {0x7f000001, 5000};
  if (channel == RUNG_CHANNEL_SERIAL && peer.adds_checksum && size + 2 <= count && size > 0) {
    const uint16_t crc = rung_modbus_crc(static_cast<uint8_t*>(bytes), size);
    static_cast<uint8_t*>(bytes)[size++] = static_cast<uint8_t>(crc);
    static_cast<uint8_t*>(bytes)[size++] = static_cast<uint8_t>(crc >> 8);
  }
  return static_cast<int64_t>(size);
}
int64_t writeAny(void*, int64_t, const void* bytes, uint64_t count, const rung_endpoint*) {
  volatile uint8_t sum = 0;
  for (uint64_t i = 0; i < count; ++i) sum = static_cast<uint8_t>(sum + static_cast<const uint8_t*>(bytes)[i]);
  return static_cast<int64_t>(count);
}
int64_t closeAny(void*, int64_t) { return 0; }
const rung_channels kChannels = {openAny, statusOfAny, readAny, writeAny, closeAny};

// Blocks and areas of the program, each of exactly its size.
struct Plant {
  const rung_module* module = plant_module();
  std::vector<std::unique_ptr<uint64_t[]>> memory;
  std::vector<void*> blocks;
  std::vector<uint8_t*> areas;
  rung_host host{};
  rung_context context{};

  void* take(uint64_t size) {
    memory.push_back(std::make_unique<uint64_t[]>((size + 7) / 8));
    return memory.back().get();
  }
  Plant() {
    for (uint32_t i = 0; i < module->blocks.count; ++i) blocks.push_back(take(rung_block_at(module, i)->size));
    for (uint32_t i = 0; i < module->areas.count; ++i)
      areas.push_back(static_cast<uint8_t*>(take(rung_area_at(module, i)->size + 8)));
    host.channels = &kChannels;
    context.module = module;
    context.host = &host;
    context.blocks = blocks.data();
    context.areas = areas.data();
  }
  void run() {
    if (rung_guarded(&context, module->init) != RUNG_FAULT_NONE) abort();
    for (int cycle = 0; cycle < 20; ++cycle) {
      context.now_ns = cycle * INT64_C(10000000);
      if (rung_guarded(&context, rung_task_at(module, 0)->run) != RUNG_FAULT_NONE) abort();
    }
  }
};

void serve(const uint8_t* bytes, size_t count, uint8_t piece) {
  static uint8_t inputs[RUNG_MODBUS_INPUT_BYTES], outputs[600], memory[100];
  static rung_area areas[3] = {{0, 0, sizeof inputs, RUNG_AREA_INPUT},
                               {0, 0, sizeof outputs, RUNG_AREA_OUTPUT},
                               {0, 0, sizeof memory, RUNG_AREA_MEMORY}};
  static uint8_t* pointers[3] = {inputs, outputs, memory};
  rung_module module{};
  module.areas = {areas, 3, sizeof areas[0]};
  const LoadedModule loaded(module);
  ServedImage image(loaded);
  image.use();
  image.exchange(pointers);
  ServedImage::Server server;
  server.unit = 1;
  TcpMaster master;
  master.clear();
  for (size_t at = 0; at < count;) {
    const size_t size = std::min<size_t>({piece, master.room(), count - at});
    std::copy_n(bytes + at, size, master.free());
    at += size;
    if (!master.receive(image, server, static_cast<uint32_t>(size))) break;
    master.sent(master.replyBytes());
  }
  rung_channel_settings settings{};
  settings.rate = 19200;
  settings.data_bits = 8;
  settings.stop_bits = 1;
  RtuLine line;
  line.open(settings);
  int64_t now = 0;
  for (size_t at = 0; at < count; at += piece) {
    uint8_t frame[256], reply[RUNG_MODBUS_MAX_RTU];
    const size_t size = std::min<size_t>(std::min<size_t>(piece, 250), count - at);
    std::copy_n(bytes + at, size, frame);
    const uint16_t crc = rung_modbus_crc(frame, size);
    frame[size] = static_cast<uint8_t>(crc);
    frame[size + 1] = static_cast<uint8_t>(crc >> 8);
    line.receive(frame, size + 2, now);
    now += 5'000'000;
    line.answer(image, server, now, reply);
  }
  image.exchange(pointers);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static Plant plant;
  if (size < 2) return 0;
  const uint8_t piece = static_cast<uint8_t>(1 + data[0] % 240);
  serve(data + 1, size - 1, piece);
  peer = {data + 1, size - 1, piece, (data[0] & 1) != 0};
  plant.run();
  return 0;
}
