// SPDX-License-Identifier: Apache-2.0
// Configurations, resources and tasks as ST; see import.h.
#include <algorithm>
#include <charconv>
#include <optional>
#include <string>
#include <unordered_set>
#include <vector>

#include "frontend/import/diagnostics.h"
#include "frontend/import/plcopen/import.h"
#include "frontend/source/names.h"

namespace rung::importer::plcopen {
namespace {

void writeIdentifier(Import& import, const xml::Element& element, std::string_view otherwise) {
  const xml::Attribute* name = import.document.attribute(element, "name");
  const std::string text = name == nullptr ? std::string() : import.document.decoded(*name);
  if (isBlank(text))
    import.out.put(element.loc, otherwise);
  else if (identifierOf(text) == text)
    import.out.add(import.document, *name);
  else
    import.out.put(name->loc, identifierOf(text));
}

// Nanoseconds of an ISO 8601 duration: P1DT2H3M4.05S. Years and months are rejected, since their length varies.
std::optional<uint64_t> isoDuration(std::string_view text) {
  if (text.empty() || foldedCharacter(text[0]) != 'p') return std::nullopt;
  uint64_t total = 0;
  bool in_time = false, any = false;
  for (size_t i = 1; i < text.size();) {
    if (foldedCharacter(text[i]) == 't' && !in_time) {
      in_time = true;
      ++i;
      continue;
    }
    uint64_t whole = 0, fraction = 0, scale = 1;
    bool digits = false;
    for (; i < text.size() && text[i] >= '0' && text[i] <= '9'; ++i, digits = true)
      if ((whole = whole * 10 + static_cast<uint64_t>(text[i] - '0')) > 1'000'000'000) return std::nullopt;
    if (digits && i < text.size() && (text[i] == '.' || text[i] == ','))
      for (++i; i < text.size() && text[i] >= '0' && text[i] <= '9'; ++i)
        if (scale < 1'000'000'000) scale *= 10, fraction = fraction * 10 + static_cast<uint64_t>(text[i] - '0');
    if (!digits || i == text.size()) return std::nullopt;
    constexpr uint64_t kSecond = 1'000'000'000;
    const char unit = foldedCharacter(text[i++]);
    const uint64_t length = !in_time && unit == 'd'   ? 86400 * kSecond
                            : !in_time && unit == 'w' ? 7 * 86400 * kSecond
                            : in_time && unit == 'h'  ? 3600 * kSecond
                            : in_time && unit == 'm'  ? 60 * kSecond
                            : in_time && unit == 's'  ? kSecond
                                                      : 0;
    if (length == 0 || whole > UINT64_MAX / 4 / length) return std::nullopt;
    total += whole * length + length / scale * fraction;
    if (total > UINT64_MAX / 4) return std::nullopt;
    any = true;
  }
  return any ? std::optional(total) : std::nullopt;
}

// `00:00:00.010000`, hours, minutes and seconds as TC6 1.0 has them.
std::optional<uint64_t> clockDuration(std::string_view text) {
  uint64_t whole[3] = {};
  for (uint64_t& part : whole) {
    const auto read = std::from_chars(text.data(), text.data() + text.size(), part);
    if (read.ec != std::errc{} || part > 1'000'000) return std::nullopt;
    text.remove_prefix(static_cast<size_t>(read.ptr - text.data()));
    if (&part == &whole[2]) break;
    if (!text.starts_with(':')) return std::nullopt;
    text.remove_prefix(1);
  }
  uint64_t ns = ((whole[0] * 60 + whole[1]) * 60 + whole[2]) * 1'000'000'000;
  if (text.empty()) return ns;
  if (text[0] != '.' || text.find_first_not_of("0123456789", 1) != std::string_view::npos) return std::nullopt;
  uint64_t digit = 100'000'000;
  for (const char c : text.substr(1)) {
    ns += digit * static_cast<uint64_t>(c - '0');
    digit /= 10;
  }
  return ns;
}

// A time in ST notation, from `PT0.05S`, `00:00:00.05`, `T#50ms` or `50` with a unit; empty: not a time, which was
// reported.
std::string timeOf(Import& import, const xml::Attribute& attribute, std::string unit) {
  std::string text = import.document.decoded(attribute);
  if (const auto duration = isoDuration(text)) return "T#" + std::to_string(*duration) + "ns";
  if (const auto duration = clockDuration(text)) return "T#" + std::to_string(*duration) + "ns";
  if (text.find('#') != std::string::npos) return text;
  uint64_t number = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), number);
  if (unit.empty()) unit = "ms";
  if (unit != "s" && unit != "ms" && unit != "us" && unit != "m") unit = "us";  // µs
  if (read.ec == std::errc{} && read.ptr == text.data() + text.size()) return "T#" + text + unit;
  import.diagnostics.report(diag::XmlDuration, attribute.loc, {text})
      .length(static_cast<uint32_t>(attribute.raw.size()));
  return {};
}

bool isZero(std::string_view time) {
  const size_t hash = time.find('#');
  for (const char c : time.substr(hash == std::string_view::npos ? 0 : hash + 1))
    if (c >= '1' && c <= '9') return false;
  return true;
}

// TASK name (INTERVAL := T#50ms, PRIORITY := 1, …);
class TaskWriter {
 public:
  TaskWriter(Import& import, const xml::Element& task)
      : import_(import), task_(task), settings_(dataOf(import, task, "tasksettings")) {}

