// SPDX-License-Identifier: Apache-2.0
// An online change as the bundled host makes it: rung/change.h with memory and sentences. In: the modules and contexts
// of two versions. Out: what keeps its value and what does not, with reasons; the new version's memory. Used by
// session.cpp.
#pragma once

#include <string>
#include <vector>

#include "loaded_module.h"
#include "rung/change.h"

namespace rung::host {

struct ChangeReport {
  struct Item {
    std::string path, reason;
  };
  uint32_t kept = 0;  // elementary variables
  std::vector<Item> initialised, removed, refused;
  std::vector<std::string> unforced;  // paths: the new version cannot force them
  std::string error;                  // why it was not made; empty: it was, or could be

  // The lines that a user reads.
  std::string text() const;
};

class Change {
 public:
  Change(const LoadedModule& old_module, const LoadedModule& module);
  Change(const Change&) = delete;
  Change& operator=(const Change&) = delete;

  // False: the change is refused; the report has the reasons.
  bool plan();
  bool check(const rung_context& old_context);
  // RUNG_FAULT_NONE, or a fault of `*faulted`.
  uint8_t apply(rung_context& old_context, rung_context& context, rung_context*& faulted) const {
    return rung_apply_change(&plan_, &old_context, &context, &faulted);
  }
  // For each block of the new version the old one whose memory stays; or RUNG_NONE.
  const std::vector<uint32_t>& kept() const { return kept_; }
  const ChangeReport& report() const { return report_; }

 private:
  static void onNote(void* data, const rung_change_note* note);
  bool refuse(std::string path, std::string reason);
  bool compareDevices();

  const LoadedModule &old_module_, &module_;
  rung_change plan_{};
  std::vector<char> path_, target_;
  std::vector<uint32_t> same_, kept_;
  std::vector<uint8_t> image_;
  std::vector<rung_move> moves_;
  std::vector<rung_holder> holders_;
  ChangeReport report_;
};

}  // namespace rung::host
