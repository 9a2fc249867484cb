// SPDX-License-Identifier: Apache-2.0
// Axes of rung.project; see project_axes.h.
#include "tools/driver/project_axes.h"

#include <algorithm>
#include <charconv>

#include "frontend/import/source_mapped_text.h"
#include "frontend/parse/parse.h"
#include "frontend/source/scanner.h"
#include "tools/driver/diagnostics.h"
#include "tools/driver/project_modules.h"

namespace rung::driver {
namespace {

enum class KeyKind : uint8_t { Number, Positive, Switch, Ramp, Objects, Startup, Scale };

// A key and the member of AXIS_REF_SM3 that it sets; members of its drive begin with `simulation.`.
struct Key {
  std::string_view name;
  KeyKind kind;
  std::string_view member;
};
constexpr Key kKeys[] = {
    {"virtual", KeyKind::Switch, "bVirtual"},
    {"scale", KeyKind::Scale, ""},
    {"increments", KeyKind::Scale, ""},
    {"units", KeyKind::Scale, ""},
    {"motor-turns", KeyKind::Scale, ""},
    {"output-turns", KeyKind::Scale, ""},
    {"invert", KeyKind::Scale, ""},
    {"period", KeyKind::Positive, "fPositionPeriod"},
    {"ramp", KeyKind::Ramp, "eRampType"},
    {"max-velocity", KeyKind::Positive, "fMaxVelocity"},
    {"max-acceleration", KeyKind::Positive, "fMaxAcceleration"},
    {"max-deceleration", KeyKind::Positive, "fMaxDeceleration"},
    {"max-jerk", KeyKind::Positive, "fMaxJerk"},
    {"max-jog-velocity", KeyKind::Positive, "fMaxJogVelocity"},
    {"limit-negative", KeyKind::Number, "fSWLimitNegative"},
    {"limit-positive", KeyKind::Number, "fSWLimitPositive"},
    {"limit-deceleration", KeyKind::Positive, "fSWLimitDeceleration"},
    {"limit-switches", KeyKind::Switch, "bHWLimitEnable"},
    {"max-lag", KeyKind::Positive, "fMaxPositionLag"},
    {"torque-factor", KeyKind::Positive, "fFactorTor"},
    {"homing-method", KeyKind::Number, "simulation.homing_method"},
    {"homing-digits", KeyKind::Number, "simulation.homing_digits"},
    {"homing-search-speed", KeyKind::Positive, "simulation.homing_speed_search"},
    {"homing-zero-speed", KeyKind::Positive, "simulation.homing_speed_zero"},
    {"homing-acceleration", KeyKind::Positive, "simulation.homing_acceleration"},
    {"homing-offset", KeyKind::Number, "simulation.home_offset"},
    {"pdo", KeyKind::Objects, ""},
    {"startup", KeyKind::Startup, "startup"},
};
constexpr std::string_view kOfDrive = "simulation.";

// A write of an object by the service channel.
struct StartupObject {
  uint32_t index, subindex, bytes;
  int64_t value;
  bool of_host;  // the simulated drive has the value from its inputs
};
constexpr size_t kMostStartup = 16;  // AXIS_REF_SM3.startup
// The objects that keys of the simulated drive set.
struct KeyObject {
  std::string_view key;
  uint32_t index, subindex, bytes;
};
constexpr KeyObject kKeyObjects[] = {
    {"homing-method", 0x6098, 0, 1},       {"homing-search-speed", 0x6099, 1, 4}, {"homing-zero-speed", 0x6099, 2, 4},
    {"homing-acceleration", 0x609A, 0, 4}, {"homing-offset", 0x607C, 0, 4},
};

// An object of the process data: its number, the member of RUNG_DRIVE, and its bit there (rung/motion.h).
struct Object {
  std::string_view number, member, type;
  char size;
  bool to_drive, needed;
  uint32_t bit;
};
constexpr Object kObjects[] = {
    {"6040", "controlword", "UINT", 'W', true, true, 1},
    {"6060", "mode", "SINT", 'B', true, false, 2},
    {"607A", "target_position", "DINT", 'D', true, true, 4},
    {"60FF", "target_velocity", "DINT", 'D', true, false, 8},
    {"6071", "target_torque", "INT", 'W', true, false, 16},
    {"60B8", "probe_function", "UINT", 'W', true, false, 32},
    {"60FE", "digital_outputs", "UDINT", 'D', true, false, 64},
    {"6041", "statusword", "UINT", 'W', false, true, 256},
    {"6061", "mode_display", "SINT", 'B', false, false, 512},
    {"6064", "position", "DINT", 'D', false, true, 1024},
    {"606C", "velocity", "DINT", 'D', false, false, 2048},
    {"6077", "torque", "INT", 'W', false, false, 4096},
    {"603F", "error_code", "UINT", 'W', false, false, 8192},
    {"60B9", "probe_status", "UINT", 'W', false, false, 16384},
    {"60BA", "probe_1_rising", "DINT", 'D', false, false, 32768},
    {"60BB", "probe_1_falling", "DINT", 'D', false, false, 32768},
    {"60BC", "probe_2_rising", "DINT", 'D', false, false, 32768},
    {"60BD", "probe_2_falling", "DINT", 'D', false, false, 32768},
    {"60FD", "digital_inputs", "UDINT", 'D', false, false, 65536},
};
constexpr std::string_view kCommunication = "communication";  // %IX of the fieldbus: the drive's data is valid

const Object* findObject(std::string_view number) {
  for (const Object& object : kObjects)
    if (sameIdentifier(object.number, number)) return &object;
  return nullptr;
}

const Key* findKey(std::string_view name) {
  for (const Key& key : kKeys)
    if (key.name == name) return &key;
  return nullptr;
}

bool isDigit(char c) { return c >= '0' && c <= '9'; }

// A number of ST: `-1.5`, `3`, `1E6`. As text with a decimal point; empty: it is not a number.
std::string numberOf(std::string_view text) {
  size_t at = text.starts_with('-') ? 1 : 0;
  const auto digits = [&] {
    const size_t begin = at;
    while (at < text.size() && isDigit(text[at])) ++at;
    return at > begin;
  };
  if (!digits()) return {};
  std::string number(text.substr(0, at));
  if (at < text.size() && text[at] == '.') {
    const size_t begin = at++;
    if (!digits()) return {};
    number += text.substr(begin, at - begin);
  } else {
    number += ".0";
  }
  if (at < text.size() && upper(text[at]) == 'E') {
    const size_t begin = at++;
    if (at < text.size() && (text[at] == '+' || text[at] == '-')) ++at;
    if (!digits()) return {};
    number += text.substr(begin, at - begin);
  }
  return at == text.size() ? number : std::string();
}

bool isAboveZero(std::string_view number) {
  const std::string_view mantissa = number.substr(0, number.find_first_of("eE"));
  return number[0] != '-' && mantissa.find_first_of("123456789") != std::string_view::npos;
}

// Literals and names only: no value can bring other code into the generated ST.
bool isLiteral(std::string_view value) {
  if (value.starts_with('-')) value.remove_prefix(1);
  return !value.empty() && std::all_of(value.begin(), value.end(), [](char c) {
    return isDigit(c) || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_' || c == '.' || c == '#';
  });
}

// `%QW10` with the area and size of the object; `%IX4.0` for a bit.
bool isAddress(std::string_view value, char area, char size) {
  if (value.size() < 4 || value[0] != '%' || upper(value[1]) != area || upper(value[2]) != size) return false;
  const size_t dot = value.find('.');
  const std::string_view number = value.substr(3, dot == std::string_view::npos ? dot : dot - 3);
  if (number.empty() || number.size() > 9 || !std::all_of(number.begin(), number.end(), isDigit)) return false;
  if (size != 'X') return dot == std::string_view::npos;
  return dot != std::string_view::npos && dot + 2 == value.size() && value[dot + 1] >= '0' && value[dot + 1] <= '7';
}

class AxisReader {
 public:
  AxisReader(Sources& sources, Diagnostics& diagnostics, ProjectFile& project)
      : diagnostics_(diagnostics), project_(project), text_(sources) {}

