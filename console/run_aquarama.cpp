// SPDX-License-Identifier: Apache-2.0
#include "console/run_aquarama.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <string_view>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "common/cli/command_line.h"

namespace aquarama::console {

namespace {

namespace fs = std::filesystem;

// All that comes until the other end is closed, a megabyte at most.
std::string readUntil(int pipe, std::chrono::steady_clock::time_point end) {
    constexpr std::size_t kMostBytes = 1U << 20U;
    std::string text;
    std::array<char, 4096> part{};
    while (text.size() < kMostBytes && std::chrono::steady_clock::now() < end) {
        pollfd waiting{pipe, POLLIN, 0};
        if (poll(&waiting, 1, 200) <= 0) continue;
        const ssize_t count = read(pipe, part.data(), part.size());
        if (count <= 0) break;
        text.append(part.data(), static_cast<std::size_t>(count));
    }
    return text;
}

// As a C library takes them: pointers, and null after the last.
std::vector<char*> pointersTo(std::vector<std::string>& words) {
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    return pointers;
}

// Of this process, but for the pipe of its supervisor, to whom the program's errors are no news.
std::vector<std::string> environmentOfOthers() {
    const std::string left = std::string(cli::kErrorPipeVariable) + "=";
    std::vector<std::string> variables;
    for (char** one = environ; *one != nullptr; ++one)
        if (!std::string_view(*one).starts_with(left)) variables.emplace_back(*one);
    return variables;
}

// The program `aquarama`, which stands beside this one; -1 where it cannot be started. Without a
// shell: no name of a file is read as a command.
pid_t startAquarama(std::vector<std::string> arguments, int output, bool withErrors) {
    const fs::path program = fs::read_symlink("/proc/self/exe").parent_path() / "aquarama";
    arguments.insert(arguments.begin(), program.string());
    std::vector<std::string> variables = environmentOfOthers();
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
    if (withErrors) posix_spawn_file_actions_adddup2(&actions, output, STDERR_FILENO);
    pid_t child = -1;
    const int failed = posix_spawn(&child,
                                   program.c_str(),
                                   &actions,
                                   nullptr,
                                   pointersTo(arguments).data(),
                                   pointersTo(variables).data());
    posix_spawn_file_actions_destroy(&actions);
    return failed == 0 ? child : -1;
}

}  // namespace

// To its end, or to the end of its minute.
Said runAquarama(std::vector<std::string> arguments, bool withErrors) {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) return {};
    const pid_t child = startAquarama(std::move(arguments), ends[1], withErrors);
    close(ends[1]);
    Said said;
    if (child > 0) {
        said.text = readUntil(ends[0], std::chrono::steady_clock::now() + std::chrono::minutes(1));
        kill(child, SIGTERM);
        int status = 0;
        if (waitpid(child, &status, 0) == child && WIFEXITED(status))
            said.status = WEXITSTATUS(status);
    }
    close(ends[0]);
    return said;
}

std::string lastLineOf(const Said& said, const char* otherwise) {
    const std::vector<std::string> lines = linesOf(said.text);
    return lines.empty() ? otherwise : lines.back();
}

std::vector<std::string> linesOf(const std::string& text) {
    std::vector<std::string> lines;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        lines.push_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    return lines;
}

}  // namespace aquarama::console
