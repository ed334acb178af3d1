// SPDX-License-Identifier: Apache-2.0
#include "master/conductor/looks.h"

#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "common/base/log.h"
#include "tests/master/conductor/parts.h"
#include "tests/support/await.h"
#include "tests/support/messages.h"
#include "tests/support/stage.h"

namespace aquarama::conductor {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using Phase = ShowControl::Phase;
using Files = std::map<std::string, net::Blob>;

net::Blob blobOf(const std::string& text) {
    const auto bytes = std::as_bytes(std::span{text});
    return std::make_shared<const net::ByteVector>(bytes.begin(), bytes.end());
}

// Its colour is not what a scene has where it says nothing.
const std::string kScene = R"(name: "sea" place: OPEN_SEA eye { x_m: 0 y_m: -9 z_m: 0 }
water { centre { x_m: 0 y_m: -9 z_m: -7 } half_extent { x_m: 7 y_m: 4 z_m: 5 }
colour_returned: 0.25 } gathering: NONE plankton: 0
cast { species: "scad.txtpb" fish: 3 })";

// Of one species, with three fish.
wire::AssetBundle assetsOf(const std::string& species) {
    return {.seed = 77,
            .sceneFile = "reef",
            .scene = kScene,
            .cast = {{species, "name: \"" + species + "\"", {std::byte{1}, std::byte{2}}, 3}}};
}

const std::vector<motion::FishTraits> kSchool{{1, 200}, {2, 210}, {3, 220}};

v1::WantedShow reef() {
    v1::WantedShow show;
    show.set_scene("reef");
    show.set_quality(v1::WantedShow::LOW);
    return show;
}

// The looks of a desk. Nobody takes part yet.
class DeskLooks : public testing::Test {
  protected:
    void begin(const LookSources& sources = {}, const Files& files = {}) {
        v1::Welcome welcome;
        welcome.set_rig_text("a rig");
        welcome.set_state_address("memory:state");
        welcome.set_pace(v1::PACE_LIVE);
        const wire::AssetBundle assets = assetsOf("scad");
        looks = std::make_unique<Looks>(sources,
                                        welcome,
                                        files,
                                        lookOf(assets, kSchool),
                                        blobsOf(assets),
                                        control,
                                        parts.roster,
                                        parts.sender);
    }
    void order(v1::WantedShow::Tier quality) {
        v1::WantedShow change;
        change.set_quality(quality);
        static_cast<void>(control.set(1, change));
    }
    void order(const std::string& scene) {
        v1::WantedShow change;
        change.set_scene(scene);
        static_cast<void>(control.set(1, change));
    }
    // Steps until the change has come to this phase.
    bool reaches(Phase phase) {
        return test::comesTrue([&] {
            looks->step(now);
            return control.phase() == phase;
        });
    }
    // Whether a node can fetch a file of this content.
    bool hasBlob(const std::string& text) const {
        return looks->blob(digestOf(std::as_bytes(std::span{text}))) != nullptr;
    }
    v1::Look welcomed() const { return wire::decode(looks->welcome()).value().welcome().look(); }

    test::Parts parts;
    ask::OrderBook book;
    ShowControl control{reef(), {}, book};
    std::unique_ptr<Looks> looks;
    net::Moment now = test::kStart;
};

TEST_F(DeskLooks, aNodeIsWelcomedToWhatIsShown) {
    begin({}, {{"wall.pfm", blobOf("a wall")}});
    const v1::Look look = welcomed();
    EXPECT_EQ(look.number(), 1U);
    EXPECT_TRUE(look.world());
    EXPECT_EQ(look.quality(), static_cast<std::uint32_t>(config::QualityTier::Low));
    EXPECT_EQ(look.fish_ids_size(), 3);
    ASSERT_EQ(look.rig_files_size(), 1);
    EXPECT_EQ(look.rig_files(0).name(), "wall.pfm");
    EXPECT_EQ(looks->sceneName(), "reef");
    EXPECT_TRUE(hasBlob("a wall"));
}

TEST_F(DeskLooks, colourIsTheScenesOwnUntilItIsSet) {
    begin();
    EXPECT_EQ(looks->colourReturned(), 0.25);
    v1::WantedShow change;
    change.set_colour_returned(0.5);
    static_cast<void>(control.set(1, change));
    EXPECT_EQ(looks->colourReturned(), 0.5);
}

TEST_F(DeskLooks, whatASpeciesIsMadeOfCanBeFetchedByItsDigest) {
    begin();
    const net::Blob species = looks->blob(wire::digestIn(welcomed().cast(0).species()));
    ASSERT_TRUE(species);
    EXPECT_EQ(*species, *blobOf("name: \"scad\""));
    const net::Blob repertoire = looks->blob(wire::digestIn(welcomed().cast(0).repertoire()));
    ASSERT_TRUE(repertoire);
    EXPECT_EQ(*repertoire, (net::ByteVector{std::byte{1}, std::byte{2}}));
    EXPECT_FALSE(looks->blob({})) << "an unknown file";
}

