// SPDX-License-Identifier: Apache-2.0
// Counts every byte that the program takes. Include it in one source of a test program only: it
// replaces operator new.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

namespace aquarama::test {

inline std::atomic<std::size_t> bytesTaken = 0;

}  // namespace aquarama::test

void* operator new(std::size_t size) {
    aquarama::test::bytesTaken += size;
    if (void* memory = std::malloc(size)) return memory;
    throw std::bad_alloc();
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    aquarama::test::bytesTaken += size;
    return std::malloc(size);
}
void operator delete(void* memory) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}
