// SPDX-License-Identifier: Apache-2.0
// Folders of the program as a whole: listed, copied and removed with their content. Links and devices are left out. In:
// the root and names below it. Out: 0 or a count, or a rung_file_error. Called by file_work.cpp.
#pragma once

#include <string>

#include "rung/module.h"

namespace rung::host {

// Fills up to `capacity` entries, by name. Returns their number.
int64_t listFolder(const std::string& root, const char* name, bool only_files, rung_file_entry* entries,
                   uint64_t capacity);
// Copies a file or folder into the existing folder `target`. A file of more than `most_bytes` is an error unless that
// is 0.
int64_t copyTree(const std::string& root, const char* name, const char* target, bool overwrites, uint64_t most_bytes);
int64_t removeTree(const std::string& root, const char* name);

}  // namespace rung::host
