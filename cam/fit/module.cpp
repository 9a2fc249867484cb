// SPDX-License-Identifier: Apache-2.0
// The part of `rung cam fit` that is loaded on demand (rung_cam_fit.so), so that no other command starts with the
// libraries of Ceres. Its types are those of the tool that it was built with: tools/driver/cam_fit_module.cpp compares
// the versions.
#include "cam/fit/fit.h"

#define RUNG_EXPORTED __attribute__((visibility("default")))

extern "C" {

RUNG_EXPORTED const char* rung_cam_fit_version() { return RUNG_VERSION; }

RUNG_EXPORTED void rung_cam_fit(const rung::cam::FitRequest* request, rung::cam::FitResult* result) {
  *result = rung::cam::fit(*request);
}

}  // extern "C"
