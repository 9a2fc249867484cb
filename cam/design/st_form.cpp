// Cams in ST; see st_form.h.
#include "cam/design/st_form.h"

#include "cam/design/text_form.h"
#include "cam/design/words.h"

namespace rung::cam {
namespace {

constexpr size_t kMostOnALine = 8;  // numbers

// With a decimal point, because in some dialects an integer is not an LREAL.
std::string real(double value) {
  std::string text = exactText(value);
  const size_t exponent = text.find('e');
  if (text.find('.') == std::string::npos) text.insert(std::min(exponent, text.size()), ".0");
  return text;
}

class DeclarationWriter {
 public:
  explicit DeclarationWriter(const Cam& cam) : cam_(cam) {}

  std::string write() {
    out_ = "VAR_GLOBAL\n";
    writeRows();
    if (cam_.hasLines()) writeSegments();
    if (!cam_.tappets.empty()) writeTappets();
    writeReference();
    return out_ + "END_VAR\n";
  }

 private:
  void open(const char* suffix, size_t room, std::string_view type) {
    out_ +=
        "  " + cam_.name + suffix + " : ARRAY[0.." + std::to_string(room - 1) + "] OF " + std::string(type) + " := [";
    is_first_ = true;
  }
  void element(const std::string& text) {
    out_ += (is_first_ ? "\n    " : ",\n    ") + text;
    is_first_ = false;
  }
  void close() { out_ += "];\n"; }

  void writeRows() {
    switch (cam_.kind) {
      case Kind::QuinticPoints:
        open("_A", cam_.room(), "SMC_CAMXYVA");
        for (const Point& p : cam_.points)
          element("(dX := " + real(p.x) + ", dY := " + real(p.y) + ", dV := " + real(p.slope) +
                  ", dA := " + real(p.curvature) + ")");
        return close();
      case Kind::Polynomials:
        open("_A", cam_.room(), "SMC_CAMElement");
        for (const Polynomial& p : cam_.polynomials) {
          std::string c;
          for (const double factor : p.c) c += (c.empty() ? "" : ", ") + real(factor);
          element("(dX := " + real(p.x) + ", c := [" + c + "])");
        }
        return close();
      case Kind::Equidistant: return writeNumbers(cam_.room(), 1);
      case Kind::Pairs: return writeNumbers(2 * cam_.room(), 2);
    }
  }

  void writeNumbers(size_t room, size_t per_row) {
    open("_A", room, wordOf(kNumberWords, cam_.number));
    const bool is_real = cam_.number == Number::Real || cam_.number == Number::LReal;
    std::string text;
    for (size_t i = 0; i < cam_.numbers.size(); ++i) {
      const double number = cam_.numbers[i];
      text += (text.empty() ? "" : ", ") + (is_real ? real(number) : std::to_string(static_cast<int64_t>(number)));
      const bool ends_line = per_row == 2 ? i % 2 == 1 : (i + 1) % kMostOnALine == 0;
      if (!ends_line && i + 1 < cam_.numbers.size()) continue;
      element(text);
      text.clear();
    }
    close();
  }

  void writeSegments() {
    open("_S", cam_.room() - 1, "CamSegmentType");
    for (size_t i = 0; i + 1 < cam_.segments.size(); ++i)
      element(cam_.segments[i] == SegmentKind::Line ? "CamSegmentType.Line" : "CamSegmentType.Poly5");
    // Points that the program adds have quintic segments too.
    const size_t rest = cam_.room() - cam_.segments.size();
    if (rest > 0) element(std::to_string(rest) + "(CamSegmentType.Poly5)");
    close();
  }

  void writeTappets() {
    constexpr const char* kDirections[] = {"TAPPET_pos", "TAPPET_all", "TAPPET_neg"};
    constexpr const char* kActions[] = {"TAPPETACTION_on", "TAPPETACTION_off", "TAPPETACTION_inv", "TAPPETACTION_time"};
    open("_T", cam_.tappets.size(), "SMC_CAMTappet");
    for (const Tappet& tappet : cam_.tappets)
      element("(x := " + real(tappet.x) + ", iGroupID := " + std::to_string(tappet.group) +
              ", ctt := SMC_CAMTAPPETTYPE." + kDirections[static_cast<size_t>(tappet.direction)] +
              ", cta := SMC_CAMTAPPETACTION." + kActions[static_cast<size_t>(tappet.action)] + ", dwDelay := " +
              std::to_string(tappet.delay) + ", dwDuration := " + std::to_string(tappet.duration) + ")");
    close();
  }

  void writeReference() {
    constexpr const char* kTypes[] = {"POLY", "X", "XY", "XYVA"};
    out_ += "  " + cam_.name + " : MC_CAM_REF := (byType := SMC_CAM_TYPE." + kTypes[static_cast<size_t>(cam_.kind)];
    const auto member = [&](const char* name, const std::string& value) {
      out_ += std::string(",\n    ") + name + " := " + value;
    };
    if (!cam_.numbers.empty()) {
      member("byVarType", std::to_string(static_cast<int>(cam_.number)));
      member("byInterpolationQuality", cam_.cubic ? "3" : "1");
    }
    member("nElements", std::to_string(cam_.rowCount()));
    member("nCapacity", std::to_string(cam_.room()));
    member("xStart", real(cam_.start));
    member("xEnd", real(cam_.end));
    member("pce", "ADR(" + cam_.name + "_A)");
    if (cam_.hasLines()) member("pSegments", "ADR(" + cam_.name + "_S[0])");
    if (!cam_.tappets.empty()) {
      member("nTappets", std::to_string(cam_.tappets.size()));
      member("pt", "ADR(" + cam_.name + "_T[0])");
    }
    if (cam_.scale) {
      member("fTableMasterMin", real(cam_.scale->table_min));
      member("fTableMasterMax", real(cam_.scale->table_max));
      member("fEditorMasterMin", real(cam_.scale->master_min));
      member("fEditorMasterMax", real(cam_.scale->master_max));
    }
    member("strCAMName", "'" + cam_.name + "'");
    out_ += ");\n";
  }

  const Cam& cam_;
  std::string out_;
  bool is_first_ = true;
};

}  // namespace

std::string globalsOf(const Cam& cam) { return DeclarationWriter(cam).write(); }

}  // namespace rung::cam
