// SPDX-License-Identifier: Apache-2.0
// Modules of rung.project; see project_modules.h.
#include "tools/driver/project_modules.h"

#include <algorithm>
#include <charconv>

#include "frontend/import/source_mapped_text.h"
#include "frontend/parse/parse.h"
#include "frontend/source/scanner.h"
#include "stdlib/runtime/host/modules/types.h"
#include "tools/driver/diagnostics.h"

namespace rung::driver {
namespace {

using host::Channel;
using host::ModuleType;

// `%IB48`, `%IW24` and `%ID12` are the byte 48 of the inputs.
std::optional<uint32_t> byteOf(std::string_view address, char area) {
  if (address.size() < 4 || address[0] != '%' || upper(address[1]) != area) return std::nullopt;
  const char letter = upper(address[2]);
  const uint32_t size = letter == 'B' ? 1 : letter == 'W' ? 2 : letter == 'D' ? 4 : 0;
  uint64_t number = 0;
  const char* const end = address.data() + address.size();
  const auto read = std::from_chars(address.data() + 3, end, number);
  if (size == 0 || read.ec != std::errc{} || read.ptr != end || number * size >= types::kMaxAreaBytes)
    return std::nullopt;
  return static_cast<uint32_t>(number * size);
}

std::string addressOf(const Channel& channel) {
  const std::string area = channel.is_output ? "%Q" : "%I";
  const uint32_t size = host::bytesOf(channel.type);
  if (channel.type == host::ChannelType::Bool)
    return area + 'X' + std::to_string(channel.byte) + '.' + std::to_string(channel.bit);
  return area + (size == 1 ? 'B' : size == 2 ? 'W' : 'D') + std::to_string(channel.byte / size);
}

class ModuleReader {
 public:
  ModuleReader(Sources& sources, Diagnostics& diagnostics, ProjectFile& project)
      : diagnostics_(diagnostics), project_(project), text_(sources) {}

  void read(const ProjectSection& section) {
    if (!isNameFree(section)) return;
    const ModuleType* const type = typeOf(section);
    if (type == nullptr) return;
    sema::ConfiguredModule module;
    module.module.name = section.name;
    module.module.type = type->name;
    if (const ProjectEntry* const station = section.find("station")) module.module.station = station->value;
    if (const ProjectEntry* const task = section.find("task")) {
      module.task = task->value;
      module.task_loc = task->value_loc;
    }
    takeRackPlace(section, *type);
    const Span in = place(section, "inputs", 'I'), out = place(section, "outputs", 'Q');
    module.module.input_offset = in.begin;
    module.module.output_offset = out.begin;
    uint32_t input_end = in.begin, output_end = out.begin;
    declare(section, host::channelsOf(*type, input_end, output_end));
    take(inputs_, {in.begin, input_end}, section, "inputs");
    take(outputs_, {out.begin, output_end}, section, "outputs");
    project_.io_modules.push_back(std::move(module));
  }

  FileId finish(Sources& sources) { return text_.empty() ? FileId{} : text_.finish(sources, project_.file); }

 private:
  struct Span {
    uint32_t begin, end;
  };
  struct Taken {
    Span bytes;
    const ProjectSection* by;
  };

  bool isNameFree(const ProjectSection& section) {
    const auto report = [&](std::string_view why) -> Report {
      return diagnostics_.report(diag::ModuleName, section.loc, {section.name, why});
    };
    if (text::isReservedWord(section.name)) return report("it is a keyword"), false;
    if (!isModuleName(section.name)) return report("use letters, digits and `_`"), false;
    for (const ProjectSection* const other : sections_)
      if (sameIdentifier(other->name, section.name))
        return report("another module has this name").declaredHere(other->loc), false;
    sections_.push_back(&section);
    return true;
  }

