// SPDX-License-Identifier: Apache-2.0
// Changes of files as data. In: edits of the files of a view. Out: the texts that they make, and where a byte of before
// is then.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "tools/ide/view.h"

namespace rung::ide {

struct TextEdit {
  FileRange range;
  std::string text;
};

class Edits {
 public:
  // Sorts them; of several at one place the first counts.
  explicit Edits(std::vector<TextEdit> edits);

  const std::vector<TextEdit>& all() const { return edits_; }
  // The new texts of the files that change, by path.
  std::map<std::string, std::string> applied(const View& view) const;
  // Of a byte that no edit takes away.
  uint32_t moved(FileId file, uint32_t byte) const;

 private:
  std::vector<TextEdit> edits_;
};

}  // namespace rung::ide
