// SPDX-License-Identifier: Apache-2.0
// The page of the monitor as one HTML file. In: the embedded files of page/. Out: page.html with the style and the
// scripts in it. Called by monitor_requests.cpp.
#pragma once

#include <string>

namespace rung::host {

// `nonce`: marks its script for the browser.
std::string pageText(const std::string& nonce);

}  // namespace rung::host
