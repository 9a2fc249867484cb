// SPDX-License-Identifier: Apache-2.0
// The reader of `.cam` files; see cam_file.h.
#include "frontend/import/cam/cam_file.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "cam/design/st_form.h"
#include "cam/design/words.h"
#include "frontend/import/cam/cam_checks.h"
#include "frontend/import/diagnostics.h"
#include "frontend/import/source_mapped_text.h"

namespace rung::importer::cams {
namespace {

using cam::Cam;
using cam::Kind;

constexpr size_t kMostUnit = 40;  // bytes
constexpr size_t kMostWords = 8;  // of a line: those of a polynomial

class CamReader {
 public:
  CamReader(const Sources& sources, FileId file, Diagnostics& diagnostics, Cam& cam, CamSource* places)
      : source_(sources.sourceText(file)),
        begin_(sources.begin(file)),
        diagnostics_(diagnostics),
        cam_(cam),
        places_(places) {}

  void read() {
    const size_t bad = findInvalidUtf8(source_);
    if (bad != std::string_view::npos) diagnostics_.report(diag::CamUtf8, locOf(source_.substr(bad))).length(1);
    for (size_t begin = 0; begin < source_.size() && !diagnostics_.full() && !is_foreign_;) {
      const size_t end = std::min(source_.find('\n', begin), source_.size());
      readLine(source_.substr(begin, end - begin));
      begin = end + 1;
    }
    if (!at_.name.loc) {
      if (!misses_name_) diagnostics_.report(diag::CamNoName, begin_).length(1);
      return;
    }
    for (const KeyOfNumbers& key : keys_of_numbers_) checkKeyOfNumbers(key);
    if (cam_.capacity != 0 && cam_.capacity < cam_.rowCount()) {
      diagnostics_
          .report(diag::CamCapacity, capacity_.loc,
                  {std::to_string(cam_.capacity), cam_.name, std::to_string(cam_.rowCount())})
          .length(capacity_.length);
    }
    if (!at_.repeat.loc) at_.repeat = at_.name;
    if (!at_.scale.loc) at_.scale = at_.name;
    checkCam(cam_, at_, !is_wrong_, diagnostics_);
  }

 private:
  struct Key {
    std::string_view word;
    const char* takes;
    void (CamReader::*read)();
    bool repeats;
  };
  struct KeyOfNumbers {
    std::string_view word;
    bool only_pairs;
  };

  static const std::array<Key, 15> kKeys;

  Loc locOf(std::string_view part) const {
    return {begin_.offset + static_cast<uint32_t>(part.data() - source_.data())};
  }
  Span spanOf(std::string_view word) const { return {locOf(word), static_cast<uint32_t>(word.size())}; }

  Report report(Diag diag, std::string_view word, std::initializer_list<std::string_view> args = {}) {
    is_wrong_ = true;
    return diagnostics_.report(diag, locOf(word), args).length(static_cast<uint32_t>(word.size()));
  }

  void splitLine(std::string_view line) {
    words_.clear();
    for (size_t at = 0; at < line.size();) {
      const size_t begin = line.find_first_not_of(" \t\r", at);
      if (begin == std::string_view::npos || line[begin] == '#') return;
      at = std::min(line.find_first_of(" \t\r", begin), line.size());
      words_.push_back(line.substr(begin, at - begin));
    }
  }

  void readLine(std::string_view line) {
    splitLine(line);
    if (words_.empty()) return;
    const auto row = std::find_if(kKeys.begin(), kKeys.end(), [&](const Key& key) { return key.word == words_[0]; });
    if (row == kKeys.end()) {
      std::vector<std::string_view> keys;
      keys.reserve(kKeys.size());
      for (const Key& key : kKeys) keys.push_back(key.word);
      // The first key misspelled is one mistake, and a file of another tool is one too.
      const bool is_first = seen_.empty() && !misses_name_;
      if (is_first) misses_name_ = true;
      is_foreign_ = is_first && nearest(words_[0], keys).empty();
      if (is_foreign_) {
        report(diag::CamNoName, words_[0]);
        return;
      }
      report(diag::CamUnknownKey, words_[0], {words_[0]}).didYouMean(nearest(words_[0], keys));
      return;
    }
    key_ = &*row;
    next_ = 1;
    if (!at_.name.loc && row->word != "cam" && !misses_name_) {
      misses_name_ = true;
      report(diag::CamNoName, words_[0]);
    }
    if (row->repeats || isFirst(*row)) (this->*row->read)();
  }

