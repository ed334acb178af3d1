// SPDX-License-Identifier: Apache-2.0
// Each folder may include only what docs/architecture.md allows it; no two types share a name.
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

struct SourceFile {
    std::string path;  // from the root
    std::vector<std::string> lines;
};

// All headers and sources of some folders.
std::vector<SourceFile> sourceFilesOf(const std::vector<std::string>& tops) {
    std::vector<SourceFile> all;
    const fs::path root = AQUARAMA_SOURCE_DIR;
    for (const std::string& top : tops) {
        for (const auto& entry : fs::recursive_directory_iterator(root / top)) {
            if (entry.path().extension() != ".h" && entry.path().extension() != ".cpp") continue;
            SourceFile file{fs::relative(entry.path(), root), {}};
            std::ifstream source(entry.path());
            for (std::string line; std::getline(source, line);) file.lines.push_back(line);
            all.push_back(std::move(file));
        }
    }
    return all;
}

// The product's, read once.
const std::vector<SourceFile>& sourceFiles() {
    static const std::vector<SourceFile> all = sourceFilesOf({"common",
                                                              "capture",
                                                              "master",
                                                              "releases",
                                                              "commands",
                                                              "render_node",
                                                              "calibration",
                                                              "console",
                                                              "drawings",
                                                              "guests"});
    return all;
}

std::vector<Inclusion> readInclusions() {
    std::vector<Inclusion> all;
    const std::regex include(R"re(^\s*#include\s+[<"]([^>"]+)[>"])re");
    std::smatch match;
    for (const SourceFile& file : sourceFiles())
        for (const std::string& line : file.lines)
            if (line.find('#') != std::string::npos && std::regex_search(line, match, include))
                all.push_back({file.path, match[1]});
    return all;
}

const std::vector<Inclusion>& inclusions() {
    static const std::vector<Inclusion> all = readInclusions();
    return all;
}

// The types that a file defines for other files to see: at namespace scope, where the formatter
// leaves no indentation, and in no unnamed namespace.
std::vector<std::string> typesOf(const SourceFile& file) {
    const std::regex definition(
        R"re(^(?:struct|class|union|enum(?: class)?) (?:alignas\([^)]*\) )?(\w+)(?!\w|::)[^;]*$)re");
    std::vector<std::string> types;
    bool unnamed = false;
    std::smatch match;
    for (const std::string& line : file.lines) {
        if (line == "namespace {") unnamed = true;
        if (line == "}  // namespace") unnamed = false;
        const bool mayDefine = line.starts_with("struct ") || line.starts_with("class ") ||
                               line.starts_with("union ") || line.starts_with("enum ");
        if (mayDefine && !unnamed && std::regex_search(line, match, definition))
            types.push_back(match[1]);
    }
    return types;
}

// The namespace in which a file defines: the last that it opens, as others are forward declared
// before. Empty where it opens none.
std::string namespaceOf(const SourceFile& file) {
    const std::regex opening(R"re(^namespace (aquarama(?:::[a-z_0-9]+)*))re");
    std::string last;
    std::smatch match;
    for (const std::string& line : file.lines)
        if (line.starts_with("namespace ") && std::regex_search(line, match, opening))
            last = match[1];
    return last;
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
    EXPECT_EQ(namespaceOf({"", {"namespace aquarama::config {", "namespace aquarama::body {"}}),
              "aquarama::body");
    EXPECT_EQ(typesOf({"", {"struct A {", "class B;", "namespace {", "struct C {"}}),
              std::vector<std::string>{"A"});
}

// Two definitions of one qualified name in one program are undefined behaviour that no tool
// reports; two of one simple name in different namespaces confuse a reader.
TEST(House, noTwoTypesShareAName) {
    std::map<std::string, std::string> home;
    for (const SourceFile& file : sourceFiles())
        for (const std::string& type : typesOf(file)) {
            const auto [known, isNew] = home.emplace(type, file.path);
            EXPECT_TRUE(isNew) << type << " is defined in " << known->second << " and in "
                               << file.path << ": rename one of them";
        }
    EXPECT_GT(home.size(), 300U);
}

// Links, pipes, modes, full disks: output_file.h knows what to do with each, and nobody else. The
// one file that is no output is the lock of the derived cache.
TEST(House, filesAreWrittenByOneWriter) {
    const std::regex opens(
        R"re(\b(ofstream|fstream file|fopen|fdopen|freopen|mkstemp|mkdtemp|O_CREAT|O_TRUNC)\b(?!"))re"
        R"re(|\b(avio_open|resize_file)\b(?!")|\b(creat|rename)\()re");
    const std::vector<std::string> writers{"common/base/output_file.cpp",
                                           "common/base/durable.cpp",         // renames only
                                           "common/base/files.cpp",           // temporary folders
                                           "common/base/derived_cache.cpp"};  // its lock
    std::size_t found = 0;
    for (const SourceFile& file : sourceFiles())
        for (const std::string& line : file.lines) {
            const std::string code = line.substr(0, line.find("//"));
            if (!std::regex_search(code, opens)) continue;
            ++found;
            EXPECT_TRUE(within(file.path, writers))
                << file.path << ": " << code
                << ": write it by writeWhole(), OutputFile or GrowingFile";
        }
    EXPECT_GE(found, 3U) << "the writers are not found any more";
}

