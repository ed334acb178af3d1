// SPDX-License-Identifier: Apache-2.0
// What the current context holds on the graphics card.
#pragma once

#include <optional>

namespace aquarama::bench {

struct CardMemory {
    double textureMebibytes = 0;  // by formats and sizes; what the driver adds is not in it
    double bufferMebibytes = 0;
};
[[nodiscard]] CardMemory cardMemory();

// Of all levels, by their formats and sizes; 0 for a buffer as a texture.
[[nodiscard]] double textureBytes(unsigned texture);

// What is free on the whole card, where the driver tells (NVX_gpu_memory_info).
[[nodiscard]] std::optional<double> freeMebibytes();

}  // namespace aquarama::bench
