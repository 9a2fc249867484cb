// SPDX-License-Identifier: Apache-2.0
// Retained variables: see retain.h. After the values a slot has a directory of their variables, a line each:
// `path TAB kind TAB offset TAB size TAB type`.
#include "retain.h"

#include <algorithm>
#include <cstring>
#include <unordered_map>

#include "rung/retain.h"

namespace rung::host {
namespace {

rung_slot headerOf(const std::vector<uint8_t>& slot) {
  rung_slot header;
  memcpy(&header, slot.data(), sizeof header);
  return header;
}

// `Main.items[..].x` of `Main.items[3].x`: a changed array is one change.
std::string withoutIndices(const std::string& path) {
  std::string text;
  bool inside = false;
  for (const char c : path) {
    if (c == ']') inside = false;
    if (!inside) text += c;
    if (c == '[') {
      inside = true;
      text += "..";
    }
  }
  return text;
}

}  // namespace

Retain::Retain(const Symbols& symbols, Memory& memory, std::string path)
    : module_(symbols.module()),
      symbols_(symbols),
      memory_(memory),
      file_(std::move(path)),
      latest_(rung_retain_bytes(&module_.description)) {}

bool Retain::open(std::string& error) {
  if (!file_.open(error)) return false;
  found_ = file_.newest();
  if (file_.isDamaged())
    changes_.push_back(
        "the file is damaged, and none of its states is complete: all variables start with their initial "
        "values");
  if (!found_.empty()) sequence_ = headerOf(found_).sequence;
  directory_ = directory();
  return file_.reserve(latest_.size() + directory_.size(), error);
}

std::string Retain::directory() const {
  struct Range {
    const uint8_t* begin;
    uint32_t size, offset;
    uint8_t bit;  // of `bits`
  };
  std::vector<Range> ranges, bits;
  uint32_t offset = 0;
  const auto add = [&](const Table<rung_range>& list) {
    for (const rung_range& range : list) {
      const uint32_t index = range.block & ~(RUNG_RANGE_AREA | RUNG_RANGE_BIT);
      const uint8_t* const memory = (range.block & RUNG_RANGE_AREA) != 0 ? memory_.area(index) : memory_.block(index);
      const bool is_bit = (range.block & RUNG_RANGE_BIT) != 0;
      if (is_bit)
        bits.push_back({memory + range.offset / 8, range.size, offset, static_cast<uint8_t>(range.offset % 8)});
      else
        ranges.push_back({memory + range.offset, range.size, offset, 0});
      offset += range.size;
    }
  };
  add(module_.retain);
  add(module_.persistent);
  if (ranges.empty() && bits.empty()) return "";
  std::sort(ranges.begin(), ranges.end(), [](const Range& a, const Range& b) { return a.begin < b.begin; });

  std::string text;
  std::vector<Variable> leaves;
  for (const Variable& root : symbols_.roots()) {
    // Others may see a part of an area that a located variable keeps.
    const bool is_kept = (root.flags & (RUNG_FIELD_RETAIN | RUNG_FIELD_PERSISTENT)) != 0;
    if (is_kept || !isInArea(root.address())) symbols_.expand(root, leaves);
  }
  for (const Variable& leaf : leaves) {
    const uint8_t* const at = leaf.address();
    if (leaf.bit != 255 && isInArea(at)) {
      for (const Range& range : bits)
        if (range.begin == at && range.bit == leaf.bit)
          text += leaf.path + '\t' + std::to_string(leaf.type->kind) + '\t' + std::to_string(range.offset) + "\t1\t" +
                  (module_.strings + leaf.type->name) + '\n';
      continue;
    }
    auto range = std::upper_bound(ranges.begin(), ranges.end(), at,
                                  [](const uint8_t* p, const Range& r) { return p < r.begin; });
    if (range == ranges.begin()) continue;
    --range;
    if (at + leaf.type->size > range->begin + range->size) continue;
    text += leaf.path + '\t' + std::to_string(leaf.type->kind) + '\t' +
            std::to_string(range->offset + static_cast<uint32_t>(at - range->begin)) + '\t' +
            std::to_string(leaf.type->size) + '\t' + (module_.strings + leaf.type->name) + '\n';
  }
  return text;
}

bool Retain::isInArea(const uint8_t* at) const {
  for (uint32_t i = 0; i < module_.areas.size(); ++i)
    if (at >= memory_.area(i) && at < memory_.area(i) + module_.areas[i].size) return true;
  return false;
}

bool Retain::readEntry(const std::string& line, std::string& path, Entry& entry) {
  const size_t tab = line.find('\t');
  int length = 0;
  if (tab == std::string::npos ||
      sscanf(line.c_str() + tab, "\t%u\t%u\t%u%n", &entry.kind, &entry.offset, &entry.size, &length) != 3)
    return false;
  path = line.substr(0, tab);
  const size_t end = tab + static_cast<size_t>(length);
  entry.type = end < line.size() ? line.substr(end + 1) : "";
  return true;
}

template <class F>
void Retain::forEachEntry(const std::string& directory, F use) {
  for (size_t at = 0, end; at < directory.size() && (end = directory.find('\n', at)) != std::string::npos;
       at = end + 1) {
    std::string path;
    Entry entry;
    if (readEntry(directory.substr(at, end - at), path, entry)) use(path, entry);
  }
}

void Retain::restore(rung_start start) {
  if (found_.empty()) return;
  if (!rung_retain_unpack(&memory_.context(), found_.data(), start)) restoreByName(start);
}

// Of another version of the program. What a start does not keep is not missed.
void Retain::restoreByName(rung_start start) {
  if (start == RUNG_ORIGIN) return;
  const rung_slot header = headerOf(found_);
  const std::string then(found_.begin() + static_cast<ptrdiff_t>(sizeof header + header.value_bytes), found_.end());
  std::unordered_map<std::string, std::pair<std::string, Entry>> now;
  forEachEntry(directory_, [&](const std::string& path, const Entry& entry) {
    now.emplace(lowerCase(path), std::make_pair(path, entry));
  });
  const uint32_t retain_bytes = rung_retain_bytes(&module_.description);
  uint32_t persistent_from = 0;
  for (uint32_t i = 0; i < module_.retain.size(); ++i) persistent_from += module_.retain[i].size;
  forEachEntry(then, [&](const std::string& path, const Entry& before) {
    if (start == RUNG_COLD && before.offset < header.retain_bytes) return;
    if (size_t{before.offset} + before.size > header.value_bytes) return;
    const auto found = now.find(lowerCase(path));
    if (found == now.end()) {
      Variable variable;
      std::string ignored;
      const bool exists = symbols_.find(path, variable, ignored);
      note(path, "` (" + before.type + ") " +
                     (exists ? "is not retained any more: it starts with its initial value"
                             : "is not in the program any more: its value is dropped"));
      return;
    }
    const auto& [name, entry] = found->second;
    if (start == RUNG_COLD && entry.offset < persistent_from) return;
    if (entry.offset + entry.size <= retain_bytes) restoreVariable(name, before, entry);
  });
}

void Retain::note(const std::string& path, const std::string& what) {
  const std::string text = "`" + withoutIndices(path) + what;
  if (changes_.empty() || changes_.back() != text) changes_.push_back(text);
}

void Retain::restoreVariable(const std::string& path, const Entry& before, const Entry& now) {
  if (before.kind != now.kind || before.size != now.size) {
    note(path, "` was " + before.type + " and is " + now.type + " now: it starts with its initial value");
    return;
  }
  Variable variable;
  std::string ignored;
  if (!symbols_.find(path, variable, ignored)) return;
  const uint8_t* const value = found_.data() + sizeof(rung_slot) + before.offset;
  if (variable.bit != 255) {
    const auto mask = static_cast<uint8_t>(1u << variable.bit % 8);
    uint8_t& byte = *variable.address();
    byte = static_cast<uint8_t>(*value != 0 ? byte | mask : byte & ~mask);
  } else {
    memcpy(variable.address(), value, now.size);
  }
  memory_.context().now_ns = headerOf(found_).time_ns;  // its timers go on
}

void Retain::copy(int64_t now_ns) {
  const std::lock_guard<std::mutex> lock(mutex_);
  rung_retain_pack(&memory_.context(), latest_.data());
  memcpy(latest_.data() + offsetof(rung_slot, time_ns), &now_ns, sizeof now_ns);
  is_new_ = true;
}

bool Retain::save(std::string& error) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!is_new_) return true;
    saving_ = latest_;
    is_new_ = false;
  }
  if (saving_.size() == written_.size() &&
      memcmp(saving_.data() + sizeof(rung_slot), written_.data() + sizeof(rung_slot),
             saving_.size() - sizeof(rung_slot)) == 0)
    return true;
  written_ = saving_;
  saving_.insert(saving_.end(), directory_.begin(), directory_.end());
  rung_slot header = headerOf(saving_);
  header.length += static_cast<uint32_t>(directory_.size());
  memcpy(saving_.data(), &header, sizeof header);
  rung_retain_seal(saving_.data(), ++sequence_);
  if (file_.write(saving_, error)) return true;
  written_.clear();
  return false;
}

}  // namespace rung::host
