// SPDX-License-Identifier: Apache-2.0
// Cams in ST; see st_form.h.
#include "cam/design/st_form.h"

#include <algorithm>
#include <charconv>

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

// Attributes end at a quote, and their lines at a semicolon.
constexpr std::string_view kEscaped = "%;'\"{}";

std::string escaped(std::string_view text) {
  constexpr char kDigits[] = "0123456789ABCDEF";
  std::string out;
  for (const char c : text) {
    if (kEscaped.find(c) == std::string_view::npos) {
      out += c;
      continue;
    }
    out += '%';
    out += kDigits[static_cast<unsigned char>(c) >> 4];
    out += kDigits[static_cast<unsigned char>(c) & 15];
  }
  return out;
}

std::string unescaped(std::string_view text) {
  std::string out;
  for (size_t i = 0; i < text.size(); ++i) {
    uint8_t code = 0;
    const auto end = text.data() + std::min(i + 3, text.size());
    if (text[i] == '%' && std::from_chars(text.data() + i + 1, end, code, 16).ptr == text.data() + i + 3) {
      out += static_cast<char>(code);
      i += 2;
    } else {
      out += text[i];
    }
  }
  return out;
}

constexpr std::string_view kOfDesign[] = {"repeat", "slave", "speed", "limit", "capacity"};
constexpr std::string_view kMaster = "master ";

// The lines of the `.cam` text that the declarations do not hold.
std::string designOf(const Cam& cam) {
  std::string out;
  const auto add = [&](std::string_view line) { out += (out.empty() ? "" : "; ") + escaped(line); };
  Cam head = cam;
  head.points.clear();
  head.polynomials.clear();
  head.numbers.clear();
  head.tappets.clear();
  const std::string text = textOf(head);
  for (size_t begin = 0; begin < text.size();) {
    const size_t end = text.find('\n', begin);
    const std::string_view line = std::string_view(text).substr(begin, end - begin);
    for (const std::string_view key : kOfDesign)
      if (line.substr(0, line.find(' ')) == key) add(line);
    begin = end + 1;
  }
  if (!cam.master_unit.empty()) add(std::string(kMaster) + cam.master_unit);
  return out;
}

class DeclarationWriter {
 public:
  DeclarationWriter(const Cam& cam, Duplicates duplicates) : cam_(cam), duplicates_(duplicates) {}

  std::string write() {
    out_ = "VAR_GLOBAL\n";
    writeRows();
    if (cam_.hasLines()) writeSegments();
    if (!cam_.tappets.empty()) writeTappets();
    writeReference();
    return out_ + "END_VAR\n";
  }

 private:
  void mark() {
    if (duplicates_ == Duplicates::AreErrors) out_ += "  {attribute '" + std::string(kUniqueAttribute) + "'}\n";
  }
  void open(const char* suffix, size_t room, std::string_view type) {
    mark();
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
    mark();
    const std::string design = designOf(cam_);
    if (!design.empty()) out_ += "  {attribute '" + std::string(kDesignAttribute) + "' := '" + design + "'}\n";
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
  const Duplicates duplicates_;
  std::string out_;
  bool is_first_ = true;
};

}  // namespace

std::string globalsOf(const Cam& cam, Duplicates duplicates) { return DeclarationWriter(cam, duplicates).write(); }

std::string withDesign(Cam table, std::string_view attribute) {
  std::string lines;
  // The room of a cam that says none: the attribute has the line of one that does.
  if (table.capacity == std::max(table.rowCount(), kLeastCapacity) || !attribute.empty()) table.capacity = 0;
  while (!attribute.empty()) {
    const std::string line = unescaped(attribute.substr(0, attribute.find(';')));
    attribute.remove_prefix(std::min(attribute.find(';'), attribute.size() - 1) + 1);
    while (attribute.starts_with(' ')) attribute.remove_prefix(1);
    if (line.starts_with(kMaster))
      table.master_unit = line.substr(kMaster.size());
    else
      lines += line + "\n";
  }
  return textOf(table) + lines;
}

}  // namespace rung::cam