TEST_F(DeskLooks, anotherQualityIsBuiltByAllWhoTakePart) {
    begin();
    for (const char* name : {"left", "right"}) parts.join(name);
    order(v1::WantedShow::HIGH);
    looks->step(now);
    looks->step(now + milliseconds(900));
    for (const char* name : {"left", "right"})
        EXPECT_EQ(parts.count(name, v1::Envelope::kPrepare), 1) << name;
    parts.seat("left").builtLook = 2;
    looks->step(now + milliseconds(1100));
    EXPECT_EQ(parts.count("left", v1::Envelope::kPrepare), 1);
    EXPECT_EQ(parts.count("right", v1::Envelope::kPrepare), 2) << "a packet may be lost";
    EXPECT_EQ(control.waitingFor(), "prepared by all nodes but right");
    parts.seat("right").builtLook = 2;
    looks->step(now + milliseconds(1200));
    ASSERT_EQ(control.phase(), Phase::Switching);
    EXPECT_EQ(looks->quality(), config::QualityTier::Low) << "until it is shown";
    EXPECT_FALSE(looks->switchToNext()) << "the world is the same one";
    EXPECT_EQ(looks->quality(), config::QualityTier::High);
    EXPECT_EQ(welcomed().number(), 2U);
    EXPECT_EQ(book.find(1)->outcome, Outcome::Done);
}

TEST_F(DeskLooks, aNodeThatComesMeanwhileIsToldOfTheNextLook) {
    begin();
    parts.join("left");
    order(v1::WantedShow::HIGH);
    looks->step(now);
    parts.join("right");
    looks->prepareAgain();
    looks->step(now + milliseconds(10));
    EXPECT_EQ(parts.count("right", v1::Envelope::kPrepare), 1);
}

// A machine that is too slow for a look must not hold up the wall for ever.
TEST_F(DeskLooks, aLookThatIsNotBuiltInTwoMinutesIsGivenUp) {
    begin();
    parts.join("left");
    order(v1::WantedShow::HIGH);
    looks->step(now);
    looks->step(now + seconds(119));
    EXPECT_EQ(control.phase(), Phase::Preparing);
    looks->step(now + seconds(121));
    EXPECT_EQ(control.phase(), Phase::Steady);
    EXPECT_EQ(*book.find(1),
              (Answer{Outcome::Refused, "not prepared within two minutes by left; see its log"}));
    EXPECT_EQ(welcomed().number(), 1U);
}

TEST_F(DeskLooks, anotherSceneIsMadeBesideTheShow) {
    std::string asked;
    begin({.makeWorld =
               [&](const std::string& scene) {
                   asked = scene;
                   return NextWorld{
                       assetsOf("tuna"), kSchool, std::make_unique<test::CountingWorld>()};
               },
           .changedRig = {}});
    parts.join("left");
    order("lagoon");
    ASSERT_TRUE(reaches(Phase::Preparing));
    EXPECT_EQ(asked, "lagoon");
    EXPECT_TRUE(hasBlob("name: \"tuna\"")) << "nodes build it now";
    parts.seat("left").builtLook = 2;
    ASSERT_TRUE(reaches(Phase::Fading));
    EXPECT_EQ(looks->sceneName(), "reef");
    control.blackShown();
    const auto world = looks->switchToNext();
    ASSERT_TRUE(world);
    EXPECT_TRUE(world->simulation);
    EXPECT_EQ(looks->sceneName(), "lagoon");
}

TEST_F(DeskLooks, aWorldThatCannotBeMadeLeavesTheWallAsItIs) {
    begin({.makeWorld = [](const std::string&) -> NextWorld { throw Error("it has no sand"); },
           .changedRig = {}});
    order("lagoon");
    ASSERT_TRUE(reaches(Phase::Steady));
    EXPECT_EQ(*book.find(1), (Answer{Outcome::Refused, "it has no sand"}));
    EXPECT_EQ(looks->sceneName(), "reef");
    EXPECT_EQ(welcomed().number(), 1U);
}

