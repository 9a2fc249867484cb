// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/pragma_words.h"

namespace rung::ide {
namespace {

constexpr PragmaWord kPragmas[] = {
    {"attribute ''", false, "An attribute of the declaration that follows."},
    {"test", false, "The POU that follows is a test."},
    {"test_only", false, "Only tests use the POU that follows."},
    {"skip ''", false, "The test that follows is left out, for this reason."},
    {"case ", false, "Runs the test that follows once with these inputs: `{case a := 1, b := 2}`."},
    {"setup", false, "The POU that follows runs before each test of the file."},
    {"teardown", false, "The POU that follows runs after each test of the file."},
    {"mock ''", false, "The test that follows uses this replacement."},
    {"replaces ''", false, "The POU that follows takes the place of another one in tests that name it by `{mock}`."},
    {"required", false, "Every call must connect the pin."},
    {"alias ''", false, "Another name of the pin."},
    {"region ''", false, "Begins a part of the source that editors fold."},
    {"endregion", false, "Ends such a part."},
    {"warning disable ", false, "No such warnings from here on: codes or names."},
    {"warning restore ", false, "Such warnings again."},
    {"IF ", false, "The source up to `{END_IF}` is read only under this condition."},
    {"ELSIF ", false, "Another condition of `{IF}`."},
    {"ELSE", false, "What is read when no condition holds."},
    {"END_IF", false, "Ends `{IF}`."},
    {"define ", false, "A name for conditions, up to the end of the file."},
    {"undefine ", false, "Removes such a name."},
    {"info ''", false, "A message."},
    {"error ''", false, "A message that stops the build."},
    {"safe_values", false, "The function that follows sets the outputs when the program stops."},
    {"before_task", false, "Each activation calls the method that follows for every instance, before its programs."},
    {"after_task", false, "Each activation calls the method that follows for every instance, after its programs."},
    {"qualified_only", true, "Names must be qualified with the name of the list or type."},
    {"strict", true,
     "No arithmetic with the enumeration; only its items, or constants with their numbers, are assigned."},
    {"to_string", true, "TO_STRING gives the name of the item instead of its number."},
    {"call_after_init", true, "The method is called when an instance is initialised."},
    {"no_virtual_actions", true, "A derived block does not replace the actions of the block."},
    {"pack_mode", true, "Members are aligned to so many bytes at most.", "0 1 2 4 8"},
    {"symbol", true, "What tools outside may do with the variable.", "none read write readwrite"},
    {"global_init_slot", true, "Lists and programs are initialised by ascending slots."},
    {"call_after_global_init_slot", true,
     "Called once when all variables have their initial values, by ascending slots."},
    {"no-exit", true, "FB_Exit of the instance is not called."},
    {"initialize_on_call", true, "Each call begins with the initial values of the marked inputs that it leaves open."},
    {"reflection", true, "Marked variables of the block tell which inputs a call gives a value."},
    {"is_connected", true, "TRUE if the call gives this input a value."},
    {"obsolete", true, "Each use is a warning with this text."},
    {"instance-path", true, "The initial value of the string is the path of its instance."},
    {"no_check", true, "The body is not checked by the implicit checks of the project."},
    {"no_final_scan", true, "Actions of the chart have no final scan."},
};

}  // namespace

std::span<const PragmaWord> pragmaWords() { return kPragmas; }

}  // namespace rung::ide
