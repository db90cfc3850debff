// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

namespace encase {

/// Whether work can be spread over threads: with oneTBB at build time.
bool has_threads();

/// Calls work(0), ..., work(count - 1), each once, on at most `threads` threads; the caller's is
/// one of them. Returns when all have returned. In what order they run and where is not defined:
/// what one does must not depend on another, and results go where the index says. Then the outcome
/// is the same for any number of threads.
///
/// An exception out of `work` ends the loop: calls that have begun are waited for, others are not
/// made, and one of the exceptions that were thrown is thrown on. To cancel, let `work` return
/// early.
///
/// Others than the caller's thread are woken only for what is left after a millisecond. Without
/// oneTBB, and for threads <= 1, all runs on the caller's, in order.
void parallel_for(int count, int threads, const std::function<void(int index)>& work);

}  // namespace encase
