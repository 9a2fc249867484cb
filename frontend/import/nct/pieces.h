// SPDX-License-Identifier: Apache-2.0
// Text in pieces with the location of each, to be put together when its parts are known. Used by the writers of NCT
// programs, whose declarations are known when their bodies are written.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "frontend/import/source_mapped_text.h"

namespace rung::importer::nct {

class Pieces {
 public:
  void put(Loc loc, std::string_view text) {
    starts_.push_back({static_cast<uint32_t>(text_.size()), loc});
    text_ += text;
  }
  void add(const Pieces& other) {
    for (const Start& start : other.starts_)
      starts_.push_back({start.at + static_cast<uint32_t>(text_.size()), start.loc});
    text_ += other.text_;
  }
  void addTo(xml::SourceMappedText& out) const {
    for (size_t k = 0; k < starts_.size(); ++k) {
      const size_t end = k + 1 < starts_.size() ? starts_[k + 1].at : text_.size();
      out.put(starts_[k].loc, std::string_view(text_).substr(starts_[k].at, end - starts_[k].at));
    }
  }

 private:
  struct Start {
    uint32_t at;
    Loc loc;
  };
  std::string text_;
  std::vector<Start> starts_;
};

}  // namespace rung::importer::nct
