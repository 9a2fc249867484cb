// SPDX-License-Identifier: Apache-2.0
// Bodies of POUs, members and actions as TC6; see exporter.h. A chart has bodies too: it gets exportBody as an
// argument.
#include "frontend/export/exporter.h"

namespace rung::exporter {

//   warns   {C++} … {END_C++}          W1099
void exportBody(Export& to, const PouDecl& pou, std::string_view element) {
  const SourceText& source = *to.source;
  to.xml.open(element);
  if (element == "inline") to.xml.attribute("name", "");
  if (pou.body_kind == BodyKind::Network) {
    exportNetworks(to, pou.diagram);
  } else if (pou.body_kind == BodyKind::Sfc) {
    exportChart(to, pou, exportBody);
  } else if (pou.body_kind == BodyKind::Cpp) {
    to.onlyRung(pou.h.loc, "C++ bodies");
    to.xml.formatted("ST", "");
    AddData data(to);
    std::string text;
    if (pou.cpp_file_begin != pou.cpp_file_end)
      text.append(source.cut(source.at(pou.cpp_file_begin), source.at(pou.cpp_file_end))).append("\n");
    text += source.cut(source.at(pou.body_begin), source.at(pou.body_end));
    exportOwnText(to, text, data);
  } else {
    size_t begin = source.at(pou.body_begin), end = source.at(pou.body_end);
    if (pou.closed || begin != end) begin = source.commentsBefore(begin, true);
    end = source.endWithComments(end);
    to.xml.formatted(pou.body_kind == BodyKind::Il ? "IL" : "ST", source.cut(begin, end));
  }
  to.xml.close();
}

}  // namespace rung::exporter
