// SPDX-License-Identifier: MIT
#pragma once

/// How often operator new has been called in this program: tests that link
/// common/counted_allocations.cpp may ask.
long counted_allocations();
