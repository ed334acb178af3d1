// SPDX-License-Identifier: Apache-2.0
#include "master/conductor/show_control.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <chrono>
#include <span>
#include <string_view>

#include <google/protobuf/text_format.h>

#include "common/base/files.h"
#include "common/config/text_reader.h"
#include "common/config/wanted.pb.h"

namespace aquarama::conductor {
namespace {

constexpr std::chrono::duration<float> kFade{0.5F};
constexpr std::size_t kAnswers = 16;

template <class Value>
void put(std::optional<Value>& into, const std::optional<Value>& value) {
    if (value) into = value;
}

}  // namespace

WantedShow with(WantedShow wanted, const ShowChange& change) {
    wanted.scene = change.scene.value_or(wanted.scene);
    wanted.quality = change.quality.value_or(wanted.quality);
    wanted.pattern = change.pattern.value_or(wanted.pattern);
    wanted.black = change.black.value_or(wanted.black);
    wanted.freeze = change.freeze.value_or(wanted.freeze);
    return wanted;
}

namespace {

constexpr std::array<std::string_view, 4> kPatternNames{"", "world", "grid", "grey"};

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
    if (change.pattern)
        add(text, "pattern", kPatternNames.at(static_cast<std::size_t>(*change.pattern)));
    add(text, "black", onOff(change.black));
    add(text, "freeze", onOff(change.freeze));
    return text;
}

ShowControl::ShowControl(WantedShow wanted, ShowChange kept)
    : wanted_{std::move(wanted)},
      kept_{std::move(kept)},
      hasWorld_{wanted_.pattern == wire::Pattern::World},
      brightness_{wanted_.black ? 0.0F : 1.0F} {}

Answer ShowControl::set(std::uint64_t request, const ShowChange& change) {
    const auto known = std::ranges::find(answers_, request, &RequestAndAnswer::first);
    if (known != answers_.end()) {
        if (known->second.outcome == Outcome::Preparing) known->second.reason = waitingFor_;
        return known->second;
    }
    const WantedShow goal = with(wanted_, change);
    const bool lacksWorld = goal.pattern == wire::Pattern::World && !hasWorld_;
    const bool isAnotherLook =
        goal.scene != wanted_.scene || goal.quality != wanted_.quality || lacksWorld;
    if (isAnotherLook && phase_ != Phase::Steady)
        return remember(request,
                        {Outcome::Refused,
                         "another change is under way (" + waitingFor_ + "); wait for its end"});
    if (goal != wanted_) ++version_;
    // At once, whatever else is under way.
    wanted_.black = next_.black = goal.black;
    wanted_.freeze = next_.freeze = goal.freeze;
    put(kept_.black, change.black);
    put(kept_.freeze, change.freeze);
    if (isAnotherLook) return begin(request, goal, change);
    wanted_.pattern = next_.pattern = goal.pattern;
    put(kept_.pattern, change.pattern);
    put(kept_.quality, change.quality);
    put(kept_.scene, change.scene);
    return remember(request, {});
}

Answer ShowControl::begin(std::uint64_t request, const WantedShow& goal, const ShowChange& change) {
    next_ = goal;
    change_ = change;
    underWay_ = request;
    phase_ = goal.scene != wanted_.scene ? Phase::Making : Phase::Preparing;
    waitingFor_ = phase_ == Phase::Making ? "the world of scene " + goal.scene + " is being made"
                                          : "nodes build it";
    return remember(request, {Outcome::Preparing, waitingFor_});
}

void ShowControl::made() {
    assert(phase_ == Phase::Making);
    phase_ = Phase::Preparing;
}

void ShowControl::prepared() {
    assert(phase_ == Phase::Preparing);
    phase_ = next_.scene != wanted_.scene ? Phase::Fading : Phase::Switching;
}

void ShowControl::blackShown() {
    if (phase_ == Phase::Fading) phase_ = Phase::Switching;
}

void ShowControl::switched() {
    assert(phase_ == Phase::Switching);
    hasWorld_ = nextHasWorld();
    wanted_ = next_;
    put(kept_.scene, change_.scene);
    put(kept_.quality, change_.quality);
    put(kept_.pattern, change_.pattern);
    phase_ = Phase::Steady;
    ++look_;
    ++version_;
    settle({});
}

void ShowControl::fail(const std::string& reason) {
    assert(phase_ != Phase::Steady);
    phase_ = Phase::Steady;
    settle({Outcome::Refused, reason});
}

Answer ShowControl::remember(std::uint64_t request, const Answer& answer) {
    answers_.emplace_back(request, answer);
    if (answers_.size() > kAnswers) answers_.pop_front();
    return answer;
}

void ShowControl::settle(const Answer& answer) {
    waitingFor_.clear();
    const auto known = std::ranges::find(answers_, underWay_, &RequestAndAnswer::first);
    if (known != answers_.end())
        known->second = answer;
    else  // many others have asked meanwhile
        remember(underWay_, answer);
}

float ShowControl::brightness(net::Instant now) {
    const std::chrono::duration<float> passed =
        brightnessAt_ == net::Instant{} ? net::Instant{} : now - brightnessAt_;
    brightnessAt_ = now;
    const bool isDark = wanted_.black || phase_ == Phase::Fading || phase_ == Phase::Switching;
    const float step = passed / kFade;
    brightness_ = std::clamp(isDark ? brightness_ - step : brightness_ + step, 0.0F, 1.0F);
    return brightness_;
}

// --- kept on disk

namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kVersion = 1;

// Tiers follow AUTO, in their order; patterns are numbered as in aquarama.proto.
static_assert(v1::WantedShow::LOW - v1::WantedShow::AUTO == 1);
static_assert(int{v1::WantedShow::GREY} == static_cast<int>(wire::Pattern::Grey));

v1::WantedShow::Tier tierOf(const std::optional<config::QualityTier>& quality) {
    if (!quality) return v1::WantedShow::AUTO;
    return static_cast<v1::WantedShow::Tier>(v1::WantedShow::LOW + static_cast<int>(*quality));
}

}  // namespace

fs::path keptShowOf(const std::string& rigPath) {
    return userFolder("XDG_STATE_HOME", ".local/state") / "shows" /
           (fs::path(rigPath).stem().string() + ".txtpb");
}

ShowChange readKeptShow(const fs::path& path) {
    if (!fs::exists(path)) return {};
    v1::WantedShow in;
    config::TextReader file(config::readTextFile(path.string()), path.string(), in);
    file.check();
    ShowChange kept;
    if (in.has_scene()) kept.scene = in.scene();
    if (in.has_quality())  // AUTO is no tier
        kept.quality =
            in.quality() == v1::WantedShow::AUTO
                ? std::nullopt
                : config::tierAt(static_cast<std::uint32_t>(in.quality() - v1::WantedShow::LOW));
    if (in.has_pattern()) kept.pattern = static_cast<wire::Pattern>(in.pattern());
    if (in.has_black()) kept.black = in.black();
    if (in.has_freeze()) kept.freeze = in.freeze();
    return kept;
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

}  // namespace aquarama::conductor