TEST_F(DeskLooks, newFilesOfTheWallAreBuiltAndOldOnesForgotten) {
    begin({.makeWorld = {},
           .changedRig =
               [] {
                   config::Rig rig;
                   rig.files = {{"wall.pfm", blobOf("a new wall")}};
                   return std::optional(rig);
               }},
          {{"wall.pfm", blobOf("a wall")}});
    const std::uint64_t before = looks->calibration();
    parts.join("left");
    ASSERT_TRUE(reaches(Phase::Preparing));
    EXPECT_TRUE(hasBlob("a wall"));
    looks->step(now);
    EXPECT_EQ(parts.count("left", v1::Envelope::kPrepare), 1);
    parts.seat("left").builtLook = 2;
    ASSERT_TRUE(reaches(Phase::Switching));
    EXPECT_EQ(looks->calibration(), before);
    EXPECT_FALSE(looks->switchToNext());
    EXPECT_NE(looks->calibration(), before);
    EXPECT_TRUE(hasBlob("a new wall"));
    EXPECT_FALSE(hasBlob("a wall"));
}

TEST_F(DeskLooks, wrongFilesOfTheWallAreNotShown) {
    std::atomic<int> calls = 0;
    begin({.makeWorld = {},
           .changedRig = [&]() -> std::optional<config::Rig> {
               ++calls;
               throw Error("the wall file is cut off");
           }},
          {{"wall.pfm", blobOf("a wall")}});
    ASSERT_TRUE(test::comesTrue([&] {
        looks->step(now += milliseconds(100));
        return calls >= 2;
    }));
    EXPECT_EQ(control.phase(), Phase::Steady);
    EXPECT_TRUE(hasBlob("a wall"));
}

// In a folder of its own.
class Keeping : public testing::Test {
  protected:
    ~Keeping() override { std::filesystem::remove_all(folder); }
    static v1::WantedShow black(bool on) {
        v1::WantedShow show;
        show.set_black(on);
        return show;
    }

    std::filesystem::path folder = test::freshDirectory();
    std::filesystem::path path = folder / "desk.txtpb";
};

TEST_F(Keeping, theLastOfManyChangesIsOnTheDisk) {
    ShowKeeper keeper(path, {});
    for (int change = 0; change < 9; ++change) keeper.keep(black(change % 2 == 0), {});
    keeper.finish(black(false));
    EXPECT_TRUE(wire::areSame(wire::readKeptShow(path), black(false)));
}

TEST_F(Keeping, itIsToldUntilWhenValuesAreBeingWritten) {
    const net::Moment begun{std::chrono::seconds(9)};
    ShowKeeper keeper(path, black(false));
    EXPECT_FALSE(keeper.writesSince(black(false))) << "there already";
    keeper.keep(black(true), begun);
    EXPECT_EQ(keeper.writesSince(black(true)), begun);
    EXPECT_FALSE(keeper.writesSince(black(false))) << "set otherwise meanwhile";
    v1::WantedShow dim = black(true);
    dim.set_brightness(0.5);
    keeper.keep(dim, begun);
    EXPECT_TRUE(keeper.writesSince(dim)) << "comes after what is being written";
    keeper.finish(dim);
    keeper.keep(dim, begun);
    EXPECT_FALSE(keeper.writesSince(dim));
    EXPECT_TRUE(wire::areSame(wire::readKeptShow(path), dim));
}

// What is being written would take the old value away again.
TEST_F(Keeping, whatIsThereButBeingReplacedIsWaitedFor) {
    ShowKeeper keeper(path, black(false));
    keeper.keep(black(true), {});
    keeper.keep(black(false), {});
    EXPECT_TRUE(keeper.writesSince(black(false)));
    keeper.finish(black(false));
    keeper.keep(black(false), {});
    EXPECT_FALSE(keeper.writesSince(black(false)));
    EXPECT_TRUE(wire::areSame(wire::readKeptShow(path), black(false)));
}

TEST_F(Keeping, aDiskThatTakesNothingIsNotWaitedFor) {
    std::ofstream(folder / "file") << "in the place of a folder";
    ShowKeeper keeper(folder / "file" / "desk.txtpb", {});
    keeper.keep(black(true), {});
    keeper.finish(black(true));
    keeper.keep(black(true), {});
    EXPECT_FALSE(keeper.writesSince(black(true)));
}

TEST_F(Keeping, nothingIsWrittenWhereNothingChanges) {
    ShowKeeper keeper(path, black(true));
    keeper.finish(black(true));
    EXPECT_FALSE(std::filesystem::exists(path));
    ShowKeeper nowhere({}, {});
    nowhere.finish(black(true));
    EXPECT_TRUE(std::filesystem::is_empty(folder));
}

TEST_F(Keeping, aDiskThatCannotBeWrittenDoesNotEndTheShow) {
    std::ofstream(folder / "file") << "in the place of a folder";
    ShowKeeper keeper(folder / "file" / "desk.txtpb", {});
    EXPECT_NO_THROW(keeper.finish(black(true)));
    EXPECT_NO_THROW(keeper.finish(black(false)));
}

}  // namespace
}  // namespace aquarama::conductor
