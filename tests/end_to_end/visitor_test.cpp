// SPDX-License-Identifier: Apache-2.0
// A real master; this test is its only node (a live show goes on without the others), and does with
// its hands what a visitor does.
#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "common/config/rig.h"
#include "render_node/session/session.h"
#include "tests/end_to_end/free_port.h"

namespace aquarama {
namespace {

namespace fs = std::filesystem;

// `aquarama master` on the desk and ports of its own; ended with the test.
class Master {
  public:
    explicit Master(const std::vector<std::string>& arguments) {
        fs::create_directories(folder_);
        // A world of its own: a show goes on from the journal of the one before.
        setenv("XDG_STATE_HOME", (folder_ / "state").c_str(), 1);
        const config::Rig rig = config::parseRig(rigOnFreePorts("desk"), "desk");
        control_ = rig.controlAddress;
        std::ofstream(folder_ / "rig.txtpb") << rig.text;
        std::vector<std::string> words{std::string(getenv("AQUARAMA_BIN")) + "/aquarama",
                                       "master",
                                       (folder_ / "rig.txtpb").string()};
        words.insert(words.end(), arguments.begin(), arguments.end());
        std::vector<char*> pointers;
        for (std::string& word : words) pointers.push_back(word.data());
        pointers.push_back(nullptr);
        EXPECT_EQ(posix_spawn(&process_, pointers[0], nullptr, nullptr, pointers.data(), environ),
                  0);
    }
    ~Master() {
        kill(process_, SIGTERM);
        waitpid(process_, nullptr, 0);
        fs::remove_all(folder_);
    }
    Master(const Master&) = delete;
    Master& operator=(const Master&) = delete;

    [[nodiscard]] std::unique_ptr<session::Session> connect() const {
        return session::connectSession("middle", {control_}, {}, folder_ / "blobs");
    }

  private:
    fs::path folder_ = fs::temp_directory_path() / ("aquarama-visitor-" + std::to_string(getpid()));
    std::string control_;
    pid_t process_ = 0;
};

// World frame.
std::vector<glm::vec3> pelletsIn(const wire::StateFrame& state) {
    std::vector<glm::vec3> places;
    for (const wire::FoodRecord record : state.foodAfter)
        if (record.kind() == wire::FoodRecord::Kind::Pellet)
            places.push_back(state.foodOriginMetres + record.offsetMetres());
    return places;
}

float meanHeight(const std::vector<glm::vec3>& places) {
    float sum = 0;
    for (const glm::vec3 place : places) sum += place.y;
    return sum / static_cast<float>(places.size());
}

// The next state in which `isIt` holds; empty after so many frames without.
template <class Predicate>
std::optional<wire::StateFrame> await(session::Session& session, Predicate isIt) {
    constexpr int kMostFrames = 1200;
    for (int frame = 0; frame < kMostFrames; ++frame) {
        auto state = session.nextFrame();
        if (!state) return std::nullopt;
        (void)session.readyThenWait(state->frame);  // or the wall would wait for us
        if (isIt(*state)) return state;
    }
    return std::nullopt;
}

TEST(Visitor, whatIsDroppedFallsWhereItWasDroppedAndSinks) {
    const Master master({"--seed", "3"});
    const auto session = master.connect();
    const auto admission = session->join();
    ASSERT_TRUE(admission);
    session->prepared(1, config::QualityTier::Low, session::motionOf(*admission));
    const auto first = await(*session, [](const wire::StateFrame&) { return true; });
    ASSERT_TRUE(first);
    EXPECT_TRUE(pelletsIn(*first).empty());
    EXPECT_GT(first->foodAfter.size(), 100U) << "plankton and room for pellets";
    EXPECT_GT(first->timeOfDay, 0.0F);

    const glm::vec3 drop = first->eye.positionMetres + glm::vec3(0, 0, -2.5F);
    session->dropFood(drop);
    session->dropFood(drop);                         // too soon after the first
    session->dropFood(drop + glm::vec3(0, 0, 500));  // out of reach
    const auto fed =
        await(*session, [](const wire::StateFrame& state) { return !pelletsIn(state).empty(); });
    ASSERT_TRUE(fed);
    const std::vector<glm::vec3> pinch = pelletsIn(*fed);
    EXPECT_LE(pinch.size(), 12U);
    for (const glm::vec3 place : pinch) EXPECT_LT(glm::distance(place, drop), 1.0F);
    // Pellets sink, some are eaten meanwhile: those that are left are deeper by and by.
    const auto later = await(*session, [&](const wire::StateFrame& state) {
        const std::vector<glm::vec3> left = pelletsIn(state);
        return left.empty() || meanHeight(left) < meanHeight(pinch) - 0.02F;
    });
    ASSERT_TRUE(later);
    EXPECT_LE(pelletsIn(*later).size(), 12U);
    session->quit();
}

// Ahead, and turned to the left: the eye goes on and looks elsewhere; who lets go glides to rest.
TEST(Visitor, steersTheSubmarine) {
    const Master master({});
    const auto session = master.connect();
    const auto admission = session->join();
    ASSERT_TRUE(admission);
    session->prepared(1, config::QualityTier::Low, session::motionOf(*admission));
    const auto first = await(*session, [](const wire::StateFrame&) { return true; });
    ASSERT_TRUE(first);
    const glm::vec3 begin = first->eye.positionMetres;
    const auto ahead = [](const wire::Eye& eye) { return eye.worldFromWall * glm::vec3(0, 0, -1); };
    EXPECT_GT(glm::dot(ahead(first->eye), glm::vec3(0, 0, -1)), 0.9999F);
    const auto moved = await(*session, [&](const wire::StateFrame& state) {
        session->steer({.ahead = 127, .turn = 127});
        return glm::distance(state.eye.positionMetres, begin) > 0.5F;
    });
    ASSERT_TRUE(moved);
    EXPECT_LT(moved->eye.positionMetres.z, begin.z);
    EXPECT_LT(ahead(moved->eye).x, -0.05F);
    // No jump between two frames, however far apart they are.
    auto last = *moved;
    float fastest = 0;
    const auto seconds = [](const wire::StateFrame& state) {
        return (static_cast<float>(state.tick.value) - 1 + state.fraction) / 60;
    };
    const auto rested = await(*session, [&](const wire::StateFrame& state) {
        const float metres = glm::distance(state.eye.positionMetres, last.eye.positionMetres);
        const float time = seconds(state) - seconds(last);
        if (time < 0.1F) return false;
        fastest = std::max(fastest, metres / time);
        last = state;
        return metres / time < 0.05F;
    });
    ASSERT_TRUE(rested) << "its last word holds for half a second";
    EXPECT_LT(fastest, 1.3F);
    session->quit();
}

TEST(Visitor, looksIntoTheMindOfAFish) {
    const Master master({});
    const auto session = master.connect();
    const auto admission = session->join();
    ASSERT_TRUE(admission);
    session->prepared(1, config::QualityTier::Low, session::motionOf(*admission));
    session->askMind(0);
    const auto told =
        await(*session, [&](const wire::StateFrame&) { return session->latestMind(); });
    ASSERT_TRUE(told);
    EXPECT_EQ(session->latestMind()->fish, 0U);
    EXPECT_FALSE(session->latestMind()->lines.empty());
    session->quit();
}

}  // namespace
}  // namespace aquarama
