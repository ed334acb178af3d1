// SPDX-License-Identifier: Apache-2.0
#include "common/wall/frame_pipe.h"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <thread>

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include "common/units/log.h"

namespace aquarama::wall {

namespace {

using namespace std::chrono_literals;

// Before the codes of each frame; both ends are on one machine.
struct Header {
    std::uint64_t frame = 0;
    std::int32_t width = 0, height = 0;
};

std::string reason() {
    return std::strerror(errno);  // NOLINT(concurrency-mt-unsafe): read at once, by its own thread
}

// A pipe that nobody reads cannot be opened for writing without being held up for ever.
int openForWriting(const std::string& pipe) {
    constexpr auto kBetweenTries = 10ms;
    constexpr int kTries = 3000;
    for (int i = 0; i < kTries; ++i) {
        const int descriptor = open(pipe.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC);
        if (descriptor >= 0) {
            fcntl(descriptor, F_SETFL, 0);  // from here on waiting is right
            return descriptor;
        }
        if (errno != ENXIO) break;
        std::this_thread::sleep_for(kBetweenTries);
    }
    throw Error(pipe + ": no frames can be sent there (" + reason() +
                "); start aquarama-calibrate clip first");
}

int openForReading(const std::string& pipe) {
    const int descriptor = open(pipe.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (descriptor < 0)
        throw Error(pipe + ": cannot be read (" + reason() + "); make it with mkfifo");
    return descriptor;
}

template <class Value>
std::span<std::uint8_t> bytesOf(Value& value) {
    return {reinterpret_cast<std::uint8_t*>(&value), sizeof(value)};
}

std::size_t codesIn(glm::ivec2 sizePixels) {
    return 3 * static_cast<std::size_t>(sizePixels.x) * static_cast<std::size_t>(sizePixels.y);
}

}  // namespace

OpenFile::~OpenFile() {
    close(descriptor_);
}

std::filesystem::path framePipe(const std::filesystem::path& folder, const std::string& channel) {
    return folder / channel;
}

FramePipeWriter::FramePipeWriter(const std::filesystem::path& pipe)
    : file_{openForWriting(pipe.string())} {
    std::signal(SIGPIPE, SIG_IGN);  // a reader that has gone is an error of write(), not our end
}

void FramePipeWriter::write(std::uint64_t frame, const Picture& picture) {
    Header header{frame, picture.sizePixels.x, picture.sizePixels.y};
    codes_.assign(picture.rgb.begin(), picture.rgb.end());
    writeAll(bytesOf(header));
    writeAll(codes_);
}

void FramePipeWriter::writeAll(std::span<const std::uint8_t> bytes) const {
    while (!bytes.empty()) {
        const ssize_t written = ::write(file_.descriptor(), bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0)
            throw Error("the clip's frames are read no longer (" + reason() +
                        "); see what its encoder said");
        bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
}

FramePipeReader::FramePipeReader(const std::filesystem::path& pipe)
    : name_{pipe.string()}, file_{openForReading(name_)} {}

std::optional<PipedFrame> FramePipeReader::read(glm::ivec2 sizePixels) {
    Header header;
    if (!readAll(bytesOf(header))) return std::nullopt;
    if (header.width != sizePixels.x || header.height != sizePixels.y)
        throw Error(name_ + ": a frame of " + std::to_string(header.width) + " x " +
                    std::to_string(header.height) + " pixels came; film with the rig of the show");
    codes_.resize(codesIn(sizePixels));
    if (!readAll(codes_)) return std::nullopt;
    return PipedFrame{header.frame, {sizePixels, 8, {codes_.begin(), codes_.end()}}};
}

// Before the first writer has come there is nothing to read and no end either.
bool FramePipeReader::readAll(std::span<std::uint8_t> bytes) const {
    while (!bytes.empty()) {
        pollfd ready{.fd = file_.descriptor(), .events = POLLIN, .revents = 0};
        if (poll(&ready, 1, -1) < 0) continue;  // a signal
        const ssize_t count = ::read(file_.descriptor(), bytes.data(), bytes.size());
        if (count == 0) return false;
        if (count < 0 && (errno == EINTR || errno == EAGAIN)) continue;
        if (count < 0) throw Error(name_ + ": cannot be read (" + reason() + ")");
        bytes = bytes.subspan(static_cast<std::size_t>(count));
    }
    return true;
}

}  // namespace aquarama::wall
