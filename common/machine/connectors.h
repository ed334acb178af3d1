// SPDX-License-Identifier: Apache-2.0
// The connectors of this machine's graphics cards, read from the kernel without a display.
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

// The self-description of a monitor (EDID). Missing values are empty or 0.
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

// The connectors with a monitor, sorted by name; empty where the kernel lists none. Tests pass a
// `folder` of their own.
[[nodiscard]] std::vector<Connector> connectedMonitors(
    const std::filesystem::path& folder = "/sys/class/drm");

// The names as a list, "HDMI-1, eDP-1", or a text that says that there are none.
[[nodiscard]] std::string namesOf(const std::vector<Connector>& connectors);

// The name that X uses: the kernel's "HDMI-A-1" is X's "HDMI-1". Other names stay.
[[nodiscard]] std::string connectorName(std::string_view name);

// Whether the connector has a built-in panel, as in a laptop.
[[nodiscard]] bool isBuiltIn(std::string_view connector);

// Parses the first block of an EDID; empty where the bytes are not an EDID.
[[nodiscard]] std::optional<MonitorFacts> factsIn(std::span<const std::byte> edid);

}  // namespace aquarama::machine