  // A station is a coupler among the modules above.
  const ModuleType* typeOf(const ProjectSection& section) {
    const ProjectEntry* const type = section.find("type");
    if (type == nullptr) {
      diagnostics_.report(diag::ModuleNoType, section.loc, {section.name});
      return nullptr;
    }
    const ProjectEntry* const station = section.find("station");
    if (station != nullptr && !isCoupler(station->value)) {
      badValue(diagnostics_, *station, "it takes the name of a module of type AX_EM_RCM_ET, declared above this one");
      return nullptr;
    }
    const ModuleType* const found = host::findModuleType(type->value, station != nullptr);
    if (found != nullptr) return found;
    if (host::findModuleType(type->value, false) != nullptr) {
      badValue(diagnostics_, *type, "this module is not connected to a station; remove `station`");
      return nullptr;
    }
    std::string names;
    for (const std::string_view name : host::moduleTypeNames()) names.append(names.empty() ? "" : ", ").append(name);
    diagnostics_.report(diag::ProjectValue, type->value_loc, {"type", "it takes one of " + names})
        .length(static_cast<uint32_t>(type->value.size()))
        .didYouMean(nearest(type->value, host::moduleTypeNames()));
    return nullptr;
  }

  bool isCoupler(std::string_view name) const {
    return std::any_of(project_.io_modules.begin(), project_.io_modules.end(), [&](const sema::ConfiguredModule& is) {
      const ModuleType* const type = host::findModuleType(is.module.type, false);
      return sameIdentifier(is.module.name, name) && type != nullptr && type->simulation == host::Simulation::Coupler;
    });
  }

  void takeRackPlace(const ProjectSection& section, const ModuleType& type) {
    if (!type.in_rack) return;
    const ProjectEntry* const station = section.find("station");
    const std::string_view rack = station == nullptr ? std::string_view() : station->value;
    uint32_t count = 1;
    for (const sema::ConfiguredModule& other : project_.io_modules) {
      const ModuleType* const is = host::findModuleType(other.module.type, !other.module.station.empty());
      count += is != nullptr && is->in_rack && sameIdentifier(other.module.station, rack) ? 1 : 0;
    }
    if (count == host::kRackPlaces + 1) diagnostics_.report(diag::RackFull, section.loc, {section.name});
  }

  // Where its inputs or outputs begin: as written, or after those of the modules above.
  Span place(const ProjectSection& section, const char* key, char area) {
    uint32_t begin = 0;
    for (const Taken& taken : area == 'I' ? inputs_ : outputs_) begin = std::max(begin, taken.bytes.end);
    if (const ProjectEntry* const entry = section.find(key)) {
      const std::optional<uint32_t> written = byteOf(entry->value, area);
      if (!written)
        badValue(diagnostics_, *entry, std::string("it takes the address of a byte, such as `%") + area + "B48`");
      else
        begin = *written;
    }
    return {begin, begin};
  }

  void take(std::vector<Taken>& all, Span bytes, const ProjectSection& section, std::string_view what) {
    if (bytes.begin == bytes.end) return;
    for (const Taken& other : all) {
      if (bytes.begin >= other.bytes.end || other.bytes.begin >= bytes.end) continue;
      diagnostics_.report(diag::ModulesOverlap, section.loc, {what, section.name, other.by->name})
          .declaredHere(other.by->loc);
      break;
    }
    all.push_back({bytes, &section});
  }

  // The channels of `[module ad]` are the variables ad.IN0 and so on.
  void declare(const ProjectSection& section, const std::vector<Channel>& channels) {
    if (channels.empty()) return;
    text_.put(section.loc, "NAMESPACE " + section.name + "\n{attribute 'qualified_only'}\nVAR_GLOBAL\n");
    for (const Channel& channel : channels)
      text_.put(section.loc, channel.name + " AT " + addressOf(channel) + " : " + host::spelling(channel.type) + ";\n");
    text_.put(section.loc, "END_VAR\nEND_NAMESPACE\n");
  }

  Diagnostics& diagnostics_;
  ProjectFile& project_;
  xml::SourceMappedText text_;
  std::vector<const ProjectSection*> sections_;
  std::vector<Taken> inputs_, outputs_;
};

}  // namespace

void readModules(Sources& sources, Diagnostics& diagnostics, ProjectFile& project) {
  ModuleReader reader(sources, diagnostics, project);
  for (const ProjectSection& section : project.sections)
    if (section.kind == "module" && !section.name.empty()) reader.read(section);
  project.module_variables = reader.finish(sources);
}

}  // namespace rung::driver
