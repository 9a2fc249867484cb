// SPDX-License-Identifier: Apache-2.0
// The checks of cams; see cam_checks.h.
#include "frontend/import/cam/cam_checks.h"

#include <algorithm>
#include <cmath>

#include "cam/design/jumps.h"
#include "cam/design/text_form.h"
#include "cam/design/words.h"
#include "frontend/import/diagnostics.h"
#include "frontend/parse/parse.h"
#include "frontend/source/scanner.h"

namespace rung::importer::cams {
namespace {

using cam::Cam;
using cam::Curve;
using cam::exactText;
using cam::Kind;
using cam::Piece;
using cam::Repeat;

struct NumberRange {
  double low, high;
  bool is_whole;
};
constexpr NumberRange kRanges[] = {{0, 0, true},
                                   {-32768, 32767, true},
                                   {0, 65535, true},
                                   {-2147483648.0, 2147483647, true},
                                   {0, 4294967295, true},
                                   {-3.4028234663852886e38, 3.4028234663852886e38, false},
                                   {-1.7976931348623157e308, 1.7976931348623157e308, false}};

// What to do when the cam jumps where it repeats.
const char* adviceFor(Repeat repeat) {
  switch (repeat) {
    case Repeat::Never: return "";
    case Repeat::Closed: return "let it end where it begins, or write `repeat relative` or `repeat modulo PERIOD`";
    case Repeat::Modulo: return "let both ends differ by a multiple of the slave's period";
    case Repeat::Relative: return "let it begin at 0, because each period is added to the end of the last one";
  }
  return "";
}

class Checker {
 public:
  Checker(Cam& cam, const CamLocations& at, Diagnostics& diagnostics) : cam_(cam), at_(at), diagnostics_(diagnostics) {}

  void check(bool is_complete) {
    checkName();
    checkNumbers();
    if (!is_complete) return (void)isInOrder();
    if (!hasRows() || !hasRange() || !isInOrder() || !isCovered()) return;
    checkTappets();
    const Curve curve = curveOf(cam_);
    if (isFinite(curve)) checkJumps(curve);
  }

 private:
  Report report(Diag diag, const Span& span, std::initializer_list<std::string_view> args) {
    return diagnostics_.report(diag, span.loc, args).length(span.length);
  }

  void checkName() {
    const char* why = text::isReservedWord(cam_.name)     ? "it is a keyword"
                      : !isIdentifier(cam_.name)          ? "use letters, digits and `_`"
                      : cam_.name.size() > cam::kMostName ? "it is longer than 80 characters"
                                                          : nullptr;
    if (why != nullptr) report(diag::CamName, at_.name, {cam_.name, why});
  }

  bool hasRows() {
    const size_t count = cam_.rowCount(), least = cam_.leastRows();
    const std::string_view word = wordOf(cam::kRowWords, cam_.kind);
    if (count < least) {
      report(diag::CamTooFew, at_.name, {cam_.name, std::to_string(count), word, std::to_string(least)});
      return false;
    }
    if (count > cam::kMostRows) {
      report(diag::CamTooMany, at_.rows[cam::kMostRows],
             {std::string(word) + "` rows", std::to_string(cam::kMostRows), "MC_CAM_REF.nElements is an INT"});
      return false;
    }
    return true;
  }

  // A REAL is the one that is nearest to what was written.
  void checkNumbers() {
    const NumberRange& range = kRanges[static_cast<size_t>(cam_.number)];
    for (size_t i = 0; i < cam_.numbers.size(); ++i) {
      const double number = cam_.numbers[i];
      if (number >= range.low && number <= range.high && (!range.is_whole || number == std::floor(number))) {
        if (cam_.number == cam::Number::Real) cam_.numbers[i] = static_cast<double>(static_cast<float>(number));
        continue;
      }
      report(diag::CamOutOfRange, at_.numbers[i],
             {exactText(number), std::string(wordOf(cam::kNumberWords, cam_.number))});
    }
  }

