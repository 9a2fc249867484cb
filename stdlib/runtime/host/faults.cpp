// SPDX-License-Identifier: Apache-2.0
// Formatting of faults: see faults.h.
#include "faults.h"

#include <strings.h>

#include <algorithm>
#include <cstdio>
#include <string_view>

#include "tasks.h"

namespace rung::host {

std::string shownPath(const ShownPaths& paths, const std::string& path) {
  const auto it = paths.find(path);
  return it == paths.end() ? path : it->second;
}

namespace {

// ---- who called

bool isSame(std::string_view name, std::string_view other) {
  return name.size() == other.size() && strncasecmp(name.data(), other.data(), name.size()) == 0;
}

// The instance of a type at an address, from the variables that contain the address down: each may begin with another.
class InstanceSearch {
 public:
  InstanceSearch(const rung_context& context, std::string_view type)
      : context_(context), module_(*context.module), type_(type) {}

  // The path; '': there is none, such as for a variable of a function.
  const std::string& found() const { return found_; }
  // The outermost variable that begins there, of whatever type.
  const std::string& first() const { return first_; }
  InstanceSearch& find(const void* instance) {
    for (uint32_t i = 0; i < module_.symbols.count; ++i) {
      const rung_symbol& symbol = *rung_symbol_at(&module_, i);
      if (symbol.storage != RUNG_IN_BLOCK || (symbol.flags & RUNG_FIELD_BY_REFERENCE) != 0) continue;
      const uintptr_t at = reinterpret_cast<uintptr_t>(context_.blocks[symbol.index]) + symbol.offset;
      const uintptr_t distance = reinterpret_cast<uintptr_t>(instance) - at;
      if (distance >= rung_type_at(&module_, symbol.type)->size) continue;
      enter(symbol.type, static_cast<uint32_t>(distance), text(symbol.name));
      if (!found_.empty()) break;
    }
    return *this;
  }

 private:
  const char* text(uint32_t offset) const { return module_.strings + offset; }

  void enter(uint32_t number, uint32_t distance, const std::string& path) {
    const rung_type& type = *rung_type_at(&module_, number);
    if (type.kind == RUNG_ARRAY) return enterElement(type, distance, path);
    if (type.kind != RUNG_RECORD) return;
    if (distance == 0 && first_.empty()) first_ = path;
    if (distance == 0 && isSame(text(type.name), type_)) found_ = path;
    for (uint32_t i = 0; i < type.count && found_.empty(); ++i) {
      const rung_field& field = *rung_field_at(&module_, type.first + i);
      if ((field.flags & RUNG_FIELD_BY_REFERENCE) != 0 || distance < field.offset ||
          distance - field.offset >= rung_type_at(&module_, field.type)->size)
        continue;
      const bool is_base = (field.flags & RUNG_FIELD_BASE) != 0;
      enter(field.type, distance - field.offset, is_base ? path : path + '.' + text(field.name));
    }
  }

  void enterElement(const rung_type& type, uint32_t distance, const std::string& path) {
    const uint32_t size = rung_type_at(&module_, type.element)->size;
    if (size == 0) return;
    int64_t number = distance / size;
    std::string indices;
    for (uint32_t i = type.count; i > 0; --i) {
      const rung_dimension& dimension = *rung_dimension_at(&module_, type.first + i - 1);
      const int64_t extent = dimension.high - dimension.low + 1;
      indices = std::to_string(dimension.low + number % extent) + (indices.empty() ? "" : ",") + indices;
      number /= extent;
    }
    enter(type.element, distance % size, path + '[' + indices + ']');
  }

