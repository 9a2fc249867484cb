// SPDX-License-Identifier: Apache-2.0
// What a session must remember to go on from a moment, as bytes. Each part of the host lists its members once, in a
// function `transfer`, which saves or restores them: an archive goes in one of the two directions. A state is restored
// in the session that saved it, so pointers of the program stay valid. Called by session.cpp.
#pragma once

#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

namespace rung::host {

class StateArchive {
 public:
  // Appends to `to`.
  static StateArchive saving(std::vector<uint8_t>& to) { return StateArchive(&to, nullptr); }
  // Reads what an archive of the same members has written.
  static StateArchive restoring(const std::vector<uint8_t>& from) { return StateArchive(nullptr, from.data()); }

  bool isRestoring() const { return from_ != nullptr; }

  void bytes(void* at, size_t size) {
    if (size == 0) return;
    if (from_ == nullptr) {
      const auto* const begin = static_cast<const uint8_t*>(at);
      to_->insert(to_->end(), begin, begin + size);
    } else {
      memcpy(at, from_, size);
      from_ += size;
    }
  }
  template <class T>
  void value(T& value) {
    static_assert(std::is_trivially_copyable_v<T>, "a state is a copy of bytes");
    bytes(&value, sizeof value);
  }
  template <class... Ts>
  void values(Ts&... all) {
    (value(all), ...);
  }
  // A list whose length may change.
  template <class T>
  void list(std::vector<T>& all) {
    static_assert(std::is_trivially_copyable_v<T>, "a state is a copy of bytes");
    size_t count = all.size();
    value(count);
    all.resize(count);
    bytes(all.data(), count * sizeof(T));
  }
  // The same of elements that are not plain bytes: `each` transfers one of them, `blank` is a new one.
  template <class List, class Each>
  void sequence(List& all, const typename List::value_type& blank, Each each) {
    size_t count = all.size();
    value(count);
    all.resize(count, blank);
    for (auto&& one : all) each(one);
  }
  template <class Set>
  void set(Set& all) {
    std::vector<typename Set::value_type> members(all.begin(), all.end());
    list(members);
    if (isRestoring()) all = Set(members.begin(), members.end());
  }
  // `each` transfers a value.
  template <class Map, class Each>
  void map(Map& all, Each each) {
    std::vector<typename Map::key_type> keys;
    for (const auto& [key, ignored] : all) keys.push_back(key);
    list(keys);
    if (isRestoring()) all.clear();
    for (const auto& key : keys) each(all[key]);
  }
  void text(std::string& text) {
    size_t size = text.size();
    value(size);
    text.resize(size);
    bytes(text.data(), size);
  }

 private:
  StateArchive(std::vector<uint8_t>* to, const uint8_t* from) : to_(to), from_(from) {}

  std::vector<uint8_t>* to_;
  const uint8_t* from_;
};

}  // namespace rung::host
