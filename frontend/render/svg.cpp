// SPDX-License-Identifier: Apache-2.0
#include "frontend/render/svg.h"

#include <algorithm>

#include "frontend/source/files.h"

namespace rung::picture {
namespace {

// Every fixed-width font in use has characters of at most 0.602 of its size.
constexpr int32_t kCharacterTenths = 73;

constexpr std::string_view kStyle =
    "text{font-family:'DejaVu Sans Mono',Consolas,Menlo,monospace;font-size:12px;fill:#000;stroke:none;"
    "white-space:pre}"
    "path,rect,circle{fill:none;stroke:#000}"
    ".b{font-weight:bold}.s{font-size:9px}.g{fill:#666}.m{text-anchor:middle}.e{text-anchor:end}"
    ".w{fill:#fff}.d{fill:#000;stroke:none}.t{stroke-width:3}.k{stroke-width:2}.x{fill:#f6f6f6}"
    ".n{fill:#e4e8ee;stroke:none}.o{fill:#dff0d8;stroke:#3c763d}.c{fill:#fffbe0;stroke:#b8a860}.r{stroke:#aaa}.z{"
    "opacity:.4}"
    // A page that shows the picture as an image has the reader's scheme, too.
    "@media(prefers-color-scheme:dark){text{fill:#e6edf3}path,rect,circle{stroke:#c9d1d9}.g{fill:#9198a1}"
    ".w{fill:#0d1117}.d{fill:#e6edf3;stroke:none}.x{fill:#161b22}.n{fill:#21262d;stroke:none}"
    ".o{fill:#12261e;stroke:#3fb950}.c{fill:#272115;stroke:#9e8c3c}.r{stroke:#484f58}}";

// The byte length of the character at `p`; 0: not UTF-8.
size_t characterAt(std::string_view text, size_t p, uint32_t& c) {
  const auto byte = static_cast<unsigned char>(text[p]);
  const size_t length = byte < 0x80 ? 1 : byte >= 0xf0 ? 4 : byte >= 0xe0 ? 3 : byte >= 0xc0 ? 2 : 0;
  if (length == 0 || p + length > text.size() || findInvalidUtf8(text.substr(p, length)) != std::string_view::npos)
    return 0;
  c = length == 1 ? byte : byte & (0x7fu >> length);
  for (size_t k = 1; k < length; ++k) c = c << 6 | (static_cast<unsigned char>(text[p + k]) & 0x3f);
  return length;
}

// Characters that XML does not allow, and bytes that are not UTF-8, become question marks. `quote`: what `"` becomes.
void appendEscaped(std::string& out, std::string_view text, const char* quote = "\"") {
  for (size_t p = 0; p < text.size();) {
    uint32_t c = 0;
    const size_t length = characterAt(text, p, c);
    if (length == 0 || (c < 0x20 && c != '\t') || c == 0xfffe || c == 0xffff) {
      out += '?';
    } else if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else if (c == '>') {
      out += "&gt;";
    } else if (c == '"') {
      out += quote;
    } else if (c == '\t') {
      out += ' ';
    } else {
      out += text.substr(p, length);
    }
    p += std::max<size_t>(length, 1);
  }
}

std::string number(int32_t n) { return std::to_string(n); }

std::string classOf(std::string_view kind) {
  return kind.empty() ? std::string() : " class=\"" + std::string(kind) + "\"";
}

}  // namespace

void Rect::include(const Rect& o) {
  const int32_t to_x = std::max(right(), o.right()), to_y = std::max(bottom(), o.bottom());
  x = std::min(x, o.x);
  y = std::min(y, o.y);
  width = to_x - x;
  height = to_y - y;
}

int32_t textWidth(std::string_view text) {
  int32_t cells = 0;
  for (size_t p = 0; p < text.size();) {
    uint32_t c = 0;
    p += std::max<size_t>(characterAt(text, p, c), 1);
    cells += c >= 0x1100 && !(c >= 0x2000 && c < 0x2e80) ? 2 : 1;
  }
  return (cells * kCharacterTenths + 9) / 10;
}

std::vector<std::string> linesOf(std::string_view text) {
  std::vector<std::string> lines;
  for (size_t p = 0; p < text.size();) {
    const size_t end = std::min(text.find('\n', p), text.size());
    lines.emplace_back(text.substr(p, end - p));
    if (!lines.back().empty() && lines.back().back() == '\r') lines.back().pop_back();
    p = end + 1;
  }
  return lines;
}

std::vector<std::string> wrapped(std::string_view text, size_t most) {
  std::vector<std::string> lines;
  for (std::string line : linesOf(text)) {
    while (line.size() > most) {
      size_t cut = line.rfind(' ', most);
      if (cut == std::string::npos || cut == 0) cut = line.find(' ', most);
      if (cut == std::string::npos) break;
      lines.push_back(line.substr(0, cut));
      line.erase(0, cut + 1);
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

void Svg::lines(Point above, const std::vector<std::string>& lines) {
  for (const std::string& line : lines) {
    above.y += kLine;
    const size_t blanks = std::min(line.find_first_not_of(' '), line.size());  // not every viewer keeps them
    text({above.x + textWidth(line.substr(0, blanks)), above.y}, Anchor::Start, line.substr(blanks));
  }
}

void Svg::path(std::string_view data, std::string_view kind) {
  body_.append("<path").append(classOf(kind)).append(" d=\"").append(data).append("\"/>\n");
}

void Svg::line(Point a, Point b, std::string_view kind) {
  const Point points[] = {a, b};
  path(route(points, 2), kind);
}

void Svg::rect(const Rect& r, std::string_view kind) {
  body_ += "<rect" + classOf(kind) + " x=\"" + number(r.x) + "\" y=\"" + number(r.y) + "\" width=\"" + number(r.width) +
           "\" height=\"" + number(r.height) + "\"/>\n";
}

void Svg::cycle(Point centre, int32_t radius, std::string_view kind) {
  body_ += "<circle" + classOf(kind) + " cx=\"" + number(centre.x) + "\" cy=\"" + number(centre.y) + "\" r=\"" +
           number(radius) + "\"/>\n";
}

void Svg::text(Point base, Anchor anchor, std::string_view text, std::string_view kind) {
  std::string classes(kind);
  if (anchor != Anchor::Start) classes += std::string(classes.empty() ? "" : " ") + (anchor == Anchor::End ? "e" : "m");
  body_ += "<text" + classOf(classes) + " x=\"" + number(base.x) + "\" y=\"" + number(base.y) + "\">";
  appendEscaped(body_, text);
  body_ += "</text>\n";
}

void Svg::open(std::string_view id) { body_.append("<g id=\"").append(id).append("\">\n"); }
void Svg::open(std::span<const Attribute> attributes) {
  body_ += "<g";
  for (const Attribute& attribute : attributes) {
    if (attribute.value.empty()) continue;
    body_.append(" ").append(attribute.name).append("=\"");
    appendEscaped(body_, attribute.value, "&quot;");
    body_ += '"';
  }
  body_ += ">\n";
}
void Svg::openFaded() { body_ += "<g class=\"z\">\n"; }
void Svg::close() { body_ += "</g>\n"; }

std::string Svg::finish(std::string_view title, int32_t width, int32_t height) const {
  const std::string w = number(width), h = number(height);
  std::string out = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + w + "\" height=\"" + h +
                    "\" viewBox=\"0 0 " + w + " " + h + "\">\n<title>";
  appendEscaped(out, title);
  out.append("</title>\n<style>").append(kStyle).append("</style>\n");
  out += "<path class=\"w\" stroke-width=\"0\" d=\"M0 0H" + w + "V" + h + "H0Z\"/>\n" + body_ + "</svg>\n";
  return out;
}

std::string route(const Point* points, size_t count) {
  std::string out = "M" + number(points[0].x) + " " + number(points[0].y);
  for (size_t k = 1; k < count; ++k) {
    const Point a = points[k - 1], b = points[k];
    if (a.x == b.x)
      out += "V" + number(b.y);
    else if (a.y == b.y)
      out += "H" + number(b.x);
    else
      out += "L" + number(b.x) + " " + number(b.y);
  }
  return out;
}

}  // namespace rung::picture
