// SPDX-License-Identifier: Apache-2.0
// Namespaces of the libraries: see namespaces.h.
#include "tools/driver/namespaces.h"

#include "frontend/source/text.h"

namespace rung::driver {
namespace {

// Namespaces that are not the folder's name with a capital letter.
struct Namespace {
  std::string_view folder;
  const char* name;
};
constexpr Namespace kNamespaces[] = {{"standard", "Standard"},
                                     {"util", "Util"},
                                     {"iecsfc", "IecSfc"},
                                     {"cmperrors", "CmpErrors"},
                                     {"sysdir", "SysDir"},
                                     {"sysfile", "SysFile"},
                                     {"systypes", "SysTypes"},
                                     {"tc2_ethercat", "Tc2_EtherCAT"},
                                     {"tc2_math", "Tc2_Math"},
                                     {"tc2_mc2", "Tc2_MC2"},
                                     {"tc2_serialcom", "Tc2_SerialCom"},
                                     {"tc2_system", "Tc2_System"},
                                     {"tc2_utilities", "Tc2_Utilities"},
                                     {"tc3_eventlogger", "Tc3_EventLogger"},
                                     {"twincat_systeminfovarlist", "TwinCAT_SystemInfoVarList"}};

constexpr NamespaceAlias kAliases[] = {{"Tc2_Standard", "Standard"},
                                       {"Tc2_Standard", "Standard64"},
                                       {"Tc2_Utilities", "Standard64"},
                                       {"Tc3_Standard", "Standard"},
                                       {"IBaseLibrary", "__system"},
                                       {"Global_Variables", "Tc2_System"},  // Tc2_System.Global_Variables.PI
                                       {"CAA_DTUtil_Extern", "DTU"},
                                       {"CAA_Types_Extern", "CAA"},
                                       {"CAA_Real_Time_Clock_Extern", "RTCLK"},
                                       {"INVT_Files_Function", "Files_Function"}};

}  // namespace

std::span<const NamespaceAlias> namespaceAliases() { return kAliases; }

std::string namespaceOf(std::string_view folder) {
  for (const Namespace& row : kNamespaces)
    if (folder == row.folder) return row.name;
  std::string name(folder);
  if (!name.empty()) name[0] = upper(name[0]);
  return name;
}

}  // namespace rung::driver
