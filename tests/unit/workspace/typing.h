// SPDX-License-Identifier: Apache-2.0
// Somebody who types: random edits of the ST files of a folder, as buffers of an editor. Equal seeds type the same.
#pragma once

#include <map>
#include <random>
#include <string>
#include <vector>

#include "tools/workspace/workspace.h"

namespace rung::workspace {

class Typing {
 public:
  Typing(const std::string& folder, uint32_t seed);

  // A few characters typed, deleted or replaced near each other; at times what was typed is undone.
  Change next();
  const std::map<std::string, std::string>& texts() const { return texts_; }  // by path

 private:
  void edit(std::string& text);

  std::mt19937 random_;
  std::map<std::string, std::string> texts_;
  std::vector<std::string> files_;
  std::string file_, before_;  // being edited, and its text when that began
  size_t at_ = 0;
  uint32_t left_ = 0;  // edits at this place
};

// `main.st 3:1 E0701 message`, one a line, with notes below.
std::string messagesOf(const Snapshot& snapshot);

}  // namespace rung::workspace
