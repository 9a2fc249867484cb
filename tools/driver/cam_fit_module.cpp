// SPDX-License-Identifier: Apache-2.0
// Loads rung_cam_fit.so: see cam_fit_module.h.
#include "tools/driver/cam_fit_module.h"

#include <string_view>

#include "tools/driver/installation.h"

#ifndef RUNG_STATIC
#include <dlfcn.h>
#endif

namespace rung::driver {

#ifdef RUNG_STATIC

std::string fitWithModule(const cam::FitRequest&, cam::FitResult&) {
  return "this rung is one file that loads no others, so it has no `rung cam fit`; use the package rung-cam-fit";
}

#else

std::string fitWithModule(const cam::FitRequest& request, cam::FitResult& result) {
  const std::string path = camFitModule();
  if (path.empty())
    return "`rung cam fit` is a part of its own, which is not installed: install the package rung-cam-fit, or build "
           "Rung with libceres-dev and libeigen3-dev";
  void* const handle = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) return std::string("cannot load `rung cam fit`: ") + dlerror();
  const auto version_of = reinterpret_cast<const char* (*)()>(dlsym(handle, "rung_cam_fit_version"));
  const auto fit = reinterpret_cast<void (*)(const cam::FitRequest*, cam::FitResult*)>(dlsym(handle, "rung_cam_fit"));
  if (version_of == nullptr || fit == nullptr || std::string_view(version_of()) != version())
    return "`" + path + "` is not of this version of Rung, which is " + version() + "; install both from one package";
  fit(&request, &result);
  return {};  // it stays loaded: the result may hold what it allocated
}

#endif

}  // namespace rung::driver
