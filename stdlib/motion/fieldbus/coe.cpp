// SPDX-License-Identifier: Apache-2.0
// CANopen over EtherCAT: see coe.h. A mailbox is its header (6 bytes), the CoE header (2), the command of the SDO (1),
// index (2), subindex (1), 4 bytes of data or size, and in a normal transfer the data: its capacity minus 16.
#include "fieldbus/coe.h"

#include <string.h>

namespace rung::fieldbus {
namespace {

constexpr size_t kSdoAt = kMailboxHeaderBytes + 2, kDataAt = kSdoAt + 4, kLongDataAt = kSdoAt + 8,
                 kSegmentAt = kSdoAt + 1;
constexpr size_t kShortestSegment = 7;

enum Command : uint8_t {
  kDownloadSegment = 0x00,
  kDownload = 0x20,
  kUpload = 0x40,
  kUploadSegment = 0x60,
  kAbort = 0x80,
  kCommandBits = 0xE0,
  kToggle = 0x10,
  kExpedited = 2,
  kSizeGiven = 1,
  kLast = 1
};

uint32_t read32(const uint8_t* bytes) {
  return bytes[0] | uint32_t{bytes[1]} << 8 | uint32_t{bytes[2]} << 16 | uint32_t{bytes[3]} << 24;
}

void write32(uint8_t* bytes, uint32_t value) {
  for (int i = 0; i < 4; ++i) bytes[i] = static_cast<uint8_t>(value >> 8 * i);
}

size_t smaller(size_t a, size_t b) { return a < b ? a : b; }

// Fills in both headers around `size` bytes in all.
size_t close(uint8_t* mailbox, CoeService service, uint8_t counter, size_t size) {
  MailboxHeader header = {};
  header.length = static_cast<uint16_t>(size - kMailboxHeaderBytes);
  header.type = MailboxType::CoE;
  header.counter = counter;
  writeHeader(header, mailbox);
  const uint16_t coe = coeHeader(service, 0);
  mailbox[6] = static_cast<uint8_t>(coe);
  mailbox[7] = static_cast<uint8_t>(coe >> 8);
  return size;
}

void writeObject(uint8_t* mailbox, uint8_t command, uint16_t index, uint8_t subindex) {
  memset(mailbox + kSdoAt, 0, 8);
  mailbox[kSdoAt] = command;
  mailbox[kSdoAt + 1] = static_cast<uint8_t>(index);
  mailbox[kSdoAt + 2] = static_cast<uint8_t>(index >> 8);
  mailbox[kSdoAt + 3] = subindex;
}

uint16_t indexOf(const uint8_t* mailbox) {
  return static_cast<uint16_t>(mailbox[kSdoAt + 1] | mailbox[kSdoAt + 2] << 8);
}

// The next part of transfer.bytes in a segment: at least 7 bytes, the rest of them unused.
size_t writeSegment(SdoTransfer& transfer, uint8_t command, uint8_t* mailbox, size_t mailbox_bytes) {
  const size_t part = smaller(transfer.size - transfer.done, mailbox_bytes - kSegmentAt);
  const bool is_last = transfer.done + part == transfer.size;
  const size_t unused = part < kShortestSegment ? kShortestSegment - part : 0;
  memset(mailbox + kSegmentAt, 0, kShortestSegment);
  memcpy(mailbox + kSegmentAt, transfer.bytes + transfer.done, part);
  mailbox[kSdoAt] =
      static_cast<uint8_t>(command | (transfer.toggle ? kToggle : 0) | unused << 1 | (is_last ? kLast : 0));
  transfer.done += part;
  transfer.is_active = !is_last;
  return kSegmentAt + part + unused;
}

// Takes a segment in. False: it does not fit.
bool readSegment(SdoTransfer& transfer, const uint8_t* mailbox, size_t size) {
  const uint8_t command = mailbox[kSdoAt];
  size_t part = size - kSegmentAt;
  if (part == kShortestSegment) part -= command >> 1 & 7;
  if (transfer.done + part > transfer.size || transfer.done + part > kSdoBytes) return false;
  memcpy(transfer.bytes + transfer.done, mailbox + kSegmentAt, part);
  transfer.done += part;
  transfer.is_active = (command & kLast) == 0;
  return true;
}

class Server {
 public:
  Server(SdoTransfer& transfer, const Dictionary& dictionary, const uint8_t* request, size_t size, uint8_t* answer,
         size_t mailbox_bytes)
      : transfer_(transfer),
        dictionary_(dictionary),
        request_(request),
        size_(size),
        answer_(answer),
        mailbox_bytes_(mailbox_bytes) {}

  size_t run() {
    switch (request_[kSdoAt] & kCommandBits) {
      case kUpload: return upload();
      case kUploadSegment: return uploadSegment();
      case kDownload: return download();
      case kDownloadSegment: return downloadSegment();
      case kAbort: transfer_.is_active = false; return 0;
      default: return abort(kSdoCommand);
    }
  }

 private:
  size_t finish(size_t size) { return close(answer_, CoeService::SdoResponse, readHeader(request_).counter, size); }

