// SPDX-License-Identifier: Apache-2.0
// The pins of the call at the cursor. In: a view and a byte of a file. Out: the signature, and which pin is being
// written.
#pragma once

#include <optional>

#include "tools/ide/signature.h"

namespace rung::ide {

struct SignatureHelp {
  PouSignature signature;
  std::optional<uint32_t> active_pin;  // index into its pins
};
std::optional<SignatureHelp> signatureHelpAt(const View& view, const LibraryIndex& libraries, FileId file,
                                             uint32_t byte);

}  // namespace rung::ide
