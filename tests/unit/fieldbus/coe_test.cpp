// SPDX-License-Identifier: Apache-2.0
// CANopen over EtherCAT: frames of the SDO service byte by byte, and transfers of every length.
#include "fieldbus/coe.h"

#include <gtest/gtest.h>

#include <string.h>

#include <map>
#include <string>

namespace rung::fieldbus {
namespace {

struct Store {
  std::map<uint32_t, std::string> objects;
};

uint32_t readStore(void* owner, uint16_t index, uint8_t subindex, uint8_t* bytes, size_t capacity, size_t* size) {
  const auto& objects = static_cast<Store*>(owner)->objects;
  const auto found = objects.find(uint32_t{index} << 8 | subindex);
  if (found == objects.end()) return kSdoNoObject;
  if (found->second.size() > capacity) return kSdoMemory;
  memcpy(bytes, found->second.data(), found->second.size());
  *size = found->second.size();
  return kSdoOk;
}

uint32_t writeStore(void* owner, uint16_t index, uint8_t subindex, const uint8_t* bytes, size_t size) {
  if (index == 0x1008) return kSdoReadOnly;
  static_cast<Store*>(owner)->objects[uint32_t{index} << 8 | subindex] =
      std::string(reinterpret_cast<const char*>(bytes), size);
  return kSdoOk;
}

struct Line {
  Store store;
  Dictionary dictionary = {&store, readStore, writeStore};
  SdoTransfer client = {}, server = {};
  uint8_t request[kMailboxBytes] = {}, answer[kMailboxBytes] = {};
  size_t request_size = 0, answer_size = 0;
  int frames = 0;

