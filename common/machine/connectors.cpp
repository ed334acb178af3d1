// SPDX-License-Identifier: Apache-2.0
#include "common/machine/connectors.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>

namespace aquarama::machine {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kBlockBytes = 128;
constexpr std::size_t kFirstDescriptor = 54;
constexpr std::size_t kDescriptorBytes = 18;
constexpr std::size_t kDescriptors = 4;

// The whole file; empty where it cannot be read.
std::string contentOf(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

// The first line of `text`, without its end.
std::string firstLine(const std::string& text) {
    return text.substr(0, text.find('\n'));
}

// A descriptor of an EDID, read byte by byte.
class Descriptor {
  public:
    explicit Descriptor(std::span<const std::byte> bytes) : bytes_{bytes} {}

    [[nodiscard]] int at(std::size_t index) const { return std::to_integer<int>(bytes_[index]); }
    // Eight low bits, and four high ones of another byte, moved down by `shift`.
    [[nodiscard]] int twelve(std::size_t low, std::size_t high, int shift) const {
        return at(low) | (((at(high) >> shift) & 0xF) << 8);
    }
    // Clock of the pixels; 0: the descriptor is a text, not a timing.
    [[nodiscard]] int clockHertz() const { return 10'000 * (at(0) | (at(1) << 8)); }
    // The text of a descriptor: at most 13 characters, ended by a line feed.
    [[nodiscard]] std::string text() const {
        std::string text;
        for (std::size_t i = 5; i < kDescriptorBytes && at(i) != '\n'; ++i)
            text += at(i) >= 0x20 && at(i) < 0x7F ? static_cast<char>(at(i)) : ' ';
        return text;
    }

  private:
    std::span<const std::byte> bytes_;
};

// The first timing is the preferred one.
void takeTiming(const Descriptor& timing, MonitorFacts& facts) {
    facts.sizePixels = {timing.twelve(2, 4, 4), timing.twelve(5, 7, 4)};
    const glm::ivec2 total =
        facts.sizePixels + glm::ivec2(timing.twelve(3, 4, 0), timing.twelve(6, 7, 0));
    if (total.x * total.y > 0)
        facts.refreshHertz = static_cast<double>(timing.clockHertz()) / (total.x * total.y);
    facts.sizeMetres = glm::dvec2(timing.twelve(12, 14, 4), timing.twelve(13, 14, 0)) / 1000.0;
}

// Reads a descriptor of any kind.
void takeDescriptor(const Descriptor& descriptor, MonitorFacts& facts) {
    constexpr int kName = 0xFC;
    const bool isTiming = descriptor.clockHertz() > 0;
    if (isTiming && facts.sizePixels.x == 0) takeTiming(descriptor, facts);
    if (!isTiming && descriptor.at(3) == kName) facts.product = descriptor.text();
}

bool isEdid(std::span<const std::byte> bytes) {
    constexpr std::array<std::uint8_t, 8> kBegin{0, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0};
    const auto isSame = [](std::uint8_t a, std::byte b) { return std::byte{a} == b; };
    return bytes.size() >= kBlockBytes &&
           std::equal(kBegin.begin(), kBegin.end(), bytes.begin(), isSame);
}

// Without an EDID the kernel still has modes, the preferred one first: "1920x1080".
MonitorFacts factsOfModes(const fs::path& connector) {
    MonitorFacts facts;
    const std::string mode = firstLine(contentOf(connector / "modes"));
    glm::ivec2 size{};
    if (std::sscanf(mode.c_str(), "%dx%d", &size.x, &size.y) == 2)  // NOLINT(cert-err34-c)
        facts.sizePixels = size;
    return facts;
}

}  // namespace

std::string connectorName(std::string_view name) {
    constexpr std::string_view kKernels = "HDMI-A-";
    if (!name.starts_with(kKernels)) return std::string(name);
    return "HDMI-" + std::string(name.substr(kKernels.size()));
}

bool isBuiltIn(std::string_view connector) {
    constexpr std::array<std::string_view, 3> kPanels{"eDP", "LVDS", "DSI"};
    return std::ranges::any_of(kPanels, [&](auto panel) { return connector.starts_with(panel); });
}

std::optional<MonitorFacts> factsIn(std::span<const std::byte> edid) {
    if (!isEdid(edid)) return std::nullopt;
    MonitorFacts facts;
    for (std::size_t i = 0; i < kDescriptors; ++i)
        takeDescriptor(
            Descriptor(edid.subspan(kFirstDescriptor + i * kDescriptorBytes, kDescriptorBytes)),
            facts);
    return facts;
}

std::vector<Connector> connectedMonitors(const fs::path& folder) {
    std::vector<Connector> connectors;
    std::error_code none;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, none)) {
        // "card0-HDMI-A-1"
        const std::string name = entry.path().filename().string();
        const std::size_t card = name.find('-');
        if (card == std::string::npos) continue;
        if (firstLine(contentOf(entry.path() / "status")) != "connected") continue;
        const std::string edid = contentOf(entry.path() / "edid");
        auto facts = factsIn(std::as_bytes(std::span(edid)));
        connectors.push_back({connectorName(std::string_view(name).substr(card + 1)),
                              facts ? std::move(*facts) : factsOfModes(entry.path())});
    }
    std::ranges::sort(connectors, {}, &Connector::name);
    return connectors;
}

std::string namesOf(const std::vector<Connector>& connectors) {
    std::string names;
    for (const Connector& connector : connectors)
        names += (names.empty() ? "" : ", ") + connector.name;
    return names.empty() ? "no monitor" : names;
}

}  // namespace aquarama::machine
