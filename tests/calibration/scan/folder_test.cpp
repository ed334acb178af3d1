// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include <gmock/gmock.h>

#include "calibration/scan/decode.h"
#include "common/base/log.h"
#include "tests/calibration/scan/synthetic_camera.h"

namespace aquarama::scan {
namespace {

namespace fs = std::filesystem;

class FolderTest : public testing::Test {
  protected:
    FolderTest() : rig_{config::readRig(AQUARAMA_SOURCE_DIR "/config/touring.txtpb")} {
        rig_.channels = {rig_.channels[1]};
        fs::remove_all(folder_);
    }
    ~FolderTest() override { fs::remove_all(folder_); }

    void write() {
        SyntheticCamera camera(rig_, {.sizePixels = {64, 40}});
        writeFolder(camera, folder_, rig_);
    }
    void writeAlone(int pictures, glm::ivec2 size = {8, 5}) const {
        fs::create_directories(folder_);
        for (int i = 0; i < pictures; ++i) writeGrey(i, 100, size);
    }
    void writeGrey(int index, std::uint16_t code, glm::ivec2 size = {8, 5}) const {
        const auto codes = static_cast<std::size_t>(3 * size.x * size.y);
        writePng(folder_ + "/" + std::to_string(1000 + index) + ".png",
                 {.sizePixels = size, .bits = 8, .rgb = std::vector<std::uint16_t>(codes, code)});
    }
    [[nodiscard]] std::string refusal() const {
        try {
            const auto source = openFolder(folder_, rig_);
            for (std::size_t i = 0; i < source->scan().pictures.size(); ++i)
                static_cast<void>(source->picture(i));
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    }

    config::Rig rig_;
    const std::string folder_ =
        (fs::temp_directory_path() / ("aquarama_folder_test_" + std::to_string(getpid()))).string();
};

TEST_F(FolderTest, WhatIsWrittenIsReadAgain) {
    write();
    SyntheticCamera camera(rig_, {.sizePixels = {64, 40}});
    const auto source = openFolder(folder_, rig_);
    ASSERT_EQ(source->scan().pictures.size(), camera.scan().pictures.size());
    EXPECT_EQ(source->scan().cameras[0].response, camera.scan().cameras[0].response);
    for (std::size_t i = 0; i < camera.scan().pictures.size(); ++i) {
        EXPECT_EQ(source->scan().pictures[i].pattern, camera.scan().pictures[i].pattern);
        EXPECT_EQ(source->picture(i).rgb, camera.picture(i).rgb);
    }
}

TEST_F(FolderTest, PicturesAloneAreThoseOfTheSequence) {
    write();
    fs::remove(fs::path(folder_) / "scan.txtpb");
    const auto source = openFolder(folder_, rig_);
    const std::vector<config::ScanPattern> sequence = sequenceOf(rig_);
    ASSERT_EQ(source->scan().pictures.size(), sequence.size());
    for (std::size_t i = 0; i < sequence.size(); ++i)
        EXPECT_EQ(source->scan().pictures[i].pattern, sequence[i]);
}

TEST_F(FolderTest, GrayCodesOfOpenCvAreKnownByTheirNumberAndTheirLastPictureByItsBrightness) {
    rig_.channels[0].sizePixels = {1024, 768};
    for (const bool whiteLast : {false, true}) {
        writeAlone(42);
        writeGrey(whiteLast ? 41 : 40, 200);
        const std::vector<config::ScanPicture> pictures =
            openFolder(folder_, rig_)->scan().pictures;
        EXPECT_EQ(pictures[41].pattern.lit, whiteLast ? 1U : 0U);
        EXPECT_EQ(pictures[40].pattern.lit, whiteLast ? 0U : 1U);
        EXPECT_TRUE(pictures[1].pattern.inverse);
        EXPECT_EQ(pictures[20].pattern.kind, config::ScanPattern::Kind::GrayRows);
    }
}

// As cameras and people name them: counted without zeros before, in capitals, with spaces, beside
// what systems leave in folders.
TEST_F(FolderTest, PicturesAreTakenAsPeopleCount) {
    rig_.channels[0].sizePixels = {1024, 768};
    for (const char* style :
         {"%d.PNG", "Scan %d.png", "IMG_%05d (1).Png", "2026-11-25 gray%d.png"}) {
        fs::remove_all(folder_);
        writeAlone(42);
        writeGrey(41, 200);
        for (int i = 0; i < 42; ++i) {
            std::array<char, 64> name{};
            std::snprintf(name.data(), name.size(), style, i + 1);
            fs::rename(folder_ + "/" + std::to_string(1000 + i) + ".png",
                       folder_ + "/" + name.data());
        }
        for (const char* other : {"Thumbs.db", ".DS_Store", "._1.png", "notes.txt", "desktop.ini"})
            std::ofstream(folder_ + "/" + other) << "of a system";
        const auto pictures = openFolder(folder_, rig_)->scan().pictures;
        ASSERT_EQ(pictures.size(), 42U) << style;
        for (int i = 0; i < 42; ++i) {
            std::array<char, 64> name{};
            std::snprintf(name.data(), name.size(), style, i + 1);
            EXPECT_EQ(pictures[static_cast<std::size_t>(i)].file, name.data());
        }
    }
}

TEST_F(FolderTest, WhiteAndBlackMayComeFirst) {
    rig_.channels[0].sizePixels = {1024, 768};
    for (const int white : {0, 1}) {
        writeAlone(42);
        writeGrey(white, 200);
        const auto pictures = openFolder(folder_, rig_)->scan().pictures;
        EXPECT_EQ(pictures[static_cast<std::size_t>(white)].pattern.lit, 1U);
        EXPECT_EQ(pictures[static_cast<std::size_t>(1 - white)].pattern.light, glm::vec3(0));
        EXPECT_EQ(pictures[2].pattern.kind, config::ScanPattern::Kind::GrayColumns);
        EXPECT_EQ(pictures[41].pattern.kind, config::ScanPattern::Kind::GrayRows);
    }
}

TEST_F(FolderTest, ADiskThatChangesTheCaseOfNamesChangesNothing) {
    write();
    fs::rename(fs::path(folder_) / "0005.png", fs::path(folder_) / "0005.PNG");
    EXPECT_EQ(refusal(), "");
}

TEST_F(FolderTest, WhichPictureIsMissingIsSaid) {
    rig_.channels[0].sizePixels = {1024, 768};
    writeAlone(42);
    fs::remove(fs::path(folder_) / "1017.png");
    EXPECT_THAT(
        refusal(),
        testing::HasSubstr("has 41 pictures and no scan.txtpb; there must be 34 (of a scan of "
                           "this rig) or 42 (Gray codes with inverses), or a scan.txtpb; none "
                           "lies between 1016.png and 1018.png"));
    fs::remove_all(folder_);
    fs::create_directories(folder_ + "/capture 0");
    std::ofstream(folder_ + "/capture 0/1.JPG") << "";
    EXPECT_THAT(refusal(), testing::HasSubstr("its folder capture 0 has some: give that"));
    fs::remove_all(folder_);
    write();
    fs::remove(fs::path(folder_) / "0005.png");
    fs::remove(fs::path(folder_) / "0009.png");
    EXPECT_THAT(refusal(), testing::HasSubstr("has no 0005.png and 1 more, which its scan names"));
}

TEST_F(FolderTest, WhatCannotBeUsedIsSaidInOneLine) {
    EXPECT_THAT(refusal(), testing::HasSubstr("cannot be read as a folder"));
    writeAlone(7);
    EXPECT_THAT(refusal(), testing::HasSubstr("has 7 pictures and no scan.txtpb; there must be"));
    fs::remove_all(folder_);
    write();
    fs::remove(fs::path(folder_) / "0005.png");
    EXPECT_THAT(refusal(), testing::HasSubstr("has no 0005.png"));
}

TEST_F(FolderTest, PicturesOfAnotherSizeAreRefused) {
    write();
    fs::copy_file(fs::path(folder_) / "0005.png", fs::path(folder_) / "copy");
    writeAlone(1, {12, 9});
    fs::rename(fs::path(folder_) / "1000.png", fs::path(folder_) / "0007.png");
    EXPECT_THAT(refusal(), testing::HasSubstr("0007.png has 12 x 9 pixels, others have 64 x 40"));
}

TEST_F(FolderTest, AScanWithoutAllPatternsIsNotDecoded) {
    write();
    const auto whole = openFolder(folder_, rig_);
    config::Scan scan = whole->scan();
    std::erase_if(scan.pictures, [](const config::ScanPicture& picture) {
        return picture.pattern.kind == config::ScanPattern::Kind::GrayRows &&
               picture.pattern.step == 2;
    });
    std::ofstream(folder_ + "/scan.txtpb") << config::textOf(scan, {rig_.channels[0].name});
    const auto source = openFolder(folder_, rig_);
    try {
        static_cast<void>(decode(*source, 0, rig_));
        FAIL();
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("complete set of patterns of rows"));
    }
}

}  // namespace
}  // namespace aquarama::scan
