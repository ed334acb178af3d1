// SPDX-License-Identifier: Apache-2.0
#include "common/cli/outputs.h"

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <sstream>
#include <system_error>

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "common/base/log.h"

namespace aquarama::cli {

namespace {

namespace fs = std::filesystem;

// Makes the folder and a file in it, which goes again.
std::error_code tryFolder(const fs::path& folder) {
    std::error_code failure;
    fs::create_directories(folder, failure);
    if (failure) return failure;
    std::string probe = (folder / ".aquarama-XXXXXX").string();
    const int file = mkstemp(probe.data());
    if (file < 0) return {errno, std::system_category()};
    close(file);
    unlink(probe.c_str());
    return {};
}

void require(const std::string& option, const std::string& path, const std::error_code& failure) {
    if (failure)
        throw Error(option + " " + path + ": cannot be written (" + failure.message() +
                    "); choose another folder");
}

enum class Output { Shown, Dropped };

// Starts a program with no signal blocked and waits for its end: whether it ended with status 0.
bool succeeds(const std::string& program, std::vector<std::string> arguments, Output output) {
    std::vector<char*> vector{const_cast<char*>(program.c_str())};
    for (std::string& argument : arguments) vector.push_back(argument.data());
    vector.push_back(nullptr);
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
        posix_spawnp(&child, program.c_str(), &files, &attributes, vector.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&files);
    int status = 0;
    return error == 0 && waitpid(child, &status, 0) == child && WIFEXITED(status) &&
           WEXITSTATUS(status) == 0;
}

std::vector<std::string> pythons() {
    // NOLINTNEXTLINE(concurrency-mt-unsafe): nobody sets it
    if (const char* chosen = std::getenv("AQUARAMA_PYTHON")) return {chosen};
    return {"python3", "/usr/bin/python3"};
}

std::string pythonWith(const std::vector<std::string>& modules) {
    std::string imports = "import sys";
    std::string packages;
    for (const std::string& module : modules) {
        imports += ", " + module;
        packages += " python3-" + module;
    }
    for (const std::string& python : pythons())
        if (succeeds(python, {"-c", imports}, Output::Dropped)) return python;
    throw Error("figures are drawn by Python, and no Python 3 with its modules is here; install" +
                packages + " (apt), or name another Python in AQUARAMA_PYTHON");
}

}  // namespace

void requireFolder(const std::string& option, const std::string& folder) {
    if (!folder.empty()) require(option, folder, tryFolder(folder));
}

void requireFile(const std::string& option, const std::string& file) {
    if (file.empty()) return;
    require(option,
            file,
            fs::is_directory(file) ? std::make_error_code(std::errc::is_a_directory)
                                   : tryFolder(fs::absolute(file).parent_path()));
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
               const std::vector<std::string>& arguments) {
    assert(!modules.empty());
    assert(script.ends_with(".py"));
    std::vector<std::string> all{"-B", findData(script)};  // -B: writes no bytecode
    all.insert(all.end(), arguments.begin(), arguments.end());
    std::cout.flush();
    if (!succeeds(pythonWith(modules), all, Output::Shown))
        throw Error(all[1] + " failed; its data are written");
}

bool Progress::isTerminal() {
    return isatty(STDOUT_FILENO) != 0;
}

void Progress::show(std::uint64_t done) {
    using namespace std::chrono_literals;
    const auto now = Clock::now();
    if (now - shown_ < (terminal_ ? 250ms : 10s)) return;
    shown_ = now;
    const double rate =
        static_cast<double>(done) / std::chrono::duration<double>(now - begun_).count();
    std::ostringstream line;
    line << what_ << ' ' << done;
    if (ofAll_ > 0) line << " of " << ofAll_;
    line << std::fixed << std::setprecision(1) << ", " << rate << " a second";
    if (ofAll_ > 0)
        line << std::setprecision(0) << ", "
             << static_cast<double>(ofAll_ - std::min(done, ofAll_)) / rate << " s left";
    std::cout << (terminal_ ? "\r\x1b[K" : "") << line.str() << (terminal_ ? "" : "\n")
              << std::flush;
}

void Progress::end() const {
    if (terminal_) std::cout << "\r\x1b[K" << std::flush;
}

}  // namespace aquarama::cli
