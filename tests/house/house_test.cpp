// SPDX-License-Identifier: Apache-2.0
// Each folder may include only what docs/architecture.md allows it.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace aquarama {
namespace {

namespace fs = std::filesystem;

struct Inclusion {
    std::string file;      // from the root, "common/wire/encode.cpp"
    std::string included;  // as written between <> or ""
};

std::vector<Inclusion> inclusions() {
    std::vector<Inclusion> all;
    const fs::path root = AQUARAMA_SOURCE_DIR;
    const std::regex include(R"re(^\s*#include\s+[<"]([^>"]+)[>"])re");
    for (const char* top : {"common", "master", "render_node", "calibration"}) {
        for (const auto& entry : fs::recursive_directory_iterator(root / top)) {
            if (entry.path().extension() != ".h" && entry.path().extension() != ".cpp") continue;
            std::ifstream source(entry.path());
            std::smatch match;
            for (std::string line; std::getline(source, line);) {
                if (std::regex_search(line, match, include))
                    all.push_back({fs::relative(entry.path(), root), match[1]});
            }
        }
    }
    return all;
}

bool within(const std::string& file, const std::vector<std::string>& folders) {
    return std::ranges::any_of(folders,
                               [&](const std::string& folder) { return file.starts_with(folder); });
}

// Those who include something that matches `library` from outside `homes`.
std::vector<std::string> strangers(const std::regex& library,
                                   const std::vector<std::string>& homes) {
    std::vector<std::string> found;
    for (const Inclusion& inclusion : inclusions()) {
        if (std::regex_search(inclusion.included, library) && !within(inclusion.file, homes)) {
            found.push_back(inclusion.file + " includes " + inclusion.included);
        }
    }
    return found;
}

TEST(House, theTreeIsRead) {
    EXPECT_GT(inclusions().size(), 100U);
}

TEST(House, zeroMqStaysInNet) {
    EXPECT_EQ(strangers(std::regex("^zmq"), {"common/net/"}), std::vector<std::string>{});
}

TEST(House, protobufStaysInConfigAndWire) {
    const std::vector<std::string> homes{"common/config/", "common/wire/"};
    EXPECT_EQ(strangers(std::regex("google/protobuf|\\.pb\\.h$"), homes),
              std::vector<std::string>{});
}

TEST(House, ffmpegStaysInTheTheatre) {
    EXPECT_EQ(strangers(std::regex("^lib(av|sw)"), {"calibration/theatre/"}),
              std::vector<std::string>{});
}

TEST(House, openGlStaysInTheRenderNode) {
    const std::regex library("^(epoxy|GL|EGL|GLFW)/");
    EXPECT_EQ(strangers(library, {"render_node/"}), std::vector<std::string>{});
}

TEST(House, openSubdivStaysInSkin) {
    EXPECT_EQ(strangers(std::regex("^opensubdiv/"), {"common/skin/"}), std::vector<std::string>{});
}

TEST(House, theThreePartsNeverIncludeOneAnother) {
    for (const char* part : {"master", "render_node", "calibration"}) {
        const std::string folder = std::string(part) + "/";
        EXPECT_EQ(strangers(std::regex("^" + folder), {folder}), std::vector<std::string>{})
            << folder;
    }
}

// What a folder of common may include of the others, from docs/architecture.md; each may always
// include itself.
TEST(House, commonIsLayered) {
    const std::map<std::string, std::vector<std::string>> mayInclude{
        {"common/units/", {}},
        {"common/files/", {"common/units/"}},
        {"common/config/", {"common/units/"}},
        {"common/body/", {"common/units/", "common/config/"}},
        {"common/skin/", {"common/units/", "common/body/"}},
        {"common/motion/", {"common/units/", "common/body/"}},
        {"common/place/", {"common/units/", "common/config/"}},
        {"common/wall/", {"common/units/", "common/config/"}},
        {"common/wire/",
         {"common/units/", "common/motion/", "common/body/", "common/wall/", "common/config/"}},
        {"common/net/", {"common/units/", "common/files/"}},
        {"common/cli/", {"common/units/", "common/files/", "common/config/"}},
    };
    for (const Inclusion& inclusion : inclusions()) {
        if (!inclusion.file.starts_with("common/") ||
            !within(inclusion.included, {"common/", "master/", "render_node/", "calibration/"}))
            continue;
        const std::string folder = inclusion.file.substr(0, inclusion.file.find('/', 7) + 1);
        ASSERT_TRUE(mayInclude.contains(folder)) << folder << " is not in docs/architecture.md";
        EXPECT_TRUE(inclusion.included.starts_with(folder) ||
                    within(inclusion.included, mayInclude.at(folder)))
            << inclusion.file << " includes " << inclusion.included;
    }
}

}  // namespace
}  // namespace aquarama
