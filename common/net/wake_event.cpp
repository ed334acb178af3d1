// SPDX-License-Identifier: Apache-2.0
#include "common/net/wake_event.h"

#include <cstdint>

#include <sys/eventfd.h>
#include <unistd.h>

#include "common/units/log.h"

namespace aquarama::net {

WakeEvent::WakeEvent() : descriptor_(eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
    if (descriptor_ < 0) {
        throw Error("no file descriptor left for a network thread; raise the limit (ulimit -n)");
    }
}

WakeEvent::~WakeEvent() {
    close(descriptor_);
}

// A full counter cannot be raised further and an empty one not be read: both mean what is wanted.
void WakeEvent::set() const {
    const std::uint64_t one = 1;
    [[maybe_unused]] const auto written = write(descriptor_, &one, sizeof one);
}

void WakeEvent::clear() const {
    std::uint64_t count = 0;
    [[maybe_unused]] const auto taken = read(descriptor_, &count, sizeof count);
}

}  // namespace aquarama::net
