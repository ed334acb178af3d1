// SPDX-License-Identifier: Apache-2.0
// What operators change while a whole show runs: freeze, scans, scenes, and what stays set.
#include <functional>
#include <map>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/ask/request_client.h"
#include "tests/master/conductor/whole_show.h"

namespace aquarama::conductor {
namespace {

using std::chrono::milliseconds;

TEST(Show, aFrozenWorldStandsStillWhileFramesGoOn) {
    test::StageMaster master(ConductorOptions{});
    test::Journal journal;
    const auto nodes = nodesOf(master, journal);
    ASSERT_TRUE(journal.awaitPresented("left", 5));
    nodes[0]->session().freeze(true);
    std::uint64_t still = 0;
    while (still < 20) {
        ASSERT_TRUE(journal.awaitPresented("left", journal.presentedBy("left") + 1));
        const auto events = journal.events();
        still =
            static_cast<std::uint64_t>(std::ranges::count_if(events, [&](const test::Event& event) {
                return event.state.tick == events.back().state.tick;
            }));
    }
    nodes[1]->session().freeze(false);
    const Tick frozen = journal.events().back().state.tick;
    while (journal.events().back().state.tick <= frozen) {
        ASSERT_TRUE(journal.awaitPresented("left", journal.presentedBy("left") + 1));
    }
}

// Sets a value as `aquarama set` does; returns why it was refused, empty where it was not.
std::string setting(const test::StageMaster& master,
                    const std::function<void(v1::WantedShow&)>& alter) {
    v1::Order order;
    alter(*order.mutable_show());
    try {
        ask::RequestClient(master.control()).carryOut(order, [](const std::string&) {});
        return "";
    } catch (const Error& refused) {
        return refused.what();
    }
}

// Asks for a pattern of a scan until it is answered otherwise than "ask again".
v1::OrderReply scanning(ask::RequestClient& client,
                        std::uint64_t holder,
                        const std::optional<config::ScanPattern>& pattern) {
    v1::Order order;
    order.set_request(ask::freshRequest());
    order.mutable_scan()->set_holder(holder);
    if (pattern) wire::writeScanPattern(*pattern, *order.mutable_scan()->mutable_pattern());
    v1::OrderReply reply = client.give(order);
    while (reply.outcome() == v1::OrderReply::WAITING) reply = client.give(order);
    return reply;
}

// What a node has shown from this frame on.
std::vector<wire::Show> shownFrom(const test::Journal& journal,
                                  const std::string& node,
                                  std::uint64_t frame) {
    std::vector<wire::Show> shows;
    for (const test::Event& event : journal.events())
        if (event.kind == test::Event::Kind::Presented && event.node == node &&
            event.state.frame.value >= frame)
            shows.push_back(event.state.show);
    return shows;
}

TEST(Show, aScanIsShownByAllBeforeItIsDoneAndLeavesTheWallAsItWas) {
    ConductorOptions options;
    options.wanted.set_pattern(v1::WantedShow::GRID);
    test::StageMaster master(options);
    test::Journal journal;
    const auto nodes = nodesOf(master, journal);
    ask::RequestClient client(master.control());
    config::ScanPattern pattern{.light = glm::vec3(0.5F), .lit = 5};
    for (const std::uint16_t number : std::array<std::uint16_t, 2>{1, 2}) {
        pattern.number = number;
        const v1::OrderReply done = scanning(client, 9, pattern);
        ASSERT_EQ(done.outcome(), v1::OrderReply::DONE);
        for (const std::string& name : kNames) {
            const auto shows = shownFrom(journal, name, done.frame());
            for (const wire::Show& show : shows) EXPECT_EQ(show.scan, pattern) << name;
        }
    }
    EXPECT_EQ(scanning(client, 10, pattern).outcome(), v1::OrderReply::REFUSED) << "another holder";
    EXPECT_THAT(
        setting(master, [](v1::WantedShow& show) { show.set_pattern(v1::WantedShow::GREY); }),
        testing::HasSubstr("a scan holds the wall"));
    EXPECT_EQ(client.status().show().pattern(), v1::PATTERN_SCAN);
    EXPECT_EQ(scanning(client, 10, {}).outcome(), v1::OrderReply::DONE) << "not its to end";
    EXPECT_EQ(client.status().show().pattern(), v1::PATTERN_SCAN);
    EXPECT_EQ(scanning(client, 9, {}).outcome(), v1::OrderReply::DONE);
    EXPECT_EQ(client.status().show().pattern(), v1::PATTERN_GRID);
    EXPECT_EQ(setting(master, [](v1::WantedShow& show) { show.set_black(true); }), "");
    const v1::OrderReply refused = scanning(client, 9, pattern);
    EXPECT_THAT(refused.reason(), testing::HasSubstr("black"));
}

ConductorOptions withScenes() {
    ConductorOptions options;
    options.wanted.set_scene("reef");
    options.looks.makeWorld = [](const std::string& scene) {
        if (scene != "lagoon") throw Error("there is no scene " + scene);
        return NextWorld{test::StageMaster::assets(),
                         test::StageMaster::school(),
                         std::make_unique<test::CountingWorld>(),
                         std::make_shared<JournalReport>(v1::JournalStatus::NOT_KEPT, scene)};
    };
    return options;
}

// Whatever a node draws it has built; no node shows the next look before all have built it; and the
// wall is black when it changes.
void expectOneLook(const std::vector<test::Event>& events) {
    std::map<std::string, std::set<std::uint32_t>> built;
    std::map<std::string, wire::StateFrame> shown;
    for (const test::Event& event : events) {
        const wire::Show& show = event.state.show;
        if (event.kind == test::Event::Kind::Built) built[event.node].insert(show.look);
        if (event.kind != test::Event::Kind::Presented) continue;
        for (const std::string& name : kNames)
            EXPECT_TRUE(show.look == 1 || built[name].contains(show.look)) << name;
        // A busy machine's node may pass over frames.
        const wire::StateFrame& last = shown[event.node];
        if (last.frame.value + 1 == event.state.frame.value && last.show.look == 1 &&
            show.look == 2) {
            EXPECT_EQ(last.show.brightness, 0) << "the last frame of the scene before";
            EXPECT_EQ(show.brightness, 0) << "the first of the next";
        }
        shown[event.node] = event.state;
    }
}

TEST(Show, aSceneChangesThroughBlackWhenEveryNodeHasBuiltIt) {
    test::StageMaster master(withScenes());
    test::Journal journal;
    std::vector<std::unique_ptr<test::StageNode>> nodes;
    for (const std::string& name : kNames)
        nodes.push_back(std::make_unique<test::StageNode>(
            name,
            master.connect(),
            journal,
            test::StageNode::Habits{{}, {}, milliseconds(name == "middle" ? 400 : 20)}));
    for (const std::string& name : kNames) ASSERT_TRUE(journal.awaitPresented(name, 5));
    const std::uint64_t before = journal.presentedBy("left");
    EXPECT_EQ(setting(master, [](v1::WantedShow& show) { show.set_scene("lagoon"); }), "");
    EXPECT_TRUE(journal.await([](const test::Event& event) {
        return event.kind == test::Event::Kind::Presented && event.state.show.look == 2 &&
               event.state.show.brightness == 1;
    }));
    expectOneLook(journal.allEvents());
    const auto events = journal.events();
    const auto during = std::ranges::count_if(events, [](const test::Event& event) {
        return event.kind == test::Event::Kind::Presented && event.node == "left" &&
               event.state.show.look == 1;
    });
    EXPECT_GT(static_cast<std::uint64_t>(during), before + 10) << "the scene before was shown";
    EXPECT_EQ(events.back().state.show.scene, "lagoon");
    for (const auto& node : nodes) EXPECT_EQ(node->joins(), 1);

    EXPECT_THAT(setting(master, [](v1::WantedShow& show) { show.set_scene("pond"); }),
                testing::HasSubstr("there is no scene pond"));
    const v1::StatusReply status = ask::RequestClient(master.control()).status();
    EXPECT_EQ(status.show().scene(), "lagoon");
    EXPECT_EQ(status.journal().reason(), "lagoon") << "the journal is that of the world";
}

// The rest of the wall need not wait for one that hangs, and it has another chance.
TEST(Show, aNodeThatComesWhileASceneChangesShowsTheNewOne) {
    test::StageMaster master(withScenes());
    test::Journal journal;
    std::vector<std::unique_ptr<test::StageNode>> nodes;
    for (const std::string& name : {kNames[0], kNames[1]})
        nodes.push_back(std::make_unique<test::StageNode>(
            name, master.connect(), journal, test::StageNode::Habits{{}, {}, milliseconds(100)}));
    ASSERT_TRUE(journal.awaitPresented("middle", 5));
    nodes.push_back(std::make_unique<test::StageNode>(
        "right",
        master.connect(),
        journal,
        test::StageNode::Habits{{}, milliseconds(50), milliseconds(250)}));
    EXPECT_EQ(setting(master, [](v1::WantedShow& show) { show.set_scene("lagoon"); }), "");
    EXPECT_TRUE(journal.await([](const test::Event& event) {
        return event.kind == test::Event::Kind::Presented && event.node == "right" &&
               event.state.show.scene == "lagoon";
    }));
}

TEST(Show, whatIsDoneIsOnTheDisk) {
    const std::filesystem::path folder = test::freshDirectory();
    ConductorOptions options;
    options.keptAt = folder / "desk.txtpb";
    const test::StageMaster master(options);
    for (int change = 0; change < 20; ++change) {
        const bool isBlack = change % 2 == 0;
        EXPECT_EQ(setting(master, [&](v1::WantedShow& show) { show.set_black(isBlack); }), "");
        EXPECT_EQ(wire::readKeptShow(options.keptAt).black(), isBlack) << change;
    }
    std::filesystem::remove_all(folder);
}

TEST(Show, whatWasSetIsShownByAMasterThatIsStartedAgain) {
    const std::filesystem::path folder = test::freshDirectory();
    ConductorOptions options;
    options.keptAt = folder / "desk.txtpb";
    {
        test::StageMaster master(options);
        test::Journal journal;
        const auto nodes = nodesOf(master, journal);
        ASSERT_TRUE(journal.awaitPresented("left", 3));
        EXPECT_EQ(setting(master,
                          [](v1::WantedShow& show) {
                              show.set_black(true);
                              show.set_pattern(v1::WantedShow::GRID);
                          }),
                  "");
    }
    options.kept = wire::readKeptShow(options.keptAt);
    options.wanted = options.kept;
    test::StageMaster master(options);
    test::Journal journal;
    const auto nodes = nodesOf(master, journal);
    ASSERT_TRUE(journal.awaitPresented("left", 3));
    for (const test::Event& event : journal.events()) {
        EXPECT_EQ(event.state.show.brightness, 0);
        EXPECT_EQ(event.state.show.pattern, wire::Pattern::Grid);
    }
    std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace aquarama::conductor
