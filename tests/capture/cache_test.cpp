// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <fstream>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture/repertoire_files.h"
#include "capture/report/report_data.h"
#include "common/base/log.h"
#include "common/config/text_file.h"
#include "common/motion/repertoire.h"
#include "tests/support/scad.h"

namespace aquarama::capture {
namespace {

namespace fs = std::filesystem;

class RepertoireCache : public testing::Test {
  protected:
    void SetUp() override {
        fs::remove_all(folder_);
        text_ = config::readTextFile(test::kScadFile);
    }
    void TearDown() override { fs::remove_all(folder_); }

    // Returns whether it was simulated.
    bool fetch() {
        bool simulated = false;
        const RepertoireFile file = repertoiresFor({config::parseSpecies(text_, "scad")},
                                                   {.own = folder_, .shipped = shipped_},
                                                   {.progress = [&](double) { simulated = true; }})
                                        .front();
        bytes_ = file.bytes;
        error_ = file.error;
        return simulated;
    }
    [[nodiscard]] std::vector<fs::path> files() const {
        return {fs::directory_iterator(folder_), fs::directory_iterator()};
    }

    fs::path folder_ = fs::path(testing::TempDir()) / "aquarama_repertoire_cache";
    fs::path shipped_ = {};
    std::string text_;
    std::vector<std::byte> bytes_;
    std::string error_;
};

TEST_F(RepertoireCache, capturesOnceAndKeepsOneFile) {
    EXPECT_TRUE(fetch());
    const auto first = bytes_;
    EXPECT_FALSE(fetch());
    EXPECT_EQ(bytes_, first);
    EXPECT_EQ(files().size(), 1U);

    shipped_ = std::exchange(folder_, folder_ / "own");
    EXPECT_FALSE(fetch()) << "it came with the programs";
    EXPECT_EQ(bytes_, first);
    EXPECT_FALSE(fs::exists(folder_)) << "nothing is copied";
    folder_ = std::exchange(shipped_, {});

    const auto change = [this](const std::string& from, const std::string& to) {
        text_.replace(text_.find(from), from.size(), to);
    };
    change("fin_drag: 1 ", "fin_drag: 1.1 ");
    EXPECT_TRUE(fetch()) << "an animal that swims otherwise is captured anew";
    EXPECT_EQ(files().size(), 2U);

    text_ += "# another word\n";
    change("appetite_particles: 4", "appetite_particles: 5");
    change("blue: 0.79", "blue: 0.78");
    EXPECT_FALSE(fetch()) << "habits, colours and comments move no fin";
}

TEST_F(RepertoireCache, aDamagedFileIsCapturedAnew) {
    EXPECT_TRUE(fetch());
    const auto whole = bytes_;
    fs::resize_file(files().front(), 1000);
    EXPECT_TRUE(fetch());
    EXPECT_EQ(bytes_, whole);
    EXPECT_FALSE(fetch());
}

TEST_F(RepertoireCache, aFolderThatCannotBeWrittenOnlyCostsTime) {
    std::ofstream(folder_).put('x');  // a file where the folder should be
    std::string warning;
    setLogListener([&](Severity, const std::string& line) { warning += line; });
    EXPECT_TRUE(fetch());
    EXPECT_TRUE(fetch());
    setLogListener({});
    EXPECT_EQ(error_, "");
    EXPECT_FALSE(bytes_.empty());
    EXPECT_THAT(warning, testing::HasSubstr(folder_.string()));
    EXPECT_EQ(warning.find(folder_.string()), warning.rfind(folder_.string())) << "said once";
}

TEST(Inspection, namesSpeciesDigestAndSegments) {
    std::vector<std::byte> bytes = motion::encodeRepertoire(test::scadRepertoire());
    const std::string text = report::inspectRepertoire(bytes, "scad.aqrep");
    for (const char* word : {"bigeye_scad", "sha256", "forward_fast", "turn_right_sharp"})
        EXPECT_NE(text.find(word), std::string::npos) << word;
    bytes[bytes.size() / 2] ^= std::byte{1};
    EXPECT_THROW(static_cast<void>(report::inspectRepertoire(bytes, "scad.aqrep")), Error);
}

TEST(SpeciesFiles, areFoundByNameByPathOrAll) {
    const fs::path config = AQUARAMA_SOURCE_DIR "/config";
    EXPECT_EQ(speciesFiles({"bigeye_scad"}, config).front(), fs::path(test::kScadFile));
    EXPECT_EQ(speciesFiles({test::kScadFile}, config).front(), fs::path(test::kScadFile));
    EXPECT_FALSE(speciesFiles({}, config).empty());
    EXPECT_THROW(static_cast<void>(speciesFiles({"mermaid"}, config)), Error);
    EXPECT_THROW(static_cast<void>(speciesFiles({}, "/nowhere")), Error);
}

}  // namespace
}  // namespace aquarama::capture
