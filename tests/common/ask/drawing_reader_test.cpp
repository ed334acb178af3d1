// SPDX-License-Identifier: Apache-2.0
// Decoders that hang, fail or lie, which are shell scripts here.
#include "common/ask/drawing_reader.h"

#include <atomic>
#include <chrono>
#include <fstream>
#include <future>

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include "common/base/files.h"

namespace aquarama::ask {
namespace {

using namespace std::chrono_literals;

class ADrawingReader : public testing::Test {
  protected:
    // A decoder of its own.
    std::filesystem::path script(const std::string& text) {
        const auto path = folder_.path() / "decoder";
        std::ofstream(path) << "#!/bin/sh\n" << text << "\n";
        std::filesystem::permissions(path, std::filesystem::perms::owner_all);
        return path;
    }
    // "drawing SPECIES SKIN" or "refused WORD".
    static std::string said(DrawingReader& reader, const std::string& picture) {
        std::promise<std::string> promise;
        const bool isTaken = reader.read(picture, [&](const DrawingOutcome& outcome) {
            const auto* drawing = std::get_if<ReadDrawing>(&outcome);
            promise.set_value(drawing != nullptr
                                  ? "drawing " + drawing->species + ' ' + drawing->skin
                                  : "refused " + std::get<DrawingRefused>(outcome).word);
        });
        return isTaken ? promise.get_future().get() : "not taken";
    }
    std::string said(const std::string& text, double seconds = 60) {
        DrawingReader reader(script(text), seconds);
        return said(reader, std::string(300'000, 'x'));
    }
    TemporaryFolder folder_{"reader"};
};

TEST_F(ADrawingReader, hearsWhatTheDecoderSays) {
    EXPECT_EQ(said("cat >/dev/null; printf 'drawing blue_tang 4\\nskin'"),
              "drawing blue_tang skin");
    EXPECT_EQ(said("printf 'refused no_sheet\\n'"), "refused no_sheet")
        << "before it has heard all";
    EXPECT_EQ(said("printf 'drawing tang 7\\n'; wc -c"), "drawing tang 300000\n") << "all is sent";
}

TEST_F(ADrawingReader, believesNoNonsense) {
    for (const char* const nonsense : {"",
                                       "exit 3",
                                       "kill -9 $$",
                                       "echo",
                                       "printf 'refused no_sheet'",
                                       "printf 'refused ../x\\n'",
                                       "printf 'refused \\n'",
                                       "printf 'drawing tang 5\\nskin'",
                                       "printf 'drawing tang 4x\\nskin'",
                                       "printf 'drawing tang -1\\nskin'",
                                       "printf 'drawing tang 0\\n'",
                                       "printf 'drawing <b> 4\\nskin'",
                                       "printf 'drawing tang\\nskin'",
                                       "printf 'drawing tang 3000000\\n'; yes"})
        EXPECT_EQ(said(nonsense), "refused unreadable") << nonsense;
    DrawingReader none(folder_.path() / "nothing", 60);
    EXPECT_EQ(said(none, "x"), "refused unreadable");
    DrawingReader nowhere{std::filesystem::path()};
    EXPECT_FALSE(nowhere.isInstalled());
    EXPECT_EQ(said(nowhere, "x"), "not taken");
}

TEST_F(ADrawingReader, killsWhoTakesTooLong) {
    const auto file = folder_.path() / "process";
    const auto began = std::chrono::steady_clock::now();
    EXPECT_EQ(said("echo $$ >" + file.string() + "; exec sleep 1000", 0.5), "refused unreadable");
    EXPECT_LT(std::chrono::steady_clock::now() - began, 30s);
    pid_t process = 0;
    std::ifstream(file) >> process;
    ASSERT_GT(process, 0);
    EXPECT_EQ(kill(process, 0), -1) << "it is gone";
    EXPECT_EQ(said("kill -STOP $$", 0.5), "refused unreadable");
}

TEST_F(ADrawingReader, givesTheDecoderNothingOfItsOwn) {
    setenv("AQUARAMA_SECRET", "x", 1);
    EXPECT_EQ(said("test -z \"$AQUARAMA_SECRET\" && printf 'refused no_variables\\n'"),
              "refused no_variables");
    constexpr int kFile = 77;
    ASSERT_EQ(dup2(STDERR_FILENO, kFile), kFile);
    EXPECT_EQ(said("test -e /proc/$$/fd/77 || printf 'refused no_file\\n'"), "refused no_file");
    close(kFile);
}

TEST_F(ADrawingReader, someWaitAndMoreAreNotTaken) {
    std::atomic<int> answers = 0;
    {
        DrawingReader reader(script("exec sleep 1000"), 60);
        const auto read = [&] { return reader.read("x", [&](const auto&) { ++answers; }); };
        for (std::size_t i = 0; i < DrawingReader::kMostWaiting; ++i) EXPECT_TRUE(read());
        EXPECT_FALSE(read());
        EXPECT_FALSE(reader.read(std::string(kMostPictureBytes + 1, 'x'), [](const auto&) {}));
    }
    EXPECT_EQ(answers, 0) << "nobody is told once it ends";
}

}  // namespace
}  // namespace aquarama::ask