  bool isFirst(const Key& key) { return isFirst(key.word, words_[0]); }
  bool isFirst(std::string_view what, std::string_view word) {
    for (const auto& [seen, loc] : seen_) {
      if (seen != what) continue;
      report(diag::CamDuplicateKey, word, {what}).declaredHere(loc);
      return false;
    }
    seen_.emplace_back(what, locOf(word));
    return true;
  }

  // Reading the words after the key. Each reports at most once on a line.

  bool isAtEnd() const { return next_ == words_.size(); }

  void wrong(std::string_view word) { report(diag::CamValue, word, {words_[0], key_->takes}); }

  bool take(std::string_view& word) {
    if (isAtEnd()) return wrong(words_[0]), false;
    word = words_[next_++];
    return true;
  }

  bool expectEnd() {
    if (isAtEnd()) return true;
    wrong(words_[next_]);
    return false;
  }

  bool takeNumber(double& number) {
    std::string_view word;
    return take(word) && parse(word, number);
  }

  bool parse(std::string_view word, double& number) {
    const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), number);
    const bool is_number = end == word.data() + word.size();
    if (is_number && code == std::errc() && std::isfinite(number)) return true;
    const bool is_beyond = is_number && code == std::errc::result_out_of_range;
    report(is_beyond ? diag::CamOutOfRange : is_number ? diag::CamNan : diag::CamNotANumber, word, {word, "LREAL"});
    return false;
  }

  bool takePositive(double& number) {
    std::string_view word;
    if (!take(word) || !parse(word, number)) return false;
    if (number <= 0) wrong(word);
    return number > 0;
  }

