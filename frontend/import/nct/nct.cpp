// SPDX-License-Identifier: Apache-2.0
// Reads an NCT program; see nct.h.
#include "frontend/import/nct/nct.h"

#include "frontend/import/nct/drawing.h"
#include "frontend/import/nct/messages.h"
#include "frontend/import/nct/write.h"

namespace rung::importer::nct {

FileId readProgram(ReadContext& context, FileId file) {
  const uint32_t errors = context.diagnostics.errorCount();
  Program program = read(context.sources, file, context.diagnostics);
  xml::SourceMappedText out(context.sources);
  if (context.for_pictures) {
    writeDrawing(program, out);
  } else {
    importMessages(context.sources, context.message_files, program, context.diagnostics);
    for (const MessageLine& line : program.messages) context.messages.push_back({line.number, line.text});
    const LadderSettings& settings = context.ladder;
    const Limits limits{static_cast<int32_t>(settings.kept), static_cast<int32_t>(settings.volatile_)};
    Memory memory(program, limits, context.diagnostics);
    write(program, memory, settings, context.diagnostics, out);
  }
  if (context.diagnostics.errorCount() != errors) return {};
  const FileId made = out.finish(context.sources, file);
  if (made) context.sources.allowAnyUnderscores(made);
  return made;
}

}  // namespace rung::importer::nct
