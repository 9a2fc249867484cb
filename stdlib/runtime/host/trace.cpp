#include "trace.h"

#include <sys/stat.h>
#include <unistd.h>
#include <cerrno>
#include <cstring>

#include "csv.h"
#include "value_text.h"

namespace rung::host {

std::string millisecondsOf(int64_t ns) {
  std::string text = std::to_string(ns / 1'000'000);
  int64_t fraction = ns % 1'000'000;
  if (fraction == 0) return text;
  std::string digits = std::to_string(1'000'000 + fraction).substr(1);
  while (digits.back() == '0') digits.pop_back();
  return text + '.' + digits;
}

Trace::~Trace() {
  if (file_ != nullptr && file_ != stdout) fclose(file_);
  if (!temporary_.empty()) unlink(temporary_.c_str());
}

bool Trace::choose(const std::string& watch, std::string& error) {
  if (watch.empty()) {
    variables_ = symbols_.ofPrograms();
    return true;
  }
  for (const std::string& path : splitList(watch)) {
    Variable variable;
    if (!symbols_.find(path, variable, error)) return false;
    variable.path = path;  // columns are named as the user wrote them
    if (variable.type->kind == RUNG_POINTER)
      variables_.push_back(variable);
    else
      symbols_.expand(variable, variables_);
  }
  return true;
}

bool Trace::open(const std::string& path, std::string& error) {
  if (path.empty()) return true;
  path_ = path;
  if (path == "-") {
    file_ = stdout;
  } else {
    // A temporary beside it, renamed at the end; devices and pipes are written directly.
    struct stat status;
    const bool regular = stat(path.c_str(), &status) != 0 || S_ISREG(status.st_mode);
    const std::string target = regular ? path + ".tmp" + std::to_string(getpid()) : path;
    file_ = fopen(target.c_str(), "wb");
    if (file_ == nullptr) {
      error = path + ": " + strerror(errno);
      return false;
    }
    if (regular) temporary_ = target;
  }
  buffer_ = "cycle,time_ms";
  for (const Variable& variable : variables_) {
    buffer_ += ',';
    appendCell(buffer_, variable.path);
  }
  buffer_ += '\n';
  return true;
}

void Trace::row(int64_t cycle, int64_t time_ns) {
  if (file_ == nullptr) return;
  buffer_ += std::to_string(cycle);
  buffer_ += ',';
  buffer_ += millisecondsOf(time_ns);
  for (const Variable& variable : variables_) {
    buffer_ += ',';
    if (variable.type->kind == RUNG_STRING || variable.type->kind == RUNG_WSTRING || variable.type->kind == RUNG_CHAR ||
        variable.type->kind == RUNG_WCHAR) {
      cell_.clear();
      spellValue(symbols_.module(), variable, cell_);
      appendCell(buffer_, cell_);
    } else {
      spellValue(symbols_.module(), variable, buffer_);  // never needs quotes
    }
  }
  buffer_ += '\n';
  if (buffer_.size() >= size_t{1} << 16) flush();
}

bool Trace::flush() {
  const bool good = fwrite(buffer_.data(), 1, buffer_.size(), file_) == buffer_.size();
  buffer_.clear();
  return good;
}

bool Trace::close(std::string& error) {
  if (file_ == nullptr) return true;
  bool good = flush() && fflush(file_) == 0 && ferror(file_) == 0;
  if (file_ != stdout) good = fclose(file_) == 0 && good;
  file_ = nullptr;
  if (good && !temporary_.empty()) good = rename(temporary_.c_str(), path_.c_str()) == 0;
  if (good)
    temporary_.clear();
  else
    error = path_ + ": " + strerror(errno);
  return good;
}

std::string Trace::lastRow() const {
  std::string lines;
  for (const Variable& variable : variables_) {
    lines += variable.path;
    lines += " = ";
    spellValue(symbols_.module(), variable, lines);
    lines += '\n';
  }
  return lines;
}

}  // namespace rung::host
