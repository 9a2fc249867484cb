// SPDX-License-Identifier: Apache-2.0
// Retained variables: see retain.h.
#include "retain.h"

#include <cstring>

#include "rung/retain.h"

namespace rung::host {
namespace {

constexpr size_t kLongestEntry = 65536;  // of the directory

rung_slot headerOf(const std::vector<uint8_t>& slot) {
  rung_slot header;
  memcpy(&header, slot.data(), sizeof header);
  return header;
}

}  // namespace

Retain::Retain(const Symbols& symbols, Memory& memory, std::string path)
    : symbols_(&symbols),
      memory_(&memory),
      file_(std::move(path)),
      latest_(rung_retain_bytes(&symbols.module().description)) {}

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

bool Retain::moveTo(const Symbols& symbols, Memory& memory, std::string& error) {
  const std::lock_guard<std::mutex> writing(writing_);
  const std::lock_guard<std::mutex> lock(mutex_);
  symbols_ = &symbols;
  memory_ = &memory;
  latest_.assign(rung_retain_bytes(&module().description), 0);
  is_new_ = false;
  directory_ = directory();
  return file_.reserve(latest_.size() + directory_.size(), error);
}

std::string Retain::directory() {
  rung_migration migration = room();
  std::string text;
  text.resize(rung_retain_directory(&module().description, nullptr, 0, &migration));
  rung_retain_directory(&module().description, text.data(), static_cast<uint32_t>(text.size()), &migration);
  return text;
}

// The room for a path is that of the longest line.
rung_migration Retain::room() {
  path_.resize(kLongestEntry);
  rung_migration migration{};
  migration.path = path_.data();
  migration.path_capacity = static_cast<uint32_t>(path_.size());
  migration.data = this;
  return migration;
}

void Retain::restore(rung_start start) {
  if (found_.empty()) return;
  if (rung_retain_unpack(&memory_->context(), found_.data(), start)) return;
  rung_migration migration = room();
  migration.lost = [](void* data, const char* path, rung_loss why, const char* old_type, const char* new_type) {
    static_cast<Retain*>(data)->note(path, why, old_type, new_type);
  };
  rung_retain_migrate(&memory_->context(), found_.data(), start, &migration);
}

void Retain::note(const char* path, rung_loss why, const std::string& old_type, const std::string& new_type) {
  Variable variable;
  std::string ignored;
  const std::string name = symbols_->find(path, variable, ignored) ? variable.path : path;
  std::string text = "`" + withoutIndices(name) + "` ";
  switch (why) {
    case RUNG_LOSS_MISSING: text += "(" + old_type + ") is not in the program any more: its value is dropped"; break;
    case RUNG_LOSS_TYPE:
      text += "was " + old_type + " and is " + new_type + " now: it starts with its initial value";
      break;
    case RUNG_LOSS_NOT_RETAINED:
      text += "(" + old_type + ") is not retained any more: it starts with its initial value";
      break;
  }
  if (changes_.empty() || changes_.back() != text) changes_.push_back(text);
}

void Retain::copy(int64_t now_ns) {
  const std::lock_guard<std::mutex> lock(mutex_);
  rung_retain_pack(&memory_->context(), latest_.data());
  memcpy(latest_.data() + offsetof(rung_slot, time_ns), &now_ns, sizeof now_ns);
  is_new_ = true;
}

bool Retain::save(std::string& error) {
  const std::lock_guard<std::mutex> writing(writing_);
  std::string directory;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!is_new_) return true;
    saving_ = latest_;
    directory = directory_;
    is_new_ = false;
  }
  if (saving_.size() == written_.size() &&
      memcmp(saving_.data() + sizeof(rung_slot), written_.data() + sizeof(rung_slot),
             saving_.size() - sizeof(rung_slot)) == 0)
    return true;
  written_ = saving_;
  saving_.insert(saving_.end(), directory.begin(), directory.end());
  rung_slot header = headerOf(saving_);
  header.length += static_cast<uint32_t>(directory.size());
  memcpy(saving_.data(), &header, sizeof header);
  rung_retain_seal(saving_.data(), ++sequence_);
  if (file_.write(saving_, error)) return true;
  written_.clear();
  return false;
}

}  // namespace rung::host