  const rung_context& context_;
  const rung_module& module_;
  std::string_view type_;
  std::string found_, first_;
};

// Of a POU as faults name it: `Belt`, or its method `Belt.run`.
std::string instanceOf(const rung_context& context, const std::string& pou, const void* instance) {
  InstanceSearch search(context, std::string_view(pou).substr(0, pou.find('.')));
  search.find(instance);
  return search.found().empty() ? search.first() : search.found();
}

// `  Main.line[0] called in `Main` at line.st:20:3`, the innermost call first.
std::string describeCallers(const rung_context& context, const rung_fault& fault, const ShownPaths& paths) {
  const rung_module& module = *context.module;
  const auto pouOf = [&](uint32_t site) {
    return site < module.sites.count ? module.strings + rung_site_at(&module, site)->pou : "";
  };
  const bool is_last = context.fault.kind == fault.kind && context.fault.site == fault.site;
  const uint32_t count = is_last ? std::min<uint32_t>(context.caller_count, RUNG_CALLERS) : 0;
  std::string text, callee = pouOf(fault.site);
  for (uint32_t i = 0; i < count; ++i) {
    const rung_caller& caller = context.callers[i];
    if (caller.site >= module.sites.count) continue;
    const rung_site& site = *rung_site_at(&module, caller.site);
    if (site.line == 0) continue;  // the host's call, not the program's
    const std::string instance =
        caller.instance == nullptr ? std::string() : instanceOf(context, callee, caller.instance);
    text += "\n  ";
    text += instance.empty() ? "`" + callee + '`' : "`" + instance + '`';
    const std::string pou = pouOf(caller.site);
    text += " called ";
    if (pou.find('~') == std::string::npos) text += "in `" + pou + "` ";  // else Rung made it: a case of a test
    text += "at " + shownPath(paths, module.strings + site.file) + ':' + std::to_string(site.line);
    if (site.column != 0) text += ':' + std::to_string(site.column);
    callee = pouOf(caller.site);
  }
  if (is_last && context.caller_count > RUNG_CALLERS)
    text += "\n  and " + std::to_string(context.caller_count - RUNG_CALLERS) + " more calls";
  return text;
}

// Where a body in C++ runs, of which there are no sites.
struct CppBody {
  std::string location, pou;
};
CppBody cppBodyOf(const rung_context& context, const ShownPaths& paths) {
  const std::string_view text(context.cpp_body);
  const size_t line = text.find('\n') + 1, pou = text.find('\n', line) + 1;
  return {shownPath(paths, std::string(text.substr(0, line - 1))) + ':' +
              std::string(text.substr(line, pou - 1 - line)) + ": ",
          " in the C++ body of `" + std::string(text.substr(pou)) + '`'};
}

// ---- what happened

std::string nullFault(int64_t value) {
  if (value == 0) return "a pointer, reference or in-out refers to nothing";
  if (value == RUNG_BAD_ADDRESS) return "a pointer or reference points to memory that the program may not access";
  return "__DELETE of memory that __NEW did not return, or that was already deleted";
}

std::string lockFault(int64_t value) {
  switch (value) {
    case RUNG_LOCK_HELD: return "another task holds the MUTEX and cannot unlock it while this one waits";
    case RUNG_LOCK_OWN: return "this task already holds the MUTEX";
    case RUNG_SEMA_FULL: return "RELEASE of a SEMA that is not acquired";
    case RUNG_SEMA_EMPTY: return "the SEMA is exhausted, and nothing is released while this task waits";
    default: return "UNLOCK of a MUTEX that this task has not locked";
  }
}

std::string stopFault(int64_t value, int64_t step_limit) {
  switch (value) {
    case RUNG_STOP_STEPS: return "[steps]: no end after " + std::to_string(step_limit) + " steps (--max-steps)";
    case RUNG_STOP_TIME: return "[time]: the time limit is reached (--timeout)";
    default: return "[interrupt]: interrupted";
  }
}

// `[div]: division by zero`: the word of the fault and a sentence. `site` has the bounds of indices and subranges.
std::string faultText(const rung_fault& fault, const rung_site& site, int64_t step_limit) {
  const std::string value = std::to_string(fault.value);
  const std::string range = std::to_string(site.low) + ".." + std::to_string(site.high);
  switch (static_cast<rung_fault_kind>(fault.kind)) {
    case RUNG_FAULT_NONE: break;
    case RUNG_FAULT_DIV: return "[div]: division by zero";
    case RUNG_FAULT_INDEX:
      return "[index]: index " + value + " is outside " + (site.low > site.high ? "the bounds of the ARRAY[*]" : range);
    case RUNG_FAULT_NULL: return "[null]: " + nullFault(fault.value);
    case RUNG_FAULT_CAST:
      return fault.value == RUNG_NO_SUCH_METHOD
                 ? "[cast]: the pointer does not point to an object that can be called here"
                 : "[cast]: the object is not of the type named in the cast";
    case RUNG_FAULT_SUBRANGE: return "[subrange]: value " + value + " is outside " + range;
    case RUNG_FAULT_CONVERT: return "[convert]: value " + value + " does not fit in the type it is converted to";
    case RUNG_FAULT_OVERFLOW: return "[overflow]: the result does not fit in its type";
    case RUNG_FAULT_LOCK: return "[lock]: " + lockFault(fault.value);
    case RUNG_FAULT_STACK: return "[stack]: calls are nested too deeply";
    case RUNG_FAULT_STOP: return stopFault(fault.value, step_limit);
  }
  return "[unknown]: number " + std::to_string(fault.kind);
}

}  // namespace

std::string instancePath(const rung_context& context, std::string_view type, const void* instance) {
  return InstanceSearch(context, type).find(instance).found();
}

std::string describeEnding(const Ending& ending, const rung_context& context, const ShownPaths& paths) {
  switch (ending.kind) {
    case Ending::Complete: break;
    case Ending::Faulted:
      return describeFault(ending.context != nullptr ? *ending.context : context, ending.fault, paths);
    case Ending::Watchdog: return "fault[watchdog]: task `" + ending.name + "` ran longer than its watchdog allows";
    case Ending::Driver: return "fault[driver]: `" + ending.name + "` does not answer";
  }
  return "";
}

std::string describeAssertion(const rung_assertion& assertion, const char* expected, const char* actual) {
  std::string text = std::string("assertion failed: expected ") + expected + ", got " + actual;
  if (assertion.message != nullptr) text += std::string(" (") + assertion.message + ')';
  return text;
}

const char* severityWord(uint8_t severity) {
  static const char* const words[] = {"note", "warning", "error"};
  return words[severity <= RUNG_MESSAGE_ERROR ? severity : 0];
}

std::string messageLine(int64_t now_ns, uint8_t severity, const char* text) {
  const int64_t ms = now_ns / 1'000'000;
  char time[32];
  snprintf(time, sizeof time, "%lld.%03d s: ", static_cast<long long>(ms / 1000), static_cast<int>(ms % 1000));
  return std::string(time) + severityWord(severity) + ": " + text;
}

std::string describeCppBody(const rung_context& context, const ShownPaths& paths, const std::string& what) {
  if (context.cpp_body == nullptr) return what;
  const CppBody body = cppBodyOf(context, paths);
  return body.location + what + body.pou;
}

std::string describeFault(const rung_context& context, const rung_fault& fault, const ShownPaths& paths) {
  const rung_module& module = *context.module;
  static const rung_site nowhere{};
  const bool known = fault.site < module.sites.count;
  const rung_site& site = known ? *rung_site_at(&module, fault.site) : nowhere;
  std::string text;
  if (known) text = shownPath(paths, module.strings + site.file) + ':' + std::to_string(site.line) + ": ";
  text += "fault" + faultText(fault, site, context.step_limit);
  if (known && module.strings[site.pou] != 0) text += std::string(" in `") + (module.strings + site.pou) + '`';
  if (!known && context.cpp_body != nullptr) return describeCppBody(context, paths, text);
  if (!known && (fault.value == RUNG_BAD_ADDRESS || fault.kind == RUNG_FAULT_STACK))
    text += ", in compiled code; `rung run --engine=interp` shows the line";
  return text + describeCallers(context, fault, paths);
}

}  // namespace rung::host
