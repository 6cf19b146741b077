// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace dust::engine {

/// Sees to it that the program's memory is asked for in pages of 2 MB (decision 0022): where Linux
/// gives them to those who ask, and the C library can ask only when a program begins, the program
/// begins again, in the same process. Returns where that is not so, not possible or done already.
/// `GLIBC_TUNABLES=glibc.malloc.hugetlb=0` keeps small pages.
void ask_for_huge_pages(char** argv);

}  // namespace dust::engine
