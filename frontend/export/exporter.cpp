// SPDX-License-Identifier: Apache-2.0
// The <data> elements of the export; see exporter.h.
#include "frontend/export/exporter.h"

namespace rung::exporter {

void Export::openData(std::string_view name, std::string_view unknown) {
  xml.open("data").attribute("name", name).attribute("handleUnknown", unknown);
}

void Export::openVendorData(std::string_view kind) {
  openData("http://www.3s-software.com/plcopenxml/" + std::string(kind));
}

void AddData::openOwn() {
  begin();
  to_.openData("urn:rung/extension", "discard");
}

void exportOwnText(Export& to, std::string_view text, AddData& data) {
  data.openOwn();
  to.xml.formatted("text", text);
  data.close();
}

}  // namespace rung::exporter
