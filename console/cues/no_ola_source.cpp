// SPDX-License-Identifier: Apache-2.0
// Where OLA's client library is not installed; else ola_source.cpp is built.
#include "common/base/log.h"
#include "console/cues/dmx_source.h"

namespace aquarama::console {

std::unique_ptr<DmxSource> openUniverse(std::uint32_t /*universe*/) {
    throw Error("this console was built without OLA; install libola-dev, and build it again");
}

}  // namespace aquarama::console