  void write() {
    import_.out.put(task_.loc, "TASK ");
    writeIdentifier(import_, task_, "Task");
    import_.out.word("(");
    writeKind();
    writePriority();
    writeWatchdog();
    import_.out.word(");\n");
  }

 private:
  void setting(std::string_view word, Loc loc, std::string_view value) {
    import_.out.put(loc, std::string(any_ ? ", " : "") + std::string(word) + " := ");
    import_.out.put(loc, value);
    any_ = true;
  }

  // As the file has it, so that an editor finds the variable there.
  void variable(std::string_view word, const xml::Attribute& path) {
    setting(word, path.loc, {});
    import_.out.add(import_.document, path);
  }

  bool writeInterval() {
    if (writeInterval(import_.document.attribute(task_, "interval"), "")) return true;
    return settings_ != nullptr && writeInterval(import_.document.attribute(*settings_, "Interval"),
                                                 import_.document.value(*settings_, "IntervalUnit"));
  }

  // False: there is no time, or it is 0.
  bool writeInterval(const xml::Attribute* interval, const std::string& unit) {
    if (interval == nullptr || isBlank(interval->raw)) return false;
    const std::string time = timeOf(import_, *interval, unit);
    if (time.empty()) return true;
    if (isZero(time)) return false;
    setting("INTERVAL", interval->loc, time);
    return true;
  }

  void writeKind() {
    const std::string kind = settings_ == nullptr ? std::string() : import_.document.value(*settings_, "KindOfTask");
    const xml::Attribute* trigger = import_.document.attribute(task_, "single");
    if ((trigger == nullptr || isBlank(trigger->raw)) && settings_ != nullptr)
      trigger =
          import_.document.attribute(*settings_, sameIdentifier(kind, "ExternalEvent") ? "ExternalEvent" : "Event");
    if (trigger != nullptr && isBlank(trigger->raw)) trigger = nullptr;
    const auto kindIs = [&](std::string_view word) { return sameIdentifier(kind, word); };
    if (kindIs("Freewheeling")) {
      setting("KIND", task_.loc, "FREEWHEELING");
    } else if (trigger != nullptr && (kindIs("ExternalEvent") || kindIs("External"))) {
      setting("KIND", task_.loc, "EXTERNAL");
      setting("TRIGGER", trigger->loc, "'" + import_.document.decoded(*trigger) + "'");
    } else if (trigger != nullptr && kindIs("Status")) {
      setting("KIND", task_.loc, "STATUS");
      variable("TRIGGER", *trigger);
    } else if (trigger != nullptr && !kindIs("Cyclic")) {
      variable("SINGLE", *trigger);
      if (kind.empty()) writeInterval();  // of the standard, which runs it periodically too
    } else if (!writeInterval()) {
      setting("KIND", task_.loc, "FREEWHEELING");
    }
  }

