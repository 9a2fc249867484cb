// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/signature_help.h"

#include "tools/ide/cursor.h"

namespace rung::ide {
namespace {

// By its name, else by position: outputs of functions come after inputs and in-outs, which have the order of the
// declaration.
std::optional<uint32_t> activePin(const PouSignature& signature, const OpenCall& call) {
  for (const std::string_view name : {call.pin, call.first})
    for (uint32_t i = 0; i < signature.pins.size(); ++i)
      if (!name.empty() && sameIdentifier(signature.pins[i].name, name)) return i;
  if (!call.pin.empty() || !call.given.empty() || call.argument >= signature.pins.size()) return std::nullopt;
  return call.argument;
}

}  // namespace

std::optional<SignatureHelp> signatureHelpAt(const View& view, const LibraryIndex& libraries, FileId file,
                                             uint32_t byte) {
  const Cursor cursor = cursorAt(view, file, byte);
  if (cursor.place == CursorPlace::Outside || cursor.place == CursorPlace::Comment) return std::nullopt;
  const std::optional<OpenCall> call = openCallAt(view, cursor);
  if (!call) return std::nullopt;
  std::optional<PouSignature> signature;
  if (const PouId pou = calledBy(view.meanings().scope(), call->callee)) {
    signature = signatureOf(view, pou);
  } else if (const LibraryName* name = libraries.find(call->name, view.snapshot().project()->options.dialect)) {
    signature = signatureOf(*name);
  }
  if (!signature) return std::nullopt;
  const std::optional<uint32_t> active = activePin(*signature, *call);
  return SignatureHelp{std::move(*signature), active};
}

}  // namespace rung::ide
