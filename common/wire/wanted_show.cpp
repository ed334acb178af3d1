// SPDX-License-Identifier: Apache-2.0
#include "common/wire/wanted_show.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <span>
#include <string_view>

#include <fmt/format.h>
#include <google/protobuf/text_format.h>

#include "common/base/files.h"
#include "common/config/text_reader.h"
#include "common/wire/state_codec.h"

namespace aquarama::wire {

namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kWantedShowVersion = 1;

// Tiers follow AUTO, in their order; patterns are numbered as in aquarama.proto.
static_assert(v1::WantedShow::LOW - v1::WantedShow::AUTO == 1);
static_assert(int{v1::WantedShow::GREY} == static_cast<int>(Pattern::Grey));

std::string_view onOff(bool isOn) {
    return isOn ? "on" : "off";
}

void add(std::string& text, std::string_view what, std::string_view value) {
    if (!text.empty()) text += ", ";
    text.append(what).append(" ").append(value);
}

fs::path keptOf(const std::string& rigPath, const char* ending) {
    return userFolder("XDG_STATE_HOME", ".local/state") / "shows" /
           (fs::path(rigPath).stem().string() + ending);
}

}  // namespace

v1::WantedShow::Tier tierOf(const std::optional<config::QualityTier>& quality) {
    if (!quality) return v1::WantedShow::AUTO;
    return static_cast<v1::WantedShow::Tier>(v1::WantedShow::LOW + static_cast<int>(*quality));
}

std::optional<config::QualityTier> tierIn(const v1::WantedShow& show) {
    if (show.quality() < v1::WantedShow::LOW) return std::nullopt;
    return config::tierAt(static_cast<std::uint32_t>(show.quality() - v1::WantedShow::LOW));
}

// As the enum has it, in small letters and with spaces.
std::string dayName(v1::WantedShow::Day day) {
    std::string name = v1::WantedShow::Day_Name(day);
    std::ranges::transform(name, name.begin(), [](char letter) {
        return letter == '_' ? ' ' : static_cast<char>(std::tolower(letter));
    });
    return name;
}

std::optional<v1::WantedShow::Day> dayNamed(const std::string& name) {
    for (int number = v1::WantedShow::CLOCK; number <= v1::WantedShow::Day_MAX; ++number) {
        const auto day = static_cast<v1::WantedShow::Day>(number);
        if (dayName(day) == name) return day;
    }
    return std::nullopt;
}

void apply(v1::WantedShow& show, const v1::WantedShow& change) {
    if (change.has_scene()) show.clear_colour_returned();
    show.MergeFrom(change);
}

bool areSame(const v1::WantedShow& one, const v1::WantedShow& other) {
    return one.SerializeAsString() == other.SerializeAsString();
}

bool isOfFader(const v1::WantedShow& show) {
    v1::WantedShow others = show;
    others.clear_brightness();
    others.clear_colour_returned();
    return others.ByteSizeLong() == 0;
}

std::string textOf(const v1::WantedShow& show) {
    std::string text;
    if (show.has_scene()) add(text, "scene", show.scene());
    if (show.has_quality()) {
        const auto tier = tierIn(show);
        add(text, "quality", tier ? config::nameOf(*tier) : "auto");
    }
    if (show.has_pattern()) add(text, "pattern", nameOf(static_cast<Pattern>(show.pattern())));
    if (show.has_black()) add(text, "black", onOff(show.black()));
    if (show.has_freeze()) add(text, "freeze", onOff(show.freeze()));
    if (show.has_colour_returned())
        add(text, "colour", fmt::format("{:.2f}", show.colour_returned()));
    if (show.has_guests()) add(text, "guests", onOff(show.guests()));
    if (show.has_drawings()) add(text, "drawings", onOff(show.drawings()));
    if (show.has_brightness()) add(text, "brightness", fmt::format("{:.2f}", show.brightness()));
    if (show.has_day()) add(text, "day", dayName(show.day()));
    return text;
}

fs::path keptShowOf(const std::string& rigPath) {
    return keptOf(rigPath, ".txtpb");
}

fs::path drawingsOf(const std::string& rigPath) {
    return keptOf(rigPath, ".drawings");
}

fs::path journalOf(const std::string& rigPath) {
    return keptOf(rigPath, ".journal");
}

v1::WantedShow readKeptShow(const fs::path& path) {
    if (!fs::exists(path)) return {};
    return parseKeptShow(config::readTextFile(path.string()), path.string());
}

v1::WantedShow parseKeptShow(const std::string& text, const std::string& source) {
    v1::WantedShow kept;
    config::TextReader file(text, source, kept);
    file.check();
    kept.clear_version();
    return kept;
}

void keepShow(const fs::path& path, const v1::WantedShow& kept) {
    v1::WantedShow out = kept;
    out.set_version(kWantedShowVersion);
    std::string text;
    google::protobuf::TextFormat::PrintToString(out, &text);
    text = "# What the wall was last told to show (aquarama set).\n" + text;
    writeWhole(path, std::as_bytes(std::span{text}));
}

}  // namespace aquarama::wire