  void read(const ProjectSection& section) {
    if (!isNameFree(section)) return;
    drive_.clear();
    bound_.clear();
    startup_.clear();
    communication_ = nullptr;
    has_wrong_address_ = false;
    separator_ = "";
    text_.put(section.loc, "VAR_GLOBAL " + section.name + " : AXIS_REF_SM3 := (");
    for (const ProjectEntry& entry : section.entries) readEntry(section, entry);
    putScale(section);
    putSoftwareLimits(section);
    if (section.find("max-lag") != nullptr) set(section.loc, "bPosLagMonitoring", section.loc, "TRUE");
    if (!bound_.empty()) set(section.loc, "bBoundDrive", section.loc, "TRUE");
    putStartup(section);
    putDrive(section);
    text_.put(section.loc, "); END_VAR\n");
    if (communication_ != nullptr && bound_.empty())
      badValue(diagnostics_, *communication_, "the axis has no object with an address, such as `6040 = %QW0`");
    if (!bound_.empty()) bind(section);
  }

  FileId finish(Sources& sources) { return text_.empty() ? FileId{} : text_.finish(sources, project_.file); }

 private:
  struct Bound {
    const Object* object;
    const ProjectEntry* entry;
  };
  struct Member {
    std::string name, value;
    const ProjectEntry* entry;
  };