  bool takeWhole(std::string_view word, uint64_t low, uint64_t high, uint64_t& number) {
    const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), number);
    return end == word.data() + word.size() && code == std::errc() && number >= low && number <= high;
  }

  bool takeUnit(std::string& unit) {
    if (isAtEnd()) return true;
    const std::string_view word = words_[next_++];
    if (word.size() > kMostUnit) return wrong(word), false;
    unit = word;
    return true;
  }

  template <typename Words>
  static int indexIn(const Words& words, std::string_view word) {
    const auto at = std::find(std::begin(words), std::end(words), word);
    return at == std::end(words) || word.empty() ? -1 : static_cast<int>(at - std::begin(words));
  }

  // The keys.

  void readName() {
    std::string_view word;
    if (!take(word)) return misses_name_ = true, void();
    cam_.name = word;
    at_.name = spanOf(word);
    if (places_ != nullptr) places_->name = at_.name.loc;
    expectEnd();
  }

  void readRepeat() {
    std::string_view word;
    at_.repeat = spanOf(words_[0]);
    if (!take(word)) return;
    if (word == "closed")
      cam_.repeat = cam::Repeat::Closed;
    else if (word == "relative")
      cam_.repeat = cam::Repeat::Relative;
    else if (word != "modulo")
      return wrong(word);
    else if (!takePositive(cam_.slave_period))
      return;
    else
      cam_.repeat = cam::Repeat::Modulo;
    expectEnd();
  }

  void readMaster() {
    if (!takeNumber(cam_.start) || !takeNumber(cam_.end) || !takeUnit(cam_.master_unit) || !expectEnd()) return;
    at_.master = {locOf(words_[1]), static_cast<uint32_t>(words_[2].data() + words_[2].size() - words_[1].data())};
  }

  void readSlave() {
    if (isAtEnd()) return wrong(words_[0]);
    if (takeUnit(cam_.slave_unit)) expectEnd();
  }

  void readSpeed() {
    double speed = 0;
    if (takePositive(speed) && expectEnd()) cam_.limits.speed = speed;
  }

  void readLimit() {
    std::string_view what;
    if (!take(what)) return;
    if (what == "position") {
      double low = 0, high = 0;
      if (!isFirst("limit position", what) || !takeNumber(low) || !takeNumber(high) || !expectEnd()) return;
      if (!(low < high)) return wrong(words_[2]);
      cam_.limits.low = low;
      cam_.limits.high = high;
      if (places_ != nullptr) places_->position = locOf(words_[0]);
      return;
    }
    for (size_t i = 0; i < std::size(cam::kLimitRows); ++i) {
      const cam::LimitRow& row = cam::kLimitRows[i];
      if (what != row.word) continue;
      constexpr std::string_view kSeen[] = {"limit velocity", "limit acceleration", "limit jerk"};
      double number = 0;
      if (!isFirst(kSeen[i], what) || !takePositive(number) || !expectEnd()) return;
      cam_.limits.*row.value = number;
      constexpr Loc CamSource::*kLocs[] = {&CamSource::velocity, &CamSource::acceleration, &CamSource::jerk};
      if (places_ != nullptr) places_->*kLocs[i] = locOf(words_[0]);
      return;
    }
    wrong(what);
  }

  void readCapacity() {
    std::string_view word;
    uint64_t capacity = 0;
    if (!take(word)) return;
    if (!takeWhole(word, 1, cam::kMostRows, capacity)) return wrong(word);
    cam_.capacity = capacity;
    capacity_ = spanOf(word);
    expectEnd();
  }

  void readNumber() {
    std::string_view word;
    if (!take(word)) return;
    const int index = indexIn(cam::kNumberWords, word);
    if (index < 0) return wrong(word);
    cam_.number = static_cast<cam::Number>(index);
    keys_of_numbers_.push_back({words_[0], false});
    expectEnd();
  }

  void readInterpolation() {
    std::string_view word;
    if (!take(word)) return;
    if (word != "cubic" && word != "linear") return wrong(word);
    cam_.cubic = word == "cubic";
    keys_of_numbers_.push_back({words_[0], false});
    expectEnd();
  }

  void readScale() {
    cam::Scale scale;
    if (!takeNumber(scale.table_min) || !takeNumber(scale.table_max) || !takeNumber(scale.master_min) ||
        !takeNumber(scale.master_max) || !expectEnd())
      return;
    // All four 0 is how MC_CAM_REF says that numbers are positions.
    if (scale.table_min == scale.table_max || scale.master_min == scale.master_max) return wrong(words_[1]);
    cam_.scale = scale;
    at_.scale = spanOf(words_[0]);
    keys_of_numbers_.push_back({words_[0], true});
  }

  void checkKeyOfNumbers(const KeyOfNumbers& key) {
    const bool fits = cam_.kind == Kind::Pairs || (cam_.kind == Kind::Equidistant && !key.only_pairs);
    if (!fits && has_rows_)
      report(diag::CamKeyOfNumbers, key.word,
             {key.word, key.only_pairs ? "`pair`" : "`value` or `pair`", wordOf(cam::kRowWords, cam_.kind)});
  }

  // The rows.

  bool isRowOf(Kind kind) {
    if (!has_rows_) {
      has_rows_ = true;
      cam_.kind = kind;
      first_row_ = locOf(words_[0]);
    }
    if (cam_.kind == kind) return true;
    report(diag::CamMixedRows, words_[0], {words_[0], wordOf(cam::kRowWords, cam_.kind)})
        .note(first_row_, diag::FirstRow);
    return false;
  }

  void readPoint() {
    if (!isRowOf(Kind::QuinticPoints)) return;
    cam::SegmentKind segment = cam::SegmentKind::Quintic;
    if (words_.back() == "line") {
      segment = cam::SegmentKind::Line;
      words_.pop_back();
    }
    cam::Point point{0, 0, 0, 0};
    if (!takeNumber(point.x) || !takeNumber(point.y)) return;
    if (!isAtEnd() && !takeNumber(point.slope)) return;
    if (!isAtEnd() && !takeNumber(point.curvature)) return;
    if (!expectEnd()) return;
    cam_.points.push_back(point);
    cam_.segments.push_back(segment);
    at_.rows.push_back(spanOf(words_[1]));
  }

  void readPolynomial() {
    if (!isRowOf(Kind::Polynomials)) return;
    cam::Polynomial polynomial{0, {0, 0, 0, 0, 0, 0}};
    if (!takeNumber(polynomial.x) || !takeNumber(polynomial.c[0])) return;
    for (size_t i = 1; i < std::size(polynomial.c) && !isAtEnd(); ++i)
      if (!takeNumber(polynomial.c[i])) return;
    if (!expectEnd()) return;
    cam_.polynomials.push_back(polynomial);
    at_.rows.push_back(spanOf(words_[1]));
  }

  bool takeNumberOfTable() {
    double number = 0;
    if (!takeNumber(number)) return false;
    cam_.numbers.push_back(number);
    at_.numbers.push_back(spanOf(words_[next_ - 1]));
    return true;
  }

  void readValue() {
    if (!isRowOf(Kind::Equidistant) || !takeNumberOfTable() || !expectEnd()) return;
    at_.rows.push_back(spanOf(words_[1]));
  }

  void readPair() {
    if (!isRowOf(Kind::Pairs) || !takeNumberOfTable() || !takeNumberOfTable() || !expectEnd()) return;
    at_.rows.push_back(spanOf(words_[1]));
  }

  void readTappet() {
    cam::Tappet tappet;
    std::string_view group, action;
    if (!takeNumber(tappet.x) || !take(group)) return;
    uint64_t number = 0;
    if (!takeWhole(group, 0, cam::kMostGroup, number)) {
      report(diag::CamGroup, group, {group});
      return;
    }
    tappet.group = static_cast<int32_t>(number);
    if (!take(action)) return;
    const int index = indexIn(cam::kActionWords, action);
    if (index < 0) return wrong(action);
    tappet.action = static_cast<cam::TappetAction>(index);
    bool has_direction = false, has_delay = false, has_duration = false;
    while (!isAtEnd()) {
      const std::string_view word = words_[next_++];
      if (const int direction = indexIn(cam::kDirectionWords, word); direction >= 0 && !has_direction) {
        tappet.direction = static_cast<cam::TappetDirection>(direction);
        has_direction = true;
      } else if (word == "delay" && !has_delay) {
        if (!takeTime(tappet.delay)) return;
        has_delay = true;
      } else if (word == "duration" && !has_duration) {
        if (!takeTime(tappet.duration)) return;
        has_duration = true;
      } else {
        return wrong(word);
      }
    }
    cam_.tappets.push_back(tappet);
    at_.tappets.push_back(spanOf(words_[1]));
  }

  // `500us`, `20ms`, `1s`
  bool takeTime(uint32_t& time) {
    std::string_view word;
    if (!take(word)) return false;
    uint64_t number = 0;
    const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), number);
    const std::string_view unit(end, static_cast<size_t>(word.data() + word.size() - end));
    const uint64_t factor = unit == "us" ? 1 : unit == "ms" ? 1000 : unit == "s" ? 1'000'000 : 0;
    if (code != std::errc() || factor == 0 || number > UINT32_MAX / factor) {
      report(diag::CamTime, word, {word});
      return false;
    }
    time = static_cast<uint32_t>(number * factor);
    return true;
  }

  std::string_view source_;
  Loc begin_;
  Diagnostics& diagnostics_;
  Cam& cam_;
  CamSource* places_;
  CamLocations at_;
  std::vector<std::string_view> words_;  // of the line
  const Key* key_ = nullptr;
  size_t next_ = 0;
  std::vector<std::pair<std::string_view, Loc>> seen_;
  std::vector<KeyOfNumbers> keys_of_numbers_;
  Span capacity_;
  Loc first_row_;
  bool has_rows_ = false, misses_name_ = false, is_wrong_ = false;
  bool is_foreign_ = false;  // its first line has no key of a cam
};

