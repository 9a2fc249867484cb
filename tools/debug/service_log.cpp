// SPDX-License-Identifier: Apache-2.0
#include "tools/debug/service_log.h"

#include <algorithm>
#include <cstring>

namespace rung::debug {

void ServiceLog::note(Service service, int64_t result, const void* bytes, size_t size) {
  const Head head{service, result, static_cast<uint32_t>(size)};
  const auto* const begin = reinterpret_cast<const uint8_t*>(&head);
  log_.insert(log_.end(), begin, begin + sizeof head);
  const auto* const content = static_cast<const uint8_t*>(bytes);
  if (size != 0) log_.insert(log_.end(), content, content + size);
  next_ = log_.size();
}

// False: the log has ended.
bool ServiceLog::repeat(Service service, int64_t& result, void* bytes, size_t capacity) {
  if (next_ == log_.size()) return false;
  Head head;
  memcpy(&head, log_.data() + next_, sizeof head);
  if (head.service != service || head.size > capacity) {
    has_diverged_ = true;
    cut();
    return false;
  }
  if (head.size != 0) memcpy(bytes, log_.data() + next_ + sizeof head, head.size);
  next_ += sizeof head + head.size;
  result = head.result;
  return true;
}

// `call` sets the result, and returns how many of the bytes an answer has.
template <class Call>
int64_t ServiceLog::ask(Service service, void* bytes, size_t capacity, Call call) {
  int64_t result = 0;
  if (repeat(service, result, bytes, capacity)) return result;
  const size_t size = call(result);
  note(service, result, bytes, std::min(size, capacity));
  return result;
}

void ServiceLog::forgetBefore(size_t position) {
  log_.erase(log_.begin(), log_.begin() + static_cast<ptrdiff_t>(position - forgotten_));
  log_.shrink_to_fit();
  next_ -= position - forgotten_;
  forgotten_ = position;
}

bool ServiceLog::isFirstReport() {
  bool is_first = false;
  ask(Service::Report, nullptr, 0, [&](int64_t&) -> size_t {
    is_first = true;
    return 0;
  });
  return is_first;
}

void ServiceLog::serve(rung_host& host) {
  session_ = host;
  if (host.files != nullptr) {
    wrapFiles();
    host.files = &files_;
    host.files_data = this;
  }
  if (host.channels != nullptr) {
    wrapChannels();
    host.channels = &channels_;
    host.channels_data = this;
  }
}

// A service whose answer is a number.
template <class Services, class... Arguments, int64_t (*Services::*member)(void*, Arguments...)>
struct ServiceLog::Forward<member> {
  static int64_t call(void* to, Arguments... arguments) {
    ServiceLog& log = of(to);
    constexpr const Services* kKind = nullptr;
    return log.ask(Service::Plain, nullptr, 0, [&](int64_t& result) -> size_t {
      result = (log.services(kKind).*member)(log.data(kKind), arguments...);
      return 0;
    });
  }
};

void ServiceLog::wrapFiles() {
  files_.open = Forward<&rung_files::open>::call;
  files_.close = Forward<&rung_files::close>::call;
  files_.write = Forward<&rung_files::write>::call;
  files_.seek = Forward<&rung_files::seek>::call;
  files_.size = Forward<&rung_files::size>::call;
  files_.remove = Forward<&rung_files::remove>::call;
  files_.rename = Forward<&rung_files::rename>::call;
  files_.make_folder = Forward<&rung_files::make_folder>::call;
  files_.remove_folder = Forward<&rung_files::remove_folder>::call;
  files_.begin = Forward<&rung_files::begin>::call;
  files_.read = [](void* to, int64_t file, void* bytes, uint64_t count) {
    ServiceLog& log = of(to);
    return log.ask(Service::Bytes, bytes, count, [&](int64_t& result) -> size_t {
      result = log.session_.files->read(log.session_.files_data, file, bytes, count);
      return result > 0 ? static_cast<size_t>(result) : 0;
    });
  };
  files_.result = [](void* to, int64_t work, void* bytes, uint64_t capacity) {
    ServiceLog& log = of(to);
    return log.ask(Service::Bytes, bytes, capacity, [&](int64_t& result) -> size_t {
      result = log.session_.files->result(log.session_.files_data, work, bytes, capacity);
      return result > 0 ? capacity : 0;  // bytes or rows
    });
  };
}

void ServiceLog::wrapChannels() {
  channels_.open = Forward<&rung_channels::open>::call;
  channels_.write = Forward<&rung_channels::write>::call;
  channels_.close = Forward<&rung_channels::close>::call;
  channels_.status = [](void* to, int64_t channel, rung_channel_status* status) {
    ServiceLog& log = of(to);
    return log.ask(Service::Status, status, sizeof *status, [&](int64_t& result) -> size_t {
      result = log.session_.channels->status(log.session_.channels_data, channel, status);
      return sizeof *status;
    });
  };
  channels_.read = [](void* to, int64_t channel, void* bytes, uint64_t count, rung_endpoint* from) {
    ServiceLog& log = of(to);
    rung_endpoint sender{};
    const int64_t read = log.ask(Service::Bytes, bytes, count, [&](int64_t& result) -> size_t {
      result = log.session_.channels->read(log.session_.channels_data, channel, bytes, count, &sender);
      return result > 0 ? static_cast<size_t>(result) : 0;
    });
    if (from == nullptr) return read;
    log.ask(Service::Sender, &sender, sizeof sender, [](int64_t&) -> size_t { return sizeof(rung_endpoint); });
    *from = sender;
    return read;
  };
}

}  // namespace rung::debug
