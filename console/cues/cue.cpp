// SPDX-License-Identifier: Apache-2.0
#include "console/cues/cue.h"

#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include "common/base/characters.h"
#include "common/config/rules.h"
#include "common/wire/state_codec.h"

namespace aquarama::console {

namespace {

using osc::OscArgument;
using v1::WantedShow;

// Nothing where the argument is no text.
std::optional<std::string> textIn(const OscArgument& argument) {
    const auto* text = std::get_if<std::string>(&argument);
    return text == nullptr ? std::nullopt : std::optional(*text);
}

// Nothing where it is neither 0 nor 1.
std::optional<bool> switchIn(const OscArgument& argument) {
    const auto* whole = std::get_if<std::int64_t>(&argument);
    if (whole == nullptr || *whole < 0 || *whole > 1) return std::nullopt;
    return *whole == 1;
}

// From 0 to 1, also as a whole number: QLab sends "1" as such.
std::optional<double> shareIn(const OscArgument& argument) {
    if (const auto whole = switchIn(argument)) return *whole ? 1.0 : 0.0;
    const auto* number = std::get_if<double>(&argument);
    if (number == nullptr || !(*number >= 0 && *number <= 1)) return std::nullopt;
    return *number;
}

// By its name, or its number from 0 for low.
std::optional<WantedShow::Tier> tierIn(const OscArgument& argument) {
    constexpr std::int64_t kMostTier = 3;
    if (const auto name = textIn(argument)) {
        if (*name == "auto") return WantedShow::AUTO;
        const auto tier = config::tierNamed(*name);
        return tier ? std::optional(wire::tierOf(tier)) : std::nullopt;
    }
    const auto* whole = std::get_if<std::int64_t>(&argument);
    if (whole == nullptr || *whole < 0 || *whole > kMostTier) return std::nullopt;
    return wire::tierOf(config::tierAt(static_cast<std::uint32_t>(*whole)));
}

std::optional<WantedShow::Shown> patternIn(const OscArgument& argument) {
    const auto name = textIn(argument);
    const auto pattern = name ? wire::patternNamed(*name) : std::nullopt;
    return pattern ? std::optional(static_cast<WantedShow::Shown>(*pattern)) : std::nullopt;
}

std::optional<WantedShow::Day> dayIn(const OscArgument& argument) {
    const auto name = textIn(argument);
    return name ? wire::dayNamed(*name) : std::nullopt;
}

// Sets a value of the show; false where the argument is none.
template <auto read, auto set>
bool take(const OscArgument& argument, v1::Order& order) {
    const auto value = read(argument);
    if (value) (order.mutable_show()->*set)(*value);
    return value.has_value();
}

// A name as the master takes it: what is no UTF-8 would be no message to it.
std::optional<std::string> nameIn(const OscArgument& argument) {
    const auto name = textIn(argument);
    return name && legible(*name) == *name ? name : std::nullopt;
}

bool takeScene(const OscArgument& argument, v1::Order& order) {
    return take<nameIn, &WantedShow::set_scene<const std::string&>>(argument, order) &&
           config::keepsRules(order.show());
}

bool takeRelease(const OscArgument& argument, v1::Order& order) {
    const auto species = nameIn(argument);
    if (species) order.mutable_release()->set_species(*species);
    return species && config::keepsRules(order.release());
}

// What an address takes: its reader, and the argument in words.
struct Kind {
    bool (*take)(const OscArgument& argument, v1::Order& order);
    const char* wanted;
};

const std::map<std::string_view, Kind>& kinds() {
    static const std::map<std::string_view, Kind> kAll{
        {"/aquarama/scene", {takeScene, "the name of a scene, a text"}},
        {"/aquarama/day",
         {take<dayIn, &WantedShow::set_day>,
          "dawn, morning, noon, afternoon, sunset, dusk, night, first light or clock, a text"}},
        {"/aquarama/release", {takeRelease, "the name of a species, a text"}},
        {"/aquarama/quality",
         {take<tierIn, &WantedShow::set_quality>, "low, medium, high, ultra or auto, or 0 to 3"}},
        {"/aquarama/pattern", {take<patternIn, &WantedShow::set_pattern>, "world, grid or grey"}},
        {"/aquarama/black", {take<switchIn, &WantedShow::set_black>, "1 or 0, a whole number"}},
        {"/aquarama/freeze", {take<switchIn, &WantedShow::set_freeze>, "1 or 0, a whole number"}},
        {"/aquarama/guests", {take<switchIn, &WantedShow::set_guests>, "1 or 0, a whole number"}},
        {"/aquarama/drawings",
         {take<switchIn, &WantedShow::set_drawings>, "1 or 0, a whole number"}},
        {"/aquarama/brightness",
         {take<shareIn, &WantedShow::set_brightness>, "a number from 0 to 1"}},
        {"/aquarama/colour",
         {take<shareIn, &WantedShow::set_colour_returned>, "a number from 0 to 1"}}};
    return kAll;
}

}  // namespace

Cue cueOf(const osc::OscMessage& message) {
    const auto kind = kinds().find(message.address);
    if (kind == kinds().end())
        return {.problem = "there is no such address; docs/cues.md lists them"};
    Cue cue;
    const bool isOne = message.arguments.size() == 1;
    if (!isOne || !kind->second.take(message.arguments[0], cue.order))
        return {.problem = std::string("it takes one argument: ") + kind->second.wanted};
    return cue;
}

}  // namespace aquarama::console
