// SPDX-License-Identifier: Apache-2.0
#include "common/base/output_file.h"

#include <array>
#include <csignal>
#include <fstream>
#include <functional>
#include <thread>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "common/base/files.h"
#include "common/base/log.h"

namespace aquarama {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

constexpr uid_t kNobody = 65534;

std::span<const std::byte> bytesOf(std::string_view text) {
    return std::as_bytes(std::span(text.data(), text.size()));
}

std::string contentOf(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

unsigned modeOf(const fs::path& path) {
    struct stat status {};
    stat(path.c_str(), &status);
    return status.st_mode & 07777U;
}

// What the error says; empty where there is none.
std::string errorOf(const std::function<void()>& act) {
    try {
        act();
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

// The exit status of a child that does this as a user who is not root.
int statusAsNobody(const std::function<int()>& act) {
    const pid_t child = fork();
    if (child == 0) {
        if (geteuid() == 0 && (setgid(kNobody) != 0 || setuid(kNobody) != 0)) _exit(99);
        _exit(act());
    }
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

// No file grows past this while it lives: the disk is full then.
class FullAfter {
  public:
    explicit FullAfter(rlim_t bytes) {
        getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit full{.rlim_cur = bytes, .rlim_max = before_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &full);
    }
    ~FullAfter() { setrlimit(RLIMIT_FSIZE, &before_); }
    FullAfter(const FullAfter&) = delete;
    FullAfter& operator=(const FullAfter&) = delete;

  private:
    rlimit before_{};
};

class Outputs : public testing::Test {
  protected:
    Outputs() {
        fs::create_directories(folder_);
        fs::permissions(folder_, fs::perms::all);  // also for nobody
    }
    ~Outputs() override {
        fs::permissions(folder_, fs::perms::all);
        fs::remove_all(folder_);
    }
    [[nodiscard]] std::size_t countOfFiles() const {
        return static_cast<std::size_t>(
            std::distance(fs::directory_iterator(folder_), fs::directory_iterator{}));
    }
    void write(const fs::path& path, std::string_view text) {
        std::ofstream(path, std::ios::binary) << text;
    }
    // As an own descriptor: a pipe of the tests.
    struct Pipe {
        Pipe() { EXPECT_EQ(pipe(ends.data()), 0); }
        ~Pipe() {
            for (const int end : ends) close(end);
        }
        std::array<int, 2> ends{};
    };

    fs::path folder_ = fs::temp_directory_path() / ("aquarama-outputs-" + std::to_string(getpid()));
    fs::path file_ = folder_ / "file.csv";
};

TEST_F(Outputs, aNewFileHasTheUsualModeAndItsFolderIsMade) {
    const mode_t before = umask(027);
    writeWhole(folder_ / "a/b/new.csv", bytesOf("new"));
    umask(before);
    EXPECT_EQ(contentOf(folder_ / "a/b/new.csv"), "new");
    EXPECT_EQ(modeOf(folder_ / "a/b/new.csv"), 0640U);
}

TEST_F(Outputs, aLinkIsFollowedAndKept) {
    fs::create_directory(folder_ / "there");
    write(folder_ / "there/real", "old");
    fs::create_symlink("real", folder_ / "there/second");
    fs::create_symlink("there/second", folder_ / "first");
    writeWhole(folder_ / "first", bytesOf("new"));
    EXPECT_EQ(fs::read_symlink(folder_ / "first"), "there/second");
    EXPECT_FALSE(fs::is_symlink(folder_ / "there/real"));
    EXPECT_EQ(contentOf(folder_ / "there/real"), "new");
}

TEST_F(Outputs, whereADanglingLinkLeadsTheFileIsMade) {
    fs::create_symlink("away/real", folder_ / "link");
    writeWhole(folder_ / "link", bytesOf("new"));
    EXPECT_TRUE(fs::is_symlink(folder_ / "link"));
    EXPECT_EQ(contentOf(folder_ / "away/real"), "new");
}

TEST_F(Outputs, linksInACircleAreNamed) {
    fs::create_symlink("two", folder_ / "one");
    fs::create_symlink("one", folder_ / "two");
    EXPECT_THAT(errorOf([&] { writeWhole(folder_ / "one", bytesOf("new")); }),
                HasSubstr("its links lead in a circle"));
}

TEST_F(Outputs, aPipeIsWrittenInto) {
    ASSERT_EQ(mkfifo(file_.c_str(), 0600), 0);
    std::string read;
    std::jthread reader([&] { read = contentOf(file_); });
    writeWhole(file_, bytesOf("through"));
    reader.join();
    EXPECT_EQ(read, "through");
    EXPECT_TRUE(fs::is_fifo(file_));
    EXPECT_EQ(countOfFiles(), 1U);
}

TEST_F(Outputs, aPipeThatNobodyReadsIsNamedAfterAWhile) {
    ASSERT_EQ(mkfifo(file_.c_str(), 0600), 0);
    EXPECT_THAT(errorOf([&] { writeWhole(file_, bytesOf("new")); }), HasSubstr("nobody reads"));
    EXPECT_TRUE(fs::is_fifo(file_));
}

TEST_F(Outputs, aPipeWhoseReaderGoesIsAnErrorAndNoSignal) {
    ASSERT_EQ(mkfifo(file_.c_str(), 0600), 0);
    std::jthread reader([&] { close(open(file_.c_str(), O_RDONLY)); });
    const std::string more(1U << 20U, 'x');  // than a pipe holds
    EXPECT_THAT(errorOf([&] { writeWhole(file_, bytesOf(more)); }),
                AllOf(HasSubstr(file_.string()), HasSubstr("its reader has ended")));
    EXPECT_TRUE(fs::is_fifo(file_));
}

TEST_F(Outputs, aDescriptorOfTheProcessIsWrittenAsItIs) {
    const Pipe pipe;
    writeWhole("/dev/fd/" + std::to_string(pipe.ends[1]), bytesOf("one"));
    GrowingFile("/proc/self/fd/" + std::to_string(pipe.ends[1])).append("two");
    std::array<char, 10> read{};
    EXPECT_EQ(::read(pipe.ends[0], read.data(), read.size()), 6);
    EXPECT_STREQ(read.data(), "onetwo");
    // Of a file that a shell has opened to append to: nothing in it is lost.
    write(file_, "before,");
    const int file = open(file_.c_str(), O_WRONLY | O_APPEND);
    writeWhole("/dev/fd/" + std::to_string(file), bytesOf("after"));
    close(file);
    EXPECT_EQ(contentOf(file_), "before,after");
}

TEST_F(Outputs, aDeviceStaysOneAndSaysThatItIsFull) {
    fs::create_symlink("/dev/full", file_);
    const std::string said = errorOf([&] { writeWhole(file_, bytesOf("new")); });
    EXPECT_THAT(said, AllOf(HasSubstr(file_.string()), HasSubstr("No space left"), HasSubstr(";")));
    EXPECT_TRUE(fs::is_symlink(file_));
    EXPECT_TRUE(fs::is_character_file("/dev/full"));
    writeWhole("/dev/null", bytesOf("new"));
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(Outputs, aFolderIsNamedAsOne) {
    EXPECT_THAT(errorOf([&] { writeWhole(folder_, bytesOf("new")); }), HasSubstr("name a file"));
    EXPECT_THAT(errorOf([&] { writeWhole(folder_ / "new/", bytesOf("new")); }),
                HasSubstr("name a file"));
}

TEST_F(Outputs, modeAndOwnerOfAFileAreKept) {
    for (const unsigned mode : {0600U, 0664U, 0755U}) {
        write(file_, "old");
        chmod(file_.c_str(), mode);
        const uid_t owner = geteuid() == 0 ? kNobody : geteuid();
        ASSERT_EQ(chown(file_.c_str(), owner, static_cast<gid_t>(-1)), 0);
        writeWhole(file_, bytesOf("new"));
        EXPECT_EQ(contentOf(file_), "new");
        EXPECT_EQ(modeOf(file_), mode);
        struct stat status {};
        stat(file_.c_str(), &status);
        EXPECT_EQ(status.st_uid, owner);
    }
}

TEST_F(Outputs, allNamesOfAFileHaveTheNewContent) {
    write(file_, "old and longer");
    fs::create_hard_link(file_, folder_ / "other");
    writeWhole(file_, bytesOf("new"));
    EXPECT_EQ(contentOf(folder_ / "other"), "new");
    EXPECT_EQ(countOfFiles(), 2U);
}

TEST_F(Outputs, whatIsPrivateIsReadByItsOwnerAlone) {
    writePrivate(file_, bytesOf("secret"));
    EXPECT_EQ(modeOf(file_), 0600U);
    chmod(file_.c_str(), 0644);
    writePrivate(file_, bytesOf("secret"));
    EXPECT_EQ(modeOf(file_), 0600U);
}

TEST_F(Outputs, aNameMayBeAsLongAsTheSystemAllows) {
    const fs::path path = folder_ / std::string(255, 'x');
    writeWhole(path, bytesOf("new"));
    EXPECT_EQ(contentOf(path), "new");
    EXPECT_THAT(errorOf([&] { writeWhole(folder_ / std::string(256, 'x'), bytesOf("new")); }),
                HasSubstr("choose a shorter name"));
}

TEST_F(Outputs, aDiskThatFillsInTheMiddleLeavesTheOldFileAndNoPart) {
    write(file_, "old");
    const FullAfter full(4096);
    const std::string content(5000, 'x');
    EXPECT_THAT(errorOf([&] { writeWhole(file_, bytesOf(content)); }), HasSubstr("File too large"));
    EXPECT_EQ(contentOf(file_), "old");
    // In its place too, as a file with two names is written.
    fs::create_hard_link(file_, folder_ / "other");
    EXPECT_THAT(errorOf([&] { writeWhole(file_, bytesOf(content)); }), HasSubstr("File too large"));
    EXPECT_EQ(contentOf(file_), "old");
    EXPECT_EQ(countOfFiles(), 2U);
}

// Root may write anywhere, so another user does it.
TEST_F(Outputs, aFileInAFolderThatIsReadOnlyIsWrittenInItsPlace) {
    write(file_, "old and longer");
    chmod(file_.c_str(), 0666);
    write(folder_ / "closed", "old");
    chmod((folder_ / "closed").c_str(), 0444);
    fs::permissions(folder_, fs::perms(0555));
    EXPECT_EQ(statusAsNobody([&] {
                  const std::string content(5000, 'x');
                  std::string said = errorOf([&] {
                      const FullAfter full(4096);
                      writeWhole(file_, bytesOf(content));
                  });
                  if (said.find("File too large") == std::string::npos) return 1;
                  if (contentOf(file_) != "old and longer") return 2;
                  requireWritable(file_);
                  writeWhole(file_, bytesOf("new"));
                  if (contentOf(file_) != "new") return 3;
                  for (const char* name : {"closed", "none"}) {
                      const fs::path path = folder_ / name;
                      said = errorOf([&] { writeWhole(path, bytesOf("new")); });
                      if (said.find("Permission denied") == std::string::npos) return 4;
                      if (errorOf([&] { requireWritable(path); }) != said) return 5;
                  }
                  return 0;
              }),
              0);
    EXPECT_EQ(contentOf(folder_ / "closed"), "old");
}

TEST_F(Outputs, aFileOfAnotherUserIsWrittenInItsPlace) {
    if (geteuid() != 0) GTEST_SKIP() << "only root gives files to others";
    write(file_, "old");
    chmod(file_.c_str(), 0666);
    ASSERT_EQ(chown(file_.c_str(), 1, 1), 0);
    for (const unsigned folderMode : {0777U, 01777U}) {  // as any folder, as /tmp
        fs::permissions(folder_, fs::perms(folderMode));
        EXPECT_EQ(statusAsNobody([&] {
                      return errorOf([&] { writeWhole(file_, bytesOf("new")); }).empty() ? 0 : 1;
                  }),
                  0);
        struct stat status {};
        stat(file_.c_str(), &status);
        EXPECT_EQ(status.st_uid, 1U);
        EXPECT_EQ(contentOf(file_), "new");
        EXPECT_EQ(countOfFiles(), 1U);
    }
}

TEST_F(Outputs, partsOfAKilledProcessGoWithTheNextWriteAndNoOthers) {
    write(folder_ / "file.csv.of_mine.part", "");
    OutputFile living(file_);
    const pid_t child = fork();
    if (child == 0) {
        const OutputFile left(file_);
        raise(SIGKILL);
    }
    waitpid(child, nullptr, 0);
    ASSERT_EQ(countOfFiles(), 3U);
    writeWhole(file_, bytesOf("new"));
    EXPECT_EQ(countOfFiles(), 3U);  // the file, mine, the living one's
    living.write(bytesOf("newer"));
    living.finish();
    EXPECT_EQ(contentOf(file_), "newer");
    EXPECT_EQ(countOfFiles(), 2U);
}

TEST_F(Outputs, withoutAnEndTheFileIsAsBefore) {
    write(file_, "old");
    OutputFile(file_).write(bytesOf("new"));
    EXPECT_EQ(contentOf(file_), "old");
    EXPECT_EQ(countOfFiles(), 1U);
}

TEST_F(Outputs, aTrialBeforehandChangesNothing) {
    ASSERT_EQ(mkfifo(file_.c_str(), 0600), 0);
    const int reader = open(file_.c_str(), O_RDONLY | O_NONBLOCK);
    requireWritable(file_);
    pollfd ended{.fd = reader, .events = POLLIN, .revents = 0};
    poll(&ended, 1, 0);
    EXPECT_EQ(ended.revents & POLLHUP, 0) << "the reader has seen an end";
    close(reader);
    write(folder_ / "old", "old");
    requireWritable(folder_ / "old");
    EXPECT_EQ(contentOf(folder_ / "old"), "old");
    requireWritable(folder_ / "new");
    EXPECT_EQ(countOfFiles(), 2U);
    requireWritableFolder(folder_ / "a/b");
    EXPECT_TRUE(fs::is_directory(folder_ / "a/b"));
}

// What is told of them before and after is the same.
TEST_F(Outputs, aTrialBeforehandAgreesWithTheWriter) {
    write(folder_ / "old", "old");
    fs::create_symlink("nowhere", folder_ / "dangling");
    fs::create_symlink("circle", folder_ / "circle");
    fs::create_directory(folder_ / "folder");
    for (const char* name : {"old", "new", "dangling", "circle", "folder", "old/below", "folder/"})
        EXPECT_EQ(errorOf([&] { requireWritable(folder_ / name); }),
                  errorOf([&] { writeWhole(folder_ / name, bytesOf("new")); }))
            << name;
}

TEST_F(Outputs, aGrowingFileIsWholeUpToItsLastEntryOnAFullDisk) {
    GrowingFile file(file_);
    file.append("one\n");
    {
        const FullAfter full(6);
        EXPECT_THAT(errorOf([&] { file.append("two\n"); }), HasSubstr("File too large"));
    }
    EXPECT_FALSE(file.isOpen());
    EXPECT_EQ(contentOf(file_), "one\n");
    file.append("three\n");  // nothing any more
    EXPECT_EQ(contentOf(file_), "one\n");
    GrowingFile again(file_, 2);
    again.append("+");
    again.close();
    EXPECT_EQ(contentOf(file_), "on+");
    GrowingFile(file_, GrowingFile::kAll).append("+");
    EXPECT_EQ(contentOf(file_), "on++");
    EXPECT_EQ(contentOf(file_), "on++");
}

TEST_F(Outputs, aLoopThatLogsTheFirstEntryThatIsLostFailsAtItsEnd) {
    int lines = 0;
    setLogListener([&](Severity severity, const std::string&) {
        if (severity == Severity::Error) ++lines;
    });
    fs::create_symlink("/dev/full", file_);
    GrowingFile file(file_);
    for (int i = 0; i < 5; ++i) file.appendOrLog("entry\n");
    setLogListener({});
    EXPECT_EQ(lines, 1);
    EXPECT_THAT(errorOf([&] { file.close(); }), HasSubstr("No space left"));
    EXPECT_FALSE(GrowingFile().isOpen());
}

TEST_F(Outputs, whatIsOnlyKeptWarnsOnceForAFolder) {
    std::string said;
    int lines = 0;
    setLogListener([&](Severity, const std::string& line) {
        said = line;
        ++lines;
    });
    write(file_, "a file where the folder should be");
    EXPECT_FALSE(keepIfPossible(file_ / "one", bytesOf("x"), "it is made anew"));
    EXPECT_FALSE(keepIfPossible(file_ / "two", bytesOf("x"), "it is made anew"));
    setLogListener({});
    EXPECT_EQ(lines, 1);
    EXPECT_THAT(said, AllOf(HasSubstr((file_ / "one").string()), HasSubstr("it is made anew")));
    EXPECT_TRUE(keepIfPossible(folder_ / "three", bytesOf("x"), ""));
}

TEST_F(Outputs, aFolderIsTrimmedByAgeAndBySize) {
    const auto now = fs::file_time_type::clock::now();
    for (const int hours : {1, 2, 3, 50}) {
        const fs::path path = folder_ / std::to_string(hours);
        write(path, "12345");
        fs::last_write_time(path, now - std::chrono::hours(hours));
    }
    trimFolder(folder_, 1000, std::chrono::hours(48));
    EXPECT_FALSE(fs::exists(folder_ / "50"));
    EXPECT_EQ(countOfFiles(), 3U);
    markUsed(folder_ / "3");
    trimFolder(folder_, 10, std::chrono::hours(48));
    EXPECT_FALSE(fs::exists(folder_ / "2"));
    EXPECT_EQ(countOfFiles(), 2U);
    trimFolder(folder_ / "none", 10, std::chrono::hours(48));
}

// TMPDIR is set for these, so that they meet no other's.
class TemporaryFolders : public Outputs {
  protected:
    TemporaryFolders() { setenv("TMPDIR", folder_.c_str(), 1); }
    ~TemporaryFolders() override { unsetenv("TMPDIR"); }
};

TEST_F(TemporaryFolders, goWithTheirWork) {
    {
        const TemporaryFolder made("clip");
        write(made.path() / "socket", "");
        EXPECT_EQ(modeOf(made.path()), 0700U);
    }
    EXPECT_EQ(countOfFiles(), 0U);
}

TEST_F(TemporaryFolders, ofAKilledProcessGoWithTheNextStartAndNoOthers) {
    fs::create_directory(folder_ / "aquarama-of-mine");
    const TemporaryFolder living("clip");
    const pid_t child = fork();
    if (child == 0) {
        const TemporaryFolder left("study");
        write(left.path() / "data.csv", "");
        raise(SIGKILL);
    }
    waitpid(child, nullptr, 0);
    ASSERT_EQ(countOfFiles(), 3U);
    removeLeftFolders();
    EXPECT_EQ(countOfFiles(), 2U);
    EXPECT_TRUE(fs::exists(living.path()));
}

TEST_F(TemporaryFolders, thatCannotBeMadeAreNamed) {
    setenv("TMPDIR", "/nonexistent", 1);  // then it is /tmp
    EXPECT_EQ(TemporaryFolder("clip").path().parent_path(), "/tmp");
    fs::permissions(folder_, fs::perms(0555));
    setenv("TMPDIR", folder_.c_str(), 1);
    EXPECT_EQ(statusAsNobody([&] {
                  const std::string said = errorOf([] { const TemporaryFolder made("clip"); });
                  return said.find("TMPDIR") != std::string::npos ? 0 : 1;
              }),
              0);
}

}  // namespace
}  // namespace aquarama
