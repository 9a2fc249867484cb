// SPDX-License-Identifier: Apache-2.0
// What a body in C++ sees of its program: types of its variables, objects of blocks, functions. In: types, and bodies
// that it may call. Out: definitions (cxx/nodes.h), made where they are needed first. Called by cpp_bodies.cpp, whose
// head lists the kinds of names. The types are in cpp_views.cpp, objects in cpp_objects.cpp, functions in
// cpp_calls.cpp.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "codegen/cxx/nodes.h"
#include "codegen/facts.h"
#include "codegen/group.h"

namespace rung::codegen {

class CppFacade {
 public:
  using Ex = cxx::Ex;
  CppFacade(const ir::Module& module, const Facts& facts, ir::BodyId body, Group& group, cxx::Tree& tree)
      : module_(module), types_(module.types), facts_(facts), body_(body), group_(group), tree_(tree) {}

  const cxx::Declarations& definitions() const { return definitions_; }

  // ---- types
  void need(TypeId type);  // the file needs the definition of its record
  bool isString(TypeId type) const;
  bool isBlock(TypeId type) const;
  bool holdsBlock(TypeId type) const;  // such a type needs an object, which knows its context
  std::string view(TypeId type);       // the C++ type that the body uses; empty: not accessible from C++
  std::string located(TypeId type);    // of a located variable: its bytes lie at any address
  std::string named(TypeId type);      // defines the type, unless already known, and returns its name
  Ex viewOf(const std::string& seen, Ex place) { return tree_.call("rung::cpp::view<" + seen + ">", {place}); }
  Ex bitsOf(const std::string& type, Ex value) { return tree_.call("rung::cpp::bits<" + type + ">", {value}); }

  // ---- objects
  // The objects of a variable: `OBJECT name`, or for an array `struct { OBJECT table[2][3]; } name`; and the arguments
  // of their constructors. No declaration: there are too many.
  struct Objects {
    cxx::Valued* declaration = nullptr;
    Ex arguments = nullptr;
    bool is_one = true;
  };
  Objects objectsOf(std::string_view name, TypeId type, Ex place);
  // The fields of a block and of those that it extends, each with its lvalue.
  using FieldPlaces = std::vector<std::pair<const types::Field*, Ex>>;
  void fieldsOf(TypeId type, Ex place, FieldPlaces& out);

  // ---- functions
  // Defines the object of a function or method. Its variable; null: it cannot be called from C++.
  cxx::Variable* functionObject(ir::BodyId id);
  std::string ownName(const ir::Body& method) const;  // as declared: methods and actions are members like pins

 private:
  std::string_view string(NameId name) const { return module_.names.string(name); }
  const types::TypeInfo& info(TypeId type) const { return types_.info(types_.resolve(type)); }
  std::string arrayOf(const std::string& element, const types::TypeInfo& array) const;
  std::string locatedStructure(TypeId type, const std::string& seen);
  void define(cxx::Decl* definition);
  cxx::Record* alias(std::string_view name);  // a structure that may alias the memory of another type
  cxx::Variable* bytes(std::string_view prefix, const std::string& name, uint64_t count);
  cxx::Record* enumeration(TypeId type, const std::string& name);
  void structure(TypeId type, const std::string& name);

  struct ObjectParts;
  cxx::Record* object(TypeId type, const std::string& name);
  void addInOut(const types::Field& field, Ex place, ObjectParts& to);
  void addPin(const types::Field& field, Ex place, ObjectParts& to);
  cxx::Function* bodyOf(TypeId type, const ObjectParts& parts);
  void addMethods(TypeId type, cxx::Declarations& to);

  struct Call;
  Call callOf(ir::BodyId id, Ex self);
  cxx::Function* conditional(const Call& call, bool has_result);
  bool addParameters(const ir::Body& function, Call& call);
  Ex placeOfBase(Ex place, TypeId from, TypeId to);
  Ex pointer(TypeId type, Ex address, bool constant);
  cxx::Function* member(std::string_view result, std::string_view name);
  cxx::Stmt* line(cxx::Stmt* stmt) const;
  cxx::Stmt* assign(Ex to, Ex value);

  const ir::Module& module_;
  const types::TypeTable& types_;
  const Facts& facts_;
  ir::BodyId body_;
  Group& group_;
  cxx::Tree& tree_;
  cxx::Declarations definitions_;
  std::vector<std::pair<TypeId, std::string>> named_;
  std::vector<TypeId> located_;
};

}  // namespace rung::codegen
