// SPDX-License-Identifier: Apache-2.0
#pragma once

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(DUST_NO_CLONES)
#define DUST_HAS_CLONES 1
#else
#define DUST_HAS_CLONES 0
#endif

/// The hot function of a kernel, compiled for several instruction sets, chosen when it is loaded.
/// With -ffp-contract=off all give the same bits.
#if DUST_HAS_CLONES
#define DUST_KERNEL __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define DUST_KERNEL
#endif
