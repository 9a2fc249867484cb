// Formatting of faults: see faults.h.
#include "faults.h"

namespace rung::host {

std::string shownPath(const ShownPaths& paths, const std::string& path) {
  const auto it = paths.find(path);
  return it == paths.end() ? path : it->second;
}

namespace {

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

}  // namespace

std::string describeCppBody(const rung_context& context, const ShownPaths& paths, const std::string& what) {
  if (context.cpp_body == nullptr) return what;
  const CppBody body = cppBodyOf(context, paths);
  return body.location + what + body.pou;
}

std::string describeFault(const rung_context& context, const rung_fault& fault, const ShownPaths& paths) {
  const rung_module& module = *context.module;
  static const rung_site nowhere{};
  const bool known = fault.site < module.site_count;
  const rung_site& site = known ? module.sites[fault.site] : nowhere;
  const std::string value = std::to_string(fault.value);
  const std::string range = std::to_string(site.low) + ".." + std::to_string(site.high);
  std::string word = "unknown", what = "number " + std::to_string(fault.kind);
  switch (static_cast<rung_fault_kind>(fault.kind)) {
    case RUNG_FAULT_NONE: break;
    case RUNG_FAULT_DIV:
      word = "div";
      what = "division by zero";
      break;
    case RUNG_FAULT_INDEX:
      word = "index";
      what = "index " + value + " is outside " + (site.low > site.high ? "the bounds of the ARRAY[*]" : range);
      break;
    case RUNG_FAULT_NULL:
      word = "null";
      what = fault.value == 0 ? "a pointer, reference or in-out refers to nothing"
             : fault.value == RUNG_BAD_ADDRESS
                 ? "a pointer or reference points to memory that the program may not access"
                 : "__DELETE of memory that __NEW did not return, or that was already deleted";
      break;
    case RUNG_FAULT_CAST:
      word = "cast";
      what = fault.value == RUNG_NO_SUCH_METHOD ? "the pointer does not point to an object that can be called here"
                                                : "the object is not of the type named in the cast";
      break;
    case RUNG_FAULT_SUBRANGE:
      word = "subrange";
      what = "value " + value + " is outside " + range;
      break;
    case RUNG_FAULT_CONVERT:
      word = "convert";
      what = "value " + value + " does not fit in the type it is converted to";
      break;
    case RUNG_FAULT_OVERFLOW:
      word = "overflow";
      what = "the result does not fit in its type";
      break;
    case RUNG_FAULT_LOCK:
      word = "lock";
      what = fault.value == RUNG_LOCK_HELD    ? "another task holds the MUTEX and cannot unlock it while this one waits"
             : fault.value == RUNG_LOCK_OWN   ? "this task already holds the MUTEX"
             : fault.value == RUNG_SEMA_FULL  ? "RELEASE of a SEMA that is not acquired"
             : fault.value == RUNG_SEMA_EMPTY ? "the SEMA is exhausted, and nothing is released while this task waits"
                                              : "UNLOCK of a MUTEX that this task has not locked";
      break;
    case RUNG_FAULT_STACK:
      word = "stack";
      what = "calls are nested too deeply";
      break;
    case RUNG_FAULT_STOP:
      word = fault.value == RUNG_STOP_STEPS ? "steps" : fault.value == RUNG_STOP_TIME ? "time" : "interrupt";
      what = fault.value == RUNG_STOP_STEPS
                 ? "no end after " + std::to_string(context.step_limit) + " steps (--max-steps)"
             : fault.value == RUNG_STOP_TIME ? "the time limit is reached (--timeout)"
                                             : "interrupted";
      break;
  }
  std::string text;
  if (known) text = shownPath(paths, module.strings + site.file) + ':' + std::to_string(site.line) + ": ";
  text += "fault[" + word + "]: " + what;
  if (known && module.strings[site.pou] != 0) text += std::string(" in `") + (module.strings + site.pou) + '`';
  if (!known && context.cpp_body != nullptr) return describeCppBody(context, paths, text);
  if (!known && (fault.value == RUNG_BAD_ADDRESS || fault.kind == RUNG_FAULT_STACK))
    text += ", in compiled code; `rung run --engine=interp` shows the line";
  return text;
}

}  // namespace rung::host