  bool isNameFree(const ProjectSection& section) {
    const auto report = [&](std::string_view why) -> Report {
      return diagnostics_.report(diag::AxisName, section.loc, {section.name, why});
    };
    if (text::isReservedWord(section.name)) return report("it is a keyword"), false;
    if (!isModuleName(section.name)) return report("use letters, digits and `_`"), false;
    for (const ProjectSection* const other : sections_)
      if (sameIdentifier(other->name, section.name))
        return report("another axis has this name").declaredHere(other->loc), false;
    sections_.push_back(&section);
    return true;
  }

  void set(Loc member_loc, std::string_view member, Loc value_loc, std::string_view value) {
    text_.put(member_loc, separator_ + std::string(member) + " := ");
    text_.put(value_loc, value);
    separator_ = ", ";
  }

  void setMember(const ProjectEntry& entry, std::string_view member, std::string value) {
    if (member.starts_with(kOfDrive))
      drive_.push_back({std::string(member.substr(kOfDrive.size())), std::move(value), &entry});
    else
      set(entry.key_loc, member, entry.value_loc, value);
  }

  void readEntry(const ProjectSection& section, const ProjectEntry& entry) {
    if (entry.key.starts_with(kOfDrive)) return readDriveEntry(entry);
    if (entry.key == kCommunication) return readCommunication(entry);
    if (const Object* const object = findObject(entry.key)) return readAddress(*object, entry);
    const Key* const key = findKey(entry.key);
    if (key == nullptr) return reportUnknown(entry);
    switch (key->kind) {
      case KeyKind::Number:
      case KeyKind::Positive: return readNumber(*key, entry);
      case KeyKind::Switch: return readSwitch(*key, entry);
      case KeyKind::Ramp: return readRamp(*key, entry);
      case KeyKind::Objects: return readObjects(section, entry);
      case KeyKind::Startup: return readStartup(entry);
      case KeyKind::Scale: return;  // putScale
    }
  }

  void reportUnknown(const ProjectEntry& entry) {
    std::vector<std::string_view> names;
    for (const Key& key : kKeys) names.push_back(key.name);
    diagnostics_.report(diag::ProjectUnknownKey, entry.key_loc, {entry.key, "axis"})
        .length(static_cast<uint32_t>(entry.key.size()))
        .didYouMean(nearest(entry.key, names));
  }

  // Sema knows the inputs of the drive, and reports at this line.
  void readDriveEntry(const ProjectEntry& entry) {
    const std::string name = entry.key.substr(kOfDrive.size());
    if (!isModuleName(name) || text::isReservedWord(name)) return reportUnknown(entry);
    if (!isLiteral(entry.value)) return badValue(diagnostics_, entry, "it takes one literal");
    drive_.push_back({name, entry.value, &entry});
  }