  void writePriority() {
    const xml::Attribute* priority = import_.document.attribute(task_, "priority");
    if (priority == nullptr || isBlank(priority->raw)) return;
    uint64_t value = 0;
    const char* end = priority->raw.data() + priority->raw.size();
    const auto read = std::from_chars(priority->raw.data(), end, value);
    if (read.ec == std::errc{} && read.ptr == end && value > kLowestPriority)
      return setting("PRIORITY", priority->loc, std::to_string(kLowestPriority));
    setting("PRIORITY", priority->loc, import_.document.decoded(*priority));
  }

  void writeWatchdog() {
    const xml::Element* watchdog = settings_ == nullptr ? nullptr : import_.document.child(*settings_, "Watchdog");
    if (watchdog == nullptr || !isTrue(import_, *watchdog, "Enabled")) return;
    for (const std::string_view name : {"Time", "Interval", "WatchdogTime"}) {
      const xml::Attribute* time = import_.document.attribute(*watchdog, name);
      if (time == nullptr || isBlank(time->raw)) continue;
      const std::string text = timeOf(import_, *time, import_.document.value(*watchdog, "TimeUnit"));
      if (text.empty() || isZero(text)) return;
      setting("WATCHDOG", time->loc, text);
      const xml::Attribute* sensitivity = import_.document.attribute(*watchdog, "Sensitivity");
      if (sensitivity != nullptr && !isBlank(sensitivity->raw))
        setting("SENSITIVITY", sensitivity->loc, import_.document.decoded(*sensitivity));
      return;
    }
  }

  Import& import_;
  const xml::Element& task_;
  const xml::Element* settings_;
  bool any_ = false;
};

// The blocks of a program that run in separate tasks: instances named `program.block`.
class BlocksInTasks {
 public:
  BlocksInTasks(const Import& import, const xml::Element& resource) {
    std::unordered_set<std::string> programs;
    for (const bool blocks : {false, true})
      forEach(import, resource, [&](const xml::Element& instance, const xml::Element* task) {
        const std::string name = import.document.value(instance, "name");
        const size_t dot = name.find('.');
        if (dot == std::string::npos)
          programs.insert(upper(name));
        else if (blocks && task != nullptr && programs.count(upper(name.substr(0, dot))) != 0)
          all_.push_back({&instance, task, upper(name.substr(0, dot)), name.substr(dot + 1)});
      });
  }
  bool has(const xml::Element& instance) const {
    return std::any_of(all_.begin(), all_.end(), [&](const Block& b) { return b.instance == &instance; });
  }
  // (u WITH slow)
  void write(Import& import, const xml::Element& program) const {
    const std::string program_name = upper(import.document.value(program, "name"));
    bool any = false;
    for (const Block& block : all_) {
      if (block.program != program_name) continue;
      import.out.put(block.instance->loc, any ? ", " : "(");
      const xml::Attribute& name_and_path = *import.document.attribute(*block.instance, "name");
      const size_t path = name_and_path.raw.rfind(block.path);
      if (path == std::string_view::npos) {
        import.out.put(block.instance->loc, block.path);
      } else {
        const Loc begin{name_and_path.loc.offset + static_cast<uint32_t>(path)};
        import.out.add(begin, Loc{begin.offset + static_cast<uint32_t>(block.path.size())});
      }
      import.out.word(" WITH ");
      writeIdentifier(import, *block.task, "Task");
      any = true;
    }
    if (any) import.out.word(")");
  }
  // Visits the <pouInstance> elements of a resource and its tasks.
  template <class Visit>
  static void forEach(const Import& import, const xml::Element& resource, Visit visit) {
    const xml::Document& document = import.document;
    for (const xml::Element& e : document.children(resource)) {
      if (e.name == "pouInstance") visit(e, nullptr);
      if (e.name != "task" || !hasName(import, e)) continue;
      for (const xml::Element& p : document.children(e))
        if (p.name == "pouInstance") visit(p, &e);
    }
  }

