// SPDX-License-Identifier: Apache-2.0
// Which project a command works on when its inputs do not say: the one around the current folder, looked for upwards as
// cargo and git do. In: a folder. Out: the input that names the project, or why there is none. Called by the command
// line.
#pragma once

#include <string>
#include <vector>

namespace rung::workspace {

struct FoundProject {
  std::string input;  // a folder with rung.project or beremiz.xml, a .plcproj or a plc.xml; empty: none
  std::string error;  // two projects in one folder
};

// The project of the nearest folder that has one: rung.project, else a .plcproj, or beremiz.xml with its plc.xml, or a
// plc.xml alone.
FoundProject projectAround(const std::string& folder);

// The inputs of a command that were not given: its project. Those of `rung test` may be within a project, which is
// added. Returns why it cannot be done, or an empty string.
std::string addProject(std::vector<std::string>& inputs, const std::string& command, bool is_test);

}  // namespace rung::workspace
