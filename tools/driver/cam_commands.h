// SPDX-License-Identifier: Apache-2.0
// The subcommands of `rung cam`, one file each. In: their words and options. Out: an exit code; results go to the sink
// and to `output`. Called by cam.cpp.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "cam/design/cam.h"
#include "cam/design/peaks.h"
#include "frontend/import/cam/cam_file.h"
#include "tools/driver/cam.h"

namespace rung::driver {

struct CamRun {
  std::vector<std::string> inputs;  // after the subcommand
  const CamOptions& options;
  const std::string& output;  // of `-o`, or empty
};

int runCamLaw(const CamRun& run, Sink& sink);
int runCamCheck(const CamRun& run, Sink& sink);
int runCamShow(const CamRun& run, Sink& sink);
int runCamConvert(const CamRun& run, Sink& sink);
int runCamFit(const CamRun& run, Sink& sink);

// A number of the motion laws that an option sets.
struct CamNumber {
  const char* name;
  uint8_t given;  // cam::Given; 0: not of the ends
  double* (*of)(CamOptions&);
};
std::span<const CamNumber> camNumbers();

// A cam that was read from a file, with its mistakes.
struct CamInput {
  Sources sources;
  Diagnostics diagnostics{sources};
  cam::Cam cam;
  importer::cams::CamSource places;
  bool is_read = false;   // without errors
  bool io_error = false;  // the file could not be opened

  int exitCode() const;
};
// No file: reported.
FileId readCamSource(const std::string& path, CamInput& input);
// Of a `.csv`, commas separate words as blanks do.
void readCamInput(const std::string& path, CamInput& input);
// The `.cam` text of a cam that was read from the file `path` in another form.
void readCamText(const std::string& path, std::string text, CamInput& input);
// Passes the diagnostics to the sink; returns the exit code.
int finishCamInput(CamInput& input, Sink& sink);

// The speed at which the peaks of a cam are asked for: of the option, else of the file. None: per unit of the master.
std::optional<double> speedOf(const CamRun& run, const cam::Cam& cam);
// The table of `rung cam check`.
std::string tableOfPeaks(const cam::Cam& cam, const cam::Peaks& peaks, std::optional<double> speed);
// `mm/s²`, with the unit of the slave; empty: it has none.
std::string unitOf(const cam::Cam& cam, int order, bool is_per_second);

std::string format(const char* pattern, double value);
std::string padded(std::string text, size_t width);

}  // namespace rung::driver
