// SPDX-License-Identifier: Apache-2.0
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <span>

#include <gtest/gtest.h>
#include <unistd.h>

#include "common/base/log.h"
#include "common/config/text_file.h"
#include "common/formats/archive.h"
#include "console/files_of_show.h"
#include "tests/support/source_folder.h"

namespace aquarama::console {
namespace {

namespace fs = std::filesystem;

class FilesTest : public testing::Test {
  protected:
    FilesTest()
        : folder_{fs::temp_directory_path() / ("aquarama-files-" + std::to_string(getpid()))} {
        fs::create_directories(folder_);
    }
    ~FilesTest() override { fs::remove_all(folder_); }
    fs::path write(const std::string& name, const std::string& text) {
        std::ofstream(folder_ / name) << text;
        return folder_ / name;
    }
    fs::path folder_;
};

TEST_F(FilesTest, theArchiveHasLogsAndRigAndWhatTheConsoleKnows) {
    setenv("XDG_STATE_HOME", folder_.c_str(), 1);
    const std::string rig = write("hall.txtpb", "name: \"hall\"\n").string();
    fs::create_directories(logOf(rig).parent_path());
    constexpr std::size_t kMostBytes = std::size_t{8} << 20U;
    std::ofstream(logOf(rig)) << std::string(kMostBytes, 'x') << "\nthe last line\n";
    std::ofstream(logOf(rig).string() + ".1") << "before\n";
    const std::string bytes = bundleOf(rig, {{"events.txt", "one\n"}, {"empty.txt", ""}});
    formats::Archive archive(std::as_bytes(std::span{bytes}), "the archive");
    const auto textOf = [&](const std::string& name) {
        const auto content = archive.read(name);
        return std::string(reinterpret_cast<const char*>(content.data()), content.size());
    };
    EXPECT_EQ(archive.names(),
              (std::vector<std::string>{
                  "events.txt", "empty.txt", "log/hall.jsonl", "log/hall.jsonl.1", "hall.txtpb"}));
    EXPECT_EQ(textOf("events.txt"), "one\n");
    EXPECT_EQ(textOf("empty.txt"), "");
    EXPECT_EQ(textOf("log/hall.jsonl"), "the last line\n") << "whole lines of the last 8 MiB";
    EXPECT_EQ(textOf("log/hall.jsonl.1"), "before\n");
    EXPECT_EQ(textOf("hall.txtpb"), "name: \"hall\"\n");
    EXPECT_THROW(static_cast<void>(bundleOf(rig, {{"hall.txtpb", "twice"}})), Error);
}

TEST_F(FilesTest, aLogIsFilteredAndWhatIsNoLineOfItIsLeftOut) {
    const fs::path log =
        write("log.jsonl",
              R"({"time":"t1","node":"left","frame":7,"severity":"info","text":"showing"})"
              "\nno json\n[1,2]\n{\"node\":5,\"frame\":\"x\"}\n"
              R"({"time":"t2","node":"right","frame":8,"severity":"warning","text":"too slow"})"
              "\n{\"cut");
    browser::Look look;
    EXPECT_EQ(tailOf(log, look).rows_size(), 3);
    EXPECT_EQ(tailOf(log, look).rows(0).frame(), 7U);
    look.set_log_node("right");
    ASSERT_EQ(tailOf(log, look).rows_size(), 1);
    EXPECT_EQ(tailOf(log, look).rows(0).text(), "too slow");
    look.set_log_text("fast");
    EXPECT_EQ(tailOf(log, look).rows_size(), 0);
    look.clear_log_node();
    look.clear_log_text();
    look.set_log_problems_only(true);
    EXPECT_EQ(tailOf(log, look).rows_size(), 2) << "what has no severity is no information";
    EXPECT_NE(tailOf(folder_ / "none.jsonl", look).problem(), "");
}

TEST_F(FilesTest, onlyTheEndOfALongLogIsReadFromTheBeginningOfALine) {
    std::string text;
    for (int i = 0; i < 40'000; ++i)
        text += R"({"node":"left","severity":"info","text":"line )" + std::to_string(i) + "\"}\n";
    const auto tail = tailOf(write("long.jsonl", text), {});
    ASSERT_EQ(tail.rows_size(), 300);
    EXPECT_EQ(tail.rows(299).text(), "line 39999");
    EXPECT_EQ(tail.rows(0).text(), "line 39700");
}

TEST_F(FilesTest, whatWasKeptOfACalibrationIsReadWithItsFiguresAndDriftsLastLook) {
    std::string rig = config::readTextFile(test::sourceFolder() + "/config/desk.txtpb");
    const std::string path = write("desk.txtpb", rig).string();
    EXPECT_EQ(calibrationsOf(path).file(), "");
    write("desk.txtpb", rig + "calibration: \"hall.mpcdi\"\n");
    EXPECT_EQ(calibrationsOf(path).file(), "hall.mpcdi");
    fs::create_directories(folder_ / "hall.history");
    write("hall.mpcdi", "second");
    write("hall.history/2026-01-24T210301.mpcdi", "first");
    write("hall.history/2026-02-24T210301.mpcdi", "second");
    write("hall.history/2026-01-24T210301.json",
          R"({"verdict":"warn","cause":"a lamp","overlap_rms_px":0.5,"overlap_max_px":"x"})");
    write("hall.history/2026-02-24T210301.json", "{cut");
    write("hall.drift.last.json",
          R"({"looked":"2026-03-01T05:00:20Z","channels":[{"name":"left","verdict":"moved"},7]})");
    const browser::Calibrations list = calibrationsOf(path);
    EXPECT_EQ(list.problem(), "");
    ASSERT_EQ(list.kept_size(), 2);
    EXPECT_TRUE(list.kept(0).in_use());
    EXPECT_EQ(list.kept(0).verdict(), "");
    EXPECT_EQ(list.kept(1).cause(), "a lamp");
    EXPECT_FLOAT_EQ(list.kept(1).overlap_rms_px(), 0.5F);
    EXPECT_FLOAT_EQ(list.kept(1).overlap_max_px(), 0);
    ASSERT_EQ(list.drift().channels_size(), 2);
    EXPECT_EQ(list.drift().channels(0).verdict(), "moved");
    write("desk.txtpb", "nonsense");
    EXPECT_NE(calibrationsOf(path).problem(), "");
}

TEST_F(FilesTest, eventsAreThereAgainAfterAStart) {
    {
        EventBook book(folder_ / "events.jsonl");
        book.add("Anna", "black on");
        book.add("wall", "\xff is no text");
        for (int i = 0; i < 300; ++i) book.add("wall", std::to_string(i));
        EXPECT_EQ(book.list().events_size(), 200);
    }
    const EventBook again(folder_ / "events.jsonl");
    EXPECT_EQ(again.list().events_size(), 200);
    EXPECT_EQ(again.list().events(0).what(), "299");
}

}  // namespace
}  // namespace aquarama::console
