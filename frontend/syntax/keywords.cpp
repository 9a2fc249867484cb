// SPDX-License-Identifier: Apache-2.0
#include "frontend/syntax/keywords.h"

namespace rung {

const char* keywordOf(PouKind kind) {
  switch (kind) {
    case PouKind::Function: return "FUNCTION";
    case PouKind::FunctionBlock: return "FUNCTION_BLOCK";
    case PouKind::Program: return "PROGRAM";
    case PouKind::Class: return "CLASS";
    case PouKind::Interface: return "INTERFACE";
    case PouKind::Method: return "METHOD";
    case PouKind::Action: return "ACTION";
  }
  return "";
}

const char* keywordOf(SectionKind section) {
  switch (section) {
    case SectionKind::Local: return "VAR";
    case SectionKind::Input: return "VAR_INPUT";
    case SectionKind::Output: return "VAR_OUTPUT";
    case SectionKind::InOut: return "VAR_IN_OUT";
    case SectionKind::Temp: return "VAR_TEMP";
    case SectionKind::External: return "VAR_EXTERNAL";
    case SectionKind::Global: return "VAR_GLOBAL";
    case SectionKind::Stat: return "VAR_STAT";
    case SectionKind::Inst: return "VAR_INST";
    case SectionKind::Access: return "VAR_ACCESS";
    case SectionKind::Config: return "VAR_CONFIG";
  }
  return "";
}

}  // namespace rung
