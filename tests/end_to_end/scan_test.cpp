// SPDX-License-Identifier: Apache-2.0
// A real master and its nodes, headless: what they show of a scan is what the formulas say, to the
// code, from the frame on that was promised; and the wall is given back.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#ifdef AQUARAMA_HAS_CAMERA
#include "calibration/scan/capture.h"
#endif
#include "calibration/scan/shown_patterns.h"
#include "common/base/log.h"
#include "common/base/picture.h"
#include "common/cli/command_line.h"
#include "common/config/rig.h"
#include "common/net/channels.h"
#include "common/wall/scan_pattern.h"
#include "tests/end_to_end/free_port.h"
#include "tests/support/edited_text.h"

namespace aquarama {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using config::ScanPattern;
using testing::HasSubstr;

// A program of ours, killed with the test.
class Process {
  public:
    explicit Process(std::vector<std::string> words) {
        words.front() = std::string(getenv("AQUARAMA_BIN")) + "/" + words.front();
        std::vector<char*> pointers;
        for (std::string& word : words) pointers.push_back(word.data());
        pointers.push_back(nullptr);
        EXPECT_EQ(posix_spawn(&id_, pointers[0], nullptr, nullptr, pointers.data(), environ), 0);
    }
    ~Process() { end(SIGTERM); }
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;
    void end(int signal) {
        if (id_ == 0) return;
        kill(id_, signal);
        waitpid(std::exchange(id_, 0), nullptr, 0);
    }

  private:
    pid_t id_ = 0;
};

// The frames of a channel as its node gives them to a clip: the newest of them.
class Watched {
  public:
    explicit Watched(const fs::path& socket)
        : socket_{socket}, receiver_{net::bindFrames(socket)}, thread_{[this] { receive(); }} {}
    // A node that has never come is not waited for.
    ~Watched() {
        if (!from(0, 0s)) (void)net::connectFrames(socket_);
        thread_.join();
    }
    Watched(const Watched&) = delete;
    Watched& operator=(const Watched&) = delete;

    // The first that was received of this number or a later one; empty after so long.
    [[nodiscard]] std::optional<net::RawFrame> from(std::uint64_t number,
                                                    std::chrono::seconds patience = 10s) {
        std::unique_lock lock(mutex_);
        const bool came =
            came_.wait_for(lock, patience, [&] { return newest_ && newest_->frame >= number; });
        return came ? newest_ : std::nullopt;
    }

  private:
    void receive() {
        while (auto frame = receiver_->receive()) {
            const std::lock_guard lock(mutex_);
            newest_ = std::move(frame);
            came_.notify_all();
        }
    }
    fs::path socket_;
    std::unique_ptr<net::FrameReceiver> receiver_;
    std::mutex mutex_;
    std::condition_variable came_;
    std::optional<net::RawFrame> newest_;
    std::thread thread_;  // last: it uses the rest
};

// config/NAME.txtpb on ports of its own, its master, and a node for each channel. It draws a grid:
// the first frames of a reef take long.
class Hall {
  public:
    explicit Hall(const std::string& name) {
        fs::create_directories(folder_);
        rig = config::parseRig(rigOnFreePorts(name), name);
        std::ofstream(rigPath()) << rig.text;
        setenv("XDG_STATE_HOME", (folder_ / "state").c_str(), 1);
        master_.emplace(
            std::vector<std::string>{"aquarama", "master", rigPath(), "--pattern", "grid"});
        for (const config::Channel& channel : rig.channels) {
            const fs::path socket = net::frameSocket(folder_, channel.name);
            watched.push_back(std::make_unique<Watched>(socket));
            nodes.push_back(std::make_unique<Process>(
                std::vector<std::string>{"aquarama-node",
                                         channel.name,
                                         "--master",
                                         rig.controlAddress,
                                         "--headless",
                                         "--film",
                                         socket.string(),
                                         "--snapshot",
                                         (folder_ / "pictures").string()}));
        }
        // Repertoires may have to be captured first.
        for (const auto& channel : watched)
            if (!channel->from(1, 120s)) throw std::runtime_error("a channel shows nothing");
    }
    ~Hall() {
        master_.reset();
        nodes.clear();
        watched.clear();
        fs::remove_all(folder_);
    }
    Hall(const Hall&) = delete;
    Hall& operator=(const Hall&) = delete;