// Headers of tests meet in the benchmarks' program, where the linker would keep one of two inline
// functions that differ in their return type alone. By name and parameters, as the linker sees
// them.
TEST(House, noTwoTestHeadersDefineOneFunction) {
    const std::regex definition(R"re(^(?:\[\[nodiscard\]\] )?inline [^=(]*?(\w+\([^{]*))re");
    std::map<std::string, std::string> home;
    std::smatch match;
    for (const SourceFile& file : sourceFilesOf({"tests"}))
        for (const std::string& line : file.lines) {
            if (!file.path.ends_with(".h") || line.find("inline ") == std::string::npos ||
                !std::regex_search(line, match, definition))
                continue;
            const std::string function = namespaceOf(file) + "::" + match[1].str();
            const auto [known, isNew] = home.emplace(function, file.path);
            EXPECT_TRUE(isNew || known->second == file.path)
                << function << " is defined in " << known->second << " and in " << file.path;
        }
    EXPECT_GT(home.size(), 50U);
}

TEST(House, aFolderHasOneNamespace) {
    std::map<std::string, std::pair<std::string, std::string>> ofFolder;  // name, first file
    for (const SourceFile& file : sourceFiles()) {
        const std::string name = namespaceOf(file);
        if (name.empty() || file.path.ends_with("/main.cpp")) continue;  // a program's own
        const std::string folder = file.path.substr(0, file.path.rfind('/'));
        const auto& [expected, first] =
            ofFolder.emplace(folder, std::pair{name, file.path}).first->second;
        EXPECT_EQ(name, expected) << file.path << " differs from " << first;
    }
}

TEST(House, zeroMqStaysInNet) {
    EXPECT_EQ(strangers(std::regex("^zmq"), {"common/net/"}), std::vector<std::string>{});
}

TEST(House, prometheusStaysInNet) {
    EXPECT_EQ(strangers(std::regex("^prometheus/"), {"common/net/"}), std::vector<std::string>{});
}

TEST(House, protobufStaysInConfigAndWire) {
    const std::vector<std::string> homes{"common/config/", "common/wire/", "console/", "releases/"};
    EXPECT_EQ(strangers(std::regex("google/protobuf|\\.pb\\.h$"), homes),
              std::vector<std::string>{});
}

// Generated messages are for who speaks to a peer: none reaches the world, the renderer or a header
// that these include.
TEST(House, generatedMessagesStayWithWhoSpeaks) {
    const std::vector<std::string> speakers{"common/wire/",
                                            "common/ask/",
                                            "master/conductor/",
                                            "master/standby/",
                                            "render_node/session/",
                                            "render_node/show/preview.cpp",
                                            "commands/doctor.h",
                                            "console/commands.h",
                                            "console/cues/cue.h",
                                            "console/cues/shown.h",
                                            "console/drawing_book.h",
                                            "console/overview.",
                                            "console/visitors.h",
                                            "guests/deed.h"};
    EXPECT_EQ(strangers(std::regex("^common/wire/messages\\.h$"), speakers),
              std::vector<std::string>{});
    const std::vector<std::string> clients{
        "master/conductor/", "commands/ask_commands.cpp", "commands/doctor_command.cpp"};
    EXPECT_EQ(strangers(std::regex("^master/conductor/status_text\\.h$"), clients),
              std::vector<std::string>{});
    const std::vector<std::string> askers{"common/ask/",
                                          "commands/ask_commands.cpp",
                                          "commands/doctor_command.cpp",
                                          "commands/poweroff_command.cpp",
                                          "commands/tour_command.cpp",
                                          "calibration/scan/shown_patterns.cpp",
                                          "console/commands.cpp",
                                          "console/console.",
                                          "console/show_link.",
                                          "console/touch/touch_command.cpp",
                                          "guests/main.cpp",
                                          "guests/wall_link."};
    EXPECT_EQ(strangers(std::regex("^common/ask/request_client\\.h$"), askers),
              std::vector<std::string>{});
    EXPECT_EQ(
        strangers(std::regex("^render_node/session/(?!session\\.h$)"), {"render_node/session/"}),
        std::vector<std::string>{});
    for (const Inclusion& inclusion : inclusions()) {
        if (inclusion.file != "render_node/session/session.h") continue;
        EXPECT_EQ(inclusion.included.find("render_node/session/"), std::string::npos);
        EXPECT_NE(inclusion.included, "common/wire/messages.h");
    }
}

TEST(House, ffmpegStaysInClipsAndScans) {
    EXPECT_EQ(strangers(std::regex("^lib(av|sw)"), {"calibration/compose/", "calibration/scan/"}),
              std::vector<std::string>{});
}

TEST(House, xmlAndArchivesStayInFormats) {
    EXPECT_EQ(strangers(std::regex("^(pugixml|pugiconfig|zip)\\.h"), {"common/formats/"}),
              std::vector<std::string>{});
}

