// SPDX-License-Identifier: Apache-2.0
// What a program asked of the world, so that a part of its run can be repeated: the answers of files and channels, and
// that it reported something. In: the services of a session. Out: services that answer from the log as long as it
// lasts, without touching the world, and then go on with the session's own, whose answers they note. Everything else
// that decides how a program goes on is part of the session's state.
#pragma once

#include <cstdint>
#include <vector>

#include "stdlib/runtime/host/session.h"

namespace rung::debug {

class ServiceLog {
 public:
  // Puts itself in the place of the files and channels of a session: SessionHooks::serving.
  void serve(rung_host& host);
  // The program reports something. True: for the first time.
  bool isFirstReport();

  size_t position() const { return forgotten_ + next_; }  // of the next answer
  void goTo(size_t position) { next_ = position - forgotten_; }
  void cut() { log_.resize(next_); }   // what follows did not happen
  void forgetBefore(size_t position);  // nothing goes back there any more
  void clear() { log_.clear(), next_ = forgotten_ = 0; }
  size_t bytes() const { return log_.size(); }
  // The program asked something else than before: it does not repeat itself.
  bool hasDiverged() const { return has_diverged_; }

 private:
  enum class Service : uint8_t { Plain, Bytes, Status, Sender, Report };
  struct Head {
    Service service;
    int64_t result;
    uint32_t size;
  };
  template <auto member>
  struct Forward;

  template <class Call>
  int64_t ask(Service service, void* bytes, size_t capacity, Call call);
  bool repeat(Service service, int64_t& result, void* bytes, size_t capacity);
  void note(Service service, int64_t result, const void* bytes, size_t size);
  void wrapFiles();
  void wrapChannels();
  static ServiceLog& of(void* data) { return *static_cast<ServiceLog*>(data); }
  // The session's own services.
  const rung_files& services(const rung_files*) const { return *session_.files; }
  const rung_channels& services(const rung_channels*) const { return *session_.channels; }
  void* data(const rung_files*) const { return session_.files_data; }
  void* data(const rung_channels*) const { return session_.channels_data; }

  rung_host session_{};  // as it was
  rung_files files_{};
  rung_channels channels_{};
  std::vector<uint8_t> log_;
  size_t next_ = 0, forgotten_ = 0;
  bool has_diverged_ = false;
};

}  // namespace rung::debug
