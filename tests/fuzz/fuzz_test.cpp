// SPDX-License-Identifier: Apache-2.0
// Thousands of damaged inputs to every reader, the same ones each time. A reader that crashes or
// breaks its promise ends the program; --gtest_filter with the name of the last test repeats it.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <span>
#include <string>

#include <gtest/gtest.h>

#include "common/base/picture.h"
#include "common/body/side_view.h"
#include "common/enrol/words.h"
#include "common/motion/repertoire.h"
#include "master/simulation/living_world.h"
#include "master/world/world_state.h"
#include "releases/messages.h"
#include "tests/common/formats/sample_walls.h"
#include "tests/common/formats/vendor_samples.h"
#include "tests/common/osc/sample_packets.h"
#include "tests/common/tuio/sample_streams.h"
#include "tests/common/wire/sample_messages.h"
#include "tests/common/wire/sample_recording.h"
#include "tests/drawings/sample_photos.h"
#include "tests/fuzz/mutate.h"
#include "tests/fuzz/targets.h"
#include "tests/support/synthetic_assets.h"
#include "tests/support/synthetic_repertoire.h"

namespace aquarama {
namespace {

using Target = int (*)(const std::uint8_t* bytes, std::size_t size);

FuzzInput inputOf(std::span<const std::byte> bytes) {
    FuzzInput input(bytes.size());
    std::ranges::transform(
        bytes, input.begin(), [](std::byte b) { return static_cast<std::uint8_t>(b); });
    return input;
}

std::vector<FuzzInput> filesIn(const std::string& folder) {
    std::vector<std::filesystem::path> paths;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        if (entry.path().extension() == ".txtpb") paths.push_back(entry.path());
    std::ranges::sort(paths);
    std::vector<FuzzInput> inputs;
    for (const auto& path : paths) {
        std::ifstream file(path, std::ios::binary);
        inputs.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
    }
    return inputs;
}

void feed(Target target, const std::vector<FuzzInput>& seeds, int mutations) {
    ASSERT_FALSE(seeds.empty());
    for (const FuzzInput& seed : seeds) target(seed.data(), seed.size());
    Random random(20261121);
    for (int i = 0; i < mutations; ++i) {
        const FuzzInput input = mutated(seeds, random);
        target(input.data(), input.size());
    }
}

TEST(Fuzz, damagedRepertoiresAreRefusedOrReadWhole) {
    motion::Repertoire repertoire = test::syntheticRepertoire(false);
    std::vector<FuzzInput> seeds{inputOf(motion::encodeRepertoire(repertoire))};
    repertoire.segments[2].controlPoints =
        test::syntheticRepertoire(true).segments[2].controlPoints;
    seeds.push_back(inputOf(motion::encodeRepertoire(repertoire)));
    feed(fuzzRepertoire, seeds, 2000);
}

// Of a machine, of the depot, and of people.
TEST(Fuzz, damagedMessagesOfADepotAreRefusedOrReadWhole) {
    v1::DepotMessage report, order, piece, request;
    releases::write(
        releases::MachineReport{.booted = {"1.0", 10}, .epoch = 5, .held = {{"1.1", 11}}},
        *report.mutable_report());
    releases::write(releases::MachineOrder{.epoch = 5, .run = {"1.0", 10}, .fetch = {"1.1", 11}},
                    *order.mutable_order());
    order.mutable_order()->set_lease_s(60);
    piece.mutable_piece()->set_version("1.1");
    piece.mutable_piece()->set_file("vmlinuz");
    piece.mutable_piece()->set_offset(7);
    piece.mutable_piece()->set_content("kernel");
    request.mutable_request()->set_what(v1::DepotRequest::STAGE);
    request.mutable_request()->set_version("1.1");
    std::vector<FuzzInput> seeds;
    for (const v1::DepotMessage& message : {report, order, piece, request})
        seeds.push_back(inputOf(releases::encode(message)));
    feed(fuzzDepot, seeds, 20'000);
}

TEST(Fuzz, damagedSavesAreRefusedOrCanBeGoneOnFrom) {
    world::World world(simulation::worldOptionsOf(test::syntheticAssets()));
    std::vector<FuzzInput> seeds;
    for (int i = 0; i < 4; ++i) {
        for (int tick = 0; tick < 300; ++tick) world.advance();
        world::WorldState state;
        world.save(state);
        seeds.push_back(inputOf(world::encodeState(state)));
    }
    feed(fuzzSave, seeds, 4000);
}

TEST(Fuzz, damagedKeyframesAndStepsOfTheFishAreRefusedOrPlayable) {
    motion::MotorCommands commands;
    commands.resize(1);
    school::StepMemory memory = school::makeStepMemory({{.first = 0, .last = 1}}, 1);
    const std::vector<motion::FishRecord> fish(1);
    std::vector<FuzzInput> seeds{inputOf(school::encodeKeyframe({7}, fish, commands, memory))};
    feed(fuzzSchool, seeds, 300);
    motion::MotorCommands wanted = commands;
    wanted.action[0] = 5;
    wanted.yawRate[0] = -700;
    const std::vector<school::PlacedFish> placed{{0, fish.front()}};
    feed(fuzzSchool, {inputOf(school::encodeStep({1}, wanted, placed, commands, memory))}, 20000);
}

TEST(Fuzz, damagedSpeciesAreRefusedOrCanBeBuilt) {
    feed(fuzzSpecies, filesIn(AQUARAMA_SOURCE_DIR "/config/species"), 6000);
}

TEST(Fuzz, damagedRigsAreRefusedOrReadWhole) {
    feed(fuzzRig, filesIn(AQUARAMA_SOURCE_DIR "/config"), 6000);
}

TEST(Fuzz, damagedAdjustmentsAreRefusedOrReadWhole) {
    const std::string byHand =
        R"(points { channel: "left" picture { x_px: 12 y_px: 34 } right_px: 1.5 radius_px: 60 }
        masks { panorama { x_px: 1 y_px: 2 } panorama { x_px: 3 y_px: 4 } panorama { x_px: 5 y_px: 9 } }
        blends { channel: "right" with: "left" width_px: 60 })";
    feed(fuzzAdjustments, {inputOf(std::as_bytes(std::span{byHand}))}, 3000);
}

TEST(Fuzz, damagedKeyFilesAreRefusedOrReadWhole) {
    const std::string key = R"(version: 1 rig: "hall" master_address: "tcp://192.168.7.1:7400"
        master_key: "rq:rM>}U?@Lns47E1%kR.o@n%FcmmsL/@{H8]yf7" name: "left" role: NODE
        public_key: "rq:rM>}U?@Lns47E1%kR.o@n%FcmmsL/@{H8]yf7"
        secret_key: "rq:rM>}U?@Lns47E1%kR.o@n%FcmmsL/@{H8]yf7" made: "2026-11-23")";
    feed(fuzzKeys, {inputOf(std::as_bytes(std::span{key}))}, 3000);
}

TEST(Fuzz, damagedScenesAreRefusedOrReadWhole) {
    feed(fuzzScene, filesIn(AQUARAMA_SOURCE_DIR "/config/scenes"), 3000);
    feed(fuzzScene, filesIn(AQUARAMA_SOURCE_DIR "/config/scenes/routines"), 3000);
}

TEST(Fuzz, damagedKeptShowsAreRefusedOrReadWhole) {
    const std::string kept =
        R"(version: 1 scene: "bait_ball" quality: HIGH pattern: GRID black: true freeze: false)";
    feed(fuzzShow, {inputOf(std::as_bytes(std::span{kept}))}, 3000);
}

TEST(Fuzz, damagedHoursAreRefusedOrReadWhole) {
    const std::string hours =
        R"(zone: "Europe/Berlin" open { days: [MONDAY, SUNDAY] from: "10:00" to: "02:00" scene: "reef" quality: "auto" }
           exceptions { date: "2026-12-24" open { from: "12:00" to: "14:00" } }
           projectors { name: "left" address: "192.168.7.21:4352" password: "x" })";
    feed(fuzzHours, {inputOf(std::as_bytes(std::span{hours}))}, 3000);
}

