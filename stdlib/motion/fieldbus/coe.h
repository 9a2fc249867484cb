// SPDX-License-Identifier: Apache-2.0
// CANopen over EtherCAT: the header of its mailboxes, the server and the client of the SDO service (expedited, normal,
// segmented), and the objects that map and assign process data. In: an object dictionary. Called by drive/objects.cpp.
// TM/TP manual 2.4.1; ETG.1000.6, CoE; CiA 301.
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "fieldbus/ethercat.h"

namespace rung::fieldbus {

enum class CoeService : uint8_t {
  Emergency = 1,
  SdoRequest = 2,
  SdoResponse = 3,
  TxPdo = 4,
  RxPdo = 5,
  TxPdoRemoteRequest = 6,
  RxPdoRemoteRequest = 7,
  SdoInformation = 8
};

// The header is 16 bits: 9 bits number of a PDO, 3 bits reserved, 4 bits type.
uint16_t coeHeader(CoeService service, uint16_t number);
CoeService coeServiceOf(uint16_t header);
uint16_t pdoNumberOf(uint16_t header);

enum SdoAbort : uint32_t {
  kSdoOk = 0,
  kSdoToggle = 0x05030000,
  kSdoTimeout = 0x05040000,
  kSdoCommand = 0x05040001,
  kSdoMemory = 0x05040005,
  kSdoWriteOnly = 0x06010001,
  kSdoReadOnly = 0x06010002,
  kSdoNoObject = 0x06020000,
  kSdoNotMappable = 0x06040041,
  kSdoMappingLength = 0x06040042,
  kSdoLength = 0x06070010,
  kSdoNoSubindex = 0x06090011,
  kSdoRange = 0x06090030,
  kSdoState = 0x08000022
};

// The kind of an object by the range of its index.
enum class ObjectArea : uint8_t { DataType, Communication, Manufacturer, Profile, Reserved };
ObjectArea areaOf(uint16_t index);

// An object dictionary: both return a SdoAbort.
struct Dictionary {
  void* owner;
  uint32_t (*read)(void* owner, uint16_t index, uint8_t subindex, uint8_t* bytes, size_t capacity, size_t* size);
  uint32_t (*write)(void* owner, uint16_t index, uint8_t subindex, const uint8_t* bytes, size_t size);
};

constexpr size_t kSdoBytes = 512;       // the longest object that is transferred
constexpr size_t kMailboxBytes = 1486;  // the longest mailbox

// A segmented transfer that is under way, in a server or a client.
struct SdoTransfer {
  bool is_active, is_upload, toggle;
  uint16_t index;
  uint8_t subindex;
  size_t size, done;
  uint8_t bytes[kSdoBytes];
};

// The mailbox of the answer to a request, at most `mailbox_bytes` long; 0: no answer, since it is not an SDO request.
size_t answerSdo(SdoTransfer& transfer, const Dictionary& dictionary, const uint8_t* request, size_t request_size,
                 uint8_t* answer, size_t mailbox_bytes);

// The client: begin… writes the first request, continueSdo reads an answer and writes the next request.
size_t beginUpload(SdoTransfer& transfer, uint16_t index, uint8_t subindex, uint8_t counter, uint8_t* request);
size_t beginDownload(SdoTransfer& transfer, uint16_t index, uint8_t subindex, const uint8_t* bytes, size_t size,
                     uint8_t counter, uint8_t* request, size_t mailbox_bytes);
struct SdoProgress {
  bool is_done;
  uint32_t abort;       // a SdoAbort
  size_t request_size;  // of the next request
};
SdoProgress continueSdo(SdoTransfer& transfer, const uint8_t* answer, size_t answer_size, uint8_t counter,
                        uint8_t* request, size_t mailbox_bytes);

// An entry of a mapping object (1600h, 1A00h): the object and its length in bits.
struct MappedObject {
  uint16_t index;
  uint8_t subindex, bits;
};
constexpr uint32_t mappingEntry(MappedObject object) {
  return uint32_t{object.index} << 16 | uint32_t{object.subindex} << 8 | object.bits;
}
constexpr MappedObject mappedObject(uint32_t entry) {
  return {static_cast<uint16_t>(entry >> 16), static_cast<uint8_t>(entry >> 8), static_cast<uint8_t>(entry)};
}

// Which PDO assignment object belongs to a sync manager: 1C10h and following.
constexpr uint16_t assignmentOf(unsigned sync_manager) { return static_cast<uint16_t>(0x1C10 + sync_manager); }

}  // namespace rung::fieldbus
