// SPDX-License-Identifier: Apache-2.0
// A function that the C++ library has since GCC 11, for products that link the host of a package with an older one,
// such as that of Debian 11. Where the library has it, its own is the same.
#include <new>

namespace std {

void __throw_bad_array_new_length() __attribute__((__noreturn__, __weak__));
void __throw_bad_array_new_length() { throw bad_array_new_length(); }

}  // namespace std