  size_t abort(uint32_t code) {
    transfer_.is_active = false;
    writeObject(answer_, kAbort, transfer_.index, transfer_.subindex);
    write32(answer_ + kDataAt, code);
    return finish(kLongDataAt);
  }

  void begin(bool is_upload) {
    transfer_.is_active = false;
    transfer_.is_upload = is_upload;
    transfer_.toggle = false;
    transfer_.index = indexOf(request_);
    transfer_.subindex = request_[kSdoAt + 3];
    transfer_.done = 0;
  }

  size_t upload() {
    begin(true);
    transfer_.size = 0;
    const uint32_t failed = dictionary_.read(dictionary_.owner, transfer_.index, transfer_.subindex, transfer_.bytes,
                                             kSdoBytes, &transfer_.size);
    if (failed != kSdoOk) return abort(failed);
    if (transfer_.size <= 4) {
      const auto unused = static_cast<uint8_t>(4 - transfer_.size);
      writeObject(answer_, static_cast<uint8_t>(kUpload | unused << 2 | kExpedited | kSizeGiven), transfer_.index,
                  transfer_.subindex);
      memcpy(answer_ + kDataAt, transfer_.bytes, transfer_.size);
      return finish(kLongDataAt);
    }
    writeObject(answer_, kUpload | kSizeGiven, transfer_.index, transfer_.subindex);
    write32(answer_ + kDataAt, static_cast<uint32_t>(transfer_.size));
    transfer_.done = smaller(transfer_.size, mailbox_bytes_ - kLongDataAt);
    memcpy(answer_ + kLongDataAt, transfer_.bytes, transfer_.done);
    transfer_.is_active = transfer_.done < transfer_.size;
    return finish(kLongDataAt + transfer_.done);
  }

  bool isInTurn(bool is_upload) const { return transfer_.is_active && transfer_.is_upload == is_upload; }
  bool togglesRight() const { return ((request_[kSdoAt] & kToggle) != 0) == transfer_.toggle; }

  size_t uploadSegment() {
    if (!isInTurn(true)) return abort(kSdoCommand);
    if (!togglesRight()) return abort(kSdoToggle);
    const size_t size = writeSegment(transfer_, 0, answer_, mailbox_bytes_);
    transfer_.toggle = !transfer_.toggle;
    return finish(size);
  }

  size_t store() {
    const uint32_t failed =
        dictionary_.write(dictionary_.owner, transfer_.index, transfer_.subindex, transfer_.bytes, transfer_.size);
    return failed == kSdoOk ? 0 : abort(failed);
  }

  size_t download() {
    begin(false);
    const uint8_t command = request_[kSdoAt];
    if ((command & kExpedited) != 0) {
      transfer_.size = (command & kSizeGiven) != 0 ? 4 - (command >> 2 & 3) : 4;
      memcpy(transfer_.bytes, request_ + kDataAt, transfer_.size);
    } else {
      transfer_.size = read32(request_ + kDataAt);
      if (transfer_.size > kSdoBytes) return abort(kSdoMemory);
      transfer_.done = smaller(transfer_.size, size_ - kLongDataAt);
      memcpy(transfer_.bytes, request_ + kLongDataAt, transfer_.done);
      transfer_.is_active = transfer_.done < transfer_.size;
    }
    if (!transfer_.is_active)
      if (const size_t aborted = store(); aborted != 0) return aborted;
    writeObject(answer_, 0x60, transfer_.index, transfer_.subindex);
    return finish(kLongDataAt);
  }

  size_t downloadSegment() {
    if (!isInTurn(false)) return abort(kSdoCommand);
    if (!togglesRight()) return abort(kSdoToggle);
    if (!readSegment(transfer_, request_, size_)) return abort(kSdoLength);
    if (!transfer_.is_active && transfer_.done != transfer_.size) return abort(kSdoLength);
    if (!transfer_.is_active)
      if (const size_t aborted = store(); aborted != 0) return aborted;
    memset(answer_ + kSdoAt, 0, 8);
    answer_[kSdoAt] = static_cast<uint8_t>(0x20 | (transfer_.toggle ? kToggle : 0));
    transfer_.toggle = !transfer_.toggle;
    return finish(kLongDataAt);
  }