  void readNumber(const Key& key, const ProjectEntry& entry) {
    const std::string number = numberOf(entry.value);
    if (number.empty() || (key.kind == KeyKind::Positive && !isAboveZero(number)))
      return badValue(diagnostics_, entry,
                      key.kind == KeyKind::Positive ? "it takes a number above 0" : "it takes a number");
    for (const KeyObject& object : kKeyObjects) {
      int64_t value = 0;
      if (object.key == key.name && readInteger(entry.value, value))
        startup_.push_back({object.index, object.subindex, object.bytes, value, true});
    }
    // Members of the drive are integers: their range is checked where they are declared.
    setMember(entry, key.member, key.member.starts_with(kOfDrive) ? entry.value : number);
  }

  bool readYes(const ProjectEntry& entry, bool& yes) {
    yes = sameIdentifier(entry.value, "yes") || sameIdentifier(entry.value, "TRUE");
    if (yes || sameIdentifier(entry.value, "no") || sameIdentifier(entry.value, "FALSE")) return true;
    badValue(diagnostics_, entry, "it takes `yes` or `no`");
    return false;
  }

  void readSwitch(const Key& key, const ProjectEntry& entry) {
    bool yes = false;
    if (readYes(entry, yes)) setMember(entry, key.member, yes ? "TRUE" : "FALSE");
  }

  void readRamp(const Key& key, const ProjectEntry& entry) {
    for (const std::string_view ramp : {"trapezoid", "sin2", "quadratic", "quadratic_smooth"})
      if (sameIdentifier(entry.value, ramp)) return setMember(entry, key.member, "SMC_RAMPTYPE." + std::string(ramp));
    badValue(diagnostics_, entry, "it takes trapezoid, quadratic, quadratic_smooth or sin2");
  }

  // `pdo = 6040 607A 6041 6064`: what the process data of the drive has.
  void readObjects(const ProjectSection& section, const ProjectEntry& entry) {
    uint32_t mapped = 0;
    for (size_t at = 0; at < entry.value.size();) {
      const size_t end = std::min(entry.value.find_first_of(" \t,", at), entry.value.size());
      const std::string_view number = std::string_view(entry.value).substr(at, end - at);
      if (!number.empty()) {
        const Object* const object = findObject(number);
        if (object == nullptr)
          diagnostics_.report(diag::AxisObject, {entry.value_loc.offset + static_cast<uint32_t>(at)}, {number})
              .length(static_cast<uint32_t>(number.size()));
        else
          mapped |= object->bit;
      }
      at = end + 1;
    }
    warnOfMissing(section, entry.value_loc, mapped);
    drive_.push_back({"mapped", std::to_string(mapped), &entry});
  }

  // `35`, `-1`, `16#23`
  static bool readInteger(std::string_view text, int64_t& value) {
    const bool is_based = text.starts_with("16#");
    if (is_based) text.remove_prefix(3);
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value, is_based ? 16 : 10);
    return code == std::errc() && end == text.data() + text.size() && !text.empty();
  }

  // `6099:01/4=20000`
  static bool readStartupObject(std::string_view text, StartupObject& object) {
    const auto part = [&](char end, std::string_view& of) {
      const size_t at = text.find(end);
      if (at == std::string_view::npos) return false;
      of = text.substr(0, at);
      text.remove_prefix(at + 1);
      return true;
    };
    const auto hex = [](std::string_view of, size_t digits, uint32_t& value) {
      const auto [end, code] = std::from_chars(of.data(), of.data() + of.size(), value, 16);
      return of.size() == digits && code == std::errc() && end == of.data() + of.size();
    };
    std::string_view number, subindex, bytes;
    if (!part('/', number) || !part('=', bytes)) return false;
    if (const size_t colon = number.find(':'); colon != std::string_view::npos) {
      subindex = number.substr(colon + 1);
      number = number.substr(0, colon);
    }
    if (!hex(number, 4, object.index) || (!subindex.empty() && !hex(subindex, 2, object.subindex))) return false;
    if (bytes != "1" && bytes != "2" && bytes != "4") return false;
    object.bytes = static_cast<uint32_t>(bytes[0] - '0');
    if (!readInteger(text, object.value)) return false;
    const int64_t high = (int64_t{1} << 8 * object.bytes) - 1;
    return object.value <= high && object.value >= -(high + 1) / 2;
  }

