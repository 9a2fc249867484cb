// SPDX-License-Identifier: Apache-2.0
// Native body of cam_file.st: reads the text of a `.cam` file (docs/cam.md) off the cycle, and a part of it in each
// call. The compiler's reader is frontend/import/cam; this one has no heap, and reports a number.
#include <math.h>
#include <string.h>

#include "blocks/cam_table.h"
#include "rung/reals.h"

using namespace rung_sm3_basic;
using namespace rung::motion;
namespace cam = rung::cam;

namespace {

using Block = SMC_ReadCAM_type;

enum Step : uint8_t { kIdle, kOpening, kReading, kClosing };

constexpr int kMostRows = 512;     // gc_SMC_FILE_MAXCAMEL
constexpr int kMostTappets = 128;  // gc_SMC_FILE_MAXCAMTAP
constexpr size_t kMostWords = 9;   // of a line

// The kinds of rows by their values, and how many numbers each has.
constexpr const char* kRowWords[] = {"polynomial", "value", "pair", "point"};
constexpr int kNumbersOfRow[] = {7, 1, 2, 4};
constexpr const char* kNumberWords[] = {"", "INT", "UINT", "DINT", "UDINT", "REAL", "LREAL"};
constexpr const char* kActionWords[] = {"on", "off", "invert", "pulse"};
constexpr const char* kDirectionWords[] = {"forward", "both", "backward"};
// About the design of the cam.
constexpr const char* kOtherWords[] = {"repeat", "slave", "speed", "limit", "capacity"};

// ---- words

struct Word {
  const char* text;
  size_t length;

