// SPDX-License-Identifier: Apache-2.0
// A cam must hold this, whatever file it comes from: rows in order, a master range that they cover, no jump, numbers
// that fit. In: a cam and where its parts are. Out: all mistakes as diagnostics. Called by the readers of this folder.
#pragma once

#include <vector>

#include "cam/design/cam.h"
#include "frontend/source/diagnostics.h"

namespace rung::importer::cams {

struct Span {
  Loc loc;
  uint32_t length = 0;
};

struct CamLocations {
  Span name;
  Span repeat;  // or the name
  Span master;  // none: the rows give the range
  Span scale;
  std::vector<Span> rows;     // of the master position, or the number of Equidistant
  std::vector<Span> numbers;  // of Equidistant and Pairs
  std::vector<Span> tappets;
};

// Sets the master range to that of the rows if the file has none. Not `is_complete`: some lines were reported, and
// what they leave out is not reported again.
void checkCam(cam::Cam& cam, const CamLocations& locations, bool is_complete, Diagnostics& diagnostics);

}  // namespace rung::importer::cams
