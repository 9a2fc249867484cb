// SPDX-License-Identifier: Apache-2.0
// Prints declarations, and the functions and records that they define: see printer.h.
#include "codegen/cxx/print.h"
#include "codegen/cxx/printer.h"
#include "codegen/names.h"

namespace rung::codegen::cxx {

// The extents of an array follow the name; what refers to an array has the name in parentheses.
void printDeclarator(Sink& out, const Type& type, std::string_view name) {
  const bool refers_to_array = !type.reference.empty() && !type.extents.empty();
  out += type.base;
  out += refers_to_array ? std::string_view(" (") : type.reference;
  if (refers_to_array)
    out += type.reference;
  else if (!name.empty() || !type.reference.empty())
    out += ' ';
  out += name;
  if (refers_to_array) out += ')';
  std::string extents;
  for (const uint64_t extent : type.extents) {
    extents += '[';
    if (extent != 0) appendUnsigned(extents, extent);
    extents += ']';
  }
  out += extents;
}

void DeclarationPrinter::list(const Decl* first) {
  for (const Decl* decl = first; decl != nullptr; decl = decl->next) {
    const bool is_text = decl->kind == DeclKind::Blank || decl->kind == DeclKind::Printed;
    if (!is_text) out_.append(indentOf(depth_), ' ');
    print(*decl);
    if (decl->kind != DeclKind::Printed) out_ += '\n';
  }
}

void DeclarationPrinter::print(const Decl& decl) {
  switch (decl.kind) {
    case DeclKind::Variable: return variable(as<Variable>(decl));
    case DeclKind::Function: return function(as<Function>(decl));
    case DeclKind::Record: return record(as<Record>(decl));
    case DeclKind::Enumeration: return enumeration(as<Enumeration>(decl));
    case DeclKind::Namespace: return space(as<Namespace>(decl));
    case DeclKind::Using:
      out_ += "using ";
      out_ += as<Using>(decl).name;
      if (!as<Using>(decl).of.empty()) out_ += " = ";
      out_ += as<Using>(decl).of;
      out_ += ';';
      return;
    case DeclKind::Assertion:
      out_ += "static_assert(";
      expression(as<Assertion>(decl).condition);
      out_ += ", \"";
      out_ += as<Assertion>(decl).text;
      out_ += "\");";
      return;
    case DeclKind::Include:
      out_ += "#include \"";
      out_ += as<Textual>(decl).text;
      out_ += '"';
      return;
    case DeclKind::Directive:
      out_ += '#';
      out_ += as<Textual>(decl).text;
      return;
    case DeclKind::Comment:
      out_ += "// ";
      out_ += as<Textual>(decl).text;
      return;
    case DeclKind::Blank:
    case DeclKind::Printed: out_ += as<Textual>(decl).text; return;
  }
}

void DeclarationPrinter::prefix(std::string_view text) {
  if (text.empty()) return;
  out_ += text;
  out_ += ' ';
}

void DeclarationPrinter::variable(const Variable& of) {
  prefix(of.prefix);
  printDeclarator(out_, of.type, of.name);
  out_ += of.suffix;
  initialiser(of);
  for (const Variable* also = of.also; also != nullptr; also = also->also) {
    out_ += ", ";
    out_ += also->name;
    initialiser(*also);
  }
  out_ += ';';
}

void DeclarationPrinter::initialiser(const Valued& of) {
  if (of.arguments != nullptr) expression(of.arguments);
  if (of.value == nullptr) return;
  out_ += " = ";
  expression(of.value);
}

void DeclarationPrinter::function(const Function& of) {
  signature(of);
  body(of);
}

void DeclarationPrinter::signature(const Function& of) {
  prefix(of.prefix);
  of.result.base.empty() ? void(out_ += of.name) : printDeclarator(out_, of.result, of.name);
  out_ += '(';
  for (const Decl* parameter = of.parameters.first(); parameter != nullptr; parameter = parameter->next) {
    if (parameter != of.parameters.first()) out_ += ", ";
    printDeclarator(out_, as<Variable>(*parameter).type, as<Variable>(*parameter).name);
  }
  out_ += ')';
  out_ += of.suffix;
}

void DeclarationPrinter::body(const Function& of) {
  std::string_view separator = " : ";
  for (const Function::Initialised& initialised : of.initialises) {
    out_ += separator;
    out_ += initialised.member;
    expression(initialised.arguments);
    separator = ", ";
  }
  switch (of.form) {
    case Function::Form::Prototype: out_ += ';'; return;
    case Function::Form::OneLine:
      out_ += ' ';
      if (of.body == nullptr)
        out_ += "{}";
      else
        StatementPrinter(out_, tree_, depth_ + 1).scope(of.body);
      return;
    case Function::Form::Lines: {
      out_ += " {";
      StatementPrinter statements(out_, tree_, depth_ + 1);
      statements.run(of.body);
      statements.run(of.exits);
      out_ += '\n';
      out_.append(indentOf(depth_), ' ');
      out_ += '}';
      return;
    }
  }
}

void DeclarationPrinter::record(const Record& of) {
  prefix(of.keyword);
  prefix(of.attributes);
  prefix(of.name);
  out_ += '{';
  if (of.is_line) {
    for (const Decl* member = of.members.first(); member != nullptr; member = member->next) {
      out_ += ' ';
      print(*member);
    }
    out_ += ' ';
  } else {
    out_ += '\n';
    if (of.has_access) {
      out_.append(indentOf(depth_), ' ');
      out_ += " public:\n";
    }
    DeclarationPrinter(out_, tree_, depth_ + 1).list(of.members.first());
    out_.append(indentOf(depth_), ' ');
  }
  out_ += '}';
  if (!of.variable.empty()) out_ += ' ';
  out_ += of.variable;
  initialiser(of);
  out_ += ';';
}

void DeclarationPrinter::enumeration(const Enumeration& of) {
  out_ += "enum ";
  out_ += of.name;
  out_ += " : ";
  out_ += of.base;
  out_ += " {";
  const auto between = [&](std::string_view line, uint32_t depth) {
    out_ += of.is_line ? std::string_view(" ") : line;
    if (!of.is_line) out_.append(indentOf(depth), ' ');
  };
  for (size_t i = 0; i < of.items.size(); ++i) {
    if (i > 0) out_ += ',';
    between("\n", depth_ + 1);
    out_ += of.items[i].name;
    out_ += " = ";
    expression(of.items[i].value);
  }
  if (!of.is_line && !of.items.empty()) out_ += ',';
  between("\n", depth_);
  out_ += "};";
}

void DeclarationPrinter::space(const Namespace& of) {
  out_ += "namespace ";
  prefix(of.name);
  prefix(of.attributes);
  out_ += "{\n";
  list(of.members.first());
  out_ += "\n}  // namespace";
  if (!of.name.empty()) out_ += ' ';
  out_ += of.name;
}

void print(std::string& out, const Tree& tree, const Declarations& declarations) {
  Sink sink(out);
  DeclarationPrinter(sink, tree).list(declarations.first());
}

void print(std::string& out, const Tree& tree, const Decl& decl) {
  Sink sink(out);
  DeclarationPrinter(sink, tree).print(decl);
}

void printSignature(std::string& out, const Function& function) {
  Sink sink(out);
  const Tree none;
  DeclarationPrinter(sink, none).signature(function);
}

void print(std::string& out, const Type& type, std::string_view name) {
  Sink sink(out);
  printDeclarator(sink, type, name);
}

std::string toString(const Type& type, std::string_view name) {
  std::string out;
  print(out, type, name);
  return out;
}

}  // namespace rung::codegen::cxx
