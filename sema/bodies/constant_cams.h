// SPDX-License-Identifier: Apache-2.0
// The cams whose table the source declares: variables with the members of MC_CAM_REF whose `pce` is the address of an
// array with an initial value, while no body changes either. In: a project whose bodies are checked. Out: each such cam
// as cam/design knows it, and where its parts are written. Called by checks/cam_tables.cpp and, through
// check.h, by `rung cam`.
#pragma once

#include <vector>

#include "cam/design/cam.h"
#include "sema/context.h"

namespace rung::sema {

struct ConstantCam {
  VarId var;                       // the cam
  VarId array;                     // of its rows
  int64_t low = 0;                 // the lowest index of the array
  cam::Cam cam;                    // as many rows as nElements says, and as the array has; `capacity` is nCapacity
  int64_t elements = 0, room = 0;  // nElements; how many rows fit into the array
  uint8_t var_type = 0;            // byVarType
  std::string_view design;         // of {attribute 'cam' := '…'}
  cam::Number number = cam::Number::None;  // what the elements of the array are; None: structures
  Loc name;
  Loc elements_loc, end_loc, type_loc;  // of nElements, xEnd and byVarType; or the name
  std::vector<Loc> rows;  // of the master position of each row, or its number; of a row without one the name
};

// In order of declaration.
std::vector<ConstantCam> constantCams(Context& context);

// A structure with the members of MC_CAM_REF.
bool isCam(const Context& context, TypeId type);

}  // namespace rung::sema
