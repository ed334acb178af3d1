// SPDX-License-Identifier: Apache-2.0
// A universe of DMX, as olad of this machine hears it by Art-Net, sACN or a USB adapter.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace aquarama::console {

// Channel 1 first, each 0 to 255; up to 512 of them.
using DmxFrame = std::vector<std::uint8_t>;

// Never waits. One thread uses it.
class DmxSource {
  public:
    virtual ~DmxSource() = default;
    // The last frame that has come since the call before; nothing where none has. Throws Error
    // where olad is gone.
    [[nodiscard]] virtual std::optional<DmxFrame> hear() = 0;
};

// A universe of olad's, by its number there. Throws Error where olad does not answer, or this
// program was built without OLA.
[[nodiscard]] std::unique_ptr<DmxSource> openUniverse(std::uint32_t universe);

}  // namespace aquarama::console