  uint32_t finish(size_t mailbox_bytes) {
    for (;;) {
      ++frames;
      answer_size = answerSdo(server, dictionary, request, request_size, answer, mailbox_bytes);
      const SdoProgress progress = continueSdo(client, answer, answer_size, 1, request, mailbox_bytes);
      if (progress.is_done) return progress.abort;
      request_size = progress.request_size;
    }
  }
  uint32_t upload(uint16_t index, uint8_t subindex, size_t mailbox_bytes) {
    request_size = beginUpload(client, index, subindex, 1, request);
    return finish(mailbox_bytes);
  }
  uint32_t download(uint16_t index, uint8_t subindex, const std::string& value, size_t mailbox_bytes) {
    request_size = beginDownload(client, index, subindex, reinterpret_cast<const uint8_t*>(value.data()), value.size(),
                                 1, request, mailbox_bytes);
    return finish(mailbox_bytes);
  }
};

// TM/TP manual, table 2-8.
TEST(Coe, HeaderAndTypes) {
  EXPECT_EQ(0x2000, coeHeader(CoeService::SdoRequest, 0));
  EXPECT_EQ(0x51FF, coeHeader(CoeService::RxPdo, 0x1FF));
  EXPECT_EQ(CoeService::TxPdo, coeServiceOf(0x4001));
  EXPECT_EQ(1, pdoNumberOf(0x4001));
  const CoeService services[] = {CoeService::Emergency,
                                 CoeService::SdoRequest,
                                 CoeService::SdoResponse,
                                 CoeService::TxPdo,
                                 CoeService::RxPdo,
                                 CoeService::TxPdoRemoteRequest,
                                 CoeService::RxPdoRemoteRequest,
                                 CoeService::SdoInformation};
  for (int i = 0; i < 8; ++i) EXPECT_EQ(i + 1, static_cast<int>(services[i]));
}

// TM/TP manual, table 2-4.
TEST(Coe, AreasOfTheDictionary) {
  EXPECT_EQ(ObjectArea::DataType, areaOf(0x0FFF));
  EXPECT_EQ(ObjectArea::Communication, areaOf(0x1000));
  EXPECT_EQ(ObjectArea::Manufacturer, areaOf(0x2000));
  EXPECT_EQ(ObjectArea::Profile, areaOf(0x6000));
  EXPECT_EQ(ObjectArea::Profile, areaOf(0x9FFF));
  EXPECT_EQ(ObjectArea::Reserved, areaOf(0xA000));
}

TEST(Coe, ExpeditedFrames) {
  Line line;
  line.store.objects[0x609901] = std::string("\x10\x27\0\0", 4);
  EXPECT_EQ(kSdoOk, line.upload(0x6099, 1, 128));
  // Length 10, station 0, CoE with counter 1; type 2; upload of 6099h:01.
  const uint8_t answer[] = {10, 0, 0, 0, 0, 0x13, 0x00, 0x30, 0x43, 0x99, 0x60, 1, 0x10, 0x27, 0, 0};
  ASSERT_EQ(sizeof answer, line.answer_size);
  EXPECT_EQ(0, memcmp(answer, line.answer, sizeof answer));
  EXPECT_EQ(kSdoOk, line.download(0x6098, 0, "\x23", 128));
  const uint8_t request[] = {10, 0, 0, 0, 0, 0x13, 0x00, 0x20, 0x2F, 0x98, 0x60, 0, 0x23, 0, 0, 0};
  EXPECT_EQ(0, memcmp(request, line.request, sizeof request));
  EXPECT_EQ(0x60, line.answer[8]);
  EXPECT_EQ("\x23", line.store.objects[0x609800]);
}

// A normal transfer has its size in the 4 data bytes, and at most the mailbox minus 16 bytes of data.
TEST(Coe, NormalTransferUpToTheMailboxMinus16) {
  Line line;
  line.store.objects[0x100800] = std::string(112, 'x');
  EXPECT_EQ(kSdoOk, line.upload(0x1008, 0, 128));
  EXPECT_EQ(1, line.frames);
  EXPECT_EQ(0x41, line.answer[8]);
  EXPECT_EQ(112, line.answer[12]);
  EXPECT_EQ(128u, line.answer_size);
  line.frames = 0;
  line.store.objects[0x100800] = std::string(113, 'x');
  EXPECT_EQ(kSdoOk, line.upload(0x1008, 0, 128));
  EXPECT_EQ(2, line.frames) << "one byte more needs a segment";
  EXPECT_EQ(113u, line.client.size);
}

TEST(Coe, TransfersOfEveryLength) {
  for (const size_t mailbox : {24u, 48u, 128u})
    for (size_t size = 1; size <= 300; ++size) {
      Line line;
      std::string value(size, ' ');
      for (size_t i = 0; i < size; ++i) value[i] = static_cast<char>(i * 7 + size);
      ASSERT_EQ(kSdoOk, line.download(0x2000, 1, value, mailbox)) << size << " in " << mailbox;
      ASSERT_EQ(value, line.store.objects[0x200001]);
      ASSERT_EQ(kSdoOk, line.upload(0x2000, 1, mailbox));
      ASSERT_EQ(value, std::string(reinterpret_cast<char*>(line.client.bytes), line.client.size));
    }
}

TEST(Coe, Aborts) {
  Line line;
  EXPECT_EQ(kSdoNoObject, line.upload(0x3000, 0, 128));
  EXPECT_EQ(0x80, line.answer[8]);
  EXPECT_EQ(kSdoReadOnly, line.download(0x1008, 0, "abc", 128));
  EXPECT_EQ(kSdoReadOnly, line.download(0x1008, 0, std::string(200, 'x'), 48));
}

TEST(Coe, ASegmentOutOfTurnIsAborted) {
  Line line;
  line.store.objects[0x100800] = std::string(200, 'x');
  line.request_size = beginUpload(line.client, 0x1008, 0, 1, line.request);
  line.answer_size = answerSdo(line.server, line.dictionary, line.request, line.request_size, line.answer, 48);
  SdoProgress progress = continueSdo(line.client, line.answer, line.answer_size, 2, line.request, 48);
  line.request[8] ^= 0x10;  // the toggle bit
  line.answer_size = answerSdo(line.server, line.dictionary, line.request, progress.request_size, line.answer, 48);
  EXPECT_EQ(0x80, line.answer[8]);
  EXPECT_EQ(0x05, line.answer[15]);
  EXPECT_EQ(0x03, line.answer[14]);
  EXPECT_FALSE(line.server.is_active);
  progress = continueSdo(line.client, line.answer, line.answer_size, 2, line.request, 48);
  EXPECT_TRUE(progress.is_done);
  EXPECT_EQ(kSdoToggle, progress.abort);
}

TEST(Coe, OtherMailboxesGetNoAnswer) {
  Line line;
  line.request_size = beginUpload(line.client, 0x1000, 0, 1, line.request);
  line.request[5] = 0x15;  // SoE
  EXPECT_EQ(0u, answerSdo(line.server, line.dictionary, line.request, line.request_size, line.answer, 128));
  EXPECT_EQ(0u, answerSdo(line.server, line.dictionary, line.request, 4, line.answer, 128));
}

// TM/TP manual, table 2-7.
TEST(Coe, MappingEntries) {
  EXPECT_EQ(0x60400010u, mappingEntry({0x6040, 0, 16}));
  EXPECT_EQ(0x607A0020u, mappingEntry({0x607A, 0, 32}));
  EXPECT_EQ(0x60710010u, mappingEntry({0x6071, 0, 16}));
  EXPECT_EQ(0x60870020u, mappingEntry({0x6087, 0, 32}));
  EXPECT_EQ(0x60730010u, mappingEntry({0x6073, 0, 16}));
  EXPECT_EQ(0x60750020u, mappingEntry({0x6075, 0, 32}));
  EXPECT_EQ(0x60FE, mappedObject(0x60FE0120).index);
  EXPECT_EQ(1, mappedObject(0x60FE0120).subindex);
  EXPECT_EQ(0x1C10, assignmentOf(0));
  EXPECT_EQ(0x1C12, assignmentOf(2));
  EXPECT_EQ(0x1C2F, assignmentOf(31));
}

}  // namespace
}  // namespace rung::fieldbus
