// SPDX-License-Identifier: Apache-2.0
#include "render_node/session/machine.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <system_error>

#include <unistd.h>

#include "common/base/characters.h"
#include "common/base/log.h"
#include "common/machine/machine_power.h"
#include "common/net/clock.h"

namespace aquarama::session {
namespace {

std::string hostName() {
    std::array<char, 65> name{};
    gethostname(name.data(), name.size() - 1);
    return name.data();
}

// Of the hottest graphics card whose driver tells the kernel, degrees Celsius; 0: none does.
float gpuCelsius() {
    namespace fs = std::filesystem;
    float hottest = 0;
    std::error_code none;
    for (const fs::directory_entry& card : fs::directory_iterator("/sys/class/drm", none)) {
        const fs::path sensors = card.path() / "device" / "hwmon";
        for (const fs::directory_entry& sensor : fs::directory_iterator(sensors, none)) {
            std::ifstream file(sensor.path() / "temp1_input");
            float thousandths = 0;
            if (file >> thousandths) hottest = std::max(hottest, thousandths / 1000);
        }
    }
    return hottest;
}

}  // namespace

void reportMachine(const NodeFacts& facts, v1::NodeReport& report) {
    report.set_host(printable(hostName(), wire::kMostReportBytes));
    report.set_build(facts.build);
    report.set_renderer(printable(facts.renderer, wire::kMostReportBytes));
    for (const std::string& monitor : facts.monitors)
        report.add_monitors(printable(monitor, wire::kMostReportBytes));
    report.set_clock_synchronised(net::isClockSynchronised());
    report.set_takes_power_word(machine::takesPowerWord(machine::powerFolder()));
    if (const float celsius = gpuCelsius(); celsius > 0) report.set_gpu_celsius(celsius);
}

v1::Envelope switchMachine(const v1::Order& order) {
    const std::string word = order.power().word() == v1::Power::POWEROFF ? "poweroff" : "reboot";
    v1::Envelope message;
    v1::OrderReply& reply = *message.mutable_order_reply();
    reply.set_request(order.request());
    reply.set_outcome(v1::OrderReply::DONE);
    try {
        machine::sayPower(machine::powerFolder(), word);
        logInfo("the master orders {} of this machine", word);
    } catch (const Error& problem) {
        logWarning("the master orders {}, which is refused: {}", word, problem.what());
        reply.set_outcome(v1::OrderReply::REFUSED);
        reply.set_reason(printable(problem.what()));
    }
    return message;
}

std::string printable(std::string text, std::size_t mostBytes) {
    std::ranges::replace_if(
        text, [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; }, ' ');
    return legible(text, mostBytes);
}

}  // namespace aquarama::session