  // `startup = 6098/1=35 6099:01/4=20000`: what is written before the axis gets power.
  void readStartup(const ProjectEntry& entry) {
    for (size_t at = 0; at < entry.value.size();) {
      const size_t end = std::min(entry.value.find_first_of(" \t,", at), entry.value.size());
      const std::string_view text = std::string_view(entry.value).substr(at, end - at);
      at = end + 1;
      StartupObject object{};
      if (text.empty()) continue;
      if (!readStartupObject(text, object))
        return badValue(
            diagnostics_, entry,
            "`" + std::string(text) + "` is not an object with its bytes and value, such as 6099:01/4=20000");
      startup_.push_back(object);
    }
    if (startup_.size() > kMostStartup)
      badValue(diagnostics_, entry, "an axis has at most 16 start-up objects, those of the homing included");
  }

  void putStartup(const ProjectSection& section) {
    if (startup_.empty()) return;
    std::string list;
    for (const StartupObject& object : startup_) {
      const uint64_t value = static_cast<uint64_t>(object.value) & ((uint64_t{1} << 8 * object.bytes) - 1);
      list += (list.empty() ? "" : ", ") + std::string("(index := ") + std::to_string(object.index) +
              ", subindex := " + std::to_string(object.subindex) + ", length := " + std::to_string(object.bytes) +
              ", value := " + std::to_string(value) + (object.of_host ? ", of_host := TRUE)" : ")");
    }
    set(section.loc, "startup", section.loc, "[" + list + "]");
  }

  // TM/TP manual 1.7.1: without its objects a drive does not move.
  void warnOfMissing(const ProjectSection& section, Loc loc, uint32_t mapped) {
    std::string missing;
    for (const Object& object : kObjects)
      if (object.needed && (mapped & object.bit) == 0)
        missing.append(missing.empty() ? "" : ", ").append(object.number).append("h");
    if (!missing.empty()) diagnostics_.report(diag::AxisObjectsMissing, loc, {section.name, missing});
  }

  void readAddress(const Object& object, const ProjectEntry& entry) {
    const char area = object.to_drive ? 'Q' : 'I';
    if (isAddress(entry.value, area, object.size)) return bound_.push_back({&object, &entry});
    has_wrong_address_ = true;
    diagnostics_
        .report(diag::AxisAddress, entry.value_loc,
                {object.number, object.type, std::string("%") + area + object.size + "4"})
        .length(static_cast<uint32_t>(entry.value.size()));
  }

  void readCommunication(const ProjectEntry& entry) {
    communication_ = &entry;
    if (isAddress(entry.value, 'I', 'X')) return;
    diagnostics_.report(diag::AxisAddress, entry.value_loc, {kCommunication, "BOOL", "%IX4.0"})
        .length(static_cast<uint32_t>(entry.value.size()));
    communication_ = nullptr;
  }

  // `scale`, or increments of a turn of the motor, its gear, and the units of a turn of the output.
  void putScale(const ProjectSection& section) {
    const ProjectEntry* const scale = section.find("scale");
    const ProjectEntry* const increments = section.find("increments");
    const ProjectEntry* first = scale != nullptr ? scale : increments;
    bool inverts = false;
    if (const ProjectEntry* const invert = section.find("invert")) {
      if (!readYes(*invert, inverts)) return;
      if (first == nullptr) return badValue(diagnostics_, *invert, "the axis has no `scale` and no `increments`");
    }
    for (const char* const other : {"increments", "units", "motor-turns", "output-turns"}) {
      const ProjectEntry* const entry = section.find(other);
      if (entry == nullptr) continue;
      if (scale != nullptr) return badValue(diagnostics_, *entry, "the axis has a `scale` already; remove one of both");
      if (increments == nullptr)
        return badValue(diagnostics_, *entry, "the axis has no `increments` of a turn of the motor");
    }
    if (first == nullptr) return;
    std::string value = inverts ? "-1.0" : "1.0";
    for (const char* const factor : {"scale", "increments", "motor-turns"})
      if (!appendFactor(section, factor, '*', value)) return;
    for (const char* const divisor : {"units", "output-turns"})
      if (!appendFactor(section, divisor, '/', value)) return;
    set(first->key_loc, "fScalefactor", first->value_loc, value);
  }

