// SPDX-License-Identifier: Apache-2.0
// Cameras without a camera: a filter graph of FFmpeg, a program that answers as gphoto2 does, and a
// wall and a lens of formulas.
#include "calibration/scan/capture.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "calibration/scan/camera.h"
#include "calibration/scan/camera_controls.h"
#include "common/base/files.h"
#include "common/base/log.h"
#include "common/wall/scan_pattern.h"
#include "tests/support/edited_text.h"
#include "tests/support/refusal.h"

namespace aquarama::scan {
namespace {

namespace fs = std::filesystem;
using config::ScanPattern;
using test::refusalOf;
using testing::HasSubstr;

class Folder {
  public:
    Folder() { fs::create_directories(path_); }
    ~Folder() { fs::remove_all(path_); }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    [[nodiscard]] std::string path(const std::string& name = "") const { return path_ / name; }

  private:
    fs::path path_ = fs::temp_directory_path() / ("aquarama-capture-" + std::to_string(getpid()));
};

// Shows by remembering; forgets a channel where it is told to.
class RememberedWall final : public PatternWall {
  public:
    std::uint64_t show(const ScanPattern& pattern) override {
        shown = pattern;
        return frame += 3;
    }
    void confirm() override {
        if (losses-- > 0) throw Error("not shown by left");
    }
    ScanPattern shown;
    std::uint64_t frame = 100;
    int losses = 0;
};

// A lens on channel 0 of that wall. Light in seconds of white: at `clipsAt` it is full.
class FormulaCamera final : public Camera {
  public:
    explicit FormulaCamera(const RememberedWall& wall) : wall_{wall} {}
    [[nodiscard]] ExposureRange exposures() const override { return range; }
    [[nodiscard]] Picture take(double exposureSeconds) override {
        constexpr glm::ivec2 kSize{64, 32};
        ++count;
        Light light = darkness(kSize);
        for (int y = 0; y < kSize.y; ++y)
            for (int x = 0; x < kSize.x; ++x)
                light.at(x, y) = wall::scanLight(wall_.shown, 0, kSize, {x, y}) *
                                 static_cast<float>(exposureSeconds / clipsAt);
        return pictureOf(light, 8, isStill ? 0U : static_cast<std::uint32_t>(count));
    }
    ExposureRange range{1e-3, 1};
    double clipsAt = 0.1;
    bool isStill = false;
    int count = 0;