TEST(House, boostStaysInTheWebServer) {
    EXPECT_EQ(strangers(std::regex("^boost/"), {"common/web/"}), std::vector<std::string>{});
}

TEST(House, curlStaysInTheLease) {
    EXPECT_EQ(strangers(std::regex("^curl/"), {"common/lease/"}), std::vector<std::string>{});
}

TEST(House, avahiStaysInEnrol) {
    EXPECT_EQ(strangers(std::regex("^avahi-"), {"common/enrol/"}), std::vector<std::string>{});
}

TEST(House, libloStaysInOsc) {
    EXPECT_EQ(strangers(std::regex("^lo/"), {"common/osc/"}), std::vector<std::string>{});
}

TEST(House, olaStaysInItsSource) {
    EXPECT_EQ(strangers(std::regex("^ola/"), {"console/cues/ola_source.cpp"}),
              std::vector<std::string>{});
}

TEST(House, jpegStaysInSmallPicturesAndPhotos) {
    EXPECT_EQ(
        strangers(
            std::regex("^(turbojpeg|jpeglib)\\.h"),
            {"render_node/show/preview.cpp", "drawings/photo.cpp", "guests/wall_picture.cpp"}),
        std::vector<std::string>{});
}

TEST(House, cairoAndAprilTagStayInDrawings) {
    EXPECT_EQ(strangers(std::regex("^cairo"), {"drawings/page.cpp"}), std::vector<std::string>{});
    EXPECT_EQ(strangers(std::regex("^apriltag/"), {"drawings/tags.cpp"}),
              std::vector<std::string>{});
}

TEST(House, seccompStaysInOneFile) {
    EXPECT_EQ(strangers(std::regex("^seccomp"), {"drawings/confine.cpp"}),
              std::vector<std::string>{});
}

TEST(House, qrencodeStaysInTheSign) {
    EXPECT_EQ(strangers(std::regex("^qrencode"), {"guests/sign.cpp"}), std::vector<std::string>{});
}

TEST(House, openGlStaysInTheRenderNode) {
    const std::regex library("^(epoxy|GL|EGL|GLFW)/");
    EXPECT_EQ(strangers(library, {"render_node/"}), std::vector<std::string>{});
}

TEST(House, openSubdivStaysInSkin) {
    EXPECT_EQ(strangers(std::regex("^opensubdiv/"), {"common/skin/"}), std::vector<std::string>{});
}

TEST(House, aPartIncludesNoOtherPart) {
    const std::map<std::string, std::vector<std::string>> mayBeIncludedBy{
        {"capture/", {"capture/", "master/", "commands/"}},
        {"master/", {"master/", "commands/"}},
        {"releases/", {"releases/", "commands/"}},
        {"commands/", {"commands/"}},
        {"render_node/", {"render_node/"}},
        {"calibration/", {"calibration/"}},
        {"console/", {"console/"}},
        {"drawings/", {"drawings/"}},
        {"guests/", {"guests/"}},
    };
    for (const auto& [folder, includers] : mayBeIncludedBy)
        EXPECT_EQ(strangers(std::regex("^" + folder), includers), std::vector<std::string>{})
            << folder;
}

// What a folder of common may include of the others, from docs/architecture.md; each may always
// include itself.
TEST(House, commonIsLayered) {
    const std::map<std::string, std::vector<std::string>> mayInclude{
        {"common/base/", {}},
        {"common/machine/", {"common/base/"}},
        {"common/config/", {"common/base/", "common/machine/"}},
        {"common/body/", {"common/base/", "common/config/"}},
        {"common/skin/", {"common/base/", "common/body/"}},
        {"common/motion/", {"common/base/", "common/body/"}},
        {"common/place/", {"common/base/", "common/config/"}},
        {"common/school/", {"common/base/", "common/motion/", "common/place/"}},
        {"common/wall/", {"common/base/", "common/config/", "common/formats/"}},
        {"common/formats/", {"common/base/"}},
        {"common/wire/",
         {"common/base/", "common/motion/", "common/body/", "common/wall/", "common/config/"}},
        {"common/net/", {"common/base/"}},
        {"common/lease/", {"common/base/"}},
        {"common/parts/", {"common/base/"}},
        {"common/osc/", {"common/base/"}},
        {"common/tuio/", {"common/osc/"}},
        {"common/enrol/", {"common/base/", "common/config/", "common/net/"}},
        {"common/ask/", {"common/base/", "common/config/", "common/net/", "common/wire/"}},
        {"common/cli/", {"common/base/"}},
        {"common/web/", {"common/base/"}},
    };
    for (const Inclusion& inclusion : inclusions()) {
        if (!inclusion.file.starts_with("common/") || !within(inclusion.included,
                                                              {"common/",
                                                               "capture/",
                                                               "master/",
                                                               "releases/",
                                                               "commands/",
                                                               "render_node/",
                                                               "calibration/",
                                                               "console/",
                                                               "drawings/",
                                                               "guests/"}))
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
