// SPDX-License-Identifier: Apache-2.0
// The output of `rung list`: lines of text, or JSON with an object for each. Shared by list.cpp and list_tasks.cpp.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "frontend/source/render.h"
#include "tools/driver/options.h"
#include "tools/driver/sink.h"

namespace rung::driver {

// One object of a JSON list: `{"name":"x","line":3}`.
class JsonRow {
 public:
  JsonRow& text(const char* name, std::string_view value) { return raw(name, jsonQuote(value)); }
  JsonRow& number(const char* name, uint64_t value) { return raw(name, std::to_string(value)); }
  JsonRow& texts(const char* name, const std::vector<std::string>& values) {
    std::string list;
    for (const std::string& value : values) list += (list.empty() ? "" : ",") + jsonQuote(value);
    return raw(name, '[' + list + ']');
  }
  JsonRow& rows(const char* name, const std::vector<JsonRow>& values) {
    std::string list;
    for (const JsonRow& value : values) list += (list.empty() ? "" : ",") + value.string();
    return raw(name, '[' + list + ']');
  }
  std::string string() const { return '{' + fields_ + '}'; }

 private:
  JsonRow& raw(const char* name, const std::string& value) {
    fields_ += (fields_.empty() ? "\"" : ",\"") + std::string(name) + "\":" + value;
    return *this;
  }
  std::string fields_;
};

// The rows of a list, in the requested format.
class List {
 public:
  explicit List(const ReportOptions& report) : is_json_(report.format == DiagnosticFormat::Json) {}
  void add(const std::string& line, const JsonRow& row) {
    if (!is_json_) {
      out_ += line;
    } else {
      out_ += (out_.empty() ? "" : ",\n ") + row.string();
    }
  }
  std::string text() const { return is_json_ ? '[' + out_ + "]\n" : out_; }
  bool empty() const { return out_.empty(); }

 private:
  bool is_json_;
  std::string out_;
};

// The names of the NCT ladder: symbols, instructions, services, execution codes. (list_nct.cpp)
int listNct(const ProjectOptions& project, Sink& sink);
// The tasks of a project, what they run, and in which order. (list_tasks.cpp)
int listTasks(const ProjectOptions& project, Sink& sink);
// The tests of a project, without running them. (test_list.cpp)
int listTests(const ProjectOptions& project, const TestOptions& options, Sink& sink);

}  // namespace rung::driver