    [[nodiscard]] std::string rigPath() const { return (folder_ / "rig.txtpb").string(); }
    [[nodiscard]] scan::ShownOn where(std::chrono::milliseconds patience = 30s) const {
        return {.rig = rigPath(), .master = "", .key = "", .patience = patience};
    }
    [[nodiscard]] std::string folder(const std::string& name) const {
        return (folder_ / name).string();
    }
    // The pictures that the nodes write when the show ends.
    [[nodiscard]] Picture snapshot(const std::string& channel) {
        master_.reset();
        nodes.clear();
        return readPng((folder_ / "pictures" / ("channel-" + channel + ".png")).string());
    }

    config::Rig rig;
    std::vector<std::unique_ptr<Watched>> watched;  // ends with its node
    std::vector<std::unique_ptr<Process>> nodes;

  private:
    fs::path folder_ = fs::temp_directory_path() / ("aquarama-scan-" + std::to_string(getpid()));
    std::optional<Process> master_;
};

// As the formulas have it, in codes.
std::vector<std::uint16_t> expected(const ScanPattern& pattern,
                                    std::size_t channel,
                                    glm::ivec2 size) {
    std::map<float, std::uint16_t> known;  // of its few lights
    const auto codeOf = [&](float light) {
        const auto [at, isNew] = known.try_emplace(light);
        if (isNew)
            at->second = static_cast<std::uint16_t>(
                std::round(255 * srgbFromLinear(static_cast<double>(light))));
        return at->second;
    };
    std::vector<std::uint16_t> codes;
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const glm::vec3 light = wall::scanLight(pattern, channel, size, {x, y});
            for (const float part : {light.r, light.g, light.b}) codes.push_back(codeOf(part));
        }
    return codes;
}

std::size_t differences(const std::vector<std::uint16_t>& some,
                        const std::vector<std::uint16_t>& others) {
    if (some.size() != others.size()) return some.size() + others.size();
    std::size_t count = 0;
    for (std::size_t i = 0; i < some.size(); ++i) count += some[i] != others[i] ? 1 : 0;
    return count;
}

// One of each kind; all lit but the middle one, but for the last two.
std::vector<ScanPattern> someOfEach() {
    using Kind = ScanPattern::Kind;
    return {
        {.kind = Kind::Level, .light = {1, 0.5F, 0.25F}, .lit = 5, .number = 1},
        {.kind = Kind::GrayColumns, .step = 2, .lit = 5, .number = 2730},
        {.kind = Kind::GrayRows, .step = 1, .inverse = true, .lit = 5, .number = 3},
        {.kind = Kind::PhaseColumns, .step = 1, .light = glm::vec3(0.8F), .lit = 7, .number = 4},
        {.kind = Kind::PhaseRows, .step = 3, .lit = 2, .number = 4095, .tagged = false},
        {.kind = Kind::Room, .number = 6},
        {.kind = Kind::GrayColumns, .step = 15, .lit = 7, .number = 7}};
}

TEST(Scan, nodesShowEachPatternToTheCodeFromThePromisedFrameOn) {
    Hall hall("desk");
    scan::ShownPatterns shown(hall.where());
    std::optional<std::uint64_t> last;
    for (const ScanPattern& pattern : someOfEach()) {
        const std::uint64_t frame = shown.show(pattern);
        EXPECT_TRUE(!last || frame > *last);
        last = frame;
        for (std::size_t i = 0; i < hall.rig.channels.size(); ++i) {
            const auto got = hall.watched[i]->from(frame);
            ASSERT_TRUE(got);
            EXPECT_EQ(differences(got->rgb, expected(pattern, i, hall.rig.channels[i].sizePixels)),
                      0U)
                << "pattern " << pattern.number << ", channel " << hall.rig.channels[i].name;
        }
    }
    shown.confirm();
    const ScanPattern tagged = someOfEach().front();
    shown.show(tagged);
    const Picture snapshot = hall.snapshot("left");
    EXPECT_EQ(differences(snapshot.rgb, expected(tagged, 0, snapshot.sizePixels)), 0U);
}

