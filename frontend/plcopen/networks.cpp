// Networks; see networks.h.
#include "frontend/plcopen/networks.h"

namespace rung::plcopen {

bool writeNetworks(const Sources&, const xml::Document&, const Diagram& diagram, Diagnostics& diagnostics,
                   xml::Assembly&) {
  const char* language = diagram.condition != nullptr               ? "a chart with a condition drawn in networks"
                         : diagram.language == NetworkLanguage::Ld  ? "drawn in LD"
                         : diagram.language == NetworkLanguage::Fbd ? "drawn in FBD"
                                                                    : "drawn in CFC";
  const Loc loc = diagram.condition != nullptr ? diagram.condition->loc : diagram.body.loc;
  diagnostics.report(Diag::NetworkBody, loc, {diagram.name, language});
  return false;
}

}  // namespace rung::plcopen