TEST(Fuzz, whatBrowsersSayIsRefusedOrReadWithinBounds) {
    std::vector<FuzzInput> seeds;
    for (
        const std::string text :
        {R"({"look":{"topics":["log","mind"],"channels":["left","right"],"widthPx":480,"logText":"x"}})",
         R"({"command":{"id":"12345678901234567890","run":"7","black":true}})",
         R"({"command":{"id":"1","run":"7","pointAt":{"channel":"left","frame":"12","x":0.5,"y":1e-3}}})",
         R"({"helm":{"ahead":127,"turn":-127}})",
         R"({"command":{"id":"2","run":"7","scan":{"kind":"columns","step":4,"channel":"left"}}})",
         R"({"command":{"id":"3","run":"7","useCalibration":"2026-01-24T210301"}})",
         R"({"command":{"id":"4","run":"7","projector":{"name":"left","power":true}}})",
         R"({"seen":{"channel":2}})"})
        seeds.push_back(inputOf(std::as_bytes(std::span{text})));
    feed(fuzzBrowser, seeds, 20000);
}

TEST(Fuzz, damagedPacketsOfOscAreRefusedOrReadWithinBounds) {
    using namespace test;
    const std::string black = oscMessage("/aquarama/black", "i", oscWord(1));
    const std::string all =
        oscMessage("/a",
                   "ifsTFhdt",
                   oscWord(1) + oscWord(2) + oscText("reef") + oscWord(3) + oscWord(4) +
                       oscWord(5) + oscWord(6) + oscWord(7) + oscWord(8));
    std::vector<FuzzInput> seeds;
    for (const std::string& packet : {black, all, oscBundle({black, oscBundle({all}), black})})
        seeds.push_back(inputOf(std::as_bytes(std::span{packet})));
    feed(fuzzOsc, seeds, 20000);
}

