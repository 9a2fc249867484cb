// SPDX-License-Identifier: Apache-2.0
// The list of a program's variables: see monitor_symbols.h.
#include "monitor_symbols.h"

#include <algorithm>
#include <cstring>
#include <memory>

#include "json.h"
#include "value_format.h"

namespace rung::host {
namespace {

constexpr uint32_t kPathRoom = 16384;

bool isSamePart(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c | 0x20) : c; };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [&](char x, char y) { return lower(x) == lower(y); });
}

const char* kindOf(const rung_type& type) {
  switch (type.kind) {
    case RUNG_ENUM: return "enumeration";
    case RUNG_ARRAY: return "array";
    case RUNG_RECORD: return "record";
    case RUNG_POINTER: return "pointer";
    default: return "elementary";
  }
}

bool isBefore(const rung_variable& a, const rung_variable& b) {
  return a.index != b.index ? a.index < b.index : a.offsets[0] < b.offsets[0];
}

class Listing {
 public:
  Listing(const LoadedModule& module, const SymbolPage& page, std::vector<Variable> forced)
      : module_(module), page_(page), forced_(std::move(forced)), path_(std::make_unique<char[]>(kPathRoom)) {
    std::sort(forced_.begin(), forced_.end(), isBefore);
  }

  std::string list() {
    json_ = "{\"symbols\":[";
    for (uint32_t i = 0; i < module_.symbols.size(); ++i) {
      rung_variable variable;
      rung_variable_of_symbol(&module_.description, i, &variable);
      if (rung_path_of_symbol(&module_.description, i, path_.get(), kPathRoom) == 0) continue;
      const auto visit = [](void* data, const rung_part* part) { return static_cast<Listing*>(data)->visit(*part); };
      rung_walk_variable(&module_.description, &variable, path_.get(), kPathRoom, visit, this);
    }
    return json_ += "],\"total\":" + std::to_string(total_) + '}';
  }

 private:
  bool isHidden(const rung_part& part) const {
    if ((part.variable->flags & (RUNG_FIELD_NO_EXTERNAL_READ | RUNG_FIELD_BY_REFERENCE)) != 0) return true;
    if (part.field == nullptr) return false;
    const char* const name = module_.strings + part.field->name;
    return (part.field->flags & RUNG_FIELD_BY_REFERENCE) != 0 || strncmp(name, "__", 2) == 0;
  }

  rung_walk visit(const rung_part& part) {
    if (isHidden(part)) return RUNG_WALK_SKIP;
    const std::string_view path(part.path, part.path_size), prefix = page_.prefix;
    const size_t common = std::min(path.size(), prefix.size());
    if (!isSamePart(path.substr(0, common), prefix.substr(0, common))) return RUNG_WALK_SKIP;
    const bool is_base = part.field != nullptr && (part.field->flags & RUNG_FIELD_BASE) != 0;
    if (path.size() < prefix.size() || is_base) return RUNG_WALK_ENTER;
    if (total_ >= page_.from && total_ - page_.from < page_.count) append(path, *part.variable);
    ++total_;
    return RUNG_WALK_ENTER;
  }

  bool isForced(const rung_variable& variable) const {
    auto forced = std::lower_bound(forced_.begin(), forced_.end(), variable, isBefore);
    for (; forced != forced_.end() && !isBefore(variable, *forced); ++forced)
      if (rung_is_same_variable(&*forced, &variable)) return true;
    return false;
  }

  void append(std::string_view path, const rung_variable& variable) {
    json_ += json_.back() == '[' ? "{\"path\":" : ",{\"path\":";
    appendJsonText(json_, path);
    json_ += ",\"type\":";
    appendJsonText(json_, typeName(module_, *variable.type));
    ((json_ += ",\"kind\":\"") += kindOf(*variable.type)) += '"';
    json_ += isWritableOutside(variable) ? ",\"writable\":true" : ",\"writable\":false";
    json_ += isForced(variable) ? ",\"forced\":true}" : ",\"forced\":false}";
  }

  const LoadedModule& module_;
  const SymbolPage& page_;
  std::vector<Variable> forced_;  // by where they are
  std::unique_ptr<char[]> path_;
  uint64_t total_ = 0;
  std::string json_;
};

}  // namespace

bool isWritableOutside(const rung_variable& variable) {
  return (variable.flags & RUNG_FIELD_NO_EXTERNAL_WRITE) == 0 && rung_is_writable(&variable) == RUNG_ACCESS_OK;
}

std::string listSymbols(const LoadedModule& module, const SymbolPage& page, std::vector<Variable> forced) {
  return Listing(module, page, std::move(forced)).list();
}

}  // namespace rung::host
