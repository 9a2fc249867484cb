// SPDX-License-Identifier: Apache-2.0
// Work on files: see file_work.h.
#include "file_work.h"

#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <cstring>

#include "file_place.h"
#include "file_tree.h"
#include "files.h"

namespace rung::host {
namespace {

bool copyName(const char* from, char (&to)[256]) {
  const size_t length = from == nullptr ? 0 : strlen(from);
  if (length >= sizeof to) return false;
  memcpy(to, from == nullptr ? "" : from, length + 1);
  return true;
}

// read() may return less than there is.
int64_t readUpTo(int descriptor, char* bytes, uint64_t count) {
  uint64_t done = 0;
  while (done < count) {
    const ssize_t got = read(descriptor, bytes + done, count - done);
    if (got < 0) return fileErrorOf(errno);
    if (got == 0) break;
    done += static_cast<uint64_t>(got);
  }
  return static_cast<int64_t>(done);
}

}  // namespace

void FileWork::start() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (requests_) return;
  requests_ = std::make_unique<Request[]>(kMostRequests);
  if (in_background_) thread_ = std::thread([this] { runThread(); });
}

int64_t FileWork::begin(const rung_file_work& work) {
  if (!requests_) start();
  const std::lock_guard<std::mutex> lock(mutex_);
  Request* const end = requests_.get() + kMostRequests;
  Request* const free =
      std::find_if(requests_.get(), end, [](const Request& request) { return request.state == Free; });
  if (free == end) return RUNG_FILE_FAILED;
  if (!copyName(work.name, free->name) || !copyName(work.target, free->target)) return RUNG_FILE_NAME;
  free->kind = work.kind;
  free->flags = work.flags;
  free->file = work.file;
  free->count = work.kind == RUNG_WORK_LIST ? std::min<uint64_t>(work.count, kMostEntries) : work.count;
  free->found = 0;
  const bool moves_bytes = work.kind == RUNG_WORK_WRITE || work.kind == RUNG_WORK_READ;
  if (moves_bytes && work.count > RUNG_WORK_BYTES) return RUNG_FILE_FAILED;
  if (work.kind == RUNG_WORK_WRITE) std::copy_n(static_cast<const char*>(work.bytes), work.count, free->bytes);
  free->order = ++begun_;
  free->state = Waiting;
  condition_.notify_one();
  return free - requests_.get() + 1;
}

int64_t FileWork::result(int64_t number, void* bytes, uint64_t capacity) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!requests_ || number < 1 || number > static_cast<int64_t>(kMostRequests)) return RUNG_FILE_HANDLE;
  Request& request = requests_[static_cast<size_t>(number - 1)];
  if (request.state == Free) return RUNG_FILE_HANDLE;
  while (!in_background_ && request.state == Waiting) {  // what began before it comes first
    Request& oldest = *next();
    execute(oldest);
    oldest.state = Complete;
  }
  if (request.state != Complete) return RUNG_FILE_BUSY;
  std::copy_n(request.bytes, std::min(capacity, request.found), static_cast<char*>(bytes));
  request.state = Free;
  return request.result;
}

FileWork::Request* FileWork::next() {
  Request* oldest = nullptr;
  for (size_t i = 0; requests_ && i < kMostRequests; ++i)
    if (requests_[i].state == Waiting && (oldest == nullptr || requests_[i].order < oldest->order))
      oldest = &requests_[i];
  return oldest;
}

void FileWork::execute(Request& request) {
  const std::string& root = files_.root();
  switch (static_cast<rung_file_work_kind>(request.kind)) {
    case RUNG_WORK_OPEN: request.result = files_.open(request.name, request.flags); break;
    case RUNG_WORK_WRITE: {
      const int descriptor = files_.descriptor(request.file);
      request.result = descriptor < 0 ? int64_t{RUNG_FILE_HANDLE} : writeAll(descriptor, request.bytes, request.count);
      break;
    }
    case RUNG_WORK_CLOSE: request.result = files_.close(request.file); break;
    case RUNG_WORK_LIST: {
      rung_file_entry entries[kMostEntries];
      request.result =
          listFolder(root, request.name, (request.flags & RUNG_WORK_ONLY_FILES) != 0, entries, request.count);
      if (request.result > 0) {
        request.found = static_cast<uint64_t>(request.result) * sizeof(rung_file_entry);
        memcpy(request.bytes, entries, request.found);
      }
      break;
    }
    case RUNG_WORK_COPY:
      request.result =
          copyTree(root, request.name, request.target, (request.flags & RUNG_WORK_OVERWRITE) != 0, request.count);
      break;
    case RUNG_WORK_REMOVE: request.result = removeTree(root, request.name); break;
    case RUNG_WORK_READ: {
      const int descriptor = files_.descriptor(request.file);
      request.result = descriptor < 0 ? int64_t{RUNG_FILE_HANDLE} : readUpTo(descriptor, request.bytes, request.count);
      request.found = request.result > 0 ? static_cast<uint64_t>(request.result) : 0;
      break;
    }
  }
}

void FileWork::runThread() {
  std::unique_lock<std::mutex> lock(mutex_);
  for (;;) {
    condition_.wait(lock, [this] { return ending_ || next() != nullptr; });
    Request* const request = next();
    if (request == nullptr) return;
    request->state = Busy;
    lock.unlock();
    execute(*request);
    lock.lock();
    request->state = Complete;
  }
}

void FileWork::end() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ending_ = true;
    if (!in_background_)
      for (Request* request = next(); request != nullptr; request = next()) {
        execute(*request);
        request->state = Complete;
      }
  }
  condition_.notify_one();
  if (thread_.joinable()) thread_.join();
}

}  // namespace rung::host