  private:
    const RememberedWall& wall_;
};

std::vector<ScanPattern> shortSequence() {
    return {{.kind = ScanPattern::Kind::Room, .number = 1},
            {.lit = 0, .number = 2},
            {.lit = 1, .number = 3},
            {.kind = ScanPattern::Kind::GrayColumns, .lit = 1, .number = 4},
            {.step = 1, .lit = 1, .number = 5}};
}

config::Rig desk() {
    return config::parseRig(test::shippedRigText("desk"), "desk");
}

TEST(Capture, writesAPictureOfEachPatternInItsExposure) {
    const Folder folder;
    RememberedWall wall;
    FormulaCamera camera(wall);
    const config::Scan scan = capture(desk(), wall, camera, shortSequence(), folder.path());
    ASSERT_EQ(scan.pictures.size(), 5U);
    const double chosen = scan.pictures.front().exposureSeconds;
    EXPECT_LT(chosen, 0.1) << "white is not clipped";
    EXPECT_GT(chosen, 0.03) << "nor dark";
    EXPECT_NEAR(std::remainder(chosen, 1.0 / desk().timing.refreshHertz), 0, 1e-6);
    EXPECT_NEAR(scan.pictures[3].exposureSeconds, chosen, 1e-9);
    EXPECT_NEAR(scan.pictures[4].exposureSeconds, chosen / 4, 1e-9);
    for (const config::ScanPicture& picture : scan.pictures) {
        EXPECT_GT(picture.frame, 100U);
        EXPECT_EQ(readPng(folder.path(picture.file)).sizePixels, glm::ivec2(64, 32));
    }
    std::vector<std::string> names;
    for (const config::Channel& channel : desk().channels) names.push_back(channel.name);
    const auto bytes = readWhole(folder.path("scan.txtpb"), 1U << 20U);
    const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const config::Scan read = config::parseScan(text, "scan.txtpb", names);
    EXPECT_EQ(read.pictures.size(), scan.pictures.size());
    EXPECT_EQ(read.pictures[4].pattern, scan.pictures[4].pattern);
    EXPECT_EQ(read.pictures[4].frame, scan.pictures[4].frame);
}

TEST(Capture, aChannelThatGoesAndComesCostsAPictureAndOneThatStaysAwayTheScan) {
    const Folder folder;
    RememberedWall wall;
    FormulaCamera camera(wall);
    wall.losses = 2;
    EXPECT_NO_THROW(capture(desk(), wall, camera, shortSequence(), folder.path()));
    wall.losses = 100;
    EXPECT_THAT(refusalOf([&] { capture(desk(), wall, camera, shortSequence(), folder.path()); }),
                HasSubstr("not shown by left"));
}

TEST(Capture, namesWhatIsWrongWithTheCamera) {
    const Folder folder;
    RememberedWall wall;
    FormulaCamera camera(wall);
    const auto problem = [&] {
        return refusalOf([&] { capture(desk(), wall, camera, shortSequence(), folder.path()); });
    };
    camera.clipsAt = 1e-4;
    EXPECT_THAT(problem(), HasSubstr("white is clipped at 0.0010 s"));
    camera.clipsAt = 1000;
    EXPECT_THAT(problem(), HasSubstr("too dark"));
    camera.clipsAt = 0.1;
    camera.range = {1, 1};
    EXPECT_THAT(problem(), HasSubstr("lets no exposure be chosen"));
    camera.range = {1e-3, 1};
    camera.isStill = true;
    std::vector<ScanPattern> twice = shortSequence();
    twice.push_back(twice.back());
    EXPECT_THAT(refusalOf([&] { capture(desk(), wall, camera, twice, folder.path()); }),
                HasSubstr("the same picture again"));
}

// A picture that is brighter with every frame: how many frames a take lets pass.
TEST(Camera, takesAPictureThatBeganAfterItWasAsked) {
    const auto camera =
        openCamera("lavfi:color=black:size=64x32:rate=20,format=gray,geq=lum='mod(N*2,256)'");
    EXPECT_TRUE(camera->exposures().isFixed());
    (void)camera->take(1);  // the first waits for the camera to settle
    const Picture first = camera->take(1);
    const Picture second = camera->take(1);
    EXPECT_EQ(first.sizePixels, glm::ivec2(64, 32));
    EXPECT_EQ(first.bits, 8);
    const int frames = (second.rgb.front() - first.rgb.front()) / 2;
    EXPECT_GE(frames, 2);
    EXPECT_LE(frames, 8);
}

TEST(Camera, thatIsNoneIsNamedAndOneThatEndsToo) {
    EXPECT_THAT(refusalOf([] { (void)openCamera("/dev/video99"); }), HasSubstr("/dev/video99"));
    EXPECT_THAT(refusalOf([] { (void)openCamera("/dev/null"); }), HasSubstr("/dev/null"));
    EXPECT_THAT(refusalOf([] { (void)openCamera("none.mp4"); }), HasSubstr("none.mp4"));
    const auto camera = openCamera("lavfi:color=black:size=64x32:rate=20:duration=0.5");
    EXPECT_THAT(refusalOf([&] {
                    for (int i = 0; i < 20; ++i) (void)camera->take(1);
                }),
                HasSubstr("has ended"));
}

TEST(Camera, aDeviceThatFailsIsToldWithWhatToDo) {
    for (const auto& [error, todo] : std::vector<std::pair<int, const char*>>{
             {ENOENT, "is not there; plug the camera in"},
             {EACCES, "group \"video\""},
             {EBUSY, "is in use; end the program"},
             {ENODEV, "plug it in again"},
             {ENOTTY, "gives no pictures"},
             {EINVAL, "gives no pictures"},
             {ENOMEM, "(Cannot allocate memory); check its name"}})
        EXPECT_THAT(deviceProblem("/dev/video0", error),
                    testing::AllOf(testing::StartsWith("/dev/video0: "), HasSubstr(todo)));
    EXPECT_THAT(deviceProblem("rtsp://10.0.0.9/", ECONNREFUSED),
                HasSubstr("does not answer; check"));
    EXPECT_THAT(refusalOf([] { (void)openCamera("/dev/video99"); }),
                HasSubstr("is not there; plug"));
    EXPECT_THAT(refusalOf([] { (void)openCamera("/dev/null"); }), HasSubstr("gives no pictures"));
    EXPECT_THAT(refusalOf([] { (void)openCamera("none.mp4"); }), HasSubstr("is not there; check"));
}

// As gphoto2 2.5 says them: the cause first, then advice for debugging.
TEST(Camera, theCauseThatGphotoGivesIsQuotedAndNotItsAdvice) {
    const std::string advice =
        "\nFor debugging messages, please use the --debug option.\nDebugging messages may help "
        "finding a solution to your problem.\nIf you intend to send any error or debug messages to "
        "the gphoto\ndeveloper mailing list <...>, please run\ngphoto2 as follows:\n\n    env "
        "LANG=C gphoto2 --debug --debug-logfile=my-logfile.txt --get-config\n\nPlease make sure "
        "there is sufficient quoting around the arguments.\n\n";
    const std::string block =
        "\n*** Error ***              \nCould not claim interface 0 (Device or resource busy).\n";
    const std::string line = "*** Error (-53: 'Could not claim the USB device') ***";
    EXPECT_EQ(gphotoCause(block + line + advice), line);
    EXPECT_EQ(gphotoCause(line + " \r\n" + advice), line);
    EXPECT_EQ(gphotoCause("*** Error: No camera found. ***\n" + advice),
              "*** Error: No camera found. ***");
    EXPECT_EQ(gphotoCause(block + advice),
              "Could not claim interface 0 (Device or resource busy).");
    EXPECT_EQ(gphotoCause("ERROR: Could not capture.\n"), "ERROR: Could not capture.");
    EXPECT_EQ(gphotoCause("a\xE9\x1B[2J\n"), "a\\xE9\\x1B[2J");
    EXPECT_LT(gphotoCause(std::string(10000, 'x')).size(), 300U);
    EXPECT_EQ(gphotoCause(""), "");
}

TEST(Camera, gphotoIsAskedInEnglishAndItsCauseGoesIntoTheError) {
    const Folder folder;
    const std::string path = getenv("PATH");
    setenv("PATH", (folder.path() + ":" + path).c_str(), 1);
    setenv("LC_MESSAGES", "de_DE.UTF-8", 1);
    setenv("LANGUAGE", "de", 1);
    const std::string program = folder.path("gphoto2");
    std::ofstream(program) << "#!/bin/sh\nprintf '*** Error ***\\nCause.\\n*** Error (-53: %s) "
                              "***\\n\\nPlease make sure there is sufficient quoting.\\n' "
                              "\"claim$LC_ALL$LC_MESSAGES$LANGUAGE\" >&2\nexit 1\n";
    fs::permissions(program, fs::perms::owner_all);
    EXPECT_THAT(
        refusalOf([] { (void)openCamera("gphoto2:"); }),
        testing::StartsWith("gphoto2 cannot use the camera (*** Error (-53: claimC) ***); end "
                            "other programs that use it"));
    unsetenv("LC_MESSAGES");
    unsetenv("LANGUAGE");
    setenv("PATH", path.c_str(), 1);
}

// Answers as gphoto2 does, and copies a picture to where it is told.
constexpr const char* kGphoto = R"(#!/bin/sh
case "$*" in
*--get-config*) printf 'Label: Shutter Speed\nType: RADIO\nCurrent: 1/60\n'
    printf 'Choice: 0 bulb\nChoice: 1 30\nChoice: 2 0.5\nChoice: 3 1/60\nChoice: 4 1/4000\nEND\n' ;;
*--capture*) echo "$*" > "$0.said"
    [ -f "$0.png" ] || { echo 'ERROR: Could not capture.'; exit 1; }
    for word; do case "$word" in */picture.%C) cp "$0.png" "${word%\%C}png" ;; esac; done ;;