  bool is(const char* other) const { return strlen(other) == length && memcmp(text, other, length) == 0; }
};

struct Line {
  Word words[kMostWords];
  size_t count = 0;
  bool is_too_long = false;
};

bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

Line split(const char* text, size_t length) {
  Line line;
  for (size_t at = 0; at < length;) {
    if (isBlank(text[at])) {
      ++at;
      continue;
    }
    const size_t begin = at;
    while (at < length && !isBlank(text[at])) ++at;
    if (line.count == kMostWords) {
      line.is_too_long = true;
      return line;
    }
    line.words[line.count++] = {text + begin, at - begin};
  }
  return line;
}

template <size_t count>
int indexOf(const char* const (&words)[count], const Word& word) {
  for (size_t i = 0; i < count; ++i)
    if (word.length > 0 && word.is(words[i])) return static_cast<int>(i);
  return -1;
}

bool readNumber(const Word& word, double& number) {
  const bool is_negative = word.length > 0 && word.text[0] == '-';
  const size_t sign = is_negative ? 1 : 0;
  size_t size = word.length - sign;
  if (rung_real_parse(word.text + sign, &size, false, &number) != RUNG_REAL_READ) return false;
  if (size != word.length - sign || !isFinite(number)) return false;
  if (is_negative) number = -number;
  return true;
}

// Digits, up to `most`; `length` becomes their number.
bool readWhole(const Word& word, uint64_t most, size_t& length, uint64_t& number) {
  number = 0;
  for (length = 0; length < word.length && word.text[length] >= '0' && word.text[length] <= '9'; ++length) {
    number = 10 * number + static_cast<uint64_t>(word.text[length] - '0');
    if (number > most) return false;
  }
  return length > 0;
}

// `500us`, `20ms`, `1s`
bool readTime(const Word& word, uint32_t& time) {
  size_t digits = 0;
  uint64_t number = 0;
  if (!readWhole(word, UINT32_MAX, digits, number)) return false;
  const Word unit = {word.text + digits, word.length - digits};
  const uint64_t factor = unit.is("us") ? 1 : unit.is("ms") ? 1000 : unit.is("s") ? 1000000 : 0;
  if (factor == 0 || number > UINT32_MAX / factor) return false;
  time = static_cast<uint32_t>(number * factor);
  return true;
}

// ---- lines

Error takeRow(Block& block, int kind, Line& line) {
  MC_CAM_REF_type& cam = block.CAM_;
  if (cam.nElements_ > 0 && cam.byType_ != kind) return SMC_RCAM_WRONG_COMPILE_TYPE_;
  if (cam.nElements_ >= kMostRows) return SMC_RCAM_TOO_MUCH_DATA_;
  const bool is_point = kind == XYVA_;
  const bool is_line = is_point && line.words[line.count - 1].is("line");
  if (is_line) --line.count;
  const size_t most = static_cast<size_t>(kNumbersOfRow[kind]), least = kind == X_ ? 1 : 2;
  if (line.count - 1 < least || line.count - 1 > most) return SMC_RCAM_WRONG_VERSION_;
  double* const row = block.numbers_ + static_cast<size_t>(cam.nElements_) * most;
  for (size_t i = 0; i < most; ++i) {
    row[i] = 0;
    if (i + 1 < line.count && !readNumber(line.words[i + 1], row[i])) return SMC_RCAM_WRONG_VERSION_;
  }
  block.segments_[cam.nElements_] = is_line ? Line_ : Poly5_;
  if (is_line) cam.pSegments_ = block.segments_;
  cam.byType_ = static_cast<int16_t>(kind);
  ++cam.nElements_;
  return SMC_NO_ERROR_;
}

bool readTappet(const Line& line, Tappet& tappet) {
  size_t digits = 0;
  uint64_t group = 0;
  tappet = {};
  if (line.count < 4 || !readNumber(line.words[1], tappet.x_)) return false;
  if (!readWhole(line.words[2], kMostGroup, digits, group) || digits != line.words[2].length) return false;
  const int action = indexOf(kActionWords, line.words[3]);
  tappet.iGroupID_ = static_cast<int16_t>(group);
  tappet.cta_ = static_cast<int16_t>(action);
  tappet.ctt_ = kBoth;
  for (size_t i = 4; i < line.count; ++i) {
    const int direction = indexOf(kDirectionWords, line.words[i]);
    const bool is_delay = line.words[i].is("delay");
    if (direction >= 0)
      tappet.ctt_ = static_cast<int16_t>(direction);
    else if ((!is_delay && !line.words[i].is("duration")) || i + 1 == line.count ||
             !readTime(line.words[++i], is_delay ? tappet.dwDelay_ : tappet.dwDuration_))
      return false;
  }
  return action >= 0;
}

Error takeTappet(Block& block, const Line& line) {
  if (block.CAM_.nTappets_ >= kMostTappets) return SMC_RCAM_TOO_MUCH_DATA_;
  if (!readTappet(line, block.tappets_[block.CAM_.nTappets_])) return SMC_RCAM_WRONG_VERSION_;
  ++block.CAM_.nTappets_;
  return SMC_NO_ERROR_;
}

bool takeName(Block& block, const Line& line) {
  if (line.count != 2 || line.words[1].length >= sizeof block.CAM_.strCAMName_) return false;
  memcpy(block.CAM_.strCAMName_, line.words[1].text, line.words[1].length);
  block.CAM_.strCAMName_[line.words[1].length] = 0;
  block.is_cam_ = 1;
  return true;
}

bool takeMaster(Block& block, const Line& line) {
  block.has_range_ = 1;
  return line.count >= 3 && line.count <= 4 && readNumber(line.words[1], block.CAM_.xStart_) &&
         readNumber(line.words[2], block.CAM_.xEnd_);
}

bool takeScale(Block& block, const Line& line) {
  MC_CAM_REF_type& cam = block.CAM_;
  return line.count == 5 && readNumber(line.words[1], cam.fTableMasterMin_) &&
         readNumber(line.words[2], cam.fTableMasterMax_) && readNumber(line.words[3], cam.fEditorMasterMin_) &&
         readNumber(line.words[4], cam.fEditorMasterMax_);
}

bool takeOption(Block& block, const Line& line, bool& is_known) {
  MC_CAM_REF_type& cam = block.CAM_;
  const Word& key = line.words[0];
  is_known = true;
  if (key.is("cam")) return takeName(block, line);
  if (key.is("master")) return takeMaster(block, line);
  if (key.is("scale")) return takeScale(block, line);
  if (key.is("number")) {
    const int type = line.count == 2 ? indexOf(kNumberWords, line.words[1]) : -1;
    cam.byVarType_ = static_cast<uint8_t>(type);
    return type > 0;
  }
  if (key.is("interpolation")) {
    const bool is_cubic = line.count == 2 && line.words[1].is("cubic");
    cam.byInterpolationQuality_ = is_cubic ? 3 : 1;
    return is_cubic || (line.count == 2 && line.words[1].is("linear"));
  }
  is_known = indexOf(kOtherWords, key) >= 0;
  return is_known;
}

Error takeLine(Block& block) {
  Line line = split(reinterpret_cast<const char*>(block.line_), static_cast<size_t>(block.length_));
  block.length_ = 0;
  if (line.count == 0) return SMC_NO_ERROR_;
  if (line.is_too_long) return SMC_RCAM_WRONG_VERSION_;
  if (block.is_cam_ == 0 && !line.words[0].is("cam")) return SMC_RCAM_WRONG_VERSION_;
  const int kind = indexOf(kRowWords, line.words[0]);
  if (kind >= 0) return takeRow(block, kind, line);
  if (line.words[0].is("tappet")) return takeTappet(block, line);
  bool is_known = false;
  return takeOption(block, line, is_known) ? SMC_NO_ERROR_ : SMC_RCAM_WRONG_VERSION_;
}

Error takeBytes(Block& block, size_t count) {
  for (size_t i = 0; i < count; ++i) {
    const uint8_t c = block.received_[i];
    if (c == '\n') {
      block.in_comment_ = 0;
      const Error error = takeLine(block);
      if (error != SMC_NO_ERROR_) return error;
      continue;
    }
    const bool begins_word = block.length_ == 0 || isBlank(static_cast<char>(block.line_[block.length_ - 1]));
    if (c == '#' && begins_word) block.in_comment_ = 1;
    if (block.in_comment_ != 0) continue;
    if (block.length_ == sizeof block.line_) return SMC_RCAM_TOO_MUCH_DATA_;
    block.line_[block.length_++] = c;
  }
  return SMC_NO_ERROR_;
}

// ---- the whole cam

// Numbers become those of the table's type, in place: none is longer.
template <class Number>
bool narrow(Block& block, int count, double low, double high) {
  char* const to = reinterpret_cast<char*>(block.numbers_);
  for (int i = 0; i < count; ++i) {
    const double number = block.numbers_[i];
    if (!(number >= low && number <= high)) return false;
    const Number narrowed = static_cast<Number>(number);
    if (low != -high && static_cast<double>(narrowed) != number) return false;  // not whole
    memcpy(to + static_cast<size_t>(i) * sizeof narrowed, &narrowed, sizeof narrowed);
  }
  return true;
}

bool setNumbers(Block& block) {
  constexpr double kMostReal = 3.4028234663852886e38;
  const MC_CAM_REF_type& cam = block.CAM_;
  if (cam.byType_ != X_ && cam.byType_ != XY_) return true;
  const int count = cam.nElements_ * kNumbersOfRow[cam.byType_];
  switch (static_cast<cam::Number>(cam.byVarType_)) {
    case cam::Number::Int: return narrow<int16_t>(block, count, INT16_MIN, INT16_MAX);
    case cam::Number::UInt: return narrow<uint16_t>(block, count, 0, UINT16_MAX);
    case cam::Number::DInt: return narrow<int32_t>(block, count, INT32_MIN, INT32_MAX);
    case cam::Number::UDInt: return narrow<uint32_t>(block, count, 0, UINT32_MAX);
    case cam::Number::Real: return narrow<float>(block, count, -kMostReal, kMostReal);
    case cam::Number::LReal:
    case cam::Number::None: return true;
  }
  return true;
}

// Without `master` the rows say the range.
bool setRange(Block& block) {
  MC_CAM_REF_type& cam = block.CAM_;
  if (block.has_range_ != 0) return true;
  if (cam.byType_ != XY_ && cam.byType_ != XYVA_) return false;
  const int per_row = kNumbersOfRow[cam.byType_];
  cam.xStart_ = block.numbers_[0];
  cam.xEnd_ = block.numbers_[(cam.nElements_ - 1) * per_row];
  const double width = cam.fTableMasterMax_ - cam.fTableMasterMin_;
  if (width == 0) return true;
  const double scale = (cam.fEditorMasterMax_ - cam.fEditorMasterMin_) / width;
  const double shift = cam.fEditorMasterMin_ - cam.fTableMasterMin_ * scale;
  cam.xStart_ = cam.xStart_ * scale + shift;
  cam.xEnd_ = cam.xEnd_ * scale + shift;
  return true;
}

Error complete(Block& block) {
  const Error error = takeLine(block);
  if (error != SMC_NO_ERROR_) return error;
  MC_CAM_REF_type& cam = block.CAM_;
  const int least = cam.byType_ == POLY_ ? 1 : 2;
  if (cam.nElements_ < least || !setRange(block)) return SMC_RCAM_UNEXPECTED_EOF_;
  if (!setNumbers(block)) return SMC_RCAM_WRONG_COMPILE_TYPE_;
  cam.nCapacity_ = kMostRows;
  cam.pce_ = block.numbers_;
  if (cam.nTappets_ > 0) cam.pt_ = block.tappets_;
  return SMC_NO_ERROR_;
}

// ---- work of the host

// It is shown when the file is closed.
void setError(Block& block, Error error) {
  block.error_ = error;
  block.CAM_.nElements_ = block.CAM_.nTappets_ = 0;
}

bool begin(Block& block, const rung_host* host, rung_file_work work) {
  const rung_files* const files = host == nullptr ? nullptr : host->files;
  block.work_ = RUNG_FILE_DENIED;
  if (files != nullptr && files->begin != nullptr) block.work_ = files->begin(host->files_data, &work);
  return block.work_ > 0;
}

void finish(Block& block) {
  block.step_ = kIdle;
  block.bBusy_ = 0;
  block.ErrorID_ = block.error_;
  block.bError_ = block.error_ != SMC_NO_ERROR_ ? 1 : 0;
  block.bDone_ = block.bError_ == 0 ? 1 : 0;
}

void closeFile(Block& block, const rung_host* host) {
  block.step_ = kClosing;
  if (!begin(block, host, {RUNG_WORK_CLOSE, 0, block.file_, nullptr, nullptr, nullptr, 0})) finish(block);
}

void readMore(Block& block, const rung_host* host) {
  block.step_ = kReading;
  if (begin(block, host, {RUNG_WORK_READ, 0, block.file_, nullptr, nullptr, nullptr, sizeof block.received_})) return;
  setError(block, SMC_RCAM_UNEXPECTED_EOF_);
  closeFile(block, host);
}

void start(Block& block, const rung_host* host) {
  block.bDone_ = block.bError_ = 0;
  block.ErrorID_ = block.error_ = SMC_NO_ERROR_;
  block.length_ = 0;
  block.in_comment_ = block.is_cam_ = block.has_range_ = 0;
  MC_CAM_REF_type& cam = block.CAM_;
  cam = {};
  cam.wCamStructID_ = kCamStructId;
  cam.byType_ = XYVA_;
  cam.byVarType_ = static_cast<uint8_t>(cam::Number::LReal);
  cam.byInterpolationQuality_ = 3;
  block.bBusy_ = 1;
  block.step_ = kOpening;
  if (begin(block, host, {RUNG_WORK_OPEN, RUNG_FILE_READ, 0, block.sFileName_, nullptr, nullptr, 0})) return;
  setError(block, SMC_RCAM_FILE_DOESNT_EXIST_);
  finish(block);
}

void takeResult(Block& block, const rung_host* host, int64_t result) {
  if (block.step_ == kClosing) return finish(block);
  if (block.step_ == kOpening) {
    block.file_ = result;
    if (result > 0) return readMore(block, host);
    setError(block, SMC_RCAM_FILE_DOESNT_EXIST_);
    return finish(block);
  }
  Error error = SMC_RCAM_UNEXPECTED_EOF_;
  if (result > 0) error = takeBytes(block, static_cast<size_t>(result));
  if (result == 0) error = complete(block);
  if (error == SMC_NO_ERROR_ && result > 0) return readMore(block, host);
  if (error != SMC_NO_ERROR_) setError(block, error);
  closeFile(block, host);
}

}  // namespace

extern "C" {

void rung_sm3_basic_SMC_ReadCAM(rung_context* context, SMC_ReadCAM_type* self) {
  const rung_host* const host = context->host;
  if (self->bExecute_ == 0 && self->bBusy_ == 0) {  // bDone and bError stay for one call at least
    self->bDone_ = self->bError_ = 0;
    self->ErrorID_ = SMC_NO_ERROR_;
  }
  if (self->bBusy_ != 0) {
    const rung_files& files = *host->files;
    const int64_t result = files.result(host->files_data, self->work_, self->received_, sizeof self->received_);
    if (result != RUNG_FILE_BUSY) takeResult(*self, host, result);
  } else if (self->bExecute_ != 0 && self->was_ == 0) {
    start(*self, host);
  }
  self->was_ = self->bExecute_;
}

}  // extern "C"
