// SPDX-License-Identifier: Apache-2.0
#include "common/cli/outputs.h"

#include <cassert>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <system_error>

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "common/base/files.h"
#include "common/base/log.h"
#include "common/base/output_file.h"

namespace aquarama::cli {

namespace {

namespace fs = std::filesystem;

// Whether the option's path can be written; errors name the option.
template <class Require>
void requireFor(const std::string& option, const std::string& path, const Require& require) {
    if (path.empty()) return;  // not requested
    try {
        require(path);
    } catch (const Error& problem) {
        throw Error(option + " " + problem.what());
    }
}

enum class Output { Shown, Dropped };

// A script that cannot write exits with this value plus the errno.
constexpr int kFirstErrno = 100;

// An argument list for the C library: the given pointers, the words, and a null at the end.
std::vector<char*> pointersTo(std::vector<char*> pointers, std::vector<std::string>& words) {
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    return pointers;
}

// The environment of this process.
std::vector<char*> environmentHere() {
    std::vector<char*> variables;
    for (char** one = environ; *one != nullptr; ++one) variables.push_back(*one);
    return variables;
}

// Starts a program with no signal blocked and waits for its end: its exit status, or -1. The
// variables ("NAME=value") are more of its environment.
int statusOf(const std::string& program,
             std::vector<std::string> arguments,
             Output output,
             std::vector<std::string> variables) {
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    if (output == Output::Dropped)
        for (const int stream : {STDOUT_FILENO, STDERR_FILENO})
            posix_spawn_file_actions_addopen(&files, stream, "/dev/null", O_WRONLY, 0);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    sigset_t none;
    sigemptyset(&none);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK);
    pid_t child = 0;
    const int error =
        posix_spawnp(&child,
                     program.c_str(),
                     &files,
                     &attributes,
                     pointersTo({const_cast<char*>(program.c_str())}, arguments).data(),
                     pointersTo(environmentHere(), variables).data());
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&files);
    int status = 0;
    const bool hasEnded = error == 0 && waitpid(child, &status, 0) == child && WIFEXITED(status);
    return hasEnded ? WEXITSTATUS(status) : -1;
}

std::vector<std::string> pythons() {
    // NOLINTNEXTLINE(concurrency-mt-unsafe): nobody sets it
    if (const char* chosen = std::getenv("AQUARAMA_PYTHON")) return {chosen};
    return {"python3", "/usr/bin/python3"};
}

// Matplotlib keeps its list of fonts in this user's folder, and prints long warnings where it
// cannot.
bool mayKeepFonts() {
    std::error_code none;
    fs::path folder = userFolder("XDG_CONFIG_HOME", ".config").parent_path();
    while (folder.has_relative_path() && !fs::exists(folder, none)) folder = folder.parent_path();
    return access(folder.c_str(), W_OK) == 0;
}

std::string pythonWith(const std::vector<std::string>& modules) {
    std::string imports = "import sys";
    std::string packages;
    for (const std::string& module : modules) {
        imports += ", " + module;
        packages += " python3-" + module;
    }
    for (const std::string& python : pythons())
        if (statusOf(python, {"-c", imports}, Output::Dropped, {}) == 0) return python;
    throw Error("figures are drawn by Python, and no Python 3 with its modules is here; install" +
                packages + " (apt), or name another Python in AQUARAMA_PYTHON");
}

}  // namespace

void requireFolder(const std::string& option, const std::string& folder) {
    requireFor(option, folder, requireWritableFolder);
}

void requireFile(const std::string& option, const std::string& file) {
    requireFor(option, file, requireWritable);
}

std::string findData(const std::string& file) {
    const fs::path program = fs::read_symlink("/proc/self/exe");
    for (fs::path folder = program.parent_path();; folder = folder.parent_path()) {
        for (const fs::path& candidate : {folder / file, folder / "share/aquarama" / file})
            if (fs::is_regular_file(candidate)) return candidate.string();
        if (folder == folder.root_path()) break;
    }
    throw Error(program.string() + ": no " + file + " above it; install it beside the programs");
}

void requirePython(const std::vector<std::string>& modules) {
    static_cast<void>(pythonWith(modules));
}

void runPython(const std::vector<std::string>& modules,
               const std::string& script,
               const std::vector<std::string>& arguments,
               const fs::path& folder) {
    assert(!modules.empty());
    assert(script.ends_with(".py"));
    std::vector<std::string> all{"-B", findData(script)};  // -B: writes no bytecode
    all.insert(all.end(), arguments.begin(), arguments.end());
    std::cout.flush();
    const TemporaryFolder drawn("figures");
    std::vector<std::string> variables{"AQUARAMA_DRAWN=" + drawn.path().string()};
    if (!mayKeepFonts()) variables.push_back("MPLCONFIGDIR=" + drawn.path().string() + "/fonts");
    const int status = statusOf(pythonWith(modules), all, Output::Shown, variables);
    if (status > kFirstErrno)
        throw Error(drawn.path().string() + ": " + whyNotWritten(status - kFirstErrno) +
                    "; the data of the figures are written");
    if (status != 0) throw Error(all[1] + " failed; its data are written");
    constexpr std::uintmax_t kMostBytes = std::uintmax_t{1} << 28U;
    for (const auto& entry : fs::directory_iterator(drawn.path()))
        if (entry.is_regular_file())
            writeWhole(folder / entry.path().filename(), readWhole(entry.path(), kMostBytes));
}

// A closed output is intended.
void say(const std::string& line) {
    errno = 0;
    std::cout << line << std::endl;
    if (!std::cout && errno != EBADF)
        throw Error("standard output: " + whyNotWritten(errno != 0 ? errno : EIO));
}

}  // namespace aquarama::cli
