// The commands of rung, one file each. In: Options. Out: the exit code. Called by main.cpp.
#pragma once

#include <string_view>

#include "tools/rung/options.h"

namespace rung::tool {

int runCheck(const Options& options);
int runEmit(const Options& options);
int runBuild(const Options& options);
int runRun(const Options& options);
int runTest(const Options& options);
int runConvert(const Options& options);
int runGraph(const Options& options);
int runList(const Options& options);
int runExplain(const Options& options);
int runVersion(const Options& options);

// The page of a code, as `rung explain` shows it; empty: no such page.
std::string_view errorPage(std::string_view code);

}  // namespace rung::tool
