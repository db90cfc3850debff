// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <memory_resource>
#include <new>

namespace encase {

/// Memory for arrays of all sizes that come and go: what was given back serves the next array of
/// about the same size, and everything is freed together at the end. As quick as a monotonic
/// buffer, without its growth. Not shared between threads.
class RecycledMemory : public std::pmr::memory_resource {
 private:
  struct Free {
    Free* next;
  };

  void* do_allocate(std::size_t bytes, std::size_t alignment) override {
    if (alignment > kAlignment) throw std::bad_alloc();
    const std::size_t size = class_of(bytes);
    Free*& first = free_[size];
    if (!first) return memory_.allocate(std::size_t{1} << size, kAlignment);
    Free* taken = first;
    first = taken->next;
    return taken;
  }
  void do_deallocate(void* memory, std::size_t bytes, std::size_t) override {
    Free*& first = free_[class_of(bytes)];
    first = new (memory) Free{first};
  }
  bool do_is_equal(const std::pmr::memory_resource& other) const noexcept override {
    return this == &other;
  }

  /// The power of two that holds so many bytes, and a pointer.
  static std::size_t class_of(std::size_t bytes) {
    return static_cast<std::size_t>(std::bit_width((bytes < kLeast ? kLeast : bytes) - 1));
  }

  static constexpr std::size_t kAlignment = alignof(std::max_align_t);
  static constexpr std::size_t kLeast = 16;

  std::pmr::monotonic_buffer_resource memory_;
  std::array<Free*, 64> free_{};
};

}  // namespace encase