constexpr std::array<CamReader::Key, 15> CamReader::kKeys = {{
    {"cam", "a name", &CamReader::readName, false},
    {"repeat", "`closed`, `relative` or `modulo PERIOD`", &CamReader::readRepeat, false},
    {"master", "`START END` and a unit", &CamReader::readMaster, false},
    {"slave", "a unit", &CamReader::readSlave, false},
    {"speed", "a number above 0", &CamReader::readSpeed, false},
    {"limit", "`position LOW HIGH`, or `velocity`, `acceleration` or `jerk` with a number above 0",
     &CamReader::readLimit, true},
    {"capacity", "a number of rows from 1 to 32767", &CamReader::readCapacity, false},
    {"number", "INT, UINT, DINT, UDINT, REAL or LREAL", &CamReader::readNumber, false},
    {"interpolation", "`cubic` or `linear`", &CamReader::readInterpolation, false},
    {"scale", "`TABLE_MIN TABLE_MAX MASTER_MIN MASTER_MAX`, with two numbers that differ and two positions",
     &CamReader::readScale, false},
    {"point", "`X Y [V [A]] [line]`", &CamReader::readPoint, true},
    {"polynomial", "`X C0 [C1 [C2 [C3 [C4 [C5]]]]]`", &CamReader::readPolynomial, true},
    {"value", "`Y`", &CamReader::readValue, true},
    {"pair", "`X Y`", &CamReader::readPair, true},
    {"tappet", "`X GROUP ACTION [DIRECTION] [delay TIME] [duration TIME]`", &CamReader::readTappet, true},
}};

}  // namespace

bool readCam(const Sources& sources, FileId file, Diagnostics& diagnostics, Cam& cam, CamSource* places) {
  const uint32_t errors = diagnostics.errorCount() + diagnostics.droppedCount();
  cam = {};
  CamReader(sources, file, diagnostics, cam, places).read();
  return diagnostics.errorCount() + diagnostics.droppedCount() == errors;
}

FileId readProgram(ReadContext& context, FileId file) {
  Cam cam;
  CamSource places;
  if (!readCam(context.sources, file, context.diagnostics, cam, &places)) return {};
  xml::SourceMappedText program(context.sources);
  program.put(places.name, globalsOf(cam, cam::Duplicates::AreErrors));
  return program.finish(context.sources, file);
}

}  // namespace rung::importer::cams