 private:
  struct Block {
    const xml::Element* instance;
    const xml::Element* task;
    std::string program, path;
  };
  std::vector<Block> all_;
};

// PROGRAM name [WITH task] : type; In TC6 1.01 the attribute is `type`, and CODESYS writes only a name.
void writeProgram(Import& import, const xml::Element& instance, const xml::Element* task, const BlocksInTasks& blocks) {
  std::string_view type = "name";
  for (const std::string_view attribute : {"type", "typeName"})
    if (hasName(import, instance, attribute)) type = attribute;
  if (!checkName(import, instance, type)) return;
  if (type == "name" && import.document.value(instance, type).find('.') != std::string::npos) {
    const xml::Attribute& called = *import.document.attribute(instance, type);
    import.diagnostics.report(diag::TaskCallsLibrary, called.loc, {import.document.decoded(called)})
        .length(static_cast<uint32_t>(called.raw.size()));
    return;
  }
  import.out.put(instance.loc, "PROGRAM ");
  writeIdentifier(import, instance, identifierOf(import.document.value(instance, type)));
  if (task != nullptr) {
    import.out.word(" WITH ");
    writeIdentifier(import, *task, "Task");
  }
  import.out.word(" : ");
  writeName(import, instance, type);
  blocks.write(import, instance);
  import.out.word(";\n");
}

// VAR_ACCESS name : path : type READ_ONLY; and VAR_CONFIG path AT address : type := value;
void writePaths(Import& import, const xml::Element& list, bool access) {
  import.out.put(list.loc, access ? "VAR_ACCESS\n" : "VAR_CONFIG\n");
  for (const xml::Element& e : import.document.children(list)) {
    if (e.name != (access ? "accessVariable" : "configVariable")) continue;
    if (!checkName(import, e, "instancePathAndName") || (access && !checkName(import, e, "alias"))) continue;
    if (access) {
      writeName(import, e, "alias");
      import.out.word(" : ");
    }
    writeName(import, e, "instancePathAndName");
    if (!access && hasName(import, e, "address")) {
      import.out.word(" AT ");
      writeName(import, e, "address");
    }
    import.out.word(" : ");
    writeType(import, e);
    if (access)
      import.out.word(import.document.value(e, "direction") == "readWrite" ? " READ_WRITE" : " READ_ONLY");
    else
      writeInitialValue(import, e, import.document.child(e, "type"));
    import.out.word(";\n");
  }
  import.out.word("END_VAR\n");
}

// The elements that configurations and resources share. Named lists of globals are written elsewhere.
void writePart(Import& import, const xml::Element& e) {
  if (e.name == "globalVars" && !hasName(import, e)) writeSection(import, e, "VAR_GLOBAL");
  if (e.name == "accessVars") writePaths(import, e, true);
  if (e.name == "configVars") writePaths(import, e, false);
}

bool hasPrograms(const Import& import, const xml::Element& task) {
  return import.document.child(task, "pouInstance") != nullptr;
}

void writeResource(Import& import, const xml::Element& resource) {
  import.out.put(resource.loc, "RESOURCE ");
  writeIdentifier(import, resource, "Resource");
  import.out.word(" ON PLC\n");
  for (const xml::Element& e : import.document.children(resource)) {
    writePart(import, e);
    if (e.name == "task" && hasPrograms(import, e) && checkName(import, e)) TaskWriter(import, e).write();
  }
  const BlocksInTasks blocks(import, resource);
  BlocksInTasks::forEach(import, resource, [&](const xml::Element& instance, const xml::Element* task) {
    if (!blocks.has(instance)) writeProgram(import, instance, task, blocks);
  });
  import.out.put(resource.end, "END_RESOURCE\n");
}

}  // namespace

void writeConfiguration(Import& import, const xml::Element& configuration) {
  if (const xml::Element* plain = plainText(import, configuration)) {
    import.out.put(plain->loc, "");
    writeText(import, *plain);
    import.out.word("\n");
    return;
  }
  import.out.put(configuration.loc, "CONFIGURATION ");
  writeIdentifier(import, configuration, "Configuration");
  import.out.word("\n");
  for (const xml::Element& e : import.document.children(configuration)) {
    writePart(import, e);
    if (e.name == "resource" && !import.isLeftOut(e)) writeResource(import, e);
  }
  import.out.put(configuration.end, "END_CONFIGURATION\n");
}

void writeApplications(Import& import, std::span<const xml::Element* const> resources) {
  import.out.put(resources.front()->loc, "CONFIGURATION Device\n");
  for (const xml::Element* resource : resources) writeResource(import, *resource);
  import.out.put(resources.back()->end, "END_CONFIGURATION\n");
}

}  // namespace rung::importer::plcopen