TEST(Fuzz, whatTrackersOfHandsSayIsReadWithinBounds) {
    using namespace test;
    const std::vector<SampleTouch> touches{{7, 0.25F, 0.5F, 1, -2}, {8, 1, 0}};
    std::vector<FuzzInput> seeds;
    for (const std::string& packet : {tuioFrame(3, touches, "tracker"),
                                      tuioFrame(4, touches, "", true),
                                      tuio2Frame(5, touches),
                                      tuio2Frame(6, touches, "tracker", true)})
        seeds.push_back(inputOf(std::as_bytes(std::span{packet})));
    feed(fuzzTuio, seeds, 20000);
}

TEST(Fuzz, whatIsSaidToAWaitingNodeIsReadWithinBounds) {
    using Kind = enrol::Word::Kind;
    std::vector<FuzzInput> seeds;
    for (const enrol::Word& word : {enrol::Word{Kind::Proof, std::string(32, 'p')},
                                    enrol::Word{Kind::KeyFile, "version: 1 name: \"left\""},
                                    enrol::Word{Kind::Taken, ""}})
        seeds.push_back(inputOf(enrol::packetOf(word)));
    feed(fuzzEnrol, seeds, 20000);
}

TEST(Fuzz, whatProjectorsSayIsRefusedOrReadWithinBounds) {
    std::vector<FuzzInput> seeds;
    for (const std::string text : {"PJLINK 1 498e4a67",
                                   "pjlink 0",
                                   "%1POWR=1",
                                   "%1lamp=1234 1 5678 0",
                                   "%2ERST=012000",
                                   "012000",
                                   "1",
                                   "30",
                                   "ERR3"})
        seeds.push_back(inputOf(std::as_bytes(std::span{text})));
    feed(fuzzPjlink, seeds, 20000);
}

TEST(Fuzz, damagedRecordingsAreRefusedOrReadWithinBounds) {
    std::vector<FuzzInput> seeds{inputOf(wire::joined(wire::sampleEntries()))};
    for (const wire::Packet& entry : wire::sampleEntries()) seeds.push_back(inputOf(entry));
    feed(fuzzRecording, seeds, 20000);
}

TEST(Fuzz, damagedWarpFilesOfVendorsAreRefusedOrReadWhole) {
    using namespace formats;
    const SampleVioso channel{.blocks = 4, .flags = 0x20, .blackScale = 0.5F};
    std::vector<FuzzInput> seeds{
        inputOf(sciss()),
        inputOf(sciss({.version = 2, .first = 5, .second = 4, .right = 0.5F})),
        inputOf(vioso({.points = true})),
        inputOf(vioso(
            channel,
            {viosoBitmap(24, false, 99), viosoBitmap(128, true, 0x3e4ccccd), viosoWarp(channel)}))};
    for (const std::string_view text :
         {kScalable, kDomeprojection, kFrustum, kSimcad, kPaulBourke, kObj})
        seeds.push_back(inputOf(bytesOf(text)));
    feed(fuzzVendors, seeds, 40000);
}

TEST(Fuzz, damagedMpcdiFilesAreRefusedOrCanBeWrittenAgain) {
    std::vector<FuzzInput> seeds{
        inputOf(test::bytesOf(test::kManifest)),
        inputOf(formats::encodePfm({.size = {1, 1}, .texels = {{0.25F, 0.5F, 1}}}))};
    for (const formats::Profile profile : {formats::Profile::Screen, formats::Profile::Projector}) {
        formats::WallFile wall = test::sampleWall(profile);
        wall.channels[1].colour = {.response = {{{0, 0.25F, 1}, {0, 1}, {0, 0, 0.5F, 1}}}};
        const std::vector<std::byte> bytes = formats::encodeMpcdi(wall, 2);
        formats::Archive archive(bytes, "a seed");
        seeds.push_back(inputOf(bytes));
        seeds.push_back(inputOf(archive.read("mpcdi.xml")));
    }
    feed(fuzzMpcdi, seeds, 4000);
}

TEST(Fuzz, damagedPicturesOfVisitorsAreRefusedOrReadWithinBounds) {
    const drawings::Photo photo = test::gradient();
    feed(fuzzPhoto,
         {inputOf(test::jpegOf(photo, 80)),
          inputOf(test::pngOf(photo)),
          inputOf(test::webpOf(photo))},
         20000);
}

TEST(Fuzz, whatATakenOverDecoderSaysIsRefusedOrReadWithinBounds) {
    PngPicture skin{.sizePixels = body::kSideTexels, .components = 4, .codes = {}};
    skin.codes.assign(4 * static_cast<std::size_t>(skin.sizePixels.x * skin.sizePixels.y), 128);
    FuzzInput png = inputOf(encodePng(skin, PngMeaning::Srgb));
    const std::string head = "drawing blue_tang " + std::to_string(png.size()) + "\n";
    png.insert(png.begin(), head.begin(), head.end());
    const std::string refused = "refused no_sheet\n";
    feed(fuzzDecoder, {png, inputOf(std::as_bytes(std::span{refused}))}, 80);
}

TEST(Fuzz, damagedPacketsAreRefusedOrReadWhole) {
    std::vector<FuzzInput> seeds;
    for (const wire::Packet& packet : wire::samplePackets()) seeds.push_back(inputOf(packet));
    feed(fuzzWire, seeds, 50000);
}

}  // namespace
}  // namespace aquarama
