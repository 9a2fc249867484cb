// SPDX-License-Identifier: Apache-2.0
// Work on files off the cycle (rung_file_work). In real time a thread does it, one after the other; in virtual time it
// is done when its result is asked for, so that runs are reproducible. In real time memory is reserved in advance:
// begin and result copy, and do not wait for the disk. In: work. Out: results. Called by files.cpp and run.cpp.
#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "rung/module.h"

namespace rung::host {

class Files;

class FileWork {
 public:
  static constexpr uint64_t kMostEntries = 64;

  FileWork(Files& files, bool in_background) : files_(files), in_background_(in_background) {}
  ~FileWork() { end(); }
  FileWork(const FileWork&) = delete;
  FileWork& operator=(const FileWork&) = delete;

  // Reserves the memory, and in real time starts the thread. Without it the first work does.
  void start();
  int64_t begin(const rung_file_work& work);
  int64_t result(int64_t number, void* bytes, uint64_t capacity);
  // Completes what is begun.
  void end();

 private:
  static constexpr size_t kMostRequests = 32;
  enum State : uint8_t { Free, Waiting, Busy, Complete };
  struct Request {
    State state = Free;
    uint8_t kind = 0;
    uint32_t flags = 0;
    int64_t file = 0;
    uint64_t count = 0, found = 0;  // bytes
    int64_t result = 0;
    uint64_t order = 0;
    char name[256] = {}, target[256] = {};
    char bytes[kMostEntries * sizeof(rung_file_entry)];
  };
  void execute(Request& request);
  Request* next();
  void runThread();

  Files& files_;
  const bool in_background_;
  std::mutex mutex_;
  std::condition_variable condition_;
  std::unique_ptr<Request[]> requests_;  // once started
  std::thread thread_;
  uint64_t begun_ = 0;
  bool ending_ = false;
};

}  // namespace rung::host
