// SPDX-License-Identifier: Apache-2.0
#include "tools/monitor/recording.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>

#include "stdlib/runtime/host/clock.h"
#include "stdlib/runtime/host/csv.h"
#include "stdlib/runtime/host/symbols.h"
#include "tools/driver/options.h"
#include "tools/monitor/table.h"

namespace rung::monitor {
namespace {

int stop_pipe[2] = {-1, -1};

void onInterrupt(int) { (void)!write(stop_pipe[1], "", 1); }

// While it lives, Ctrl-C and SIGTERM make a descriptor readable instead of ending the process.
class Interrupts {
 public:
  Interrupts() {
    if (pipe2(stop_pipe, O_CLOEXEC | O_NONBLOCK) != 0) return;
    struct sigaction action {};
    action.sa_handler = onInterrupt;
    sigaction(SIGINT, &action, &interrupt_);
    sigaction(SIGTERM, &action, &termination_);
  }
  ~Interrupts() {
    if (stop_pipe[0] < 0) return;
    sigaction(SIGINT, &interrupt_, nullptr);
    sigaction(SIGTERM, &termination_, nullptr);
    close(stop_pipe[0]);
    close(stop_pipe[1]);
  }
  Interrupts(const Interrupts&) = delete;
  Interrupts& operator=(const Interrupts&) = delete;
  int descriptor() const { return stop_pipe[0]; }

 private:
  struct sigaction interrupt_ {
  }, termination_{};
};

// Rows of CSV, with a header of the first event.
class Rows {
 public:
  explicit Rows(std::FILE* out) : out_(out) {}
  bool add(const Json& event) {
    std::string row;
    const Json::Object& values = event["values"].members();
    if (!has_header_) {
      row = "cycle,time_ms";
      for (const host::JsonMember& value : values) host::appendCell(row += ',', value.name);
      row += '\n';
    }
    has_header_ = true;
    row += event["cycle"].toText() + ',' + event["time_ms"].toText();
    for (const host::JsonMember& value : values) host::appendCell(row += ',', value.value.text());
    row += '\n';
    return std::fputs(row.c_str(), out_) >= 0 && std::fflush(out_) == 0;
  }

 private:
  std::FILE* out_;
  bool has_header_ = false;
};

std::string refusalOf(const Client::Answer& answer) { return answer.error; }

// The list of the paths on the server: a request line has less room.
Client::Answer openStream(Client& client, const Recording& recording) {
  Json paths{Json::Array()};
  for (const std::string& path : host::splitList(recording.paths)) paths.add(path);
  Client::Answer list = client.post("/api/watch", Json{{"paths", paths}});
  if (!list.error.empty()) return list;
  return client.open("/api/stream?watch=" + list.value["id"].toText() + "&rate=" + std::to_string(recording.rate));
}

}  // namespace

int record(Client& client, const Recording& recording, driver::Sink& sink) {
  const Client::Answer opened = openStream(client, recording);
  if (!opened.error.empty()) {
    sink.error(refusalOf(opened));
    return opened.is_refused ? driver::kInputErrors : driver::kUsage;
  }
  std::FILE* const out = recording.file == "-" ? sink.programOutput() : std::fopen(recording.file.c_str(), "we");
  if (out == nullptr) return sink.error(recording.file + ": " + strerror(errno)), driver::kUsage;
  const Interrupts interrupts;
  bool is_written = true, has_ended = false;
  {
    Rows rows(out);
    Table table(out);
    const int64_t begin = host::monotonicNs();
    for (int64_t row = 0; is_written && (recording.rows < 0 || row < recording.rows); ++row) {
      const int64_t left_ns = recording.for_ns < 0 ? INT32_MAX : recording.for_ns - (host::monotonicNs() - begin);
      Json event;
      const Client::Event kind =
          client.next(event, interrupts.descriptor(), recording.for_ns < 0 ? INT32_MAX : left_ns / 1'000'000);
      has_ended = kind == Client::Event::End;
      if (kind != Client::Event::Values) break;
      if (recording.is_table)
        table.show(event);
      else
        is_written = rows.add(event);
    }
  }
  const bool is_file = recording.file != "-";
  if (is_file && std::fclose(out) != 0) is_written = false;
  if (!is_written) return sink.error(recording.file + ": " + strerror(errno)), driver::kUsage;
  if (has_ended) sink.message("rung: the program has ended\n");
  return driver::kSuccess;
}

}  // namespace rung::monitor
