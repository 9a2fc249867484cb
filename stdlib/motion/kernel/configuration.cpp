// SPDX-License-Identifier: Apache-2.0
// Before an axis gets power: the start-up SDOs of its drive, and whether the process data has what the axis needs. Also
// the service channel of the drive, for blocks. TM/TP manual 1.7.1, 2.4.1.
#include "drive/drive.h"
#include "kernel/axis.h"

namespace rung::motion {
namespace {

using namespace rung_sm3_basic;

// A message to the operator: texts and numbers, cut where it is too long.
class Message {
 public:
  void add(const char* text) {
    while (*text != 0 && size_ + 1 < sizeof text_) text_[size_++] = *text++;
    text_[size_] = 0;
  }
  // 607Ah, 6099h:01
  void addObject(uint16_t index, uint8_t subindex) {
    addHex(index, 4);
    add("h");
    if (subindex == 0) return;
    add(":");
    addHex(subindex, 2);
  }
  const char* text() const { return text_; }

 private:
  void addHex(uint32_t value, int digits) {
    for (int i = digits - 1; i >= 0; --i) {
      const char digit[] = {"0123456789ABCDEF"[value >> 4 * i & 15], 0};
      add(digit);
    }
  }

  char text_[240] = "";
  size_t size_ = 0;
};

void tell(const rung_context* ctx, const Message& message) {
  if (ctx->host != nullptr && ctx->host->message != nullptr)
    ctx->host->message(ctx->host_data, RUNG_MESSAGE_ERROR, message.text());
}

struct Needed {
  uint32_t bit;
  uint16_t index;
};

// The set value of what the drive is to control.
Needed targetOf(const Axis& a) {
  switch (driveMode(a.eControllerMode_)) {
    case 9: return {RUNG_DRIVE_TARGET_VELOCITY, 0x60FF};
    case 10: return {RUNG_DRIVE_TARGET_TORQUE, 0x6071};
    default: return {RUNG_DRIVE_TARGET_POSITION, 0x607A};
  }
}

// Without one of these a drive does not follow. A host that does not tell its mapping has them all.
void checkMapping(const rung_context* ctx, Axis& a) {
  const Needed needed[] = {
      {RUNG_DRIVE_CONTROLWORD, 0x6040}, targetOf(a), {RUNG_DRIVE_STATUSWORD, 0x6041}, {RUNG_DRIVE_POSITION, 0x6064}};
  Message message;
  message.add(a.path_);
  message.add(": the axis does not move: the process data of its drive lacks ");
  a.eConfiguration_ = complete_;
  for (const Needed& object : needed) {
    if (a.drive_.mapped_ == 0 || (a.drive_.mapped_ & object.bit) != 0) continue;
    if (a.eConfiguration_ == complete_) a.dwConfigurationObject_ = uint32_t{object.index} << 8;
    if (a.eConfiguration_ == missing_object_) message.add(", ");
    a.eConfiguration_ = missing_object_;
    message.addObject(object.index, 0);
  }
  if (a.eConfiguration_ == missing_object_) tell(ctx, message);
}

const char* causeOf(int64_t result) {
  switch (result) {
    case RUNG_OBJECT_UNKNOWN: return ": the drive has no such object, or of another length";
    case RUNG_OBJECT_READ_ONLY: return ": it is read-only";
    case RUNG_OBJECT_RANGE: return ": the drive does not take this value";
    default: return ": no answer";
  }
}

void refuse(const rung_context* ctx, Axis& a, const AXIS_STARTUP_OBJECT_type& object, int64_t result) {
  a.eConfiguration_ = refused_;
  a.dwConfigurationObject_ = uint32_t{object.index_} << 8 | object.subindex_;
  Message message;
  message.add(a.path_);
  message.add(": the axis does not move: its start-up object ");
  message.addObject(object.index_, object.subindex_);
  message.add(" was not written");
  message.add(causeOf(result));
  tell(ctx, message);
}

// Writes one start-up object after the other. True: all are written.
bool writeStartup(const rung_context* ctx, Axis& a) {
  constexpr unsigned kMost = sizeof a.startup_ / sizeof a.startup_[0];
  for (; a.startup_next_ < kMost; ++a.startup_next_) {
    const AXIS_STARTUP_OBJECT_type& object = a.startup_[a.startup_next_];
    if (object.length_ == 0 || (object.of_host_ != 0 && a.host_drive_ == 0)) continue;
    AXIS_OBJECT_ACCESS_type& access = a.startup_access_;
    access.index_ = object.index_;
    access.subindex_ = object.subindex_;
    access.length_ = object.length_;
    access.is_write_ = 1;
    access.value_ = object.value_;
    const int64_t result = accessObject(ctx, a, access);
    if (result == RUNG_OBJECT_BUSY) return false;
    access.number_ = 0;
    if (result == RUNG_OBJECT_DONE) continue;
    refuse(ctx, a, object, result);
    return false;
  }
  return true;
}

}  // namespace

void configure(const rung_context* ctx, Axis& a) {
  if (a.bVirtual_ != 0) {
    a.eConfiguration_ = complete_;
    return;
  }
  if (a.bCommunication_ == 0) {
    a.eConfiguration_ = unknown_;
    return;
  }
  if (a.eConfiguration_ == unknown_) {
    a.eConfiguration_ = running_;
    a.startup_next_ = 0;
    a.startup_access_ = {};
    a.dwConfigurationObject_ = 0;
  }
  if (a.eConfiguration_ == running_ && writeStartup(ctx, a)) checkMapping(ctx, a);
}

int64_t accessObject(const rung_context* ctx, Axis& a, AXIS_OBJECT_ACCESS_type& access) {
  const rung_object_access wanted = {access.index_, access.subindex_, access.length_, access.is_write_, access.value_};
  rung_drive& drive = reinterpret_cast<rung_drive&>(a.drive_);
  uint32_t value = access.value_;
  if (a.host_drive_ != 0) {
    const rung_drives* const host = ctx->host->drives;
    if (access.number_ == 0) access.number_ = host->begin(ctx->host->drives_data, &drive, &wanted);
    const int64_t result =
        access.number_ < 0 ? access.number_ : host->result(ctx->host->drives_data, access.number_, &value);
    if (result == RUNG_OBJECT_DONE) access.value_ = value;
    return result;
  }
  if (a.bBoundDrive_ != 0) return RUNG_OBJECT_FAILED;  // the process image has no service channel
  const bool is_free = a.access_owner_ == nullptr || a.access_owner_ == &access || a.access_called_ + 1 < a.cycle_;
  if (!is_free) return RUNG_OBJECT_BUSY;
  a.access_owner_ = &access;
  if (a.access_called_ == a.cycle_ && access.busy_ != 0) return RUNG_OBJECT_BUSY;  // called twice in a cycle
  a.access_called_ = a.cycle_;
  access.busy_ = 1;
  const int64_t result = accessObject(a.simulation_, wanted, &value);
  if (result == RUNG_OBJECT_BUSY) return result;
  access.busy_ = 0;
  a.access_owner_ = nullptr;
  if (result == RUNG_OBJECT_DONE) access.value_ = value;
  return result;
}

}  // namespace rung::motion
