// SPDX-License-Identifier: Apache-2.0
// The connectors of this machine's graphics cards, as its kernel tells of them without a display.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>

namespace aquarama::machine {

// What a monitor says of itself (EDID); what it does not say is empty or 0.
struct MonitorFacts {
    std::string product;      // "LG TV"
    glm::ivec2 sizePixels{};  // of the mode that it prefers
    double refreshHertz = 0;  // of that
    glm::dvec2 sizeMetres{};  // of its picture
};

// A connector with a monitor.
struct Connector {
    std::string name;  // as X has it: "HDMI-1"
    MonitorFacts monitor;
};

// Those that have a monitor, by name; none where the kernel tells of none. `folder` is other than
// the kernel's in tests.
[[nodiscard]] std::vector<Connector> connectedMonitors(
    const std::filesystem::path& folder = "/sys/class/drm");

// "HDMI-1, eDP-1", or that there are none.
[[nodiscard]] std::string namesOf(const std::vector<Connector>& connectors);

// As X names it: the kernel's "HDMI-A-1" is X's "HDMI-1". What is neither stays.
[[nodiscard]] std::string connectorName(std::string_view name);

// Whether it is a panel that is part of the machine, as that of a laptop.
[[nodiscard]] bool isBuiltIn(std::string_view connector);

// Of the first block of an EDID; nothing where it is none.
[[nodiscard]] std::optional<MonitorFacts> factsIn(std::span<const std::byte> edid);

}  // namespace aquarama::machine
