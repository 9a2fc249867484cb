// SPDX-License-Identifier: Apache-2.0
// How a POU is called: its pins with their types, initial values and documentation. In: a POU of a project, or the
// source of a library block that no program uses yet. Out: the signature, for hover, signature help and completion.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/ide/library_index.h"
#include "tools/ide/scope.h"
#include "tools/ide/view.h"

namespace rung::ide {

struct SignaturePin {
  std::string name, type, initial, documentation;
  SectionKind section;  // Input, InOut or Output
};
struct PouSignature {
  PouKind kind = PouKind::Function;
  std::string name, result, documentation;
  std::string relations;  // ` EXTENDS Base IMPLEMENTS IRun`
  std::vector<SignaturePin> pins;

  // `FUNCTION_BLOCK Ramp EXTENDS Base`, and the sections of the pins.
  std::string declaration() const;
};

// With the pins of its bases.
PouSignature signatureOf(const View& view, PouId pou);
// None: the name is not that of a POU.
std::optional<PouSignature> signatureOf(const LibraryName& name);

}  // namespace rung::ide