esac
)";

TEST(Camera, gphoto2TakesAPictureWithTheNearestExposure) {
    const Folder folder;
    const std::string path = getenv("PATH");
    setenv("PATH", folder.path().c_str(), 1);
    EXPECT_THAT(refusalOf([] { (void)openCamera("gphoto2:"); }), HasSubstr("is not installed"));
    setenv("PATH", (folder.path() + ":" + path).c_str(), 1);
    const std::string program = folder.path("gphoto2");
    std::ofstream(program) << kGphoto;
    fs::permissions(program, fs::perms::owner_all);
    const auto camera = openCamera("gphoto2:usb:001,004");
    EXPECT_EQ(camera->exposures().shortest, 1.0 / 4000);
    EXPECT_EQ(camera->exposures().longest, 30);
    EXPECT_THAT(refusalOf([&] { (void)camera->take(0.02); }), HasSubstr("Could not capture"));
    writePng(program + ".png", {{1, 1}, 16, {1, 2, 300}});
    EXPECT_EQ(camera->take(0.02).rgb, (std::vector<std::uint16_t>{1, 2, 300}));
    std::ifstream said(program + ".said");
    const std::string words{std::istreambuf_iterator<char>(said), {}};
    EXPECT_THAT(words, HasSubstr("--port usb:001,004"));
    EXPECT_THAT(words, HasSubstr("shutterspeed=1/60"));
    setenv("PATH", path.c_str(), 1);
}

}  // namespace
}  // namespace aquarama::scan
