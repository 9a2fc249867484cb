// SPDX-License-Identifier: Apache-2.0
// Services of MR and MW; see services.h.
#include "frontend/import/nct/services.h"

#include <algorithm>

namespace rung::importer::nct {
namespace {

#define NC_SERVICE(direction, code, least, most, section, what) \
  {ServiceDirection::direction, code, least, most, section, what},
constexpr Service kServices[] = {
#include "frontend/import/nct/nc_services.def"
};
#undef NC_SERVICE

#define NC_CODE(code, meaning) {code, meaning},
constexpr ExecutionCode kCodes[] = {
#include "frontend/import/nct/nc_codes.def"
};
#undef NC_CODE

}  // namespace

std::span<const Service> services() { return kServices; }
std::span<const ExecutionCode> executionCodes() { return kCodes; }

const Service* findService(int64_t code) {
  const auto* const found =
      std::find_if(std::begin(kServices), std::end(kServices), [&](const Service& row) { return row.code == code; });
  return found == std::end(kServices) ? nullptr : found;
}

}  // namespace rung::importer::nct
