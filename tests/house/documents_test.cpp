// SPDX-License-Identifier: Apache-2.0
// What the documents refer to is there: files, headings, pictures; and each picture is drawn by
// docs/draw_pictures.sh.
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace aquarama {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = AQUARAMA_SOURCE_DIR;

std::string textOf(const fs::path& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
}

// All of the tree's, by their path from the root.
std::vector<fs::path> documents() {
    std::vector<fs::path> found;
    for (const auto& entry : fs::directory_iterator(kRoot))
        if (entry.path().extension() == ".md") found.push_back(entry.path().filename());
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / "docs"))
        if (entry.path().extension() == ".md") found.push_back(fs::relative(entry.path(), kRoot));
    return found;
}

std::vector<std::string> matches(const std::string& text, const std::string& pattern) {
    const std::regex wanted(pattern);
    std::vector<std::string> found;
    for (std::sregex_iterator match(text.begin(), text.end(), wanted), end; match != end; ++match)
        found.push_back((*match)[1]);
    return found;
}

// As GitHub makes it of a heading.
std::string anchorOf(const std::string& heading) {
    std::string anchor;
    for (const char letter : heading) {
        const auto code = static_cast<unsigned char>(letter);
        if (std::isalnum(code) != 0 || letter == '-' || letter == '_')
            anchor += static_cast<char>(std::tolower(code));
        else if (letter == ' ')
            anchor += '-';
    }
    return anchor;
}

bool hasHeading(const fs::path& document, const std::string& anchor) {
    std::istringstream lines(textOf(document));
    for (std::string line; std::getline(lines, line);) {
        const std::size_t text = line.find_first_not_of('#');
        if (text == 0 || text == std::string::npos || line[text] != ' ') continue;
        if (anchorOf(line.substr(text + 1)) == anchor) return true;
    }
    return false;
}

TEST(Documents, noMergeIsLeftHalfDone) {
    for (const fs::path& document : documents()) {
        const std::string text = "\n" + textOf(kRoot / document);
        for (const char* marker : {"\n<<<<<<< ", "\n>>>>>>> "})
            EXPECT_EQ(text.find(marker), std::string::npos)
                << document << " has a mark of a merge: choose a side";
    }
}

TEST(Documents, linksLeadToWhatIsThere) {
    std::size_t count = 0;
    for (const fs::path& document : documents()) {
        for (const std::string& link : matches(textOf(kRoot / document), R"(\]\(([^)\s]+)\))")) {
            if (link.find("://") != std::string::npos) continue;
            ++count;
            const std::size_t hash = std::min(link.find('#'), link.size());
            const fs::path file =
                hash == 0 ? document : document.parent_path() / link.substr(0, hash);
            EXPECT_TRUE(fs::exists(kRoot / file)) << document << " links to " << link;
            if (hash < link.size()) {
                EXPECT_TRUE(hasHeading(kRoot / file, link.substr(hash + 1)))
                    << document << " links to " << link << ", a heading that is not there";
            }
        }
    }
    EXPECT_GT(count, 100U) << "no links were read";
}

// Decisions are of their day: what they name may have gone.
TEST(Documents, filesThatAreNamedAreThere) {
    const std::string top = "common|master|render_node|calibration|config|tests|docs|packaging";
    const std::string pattern = "`((?:" + top + R"()/[A-Za-z0-9_./-]+)`)";
    const std::string plainPattern = R"(\b(docs/[a-z0-9_/-]+\.md)\b)";
    for (const fs::path& document : documents()) {
        if (document.parent_path() == "docs/decisions" || document == "CHANGELOG.md") continue;
        const std::string text = textOf(kRoot / document);
        std::vector<std::string> named = matches(text, pattern);
        std::ranges::copy(matches(text, plainPattern), std::back_inserter(named));
        for (const std::string& path : named) {
            if (path.find("NAME") != std::string::npos) continue;  // the reader's own
            const fs::path file = kRoot / path;
            EXPECT_TRUE(fs::exists(file) || fs::exists(file.string() + ".h"))
                << document << " names " << path;
        }
    }
}

TEST(Documents, eachPictureIsShownAndDrawn) {
    std::set<std::string> shown;
    for (const fs::path& document : documents())
        for (const std::string& picture :
             matches(textOf(kRoot / document), R"(!\[[^\]]*\]\([^)\s]*pictures/([^)\s]+)\))"))
            shown.insert(picture);
    const std::string script = textOf(kRoot / "docs/draw_pictures.sh");
    std::set<std::string> drawn;
    for (const std::string& picture : matches(script, R"(\n\s*\[([a-z_0-9]+\.[a-z]+)\]=)"))
        drawn.insert(picture);
    std::set<std::string> kept;
    for (const auto& entry : fs::directory_iterator(kRoot / "docs/pictures"))
        kept.insert(entry.path().filename());
    EXPECT_EQ(kept, shown) << "pictures in docs/pictures, and those that a document shows";
    EXPECT_EQ(kept, drawn) << "pictures in docs/pictures, and those that the script draws";
}

}  // namespace
}  // namespace aquarama
