// SPDX-License-Identifier: Apache-2.0
// The page of the monitor as one HTML file: see page_text.h.
#include "page_text.h"

#include <string_view>

#include "monitor_page.h"

namespace rung::host {
namespace {

// Each uses what is before it.
constexpr const char* kScripts[] = {"core.js",    "tree.js",  "watch.js",  "picture.js",
                                    "program.js", "scope.js", "motion.js", "status.js"};

std::string_view pageFile(std::string_view name) {
  for (size_t i = 0; i < embedded::monitor_page_count; ++i)
    if (embedded::monitor_page[i].name == name) return embedded::monitor_page[i].text;
  return {};
}

void insertAt(std::string& page, std::string_view mark, const std::string& text) {
  page.replace(page.find(mark), mark.size(), text);
}

}  // namespace

std::string pageText(const std::string& nonce) {
  std::string page(pageFile("page.html")), scripts;
  for (const char* const script : kScripts) scripts += pageFile(script);
  insertAt(page, "/*style*/", std::string(pageFile("style.css")));
  insertAt(page, "/*nonce*/", nonce);
  insertAt(page, "/*script*/", scripts);
  return page;
}

}  // namespace rung::host