  SdoTransfer& transfer_;
  const Dictionary& dictionary_;
  const uint8_t* request_;
  size_t size_;
  uint8_t* answer_;
  size_t mailbox_bytes_;
};

bool isCoe(const uint8_t* mailbox, size_t size, CoeService service) {
  return size >= kLongDataAt && readHeader(mailbox).type == MailboxType::CoE &&
         coeServiceOf(static_cast<uint16_t>(mailbox[6] | mailbox[7] << 8)) == service;
}

size_t nextUploadRequest(SdoTransfer& transfer, uint8_t counter, uint8_t* request) {
  memset(request + kSdoAt, 0, 8);
  request[kSdoAt] = static_cast<uint8_t>(kUploadSegment | (transfer.toggle ? kToggle : 0));
  return close(request, CoeService::SdoRequest, counter, kLongDataAt);
}

SdoProgress takeUploaded(SdoTransfer& transfer, const uint8_t* answer, size_t size) {
  const uint8_t command = answer[kSdoAt];
  if ((command & kExpedited) != 0) {
    transfer.size = transfer.done = (command & kSizeGiven) != 0 ? 4 - (command >> 2 & 3) : 4;
    memcpy(transfer.bytes, answer + kDataAt, transfer.size);
    return {true, kSdoOk, 0};
  }
  transfer.size = read32(answer + kDataAt);
  if (transfer.size > kSdoBytes) return {true, kSdoMemory, 0};
  transfer.done = smaller(transfer.size, size - kLongDataAt);
  memcpy(transfer.bytes, answer + kLongDataAt, transfer.done);
  transfer.is_active = transfer.done < transfer.size;
  return {!transfer.is_active, kSdoOk, 0};
}

}  // namespace

uint16_t coeHeader(CoeService service, uint16_t number) {
  return static_cast<uint16_t>((number & 0x1FF) | static_cast<unsigned>(service) << 12);
}
CoeService coeServiceOf(uint16_t header) { return static_cast<CoeService>(header >> 12); }
uint16_t pdoNumberOf(uint16_t header) { return header & 0x1FF; }

ObjectArea areaOf(uint16_t index) {
  return index < 0x1000   ? ObjectArea::DataType
         : index < 0x2000 ? ObjectArea::Communication
         : index < 0x6000 ? ObjectArea::Manufacturer
         : index < 0xA000 ? ObjectArea::Profile
                          : ObjectArea::Reserved;
}

size_t answerSdo(SdoTransfer& transfer, const Dictionary& dictionary, const uint8_t* request, size_t request_size,
                 uint8_t* answer, size_t mailbox_bytes) {
  if (!isCoe(request, request_size, CoeService::SdoRequest)) return 0;
  return Server(transfer, dictionary, request, request_size, answer, mailbox_bytes).run();
}

size_t beginUpload(SdoTransfer& transfer, uint16_t index, uint8_t subindex, uint8_t counter, uint8_t* request) {
  transfer = {};
  transfer.is_upload = true;
  transfer.index = index;
  transfer.subindex = subindex;
  writeObject(request, kUpload, index, subindex);
  return close(request, CoeService::SdoRequest, counter, kLongDataAt);
}

size_t beginDownload(SdoTransfer& transfer, uint16_t index, uint8_t subindex, const uint8_t* bytes, size_t size,
                     uint8_t counter, uint8_t* request, size_t mailbox_bytes) {
  transfer = {};
  transfer.index = index;
  transfer.subindex = subindex;
  transfer.size = smaller(size, kSdoBytes);
  memcpy(transfer.bytes, bytes, transfer.size);
  if (size <= 4) {
    const auto unused = static_cast<uint8_t>(4 - size);
    writeObject(request, static_cast<uint8_t>(kDownload | unused << 2 | kExpedited | kSizeGiven), index, subindex);
    memcpy(request + kDataAt, bytes, size);
    transfer.done = size;
    return close(request, CoeService::SdoRequest, counter, kLongDataAt);
  }
  writeObject(request, kDownload | kSizeGiven, index, subindex);
  write32(request + kDataAt, static_cast<uint32_t>(transfer.size));
  transfer.done = smaller(transfer.size, mailbox_bytes - kLongDataAt);
  memcpy(request + kLongDataAt, transfer.bytes, transfer.done);
  return close(request, CoeService::SdoRequest, counter, kLongDataAt + transfer.done);
}

SdoProgress continueSdo(SdoTransfer& transfer, const uint8_t* answer, size_t answer_size, uint8_t counter,
                        uint8_t* request, size_t mailbox_bytes) {
  if (!isCoe(answer, answer_size, CoeService::SdoResponse)) return {true, kSdoCommand, 0};
  const uint8_t command = answer[kSdoAt];
  if ((command & kCommandBits) == kAbort) return {true, read32(answer + kDataAt), 0};
  if (!transfer.is_upload) {
    if ((command & kCommandBits) == 0x20) transfer.toggle = !transfer.toggle;
    if (transfer.done >= transfer.size) return {true, kSdoOk, 0};
    const size_t size = writeSegment(transfer, kDownloadSegment, request, mailbox_bytes);
    return {false, kSdoOk, close(request, CoeService::SdoRequest, counter, size)};
  }
  if ((command & kCommandBits) == kUpload) {
    const SdoProgress progress = takeUploaded(transfer, answer, answer_size);
    if (progress.is_done) return progress;
  } else {
    if (((command & kToggle) != 0) != transfer.toggle) return {true, kSdoToggle, 0};
    if (!readSegment(transfer, answer, answer_size)) return {true, kSdoLength, 0};
    transfer.toggle = !transfer.toggle;
    if (!transfer.is_active) return {true, transfer.done == transfer.size ? kSdoOk : kSdoLength, 0};
  }
  return {false, kSdoOk, nextUploadRequest(transfer, counter, request)};
}

}  // namespace rung::fieldbus
