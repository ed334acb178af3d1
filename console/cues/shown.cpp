// SPDX-License-Identifier: Apache-2.0
#include "console/cues/shown.h"

#include <algorithm>

#include "common/wire/wanted_show.h"

namespace aquarama::console {

namespace {

std::int64_t nodesThat(const v1::StatusReply& status, bool (*are)(v1::NodeCondition)) {
    return std::ranges::count_if(status.nodes(), are, &v1::NodeStatus::condition);
}

}  // namespace

std::vector<ShownValue> shownBy(const v1::StatusReply& status,
                                bool isHeard,
                                const DrawingCounts& drawings) {
    using C = v1::NodeCondition;
    const wire::Show show = wire::readShow(status.show()).value_or(wire::Show{});
    return {{"running", std::int64_t{isHeard}},
            {"scene", show.scene},
            {"quality", std::string(config::nameOf(show.quality))},
            {"pattern", std::string(wire::nameOf(show.pattern))},
            {"black", std::int64_t{show.black}},
            {"freeze", std::int64_t{show.frozen}},
            {"brightness", double{show.brightness}},
            {"colour", double{show.colourReturned}},
            {"guests", std::int64_t{status.guests()}},
            {"drawings", std::int64_t{status.drawings()}},
            {"day", wire::dayName(status.has_day() ? status.day() : v1::WantedShow::CLOCK)},
            {"drawings_waiting", std::int64_t{drawings.waiting}},
            {"drawings_swimming", std::int64_t{drawings.swimming}},
            {"frame", static_cast<std::int64_t>(status.frame())},
            {"nodes_in_step", nodesThat(status, [](C is) { return is == v1::NODE_IN_STEP; })},
            {"nodes_late", nodesThat(status, [](C is) { return is == v1::NODE_LATE; })},
            {"nodes_absent", nodesThat(status, [](C is) {
                 return is != v1::NODE_IN_STEP && is != v1::NODE_LATE;
             })}};
}

}  // namespace aquarama::console
