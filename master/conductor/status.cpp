// SPDX-License-Identifier: Apache-2.0
#include "master/conductor/status.h"

#include <chrono>

#include <spdlog/fmt/fmt.h>

#include "common/net/channels.h"
#include "common/units/error.h"

namespace aquarama {
namespace {

constexpr Instant kPatience = std::chrono::seconds(2);
constexpr Instant kRepeat = std::chrono::milliseconds(50);

const char* wordFor(NodeCondition condition) {
    switch (condition) {
        case NodeCondition::Absent:
            return "absent";
        case NodeCondition::Preparing:
            return "preparing";
        case NodeCondition::InStep:
            return "in step";
        case NodeCondition::Late:
            break;
    }
    return "late";
}

}  // namespace

std::string statusText(const StatusReply& status) {
    std::string text = fmt::format("{}{}   frame {}   tick {}\n",
                                   status.pace == Pace::Live ? "live" : "lockstep",
                                   status.paused ? ", paused" : "",
                                   status.frame.value,
                                   status.tick.value);
    text += fmt::format("frame time    median {:8.2f} ms   p99 {:8.2f} ms\n",
                        status.frameMedianMs,
                        status.frameP99Ms);
    text += fmt::format("release skew  median {:8.3f} ms   p99 {:8.3f} ms\n",
                        status.skewMedianMs,
                        status.skewP99Ms);
    text += fmt::format("refused packets {}\n\n", status.refusedPackets);
    text += fmt::format("{:<16} {:<10} {:>8} {:>8}\n", "node", "state", "late", "dropped");
    for (const NodeStatus& node : status.nodes) {
        text += fmt::format("{:<16} {:<10} {:>8} {:>8}\n",
                            node.name,
                            wordFor(node.condition),
                            node.late,
                            node.dropped);
    }
    return text;
}

std::string runStatus(const std::string& controlAddress) {
    const auto channels = connectNode(controlAddress);
    const Instant giveUp = monotonicNow() + kPatience;
    while (monotonicNow() < giveUp) {
        channels->sendControl(encode({0, StatusRequest{}}));  // the connection may not stand yet
        while (const auto bytes = channels->receiveControl()) {
            const auto envelope = decode(*bytes);
            if (!envelope) continue;
            if (const auto* reply = std::get_if<StatusReply>(&envelope->message)) {
                return statusText(*reply);
            }
        }
        channels->wait(kRepeat);
    }
    throw Error("no master answers at " + controlAddress +
                "; start one, or name its control address with --master");
}

}  // namespace aquarama