// How a scan fails for want of a node, of patience, or of a master that lets it; empty where it
// does not.
std::string scanProblem(scan::ShownPatterns& shown, const ScanPattern& pattern) {
    try {
        shown.show(pattern);
        return "";
    } catch (const Error& problem) {
        return problem.what();
    }
}

// Of the first channel, once it shows something that has no scan's codes.
bool isGivenBack(Hall& hall, const ScanPattern& pattern) {
    const auto scanned = expected(pattern, 0, hall.rig.channels[0].sizePixels);
    const auto giveUp = std::chrono::steady_clock::now() + 10s;
    std::uint64_t number = 0;
    while (std::chrono::steady_clock::now() < giveUp) {
        const auto frame = hall.watched[0]->from(number + 1);
        if (!frame) return false;
        if (frame->rgb != scanned) return true;
        number = frame->frame;
    }
    return false;
}

#ifdef AQUARAMA_HAS_CAMERA
// Of a camera that sees grey noise.
config::Scan capture(Hall& hall, const std::string& folder, std::size_t patterns) {
    std::vector<ScanPattern> sequence(patterns, {.lit = 7, .number = 1});
    for (std::size_t i = 1; i < patterns; ++i)
        sequence[i] = {.kind = ScanPattern::Kind::GrayColumns,
                       .lit = 7,
                       .number = static_cast<std::uint16_t>(i + 1)};
    return scan::captureShow(hall.rig,
                             hall.where(),
                             "lavfi:color=gray:size=64x48:rate=30,noise=alls=20:allf=t",
                             sequence,
                             hall.folder(folder));
}

// A whole capture, and one that somebody ends in the middle.
void expectCaptures(Hall& hall) {
    const config::Scan scan = capture(hall, "whole", 3);
    ASSERT_EQ(scan.pictures.size(), 3U);
    EXPECT_LT(scan.pictures[0].frame, scan.pictures[1].frame);
    EXPECT_LT(scan.pictures[1].frame, scan.pictures[2].frame);
    for (const config::ScanPicture& picture : scan.pictures)
        EXPECT_TRUE(fs::exists(fs::path(hall.folder("whole")) / picture.file));
    EXPECT_TRUE(fs::exists(fs::path(hall.folder("whole")) / "scan.txtpb"));

    std::jthread hand([] {
        std::this_thread::sleep_for(500ms);
        kill(getpid(), SIGTERM);
    });
    try {
        capture(hall, "broken", 100);
        ADD_FAILURE() << "it went on";
    } catch (const Error& problem) {
        EXPECT_THAT(problem.what(), HasSubstr("the scan was ended"));
    }
    EXPECT_FALSE(fs::exists(fs::path(hall.folder("broken")) / "scan.txtpb"));
}
#else
void expectCaptures(Hall&) {}
#endif

// A capture leaves its pictures, and one that is interrupted leaves the wall.
TEST(Scan, theWallComesBackAndWhoIsMissingIsNamed) {
    cli::holdSignals();
    Hall hall("desk");
    expectCaptures(hall);
    const ScanPattern pattern{.lit = 7, .number = 9};
    {
        scan::ShownPatterns shown(hall.where());
        shown.show(pattern);
        scan::ShownPatterns other(hall.where());
        EXPECT_THAT(scanProblem(other, pattern), HasSubstr("another scan holds the wall"));
        std::this_thread::sleep_for(3500ms);  // longer than the master's patience
        EXPECT_NO_THROW(shown.confirm());
    }
    EXPECT_TRUE(isGivenBack(hall, pattern)) << "at the end";
    scan::ShownPatterns shown(hall.where());
    shown.show(pattern);
    hall.nodes[1]->end(SIGKILL);
    scan::ShownPatterns impatient(hall.where(1s));
    ScanPattern next = pattern;
    next.number = 10;
    shown.giveBack();
    EXPECT_THAT(scanProblem(shown, next), HasSubstr("the scan was ended"));
    EXPECT_TRUE(isGivenBack(hall, pattern)) << "by hand";
    EXPECT_THAT(
        scanProblem(impatient, next),
        testing::AllOf(HasSubstr("pattern 10 is not shown yet by middle"), HasSubstr("after 1 s")));
    EXPECT_THROW(impatient.confirm(), Error);
}

}  // namespace
}  // namespace aquarama
