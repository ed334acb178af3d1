// SPDX-License-Identifier: Apache-2.0
// A process gives up all rights but those that reading a picture needs. The only place that knows
// libseccomp.
#pragma once

namespace aquarama::drawings {

// A build under a sanitizer is not confined, as sanitizers ask the kernel for much.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kIsSanitized = true;
#else
inline constexpr bool kIsSanitized = false;
#endif

// From now on this process may read standard input, write standard output, take memory and end;
// whatever else it asks of the kernel kills it. It has 1.5 GB of addresses and 20 s of processor
// time, and leaves no core. A process of one thread calls it, once all files are read. Throws Error
// where the kernel cannot do it.
void confine();

}  // namespace aquarama::drawings
