// SPDX-License-Identifier: Apache-2.0
// A hall comes back from its file; a file that was cut or changed, or that leads out of the folder,
// is refused by name.
#include "commands/hall_archive.h"

#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "commands/hall_files.h"
#include "common/base/files.h"
#include "common/base/log.h"
#include "tests/support/refusal.h"

namespace aquarama {
namespace {

namespace fs = std::filesystem;
using formats::ArchiveFile;
using test::refusalOf;
using testing::HasSubstr;
using Bytes = std::vector<std::byte>;

const std::string kDesk = std::string(AQUARAMA_SOURCE_DIR) + "/config/desk.txtpb";

Bytes bytesOf(const std::string& text) {
    const auto bytes = std::as_bytes(std::span(text));
    return {bytes.begin(), bytes.end()};
}

std::string words() {
    return "a fish in a hall";
}

std::string refusalOf(const Bytes& file) {
    return refusalOf([&] { static_cast<void>(decodeHall(file, "hall", &words)); });
}

TravellingHall someHall() {
    return {
        "hall.txtpb",
        {{"hall.txtpb", bytesOf("name: 'hall'")}, {"scenes/reef.txtpb", bytesOf("place: REEF")}},
        {{"keys/left.key", bytesOf("key")}, {"drawings/1.png", bytesOf("png")}}};
}

// The entries of a hall's file.
std::vector<ArchiveFile> entriesOf(const TravellingHall& hall) {
    const Bytes bytes = encodeHall(hall, &words);
    formats::Archive archive(bytes, "hall");
    std::vector<ArchiveFile> entries;
    for (const std::string& name : archive.names()) entries.emplace_back(name, archive.read(name));
    return entries;
}

// The same file with other entries.
Bytes changed(const TravellingHall& hall, const std::function<void(ArchiveFile&)>& change) {
    std::vector<ArchiveFile> entries = entriesOf(hall);
    for (ArchiveFile& entry : entries) change(entry);
    return formats::encodeArchive(entries);
}

TEST(HallArchive, aHallComesBack) {
    const TravellingHall hall = someHall();
    const TravellingHall back = decodeHall(encodeHall(hall, &words), "hall", &words);
    EXPECT_EQ(back.rig, hall.rig);
    EXPECT_EQ(back.files, hall.files);
    EXPECT_EQ(back.secrets, hall.secrets);
}

TEST(HallArchive, withoutSecretsNobodyIsAsked) {
    TravellingHall hall = someHall();
    hall.secrets.clear();
    const auto never = []() -> std::string { throw Error("asked"); };
    EXPECT_EQ(decodeHall(encodeHall(hall, never), "hall", never).files, hall.files);
}

TEST(HallArchive, secretsAreSealed) {
    for (const auto& [name, bytes] : entriesOf(someHall()))
        EXPECT_TRUE(name == "secrets.sealed" || bytes != bytesOf("key")) << name;
    EXPECT_EQ(refusalOf([] {
                  static_cast<void>(decodeHall(
                      encodeHall(someHall(), &words), "hall", [] { return "other words"; }));
              }),
              "hall: the passphrase is wrong; type the one with which it was sealed");
}

TEST(HallArchive, aChangedFileIsRefusedByName) {
    const auto change = [](ArchiveFile& entry) {
        if (entry.first == "files/scenes/reef.txtpb") entry.second = bytesOf("place: OPEN_SEA");
    };
    EXPECT_EQ(refusalOf(changed(someHall(), change)),
              "hall: its entry \"files/scenes/reef.txtpb\" is not as it was sealed; copy or export "
              "it anew");
    std::vector<ArchiveFile> entries = entriesOf(someHall());
    entries.emplace_back("files/more.txtpb", bytesOf("more"));
    EXPECT_THAT(refusalOf(formats::encodeArchive(entries)), HasSubstr("files/more.txtpb"));
    std::erase_if(entries, [](const ArchiveFile& one) { return one.first.starts_with("files/s"); });
    EXPECT_THAT(refusalOf(formats::encodeArchive(entries)), HasSubstr("files/scenes/reef.txtpb"));
}

TEST(HallArchive, whicheverByteIsCutOrChangedItIsOneLine) {
    const Bytes file = encodeHall(someHall(), &words);
    for (std::size_t size = 0; size < file.size(); size += 97) {
        const Bytes cut(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(size));
        EXPECT_NE(refusalOf(cut), "") << size;
        Bytes other = file;
        other[size] ^= std::byte{0x55};
        const std::string refusal = refusalOf(other);
        if (refusal.empty()) {  // a byte that says nothing, as the time of a file
            EXPECT_EQ(decodeHall(other, "hall", &words).files, someHall().files) << size;
        }
        EXPECT_EQ(refusal.find('\n'), std::string::npos);
    }
}

TEST(HallArchive, namesThatLeadOutOfTheFolderAreRefused) {
    TravellingHall hall = someHall();
    hall.secrets.clear();
    for (const std::string to :
         {"files//etc/passwd", "files/./hall", "files/a//b", "elsewhere", "files/a/"}) {
        const auto change = [&](ArchiveFile& entry) {
            if (entry.first == "files/scenes/reef.txtpb") entry.first = to;
        };
        const std::string refusal = refusalOf(changed(hall, change));
        if (to.back() == '/')
            EXPECT_EQ(refusal, "") << "a folder is no file";
        else
            EXPECT_THAT(refusal, HasSubstr("which no hall has")) << to;
    }
    for (const char* const secret : {"keys/a/b", "notes", "drawings/a/../../b"}) {
        hall.secrets = {{secret, bytesOf("x")}};
        EXPECT_NE(refusalOf([&] {
                      static_cast<void>(decodeHall(encodeHall(hall, &words), "hall", &words));
                  }),
                  "")
            << secret;
    }
}

TEST(HallArchive, otherArchivesAndVersionsAreRefused) {
    EXPECT_THAT(refusalOf(formats::encodeArchive({{"mpcdi.xml", bytesOf("<MPCDI/>")}})),
                HasSubstr("is no hall"));
    const auto later = [](ArchiveFile& entry) {
        if (entry.first == "hall.json") entry.second = bytesOf("{\"version\": 2, \"rig\": 3}");
    };
    EXPECT_THAT(refusalOf(changed(someHall(), later)), HasSubstr("is a hall of version 2"));
    const auto lost = [](ArchiveFile& entry) {
        if (entry.first == "hall.json")
            entry.second = bytesOf("{\"version\": 1, \"rig\": \"../x\"}");
    };
    TravellingHall open = someHall();
    open.secrets.clear();
    EXPECT_THAT(refusalOf(changed(open, lost)), HasSubstr("lacks its rig ../x"));
}

// With folders of the user below a folder that is removed after each test.
class HallFiles : public testing::Test {
  protected:
    void SetUp() override {
        setenv("XDG_STATE_HOME", (folder_.path() / "state").c_str(), 1);
        setenv("XDG_CONFIG_HOME", (folder_.path() / "config").c_str(), 1);
    }
    [[nodiscard]] std::string refusalOfPlacing(const TravellingHall& hall) const {
        return refusalOf([&] { static_cast<void>(placeHall(hall, place_, "hall")); });
    }
    const TemporaryFolder folder_{"hall_test"};
    const fs::path place_ = folder_.path() / "rigs";
};

TEST_F(HallFiles, aHallThatCannotBeShownLeavesNothing) {
    TravellingHall hall = readHall(kDesk, false);
    std::erase_if(hall.files,
                  [](const ArchiveFile& one) { return one.first == "species/clownfish.txtpb"; });
    EXPECT_THAT(refusalOfPlacing(hall), HasSubstr("clownfish"));
    EXPECT_TRUE(fs::is_empty(place_));
    hall = readHall(kDesk, false);
    hall.secrets.emplace_back("keys/left.key", bytesOf("no key"));
    EXPECT_THAT(refusalOfPlacing(hall), HasSubstr("hall: keys/left.key:1"));
    EXPECT_TRUE(fs::is_empty(place_));
}

TEST_F(HallFiles, nothingIsReplaced) {
    TravellingHall hall = readHall(kDesk, false);
    hall.secrets.emplace_back("drawings/1.png", bytesOf("png"));
    ASSERT_EQ(refusalOfPlacing(hall), "");
    EXPECT_EQ(refusalOfPlacing(hall),
              place_.string() + ": has files; give an empty or a new folder");
    fs::remove_all(place_);
    EXPECT_THAT(refusalOfPlacing(hall), HasSubstr("has drawings here already"));
    EXPECT_FALSE(fs::exists(place_));
}

}  // namespace
}  // namespace aquarama
