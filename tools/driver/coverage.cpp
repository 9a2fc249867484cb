// SPDX-License-Identifier: Apache-2.0
// Line coverage of `rung test`: see coverage.h.
#include "tools/driver/coverage.h"

#include <algorithm>
#include <cstdio>

namespace rung::driver {
namespace {

uint64_t hitCount(const std::map<uint32_t, uint64_t>& lines) {
  return static_cast<uint64_t>(std::count_if(lines.begin(), lines.end(), [](const auto& l) { return l.second != 0; }));
}

// `14, 31-33`: ranges of lines that never ran.
std::string missedRanges(const std::map<uint32_t, uint64_t>& lines) {
  std::string out;
  uint32_t first = 0, last = 0;
  const auto end = [&] {
    if (first == 0) return;
    if (!out.empty()) out += ", ";
    out += std::to_string(first);
    if (last != first) out += '-' + std::to_string(last);
    first = 0;
  };
  for (const auto& [line, count] : lines) {
    if (count != 0) {
      end();
      continue;
    }
    if (first == 0) first = line;
    last = line;
  }
  end();
  return out;
}

}  // namespace

void Coverage::add(const ir::interpreter::Program& program) {
  // A line may have several statements: it ran as often as the most frequent one.
  std::map<std::string, std::map<uint32_t, uint64_t>> lines;
  for (const ir::interpreter::Counter& counter : program.counters()) {
    if (counter.function != nullptr) {
      files_[counter.file].functions[{counter.line, counter.function}] += counter.count;
    } else if (counter.branch != 0) {
      files_[counter.file].branches[{counter.line, counter.column}][counter.branch] += counter.count;
    } else {
      uint64_t& count = lines[counter.file][counter.line];
      count = std::max(count, counter.count);
    }
  }
  for (const auto& [file, counts] : lines)
    for (const auto& [line, count] : counts) files_[file].lines[line] += count;
}

const std::string& Coverage::shown(const std::string& below) const {
  const auto known = shown_.find(below);
  return known == shown_.end() ? below : known->second;
}

std::string Coverage::text() const {
  size_t width = 10;
  for (const auto& [below, file] : files_) width = std::max(width, shown(below).size());
  std::string out;
  const auto row = [&](const std::string& name, uint64_t lines, uint64_t hit, const std::string& missed) {
    char cells[96];
    const double percent = lines == 0 ? 100.0 : 100.0 * static_cast<double>(hit) / static_cast<double>(lines);
    snprintf(cells, sizeof cells, " %7llu %7llu %7.1f%%", static_cast<unsigned long long>(lines),
             static_cast<unsigned long long>(hit), percent);
    out += name + std::string(width - name.size(), ' ') + cells + (missed.empty() ? "" : "  " + missed) + '\n';
  };
  out = "coverage" + std::string(width - 8, ' ') + "   lines     hit  percent  missed\n";
  uint64_t lines = 0, hit = 0;
  for (const auto& [below, file] : files_) {
    const uint64_t hit_here = hitCount(file.lines);
    row(shown(below), file.lines.size(), hit_here, missedRanges(file.lines));
    lines += file.lines.size();
    hit += hit_here;
  }
  row("total", lines, hit, "");
  return out;
}

// BRDA: line, number of the IF or CASE on the line, branch, how often it was taken or `-`: the statement never ran.
void Coverage::appendBranches(std::string& out, const File& file) {
  uint64_t found = 0, hit = 0;
  uint32_t line = 0, number = 0;
  for (const auto& [position, counts] : file.branches) {
    number = position.first == line ? number + 1 : 0;
    line = position.first;
    uint64_t runs = 0;
    for (const auto& [branch, count] : counts) runs += count;
    for (const auto& [branch, count] : counts) {
      out += "BRDA:" + std::to_string(line) + ',' + std::to_string(number) + ',' + std::to_string(branch - 1) + ',' +
             (runs == 0 ? "-" : std::to_string(count)) + '\n';
      ++found;
      hit += count != 0;
    }
  }
  if (found != 0) out += "BRF:" + std::to_string(found) + "\nBRH:" + std::to_string(hit) + '\n';
}

std::string Coverage::lcov() const {
  std::string out;
  for (const auto& [below, file] : files_) {
    out += "TN:\nSF:" + shown(below) + '\n';
    for (const auto& [function, count] : file.functions)
      out += "FN:" + std::to_string(function.first) + ',' + function.second + '\n';
    uint64_t called = 0;
    for (const auto& [function, count] : file.functions) {
      out += "FNDA:" + std::to_string(count) + ',' + function.second + '\n';
      called += count != 0;
    }
    out += "FNF:" + std::to_string(file.functions.size()) + "\nFNH:" + std::to_string(called) + '\n';
    appendBranches(out, file);
    for (const auto& [line, count] : file.lines)
      out += "DA:" + std::to_string(line) + ',' + std::to_string(count) + '\n';
    out += "LF:" + std::to_string(file.lines.size()) + "\nLH:" + std::to_string(hitCount(file.lines)) +
           "\nend_of_record\n";
  }
  return out;
}

}  // namespace rung::driver