  bool appendFactor(const ProjectSection& section, const char* key, char operation, std::string& value) {
    const ProjectEntry* const entry = section.find(key);
    if (entry == nullptr) return true;
    const std::string number = numberOf(entry->value);
    if (number.empty() || !isAboveZero(number)) {
      badValue(diagnostics_, *entry, "it takes a number above 0; `invert = yes` changes the direction");
      return false;
    }
    value += std::string(" ") + operation + " " + number;
    return true;
  }

  // Both limits, or none.
  void putSoftwareLimits(const ProjectSection& section) {
    const ProjectEntry* const negative = section.find("limit-negative");
    const ProjectEntry* const positive = section.find("limit-positive");
    if (negative == nullptr && positive == nullptr) return;
    if (negative == nullptr || positive == nullptr) {
      const ProjectEntry& only = negative != nullptr ? *negative : *positive;
      return badValue(diagnostics_, only,
                      std::string("the software limits need `") +
                          (negative != nullptr ? "limit-positive" : "limit-negative") + "` too");
    }
    set(negative->key_loc, "bSWLimitEnable", negative->key_loc, "TRUE");
  }

  void putDrive(const ProjectSection& section) {
    if (drive_.empty()) return;
    text_.put(section.loc, std::string(separator_) + "simulation := (");
    const char* separator = "";
    for (const Member& member : drive_) {
      text_.put(member.entry->key_loc, separator + member.name + " := ");
      text_.put(member.entry->value_loc, member.value);
      separator = ", ";
    }
    text_.put(section.loc, ")");
  }

  // The located variables, and a block whose methods copy them around the programs of the task that has the axis.
  void bind(const ProjectSection& section) {
    const std::string name = "rung_project_axis_" + section.name;
    const auto variable = [&](std::string_view what) { return name + "_" + std::string(what); };
    uint32_t mapped = 0;
    text_.put(section.loc, "VAR_GLOBAL\n");
    for (const Bound& bound : bound_) {
      mapped |= bound.object->bit;
      text_.put(bound.entry->key_loc, variable(bound.object->number) + " AT ");
      text_.put(bound.entry->value_loc, bound.entry->value);
      text_.put(bound.entry->value_loc, " : " + std::string(bound.object->type) + ";\n");
    }
    if (communication_ != nullptr) {
      text_.put(communication_->key_loc, variable(kCommunication) + " AT ");
      text_.put(communication_->value_loc, communication_->value);
      text_.put(communication_->value_loc, " : BOOL;\n");
    }
    if (!has_wrong_address_) warnOfMissing(section, section.loc, mapped);
    const std::string drive = section.name + ".drive.";
    std::string receive = drive + "mapped := " + std::to_string(mapped) + ";\n", send;
    receive += drive + "communication := ";
    receive += communication_ == nullptr ? "1;\n" : "BOOL_TO_USINT(" + variable(kCommunication) + ");\n";
    for (const Bound& bound : bound_) {
      const std::string member = drive + std::string(bound.object->member), located = variable(bound.object->number);
      if (bound.object->to_drive)
        send += located + " := " + member + ";\n";
      else
        receive += member + " := " + located + ";\n";
    }
    text_.put(section.loc, "binding_of_" + name + " : " + name + ";\nEND_VAR\nFUNCTION_BLOCK " + name +
                               "\n{before_task}\nMETHOD Receive\n" + receive +
                               "END_METHOD\n{after_task}\nMETHOD Send\n" + (send.empty() ? ";" : send) +
                               "END_METHOD\nEND_FUNCTION_BLOCK\n");
  }

  Diagnostics& diagnostics_;
  ProjectFile& project_;
  xml::SourceMappedText text_;
  std::vector<const ProjectSection*> sections_;
  std::vector<Member> drive_;  // of the axis that is being read
  std::vector<Bound> bound_;
  std::vector<StartupObject> startup_;
  const ProjectEntry* communication_ = nullptr;
  bool has_wrong_address_ = false;
  const char* separator_ = "";
};

}  // namespace

void readAxes(Sources& sources, Diagnostics& diagnostics, ProjectFile& project) {
  AxisReader reader(sources, diagnostics, project);
  for (const ProjectSection& section : project.sections)
    if (section.kind == "axis" && !section.name.empty()) reader.read(section);
  project.axis_variables = reader.finish(sources);
}

}  // namespace rung::driver