  // The first and the last master position, if the file does not say it.
  bool hasRange() {
    if (at_.master.loc) {
      if (cam_.start < cam_.end) return true;
      report(diag::CamMasterRange, at_.master,
             {"it begins at `" + exactText(cam_.start) + "` and ends at `" + exactText(cam_.end) +
              "`; write the lower end first"});
      return false;
    }
    if (cam_.kind == Kind::Polynomials || cam_.kind == Kind::Equidistant) {
      report(diag::CamNoMaster, at_.name, {cam_.name, wordOf(cam::kRowWords, cam_.kind)});
      return false;
    }
    cam_.start = cam_.masterAt(0);
    cam_.end = cam_.masterAt(cam_.rowCount() - 1);
    return true;
  }

  bool isInOrder() {
    if (cam_.kind == Kind::Equidistant) return true;
    bool is_in_order = true;
    for (size_t row = 1; row < cam_.rowCount(); ++row) {
      const double before = cam_.masterAt(row - 1), here = cam_.masterAt(row);
      if (before < here) continue;
      is_in_order = false;
      const Diag diag = before == here ? diag::CamDuplicateMaster : diag::CamOrder;
      report(diag, at_.rows[row], {exactText(here), exactText(before)}).note(at_.rows[row - 1].loc, diag::RowBefore);
    }
    return is_in_order;
  }

  bool isCovered() {
    const double first = cam_.masterAt(0);
    const double last = cam_.kind == Kind::Polynomials ? cam_.end : cam_.masterAt(cam_.rowCount() - 1);
    if (first <= cam_.start && cam_.end <= last) return true;
    report(diag::CamMasterRange, at_.master,
           {"the rows cover `" + exactText(first) + "` to `" + exactText(last) + "`"});
    return false;
  }

  bool isFinite(const Curve& curve) {
    for (const Piece& piece : curve.pieces())
      for (const double factor : piece.coefficients)
        if (!std::isfinite(factor)) {
          report(diag::CamNotFinite, at_.name, {cam_.name, exactText(piece.from)});
          return false;
        }
    return true;
  }

  void checkTappets() {
    size_t pulses = 0;
    for (size_t i = 0; i < cam_.tappets.size(); ++i) {
      const cam::Tappet& tappet = cam_.tappets[i];
      if (tappet.x < cam_.start || tappet.x > cam_.end)
        report(diag::CamTappet, at_.tappets[i], {exactText(tappet.x), exactText(cam_.start), exactText(cam_.end)});
      if (tappet.action == cam::TappetAction::Pulse && ++pulses == cam::kMostPulses + 1)
        report(diag::CamTooMany, at_.tappets[i],
               {"pulse` tappets", std::to_string(cam::kMostPulses), "a cam has that many timers"});
    }
    if (cam_.tappets.size() > cam::kMostRows)
      report(diag::CamTooMany, at_.tappets[cam::kMostRows],
             {"tappet` rows", std::to_string(cam::kMostRows), "MC_CAM_REF.nTappets is an INT"});
  }

  const Span& rowFrom(double x) const {
    for (size_t row = 0; row < cam_.rowCount(); ++row)
      if (cam_.masterAt(row) == x) return at_.rows[row];
    return at_.name;
  }

  // Where two polynomials meet, and where the cam repeats.
  void checkJumps(const Curve& curve) {
    for (const cam::Jump& jump : cam::jumpsOf(curve))
      report(diag::CamJump, rowFrom(jump.x), {cam_.name, exactText(jump.size), exactText(jump.x)});
    if (const auto jump = cam::jumpOfRepeat(cam_, curve, cam_.repeat))
      report(diag::CamClosure, at_.repeat, {cam_.name, exactText(*jump), adviceFor(cam_.repeat)});
  }

  Cam& cam_;
  const CamLocations& at_;
  Diagnostics& diagnostics_;
};

}  // namespace

void checkCam(cam::Cam& cam, const CamLocations& locations, bool is_complete, Diagnostics& diagnostics) {
  Checker(cam, locations, diagnostics).check(is_complete);
}

}  // namespace rung::importer::cams
