// SPDX-License-Identifier: Apache-2.0
// The messages of the PLC on the screen of the simulated control and in its log. NCT manual 6.13, 7.12.
#pragma once

#include <string>
#include <vector>

#include "rung/nc.h"

namespace rung::nct {

struct Message {
  uint32_t code;
  std::string text;
};

class Messages {
 public:
  // The input of a message rises, and then in each cycle: a rung_nc_result.
  int32_t send(const rung_nc_message& message, bool is_new);
  void withdraw(const rung_nc_message& message);
  // The operator deletes the message on top, or all of them.
  void cancel();
  void clear();
  void setRows(uint32_t rows) { rows_ = rows; }

  // On the screen, the newest first.
  const std::vector<Message>& screen() const { return screen_; }
  const std::vector<Message>& log() const { return log_; }
  // Tells whether the operator has deleted messages since the last call.
  bool takeCleared();

  template <class Archive>
  void transfer(Archive& archive) {
    const auto message = [&](Message& it) {
      archive.value(it.code);
      archive.text(it.text);
    };
    archive.sequence(screen_, Message{}, message);
    archive.sequence(log_, Message{}, message);
    archive.values(rows_, cleared_);
  }

 private:
  std::vector<Message> screen_, log_;
  uint32_t rows_ = 8;
  bool cleared_ = false;
};

}  // namespace rung::nct
