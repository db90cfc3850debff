// SPDX-License-Identifier: MIT
#pragma once

/// Compiles a function for several instruction sets and picks one at run time. Only for plain
/// loops: every clone does the same IEEE operations (contraction is off), so all give the same
/// bits.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__)
#define ENCASE_VECTORIZED __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define ENCASE_VECTORIZED
#endif
