// Namespaces of the libraries: see namespaces.h.
#include "tools/rung/namespaces.h"

namespace rung::tool {
namespace {

// Namespaces that are not the folder's name with a capital letter.
struct Namespace {
  std::string_view folder;
  const char* name;
};
constexpr Namespace kNamespaces[] = {{"standard", "Standard"},         {"util", "Util"},
                                     {"ibaselibrary", "IBaseLibrary"}, {"iecsfc", "IecSfc"},
                                     {"tc2_system", "Tc2_System"},     {"tc2_utilities", "Tc2_Utilities"}};

constexpr NamespaceAlias kAliases[] = {{"Tc2_Standard", "Standard"}, {"Tc3_Standard", "Standard"}};

}  // namespace

std::span<const NamespaceAlias> namespaceAliases() { return kAliases; }

std::string namespaceOf(std::string_view folder) {
  for (const Namespace& row : kNamespaces)
    if (folder == row.folder) return row.name;
  std::string name(folder);
  if (!name.empty() && name[0] >= 'a' && name[0] <= 'z') name[0] = static_cast<char>(name[0] - 32);
  return name;
}

}  // namespace rung::tool
