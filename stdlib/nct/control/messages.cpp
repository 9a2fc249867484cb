// SPDX-License-Identifier: Apache-2.0
// Messages of the PLC: see messages.h.
#include "messages.h"

#include <algorithm>

namespace rung::nct {
namespace {

constexpr size_t kLogged = 10000;  // a month of a busy machine

std::vector<Message>::iterator find(std::vector<Message>& messages, uint32_t code) {
  return std::find_if(messages.begin(), messages.end(), [&](const Message& message) { return message.code == code; });
}

}  // namespace

int32_t Messages::send(const rung_nc_message& message, bool is_new) {
  if (is_new) {
    if (message.is_logged != 0 && log_.size() < kLogged) log_.push_back({message.code, message.text});
    if (message.is_shown != 0 && find(screen_, message.code) == screen_.end())
      screen_.insert(screen_.begin(), {message.code, message.text});
  }
  if (message.is_shown == 0) return RUNG_NC_DONE;
  const auto at = find(screen_, message.code);
  if (at == screen_.end()) return RUNG_NC_REFUSED;
  return at - screen_.begin() < static_cast<std::ptrdiff_t>(rows_) ? RUNG_NC_DONE : RUNG_NC_BUSY;
}

void Messages::withdraw(const rung_nc_message& message) {
  if (message.is_shown == 0) return;
  const auto at = find(screen_, message.code);
  if (at != screen_.end()) screen_.erase(at);
}

void Messages::cancel() {
  if (screen_.empty()) return;
  screen_.erase(screen_.begin());
  cleared_ = true;
}

void Messages::clear() {
  cleared_ = cleared_ || !screen_.empty();
  screen_.clear();
}

bool Messages::takeCleared() {
  const bool was = cleared_;
  cleared_ = false;
  return was;
}

}  // namespace rung::nct
