// SPDX-License-Identifier: Apache-2.0
#include "common/wire/show_file.h"

#include <span>
#include <string_view>

#include <google/protobuf/text_format.h>

#include "common/base/files.h"
#include "common/config/keys.pb.h"
#include "common/config/text_reader.h"

namespace aquarama::wire {

WantedShow with(WantedShow wanted, const ShowChange& change) {
    wanted.scene = change.scene.value_or(wanted.scene);
    wanted.quality = change.quality.value_or(wanted.quality);
    wanted.pattern = change.pattern.value_or(wanted.pattern);
    wanted.black = change.black.value_or(wanted.black);
    wanted.freeze = change.freeze.value_or(wanted.freeze);
    return wanted;
}

namespace {

void add(std::string& text, std::string_view what, const std::optional<std::string_view>& value) {
    if (!value) return;
    if (!text.empty()) text += ", ";
    text += std::string(what) + " " + std::string(*value);
}

std::optional<std::string_view> onOff(const std::optional<bool>& on) {
    return on ? std::optional(std::string_view(*on ? "on" : "off")) : std::nullopt;
}

}  // namespace

std::string textOf(const ShowChange& change) {
    std::string text;
    add(text, "scene", change.scene);
    if (change.quality)
        add(text, "quality", *change.quality ? config::nameOf(**change.quality) : "auto");
    if (change.pattern) add(text, "pattern", nameOf(*change.pattern));
    add(text, "black", onOff(change.black));
    add(text, "freeze", onOff(change.freeze));
    return text;
}

namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kVersion = 1;

// Tiers follow AUTO, in their order; patterns are numbered as in aquarama.proto.
static_assert(v1::WantedShow::LOW - v1::WantedShow::AUTO == 1);
static_assert(int{v1::WantedShow::GREY} == static_cast<int>(Pattern::Grey));

}  // namespace

v1::WantedShow::Tier tierOf(const std::optional<config::QualityTier>& quality) {
    if (!quality) return v1::WantedShow::AUTO;
    return static_cast<v1::WantedShow::Tier>(v1::WantedShow::LOW + static_cast<int>(*quality));
}

ShowChange changeIn(const v1::WantedShow& message) {
    ShowChange change;
    if (message.has_scene()) change.scene = message.scene();
    if (message.has_quality())  // AUTO is no tier
        change.quality = message.quality() == v1::WantedShow::AUTO
                             ? std::nullopt
                             : config::tierAt(static_cast<std::uint32_t>(message.quality() -
                                                                         v1::WantedShow::LOW));
    if (message.has_pattern()) change.pattern = static_cast<Pattern>(message.pattern());
    if (message.has_black()) change.black = message.black();
    if (message.has_freeze()) change.freeze = message.freeze();
    return change;
}

fs::path keptShowOf(const std::string& rigPath) {
    return userFolder("XDG_STATE_HOME", ".local/state") / "shows" /
           (fs::path(rigPath).stem().string() + ".txtpb");
}

ShowChange readKeptShow(const fs::path& path) {
    if (!fs::exists(path)) return {};
    return parseKeptShow(config::readTextFile(path.string()), path.string());
}

ShowChange parseKeptShow(const std::string& text, const std::string& source) {
    v1::WantedShow in;
    config::TextReader file(text, source, in);
    file.check();
    return changeIn(in);
}

void keepShow(const fs::path& path, const ShowChange& kept) {
    v1::WantedShow out;
    out.set_version(kVersion);
    if (kept.scene) out.set_scene(*kept.scene);
    if (kept.quality) out.set_quality(tierOf(*kept.quality));
    if (kept.pattern) out.set_pattern(static_cast<v1::WantedShow::Shown>(*kept.pattern));
    if (kept.black) out.set_black(*kept.black);
    if (kept.freeze) out.set_freeze(*kept.freeze);
    std::string text;
    google::protobuf::TextFormat::PrintToString(out, &text);
    text = "# What the wall was last told to show (aquarama set).\n" + text;
    writeWhole(path, std::as_bytes(std::span{text}));
}

}  // namespace aquarama::wire
