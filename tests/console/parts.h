// SPDX-License-Identifier: Apache-2.0
// What tests of the parts of a console stand on, without sockets: a state of the desk in a folder
// of its own, pages that keep what they are sent, and a record of what master and nodes are told.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <google/protobuf/util/json_util.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "common/ask/picture_hub.h"
#include "common/config/rig.h"
#include "console/show_link.h"
#include "console/state.h"
#include "console/visitors.h"
#include "tests/support/source_folder.h"

namespace aquarama::test {

// The run of the master that is heard.
inline constexpr std::uint64_t kRun = 77;

// The sending end of a page: keeps all that is put into it.
struct PageOutbox final : web::Outbox {
    std::vector<std::pair<std::string, browser::ToBrowser>> sent;  // topic, message
    std::vector<std::string> pictures;
    std::optional<std::uint16_t> closed;  // by this code

    void put(const std::string& topic, web::Payload payload, bool isBinary) override {
        if (isBinary) return pictures.push_back(*payload);
        sent.emplace_back(topic, browser::ToBrowser{});
        const auto read =
            google::protobuf::util::JsonStringToMessage(*payload, &sent.back().second);
        EXPECT_TRUE(read.ok()) << *payload;
    }
    void close(std::uint16_t code) override { closed = code; }

    // How often something came under this topic, and the last of it.
    [[nodiscard]] std::ptrdiff_t count(const std::string& topic) const {
        return std::ranges::count(sent, topic, [](const auto& one) { return one.first; });
    }
    [[nodiscard]] browser::ToBrowser last(const std::string& topic) const {
        browser::ToBrowser message;
        for (const auto& [name, one] : sent)
            if (name == topic) message = one;
        return message;
    }
};

// One projector, "left", of which this is known.
inline browser::ProjectorList projectorWith(const std::string& reach, const std::string& power) {
    browser::ProjectorList list;
    browser::ProjectorState& one = *list.add_projectors();
    one.set_name("left");
    one.set_reach(reach);
    one.set_power(power);
    return list;
}

// A page that somebody has open.
struct Page {
    explicit Page(console::ConsoleRole role, const std::string& name = "anna")
        : visitor{.holder = {.id = "id of " + name, .hash = {}, .name = name, .role = role},
                  .outbox = &outbox} {}
    Page(const Page&) = delete;
    Page& operator=(const Page&) = delete;

    PageOutbox outbox;
    console::Visitor visitor;
};

// What the master is told.
struct ToldMaster final : console::MasterProxy {
    std::vector<v1::Order> orders;
    std::vector<std::uint32_t> fish;   // whose minds are asked for
    std::vector<std::uint32_t> skins;  // of drawings that are asked for

    void give(v1::Order order) override { orders.push_back(std::move(order)); }
    void touch(const WallHands& /*hands*/) override {}
    void steer(const Steering& /*steering*/) override {}
    void explain(std::uint32_t asked) override { fish.push_back(asked); }
    void askSkin(std::uint32_t number) override { skins.push_back(number); }
};

// What the nodes are asked.
struct AskedNodes final : ask::NodeProxy {
    struct Picture {
        std::string channel;
        std::uint64_t number;
        std::uint32_t widthPixels;
    };
    std::vector<Picture> pictures;
    std::vector<v1::FishRequest> fish;

    void askPicture(const std::string& channel,
                    std::uint64_t number,
                    std::uint32_t widthPixels) override {
        pictures.push_back({channel, number, widthPixels});
    }
    void askFish(const std::string& /*channel*/, const v1::FishRequest& request) override {
        fish.push_back(request);
    }
};

// A console of the desk (channels left, middle and right) that has heard nothing yet. It sets the
// variables of the process that name folders: one at a time.
struct ConsoleParts {
    ConsoleParts() { visitors.watch(&nodes); }
    ~ConsoleParts() { std::filesystem::remove_all(folder); }
    ConsoleParts(const ConsoleParts&) = delete;
    ConsoleParts& operator=(const ConsoleParts&) = delete;

    // The master says that its wall is shown.
    void hearWall() {
        state.wall.set_heard(true);
        state.wall.set_run(kRun);
    }
    // Where words for the console's machine are put. It is not there: no word is taken.
    [[nodiscard]] std::filesystem::path powerFolder() const { return folder / "power"; }
    // The list of events, "who: what", the newest first.
    [[nodiscard]] std::vector<std::string> events() const {
        std::vector<std::string> texts;
        const browser::EventList list = state.events.list();
        for (const browser::Event& event : list.events())
            texts.push_back(event.who() + ": " + event.what());
        return texts;
    }

    std::filesystem::path folder = freshFolder();
    std::string rigFile = sourceFolder() + "/config/desk.txtpb";
    console::Access access{folder / "access"};
    console::State state{config::readRig(rigFile), rigFile, "build 1", access};
    AskedNodes nodes;
    console::Visitors visitors{state};

  private:
    static std::filesystem::path freshFolder() {
        const auto path = std::filesystem::temp_directory_path() /
                          ("aquarama-console-parts-" + std::to_string(getpid()));
        std::filesystem::remove_all(path);
        std::filesystem::create_directories(path);
        setenv("XDG_STATE_HOME", path.c_str(), 1);
        setenv("AQUARAMA_POWER_FOLDER", (path / "power").c_str(), 1);  // not this machine's
        return path;
    }
};

}  // namespace aquarama::test
