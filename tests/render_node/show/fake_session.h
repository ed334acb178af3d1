// SPDX-License-Identifier: Apache-2.0
// A master that follows a script, and a context that counts, for tests of a node's frame loop.
#pragma once

#include <algorithm>
#include <deque>
#include <fstream>
#include <functional>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <glm/gtc/quaternion.hpp>

#include "common/place/place.h"
#include "render_node/gl/context.h"
#include "render_node/session/session.h"
#include "tests/common/wall/rigs.h"
#include "tests/render_node/surface/test_fish.h"

namespace aquarama::show {

using Events = std::vector<std::string>;

// What the script answers when a frame is reported ready.
using Script = std::deque<std::pair<wire::StateFrame, session::Release>>;

class FakeSession : public session::Session {
  public:
    FakeSession(Events& events, Script script) : events_{events}, script_{std::move(script)} {}

    std::optional<session::Admission> join() override {
        events_.emplace_back("join");
        return rejoin_;
    }
    void prepared(std::uint32_t look,
                  config::QualityTier /*quality*/,
                  std::shared_ptr<school::SchoolMotion> /*motion*/) override {
        events_.push_back(look == 0 ? "prepared" : "prepared look " + std::to_string(look));
    }
    [[nodiscard]] std::optional<session::Admission> nextLook() override {
        return std::exchange(nextLook_, {});
    }
    [[nodiscard]] std::shared_ptr<const body::SkinsByNumber> newSkins() override {
        return std::exchange(skins_, {});
    }
    std::optional<wire::StateFrame> nextFrame() override {
        if (script_.empty()) return std::nullopt;
        return script_.front().first;
    }
    [[nodiscard]] bool isReckoned() const override { return false; }
    [[nodiscard]] std::optional<std::uint32_t> renumbered() const override { return {}; }
    [[nodiscard]] net::Moment stateArrival() const override {
        return net::Moment{net::Duration{1}};
    }
    [[nodiscard]] session::Release interruption() const override { return session::Release::Quit; }
    session::Release readyThenWait(Frame frame) override {
        events_.push_back("ready " + std::to_string(frame.value));
        const session::Release answer = script_.front().second;
        script_.pop_front();
        return answer;
    }
    void sawBlank(std::uint64_t /*count*/, net::Moment /*at*/) override {}
    void quit() override { events_.emplace_back("quit"); }
    bool isToRestart() const override { return false; }
    void touch(const WallHands& hands) override {
        events_.emplace_back("hands " + std::to_string(hands.size()));
    }
    void freeze(bool frozen) override { events_.emplace_back(frozen ? "freeze" : "thaw"); }
    void describe(const session::NodeFacts& facts) override { facts_ = facts; }
    void dropFood(glm::vec3 positionMetres) override { drops_.push_back(positionMetres); }
    void steer(const Steering& steering) override { steerings_.push_back(steering); }
    void askMind(std::uint32_t fish) override { events_.push_back("ask " + std::to_string(fish)); }
    [[nodiscard]] std::optional<session::ExplainedMind> latestMind() const override {
        return mind_;
    }
    void whileWaiting(std::function<void()> /*call*/) override {}
    void stop() override { events_.emplace_back("stop"); }

    std::optional<session::Admission> rejoin_, nextLook_;
    std::shared_ptr<const body::SkinsByNumber> skins_;
    session::NodeFacts facts_;
    std::vector<glm::vec3> drops_;
    std::vector<Steering> steerings_;
    std::optional<session::ExplainedMind> mind_;

  private:
    Events& events_;
    Script script_;
};

// EGL underneath; says when it swaps.
class CountingContext : public gl::Context {
  public:
    CountingContext(Events& events, glm::ivec2 size)
        : events_{events}, context_{gl::makeOffscreenContext("auto", size)} {}
    [[nodiscard]] std::unique_ptr<gl::Workspace> makeWorkspace() override {
        return context_->makeWorkspace();
    }
    void makeCurrent() override { context_->makeCurrent(); }
    void release() override { context_->release(); }
    void swap() override { events_.emplace_back("swap"); }
    [[nodiscard]] glm::ivec2 framebufferPixels() const override {
        return context_->framebufferPixels();
    }
    [[nodiscard]] bool hasWindow() const override { return false; }
    [[nodiscard]] std::string description() const override { return context_->description(); }
    [[nodiscard]] std::optional<std::string> loss() const override {
        return lostAfterSwaps_ && std::ranges::count(events_, "swap") >= *lostAfterSwaps_
                   ? std::optional<std::string>("a reset")
                   : context_->loss();
    }
    void pumpEvents(std::chrono::milliseconds) override {}
    [[nodiscard]] std::optional<char> nextKey() override { return std::nullopt; }
    [[nodiscard]] std::optional<glm::vec2> nextClick() override { return std::nullopt; }
    [[nodiscard]] std::optional<glm::vec2> pointer() const override { return std::nullopt; }
    [[nodiscard]] gl::Hands hands() const override { return {}; }

    std::optional<long> lostAfterSwaps_;

  private:
    Events& events_;
    std::unique_ptr<gl::Context> context_;
};

inline std::string fileText(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

// Welcomed to the desk.
inline session::Admission admissionTo(wire::Pattern pattern) {
    session::Admission admission;
    admission.rig = wall::shippedRig("desk");
    admission.scene = config::readScene(AQUARAMA_SOURCE_DIR "/config/scenes/reef_1998.txtpb");
    admission.seed = 1;
    admission.world = pattern == wire::Pattern::World;
    return admission;
}

// One scad of this length is the whole school.
inline void addScad(session::Admission& admission, std::uint16_t lengthMillimetres) {
    admission.school = {{.id = 17, .lengthMillimetres = lengthMillimetres}};
    admission.cast = {
        {.file = "bigeye_scad.txtpb",
         .text = fileText(AQUARAMA_SOURCE_DIR "/config/species/bigeye_scad.txtpb"),
         .repertoire = motion::encodeRepertoire(test::swaying(test::scadBody(), 0.05F)),
         .fish = 1}};
}

// The pictures of all channels in half their width and height.
inline void halvePictures(config::Rig& rig) {
    for (config::Channel& channel : rig.channels) {
        channel.sizePixels /= 2;
        channel.projector.focalPixels /= 2;
        channel.projector.principalPixels /= 2;
    }
}

inline wire::StateFrame frameNumber(std::uint64_t number,
                                    wire::Pattern pattern = wire::Pattern::World) {
    wire::StateFrame frame;
    frame.show.pattern = pattern;
    frame.frame = {number};
    frame.tick = {number};
    return frame;
}

// The world without fish.
inline wire::StateFrame emptySea() {
    wire::StateFrame frame = frameNumber(1);
    frame.eye.positionMetres = place::kEyePosition;
    return frame;
}

}  // namespace aquarama::show
