// SPDX-License-Identifier: Apache-2.0
#include "common/cli/causes.h"

#include <array>
#include <cerrno>
#include <cstdlib>
#include <sstream>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

#include "common/units/log.h"

namespace aquarama::cli {

namespace {

constexpr const char* kVariable = "AQUARAMA_CAUSES";  // the pipe's number, for the children

}  // namespace

Causes::Causes() {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0)
        throw Error("no pipe can be made (" + std::system_category().message(errno) +
                    "); close other programs");
    reading_ = ends[0];
    writing_ = ends[1];
    fcntl(reading_, F_SETFL, O_NONBLOCK);
    fcntl(writing_, F_SETFD, 0);  // the children inherit it
    // NOLINTNEXTLINE(concurrency-mt-unsafe): this process has one thread
    setenv(kVariable, std::to_string(writing_).c_str(), /*overwrite=*/1);
}

Causes::~Causes() {
    // NOLINTNEXTLINE(concurrency-mt-unsafe): this process has one thread
    unsetenv(kVariable);
    close(reading_);
    close(writing_);
}

std::vector<std::string> Causes::heard() const {
    std::string text;
    std::array<char, 4096> bytes{};
    for (ssize_t count = 0; (count = read(reading_, bytes.data(), bytes.size())) > 0;)
        text.append(bytes.data(), static_cast<std::size_t>(count));
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

bool tellSupervisor(const std::string& line) {
    // NOLINTNEXTLINE(concurrency-mt-unsafe): nobody changes it
    const char* pipe = std::getenv(kVariable);
    if (pipe == nullptr) return false;
    const std::string whole = line + '\n';
    return write(std::atoi(pipe), whole.data(), whole.size()) == static_cast<ssize_t>(whole.size());
}

}  // namespace aquarama::cli
