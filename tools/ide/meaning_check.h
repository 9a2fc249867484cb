// SPDX-License-Identifier: Apache-2.0
// Whether edits keep the meaning of a project. In: views before and after them, and the names that they exchange. Out:
// the first name that means something else, or the first new error, as a sentence. What the check recorded of both is
// compared, so that it holds for all that may happen to names: duplicates, hiding, inheritance, overloads.
#pragma once

#include <compare>
#include <set>
#include <string>
#include <vector>

#include "tools/ide/text_edits.h"

namespace rung::ide {

// Values, which need no view any more.
class MeaningRecord {
 public:
  // `edits`: that are not made in the view; null: it has them. Of two empty names the meaning of all names counts.
  MeaningRecord(const View& view, const Edits* edits, const std::string& old_name, const std::string& new_name);

  // What another project with the same edits means otherwise, or has as a new error; empty: nothing.
  std::string differenceIn(const View& after) const;

  // A byte of a file with the edits.
  struct Spot {
    std::string path;  // empty: of a library, or of none
    uint32_t byte = 0;
    auto operator<=>(const Spot&) const = default;
  };

 private:
  // A name, and the name in the declaration that it means.
  struct Meant {
    Spot at, declared;
    auto operator<=>(const Meant&) const = default;
  };
  struct Problem {
    Spot at;
    std::string code;
    auto operator<=>(const Problem&) const = default;
  };
  void add(const View& view, const Edits* edits, const std::vector<NameId>& keys);
  std::string newProblemIn(const View& after) const;

  std::string old_name_, new_name_;
  std::vector<Meant> meant_;
  std::multiset<Problem> problems_;
};

}  // namespace rung::ide
